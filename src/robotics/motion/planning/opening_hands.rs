//! Paths of the arms while fingers open: they need room at the time.

use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::planning::configuration::with_joints;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::{JointId, LinkId};
use crate::world::{CollisionHit, MovingParts, Pairs, World};

/// How far apart (s) the moments are at which a trajectory is looked at.
const STEP: f64 = 0.02;

/// A plan that leaves the fingers room that are opening meanwhile: one that is made as if they stayed as they are, if
/// it happens to do so, or else one that is made with room for them on the whole way, as the function is told.
pub(crate) fn with_room_for_fingers(
    world: &World,
    mut plan: impl FnMut(bool) -> Result<JointPlan, MotionFailure>,
) -> Result<JointPlan, MotionFailure> {
    let first = plan(false)?;
    if leaves_room(world, &first) {
        return Ok(first);
    }
    plan(true)
}

/// Whether the fingers that are opening meanwhile touch nothing new on the way.
fn leaves_room(world: &World, plan: &JointPlan) -> bool {
    let description = &world.models().description;
    let robot = world.robot_configuration();
    let opening = world.opening_fingers();
    let opening = opening.filter(|(joint, _)| !plan.joints.contains(joint));
    let opening: Vec<(JointId, Trajectory)> = opening
        .map(|(joint, to)| {
            let path = [vec![robot.joints.get(joint)], vec![to]];
            let limits = speeds::limits_of(description, &[joint]);
            (joint, Trajectory::new(&path, &limits))
        })
        .collect();
    if opening.is_empty() {
        return true;
    }
    let is_opening = |joint: JointId| opening.iter().any(|(other, _)| *other == joint);
    let grippers = description.arms.iter().map(|arm| &arm.gripper);
    let fingers: Vec<LinkId> = grippers
        .filter(|gripper| is_opening(gripper.joint))
        .flat_map(|gripper| gripper.fingers.iter().flatten().copied())
        .collect();
    let is_finger = |hit: &CollisionHit| {
        [&hit.moving, &hit.other].into_iter().any(|body| {
            let link = body.robot_link();
            link.is_some_and(|link| fingers.contains(&link))
        })
    };
    let mut joints = plan.joints.clone();
    joints.extend(opening.iter().map(|(joint, _)| *joint));
    let mut checker = world.collision_checker();
    let moving = MovingParts::of_joints(&world.models().robot, &joints);
    checker.expect_once(moving, Pairs::Changing);
    let mut touching = |time: f64| {
        let mut there = with_joints(robot, &plan.joints, &plan.trajectory.position(time));
        for (joint, trajectory) in &opening {
            if let [position] = trajectory.position(time)[..] {
                there.joints.set(*joint, position);
            }
        }
        let hits = checker.all_hits(&there, &plan.allowed, 0.0).into_iter();
        hits.filter(is_finger)
            .map(|hit| (hit.moving, hit.other))
            .collect::<Vec<_>>()
    };
    let before = touching(0.0);
    let durations = opening.iter().map(|(_, trajectory)| trajectory.duration());
    let duration = durations.fold(plan.trajectory.duration(), f64::max);
    let steps = (duration / STEP).ceil() as u32;
    (1..=steps).all(|i| {
        let touching = touching((f64::from(i) * STEP).min(duration));
        touching.iter().all(|pair| before.contains(pair))
    })
}
