//! The material: a base lobe and what its density means for light.

use super::item::Item;
use super::limits::Limits;
use super::reader::Reader;
use crate::lobe::intensity::Fresnel;
use crate::lobe::{BaseLobe, Shading};

/// The family of a base lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    BlinnPhong,
    Beckmann,
    Ggx,
}

const FAMILIES: [(&str, Family); 3] =
    [("blinn-phong", Family::BlinnPhong), ("beckmann", Family::Beckmann), ("ggx", Family::Ggx)];

/// Exponents: from wider than any paper draws to sharper than a pixel can show.
const EXPONENT: Limits = Limits::from_to(1.0, 100_000.0);
/// Roughness α, up to a cosine distribution's.
const ALPHA: Limits = Limits::from_to(0.005, 1.0);

impl Family {
    /// The key of the number that states the width of these lobes.
    pub fn key(self) -> &'static str {
        match self {
            Self::BlinnPhong => "exponent",
            Self::Beckmann | Self::Ggx => "alpha",
        }
    }

    fn default(self) -> f64 {
        match self {
            Self::BlinnPhong => 60.0,
            Self::Beckmann | Self::Ggx => 0.2,
        }
    }

    /// Reads the number that states the width.
    pub fn parameter(self, item: &Item) -> Option<f64> {
        item.real(match self {
            Self::BlinnPhong => EXPONENT,
            Self::Beckmann | Self::Ggx => ALPHA,
        })
    }

    /// The lobe of this family and width.
    pub fn lobe(self, parameter: f64) -> BaseLobe {
        match self {
            Self::BlinnPhong => BaseLobe::BlinnPhong { exponent: parameter },
            Self::Beckmann => BaseLobe::Beckmann { alpha: parameter },
            Self::Ggx => BaseLobe::Ggx { alpha: parameter },
        }
    }
}

/// The `[material]` table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Material {
    pub family: Family,
    pub lobe: BaseLobe,
    pub shading: Shading,
}

impl Material {
    pub fn read(reader: &Reader) -> Self {
        let (family, lobe) = read_lobe(reader);
        let shadings = [
            ("ndf", Shading::Ndf),
            ("microfacet", Shading::Microfacet),
            ("phong", Shading::Phong),
            ("torrance-sparrow", Shading::TorranceSparrow(Fresnel::Mirror)),
        ];
        let shading = match reader.choice("shading", &shadings) {
            Shading::TorranceSparrow(_) => Shading::TorranceSparrow(read_fresnel(reader)),
            shading => shading,
        };
        if let (Shading::Phong, true, Some(item)) =
            (shading, family != Family::BlinnPhong, reader.item("shading"))
        {
            let help = "choose the lobe \"blinn-phong\", or another shading".to_owned();
            item.error(
                "Phong's highlight has an exponent, and this lobe has none".to_owned(),
                Some(help),
            );
        }
        Self { family, lobe, shading }
    }
}

/// What facets mirror: all, unless there is an index of refraction.
fn read_fresnel(reader: &Reader) -> Fresnel {
    let index = reader.item("index").and_then(|item| item.real(Limits::from_to(1.0, 10.0)));
    index.map_or(Fresnel::Mirror, |index| Fresnel::Index(index as f32))
}

/// Reads `lobe` and its `exponent` or `alpha`.
pub(super) fn read_lobe(reader: &Reader) -> (Family, BaseLobe) {
    let family = reader.choice("lobe", &FAMILIES);
    let item = reader.item(family.key());
    let parameter = item.and_then(|item| family.parameter(&item));
    (family, family.lobe(parameter.unwrap_or(family.default())))
}
