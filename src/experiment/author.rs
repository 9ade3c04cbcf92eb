//! From a spec to entities: the author of the world.

mod placement;

use std::sync::Arc;

use bevy_ecs::prelude::*;

use placement::{Placement, placements, spawn_lights};

use super::spec::{
    AxesSpec, EnvironmentSource, LightSpec, MAX_REPEATED, ModelSpec, Pose, ReferenceSpec,
    Shape as ShapeSpec, Spec, SurfaceSpec, TextureSource, TextureSpec,
};
use crate::light::Light;
use crate::light::environment::{Environment, Read, maps, read};
use crate::lobe::BaseLobe;
use crate::pattern::{self, Bumps};
use crate::render::direction;
use crate::scene::{
    BudgetPlan, BumpSource, Kindled, LightOrigin, LightSource, LoadError, LookupBy, Material,
    PrefilterOf, ProbePlan, ReferencePlan, SameAs, SceneOf, Shaped, Spp, Stagehand, Strategy,
    SurfaceOrigin, SurfaceShape, Texture, TiledBefore, Tiling, TrialOf,
};
use crate::surface::{
    Cylinder, MainDirection, Mesh, Perturbation, Perturbed, Plane, Shape, Sphere, WavyFrame,
    WavySphere, bent_patch, drapery, read_model, ribbon, teapot,
};
use crate::texture::{Integrated, integrate};

/// The entities of an experiment, in the order of its spec.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// One a texture.
    pub textures: Vec<Entity>,
    /// The scenes, texture by texture, so that a texture's maps can be let go when its scenes are done.
    pub scenes: Vec<PlannedScene>,
}

impl Plan {
    /// Whether no later scene looks at the prefilters of this one.
    pub(super) fn is_last_of_its_prefilters(&self, scene: &PlannedScene) -> bool {
        let last = self.scenes.iter().rfind(|other| other.prefilters == scene.prefilters);
        last.is_some_and(|last| last.entity == scene.entity)
    }
}

/// A scene of the sweep.
#[derive(Clone, Debug)]
pub struct PlannedScene {
    /// The scene.
    pub entity: Entity,
    /// Index of its texture in the spec.
    pub texture: usize,
    /// What its texture is made of, as text.
    pub texture_key: String,
    /// Its base lobe.
    pub base: BaseLobe,
    /// How its texture is laid.
    pub tiling: Tiling,
    /// Distance of its camera.
    pub distance: f64,
    /// Degrees above the plane z = 0 that its camera stands at.
    pub elevation: f64,
    /// Which frame of its sequence it is, if things move.
    pub frame: Option<Frame>,
    /// A file-name-safe identifier, unique in the experiment.
    pub slug: String,
    /// The slug of its sequence: the same in all its frames. Of a still scene, its own.
    pub sequence: String,
    /// Its prefilters, one a method in the spec's order.
    pub prefilters: Vec<Entity>,
    /// Its trials, method by method.
    pub trials: Vec<PlannedTrial>,
}

/// A frame of a sequence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Its number, the first being 0.
    pub number: u32,
    /// Where things stand in it.
    pub pose: Pose,
    /// Distance of the camera at rest, which the texture is tiled before.
    pub rest: f64,
}

/// A trial of a scene.
#[derive(Clone, Debug)]
pub struct PlannedTrial {
    /// The trial.
    pub entity: Entity,
    /// Index of its method in the spec.
    pub method: usize,
    /// Samples a pixel.
    pub spp: u32,
}

/// Spawns all entities of the experiment.
pub fn author(spec: &Spec, stage: &mut Stagehand) -> Plan {
    let world = &mut stage.world;
    let textures: Vec<Entity> =
        spec.sweep.textures.iter().map(|t| spawn_texture(world, t, spec.needs_heights())).collect();
    let strategies: Vec<Entity> = spec
        .sweep
        .methods
        .iter()
        .map(|m| world.spawn((Name::new(m.label.clone()), Strategy(m.build()))).id())
        .collect();
    let materials: Vec<(BaseLobe, Entity)> = spec
        .sweep
        .lobes
        .iter()
        .map(|&base| (base, world.spawn(Material { base, shading: spec.shading }).id()))
        .collect();
    let surface = spawn_surface(world, &spec.surface);
    let lights = spawn_lights(world, spec);
    let placements = placements(world, spec, &lights);

    let mut plan = Plan { textures, scenes: Vec::new() };
    for (index, &texture) in plan.textures.iter().enumerate() {
        let texture_key = super::keys::texture(&spec.sweep.textures[index]);
        for &(base, material) in &materials {
            let of = |strategy| PrefilterOf { texture, strategy, material };
            let prefilters = spawn_prefilters(world, spec, &strategies, of);
            for placement in &placements {
                let Placement { camera, light, tiling, .. } = *placement;
                let of = SceneOf { texture, surface, camera, light, material };
                let sequence = slug(spec, index, &base, placement);
                let scene = spawn_scene(world, spec, of, placement);
                plan_budget(world, spec, scene, &prefilters);
                plan.scenes.push(PlannedScene {
                    entity: scene,
                    texture: index,
                    texture_key: texture_key.clone(),
                    base,
                    tiling,
                    distance: placement.distance,
                    elevation: placement.elevation,
                    frame: placement.frame,
                    slug: match placement.frame {
                        Some(frame) => format!("{sequence}-f{:03}", frame.number + 1),
                        None => sequence.clone(),
                    },
                    sequence,
                    trials: spawn_trials(world, spec, scene, &prefilters),
                    prefilters: prefilters.clone(),
                });
            }
        }
    }
    plan
}

fn spawn_scene(world: &mut World, spec: &Spec, of: SceneOf, placement: &Placement) -> Entity {
    let centre = [spec.image.width / 2, spec.image.height / 2];
    // Beside the centre, a pixel halfway to the image's corner, where the highlight fades.
    let aside = [spec.image.width / 4, spec.image.height / 4];
    let ReferenceSpec { replicates, truth, gap, .. } = spec.reference;
    let (spp, most) = (spec.reference.replicate_spp(), spec.reference.most_replicates());
    let still = ReferencePlan { spp, replicates, most, gap, truth, first: 1 };
    let Some(Frame { number, .. }) = placement.frame else {
        return world.spawn((of, placement.tiling, still, ProbePlan(vec![centre, aside]))).id();
    };
    // No two frames' references share a random number, so that the noise of their difference is known.
    let reference = ReferencePlan { first: 1 + number * most, ..still };
    let before = TiledBefore(placement.first);
    world.spawn((of, placement.tiling, before, reference, ProbePlan(vec![centre]))).id()
}

/// Asks for the budgets that the spec wants of a scene.
fn plan_budget(world: &mut World, spec: &Spec, scene: Entity, prefilters: &[Entity]) {
    if let Some(budget) = &spec.budget {
        let prefilters = budget.methods.iter().map(|&method| prefilters[method]).collect();
        let plan = BudgetPlan { prefilters, points: budget.points };
        world.entity_mut(scene).insert(plan);
    }
}

/// One prefilter a method; those that differ in their lookup alone are built once.
fn spawn_prefilters(
    world: &mut World,
    spec: &Spec,
    strategies: &[Entity],
    of: impl Fn(Entity) -> PrefilterOf,
) -> Vec<Entity> {
    let methods = &spec.sweep.methods;
    let mut all: Vec<Entity> = Vec::with_capacity(methods.len());
    for (k, (method, &strategy)) in methods.iter().zip(strategies).enumerate() {
        let entity = world.spawn((of(strategy), LookupBy(method.lookup))).id();
        if let Some(other) = methods[..k].iter().position(|other| other.same_filter(method)) {
            world.entity_mut(entity).insert(SameAs(all[other]));
        }
        all.push(entity);
    }
    all
}

fn spawn_trials(
    world: &mut World,
    spec: &Spec,
    scene: Entity,
    prefilters: &[Entity],
) -> Vec<PlannedTrial> {
    let mut trials = Vec::new();
    for (method, (of, &prefilter)) in spec.sweep.methods.iter().zip(prefilters).enumerate() {
        for &spp in spec.sweep.spp_of(of) {
            let entity = world.spawn((TrialOf { scene, prefilter }, Spp(spp))).id();
            trials.push(PlannedTrial { entity, method, spp });
        }
    }
    trials
}

fn spawn_texture(world: &mut World, spec: &TextureSpec, heights: bool) -> Entity {
    let name = Name::new(spec.name.clone());
    let spec = spec.clone();
    let source = BumpSource(Box::new(move || load(&spec, heights)));
    world.spawn((Texture, name, source)).id()
}

/// Makes or reads a texture's bumps. Its normals know the heights they are of, where there are any; if
/// `heights` are needed and there are none, they are integrated, and a note tells how well.
///
/// # Errors
/// What is wrong with its file.
pub fn load(spec: &TextureSpec, heights: bool) -> Result<Bumps, LoadError> {
    let mut bumps = match &spec.source {
        TextureSource::Pattern { name, width, height, values, seed } => {
            let entry = pattern::find(name).expect("the spec names registered patterns");
            (entry.build)(*width, *height, values, *seed)
        }
        TextureSource::File { path, reading, .. } => {
            let reading = reading.of(spec.wrap);
            pattern::file::read(path, &reading).map_err(|error| LoadError(error.to_string()))?
        }
        TextureSource::Baked { recipe, .. } => {
            let baked = recipe.bake().map_err(|error| LoadError(error.to_string()))?;
            Bumps { normals: baked.normals, heights: None, notes: baked.notes }
        }
    };
    let heights = heights || spec.interpolation.spline().is_some();
    if heights && bumps.heights.is_none() {
        let Integrated { heights, residual } = integrate(&bumps.normals);
        bumps.notes.push(residual.to_string());
        bumps.heights = Some(heights);
    }
    if let Some(heights) = bumps.heights.take() {
        bumps.normals = bumps.normals.with_heights(Arc::new(heights));
    }
    bumps.normals = bumps.normals.with_interpolation(spec.interpolation);
    if spec.repeat > 1 {
        let longest = bumps.normals.width().max(bumps.normals.height());
        if longest * spec.repeat > MAX_REPEATED {
            let (name, most) = (&spec.name, MAX_REPEATED / longest);
            return Err(LoadError(format!(
                "texture {name} is {longest} texels long: `repeat` may be {most} at most",
                most = most.max(1)
            )));
        }
        bumps.normals = bumps.normals.replicated(spec.repeat);
    }
    Ok(bumps)
}

fn spawn_surface(world: &mut World, spec: &SurfaceSpec) -> Entity {
    let Some(ModelSpec { path, up }) = spec.model.clone() else {
        return world.spawn(SurfaceShape(shape(spec))).id();
    };
    let (axes, perturbation) = (spec.axes, spec.perturbation);
    let origin = SurfaceOrigin(Box::new(move || {
        let model = read_model(&path, up).map_err(|error| LoadError(error.to_string()))?;
        Ok(Shaped { shape: along(axes, perturbation, Shape::Mesh(model.mesh)), notes: model.notes })
    }));
    world.spawn(origin).id()
}

/// A surface that the program makes itself.
fn shape(spec: &SurfaceSpec) -> Shape {
    let frame = match spec.axes {
        AxesSpec::Sphere => WavyFrame::Sphere,
        AxesSpec::Natural | AxesSpec::MainDirection(_) => WavyFrame::Vertex,
    };
    let shape = match spec.shape {
        ShapeSpec::Plane => Shape::Plane(Plane::new()),
        ShapeSpec::Sphere => Shape::Sphere(Sphere::new()),
        ShapeSpec::Drapery => Shape::Mesh(drapery()),
        ShapeSpec::Teapot => Shape::Patches(teapot()),
        ShapeSpec::BentPatch => Shape::Patches(bent_patch()),
        ShapeSpec::Cylinder => Shape::Cylinder(Cylinder::new()),
        ShapeSpec::Ribbon => Shape::Patches(ribbon()),
        // Nothing, if its file is not told; the spec sees to it that it is.
        ShapeSpec::Mesh => Shape::Mesh(Mesh::new(Vec::new(), &[])),
        ShapeSpec::WavySphere(wavy) => {
            Shape::WavySphere(WavySphere::new(wavy.ripples, wavy.cells, frame))
        }
    };
    along(spec.axes, spec.perturbation, shape)
}

/// The surface with bumps along these axes, as steep as that form makes them.
fn along(axes: AxesSpec, perturbation: Perturbation, shape: Shape) -> Shape {
    if perturbation != Perturbation::Tangent {
        return Shape::Perturbed(Perturbed::new(shape, perturbation));
    }
    match axes {
        AxesSpec::MainDirection(main) => {
            Shape::MainDirection(MainDirection::new(shape, main.into()))
        }
        AxesSpec::Natural | AxesSpec::Sphere => shape,
    }
}

fn spawn_light(world: &mut World, spec: &LightSpec) -> Entity {
    let spec = spec.clone();
    match spec {
        LightSpec::Directional { elevation, azimuth, irradiance } => {
            let direction = direction(elevation, azimuth);
            world.spawn(LightSource(Light::Directional { direction, irradiance })).id()
        }
        LightSpec::Point { position: [x, y, z], intensity } => {
            let position = crate::geometry::Vec3::new(x, y, z);
            world.spawn(LightSource(Light::Point { position, intensity })).id()
        }
        LightSpec::Environment { source, rotation, intensity, filter } => {
            let origin = LightOrigin(Box::new(move || {
                let Read { environment, notes } = surroundings(&source, rotation, intensity)?;
                let environment = Arc::new(environment);
                Ok(Kindled { light: Light::Environment { environment, filter }, notes })
            }));
            world.spawn(origin).id()
        }
    }
}

/// Makes or reads an environment.
fn surroundings(
    source: &EnvironmentSource,
    rotation: f64,
    intensity: f64,
) -> Result<Read, LoadError> {
    match source {
        EnvironmentSource::Map { name, width, values } => {
            let entry = maps::find(name).expect("the spec names registered maps");
            let radiance = (entry.build)(values);
            let environment = Environment::of(&*radiance, width / 2, rotation, intensity);
            Ok(Read { environment, notes: Vec::new() })
        }
        EnvironmentSource::File { path } => {
            read(path, rotation, intensity).map_err(|error| LoadError(error.to_string()))
        }
    }
}

/// A scene's file-name-safe identifier, but for the number of its frame: its texture, its lobe and elevation if
/// there are several, its scale.
fn slug(spec: &Spec, texture: usize, base: &BaseLobe, placement: &Placement) -> String {
    let safe = |text: &str| -> String {
        text.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect()
    };
    let mut parts = vec![safe(&spec.sweep.textures[texture].name)];
    // Names that differ only in what was replaced stay apart.
    let same = |t: &TextureSpec| safe(&t.name) == parts[0];
    if spec.sweep.textures.iter().filter(|t| same(t)).count() > 1 {
        parts.push(texture.to_string());
    }
    if spec.sweep.lobes.len() > 1 {
        parts.push(format!("{}-{}", base.name(), base.parameter()));
    }
    if spec.sweep.elevations.len() > 1 {
        parts.push(format!("from-{}", placement.elevation));
    }
    parts.push(match placement.tiling {
        Tiling::TexelsPerPixel(texels) => format!("{texels}-texels"),
        Tiling::Tiles(_) => {
            format!("at-{}", placement.frame.map_or(placement.distance, |frame| frame.rest))
        }
    });
    parts.join("-")
}
