//! Measured distributions as text: a direction and a value a line.

use super::{Directions, Distribution};
use crate::geometry::Vec3;

/// The columns of a line.
const COLUMNS: [&str; 4] = ["x", "y", "z", "value"];
/// Unknowns of a peak: amplitude, direction and exponent.
const UNKNOWNS: usize = 4;
/// As much of a wrong word as is shown.
const SHOWN: usize = 24;

/// A distribution where it was measured.
#[derive(Clone, Debug)]
pub struct Samples {
    /// The directions, brought to unit length, in the order of the lines.
    pub directions: Directions,
    /// The values there.
    pub distribution: Distribution,
}

/// Why a text holds no samples that can be fitted. Lines count from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SamplesError {
    /// There is no line with numbers.
    #[error("no samples: give lines of x,y,z,value")]
    Empty,
    /// A line has not four columns.
    #[error("line {line}: give four columns, x,y,z,value, with commas between; it has {got}")]
    Columns {
        /// Which line.
        line: usize,
        /// Columns it has.
        got: usize,
    },
    /// A word is not a number.
    #[error("line {line}: {column} is `{word}`, which is not a number")]
    Number {
        /// Which line.
        line: usize,
        /// Which column.
        column: &'static str,
        /// What stands there.
        word: String,
    },
    /// A number is not finite.
    #[error("line {line}: {column} is {word}: it must be a finite number")]
    NotFinite {
        /// Which line.
        line: usize,
        /// Which column.
        column: &'static str,
        /// What stands there.
        word: String,
    },
    /// A value is below 0.
    #[error("line {line}: the value is {value}: a density is at least 0")]
    Negative {
        /// Which line.
        line: usize,
        /// The value.
        value: f64,
    },
    /// A direction has no length.
    #[error("line {line}: the direction is 0,0,0, which points nowhere")]
    Nowhere {
        /// Which line.
        line: usize,
    },
    /// There are fewer samples than a single peak has unknowns.
    #[error(
        "{got} samples cannot tell the {UNKNOWNS} unknowns of a peak: give at least {UNKNOWNS}"
    )]
    TooFew {
        /// Samples there are.
        got: usize,
    },
    /// Every value is 0.
    #[error("every value is 0: there is nothing to fit")]
    Dark,
}

impl Samples {
    /// Reads lines `x,y,z,value`: a direction of any length in the surface's frame, z along its normal,
    /// and the density there, in any unit. Blank lines and those that begin with `#` are skipped, and so
    /// is a first line without any number: a header.
    ///
    /// # Errors
    /// [`SamplesError`] for the first line that is wrong, or if all together are too few or all 0.
    pub fn parse(text: &str) -> Result<Self, SamplesError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = (1..).zip(text.lines().map(str::trim));
        let mut rows = lines.filter(|(_, l)| !l.is_empty() && !l.starts_with('#')).peekable();
        let is_header = |row: &(usize, &str)| words(row.1).all(|word| word.parse::<f64>().is_err());
        rows.next_if(is_header);
        let (mut vectors, mut values) = (Vec::new(), Vec::new());
        for (line, row) in rows {
            let [x, y, z, value] = numbers(line, row)?;
            let vector = Vec3::new(x, y, z);
            if vector == Vec3::zeros() {
                return Err(SamplesError::Nowhere { line });
            }
            if value < 0.0 {
                return Err(SamplesError::Negative { line, value });
            }
            vectors.push(vector);
            values.push(value);
        }
        Self::new(&vectors, &values)
    }

    /// Vectors that are finite and not zero, and as many finite values of at least 0.
    fn new(vectors: &[Vec3], values: &[f64]) -> Result<Self, SamplesError> {
        match values.len() {
            0 => return Err(SamplesError::Empty),
            got @ 1..UNKNOWNS => return Err(SamplesError::TooFew { got }),
            _ => {}
        }
        let directions = Directions::scattered(vectors).expect("checked line by line");
        let distribution =
            Distribution::from_samples(values, &directions).expect("checked line by line");
        if distribution.maximum() <= 0.0 {
            return Err(SamplesError::Dark);
        }
        Ok(Self { directions, distribution })
    }

    /// Number of samples.
    pub fn count(&self) -> usize {
        self.directions.count()
    }

    /// The most peaks that so many samples can tell: one for four.
    pub fn most_peaks(&self) -> usize {
        self.count() / UNKNOWNS
    }
}

fn words(row: &str) -> impl Iterator<Item = &str> {
    row.split(',').map(str::trim)
}

/// The four numbers of a row.
fn numbers(line: usize, row: &str) -> Result<[f64; 4], SamplesError> {
    let got = words(row).count();
    if got != COLUMNS.len() {
        return Err(SamplesError::Columns { line, got });
    }
    let mut numbers = [0.0; 4];
    for ((number, column), word) in numbers.iter_mut().zip(COLUMNS).zip(words(row)) {
        let shown = || word.chars().take(SHOWN).collect();
        *number = match word.parse::<f64>() {
            Ok(number) if number.is_finite() => number,
            Ok(_) => return Err(SamplesError::NotFinite { line, column, word: shown() }),
            Err(_) => return Err(SamplesError::Number { line, column, word: shown() }),
        };
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOUR: &str = "0,0,1,2\n0.5,0,1,1\n0,0.5,1,1\n-1,0,1,0.5\n";

    #[test]
    fn comments_blank_lines_and_a_header_are_skipped() {
        let plain = Samples::parse(FOUR).unwrap();
        assert_eq!((plain.count(), plain.most_peaks()), (4, 1));
        assert_eq!(plain.distribution.values(), [2.0, 1.0, 1.0, 0.5]);
        assert!((plain.directions.at(3) - Vec3::new(-0.5, 0.0, 0.5).normalize()).norm() < 1e-15);
        let dressed = format!(
            "\u{feff}# measured\r\n\r\n x, y ,z,value\r\n{}  # done\n",
            FOUR.replace('\n', " \r\n\r\n").replace(',', " , ")
        );
        let dressed = Samples::parse(&dressed).unwrap();
        assert_eq!(dressed.distribution.values(), plain.distribution.values());
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let said = |text: &str| Samples::parse(text).unwrap_err().to_string();
        let second = |row: &str| said(&format!("0,0,1,1\n{row}\n{FOUR}"));
        assert!(second("0,0,1").starts_with("line 2: give four columns"));
        assert!(second("1;2;3;4").ends_with("it has 1"));
        assert!(second("0,0,,1").starts_with("line 2: z is ``"));
        assert!(second("0,0,1,abc").starts_with("line 2: value is `abc`, which is not"));
        assert!(second("x,y,z,value").starts_with("line 2: x is `x`"), "a header stands first");
        assert!(second("0,nan,1,1").starts_with("line 2: y is nan"));
        assert!(second("0,0,1,1e999").starts_with("line 2: value is 1e999"));
        assert!(second("0,0,1,-1e-9").starts_with("line 2: the value is -0.000000001"));
        assert!(second("0,-0,0,1").starts_with("line 2: the direction is 0,0,0"));
        for nothing in ["", "\n\n", "# nothing\n", "x,y,z,value\n"] {
            assert!(said(nothing).starts_with("no samples"));
        }
        assert!(said("0,0,1,1\n1,0,0,1\n").starts_with("2 samples cannot tell"));
        assert!(
            said(&FOUR.replace("2\n", "0\n").replace(",1\n", ",0\n").replace("0.5\n", "0\n"))
                .starts_with("every value is 0")
        );
    }

    #[test]
    fn the_range_of_values_is_that_of_numbers() {
        for unit in [1e-300, 1e300] {
            let text: String = FOUR
                .lines()
                .map(|line| {
                    let (direction, value) = line.rsplit_once(',').unwrap();
                    format!("{direction},{:e}\n", value.parse::<f64>().unwrap() * unit)
                })
                .collect();
            let samples = Samples::parse(&text).unwrap();
            assert!((samples.distribution.maximum() / unit - 2.0).abs() < 1e-15);
            assert!((samples.distribution.relative_rms() - (6.25f64 / 16.0).sqrt()).abs() < 1e-15);
        }
    }
}
