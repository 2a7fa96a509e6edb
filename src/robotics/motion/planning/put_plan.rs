//! Planning how to put a held object down: where it meets a surface, and a path there.

use nalgebra::Translation3;

use super::cartesian_path::{
    CartesianEnd, CartesianLine, CartesianPath, CartesianTask, tcp_in_base,
};
use super::configuration::with_joints;
use super::configuration_checker::ConfigurationChecker;
use super::joint_plan::JointPlan;
use super::planning_group::PlanningGroup;
use super::pose_goal::{PoseGoalTask, REASON_STEP};
use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::trajectories::speeds;
use crate::robot::Side;
use crate::world::{AllowedPairs, World, WorldError};
use spatial::{Pose, pose};

/// How far (m) the hand may continue below the point where the object meets something.
const PRESS: f64 = 0.004;
/// Steps of bisection of that point, starting from one centimetre between two configurations.
const REFINEMENTS: u32 = 6;
/// How far (m) and how much (rad, 5 degrees) an object may move after it has been let go.
const GREATEST_MOTION: f64 = 0.02;
const GREATEST_TILT: f64 = 0.0873;
/// How far (m) above its goal the hand begins anew if it cannot move there from where it is.
const ABOVE: f64 = 0.05;
/// How many detours there may be: other jobs may move the torso or the base meanwhile.
const MAX_DETOURS: u32 = 2;

/// Plans the path of a hand with an object: straight to the task's only goal, and from there
/// straight down.
pub(crate) struct PutPlan<'a> {
    pub(crate) task: PoseGoalTask<'a>,
    pub(crate) side: Side,
    /// Name of the held object.
    pub(crate) object: &'a str,
    /// How far (m) below the goal to look for a surface.
    pub(crate) depth: f64,
}

/// The next motion of putting down.
pub(crate) enum PutMotion {
    /// Straight to where the object meets something on which it will stand.
    Down(JointPlan),
    /// To where such a motion can begin; the object touches nothing.
    Detour(JointPlan),
}

impl PutPlan<'_> {
    /// The next motion, after as many `detours`.
    pub(crate) fn plan(mut self, detours: u32) -> Result<PutMotion, MotionFailure> {
        let Some(&(side, goal)) = self.task.goals.first() else {
            return Err(MotionFailure::HoldsNothing { side: self.side });
        };
        let contact = match self.contact() {
            Meeting::At(contact) => Some(contact),
            Meeting::Nothing => return Err(self.nothing_below_goal(&goal)),
            Meeting::Unknown => None,
        };
        if let Some(contact) = &contact {
            self.check_stand(contact)?;
        }
        let end = contact.unwrap_or(goal);
        self.task.goals = vec![(side, end)];
        for height in self.task.heights(REASON_STEP) {
            if let Some(plan) = self.plan_at(height, contact.is_some()) {
                return Ok(PutMotion::Down(plan));
            }
        }
        let sides = [self.side].into_iter();
        let careful = ExpectedContacts::of(self.task.world, sides, CollisionMode::AvoidAll, None);
        if detours < MAX_DETOURS {
            let above = Translation3::new(0.0, 0.0, ABOVE);
            let starts = [None, Some(above)].into_iter();
            let mut detours = starts.filter_map(|s| self.task.plan_to_start_of_line(s, &careful));
            if let Some(detour) = detours.next() {
                return Ok(PutMotion::Detour(detour));
            }
        }
        Err(no_way_down(self.side, self.object))
    }

    /// Where the object will be, in the map frame, when the tool is at the pose in the frame of
    /// the base.
    fn object_at(&self, tool: &Pose) -> Result<Pose, WorldError> {
        let world = self.task.world;
        let base = world.robot_configuration().base;
        let grip =
            (base * tcp_in_base(world, self.side)).inverse() * world.object_pose(self.object)?;
        Ok(base * tool * grip)
    }

    fn nothing_below_goal(&self, goal: &Pose) -> MotionFailure {
        let at = |pose| nothing_below_at(self.task.world, self.object, &pose, self.depth);
        let failure = self.object_at(goal).and_then(at);
        failure.unwrap_or_else(|error| MotionFailure::UnknownName(error.to_string()))
    }

    /// An error if the object would not stay where it meets something.
    fn check_stand(&self, contact: &Pose) -> Result<(), MotionFailure> {
        let world = self.task.world;
        let unknown = |error: WorldError| MotionFailure::UnknownName(error.to_string());
        let place = self.object_at(contact).map_err(unknown)?;
        let trial = world.stand_trial(self.object, &place).map_err(unknown)?;
        if trial.moved <= GREATEST_MOTION && trial.tilt <= GREATEST_TILT {
            return Ok(());
        }
        let t = place.translation;
        Err(MotionFailure::WouldNotStand {
            object: self.object.to_owned(),
            place: [t.x, t.y, t.z],
            trial: Box::new(trial),
        })
    }

    fn plan_at(&self, height: f64, presses: bool) -> Option<JointPlan> {
        let group = self.task.group(height);
        let configurations = self.task.configurations(height, &group);
        if configurations.is_empty() {
            return None;
        }
        let mut checker = self.task.checker(&group, &self.task.contacts);
        let start = group.now(self.task.world);
        let ends = configurations.iter().map(|p| Some(p.positions.as_slice()));
        let mut task = self.task.line_task(height, &group);
        for end in std::iter::once(None).chain(ends) {
            let (mut path, met) = task.follow(&start, end, Some(&mut checker));
            if !matches!(met, CartesianEnd::Complete) {
                continue;
            }
            if presses {
                lower(&mut task, PRESS);
                append(&mut path, &task, Some(&mut checker));
            }
            let trajectory =
                self.task
                    .cartesian_trajectory(&path, &group, speeds::PUT, &mut checker);
            return Some(JointPlan::new(
                group.joints,
                trajectory,
                self.task.contacts.allowed.clone(),
            ));
        }
        None
    }

    /// The pose of the hand at which the object first meets something, whatever the arm
    /// itself would touch on the way.
    fn contact(&self) -> Meeting {
        for height in self.task.heights(REASON_STEP) {
            let group = self.task.group(height);
            let start = group.now(self.task.world);
            let mut task = self.task.line_task(height, &group);
            let (path, met) = task.follow(&start, None, None);
            let to_goal = self.contact_on(&task, &path, &group, &start);
            if let Some(pose) = to_goal {
                return Meeting::At(pose);
            }
            if !matches!(met, CartesianEnd::Complete) {
                continue;
            }
            lower(&mut task, self.depth);
            let reached = path.points.last().cloned().unwrap_or_default();
            let (down, met) = task.follow(&reached, None, None);
            match self.contact_on(&task, &down, &group, &reached) {
                Some(below) => return Meeting::At(below),
                None if matches!(met, CartesianEnd::Complete) => return Meeting::Nothing,
                // The arm does not get far enough down from this height.
                None => {}
            }
        }
        Meeting::Unknown
    }

    /// The first contact of the object on the path, refined between two configurations.
    fn contact_on(
        &self,
        task: &CartesianTask<'_>,
        path: &CartesianPath,
        group: &PlanningGroup,
        start: &[f64],
    ) -> Option<Pose> {
        let world = self.task.world;
        let mut checker = world.collision_checker();
        let none = AllowedPairs::none();
        let mut touches = |positions: &[f64]| {
            let there = with_joints(world.robot_configuration(), &group.joints, positions);
            checker
                .all_hits(&there, &none, 0.0)
                .iter()
                .any(|hit| hit.moving.object() == Some(self.object))
        };
        // At the start the object may be standing on something.
        let met =
            (1..path.points.len()).find(|&i| path.points.get(i).is_some_and(|p| touches(p)))?;
        let share = |i: usize| i as f64 / (path.steps as f64).max(1.0);
        let (mut free, mut touching) = (share(met - 1), share(met));
        let seed = path.points.get(met)?;
        for _ in 0..REFINEMENTS {
            let middle = (free + touching) / 2.0;
            match task.configuration(middle, seed, start) {
                Some(configuration) if touches(&configuration) => touching = middle,
                Some(_) => free = middle,
                None => break,
            }
        }
        let line = task.lines.iter().find(|line| line.side == self.side)?;
        Some(pose::between(&line.from, &line.to, touching))
    }
}

/// The failure of an arm that cannot move the object straight to its place.
pub(crate) fn no_way_down(side: Side, object: &str) -> MotionFailure {
    MotionFailure::NoWayDown {
        side,
        object: object.to_owned(),
    }
}

/// Where a held object meets something on its way to the goal and down from there.
enum Meeting {
    /// With the tool at this pose in the frame of the base.
    At(Pose),
    /// Nowhere.
    Nothing,
    /// The arm cannot follow the way.
    Unknown,
}

/// The failure to put down the object where it is now, with nothing below within the depth (m).
pub(crate) fn nothing_below(
    world: &World,
    object: &str,
    depth: f64,
) -> Result<MotionFailure, WorldError> {
    let pose = world.object_pose(object)?;
    nothing_below_at(world, object, &pose, depth)
}

fn nothing_below_at(
    world: &World,
    object: &str,
    pose: &Pose,
    depth: f64,
) -> Result<MotionFailure, WorldError> {
    let t = pose.translation;
    Ok(MotionFailure::NothingBelow {
        object: object.to_owned(),
        place: [t.x, t.y, t.z],
        depth,
        below: world.below(object, pose)?,
    })
}

/// Extends the lines straight down from where they end.
fn lower(task: &mut CartesianTask<'_>, depth: f64) {
    for line in &mut task.lines {
        let mut to = line.to;
        to.translation.z -= depth;
        *line = CartesianLine {
            from: line.to,
            to,
            ..*line
        };
    }
}

/// Follows the lines from the end of the path on, as far as possible.
fn append(
    path: &mut CartesianPath,
    task: &CartesianTask<'_>,
    checker: Option<&mut ConfigurationChecker<'_>>,
) {
    let reached = path.points.last().cloned().unwrap_or_default();
    let so_far = path.lengths.last().copied().unwrap_or(0.0);
    let (more, _) = task.follow(&reached, None, checker);
    path.points.extend(more.points.into_iter().skip(1));
    path.lengths.extend(
        more.lengths
            .into_iter()
            .skip(1)
            .map(|length| so_far + length),
    );
}
