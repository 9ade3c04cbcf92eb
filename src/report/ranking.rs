//! The tables of the answer: which filter to choose, how each did over all scenes, and what
//! normalising is worth.

use super::answer::{gains, wins, worth};
use super::caveats::printed_over_normalised;
use super::choice::choices;
use super::contest::{Comparison, Contest, Setting, family, geometric_mean, median};
use super::phrase::{self, list};
use super::source::{self, Source};
use super::tables::{Cell, Table, dagger, label};
use crate::experiment::results::{Costs, MethodInfo};

/// What to choose at each scale of a setting. `None` without brute force to compare with.
pub fn choice(comparison: &Comparison, setting: &Setting) -> Option<Table> {
    let brute = &comparison.brute_force()?.label;
    let found = choices(comparison, setting);
    let rows = found.iter().filter(|c| !c.candidates.is_empty()).map(|c| {
        let best = &c.candidates[0];
        let pays = best.left < 1.0;
        let next = c.candidates.get(1).map_or_else(Cell::default, |next| Cell {
            aside: phrase::percent(next.left),
            ..label(next.method).into()
        });
        let unhelped = if c.unhelped.is_empty() { "none".into() } else { list(&c.unhelped) };
        vec![
            c.scale.as_str().into(),
            Cell { best: pays, ..label(best.method).into() },
            Cell::from(phrase::percent(best.left)).of_rows(source::ratio(
                at_scale(setting, &c.scale),
                &best.method.label,
                brute,
            )),
            Cell::from(best.relative.map_or_else(String::new, phrase::percent)).of_rows(
                at_scale(setting, &c.scale)
                    .flat_map(|s| source::relative(s.scene, &best.method.label)),
            ),
            Cell::from(best.worth.map_or_else(String::new, phrase::samples_short)).of_rows(
                at_scale(setting, &c.scale)
                    .flat_map(|s| source::worth(comparison.results, s.scene, &best.method.label)),
            ),
            next,
            unhelped.into(),
        ]
    });
    let head = [
        "Scale".to_owned(),
        "Closest filter over all textures".into(),
        format!("RMSE left, of {brute}’s"),
        "RMSE, of mean radiance".into(),
        format!("Worth, {brute} samples a pixel"),
        "Next".into(),
        "No filter helps on".into(),
    ];
    let notes = vec![format!(
        "RMSE left: the filter’s RMSE over that of {brute} at the same samples a pixel, geometric mean over textures. \
         Of mean radiance: RMSE over the mean radiance of the reference, median. Worth: the {brute} samples a pixel \
         that reach the same RMSE, median. Bold: it pays to filter."
    )];
    let rows: Vec<_> = rows.collect();
    let title = "Which filter to choose".into();
    (!rows.is_empty()).then(|| Table { title, head: head.to_vec(), rows, notes })
}

/// The contests at the scale of this label.
fn at_scale<'a>(setting: &'a Setting<'a>, label: &'a str) -> impl Iterator<Item = &'a Contest<'a>> {
    let scale = setting.scales.iter().filter(move |scale| scale.label == label);
    scale.flat_map(|scale| setting.at(scale))
}

/// How each method did over all scenes, and the memory it needs.
pub fn ranking(comparison: &Comparison, costs: &Costs) -> Table {
    let brute = comparison.brute_force();
    let mut head = ["Method", "Scenes", "Closest alone", "Tied"].map(str::to_owned).to_vec();
    if let Some(brute) = brute {
        head.push(format!("RMSE left, of {}’s", brute.label));
        head.push(format!("Farther off than {}", brute.label));
        head.push(format!("Worth, {} samples a pixel", brute.label));
    }
    head.extend(["RMSE, of mean radiance".into(), "Bytes a texel".into()]);
    let best = comparison.results.methods.iter().map(|m| wins(comparison, &m.label)).max();
    let rows = comparison.results.methods.iter().map(|method| {
        let (alone, tied) = wins(comparison, &method.label);
        let scenes = comparison.contests().filter(|c| c.standing(&method.label).is_some()).count();
        let mut row = vec![
            Cell::from(label(method)),
            scenes.to_string().into(),
            Cell { best: Some((alone, tied)) == best, ..alone.to_string().into() },
            tied.to_string().into(),
        ];
        if let Some(brute) = brute {
            row.extend(against(comparison, &method.label, &brute.label));
        }
        row.push(relative(comparison, &method.label));
        row.push(memory(costs, &method.label));
        row
    });
    let note = "RMSE left: geometric mean over scenes. Worth: how many samples a pixel reach the same RMSE without a \
                filter, median (least … greatest). Of mean radiance: median. Bytes a texel: held beside the normal \
                map, median over maps; what methods cost in time is in costs.md.";
    Table {
        title: "All scenes".into(),
        head,
        rows: rows.collect(),
        notes: std::iter::once(note.to_owned())
            .chain(dagger(&comparison.results.methods))
            .collect(),
    }
}

/// A method's error against brute force's: what is left, how often it is more, what it is worth.
fn against(comparison: &Comparison, label: &str, brute: &str) -> [Cell; 3] {
    let ratios = gains(comparison, brute, label);
    let left = geometric_mean(ratios.iter().copied());
    let farther = ratios.iter().filter(|r| **r > 1.0).count();
    let worth = worth(comparison, label).map(|(middle, low, high)| Cell {
        text: phrase::samples_short(middle),
        aside: format!("{} … {}", phrase::samples_short(low), phrase::samples_short(high)),
        ..Cell::default()
    });
    if label == brute || ratios.is_empty() {
        return Default::default();
    }
    let left = left.map_or_else(Cell::default, |left| phrase::percent(left).into());
    let rows = source::ratio(comparison.contests(), label, brute);
    let curves = comparison.contests();
    let curves = curves.flat_map(|c| source::worth(comparison.results, c.scene, label));
    [
        left.of_rows(rows.clone()),
        Cell::from(format!("{farther} of {}", ratios.len())).of_rows(rows),
        worth.unwrap_or_default().of_rows(curves),
    ]
}

fn relative(comparison: &Comparison, label: &str) -> Cell {
    let of = |c: &Contest| c.relative(c.standing(label)?.error);
    let found: Vec<f64> = comparison.contests().filter_map(of).collect();
    let took_part = comparison.contests().filter(|c| c.standing(label).is_some());
    let middle = median(found, |v| v).map_or_else(Cell::default, |v| phrase::percent(v).into());
    middle.of_rows(took_part.flat_map(|c| source::relative(c.scene, label)))
}

/// Memory is part of the report, times are not: it is the same in every run.
fn memory(costs: &Costs, label: &str) -> Cell {
    let of = costs.prefilters.iter().filter(|p| p.method == label);
    let found = median(of.map(|p| p.bytes_per_texel).collect(), |v| v);
    found.map_or_else(Cell::default, |v| phrase::scale(v).into())
}

/// Printed forms beside their normalised ones, if the experiment has both.
pub fn normalising(comparison: &Comparison) -> Option<Table> {
    let methods = &comparison.results.methods;
    let form = |printed: &'_ MethodInfo| {
        let same = |m: &&MethodInfo| m.normalised && family(m) == family(printed);
        methods.iter().find(same).map(|normalised| (printed.clone(), normalised))
    };
    let row = |(printed, normalised): (MethodInfo, &MethodInfo)| {
        let shared = gains(comparison, &normalised.label, &printed.label).len();
        let ratio = printed_over_normalised(comparison, &printed.label, &normalised.label)?;
        Some(vec![
            normalised.label.as_str().into(),
            printed.label.as_str().into(),
            Cell::from(phrase::times(ratio)).of_rows(source::ratio(
                comparison.contests(),
                &printed.label,
                &normalised.label,
            )),
            energy(comparison, &printed.label, &normalised.label),
            energy(comparison, &normalised.label, &printed.label),
            shared.to_string().into(),
        ])
    };
    let printed = methods.iter().filter(|m| !m.normalised);
    let rows: Vec<_> = printed.filter_map(form).filter_map(row).collect();
    let head = [
        "Normalised form",
        "Printed form",
        "RMSE, printed ÷ normalised",
        "Energy, printed",
        "Energy, normalised",
        "Scenes",
    ];
    (!rows.is_empty()).then(|| Table {
        title: "What normalising is worth".into(),
        head: head.map(str::to_owned).to_vec(),
        rows,
        notes: vec![
            "RMSE: geometric mean over the scenes that have both. Energy: the share of the reference’s light that the \
             image holds, median over the same scenes; 1 is right."
                .into(),
        ],
    })
}

/// A method's median energy over the scenes where `other` was measured too.
fn energy(comparison: &Comparison, label: &str, other: &str) -> Cell {
    let both = |c: &&Contest| c.standing(label).is_some() && c.standing(other).is_some();
    let spp = comparison.spp;
    let value = |c: &Contest| {
        let trial = c.scene.trials.iter().find(|t| t.method == label && t.spp == spp)?;
        Some((trial.score("energy")?, Source::of(c.scene, label, Some(spp), "energy")))
    };
    let (found, rows): (Vec<f64>, Vec<Source>) =
        comparison.contests().filter(both).filter_map(value).unzip();
    let middle = median(found, |v| v).map_or_else(Cell::default, |v| phrase::number(v).into());
    middle.of_rows(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn every_row_is_as_long_as_the_head() {
        let results = fixture::results();
        let comparison = Comparison::of(&results);
        let tables = [
            ranking(&comparison, &fixture::costs()),
            choice(&comparison, &comparison.settings[0]).unwrap(),
            normalising(&comparison).unwrap(),
        ];
        for table in tables {
            assert!(table.rows.iter().all(|row| row.len() == table.head.len()), "{}", table.title);
        }
    }

    #[test]
    fn a_printed_form_is_set_against_the_normalised_one() {
        let results = fixture::results();
        let table = normalising(&Comparison::of(&results)).unwrap();
        let texts: Vec<_> = table.rows[0].iter().map(|cell| cell.text.as_str()).collect();
        assert_eq!(texts[..2], ["schilling", "schilling-printed"]);
        assert!(texts[2].parse::<f64>().unwrap() > 1.0, "{texts:?}");
    }

    #[test]
    fn without_brute_force_there_is_nothing_to_choose_by() {
        let mut results = fixture::results();
        results.methods.retain(|m| m.name != "unfiltered");
        let comparison = Comparison::of(&results);
        assert!(choice(&comparison, &comparison.settings[0]).is_none());
        let table = ranking(&comparison, &Costs::default());
        assert!(table.rows.iter().all(|row| row.len() == table.head.len()));
    }
}
