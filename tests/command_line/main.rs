//! The program as people start it: the command line, and the prompt in a terminal.
// Figures are told.
#![allow(clippy::print_stdout)]

mod ask;
mod closed;
mod faulty;
mod grade;
#[cfg(unix)]
mod interrupts;
mod json_lines;
mod mcp;
mod mcp_http;
mod outputs;
mod pseudo_terminal;
mod robots;
mod serve;
#[cfg(unix)]
mod swank;
mod sweep;
#[cfg(unix)]
mod terminal;
#[cfg(unix)]
mod text_that_comes_anyhow;
#[cfg(unix)]
mod torture;
mod usage;
