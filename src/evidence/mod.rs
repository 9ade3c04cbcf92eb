//! Floor 6: evidence. What a paper shows and claims, made and measured again: one folder a paper, one
//! file a figure, table or number of it.
//!
//! An [`Exhibit`] is what a run found for one *row* of a paper: [`Claim`]s, each set beside what was
//! measured with a [`Verdict`] that the run computes, and [`Figure`]s and [`Table`]s as plain data,
//! which the report draws. What varies from run to run (times) is kept apart, in [`Exhibit::timed`].

mod blinn_1978;
mod claim;
mod exhibit;
mod figure;
mod fournier_1992;
mod gather;
mod kautz_2001;
mod olano_north_1997;
mod paper;
mod schilling_1997;
mod table;
mod trials;

pub use claim::{Claim, Quantity, Verdict};
pub use exhibit::{Evidence, Exhibit, Timed};
pub use figure::{
    Axis, Chart, Disc, Drawing, Field, Figure, Images, LobePlot, Panel, Reflection, Series, Sketch,
    Stroke,
};
pub use gather::{Findings, Gathered, gather, gather_share, missing};
pub use paper::{FinishedPart, Halted, Paper, Row, Task, find, keys, papers};
pub use table::{Cell, Table};
use trials::{rmse, trials};
