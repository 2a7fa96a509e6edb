//! Plans: the plan language, designators, whole plans.

mod arm_on_table;
mod braking;
mod chores;
mod clutter;
mod cluttered_tables;
mod container_measurements;
mod containers;
mod cook;
mod definitions;
mod deliveries;
mod demos;
mod designators;
mod every_type;
mod exercises;
mod fetch;
mod generated_kitchens;
mod grasping;
mod hsr;
mod kinds_of_worlds;
mod knobs;
mod lessons;
mod location_measurements;
mod location_solutions;
mod locations;
mod noise;
mod object_types;
mod occasions;
mod other_kitchens;
mod out_of_containers;
pub(crate) mod overlaps;
mod packages;
mod parking;
mod past;
mod published_code;
mod published_kitchens;
mod putting_down;
mod quick_answers;
mod random_scenes;
mod rays;
mod real_robot;
mod refusals;
mod renamed_robot;
mod salting;
mod searching;
mod session_copies;
mod spawning;
mod speeds;
mod strange_kitchens;
mod surface_chores;
mod surfaces;
mod sweeps;
mod systems;
mod things_on_things;
mod trace;
mod transporting;
mod turtle;
mod two_hands;
mod types;
mod upright;
mod whole_plan;

use session::Session;
use session::dialogue::{Evaluate, Event};

/// What a text prints and returns, or the report of what ended it.
fn said_and_printed(session: &mut Session, text: &str) -> String {
    let mut said = String::new();
    session.evaluate("test", text, &mut |event| match event {
        Event::Output(text) => said.push_str(&text),
        Event::Values(values) => said.push_str(&values.join(" ; ")),
        Event::Aborted(abort) => said.push_str(&abort.report),
        _ => {}
    });
    said
}

/// The last value of a text, or the report of what went wrong.
fn said(session: &mut Session, text: &str) -> String {
    let mut said = String::new();
    session.evaluate("test", text, &mut |event| match event {
        Event::Values(values) => said = values.join(" ; "),
        Event::Aborted(abort) => said = abort.report,
        _ => {}
    });
    said
}
