//! Whether a hand can be moved straight through poses, one after the other, without a detour on which it
//! would turn what it holds.

use super::cartesian_path::{CartesianEnd, CartesianLine, CartesianTask, tcp_in_base};
use super::configuration_checker::ConfigurationChecker;
use super::planning_group::PlanningGroup;
use super::pose_goal::{PoseGoalTask, REASON_STEP};
use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::holding::held_objects;
use crate::robot::Side;
use crate::world::{BodyName, World};
use spatial::Pose;

/// How many postures at the first pose are tried at each height of the torso.
const FIRST_POSTURES: usize = 8;

/// The posture in which a straight way begins.
#[derive(Clone, Debug, PartialEq)]
pub struct WayStart {
    /// Height (m) of the torso.
    pub torso: f64,
    /// Positions of the arm's joints, from the shoulder to the wrist.
    pub arm: Vec<f64>,
}

/// Where a straight way may begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayBegin {
    /// Where the hand is.
    Here,
    /// At the first pose, with the torso as it is.
    AtThisHeight,
    /// At the first pose.
    AtAnyHeight,
}

/// Where a hand can begin to move straight through poses, which are in the frame of the base, while the
/// robot and what it holds touch nothing, but the hand the object, if one is named, and what it holds the
/// bodies through which it goes. If it begins where the hand is, a line leads to the first pose; else the best
/// posture at the first pose is taken. The torso stays at one height.
pub fn straight_way(
    world: &World,
    side: Side,
    poses: &[Pose],
    begin: WayBegin,
    object: Option<&str>,
    through: &[BodyName],
) -> Option<WayStart> {
    let first = *poses.first()?;
    let mode = match object {
        Some(_) => CollisionMode::AllowHand,
        None => CollisionMode::AvoidAll,
    };
    let mut contacts = ExpectedContacts::of(world, [side].into_iter(), mode, object);
    for held in held_objects(world, side).into_iter().map(BodyName::Object) {
        let through = through.iter().cloned();
        contacts.allowed = contacts.allowed.and_all(through, &held);
    }
    let task = PoseGoalTask {
        world,
        goals: vec![(side, first)],
        contacts,
    };
    let heights = match begin {
        WayBegin::AtAnyHeight => task.heights(REASON_STEP),
        WayBegin::Here | WayBegin::AtThisHeight => vec![task.torso_now()],
    };
    let now = tcp_in_base(world, side);
    for height in heights {
        let group = task.group(height);
        let (starts, from) = match begin {
            WayBegin::Here => (vec![group.now(world)], Some(now)),
            WayBegin::AtThisHeight | WayBegin::AtAnyHeight => {
                let found = task.configurations(height, &group).into_iter();
                (found.map(|one| one.positions).collect(), None)
            }
        };
        if starts.is_empty() {
            continue;
        }
        let joints = world.models().description.arm(side).joints().len();
        let mut checker = ConfigurationChecker::new(world, group.joints.clone(), &task.contacts);
        let stations: Vec<Pose> = from.iter().chain(poses).copied().collect();
        let is_free = |checker: &mut ConfigurationChecker<'_>, start: &[f64]| {
            begin == WayBegin::Here || checker.blocked(start).is_none()
        };
        let mut tried = 0;
        for start in starts {
            if !is_free(&mut checker, &start) {
                continue;
            }
            if tried == FIRST_POSTURES {
                break;
            }
            tried += 1;
            if follows(world, side, &group, height, &start, &stations, &mut checker) {
                let torso_axes = start.len().saturating_sub(joints);
                return Some(WayStart {
                    torso: height,
                    arm: start.into_iter().skip(torso_axes).collect(),
                });
            }
        }
    }
    None
}

/// Whether the joints can follow the lines between stations from a configuration at the first.
fn follows(
    world: &World,
    side: Side,
    group: &PlanningGroup,
    height: f64,
    start: &[f64],
    stations: &[Pose],
    checker: &mut ConfigurationChecker<'_>,
) -> bool {
    let joints = world.models().description.arm(side).joints().len();
    let torso_moves = start.len() > joints;
    let mut at = start.to_vec();
    for line in stations.windows(2) {
        let [from, to] = *line else { return false };
        let task = CartesianTask {
            models: world.models(),
            robot: world.robot_configuration().clone(),
            group: group.clone(),
            lines: vec![CartesianLine { side, from, to }],
            torso: torso_moves.then_some(height),
        };
        let (path, end) = task.follow(&at, None, Some(checker));
        match (end, path.points.into_iter().next_back()) {
            (CartesianEnd::Complete, Some(last)) => at = last,
            _ => return false,
        }
    }
    true
}
