//! What every registered method must satisfy, whatever it is: a new line in the registry is tested
//! without a line here. Each file holds one property.
#![allow(clippy::disallowed_methods, reason = "tests compare numbers within tolerances")]

mod base;
mod bumps;
mod energy;
mod environment;
mod fast;
mod fixture;
mod flat;
mod kernels;
mod lookup;
mod magnified;
mod rotation;
mod soundness;
mod surfaces;
