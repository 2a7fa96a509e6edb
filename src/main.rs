//! The program `planwright`.

use std::process::ExitCode;

fn main() -> ExitCode {
    planwright::main()
}
