//! The world here follows what the robot tells of itself.

use super::RobotAccess;
use super::check::{OTHER_SIZE, closed as closed_gap};
use super::goals::joints_of;
use crate::outside::RobotState;
use robotics::motion::{RobotTrouble, held_objects};
use robotics::robot::{JointId, RobotPart};
use robotics::world::{RobotConfiguration, World};
use spatial::pose::{from_xy_yaw, yaw};
use spatial::trig;

/// What differs by less (m or rad) is the same.
const SAME: f64 = 1e-4;
/// What differs by more (m or rad) has not moved there within a step.
const STEP: f64 = 0.01;

/// What a robot tells of its parts.
pub(super) struct Told {
    state: RobotState,
    joints: Vec<(RobotPart, JointId)>,
}

impl Told {
    /// How the robot is now.
    pub(super) fn now(robot: &RobotAccess, world: &World) -> Result<Self, RobotTrouble> {
        let models = world.models();
        let parts = RobotPart::ALL.iter().flat_map(|part| {
            let joints = joints_of(models, *part).into_iter();
            joints.map(|joint| (*part, joint))
        });
        let joints: Vec<(RobotPart, JointId)> = parts.collect();
        let names = joints
            .iter()
            .map(|(_, id)| models.robot.joint(*id).name.as_str());
        let names: Vec<&str> = names.collect();
        let state = robot.link.borrow().state(&names)?;
        if let Some(wrong) = wrong(&state, &names) {
            return Err(RobotTrouble::NoState(wrong));
        }
        robot.was_heard.set(true);
        Ok(Self { state, joints })
    }

    /// Where the base is on the floor of the map.
    pub(super) fn base(&self) -> spatial::Pose {
        let at = self.state.base.translation;
        from_xy_yaw(at.x, at.y, yaw(&self.state.base))
    }

    /// Whether parts of the robot are where they were when it told that.
    pub(super) fn is_as(&self, before: &Told, is_meant: impl Fn(RobotPart) -> bool) -> bool {
        let [now, then] = [self.base(), before.base()];
        let way = (now.translation.vector - then.translation.vector).norm();
        let turn = trig::wrap(yaw(&now) - yaw(&then)).abs();
        let base = match is_meant(RobotPart::Base) {
            true => way.max(turn),
            false => 0.0,
        };
        let parts = self.joints.iter().map(|(part, _)| is_meant(*part));
        let pairs = self.state.joints.iter().zip(&before.state.joints);
        let meant = pairs.zip(parts).filter(|(_, is_meant)| *is_meant);
        let farthest = meant.map(|((now, then), _)| (now - then).abs());
        farthest.fold(base, f64::max) <= STEP
    }

    /// Where a joint is (rad or m).
    pub(super) fn position(&self, joint: JointId) -> Option<f64> {
        let place = self.joints.iter().position(|(_, known)| *known == joint);
        place.and_then(|place| self.state.joints.get(place).copied())
    }

    /// Where a joint is, turned by as many whole turns as a world has it, if it has no limits.
    fn unwound(&self, joint: JointId, world: &World) -> Option<f64> {
        let told = self.position(joint)?;
        let known = world.robot_configuration().joints.get(joint);
        Some(match world.models().robot.joint(joint).limits {
            Some(_) => told,
            None => known + trig::wrap(told - known),
        })
    }

    /// By how much (rad) the robot counts a joint otherwise than a world.
    pub(super) fn turns(&self, joint: JointId, world: &World) -> f64 {
        let pair = self.position(joint).zip(self.unwound(joint, world));
        pair.map_or(0.0, |(told, here)| told - here)
    }

    /// Takes parts of the robot in a world to where they are. What a hand is not there to hold any more, it does not
    /// hold.
    pub(super) fn believe(
        &self,
        world: &mut World,
        is_meant: impl Fn(RobotPart) -> bool,
        closed: f64,
    ) {
        let mut next = world.robot_configuration().clone();
        let mut farthest: f64 = 0.0;
        if is_meant(RobotPart::Base) {
            let base = self.base();
            let way = (base.translation.vector - next.base.translation.vector).norm();
            let turn = trig::wrap(yaw(&base) - yaw(&next.base)).abs();
            if way.max(turn) > SAME {
                farthest = farthest.max(way).max(turn);
                next.base = base;
            }
        }
        for (part, joint) in &self.joints {
            let Some(position) = self.unwound(*joint, world).filter(|_| is_meant(*part)) else {
                continue;
            };
            if let RobotPart::Gripper(side) = part
                && self.keeps(world, *side, position, closed)
            {
                continue;
            }
            let way = (position - next.joints.get(*joint)).abs();
            if way > SAME {
                farthest = farthest.max(way);
                next.joints.set(*joint, position);
            }
        }
        adopt(world, &next, farthest);
    }

    /// Whether the fingers of a hand hold something, in the world and as the robot tells; they are left alone then.
    fn keeps(
        &self,
        world: &mut World,
        side: robotics::robot::Side,
        position: f64,
        closed: f64,
    ) -> bool {
        let held = held_objects(world, side);
        let holds_handle = world.handle_hold(side).is_some();
        if held.is_empty() && !holds_handle {
            return false;
        }
        let gripper = &world.models().description.arm(side).gripper;
        let believed = gripper.gap(world.robot_configuration().joints.get(gripper.joint));
        let gap = gripper.gap(position);
        let is_empty = gap <= closed_gap(gripper.gap(gripper.limits.lower), closed);
        // Fingers that are so far open hold nothing.
        let is_open = gap > believed + OTHER_SIZE;
        if is_empty || is_open {
            world.release_handle(side);
            for name in held {
                // It has just been found.
                let _link = world.detach(&name);
            }
        }
        !(is_empty || is_open)
    }
}

/// What of a state cannot be.
fn wrong(state: &RobotState, names: &[&str]) -> Option<String> {
    let base = &state.base;
    let numbers = base
        .translation
        .vector
        .iter()
        .chain(base.rotation.coords.iter());
    if !numbers.copied().all(f64::is_finite) {
        return Some("the place of the base is no number".to_owned());
    }
    let [positions, joints] = [state.joints.len(), names.len()];
    if positions != joints {
        return Some(format!(
            "the joint states have {positions} positions for {joints} joints"
        ));
    }
    let mut pairs = names.iter().zip(&state.joints);
    let (name, _) = pairs.find(|(_, position)| !position.is_finite())?;
    Some(format!(
        "the joint states have no finite position of {name}"
    ))
}

/// Takes the robot to a configuration: within the next step if that is near, since what it holds follows; at once if not.
fn adopt(world: &mut World, next: &RobotConfiguration, farthest: f64) {
    let holds_handle = {
        let mut sides = world.models().description.sides();
        sides.any(|side| world.handle_hold(side).is_some())
    };
    match farthest {
        0.0 => {}
        near if near <= STEP || holds_handle => world.set_robot_configuration(next),
        _ => world.teleport_robot(next),
    }
}
