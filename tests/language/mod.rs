//! The language without robots.

mod builtin_robustness;
mod cram_utilities;
mod examples;
mod library;
mod limits;
mod method_combinations;
mod pretty_printer;
mod reader_round_trip;
mod standard;
