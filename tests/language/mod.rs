//! The language without robots.

mod builtin_robustness;
mod examples;
mod library;
mod limits;
mod reader_round_trip;
mod standard;
