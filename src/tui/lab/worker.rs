//! The lab's threads: one renders, one looks under pixels, one reads and writes files.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;
use std::time::{Duration, Instant};

use super::bench::{Bench, Shelf, Watch};
use super::setup::Setup;
use super::told::{Finding, Held, Look, Order, Told, Under, Wanted};
use crate::experiment::preview::Stock;
use crate::file::write_whole;
use crate::job;
use crate::method::Prefiltered;
use crate::scene::{StagedScene, look_under};
use crate::texture::Lookup;

/// Points of a footprint that its true distribution is drawn from while the cursor moves.
const POINTS: u32 = 512;
/// Progress is told at most this often.
const EVERY: Duration = Duration::from_millis(100);

/// Hears what the lab's threads tell, from any of them.
pub type Tell = Arc<dyn Fn(Told) + Send + Sync>;

/// The lab's threads.
pub struct Worker {
    desk: Arc<Desk>,
    looks: mpsc::Sender<Look>,
    files: mpsc::Sender<Order>,
}

/// What the rendering thread is asked for, and what it has to show.
#[derive(Default)]
struct Desk {
    wanted: Mutex<Option<Wanted>>,
    arrived: Condvar,
    /// Counts orders, so that whoever works sees that there is another.
    orders: AtomicU64,
    stand: Mutex<Option<Stand>>,
}

/// A scene and the maps that are built for it.
#[derive(Clone)]
struct Stand {
    scene: u64,
    staged: Arc<StagedScene>,
    maps: Vec<Option<LookedUp>>,
}

/// A map and how it is looked up.
type LookedUp = (Lookup, Arc<dyn Prefiltered>);

/// What a thread that panicked held is taken as it is: each value is written whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Worker {
    /// Starts the threads.
    pub fn start(tell: Tell) -> Self {
        let desk = Arc::new(Desk::default());
        let (looks, asked) = mpsc::channel();
        let (files, orders) = mpsc::channel();
        let (at, told) = (Arc::clone(&desk), Arc::clone(&tell));
        thread::spawn(move || render(&at, &told));
        let (at, told) = (Arc::clone(&desk), Arc::clone(&tell));
        thread::spawn(move || look(&at, &asked, &told));
        thread::spawn(move || keep_files(&orders, &tell));
        Self { desk, looks, files }
    }

    /// Passes an order on; never waits.
    pub fn order(&self, order: Order) {
        // A thread that is gone has panicked, and the program is ending.
        match order {
            Order::Show(wanted) => self.want(Some(*wanted)),
            Order::Rest => self.want(None),
            Order::Probe(look) => drop(self.looks.send(look)),
            file => drop(self.files.send(file)),
        }
    }

    fn want(&self, wanted: Option<Wanted>) {
        let mut waiting = lock(&self.desk.wanted);
        *waiting = wanted;
        // Counted under the lock: whoever takes an order knows its number.
        self.desk.orders.fetch_add(1, Ordering::Relaxed);
        drop(waiting);
        self.desk.arrived.notify_one();
    }
}

/// Renders what is wanted, step by step, until something else is.
fn render(desk: &Desk, tell: &Tell) {
    let (mut stock, mut shelf) = (Stock::default(), Shelf::new());
    let mut bench: Option<Bench> = None;
    loop {
        let (wanted, order) = {
            let waiting = lock(&desk.wanted);
            let idle = |wanted: &mut Option<Wanted>| wanted.is_none();
            let held = desk.arrived.wait_while(waiting, idle);
            let mut wanted = held.unwrap_or_else(PoisonError::into_inner);
            (wanted.take(), desk.orders.load(Ordering::Relaxed))
        };
        let Some(wanted) = wanted else { continue };
        let scene = wanted.scene;
        match bench.as_mut().filter(|bench| bench.wanted.scene == scene) {
            Some(bench) => bench.wanted.first = wanted.first,
            None => {
                bench = None;
                match Bench::new(wanted, &mut stock) {
                    Ok(new) => {
                        tell(Told::Of(scene, Finding::Notes(stock.notes().to_vec())));
                        bench = Some(new);
                    }
                    Err(message) => tell(Told::Of(scene, Finding::Failed(message))),
                }
            }
        }
        if let Some(bench) = &mut bench {
            finish(bench, &mut shelf, desk, order, tell);
        }
    }
}

/// Works at a scene until it is done or another order comes.
fn finish(bench: &mut Bench, shelf: &mut Shelf, desk: &Desk, order: u64, tell: &Tell) {
    let scene = bench.wanted.scene;
    let cancelled = || desk.orders.load(Ordering::Relaxed) != order;
    let last = Mutex::new(None::<Instant>);
    let now_and_then = |finding: Finding| {
        let mut last = lock(&last);
        if last.is_none_or(|last| last.elapsed() >= EVERY) {
            *last = Some(Instant::now());
            tell(Told::Of(scene, finding));
        }
    };
    let watch = Watch { cancelled: &cancelled, tell: &now_and_then };
    show(bench, desk);
    while let Some(step) = bench.next() {
        let findings = bench.work(step, shelf, &watch);
        // Set out before it is told: whoever hears of a map may look into it.
        show(bench, desk);
        findings.into_iter().for_each(|finding| tell(Told::Of(scene, finding)));
        if cancelled() {
            return;
        }
    }
    tell(Told::Of(scene, Finding::Done));
}

/// Sets out what is built, for those who look under pixels.
fn show(bench: &Bench, desk: &Desk) {
    let methods = &bench.wanted.spec.sweep.methods;
    let map = |(map, of): (&Option<Arc<dyn Prefiltered>>, &crate::experiment::spec::MethodSpec)| {
        map.as_ref().map(|map| (of.lookup, Arc::clone(map)))
    };
    let maps = bench.maps.iter().zip(methods).map(map).collect();
    let (scene, staged) = (bench.wanted.scene, Arc::clone(&bench.staged));
    *lock(&desk.stand) = Some(Stand { scene, staged, maps });
}

/// Looks under the pixel last asked for. In a pool of its own: it does not queue behind what is rendered.
fn look(desk: &Desk, asked: &mpsc::Receiver<Look>, tell: &Tell) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    while let Ok(mut wish) = asked.recv() {
        while let Ok(later) = asked.try_recv() {
            wish = later;
        }
        let Some(stand) = lock(&desk.stand).clone().filter(|stand| stand.scene == wish.scene)
        else {
            continue;
        };
        let under = match &pool {
            Ok(pool) => pool.install(|| under(&stand, &wish)),
            Err(_) => under(&stand, &wish),
        };
        tell(Told::Of(wish.scene, Finding::Under(Box::new(under))));
    }
}

fn under(stand: &Stand, wish: &Look) -> Under {
    let built: Vec<(usize, &LookedUp)> = wish
        .methods
        .iter()
        .filter_map(|&method| Some((method, stand.maps.get(method)?.as_ref()?)))
        .collect();
    let maps: Vec<_> = built.iter().map(|(_, (lookup, map))| (*lookup, map.as_ref())).collect();
    let pixel = wish.pixel;
    let Some(found) = look_under(&stand.staged, pixel, POINTS, &maps) else {
        return Under { pixel, texels_across: None, truth: Vec::new(), methods: Vec::new() };
    };
    let held = |((method, _), held): (&(usize, _), crate::scene::Held)| Held {
        method: *method,
        axes: held.surface.lobes().iter().map(|lobe| lobe.axis()).collect(),
        density: held.density,
        distance: held.distance,
    };
    let methods = built.iter().zip(found.methods).map(held).collect();
    Under { pixel, texels_across: Some(found.texels_across), truth: found.truth, methods }
}

/// Opens and saves.
fn keep_files(orders: &mpsc::Receiver<Order>, tell: &Tell) {
    while let Ok(order) = orders.recv() {
        match order {
            Order::Open(name) => tell(Told::Opened(open(&name).map(Box::new))),
            Order::Save(text) => tell(Told::Saved(save(&text, Path::new(job::FOLDER)))),
            _ => {}
        }
    }
}

/// The setup of a map, or of an experiment.
fn open(name: &str) -> Result<Setup, String> {
    let path = Path::new(name);
    if job::is_image(path) {
        return Setup::of_map(path);
    }
    match job::draft(name) {
        Ok(draft) => Setup::of_draft(name, draft),
        Err(job::FindError::WhichPart { parts, .. }) if !parts.is_empty() => {
            open(&format!("{name}/{}", parts[0]))
        }
        Err(error) => Err(error.to_string()),
    }
}

/// Writes an experiment under the first free name.
fn save(text: &str, folder: &Path) -> Result<PathBuf, String> {
    let cannot =
        |path: &Path, error: std::io::Error| format!("cannot write {}: {error}", path.display());
    std::fs::create_dir_all(folder).map_err(|error| cannot(folder, error))?;
    let free = (1..).map(|n| folder.join(format!("lab-{n}.toml"))).find(|path| !path.exists());
    let path = free.unwrap_or_else(|| folder.join("lab.toml"));
    let text = format!("# A scene of the lab. docs/experiments.md explains every key.\n\n{text}");
    write_whole(&path, text.as_bytes()).map_err(|error| cannot(&path, error))?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::{Receiver, RecvTimeoutError};

    use super::*;

    /// Generous: a busy machine is no failure.
    const DEADLINE: Duration = Duration::from_secs(300);

    fn wanted(scene: u64, texels: f64) -> Wanted {
        let mut setup = super::super::setup::tests::setup();
        setup.draft.set("image", "width", 32);
        setup.draft.set("image", "height", 24);
        let list = toml::Value::Array(vec![texels.into()]);
        setup.draft.set("sweep", "texels_per_pixel", list);
        Wanted { scene, spec: setup.spec().unwrap(), spp: 1, first: vec![0] }
    }

    fn start() -> (Worker, Receiver<Told>) {
        let (sender, told) = mpsc::channel();
        let sender = Mutex::new(sender);
        let worker = Worker::start(Arc::new(move |told| drop(lock(&sender).send(told))));
        (worker, told)
    }

    /// What is told of a scene until it is done.
    fn until_done(told: &Receiver<Told>, scene: u64) -> Vec<Finding> {
        let mut findings = Vec::new();
        loop {
            match told.recv_timeout(DEADLINE) {
                Ok(Told::Of(of, Finding::Done)) if of == scene => return findings,
                Ok(Told::Of(of, finding)) if of == scene => findings.push(finding),
                Ok(_) => {}
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
                    panic!("scene {scene} was never done: {} findings", findings.len())
                }
            }
        }
    }

    #[test]
    fn one_scene_after_the_other_is_done() {
        let (worker, told) = start();
        for scene in 1..4 {
            worker.order(Order::Show(Box::new(wanted(scene, scene as f64))));
            assert!(!until_done(&told, scene).is_empty());
        }
    }

    #[test]
    fn the_last_of_many_orders_is_done() {
        let (worker, told) = start();
        for scene in 1..20 {
            worker.order(Order::Show(Box::new(wanted(scene, 1.0 + scene as f64))));
        }
        until_done(&told, 19);
        worker.order(Order::Rest);
        worker.order(Order::Show(Box::new(wanted(20, 3.0))));
        until_done(&told, 20);
    }

    #[test]
    fn what_lies_under_a_pixel_is_told_of_the_scene_shown() {
        let (worker, told) = start();
        worker.order(Order::Show(Box::new(wanted(1, 4.0))));
        until_done(&told, 1);
        worker.order(Order::Probe(Look { scene: 1, pixel: [16, 12], methods: vec![0, 8] }));
        let under = loop {
            let told = told.recv_timeout(DEADLINE).expect("an answer");
            if let Told::Of(1, Finding::Under(under)) = told {
                break under;
            }
        };
        assert_eq!((under.truth.len(), under.methods.len()), (1297, 2));
        assert!(under.methods.iter().all(|held| held.axes.len() == 1));
    }

    #[test]
    fn what_is_not_there_is_told_in_a_sentence() {
        for (name, told) in [
            ("gone.png", "there is no file"),
            ("no-such-experiment.toml", "there is no experiment file"),
        ] {
            let error = open(name).unwrap_err();
            assert!(error.contains(told), "{error}");
        }
    }

    #[test]
    fn what_is_saved_gets_a_name_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let text = super::super::setup::tests::setup().experiment();
        let one = save(&text, folder.path()).unwrap();
        let two = save(&text, folder.path()).unwrap();
        assert!(one.ends_with("lab-1.toml") && two.ends_with("lab-2.toml"));
        assert!(crate::experiment::spec::Spec::load(&two).is_ok());
    }
}
