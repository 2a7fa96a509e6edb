//! Queries of what the robot could do from a base pose, without moving it.

use crate::simulation::Simulation;
use crate::simulation::imagined::Imagined;
use crate::simulation::motions::side;
use crate::simulation::properties::property;
use cram::designator::value::{as_designator, current};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::{can_stand, plan_drive};
use robotics::world::WorldError;
use spatial::pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-PICK-PLACE-TUTORIAL`.
pub(super) static TABLE: &[Builtin] = builtins![base_pose_free_p, base_path_p, grasp_reachable_p];

/// Could the robot, with its arms as they are, stand at a pose of its base without touching anything? Does
/// not check whether a path leads there.
///
/// `(progn (pp-tut:init-projection) (pp-tut:base-pose-free-p '((0 1 0) (0 0 0 1))))` => `T`
/// `(pp-tut:base-pose-free-p '((-1 1.5 0) (0 0 0 1)))` => `NIL`
#[builtin]
fn base_pose_free_p(
    simulation: &mut Simulation,
    image: &mut Image,
    base_pose: &Value,
) -> Result<bool> {
    let place = place(simulation, image, base_pose)?;
    Ok(can_stand(&simulation.world, &place))
}

/// Does a path lead the robot's base, with the arms as they are, from where it stands to a pose?
///
/// `(progn (pp-tut:init-projection) (pp-tut:base-path-p '((0 1 0) (0 0 0 1))))` => `T`
/// `(pp-tut:base-path-p '((-1 1.5 0) (0 0 0 1)))` => `NIL`
#[builtin]
fn base_path_p(simulation: &mut Simulation, image: &mut Image, base_pose: &Value) -> Result<bool> {
    let place = place(simulation, image, base_pose)?;
    Ok(plan_drive(&simulation.world, place).is_ok())
}

/// Where the base is on the floor (m, m, rad) at a pose that is given.
fn place(simulation: &mut Simulation, image: &mut Image, pose: &Value) -> Result<[f64; 3]> {
    let base = simulation.pose_as_given(image, pose)?;
    let t = base.translation;
    Ok([t.x, t.y, pose::yaw(&base)])
}

/// Could an arm pick an object up, or put it down, with a grasp: can the hand come to the grasp, and leave
/// it, without touching anything else? From where the robot stands and for where the object is, unless other
/// poses are given.
///
/// `(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (pp-tut:grasp-reachable-p 'bottle-1 :right :left-side))` => `NIL`
/// `(pp-tut:grasp-reachable-p 'bottle-1 :right :left-side :base-pose '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))` => `T`
#[builtin]
fn grasp_reachable_p(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    arm: &Value,
    grasp: &Value,
    #[key] object_pose: Option<&Value>,
    #[key] base_pose: Option<&Value>,
) -> Result<bool> {
    let name = match as_designator(object) {
        Some(_) => property(image, &current(object), "NAME").unwrap_or(Value::NIL),
        None => object.clone(),
    };
    let name = simulation.object_named(image, &name)?;
    let side = side(image, arm)?;
    let object_pose = object_pose.filter(|pose| pose.is_true());
    let object_pose = object_pose.map(|pose| simulation.pose_in_map(image, pose));
    let base_pose = base_pose.filter(|pose| pose.is_true());
    let base_pose = base_pose.map(|pose| simulation.pose_as_given(image, pose));
    let raise = |error: WorldError| Raise::reporting(error);
    let kind = simulation.world.object(&name).map_err(raise)?;
    let kind = kind.type_name().to_owned();
    let definition = match simulation.grasp(image, &kind, side, grasp) {
        Ok(definition) => definition,
        // With the other arm only.
        Err(_) if simulation.grasp(image, &kind, side.other(), grasp).is_ok() => {
            return Ok(false);
        }
        Err(unknown) => return Err(unknown),
    };
    let imagined = Imagined {
        object: &name,
        object_pose: object_pose.transpose()?,
        base_pose: base_pose.transpose()?,
        side,
        opening: simulation.grasps.opening(&kind, &definition),
    };
    simulation.lets_grasp(&imagined, &definition)
}
