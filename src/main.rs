//! The command `wrinkle`. Everything is in the library; this only hands over.

use std::process::ExitCode;

fn main() -> ExitCode {
    wrinkle::cli::main()
}
