//! The plans that come with planwright, as texts.

/// Name and text of files of `plans/lib`.
macro_rules! library {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("lib/", $name)))),*]
    };
}

/// The files, in the order in which they are loaded.
pub const LIBRARY: &[(&str, &str)] = library![
    "log.plan",
    "robot.plan",
    "events.plan",
    "occasions.plan",
    "retrying.plan",
    "locations.plan",
    "noise.plan",
    "sweep-draws.plan",
    "sweep-predicates.plan",
    "sweeps.plan",
    "going.plan",
    "perceiving.plan",
    "gripper.plan",
    "arms.plan",
    "picking-up.plan",
    "placing.plan",
    "containers.plan",
    "navigating.plan",
    "attempts.plan",
    "household.plan",
    "accessing.plan",
    "searching.plan",
    "fetching.plan",
    "delivering.plan",
    "transporting.plan",
    "tutorial-package.plan",
];

/// Name and text of the demos' files, of `plans/demos`.
pub const DEMOS: &[(&str, &str)] = &[
    (
        "plans/demos/pick-place-demo.plan",
        include_str!("demos/pick-place-demo.plan"),
    ),
    (
        "plans/demos/household-demo.plan",
        include_str!("demos/household-demo.plan"),
    ),
];
