//! Queries of what the robot could do from a base pose, without moving it.

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use crate::simulation::imagined::Imagined;
use crate::simulation::motions::side;
use crate::simulation::properties::property;
use cram::Reply;
use cram::designator::value::{as_designator, current};
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::typed::keywords;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::{can_stand, plan_drive};
use robotics::world::WorldError;
use spatial::pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-PICK-PLACE-TUTORIAL`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "BASE-POSE-FREE-P",
        "base-pose",
        "Could the robot, with its arms as they are, stand at a pose of its base without touching anything? Does not check whether a path leads there.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:base-pose-free-p '((0 1 0) (0 0 0 1)))) => T",
            "(pp-tut:base-pose-free-p '((-1 1.5 0) (0 0 0 1))) => NIL",
        ],
        host!(base_pose_free),
    ),
    control(
        "BASE-PATH-P",
        "base-pose",
        "Does a path lead the robot's base, with the arms as they are, from where it stands to a pose?",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:base-path-p '((0 1 0) (0 0 0 1)))) => T",
            "(pp-tut:base-path-p '((-1 1.5 0) (0 0 0 1))) => NIL",
        ],
        host!(base_path),
    ),
    control(
        "GRASP-REACHABLE-P",
        "object arm grasp &key object-pose base-pose",
        "Could an arm pick an object up, or put it down, with a grasp: can the hand come to the grasp, and leave it, without touching anything else? From where the robot stands and for where the object is, unless other poses are given.",
        &[
            "(progn (pp-tut:init-projection) (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (pp-tut:grasp-reachable-p 'bottle-1 :right :left-side)) => NIL",
            "(pp-tut:grasp-reachable-p 'bottle-1 :right :left-side :base-pose '((-1.447 -0.15 0) (0 0 -0.7071 0.7071))) => T",
        ],
        host!(grasp_reachable),
    ),
];

fn base_pose_free(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let place = place(simulation, image, &args[0])?;
    done(can_stand(&simulation.world, &place))
}

fn base_path(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let place = place(simulation, image, &args[0])?;
    done(plan_drive(&simulation.world, place).is_ok())
}

/// Where the base is on the floor (m, m, rad) at a pose that is given.
fn place(simulation: &mut Simulation, image: &mut Image, pose: &Value) -> Result<[f64; 3]> {
    let base = simulation.pose_as_given(image, pose)?;
    let t = base.translation;
    Ok([t.x, t.y, pose::yaw(&base)])
}

fn grasp_reachable(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let name = match as_designator(&args[0]) {
        Some(_) => property(image, &current(&args[0]), "NAME").unwrap_or(Value::NIL),
        None => args[0].clone(),
    };
    let name = simulation.object_named(image, &name)?;
    let side = side(image, &args[1])?;
    let keys = [image.keyword("OBJECT-POSE"), image.keyword("BASE-POSE")];
    let [object_pose, base_pose] = keywords::parse(image, &args[3..], keys)?;
    let object_pose = object_pose.filter(Value::is_true);
    let object_pose = object_pose.map(|pose| simulation.pose_in_map(image, &pose));
    let base_pose = base_pose.filter(Value::is_true);
    let base_pose = base_pose.map(|pose| simulation.pose_as_given(image, &pose));
    let raise = |error: WorldError| Raise::reporting(error);
    let kind = simulation.world.object(&name).map_err(raise)?;
    let kind = kind.type_name().to_owned();
    let definition = match simulation.grasp(image, &kind, side, &args[2]) {
        Ok(definition) => definition,
        // With the other arm only.
        Err(_)
            if simulation
                .grasp(image, &kind, side.other(), &args[2])
                .is_ok() =>
        {
            return done(Value::NIL);
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
    done(simulation.lets_grasp(&imagined, &definition)?)
}
