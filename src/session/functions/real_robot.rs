//! Plans that drive a robot elsewhere.

use crate::host::call::{done, edit, host};
use crate::simulation::Simulation;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-PR2-PROCESS-MODULES`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%BEGIN-REAL-ROBOT",
        "",
        "From now on, motions are those of the robot that planwright was started with by --real-robot, until %END-REAL-ROBOT.",
        &[],
        edit!(begin),
    ),
    control(
        "%END-REAL-ROBOT",
        "",
        "Motions are those of the simulated robot again, if this ends the outermost %BEGIN-REAL-ROBOT.",
        &["(pr2-pms::%end-real-robot) => NIL"],
        host!(end),
    ),
    control(
        "%SET-PROSPECTION",
        "is-tried",
        "Whether each motion of the robot is tried before its goals are sent, also where the robot itself finds the way. Returns how it was.",
        &["(pr2-pms::%set-prospection t) => T"],
        host!(set_prospection),
    ),
];

fn set_prospection(simulation: &mut Simulation, _: &mut Image, args: &[Value]) -> Result<Reply> {
    let is_tried = args.first().is_some_and(|value| !value.is_nil());
    done(Value::bool(simulation.set_prospection(is_tried)))
}

fn begin(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    simulation.drive_robot()?;
    done(Value::T)
}

fn end(simulation: &mut Simulation, _: &mut Image, _: &[Value]) -> Result<Reply> {
    simulation.leave_robot();
    done(Value::NIL)
}
