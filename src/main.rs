//! The program `tautline`.

use std::process::ExitCode;

fn main() -> ExitCode {
    tautline::cli::run()
}
