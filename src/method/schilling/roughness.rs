//! Slopes, their covariance, and how both are written.

use crate::lobe::vector::{Sym2, at_least, largest_eigenvalue};
use crate::method::storage::{Code, Storage};
use crate::texture::{Moments, NormalMap, Pyramid, Texel};

/// Raw moments [p, p·b, p·b bᵀ] of a slope b with weight p.
#[inline(always)]
pub fn raw_moments(p: f32, x: f32, y: f32) -> [f32; 6] {
    [p, p * x, p * y, p * x * x, p * x * y, p * y * y]
}

/// From averaged raw moments to [p, p·b̄, K].
#[inline(always)]
pub fn central_moments([p, px, py, pxx, pxy, pyy]: [f32; 6]) -> [f32; 6] {
    let per = 1.0 / p.max(f32::MIN_POSITIVE);
    let (x, y) = (px * per, py * per);
    let central = [pxx * per - x * x, pxy * per - x * y, pyy * per - y * y];
    let [a, b, c] = at_least(central, 0.0);
    [p, px, py, a, b, c]
}

/// D of K = D Dᵀ: d₁ = √(a − b²/c), d₂ = b/√c, d₃ = √c (Schilling 1997, *The roughness pyramid*).
/// Since K is a covariance |d₂| is at most √a; holding it there keeps rounding from making much of a
/// direction with next to no variance.
#[inline(always)]
pub fn factor([a, b, c]: Sym2) -> [f32; 3] {
    let (most, d3) = (a.max(0.0).sqrt(), c.max(0.0).sqrt());
    let d2 = (b / d3.max(f32::MIN_POSITIVE)).clamp(-most, most);
    [(a - d2 * d2).max(0.0).sqrt(), d2, d3]
}

/// K = D Dᵀ.
#[inline(always)]
pub fn covariance(d1: f32, d2: f32, d3: f32) -> Sym2 {
    [d1 * d1 + d2 * d2, d2 * d3, d3 * d3]
}

/// σ₁² I: the larger variance of K in every direction.
#[inline(always)]
pub fn widest(k: Sym2) -> Sym2 {
    let widest = largest_eigenvalue(k);
    [widest, 0.0, widest]
}

/// J K Jᵀ with J = c (I − b bᵀ c²/(1 + c)), c = 1/√(1 + |b|²): a slope covariance about slope b in the
/// tangent frame, carried to the frame of the normal (−b, 1). It is the derivative of one frame's
/// slopes by the other's, and takes (1 + |b|²)(I + b bᵀ) to I.
#[inline(always)]
pub fn carried(k: Sym2, x: f32, y: f32) -> Sym2 {
    let c = 1.0 / (1.0 + x * x + y * y).sqrt();
    let pull = c * c / (1.0 + c);
    let j = [c * (1.0 - x * x * pull), -c * x * y * pull, c * (1.0 - y * y * pull)];
    let kj = [
        [k[0] * j[0] + k[1] * j[1], k[0] * j[1] + k[1] * j[2]],
        [k[1] * j[0] + k[2] * j[1], k[1] * j[1] + k[2] * j[2]],
    ];
    [
        j[0] * kj[0][0] + j[1] * kj[1][0],
        j[0] * kj[0][1] + j[1] * kj[1][1],
        j[1] * kj[0][1] + j[2] * kj[1][1],
    ]
}

/// How a cell's numbers are rounded: weight, slopes, and deviations with and without a sign.
#[derive(Clone, Copy, Debug)]
pub struct Codes {
    weight: Code,
    slope: Code,
    signed: Code,
    unsigned: Code,
}

impl Codes {
    /// The codes for a map, their ranges those of what `written` makes of all its cells: [weight, slopes,
    /// d₁, d₂, d₃]. None if numbers are floats.
    pub fn of<M: Moments<6>>(
        storage: Storage,
        map: &NormalMap,
        written: impl Fn([f32; 6]) -> [f32; 6],
        moments: &M,
    ) -> Option<Self> {
        if storage == Storage::Float {
            return None;
        }
        let averages = Pyramid::build(map, Averages(moments));
        let (mut weight, mut slope, mut deviation) = (0f32, 0f32, 0f32);
        for level in 0..averages.level_count() {
            for cell in averages.cells(map, level) {
                let [w, x, y, d1, d2, d3] = written(cell);
                weight = weight.max(w);
                slope = slope.max(x.abs()).max(y.abs());
                deviation = deviation.max(d1).max(d2.abs()).max(d3);
            }
        }
        Some(Self {
            weight: storage.unsigned(weight),
            slope: storage.signed(slope),
            signed: storage.signed(deviation),
            unsigned: storage.unsigned(deviation),
        })
    }

    /// Deviations are never 0.
    pub fn rough(self) -> Self {
        Self { unsigned: self.unsigned.above_zero(), ..self }
    }

    /// What is read of a cell that was written.
    #[inline(always)]
    pub fn round(&self, [w, x, y, d1, d2, d3]: [f32; 6]) -> [f32; 6] {
        [
            self.weight.round(w),
            self.slope.round(x),
            self.slope.round(y),
            self.unsigned.round(d1),
            self.signed.round(d2),
            self.unsigned.round(d3),
        ]
    }
}

/// Averaged moments without a store of their own.
struct Averages<'a, M>(&'a M);

impl<M: Moments<6>> Moments<6> for Averages<'_, M> {
    fn encode(&self, texel: Texel) -> [f32; 6] {
        self.0.encode(texel)
    }
}

/// [p, b̄, …] of [p, p·b̄, …].
#[inline(always)]
pub fn divided([p, px, py, a, b, c]: [f32; 6]) -> [f32; 6] {
    let per = 1.0 / p.max(f32::MIN_POSITIVE);
    [p, px * per, py * per, a, b, c]
}

/// [p, p·b̄, …] of [p, b̄, …].
#[inline(always)]
pub fn multiplied([p, x, y, a, b, c]: [f32; 6]) -> [f32; 6] {
    [p, p * x, p * y, a, b, c]
}
