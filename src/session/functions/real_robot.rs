//! Plans that drive a robot elsewhere.

use crate::simulation::Simulation;
use lisp::builtin::Builtin;
use lisp::typed::{self, builtin, builtins};
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-PR2-PROCESS-MODULES`.
pub(super) static TABLE: &[Builtin] = builtins![begin, end, set_prospection];

/// Whether each motion of the robot is tried before its goals are sent, also where the robot itself finds the
/// way. Returns how it was.
///
/// `(pr2-pms::%set-prospection t)` => `T`
#[builtin("%SET-PROSPECTION")]
fn set_prospection(simulation: &mut Simulation, is_tried: bool) -> bool {
    simulation.set_prospection(is_tried)
}

/// From now on, motions are those of the robot that planwright was started with by --real-robot, until
/// %END-REAL-ROBOT.
#[builtin("%BEGIN-REAL-ROBOT", edit)]
fn begin(simulation: &mut Simulation) -> Result<bool> {
    simulation.drive_robot()?;
    Ok(true)
}

/// Motions are those of the simulated robot again, if this ends the outermost %BEGIN-REAL-ROBOT.
///
/// `(pr2-pms::%end-real-robot)` => `NIL`
#[builtin("%END-REAL-ROBOT")]
fn end(simulation: &mut Simulation) {
    simulation.leave_robot();
}
