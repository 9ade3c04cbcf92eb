//! Tests of the pane: what keys and findings do, how it looks, and a run from a key to its report.

mod fixture;
mod keys;
mod looks;
mod runs;
