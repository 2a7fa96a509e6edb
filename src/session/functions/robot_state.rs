//! The state of the robot, as occasions and the facts about the robot ask for it.

use nalgebra::Point3;

use crate::simulation::Simulation;
use crate::simulation::motions::side;
use crate::simulation::names::{suggestion, type_keyword};
use cram::designator::names::{name_text, rosify};
use cram::pose::value::pose_stamped;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use robotics::motion::{is_in_picture, neck_positions};
use robotics::robot::{JointId, KinematicTree};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-ROBOT-INTERFACES`.
pub(super) static TABLE: &[Builtin] = builtins![
    joint_position,
    joint_limits,
    arm_positions,
    hand_opening,
    gaze_error,
    grasp_in_hand,
    pose_in_map
];

/// The joint with a name; an error suggests others.
fn joint_named(tree: &KinematicTree, image: &Image, name: &Value) -> Result<JointId> {
    let Some(text) = name_text(image, name) else {
        return Err(Raise::type_error(name, known::STRING));
    };
    let text = &rosify(&text);
    tree.joint_named(text).ok_or_else(|| {
        let names = tree.joints().map(|(_, joint)| joint.name.as_str());
        let near = suggestion(text, names, |n| format!("{n:?}"));
        let end = if near.is_empty() { "." } else { "" };
        Raise::simple(format!("The robot has no joint {text:?}{near}{end}"))
    })
}

/// The position (rad or m) of a joint of the robot, given by its name as a string.
///
/// `(progn (pp-tut:init-projection) (rob-int::joint-position "head_pan_joint"))` => `0.0d0`
#[builtin]
fn joint_position(simulation: &mut Simulation, image: &mut Image, joint: &Value) -> Result<f64> {
    let robot = &simulation.models.robot;
    let joint = joint_named(robot, image, joint)?;
    let joints = &simulation.world.robot_configuration().joints;
    Ok(robot.position(joints, joint))
}

/// The lower and the upper limit (rad or m) of a joint of the robot, as a list; NIL if it has none.
///
/// `(rob-int::joint-limits "torso_lift_joint")` => `(0.0d0 0.33d0)`
#[builtin]
fn joint_limits(
    simulation: &mut Simulation,
    image: &mut Image,
    joint: &Value,
) -> Result<Option<Value>> {
    let robot = &simulation.models.robot;
    let limits = robot.joint(joint_named(robot, image, joint)?).limits;
    Ok(limits.map(|limits| Value::list([limits.lower, limits.upper].map(Value::Double))))
}

/// The positions (rad) of the seven joints of an arm, from the shoulder to the wrist.
///
/// `(length (rob-int::arm-positions :left))` => `7`
#[builtin]
fn arm_positions(simulation: &mut Simulation, image: &mut Image, arm: &Value) -> Result<Value> {
    let side = side(image, arm)?;
    let joints = &simulation.world.robot_configuration().joints;
    let positions = simulation.models.description.arm(side).positions(joints);
    Ok(Value::list(positions.iter().map(|q| Value::Double(*q))))
}

/// How far a hand is open (m), as SETTING-GRIPPER counts it, and how far it can be opened.
///
/// `(progn (pp-tut:init-projection) (< (rob-int::hand-opening :left) 0.01))` => `T`
#[builtin]
fn hand_opening(simulation: &mut Simulation, image: &mut Image, arm: &Value) -> Result<(f64, f64)> {
    let side = side(image, arm)?;
    let gripper = &simulation.models.description.arm(side).gripper;
    let now = simulation
        .world
        .robot_configuration()
        .joints
        .get(gripper.joint);
    Ok((
        gripper.opening_at(now),
        gripper.opening_at(gripper.limits.upper),
    ))
}

/// By how much (rad) the head would have to turn, in the joint that turns farther, to look at a pose.
///
/// `(progn (pp-tut:init-projection) (< (rob-int::gaze-error '((5 0 1.2) (0 0 0 1))) 0.1))` => `T`
#[builtin]
fn gaze_error(simulation: &mut Simulation, image: &mut Image, pose: &Value) -> Result<f64> {
    let target = simulation.pose_in_map(image, pose)?;
    let target = Point3::from(target.translation.vector);
    let neck = &simulation.models.description.neck;
    if neck.joints.is_empty() && !is_in_picture(&simulation.world, &target) {
        return Ok(std::f64::consts::PI);
    }
    let wanted = neck_positions(&simulation.world, &target);
    let joints = &simulation.world.robot_configuration().joints;
    let now = neck.joints.iter().map(|joint| joints.get(*joint));
    let errors = wanted
        .iter()
        .zip(now)
        .map(|(wanted, now)| (wanted - now).abs());
    Ok(errors.fold(0.0, f64::max))
}

/// The grasp by which an object was picked up, if a hand holds it and that is known.
#[builtin]
fn grasp_in_hand(
    simulation: &mut Simulation,
    image: &mut Image,
    name: &Value,
) -> Result<Option<Value>> {
    let name = simulation.object_named(image, name)?;
    let grasp = simulation
        .held
        .get(&name)
        .and_then(|held| held.grasp.as_ref())
        .filter(|_| simulation.hand_of(&name).is_some());
    Ok(grasp.map(|grasp| type_keyword(image, grasp)))
}

/// A pose in any frame, or in none, as a pose in the map frame.
///
/// `(progn (pp-tut:init-projection) (rob-int::pose-in-map (cl-tf:make-pose-stamped "base_footprint" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation))))` => `#<"map" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>`
#[builtin]
fn pose_in_map(simulation: &mut Simulation, image: &mut Image, pose: &Value) -> Result<Value> {
    let pose = Simulation::location_pose(image, pose).unwrap_or_else(|_| pose.clone());
    Ok(pose_stamped("map", &simulation.pose_in_map(image, &pose)?))
}
