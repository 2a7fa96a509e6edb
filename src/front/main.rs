//! The program `planwright`.

use std::alloc::System;
use std::process::ExitCode;

use cap::Cap;

/// Counts the memory in use, for the limit that `--heap` sets.
#[global_allocator]
static HEAP: Cap<System> = Cap::new(System, usize::MAX);

fn main() -> ExitCode {
    planwright::main(|| HEAP.allocated())
}
