//! Other robots than the one with which a session began.

use crate::host::SimulationHost;
use crate::simulation::names::name_text;
use closest_name::closest_name;
use descriptions::{ROBOTS, robot_named};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;
use robotics::robot::{KinematicTree, RobotDescription};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![list_robots, use_robot];

/// The robots that come with planwright, the usual one first.
///
/// `(list-robots)` => `(:PR2 :FETCH :HSR)`
#[builtin]
fn list_robots(image: &mut Image) -> Vec<Sym> {
    let names = ROBOTS.iter().map(|robot| robot.name.to_uppercase());
    names.map(|name| image.keyword(&name)).collect()
}

/// Puts another robot into the kitchen, at its start and without objects: :PR2, :FETCH or :HSR. Returns its
/// name. Robots of one's own are given when planwright starts, by --robot.
///
/// `(use-robot :fetch)` => `:FETCH`
/// `(use-robot :pr2)` => `:PR2`
#[builtin(edit)]
fn use_robot(host: &mut SimulationHost, image: &mut Image, robot: &Value) -> Result<Sym> {
    let named = name_text(image, robot);
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
                print::to_string(image, robot, true),
                near.to_uppercase()
            )));
        }
        return Err(Raise::simple(format!(
            "{} is no robot that planwright has: it has {}. Others are given by --robot when it starts.",
            print::to_string(image, robot, true),
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
    Ok(image.keyword(&robot.name.to_uppercase()))
}
