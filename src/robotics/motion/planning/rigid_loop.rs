//! Two hands that hold one object: arms and object form a loop, which no motion may break.

use crate::motion::failure::broken_loop::BrokenLoop;
use crate::motion::planning::configuration::with_joints;
use crate::motion::planning::joint_plan::JointPlan;
use crate::robot::LinkId;
use crate::world::{RobotConfiguration, World};
use spatial::Pose;
use spatial::pose::{angle_between, distance_between};

/// How far (m) the hands may get from where they took an object, relative to each other.
pub const GREATEST_STRAIN: f64 = 0.003;
/// How far (rad) they may be turned from that.
const GREATEST_TURN: f64 = 0.02;
/// How far apart (s) the moments are at which a trajectory is looked at.
const STEP: f64 = 0.02;

/// Two hands that hold one object.
struct RigidLoop<'w> {
    world: &'w World,
    object: &'w str,
    palms: [LinkId; 2],
    /// The pose of one palm in the frame of the other when they took the object.
    taken: Pose,
}

impl<'w> RigidLoop<'w> {
    fn of(world: &'w World) -> Option<Self> {
        let object = world.objects().find(|object| object.is_held_by_two())?;
        let mut held = object.attachments();
        let (one, two) = (held.next()?, held.next()?);
        Some(Self {
            world,
            object: object.name(),
            palms: [one.link, two.link],
            taken: one.at * two.at.inverse(),
        })
    }

    /// How far the hands of a robot are from where they were when they took the object, relative to each other: m and
    /// rad.
    fn strain(&self, robot: &RobotConfiguration) -> [f64; 2] {
        let tree = &self.world.models().robot;
        let [one, two] = self
            .palms
            .map(|palm| tree.link_pose(palm, &robot.base, &robot.joints));
        let now = one.inverse() * two;
        [
            distance_between(&self.taken, &now),
            angle_between(&self.taken, &now),
        ]
    }
}

/// How a plan would tear two hands from the object that they hold together, or press them into it, if it would.
pub(crate) fn broken_loop(world: &World, plan: &JointPlan) -> Option<BrokenLoop> {
    let hands = RigidLoop::of(world)?;
    let robot = world.robot_configuration();
    // Hands that are too far off already may move so that they get no farther.
    let [distance, angle] = hands.strain(robot);
    let greatest = [GREATEST_STRAIN.max(distance), GREATEST_TURN.max(angle)];
    let steps = (plan.trajectory.duration() / STEP).ceil() as u32;
    let mut worst = [distance, angle];
    for i in 0..=steps {
        let time = (f64::from(i) * STEP).min(plan.trajectory.duration());
        let there = with_joints(robot, &plan.joints, &plan.trajectory.position(time));
        let then = hands.strain(&there);
        worst = [worst[0].max(then[0]), worst[1].max(then[1])];
    }
    (worst[0] > greatest[0] || worst[1] > greatest[1]).then(|| BrokenLoop {
        object: hands.object.to_owned(),
        distance: worst[0],
        angle: worst[1],
    })
}

/// How far (m) the hands that hold an object together are from where they were when they took it, relative to each
/// other; `None` if no two hands hold one.
pub fn strain(world: &World) -> Option<f64> {
    let hands = RigidLoop::of(world)?;
    let [distance, _] = hands.strain(world.robot_configuration());
    Some(distance)
}
