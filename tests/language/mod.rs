//! The language without robots.

mod builtin_robustness;
mod examples;
mod limits;
mod reader_round_trip;
