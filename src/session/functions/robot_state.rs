//! The state of the robot, as occasions and the facts about the robot ask for it.

use nalgebra::Point3;

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use crate::simulation::motions::side;
use crate::simulation::names::{suggestion, type_keyword};
use cram::Reply;
use cram::designator::names::{name_text, rosify};
use cram::pose::value::pose_stamped;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;
use robotics::motion::{is_in_picture, neck_positions};
use robotics::robot::{JointId, KinematicTree};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-ROBOT-INTERFACES`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "JOINT-POSITION",
        "joint",
        "The position (rad or m) of a joint of the robot, given by its name as a string.",
        &["(progn (pp-tut:init-projection) (rob-int::joint-position \"head_pan_joint\")) => 0.0d0"],
        host!(joint_position),
    ),
    control(
        "JOINT-LIMITS",
        "joint",
        "The lower and the upper limit (rad or m) of a joint of the robot, as a list; NIL if it has none.",
        &["(rob-int::joint-limits \"torso_lift_joint\") => (0.0d0 0.33d0)"],
        host!(joint_limits),
    ),
    control(
        "ARM-POSITIONS",
        "arm",
        "The positions (rad) of the seven joints of an arm, from the shoulder to the wrist.",
        &["(length (rob-int::arm-positions :left)) => 7"],
        host!(arm_positions),
    ),
    control(
        "HAND-OPENING",
        "arm",
        "How far a hand is open (m), as SETTING-GRIPPER counts it, and how far it can be opened.",
        &["(progn (pp-tut:init-projection) (< (rob-int::hand-opening :left) 0.01)) => T"],
        host!(hand_opening),
    ),
    control(
        "GAZE-ERROR",
        "pose",
        "By how much (rad) the head would have to turn, in the joint that turns farther, to look at a pose.",
        &[
            "(progn (pp-tut:init-projection) (< (rob-int::gaze-error '((5 0 1.2) (0 0 0 1))) 0.1)) => T",
        ],
        host!(gaze_error),
    ),
    control(
        "GRASP-IN-HAND",
        "name",
        "The grasp by which an object was picked up, if a hand holds it and that is known.",
        &[],
        host!(grasp_in_hand),
    ),
    control(
        "POSE-IN-MAP",
        "pose",
        "A pose in any frame, or in none, as a pose in the map frame.",
        &[
            "(progn (pp-tut:init-projection) (rob-int::pose-in-map (cl-tf:make-pose-stamped \"base_footprint\" 0.0 (cl-tf:make-3d-vector 1 0 0) (cl-tf:make-identity-rotation)))) => #<\"map\" ((1.00000 0.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>",
        ],
        host!(pose_in_map),
    ),
];

/// The joint with a name; an error suggests others.
fn joint(tree: &KinematicTree, image: &Image, name: &Value) -> Result<JointId> {
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

fn joint_position(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let robot = &simulation.models.robot;
    let joint = joint(robot, image, &args[0])?;
    let joints = &simulation.world.robot_configuration().joints;
    done(Value::Double(robot.position(joints, joint)))
}

fn joint_limits(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let robot = &simulation.models.robot;
    let joint = joint(robot, image, &args[0])?;
    done(match robot.joint(joint).limits {
        Some(limits) => Value::list([limits.lower, limits.upper].map(Value::Double)),
        None => Value::NIL,
    })
}

fn arm_positions(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let joints = &simulation.world.robot_configuration().joints;
    let positions = simulation.models.description.arm(side).positions(joints);
    done(Value::list(positions.iter().map(|q| Value::Double(*q))))
}

fn hand_opening(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let gripper = &simulation.models.description.arm(side).gripper;
    let now = simulation
        .world
        .robot_configuration()
        .joints
        .get(gripper.joint);
    let [now, most] = [now, gripper.limits.upper].map(|q| Value::Double(gripper.opening_at(q)));
    done(Value::values(vec![now, most]))
}

fn gaze_error(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let target = simulation.pose_in_map(image, &args[0])?;
    let target = Point3::from(target.translation.vector);
    let neck = &simulation.models.description.neck;
    if neck.joints.is_empty() && !is_in_picture(&simulation.world, &target) {
        return done(Value::Double(std::f64::consts::PI));
    }
    let wanted = neck_positions(&simulation.world, &target);
    let joints = &simulation.world.robot_configuration().joints;
    let now = neck.joints.iter().map(|joint| joints.get(*joint));
    let errors = wanted
        .iter()
        .zip(now)
        .map(|(wanted, now)| (wanted - now).abs());
    done(Value::Double(errors.fold(0.0, f64::max)))
}

fn grasp_in_hand(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let name = simulation.object_named(image, &args[0])?;
    let grasp = simulation
        .held
        .get(&name)
        .and_then(|held| held.grasp.as_ref());
    done(match grasp {
        Some(grasp) if simulation.hand_of(&name).is_some() => type_keyword(image, grasp),
        _ => Value::NIL,
    })
}

fn pose_in_map(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let pose = Simulation::location_pose(image, &args[0]).unwrap_or_else(|_| args[0].clone());
    done(pose_stamped("map", &simulation.pose_in_map(image, &pose)?))
}
