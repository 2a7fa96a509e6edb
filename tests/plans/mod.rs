//! Plans: the plan language, designators, whole plans.

mod designators;
mod exercises;
mod language;
pub(crate) mod overlaps;
mod packages;
pub(crate) mod prompt;
mod properties;
mod tasks;
mod types;
mod whole_plan;
