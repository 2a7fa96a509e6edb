//! Two hands that hold one object: arms and object form a loop, which no motion may break.

use crate::motion::failure::broken_loop::BrokenLoop;
use crate::motion::planning::configuration::with_joints;
use crate::motion::planning::joint_plan::JointPlan;
use crate::robot::LinkId;
use crate::world::{RobotConfiguration, World};
use spatial::Pose;
use spatial::pose::{angle_between, distance_between};

/// How far (m) the hands may get from where they are relative to each other.
pub const GREATEST_STRAIN: f64 = 0.003;
/// How far (rad) they may be turned relative to each other.
const GREATEST_TURN: f64 = 0.02;
/// How far apart (s) the moments are at which a trajectory is looked at.
const STEP: f64 = 0.02;

/// The object that two hands hold together, and their palms.
fn held_by_two(world: &World) -> Option<(&str, [LinkId; 2])> {
    let object = world.objects().find(|object| object.is_held_by_two())?;
    let mut palms = object.attachments().map(|one| one.link);
    Some((object.name(), [palms.next()?, palms.next()?]))
}

/// The pose of one hand in the frame of the other.
fn between(world: &World, [one, two]: [LinkId; 2], robot: &RobotConfiguration) -> Pose {
    let tree = &world.models().robot;
    let at = |link| tree.link_pose(link, &robot.base, &robot.joints);
    at(one).inverse() * at(two)
}

/// How a plan would tear two hands from the object that they hold together, or press them into it, if it would.
pub(crate) fn broken_loop(world: &World, plan: &JointPlan) -> Option<BrokenLoop> {
    let (object, palms) = held_by_two(world)?;
    let robot = world.robot_configuration();
    let now = between(world, palms, robot);
    let steps = (plan.trajectory.duration() / STEP).ceil() as u32;
    let mut worst: (f64, f64) = (0.0, 0.0);
    for i in 0..=steps {
        let time = (f64::from(i) * STEP).min(plan.trajectory.duration());
        let there = with_joints(robot, &plan.joints, &plan.trajectory.position(time));
        let then = between(world, palms, &there);
        worst.0 = worst.0.max(distance_between(&now, &then));
        worst.1 = worst.1.max(angle_between(&now, &then));
    }
    (worst.0 > GREATEST_STRAIN || worst.1 > GREATEST_TURN).then(|| BrokenLoop {
        object: object.to_owned(),
        distance: worst.0,
        angle: worst.1,
    })
}

/// How far (m) the hands that hold an object together are from where they were when they took it, relative to each
/// other; `None` if no two hands hold one.
pub fn strain(world: &World) -> Option<f64> {
    let (name, palms) = held_by_two(world)?;
    let object = world.object(name).ok()?;
    let [one, two] = palms.map(|palm| object.attachment_to(palm).map(|held| held.at));
    let taken = one? * two?.inverse();
    let now = between(world, palms, world.robot_configuration());
    Some(distance_between(&taken, &now))
}
