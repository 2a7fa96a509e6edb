//! Plans: the plan language, designators, whole plans.

mod braking;
mod clutter;
mod cluttered_tables;
mod containers;
mod cook;
mod deliveries;
mod designators;
mod every_type;
mod exercises;
mod grasping;
mod language;
mod location_measurements;
mod locations;
mod noise;
mod occasions;
pub(crate) mod overlaps;
mod packages;
pub(crate) mod prompt;
mod properties;
mod putting_down;
mod refusals;
mod searching;
mod spawning;
mod tasks;
mod transporting;
mod types;
mod whole_plan;
