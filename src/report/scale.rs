//! Scales: how many texels a pixel covers, with scenes that differ by rounding alone put together.

use super::phrase;
use crate::experiment::results::SceneKey;

/// Scenes are of one scale if none covers this many times more texels a pixel than another: a
/// surface that fits whole tiles meets a wish only nearly.
const SAME: f64 = 1.1;

/// Scenes of one scale, at most one a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// `4 texels a pixel`, or `about 4 texels a pixel` if scenes differ.
    pub label: String,
    /// The places of its scenes in the list that was sorted.
    pub members: Vec<usize>,
}

/// Sorts scenes into scales, from fine to coarse.
pub fn scales(keys: &[&SceneKey]) -> Vec<Scale> {
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|a, b| keys[*a].texels_per_pixel.total_cmp(&keys[*b].texels_per_pixel));
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for i in order {
        match groups.last_mut().filter(|group| belongs(keys, group, i)) {
            Some(group) => group.push(i),
            None => groups.push(vec![i]),
        }
    }
    groups.into_iter().map(|members| Scale { label: label(keys, &members), members }).collect()
}

fn belongs(keys: &[&SceneKey], group: &[usize], i: usize) -> bool {
    let finest = keys[group[0]].texels_per_pixel;
    let near = keys[i].texels_per_pixel <= SAME * finest;
    near && group.iter().all(|&j| keys[j].texture != keys[i].texture)
}

fn label(keys: &[&SceneKey], members: &[usize]) -> String {
    let finest = keys[members[0]].texels_per_pixel;
    let coarsest = keys[members[members.len() - 1]].texels_per_pixel;
    let (low, high) = (phrase::scale(finest), phrase::scale(coarsest));
    if low == high {
        return texels(finest);
    }
    format!("about {}", texels((finest * coarsest).sqrt()))
}

/// `4 texels a pixel`.
pub fn texels(count: f64) -> String {
    if !count.is_finite() {
        return "an unknown number of texels a pixel".into();
    }
    let count = phrase::scale(count);
    let noun = if count == "1" { "texel" } else { "texels" };
    format!("{count} {noun} a pixel")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn labels(values: &[(&str, f64)]) -> Vec<String> {
        let first = fixture::results().scenes.remove(0).key;
        let key = |(texture, texels): &(&str, f64)| SceneKey {
            texture: (*texture).into(),
            texels_per_pixel: *texels,
            ..first.clone()
        };
        let keys: Vec<_> = values.iter().map(key).collect();
        scales(&keys.iter().collect::<Vec<_>>()).into_iter().map(|s| s.label).collect()
    }

    #[test]
    fn rounding_does_not_split_a_scale_but_a_sweep_does() {
        assert_eq!(
            labels(&[("a", 16.2), ("b", 15.8), ("a", 1.0), ("b", 1.0)]),
            ["1 texel a pixel", "about 16 texels a pixel"]
        );
        assert_eq!(labels(&[("a", 4.0), ("a", 4.1)]), ["4 texels a pixel", "4.1 texels a pixel"]);
    }

    #[test]
    fn an_unknown_scale_has_a_name() {
        assert_eq!(labels(&[("a", f64::NAN)]), ["an unknown number of texels a pixel"]);
    }
}
