//! `choose-grasp`: an arm and a grasp that work; `grasps-for-target`: those that suit a place to put it down.

use crate::host::call::{done, host};
use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::motions::{self, side, side_keyword, sides};
use crate::simulation::names::{type_keyword, type_text, type_text_of};
use crate::simulation::target_checks::{PlacingTarget, TargetGrasps};
use cram::Reply;
use indexmap::IndexMap;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::print;
use lisp::typed::keywords;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::interruption::interruptible;
use robotics::motion::{GraspObstacle, GraspQuestion};
use robotics::robot::Side;
use spatial::Pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "CHOOSE-GRASP",
        "object &key arms grasps base-pose target target-base-pose failed",
        "The nearest arm and grasp by which a perceived object can be picked up from where the robot stands, or from a base pose: the arm, the grasp, the poses of the hand (pregrasp, second pregrasp, grasp, lift, second lift), the angle (rad) by which the grasp is turned about the axis of a round object, the cost of the choice (less is better: how far, in m, the wrist is from the shoulder), and the height (m) of the torso. Only the given arms and grasps are used, and only those with which the object can be put down at the target. FAILED is a list of arms, grasps and angles that have failed already. If there is no such grasp, fails with MANIPULATION-POSE-UNREACHABLE, and EXPLAIN tells why each of them does not work.",
        &[],
        host!(choose_grasp),
    ),
    control(
        "GRASPS-FOR-TARGET",
        "object target &key arms grasps",
        "The arms and grasps by which a perceived object can be put down at a pose, wherever the robot stands, of those for which the hand has room where the object is now: a list of lists of an arm and its grasps. If there are none, the second value tells why, and the third one is true if the hand has no room at the target for any of them. The fourth one is true if the object is round and no grasps are given, so that the grasps are also turned about its axis; the fifth one if all will do for which there is room.",
        &[],
        host!(grasps_for_target),
    ),
    control(
        "ROOM-TO-PUT-DOWN-P",
        "arm name target",
        "Has the hand that holds an object of the world room to put it down at a pose, wherever the robot stands?",
        &[],
        host!(room_to_put_down),
    ),
];

/// One thing or a list of things.
fn listed(value: Option<Value>) -> Vec<Value> {
    match value {
        None => Vec::new(),
        Some(value) if value.is_nil() => Vec::new(),
        Some(value) if matches!(value, Value::Cons(_)) => value.iter_list().collect(),
        Some(value) => vec![value],
    }
}

fn choose_grasp(simulation: &mut Simulation, image: &mut Image, args: &[Value]) -> Result<Reply> {
    let keys = [
        "ARMS",
        "GRASPS",
        "BASE-POSE",
        "TARGET",
        "TARGET-BASE-POSE",
        "FAILED",
    ]
    .map(|name| image.keyword(name));
    let [arms, grasps, base, target, target_base, failed] =
        keywords::parse(image, &args[1..], keys)?;
    let mut question = question(simulation, image, &args[0], arms, grasps)?;
    let mut pose_of = |pose: Option<Value>| match pose.filter(Value::is_true) {
        None => Ok(None),
        Some(pose) => pose_in_map(simulation, image, &pose).map(Some),
    };
    let (base, target, target_base) = (pose_of(base)?, pose_of(target)?, pose_of(target_base)?);
    question.failed = listed(failed)
        .iter()
        .map(|one| failed_grasp(image, one))
        .collect::<Result<_>>()?;
    let target = target.map(|pose| PlacingTarget {
        pose,
        base: target_base,
    });
    let chosen = interruptible(interruption(image), || {
        simulation.choose_grasp(&question, target.as_ref(), base.as_ref())
    });
    let Some(chosen) = chosen else {
        // Ctrl-C stops the plan at its next step.
        return done(Value::values(Vec::new()));
    };
    let choice = chosen.map_err(|failure| simulation.failure(image, &failure, &args[0]))?;
    let poses = [
        choice.poses.pregrasp,
        choice.poses.second_pregrasp,
        choice.poses.grasp,
        choice.poses.lift,
        choice.poses.second_lift,
    ];
    let poses = poses.map(|pose| simulation.in_base(&pose));
    done(Value::values(vec![
        side_keyword(image, choice.side),
        type_keyword(image, &choice.grasp),
        Value::list(poses),
        Value::Double(choice.turn),
        Value::Double(choice.cost),
        Value::Double(choice.torso),
    ]))
}

fn grasps_for_target(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let keys = ["ARMS", "GRASPS"].map(|name| image.keyword(name));
    let [arms, grasps] = keywords::parse(image, &args[2..], keys)?;
    let question = question(simulation, image, &args[0], arms, grasps)?;
    let pose = pose_in_map(simulation, image, &args[1])?;
    let target = PlacingTarget { pose, base: None };
    let found = interruptible(interruption(image), || {
        simulation.grasps_for_target(&question, &target)
    });
    let Some(found) = found else {
        // Ctrl-C stops the plan at its next step.
        return done(Value::values(Vec::new()));
    };
    let mut by_arm = Vec::new();
    for side in &question.arms {
        let suiting = found.suiting.iter().filter(|(arm, _)| arm == side);
        let mut grasps: Vec<Value> = suiting
            .map(|(_, grasp)| type_keyword(image, grasp))
            .collect();
        if !grasps.is_empty() {
            grasps.insert(0, side_keyword(image, *side));
            by_arm.push(Value::list(grasps));
        }
    }
    let why = match by_arm.is_empty() {
        true => why_none(&found).map_or(Value::NIL, Value::string),
        false => Value::NIL,
    };
    let is_certain = by_arm.is_empty() && found.is_certain;
    done(Value::values(vec![
        Value::list(by_arm),
        why,
        Value::bool(is_certain),
        Value::bool(found.is_from_all_angles),
        Value::bool(found.others.is_empty()),
    ]))
}

fn room_to_put_down(
    simulation: &mut Simulation,
    image: &mut Image,
    args: &[Value],
) -> Result<Reply> {
    let side = side(image, &args[0])?;
    let object = simulation.object_named(image, &args[1])?;
    let pose = pose_in_map(simulation, image, &args[2])?;
    let has_room = simulation.has_room_to_put(&object, side, pose);
    done(Value::bool(has_room.map_err(Raise::reporting)?))
}

/// The most frequent cause for which no grasp suits a target.
fn why_none(found: &TargetGrasps) -> Option<String> {
    let mut causes: IndexMap<String, usize> = IndexMap::new();
    for (.., obstacle) in &found.others {
        let obstacle = match obstacle {
            GraspObstacle::NotAtTarget { obstacle } => obstacle,
            other => other,
        };
        *causes.entry(obstacle.to_string()).or_default() += 1;
    }
    let most = causes.values().copied().max()?;
    let mut causes = causes.into_iter();
    causes.find_map(|(cause, count)| (count == most).then_some(cause))
}

/// What is asked about a perceived object, with some arms and grasps.
fn question(
    simulation: &Simulation,
    image: &mut Image,
    object: &Value,
    arms: Option<Value>,
    grasps: Option<Value>,
) -> Result<GraspQuestion> {
    let object = simulation.perceived(image, object)?;
    let arms = match arms.filter(Value::is_true) {
        Some(arms) => sides(image, &arms)?,
        None => motions::arms(image).into_iter().rev().collect(),
    };
    let mut names = Vec::new();
    for grasp in listed(grasps) {
        let known = arms
            .iter()
            .find_map(|arm| simulation.grasp(image, &object.kind, *arm, &grasp).ok());
        if known.is_none() {
            // An error that lists the grasps that there are.
            simulation.grasp(image, &object.kind, arms[0], &grasp)?;
        }
        names.extend(type_text(image, &grasp));
    }
    Ok(GraspQuestion {
        in_map: simulation.base() * object.in_base,
        object: object.name,
        kind: object.kind,
        arms,
        grasps: names,
        torso_moves: true,
        failed: Vec::new(),
    })
}

fn pose_in_map(simulation: &Simulation, image: &mut Image, pose: &Value) -> Result<Pose> {
    let pose = Simulation::location_pose(image, pose)?;
    simulation.pose_in_map(image, &pose)
}

/// An arm, a grasp and an angle (rad).
fn failed_grasp(image: &Image, value: &Value) -> Result<(Side, String, f64)> {
    let parts: Vec<Value> = value.iter_list().collect();
    let [arm, grasp, turn] = parts.as_slice() else {
        return Err(Raise::simple(format!(
            "{} is no list of an arm, a grasp and an angle.",
            print::to_string(image, value, true)
        )));
    };
    let grasp = type_text_of(image, grasp)?;
    Ok((
        side(image, arm)?,
        grasp,
        number::to_f64(turn).unwrap_or(0.0),
    ))
}
