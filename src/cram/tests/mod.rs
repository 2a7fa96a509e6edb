//! The plan language without a world.

mod failures;
mod language;
mod prompt;
mod properties;
mod task_outcomes;
mod tasks;
mod trace;
mod waiting_for_fluents;
