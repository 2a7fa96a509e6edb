//! The plans that come with planwright, as texts.

/// Name and text of files of `plans/lib`.
macro_rules! library {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("lib/", $name)))),*]
    };
}

/// The files, in the order in which they are loaded.
pub const LIBRARY: &[(&str, &str)] = library![
    "cram-packages.plan",
    "log.plan",
    "cram-switches.plan",
    "cram-transforms.plan",
    "robot.plan",
    "events.plan",
    "occasions.plan",
    "urdf.plan",
    "world-objects.plan",
    "attaching.plan",
    "seeing.plan",
    "world-utilities.plan",
    "questions.plan",
    "contact-facts.plan",
    "sight-facts.plan",
    "world-facts.plan",
    "trace-facts.plan",
    "past.plan",
    "episodes.plan",
    "run-facts.plan",
    "ros.plan",
    "turtle.plan",
    "retrying.plan",
    "locations.plan",
    "costmap-facts.plan",
    "manipulation-data.plan",
    "object-types.plan",
    "noise.plan",
    "sweep-draws.plan",
    "sweep-predicates.plan",
    "sweeps.plan",
    "lessons.plan",
    "overview.plan",
    "going.plan",
    "perceiving.plan",
    "gripper.plan",
    "arms.plan",
    "hand-ways.plan",
    "picking-up.plan",
    "placing.plan",
    "containers.plan",
    "navigating.plan",
    "attempts.plan",
    "household.plan",
    "accessing.plan",
    "two-hands.plan",
    "searching.plan",
    "fetching.plan",
    "fetching-for-target.plan",
    "delivering.plan",
    "transporting.plan",
    "pointing.plan",
    "vessels.plan",
    "pouring.plan",
    "surface-paths.plan",
    "wiping.plan",
    "slicing.plan",
    "mixing.plan",
    "salting.plan",
    "turning-knob.plan",
    "handing-over.plan",
    "holding.plan",
    "projection-motions.plan",
    "real-robot.plan",
    "tutorial-package.plan",
    "lisp-unit.plan",
    "cram-refused.plan",
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

/// Name and text of files of other folders below `plans`.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$((concat!("plans/", $name), include_str!($name))),*]
    };
}

/// Name and text of what the tutorial and its exercises load.
pub const TUTORIAL: &[(&str, &str)] = files![
    "tutorial/changing-grasp.plan",
    "tutorial/going.plan",
    "tutorial/looking-around.plan",
    "tutorial/move-bottle.plan",
    "tutorial/new-grasp.plan",
    "tutorial/picking-up.plan",
    "tutorial/pictures.plan",
    "tutorial/skills.plan",
    "tutorial/transport.plan",
    "exercises/1.plan",
    "exercises/1b.plan",
    "exercises/2.plan",
    "exercises/3.plan",
    "exercises/4.plan",
    "exercises/5.plan",
    "exercises/6.plan",
    "exercises/7.plan",
    "exercises/8.plan",
    "exercises/9.plan",
    "sweeps/changing-grasp.plan",
    "sweeps/move-bottle.plan",
    "sweeps/transporting.plan",
];

/// Name and text of the lessons' files.
pub const LESSONS: &[(&str, &str)] = files![
    "lessons/tour.lesson",
    "lessons/prompt.lesson",
    "lessons/driving.lesson",
    "lessons/objects.lesson",
    "lessons/at-once.lesson",
    "lessons/seeing.lesson",
    "lessons/picking-up.lesson",
    "lessons/putting-down.lesson",
    "lessons/plan.lesson",
    "lessons/failures.lesson",
    "lessons/look-elsewhere.lesson",
    "lessons/other-grasps.lesson",
    "lessons/coordinates.lesson",
    "lessons/own-grasp.lesson",
    "lessons/thinking.lesson",
    "lessons/saying-where.lesson",
    "lessons/transporting.lesson",
    "lessons/drawers.lesson",
    "lessons/breakfast.lesson",
    "lessons/how-often.lesson",
    "lessons/bring-the-bottle.lesson",
    "lessons/search-places.lesson",
    "lessons/where-to-stand.lesson",
    "lessons/better-arm.lesson",
    "lessons/see-more.lesson",
    "lessons/look-again.lesson",
    "lessons/from-the-top.lesson",
    "lessons/regrasp.lesson",
    "lessons/no-coordinates.lesson",
    "lessons/own-rule.lesson",
    "lessons/clear-table.lesson",
    "lessons/own-context.lesson",
];

/// The names of the lessons, in the order in which they are best learned.
pub fn lesson_names() -> impl Iterator<Item = &'static str> {
    let files = LESSONS
        .iter()
        .filter_map(|(file, _)| file.rsplit('/').next());
    files.filter_map(|file| file.strip_suffix(".lesson"))
}

/// The title of a lesson.
pub fn lesson_title(name: &str) -> Option<&'static str> {
    let file = format!("plans/lessons/{name}.lesson");
    let (_, text) = LESSONS.iter().find(|(known, _)| *known == file)?;
    let (_, rest) = text.split_once("(title \"")?;
    rest.split('"').next()
}

/// The text of a file that programs may load by its name, such as `plans/tutorial/skills.plan`,
/// though there is no such file.
pub fn text_of(name: &str) -> Option<&'static str> {
    let mut files = TUTORIAL.iter().chain(DEMOS).chain(LESSONS);
    files.find(|(file, _)| *file == name).map(|(_, text)| *text)
}
