//! What the robot could do at a base pose, without moving: stand there, and bring a hand to
//! a pose.
//!
//! The answers agree with those of the motions; whether there is a path is not checked.

use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::hand::hand_names;
use crate::motion::failure::base_place::BasePlace;
use crate::motion::planning::base_checker::BaseChecker;
use crate::motion::planning::configuration::at_place;
use crate::motion::planning::configuration_checker::ConfigurationChecker;
use crate::motion::planning::pose_goal::{PathSearch, PoseGoalTask, TORSO_STEP};
use crate::robot::Side;
use crate::world::{AllowedPairs, BodyName, CollisionHit, World};
use spatial::Pose;

/// Whether the base could be at the pose (m, m, rad) with torso and arms as they are: on the
/// map, without collision.
pub fn can_stand(world: &World, place: &BasePlace) -> bool {
    let [x, y, _] = *place;
    world.models().map.contains([x, y]) && BaseChecker::new(world).blocked(place, 0.0).is_none()
}

/// What the robot would touch with its base at the pose (m, m, rad) and torso and arms as
/// they are.
pub fn touching_at(world: &World, place: &BasePlace) -> Vec<CollisionHit> {
    let robot = at_place(world.robot_configuration(), place);
    let mut checker = world.collision_checker();
    checker.all_hits(&robot, &AllowedPairs::none(), 0.0)
}

/// Whether the tool of a hand could be at the pose in the frame of the base, at any height
/// of the torso, while the robot touches nothing but what the mode permits, and of objects only
/// the target, if one is named.
pub fn can_reach(
    world: &World,
    side: Side,
    tool: &Pose,
    mode: CollisionMode,
    target: Option<&str>,
) -> bool {
    let contacts = ExpectedContacts::of(world, [side].into_iter(), mode, target);
    let task = PoseGoalTask {
        world,
        goals: vec![(side, *tool)],
        contacts,
        search: PathSearch::Long,
    };
    let heights = task.heights(TORSO_STEP);
    // The first one is the present one, at which the torso need not move.
    let (now, others) = heights.split_at(1);
    let hand = hand_names(world, side);
    for heights in [now, others] {
        match reaches_at(&task, heights, &hand) {
            Reach::Reaches => return true,
            Reach::HandBlocked => return false,
            Reach::Fails => {}
        }
    }
    false
}

/// How a try to reach a pose ends.
enum Reach {
    Reaches,
    /// The hand touches something at the pose, whatever torso and arm do.
    HandBlocked,
    /// No posture is free.
    Fails,
}

/// Tries heights of the torso for which the same joints move.
fn reaches_at(task: &PoseGoalTask<'_>, heights: &[f64], hand: &[BodyName]) -> Reach {
    let Some(first) = heights.first() else {
        return Reach::Fails;
    };
    let group = task.group(*first);
    let mut checker = None;
    for height in heights {
        for configuration in task.configurations(*height, &group) {
            let positions = &configuration.positions;
            let checker = match &mut checker {
                Some(checker) => checker,
                none => {
                    let joints = group.joints.clone();
                    let new = ConfigurationChecker::new(task.world, joints, &task.contacts);
                    let checker = none.insert(new);
                    if checker.touches_surroundings(positions, hand) {
                        return Reach::HandBlocked;
                    }
                    checker
                }
            };
            if checker.is_free(positions) {
                return Reach::Reaches;
            }
        }
    }
    Reach::Fails
}
