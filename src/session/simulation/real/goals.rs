//! The goals of a robot's parts, from how a motion went when it was tried.

use super::trial::Trial;
use crate::outside::{PartGoal, TrajectoryPoint};
use robotics::motion::{Motion, ProcessModule, RobotTrouble, held_objects};
use robotics::robot::{JointId, RobotPart, Side};
use robotics::world::physics::STEP_SECONDS;
use robotics::world::{Models, RobotConfiguration, World};

/// A joint has moved if it has moved by this much (rad or m).
const MOVES: f64 = 1e-4;
/// Steps between two points of a trajectory, while velocities change, and otherwise.
const EVERY: usize = 4;
const SELDOM: usize = 3;
/// Velocities that differ by less (rad/s or m/s) are the same.
const EVEN: f64 = 1e-5;
/// How much longer than it was tried a trajectory takes: controllers that interpolate otherwise stay within the limits.
const SLOWER: f64 = 1.05;

/// What a part is to do, and how it is known to have done it.
#[derive(Clone, Debug)]
pub(super) struct Order {
    pub(super) part: RobotPart,
    pub(super) goal: PartGoal,
    /// Whether fingers close on something.
    pub(super) grips: bool,
}

/// The joints of a part.
pub(super) fn joints_of(models: &Models, part: RobotPart) -> Vec<JointId> {
    let body = &models.description;
    let has = |side: Side| body.sides().any(|own| own == side);
    match part {
        RobotPart::Base => Vec::new(),
        RobotPart::Torso => body.torso.joint.into_iter().collect(),
        RobotPart::Neck => body.neck.joints.clone(),
        RobotPart::Arm(side) if has(side) => body.arm(side).joints().to_vec(),
        RobotPart::Gripper(side) if has(side) => vec![body.arm(side).gripper.joint],
        RobotPart::Arm(_) | RobotPart::Gripper(_) => Vec::new(),
    }
}

/// What a part is to do that the robot does by its own lights, without a trial.
pub(super) fn untried(world: &World, motion: &dyn Motion) -> Option<Order> {
    let (part, goal) = match motion.module() {
        ProcessModule::Navigation => (RobotPart::Base, PartGoal::Drive(motion.drives_to()?)),
        ProcessModule::Neck => (
            RobotPart::Neck,
            PartGoal::Aim(motion.aims_at(world)?.into()),
        ),
        _ => return None,
    };
    Some(Order {
        part,
        goal,
        grips: false,
    })
}

/// What the parts of the robot are to do so that it does what was tried. `turns` is, for a joint, by how much (rad) the
/// robot counts it otherwise than the world here; parts that are busy do what other motions want.
pub(super) fn orders(
    world: &World,
    motion: &dyn Motion,
    trial: &Trial,
    turns: impl Fn(JointId) -> f64,
    is_busy: impl Fn(RobotPart) -> bool,
) -> Result<Vec<Order>, RobotTrouble> {
    let models = world.models();
    let trace = &trial.trace;
    let (Some(first), Some(last)) = (trace.first(), trace.last()) else {
        return Ok(Vec::new());
    };
    let module = motion.module();
    let has_moved = |part: RobotPart| {
        let joints = joints_of(models, part);
        !is_busy(part) && trace.iter().any(|at| moved(&joints, first, at))
    };
    let mut orders = Vec::new();
    let mut order = |part, goal| {
        orders.push(Order {
            part,
            goal,
            grips: false,
        });
    };
    let drives = !is_busy(RobotPart::Base) && trace.iter().any(|at| at.base != first.base);
    let mut arms = models.description.sides().map(RobotPart::Arm);
    if module == ProcessModule::Navigation && !arms.any(has_moved) {
        order(RobotPart::Base, PartGoal::Drive(last.base));
    } else if drives {
        return Err(RobotTrouble::NotPossible(
            "the motion would move the base together with an arm, which no action of the robot does"
                .to_owned(),
        ));
    }
    if module == ProcessModule::Neck && !models.description.neck.joints.is_empty() {
        let aim = motion.aims_at(world).ok_or_else(|| {
            RobotTrouble::NotPossible("the head is to be aimed at no point".to_owned())
        })?;
        order(RobotPart::Neck, PartGoal::Aim(aim.into()));
    }
    let follow = |part: RobotPart| follow(models, trace, part, &turns);
    let wants_torso = module == ProcessModule::Torso || has_moved(RobotPart::Torso);
    if wants_torso && models.description.torso.joint.is_some() {
        order(RobotPart::Torso, follow(RobotPart::Torso));
    }
    for side in models.description.sides() {
        if has_moved(RobotPart::Arm(side)) {
            order(RobotPart::Arm(side), follow(RobotPart::Arm(side)));
        }
    }
    for side in models.description.sides() {
        // Fingers that do not move here may have to on the robot, for what they hold from now on.
        let held = |world: &World| (held_objects(world, side), world.handle_hold(side).is_some());
        let holds_otherwise =
            !is_busy(RobotPart::Gripper(side)) && held(world) != held(&trial.world);
        if has_moved(RobotPart::Gripper(side)) || holds_otherwise {
            orders.push(fingers(&trial.world, side, motion.grip_effort()));
        }
    }
    Ok(orders)
}

fn moved(joints: &[JointId], from: &RobotConfiguration, to: &RobotConfiguration) -> bool {
    let mut ways = joints
        .iter()
        .map(|joint| to.joints.get(*joint) - from.joints.get(*joint));
    ways.any(|way| way.abs() > MOVES)
}

/// A trajectory of a part.
fn follow(
    models: &Models,
    trace: &[RobotConfiguration],
    part: RobotPart,
    turns: impl Fn(JointId) -> f64,
) -> PartGoal {
    let ids = joints_of(models, part);
    let last = trace.len().saturating_sub(1);
    let at = |step: usize, joint: JointId| trace.get(step).map_or(0.0, |at| at.joints.get(joint));
    // What rests at the end needs no further points.
    let is_end = |step: &usize| ids.iter().all(|id| at(*step, *id) == at(last, *id));
    let end = (0..=last).rev().take_while(is_end).last().unwrap_or(last);
    let end = end.max(1);
    let velocity = |step: usize, id: JointId| match step < end {
        true => (at(step + 1, id) - at(step - 1, id)) / (2.0 * STEP_SECONDS),
        false => 0.0,
    };
    let is_even = |a: usize, b: usize| {
        let mut ids = ids.iter();
        ids.all(|id| (velocity(a, *id) - velocity(b, *id)).abs() < EVEN)
    };
    let mut steps = Vec::new();
    let mut skipped = 0;
    for step in (EVERY..end).step_by(EVERY) {
        // Where nothing changes, before and behind it, a point says nothing.
        let is_dull = step > EVERY
            && step + EVERY < end
            && is_even(step - EVERY, step)
            && is_even(step, step + EVERY);
        if is_dull && skipped + 1 < SELDOM {
            skipped += 1;
            continue;
        }
        skipped = 0;
        steps.push(step);
    }
    steps.push(end);
    let points = steps.into_iter().map(|step| TrajectoryPoint {
        time: step as f64 * STEP_SECONDS * SLOWER,
        positions: ids.iter().map(|id| at(step, *id) + turns(*id)).collect(),
        velocities: ids.iter().map(|id| velocity(step, *id) / SLOWER).collect(),
    });
    PartGoal::Follow {
        points: points.collect(),
        joints: ids
            .iter()
            .map(|id| models.robot.joint(*id).name.clone())
            .collect(),
    }
}

/// What the fingers of a hand are to do so that it is as in a world, with a force (N), or else the greatest.
fn fingers(end: &World, side: Side, effort: Option<f64>) -> Order {
    let gripper = &end.models().description.arm(side).gripper;
    let grips = !held_objects(end, side).is_empty() || end.handle_hold(side).is_some();
    let position = match grips {
        // On through what they hold.
        true => gripper.limits.lower,
        false => end.robot_configuration().joints.get(gripper.joint),
    };
    Order {
        part: RobotPart::Gripper(side),
        goal: PartGoal::Fingers {
            gap: gripper.gap(position).max(0.0),
            effort: effort.unwrap_or(gripper.effort),
        },
        grips,
    }
}
