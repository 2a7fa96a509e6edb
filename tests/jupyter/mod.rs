//! The kernel for notebooks, as clients meet it.

mod adversaries;
mod cells;
mod client;
