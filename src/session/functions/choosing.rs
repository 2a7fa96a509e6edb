//! `choose-grasp`: an arm and a grasp that work; `grasps-for-target`: those that suit a place to put it down.

use crate::interruption::interruption;
use crate::simulation::Simulation;
use crate::simulation::motions::{self, side, side_keyword, sides};
use crate::simulation::names::{type_keyword, type_text, type_text_of};
use crate::simulation::target_checks::{PlacingTarget, TargetGrasps};
use indexmap::IndexMap;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;
use robotics::motion::interruption::interruptible;
use robotics::motion::{GraspObstacle, GraspQuestion};
use robotics::robot::Side;
use spatial::Pose;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-MOBILE-PICK-PLACE-PLANS`.
pub(super) static TABLE: &[Builtin] =
    builtins![choose_grasp, grasps_for_target, room_to_put_down_p];

/// One thing or a list of things.
fn listed(value: Option<&Value>) -> Vec<Value> {
    match value {
        None => Vec::new(),
        Some(value) if value.is_nil() => Vec::new(),
        Some(value @ Value::Cons(_)) => value.iter_list().collect(),
        Some(value) => vec![value.clone()],
    }
}

/// The nearest arm and grasp by which a perceived object can be picked up from where the robot stands, or
/// from a base pose: the arm, the grasp, the poses of the hand (pregrasp, second pregrasp, grasp, lift,
/// second lift), the angle (rad) by which the grasp is turned about the axis of a round object, the cost of
/// the choice (less is better: how far, in m, the wrist is from the shoulder), and the height (m) of the
/// torso. Only the given arms and grasps are used, and only those with which the object can be put down at
/// the target. FAILED is a list of arms, grasps and angles that have failed already. If there is no such
/// grasp, fails with MANIPULATION-POSE-UNREACHABLE, and EXPLAIN tells why each of them does not work.
#[builtin]
fn choose_grasp(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    #[key] arms: Option<&Value>,
    #[key] grasps: Option<&Value>,
    #[key] base_pose: Option<&Value>,
    #[key] target: Option<&Value>,
    #[key] target_base_pose: Option<&Value>,
    #[key] failed: Option<&Value>,
) -> Result<Value> {
    let mut question = question(simulation, image, object, arms, grasps)?;
    let mut pose_of = |pose: Option<&Value>| match pose.filter(|pose| pose.is_true()) {
        None => Ok(None),
        Some(pose) => pose_in_map(simulation, image, pose).map(Some),
    };
    let (base, target, target_base) = (
        pose_of(base_pose)?,
        pose_of(target)?,
        pose_of(target_base_pose)?,
    );
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
        return Ok(Value::values(Vec::new()));
    };
    let choice = chosen.map_err(|failure| simulation.failure(image, &failure, object))?;
    let poses = [
        choice.poses.pregrasp,
        choice.poses.second_pregrasp,
        choice.poses.grasp,
        choice.poses.lift,
        choice.poses.second_lift,
    ];
    let poses = poses.map(|pose| simulation.in_base(&pose));
    Ok(Value::values(vec![
        side_keyword(image, choice.side),
        type_keyword(image, &choice.grasp),
        Value::list(poses),
        Value::Double(choice.turn),
        Value::Double(choice.cost),
        Value::Double(choice.torso),
    ]))
}

/// The arms and grasps by which a perceived object can be put down at a pose, wherever the robot stands, of
/// those for which the hand has room where the object is now: a list of lists of an arm and its grasps. If
/// there are none, the second value tells why, and the third one is true if the hand has no room at the
/// target for any of them. The fourth one is true if the object is round and no grasps are given, so that the
/// grasps are also turned about its axis; the fifth one if all will do for which there is room.
#[builtin]
fn grasps_for_target(
    simulation: &mut Simulation,
    image: &mut Image,
    object: &Value,
    target: &Value,
    #[key] arms: Option<&Value>,
    #[key] grasps: Option<&Value>,
) -> Result<Value> {
    let question = question(simulation, image, object, arms, grasps)?;
    let pose = pose_in_map(simulation, image, target)?;
    let target = PlacingTarget { pose, base: None };
    let found = interruptible(interruption(image), || {
        simulation.grasps_for_target(&question, &target)
    });
    let Some(found) = found else {
        // Ctrl-C stops the plan at its next step.
        return Ok(Value::values(Vec::new()));
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
    Ok(Value::values(vec![
        Value::list(by_arm),
        why,
        Value::bool(is_certain),
        Value::bool(found.is_from_all_angles),
        Value::bool(found.others.is_empty()),
    ]))
}

/// Has the hand that holds an object of the world room to put it down at a pose, wherever the robot stands?
#[builtin]
fn room_to_put_down_p(
    simulation: &mut Simulation,
    image: &mut Image,
    arm: &Value,
    name: &Value,
    target: &Value,
) -> Result<bool> {
    let side = side(image, arm)?;
    let object = simulation.object_named(image, name)?;
    let pose = pose_in_map(simulation, image, target)?;
    let has_room = simulation.has_room_to_put(&object, side, pose);
    has_room.map_err(Raise::reporting)
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
    arms: Option<&Value>,
    grasps: Option<&Value>,
) -> Result<GraspQuestion> {
    let object = simulation.perceived(image, object)?;
    let arms = match arms.filter(|arms| arms.is_true()) {
        Some(arms) => sides(image, arms)?,
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
