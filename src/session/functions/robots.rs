//! Other robots than the one with which a session began.

use crate::host::SimulationHost;
use crate::host::call::{done, edit};
use crate::simulation::names::name_text;
use closest_name::closest_name;
use cram::Reply;
use descriptions::{ROBOTS, robot_named};
use lisp::builtin::{Builtin, control, pure};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::robot::{KinematicTree, RobotDescription};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[
    pure(
        "LIST-ROBOTS",
        "",
        "The robots that come with planwright, the usual one first.",
        &["(list-robots) => (:PR2 :FETCH :HSR)"],
        list_robots,
    ),
    control(
        "USE-ROBOT",
        "robot",
        "Puts another robot into the kitchen, at its start and without objects: :PR2, :FETCH or :HSR. Returns its name. Robots of one's own are given when planwright starts, by --robot.",
        &["(use-robot :fetch) => :FETCH", "(use-robot :pr2) => :PR2"],
        edit!(use_robot),
    ),
];

fn list_robots(image: &mut Image, _: &[Value]) -> Result<Value> {
    let names: Vec<Value> = ROBOTS
        .iter()
        .map(|robot| image.keyword(&robot.name.to_uppercase()).into())
        .collect();
    Ok(Value::list(names))
}

fn use_robot(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let named = name_text(image, &args[0]);
    let Some(robot) = named.as_deref().and_then(robot_named) else {
        let names = ROBOTS
            .iter()
            .map(|robot| format!(":{}", robot.name.to_uppercase()))
            .collect::<Vec<_>>();
        let wanted = named.unwrap_or_default();
        let near = closest_name(&wanted, ROBOTS.iter().map(|robot| robot.name));
        if let Some(near) = near {
            return Err(Raise::simple(format!(
                "{} is no robot that planwright has; did you mean :{}?",
                print::to_string(image, &args[0], true),
                near.to_uppercase()
            )));
        }
        return Err(Raise::simple(format!(
            "{} is no robot that planwright has: it has {}. Others are given by --robot when it starts.",
            print::to_string(image, &args[0], true),
            names.join(", ")
        )));
    };
    if host.audience.shows_kitchen() {
        return Err(Raise::simple(format!(
            "The live view and recordings show one robot: end them, or start planwright with --robot {}.",
            robot.name
        )));
    }
    let simulation = &mut host.simulation;
    if !simulation.jobs.is_idle() {
        return Err(Raise::simple(
            "The robot moves: stop it before another one takes its place.",
        ));
    }
    let file = |ending: &str| format!("{}.{ending}", robot.name);
    let tree = KinematicTree::built_in(robot.urdf, &file("urdf")).map_err(Raise::reporting)?;
    let description = RobotDescription::from_sexp(robot.description, &file("sexp"), &tree)
        .map_err(Raise::reporting)?;
    let models = simulation.models.with_robot(tree, description);
    simulation.begin_with(&models);
    done(Value::from(image.keyword(&robot.name.to_uppercase())))
}
