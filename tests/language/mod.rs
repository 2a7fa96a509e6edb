//! The language without robots.

mod builtin_robustness;
mod cram_utilities;
mod debugger_and_packages;
mod examples;
mod library;
mod limits;
mod macros;
mod method_combinations;
mod pathnames;
mod pretty_printer;
mod reader_round_trip;
mod redefined_classes;
mod standard;
