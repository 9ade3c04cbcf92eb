//! Distributions of normals as lobes in words.

use crate::lobe::vector::{V3, turned};
use crate::lobe::{EllipticLobe, MultipleSurface, NdfError, NdfImage, Profile};

/// A lobe of a distribution, and its share of all normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrittenLobe {
    /// Its share over those of the other lobes, above 0.
    pub share: f64,
    /// How its density falls.
    pub family: Family,
    /// Its widths along its own two axes: roughnesses α, or exponents.
    pub widths: [f64; 2],
    /// Degrees by which these axes are turned, from u towards v.
    pub direction: f64,
    /// Degrees by which its middle leans away from the surface's normal, in [0, 85].
    pub tilt: f64,
    /// Where it leans to, degrees from u towards v.
    pub azimuth: f64,
}

/// Families of lobes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Blinn-Phong, by its exponent.
    BlinnPhong,
    /// Beckmann, by its roughness α.
    Beckmann,
    /// GGX, by its roughness α.
    Ggx,
}

/// Most lobes of a distribution.
const MOST: usize = 64;

/// The lobes a text is of, `[SHARE*]FAMILY:U[,V[,DEGREES]][@TILT,AZIMUTH]` joined by `+`; `None` if it is of another kind.
///
/// # Errors
/// A sentence that says what is wrong with which lobe.
pub fn lobes(text: &str) -> Option<Result<Vec<WrittenLobe>, String>> {
    let (head, _) = text.split_once(':')?;
    let name = head.rsplit('*').next().unwrap_or(head);
    Family::of(name.trim())?;
    let read = text.split('+').map(|term| {
        WrittenLobe::parse(term.trim()).map_err(|error| format!("{}: {error}", term.trim()))
    });
    let all: Result<Vec<_>, _> = read.collect();
    Some(all.and_then(|all| match all.len() {
        ..=MOST => Ok(all),
        many => Err(format!("{many} lobes are too many: give at most {MOST}")),
    }))
}

/// What they are together: each by its share of the normals over the (x, y) map.
///
/// # Errors
/// [`NdfError::Empty`] if none has any density.
pub fn ndf_of(lobes: &[WrittenLobe], side: usize) -> Result<NdfImage, NdfError> {
    let image = |lobe: &WrittenLobe| {
        let surface: MultipleSurface = [lobe.lobe()].into_iter().collect();
        NdfImage::of_surface(&surface, side).map(|image| (lobe.share, image))
    };
    let images: Vec<_> = lobes.iter().map(image).collect::<Result<_, _>>()?;
    match images.as_slice() {
        [(_, only)] => Ok(only.clone()),
        all => {
            let all: Vec<_> = all.iter().map(|(share, image)| (*share, image)).collect();
            NdfImage::mixed(&all)
        }
    }
}

impl WrittenLobe {
    fn parse(term: &str) -> Result<Self, String> {
        let (share, term) = match term.split_once('*') {
            Some((share, term)) => (number(share)?, term),
            None => (1.0, term),
        };
        if !(1e-6..=1e6).contains(&share) {
            return Err("a share is from 0.000001 to 1000000".into());
        }
        let form = || "a lobe is written FAMILY:WIDTHS, such as ggx:0.3".to_owned();
        let (name, rest) = term.split_once(':').ok_or_else(form)?;
        let family = Family::of(name.trim())
            .ok_or("the families are blinn-phong, beckmann and ggx".to_owned())?;
        let (widths, leaning) = match rest.split_once('@') {
            Some((widths, leaning)) => (widths, Some(leaning)),
            None => (rest, None),
        };
        let (u, v, direction) = match *numbers(widths)?.as_slice() {
            [width] => (width, width, 0.0),
            [u, v] => (u, v, 0.0),
            [u, v, degrees] => (u, v, degrees),
            _ => {
                return Err(
                    "give one width, one along u and one along v, or both and an angle".into()
                );
            }
        };
        let (range, what) = family.widths();
        if !(range.contains(&u) && range.contains(&v)) {
            return Err(what.into());
        }
        let [tilt, azimuth] = match leaning.map(numbers).transpose()?.as_deref() {
            None => [0.0, 0.0],
            Some(&[tilt, azimuth]) => [tilt, azimuth],
            Some(_) => return Err("after @ give a tilt and an azimuth, such as @30,90".into()),
        };
        if ![direction, azimuth].iter().all(|angle| (-360.0..=360.0).contains(angle)) {
            return Err("an angle is from -360 to 360 degrees".into());
        }
        if !(0.0..=85.0).contains(&tilt) {
            return Err("a tilt is from 0 to 85 degrees".into());
        }
        Ok(Self { share, family, widths: [u, v], direction, tilt, azimuth })
    }

    fn lobe(&self) -> EllipticLobe {
        // A Gaussian's spread is the variance of slopes, α²/2; GGX's is α².
        let spread = |width: f64| match self.family {
            Family::BlinnPhong => 1.0 / width,
            Family::Beckmann => 0.5 * width * width,
            Family::Ggx => width * width,
        };
        let [a, b] = self.widths.map(spread);
        let profile = match self.family {
            // One exponent for both tails: that of the mean variance.
            Family::BlinnPhong => Profile::Student { exponent: (2.0 / (a + b)) as f32 },
            Family::Beckmann => Profile::Gaussian,
            Family::Ggx => Profile::Ggx,
        };
        EllipticLobe::new(self.middle(), turned([a, b], self.direction), 1.0, profile)
    }

    fn middle(&self) -> V3 {
        let (out, up) = libm::sincos(self.tilt.to_radians());
        let (v, u) = libm::sincos(self.azimuth.to_radians());
        [out * u, out * v, up].map(|c| c as f32)
    }
}

impl Family {
    fn of(name: &str) -> Option<Self> {
        match name {
            "blinn-phong" => Some(Self::BlinnPhong),
            "beckmann" => Some(Self::Beckmann),
            "ggx" => Some(Self::Ggx),
            _ => None,
        }
    }

    /// Widths it may have. Narrower, and it would be less than a pixel of its image wide.
    fn widths(self) -> (std::ops::RangeInclusive<f64>, &'static str) {
        match self {
            Self::BlinnPhong => (1.0..=5000.0, "an exponent is from 1 to 5000"),
            Self::Beckmann | Self::Ggx => (0.02..=2.0, "a roughness α is from 0.02 to 2"),
        }
    }
}

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("`{}` is not a number", text.trim()))
}

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let parsed: Result<_, _> = text.split(',').map(|n| n.trim().parse()).collect();
    parsed.map_err(|_| "write numbers with commas between them".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lobes_are_read_in_words_and_nonsense_is_told() {
        for (text, count) in [
            ("beckmann:0.3", 1),
            ("ggx:0.1,0.4 + blinn-phong:60", 2),
            ("2*beckmann:0.1, 0.4, -30@20,90+0.5*ggx:0.2@0,0", 2),
        ] {
            assert_eq!(lobes(text).unwrap().unwrap().len(), count, "{text}");
        }
        for (text, says) in [
            ("beckmann:", "write numbers"),
            ("ggx:NaN", "from 0.02 to 2"),
            ("beckmann:0", "from 0.02 to 2"),
            ("ggx:1,2,3,4", "give one width"),
            ("beckmann:0.1,0.1,inf", "an angle is"),
            ("blinn-phong:-3", "an exponent is"),
            ("ggx:0.3 + velvet", "velvet: a lobe is written"),
            ("ggx:0.3+charlie:0.3", "charlie:0.3: the families are"),
            ("0*ggx:0.3", "a share is"),
            ("x*ggx:0.3", "`x` is not a number"),
            ("ggx:0.3@30", "give a tilt and an azimuth"),
            ("ggx:0.3@89,0", "a tilt is"),
        ] {
            let error = lobes(text).unwrap().unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
        }
        assert!(lobes(&["ggx:1"; 65].join("+")).unwrap().unwrap_err().contains("65 lobes"));
        assert!(lobes("velvet").is_none() && lobes("C:file.exr").is_none());
        assert!(lobes("").is_none() && lobes("a+b.exr").is_none());
    }

    #[test]
    fn shares_are_those_of_normals_and_middles_lean_as_told() {
        let of = |text: &str| ndf_of(&lobes(text).unwrap().unwrap(), 128).unwrap();
        let two = of("3*beckmann:0.1@30,0 + beckmann:0.1@30,180");
        let normals = |sign: f64| -> f64 {
            let at = |k: usize| (2 * (k % 128) + 1) as f64 / 128.0 - 1.0;
            let all = two.values().iter().enumerate();
            all.filter(|(k, _)| at(*k) * sign > 0.0).map(|(_, d)| f64::from(*d)).sum()
        };
        // The lobes lie five of their widths apart: next to nothing of one is on the other's side.
        assert!((normals(1.0) / normals(-1.0) - 3.0).abs() < 1e-3);
        // sin 30° = ½, but that lobes are a little short of symmetric.
        let mean = of("beckmann:0.1@30,90").mean_normal();
        assert!((mean[1] - 0.5).abs() < 0.01 && mean[0].abs() < 1e-4, "{mean:?}");
    }
}
