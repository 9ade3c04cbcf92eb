//! Floor 8: a job: one experiment, from its spec to its written report. Both faces of the program, the command line
//! and the terminal runner, do their runs through it.
