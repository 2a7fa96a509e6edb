//! Whether a hand, or both at once, can be moved straight through poses, one after the other, without a detour on
//! which they would turn what they hold.

use super::cartesian_path::{CartesianEnd, CartesianLine, CartesianTask, tcp_in_base};
use super::configuration_checker::ConfigurationChecker;
use super::planning_group::PlanningGroup;
use super::pose_goal::{PathSearch, PoseGoalTask, REASON_STEP};
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

/// The postures in which the straight ways of several hands begin.
#[derive(Clone, Debug, PartialEq)]
pub struct WaysStart {
    /// Height (m) of the torso.
    pub torso: f64,
    /// Positions of each arm's joints, in the order of the ways.
    pub arms: Vec<Vec<f64>>,
}

/// Where a straight way may begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayBegin {
    /// Where the hand is, with the torso as it is.
    Here,
    /// Where the hand is; the torso may move on the way.
    HereAtAnyHeight,
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
    let ways = [(side, poses.to_vec())];
    let start = straight_ways(world, &ways, begin, object, through)?;
    Some(WayStart {
        torso: start.torso,
        arm: start.arms.into_iter().next()?,
    })
}

/// As [`straight_way`], for several hands that move at the same time, each through as many poses.
pub fn straight_ways(
    world: &World,
    ways: &[(Side, Vec<Pose>)],
    begin: WayBegin,
    object: Option<&str>,
    through: &[BodyName],
) -> Option<WaysStart> {
    let goals: Option<Vec<(Side, Pose)>> = ways
        .iter()
        .map(|(side, poses)| Some((*side, *poses.first()?)))
        .collect();
    let goals = goals?;
    let sides: Vec<Side> = goals.iter().map(|(side, _)| *side).collect();
    let mode = match object {
        Some(_) => CollisionMode::AllowHand,
        None => CollisionMode::AvoidAll,
    };
    let mut contacts = ExpectedContacts::of(world, sides.iter().copied(), mode, object);
    for side in &sides {
        for held in held_objects(world, *side).into_iter().map(BodyName::Object) {
            let through = through.iter().cloned();
            contacts.allowed = contacts.allowed.and_all(through, &held);
        }
    }
    let task = PoseGoalTask {
        world,
        goals,
        contacts,
        search: PathSearch::Long,
        leaves_room: false,
    };
    let heights = match begin {
        WayBegin::AtAnyHeight | WayBegin::HereAtAnyHeight => task.heights(REASON_STEP),
        WayBegin::Here | WayBegin::AtThisHeight => vec![task.torso_now()],
    };
    let begins_here = matches!(begin, WayBegin::Here | WayBegin::HereAtAnyHeight);
    let stations = stations(world, ways, begins_here);
    for height in heights {
        let group = task.group(height);
        let starts = match begin {
            WayBegin::Here | WayBegin::HereAtAnyHeight => vec![group.now(world)],
            WayBegin::AtThisHeight | WayBegin::AtAnyHeight => {
                let found = task.configurations(height, &group).into_iter();
                found.map(|one| one.positions).collect()
            }
        };
        if starts.is_empty() {
            continue;
        }
        // The torso is at that height at all of them but where the hands are now.
        let given = if begins_here { 1 } else { 0 };
        let mut hands = stations.iter().skip(given).flatten();
        if hands.any(|(side, tool)| misses(&task, *side, tool, height)) {
            continue;
        }
        let mut checker = ConfigurationChecker::new(world, group.joints.clone(), &task.contacts);
        let is_free = |checker: &mut ConfigurationChecker<'_>, start: &[f64]| {
            begins_here || checker.is_free(start)
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
            if follows(world, &group, height, &start, &stations, &mut checker) {
                return Some(WaysStart {
                    torso: height,
                    arms: arms_of(world, &sides, &start),
                });
            }
        }
    }
    None
}

/// Whether it is certain that the arm does not reach the pose with the torso at a height (m).
fn misses(task: &PoseGoalTask<'_>, side: Side, tool: &Pose, height: f64) -> bool {
    let kinematics = &task.body().arm(side).kinematics;
    kinematics.surely_misses(&task.wrist(side, tool, height))
}

/// The poses of all hands at each station of their ways, from where they are if the ways begin there.
fn stations(
    world: &World,
    ways: &[(Side, Vec<Pose>)],
    begins_here: bool,
) -> Vec<Vec<(Side, Pose)>> {
    let count = ways.iter().map(|(_, poses)| poses.len()).min().unwrap_or(0);
    let now = begins_here.then(|| {
        let hands = ways.iter();
        hands
            .map(|(side, _)| (*side, tcp_in_base(world, *side)))
            .collect()
    });
    let poses = (0..count).map(|i| {
        let hands = ways.iter();
        hands
            .filter_map(|(side, poses)| Some((*side, *poses.get(i)?)))
            .collect()
    });
    now.into_iter().chain(poses).collect()
}

/// The positions of each arm's joints, out of those of torso and arms.
fn arms_of(world: &World, sides: &[Side], positions: &[f64]) -> Vec<Vec<f64>> {
    let mut end = positions.len();
    let mut arms: Vec<Vec<f64>> = Vec::new();
    for side in sides.iter().rev() {
        let joints = world.models().description.arm(*side).joints().len();
        let start = end.saturating_sub(joints);
        arms.push(positions.get(start..end).unwrap_or_default().to_vec());
        end = start;
    }
    arms.reverse();
    arms
}

/// Whether the joints can follow the lines between stations from a configuration at the first.
fn follows(
    world: &World,
    group: &PlanningGroup,
    height: f64,
    start: &[f64],
    stations: &[Vec<(Side, Pose)>],
    checker: &mut ConfigurationChecker<'_>,
) -> bool {
    let hands = stations.iter().take(1).flatten();
    let joints = hands.map(|(side, _)| world.models().description.arm(*side).joints().len());
    let torso_moves = start.len() > joints.sum::<usize>();
    let mut at = start.to_vec();
    for line in stations.windows(2) {
        let [from, to] = line else { return false };
        let lines = from.iter().zip(to);
        let task = CartesianTask {
            models: world.models(),
            robot: world.robot_configuration().clone(),
            group: group.clone(),
            lines: lines
                .map(|((side, from), (_, to))| CartesianLine {
                    side: *side,
                    from: *from,
                    to: *to,
                })
                .collect(),
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
