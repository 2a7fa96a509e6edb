//! Whether the robot is where it was to be: what it tells of itself counts, not what a server reports.

use super::belief::Told;
use super::goals::{Order, joints_of};
use crate::outside::{FingersReport, PartGoal};
use robotics::motion::RobotTrouble;
use robotics::robot::{PartInterface, RobotPart};
use robotics::world::World;
use spatial::pose::yaw;
use spatial::trig;

/// How far (m) from where they were to meet an object fingers may stop and still hold it.
pub(super) const OTHER_SIZE: f64 = 0.015;

/// The gap (m) up to which nothing is between fingers, from that at the lower limit of their joint: where that is below
/// zero, no robot gets there.
pub(super) fn closed(least: f64, tolerance: f64) -> f64 {
    least.max(0.0) + tolerance
}

/// The gap (m) at which the fingers of an order meet what they are to grip, as it was tried.
pub(super) fn met(order: &Order, end: &World) -> Option<f64> {
    let RobotPart::Gripper(side) = order.part else {
        return None;
    };
    let gripper = &end.models().description.arm(side).gripper;
    let joint = end.robot_configuration().joints.get(gripper.joint);
    order.grips.then(|| gripper.gap(joint))
}

/// What is wrong with the end of an order that its server reports as reached, if anything. `end` is the world as it was to
/// be then, and `missed` the gap (m) at which the fingers were to meet what they have missed before.
pub(super) fn trouble(
    order: &Order,
    interface: &PartInterface,
    told: &Told,
    end: &World,
    fingers: Option<FingersReport>,
    missed: Option<f64>,
) -> Option<RobotTrouble> {
    let beside = |beside: String| {
        Some(RobotTrouble::Beside {
            name: interface.name.clone(),
            beside,
        })
    };
    match &order.goal {
        PartGoal::Drive(goal) => {
            let base = told.base();
            let way = (goal.translation.vector - base.translation.vector)
                .xy()
                .norm();
            let turn = trig::wrap(yaw(goal) - yaw(&base)).abs();
            if way > interface.tolerance {
                return beside(format!("{way:.2} m from the goal"));
            }
            if turn > interface.turn_tolerance {
                return beside(format!("turned {turn:.2} rad away from the goal"));
            }
            None
        }
        PartGoal::Follow { points, .. } => {
            let models = end.models();
            let goal = points.last()?;
            let joints = joints_of(models, order.part);
            for (id, wanted) in joints.iter().zip(&goal.positions) {
                let joint = models.robot.joint(*id);
                let Some(there) = told.position(*id) else {
                    return Some(unknown(&joint.name));
                };
                let way = match joint.limits {
                    Some(_) => (wanted - there).abs(),
                    None => trig::wrap(wanted - there).abs(),
                };
                // False for what is no number, too.
                let is_there = way <= interface.tolerance;
                if !is_there {
                    let unit = if order.part == RobotPart::Torso {
                        "m"
                    } else {
                        "rad"
                    };
                    let name = &joint.name;
                    return beside(format!("{way:.3} {unit} from the goal of {name}"));
                }
            }
            None
        }
        PartGoal::Fingers { gap, .. } => {
            let RobotPart::Gripper(side) = order.part else {
                return None;
            };
            let gripper = &end.models().description.arm(side).gripper;
            let Some(there) = told.position(gripper.joint) else {
                return Some(unknown(&end.models().robot.joint(gripper.joint).name));
            };
            let there = gripper.gap(there);
            let tolerance = interface.tolerance;
            if !order.grips {
                let way = (there - gap).abs();
                let is_there = way <= tolerance;
                return match is_there {
                    true => None,
                    false => beside(format!("{way:.4} m from the gap of {gap:.4} m")),
                };
            }
            let closed = closed(gripper.gap(gripper.limits.lower), tolerance);
            let reported = fingers.map_or(there, |fingers| fingers.gap);
            if there <= closed || reported <= closed {
                return Some(RobotTrouble::NothingGripped {
                    name: interface.name.clone(),
                    gap: there.min(reported),
                });
            }
            if !fingers.is_some_and(|fingers| fingers.is_stalled) {
                return beside("without having been stopped by anything".to_owned());
            }
            let met = met(order, end).into_iter().chain(missed);
            let met = met.fold(0.0, f64::max);
            match (there - met).abs() > OTHER_SIZE {
                true => beside(format!(
                    "with fingers {there:.3} m apart, which were to meet what they grip at {met:.3} m"
                )),
                false => None,
            }
        }
        // There is no more than the server's word.
        PartGoal::Aim(_) => None,
    }
}

fn unknown(joint: &str) -> RobotTrouble {
    RobotTrouble::NoState(format!("the joint states lack {joint}"))
}
