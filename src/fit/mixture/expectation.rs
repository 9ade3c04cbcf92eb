//! Expectation-maximisation where the data are lobes.

use super::cloud::{Cloud, LANES, total};
use super::fisher::Fisher;
use crate::fit::mixture::bins::Resultant;
use crate::geometry::elementary::{exp64, ln64};
use crate::geometry::{Kernel, Vec3, vectorised};

/// How many samples each lobe counts as when it is assigned (N of Vasconcelos and Lippman 1998): the
/// more, the harder the assignment.
const SAMPLES: f64 = 2.0;

/// The most components.
const MOST: usize = 16;

/// One round: each lobe of the cloud is shared between the components by their expected likelihoods,
/// and each component takes the vector and total moments of its share. `s` is the base exponent.
///
/// With n the component's exponent and R = (s+1)/(s+2) the mean resultant length of a base lobe about v, its
/// expected log-likelihood is ln (n+1)/2π + n(R d·v − 1), a Phong peak taken as of the von Mises-Fisher
/// family.
pub(super) fn round(components: &mut [Fisher], cloud: &Cloud, s: f64) {
    let count = components.len().min(MOST);
    let mut rates = [Rate::default(); MOST];
    for (rate, component) in rates.iter_mut().zip(components.iter()) {
        *rate = Rate::of(component, s);
    }
    let mut sums = [[[0.0; LANES]; 4]; MOST];
    vectorised(Share { cloud, rates: &rates[..count], sums: &mut sums });
    for (component, sums) in components.iter_mut().zip(&sums) {
        let [x, y, z, weight] = sums.map(total);
        let share = Resultant { vector: Vec3::new(x, y, z), weight };
        let strength = share.vector.norm();
        if strength > 0.0 {
            *component = Fisher::new(share.vector / strength, share.exponent(s), strength);
        }
    }
}

/// ln of a component's likelihood for a unit direction v is `base` + `slope`·v.
#[derive(Clone, Copy, Default)]
struct Rate {
    base: f64,
    slope: [f64; 3],
}

impl Rate {
    fn of(component: &Fisher, s: f64) -> Self {
        let (n, length) = (component.exponent(), (s + 1.0) / (s + 2.0));
        let weight = component.strength() * (n + 2.0) / (n + 1.0);
        let log_weight = ln64(weight.max(f64::MIN_POSITIVE));
        Self {
            base: log_weight + SAMPLES * (ln64(n + 1.0) - n),
            slope: (component.direction() * (SAMPLES * n * length)).into(),
        }
    }
}

struct Share<'a> {
    cloud: &'a Cloud,
    rates: &'a [Rate],
    sums: &'a mut [[[f64; LANES]; 4]; MOST],
}

impl Kernel for Share<'_> {
    #[inline(always)]
    #[allow(clippy::needless_range_loop, reason = "lanes run through several arrays at once")]
    fn run(self) {
        let Self { cloud, rates, sums } = self;
        let mut logs = [[0.0; LANES]; MOST];
        for k in 0..cloud.chunks() {
            let [x, y, z] = [0, 1, 2].map(|c| &cloud.natural[c][k]);
            let kappa = &cloud.kappa[k];
            let mut highest = [f64::MIN; LANES];
            for (rate, log) in rates.iter().zip(&mut logs) {
                let [a, b, c] = rate.slope;
                for i in 0..LANES {
                    log[i] = rate.base + (a * x[i] + b * y[i] + c * z[i]) / kappa[i];
                    highest[i] = if log[i] > highest[i] { log[i] } else { highest[i] };
                }
            }
            let mut all = [0.0; LANES];
            for log in &mut logs[..rates.len()] {
                for i in 0..LANES {
                    log[i] = exp64(log[i] - highest[i]);
                    all[i] += log[i];
                }
            }
            for (likelihood, sum) in logs[..rates.len()].iter().zip(sums.iter_mut()) {
                for i in 0..LANES {
                    let share = likelihood[i] / all[i];
                    sum[0][i] += share * cloud.vector[0][k][i];
                    sum[1][i] += share * cloud.vector[1][k][i];
                    sum[2][i] += share * cloud.vector[2][k][i];
                    sum[3][i] += share * cloud.weight[k][i];
                }
            }
        }
    }
}
