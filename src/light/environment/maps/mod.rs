//! Environments the program computes. One file each; [`entries`] lists them.

mod moon;
mod stripes;
mod studio;
mod white;

use super::Radiance;
pub use crate::parameter::Card;
use crate::parameter::{Parameter, Values};

/// A map the program knows.
pub struct Entry {
    /// What it is.
    pub card: Card,
    /// Its options.
    pub parameters: &'static [Parameter],
    /// Its radiance with these options (complete, within their domains); z is up, +y ahead.
    pub build: fn(&Values) -> Box<Radiance>,
}

/// Every map, in the order lists show them.
pub fn entries() -> Vec<Entry> {
    vec![white::ENTRY, moon::ENTRY, stripes::ENTRY, studio::ENTRY]
}

/// The map of this name.
pub fn find(name: &str) -> Option<Entry> {
    entries().into_iter().find(|entry| entry.card.name == name)
}

/// 0 below `low`, 1 above `high`, smooth between.
fn step(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::environment::Environment;

    #[test]
    fn maps_have_radiances_and_names_of_their_own() {
        let mut names: Vec<&str> = entries().iter().map(|e| e.card.name).collect();
        for entry in entries() {
            let radiance = (entry.build)(&Values::defaults(entry.parameters));
            let environment = Environment::of(&*radiance, 64, 0.0, 1.0);
            // As bright as a grey card to a few suns of irradiance 1.
            let mean = environment.mean();
            assert!((0.02..=1.0001).contains(&mean), "{}: {mean}", entry.card.name);
        }
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), entries().len());
    }

    #[test]
    fn the_moons_disc_gives_the_irradiance_it_is_said_to() {
        let entry = find("moon").unwrap();
        let mut values = Values::defaults(entry.parameters);
        values.set("glow", crate::parameter::Value::Number(0.0));
        let moon = Environment::of(&*(entry.build)(&values), 512, 0.0, 1.0);
        // ∫ L dω = E for a small disc seen head on.
        let flux = moon.mean() * 4.0 * std::f64::consts::PI;
        assert!((flux - 1.0).abs() < 0.01, "{flux}");
    }
}
