//! Whether the hand finds its way to a grasp, and off again with the object: the motions of
//! picking up are planned one after another, in a copy of the world.

use super::joint_motion::JointGoal;
use super::move_tcp::{HandGoal, PoseGoal, TcpPath};
use crate::motion::choosing::carrying_posture::can_carry;
use crate::motion::choosing::grasp_reach::Station;
use crate::motion::contact::expected_contacts::CollisionMode;
use crate::motion::contact::hand::gripper_of;
use crate::motion::contact::holding::{held_objects, press};
use crate::motion::failure::grasp_obstacle::GraspPart;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::planning::cartesian_path::tcp_in_base;
use crate::motion::planning::configuration::with_joints;
use crate::motion::planning::pose_goal::PathSearch;
use crate::robot::Side;
use crate::world::World;
use spatial::Pose;
use spatial::pose::{angle_between, distance_between};

/// A hand this far (m, rad) from a pose is there.
const THERE: (f64, f64) = (0.001, 0.01);

/// Plans the motions from where the arm is to a first pose, which may be left out, and through the
/// stations, with fingers that open as far as given (m) before the object is approached.
pub fn plan_grasp(
    world: &World,
    side: Side,
    object: &str,
    opening: f64,
    first: &Pose,
    stations: &[Station],
    search: PathSearch,
) -> Result<(), MotionFailure> {
    let mut world = world.clone();
    let first = Station {
        part: GraspPart::Approach,
        tool: *first,
    };
    // As in the plan for picking up, a first pose that is not reached is left out. Where a long search has found no way
    // there, another one to the next pose, which is a few centimetres away, hardly finds one.
    let reached = follow(
        &mut world,
        side,
        object,
        &first,
        (TcpPath::Free, CollisionMode::AvoidAll),
        search,
    );
    let approach = match reached {
        Ok(()) => search,
        Err(_) => PathSearch::Short,
    };
    for station in stations {
        let (path, mode) = match station.part {
            GraspPart::Approach => (TcpPath::Free, CollisionMode::AvoidAll),
            GraspPart::Grasp | GraspPart::Lift => (TcpPath::Straight, CollisionMode::AllowHand),
        };
        if station.part == GraspPart::Lift && held_objects(&world, side).is_empty() {
            let effort = gripper_of(&world, side).effort;
            press(&mut world, side, object, effort)?;
        }
        let search = match station.part {
            GraspPart::Approach => approach,
            GraspPart::Grasp | GraspPart::Lift => search,
        };
        follow(&mut world, side, object, station, (path, mode), search)?;
        if station.part == GraspPart::Approach {
            let gripper = gripper_of(&world, side);
            let fingers = gripper.position_for_opening(opening);
            let opened = with_joints(world.robot_configuration(), &[gripper.joint], &[fingers]);
            world.teleport_robot(&opened);
        }
    }
    match can_carry(&world, side) {
        true => Ok(()),
        false => Err(MotionFailure::NotCarriedUpright {
            side,
            object: object.to_owned(),
        }),
    }
}

/// Moves the hand in the copy of the world, replanning as the motion would.
fn follow(
    world: &mut World,
    side: Side,
    object: &str,
    station: &Station,
    (path, mode): (TcpPath, CollisionMode),
    search: PathSearch,
) -> Result<(), MotionFailure> {
    let mut poses = [None; 2];
    poses[side.index()] = Some(PoseGoal::InBase(station.tool));
    let goal = HandGoal::new(poses, path, mode, Some(object.to_owned()));
    let mut goal = goal.searching(search);
    for plans in 0..HandGoal::MAX_PLANS {
        let plan = goal.plan(world, plans)?;
        world.teleport_robot(&plan.end(world.robot_configuration()));
        let hand = tcp_in_base(world, side);
        let far = distance_between(&hand, &station.tool) > THERE.0
            || angle_between(&hand, &station.tool) > THERE.1;
        if !far {
            break;
        }
    }
    Ok(())
}
