//! Planning how to put a held object down: where it meets a surface, and a path there.

use super::cartesian_path::{CartesianEnd, CartesianLine, CartesianPath, CartesianTask};
use super::configuration_checker::ConfigurationChecker;
use super::joint_follower::{JointFollower, with_joints};
use super::planning_group::PlanningGroup;
use super::pose_goal::{PoseGoalTask, REASON_STEP};
use super::speeds;
use crate::robot::Side;
use crate::spatial::{Pose, pose};
use crate::world::{AllowedPairs, BodyName};

/// How far (m) the hand may continue below the point where the object meets something.
const PRESS: f64 = 0.004;
/// Steps of bisection of that point, starting from one centimetre between two configurations.
const REFINEMENTS: u32 = 6;
/// How many final configurations at one height are tried.
const CONFIGURATIONS: usize = 6;

/// Plans the path of a hand with an object: straight to the task's only goal, and from there
/// straight down.
pub(super) struct PutPlan<'a> {
    pub(super) task: PoseGoalTask<'a>,
    pub(super) side: Side,
    /// Name of the held object.
    pub(super) object: BodyName,
    /// How far (m) below the goal to look for a surface.
    pub(super) depth: f64,
}

impl PutPlan<'_> {
    /// The path to where the object meets something, or to the goal if it meets nothing.
    pub(super) fn plan(mut self) -> Result<JointFollower, super::failure::MotionFailure> {
        let Some(&(side, goal)) = self.task.goals.first() else {
            return self.task.plan_free();
        };
        let contact = self.contact();
        self.task.goals = vec![(side, contact.unwrap_or(goal))];
        for height in self.task.heights(REASON_STEP) {
            if let Some(follow) = self.plan_at(height, contact.is_some()) {
                return Ok(follow);
            }
        }
        self.task.plan_free()
    }

    fn plan_at(&self, height: f64, presses: bool) -> Option<JointFollower> {
        let group = self.task.group(height);
        let configurations = self.task.configurations(height, &group);
        if configurations.is_empty() {
            return None;
        }
        let mut checker =
            ConfigurationChecker::new(self.task.world, group.joints.clone(), &self.task.contacts);
        let start = group.now(self.task.world);
        let ends = configurations
            .iter()
            .take(CONFIGURATIONS)
            .map(|p| Some(p.positions.as_slice()));
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
            return Some(JointFollower::new(
                group.joints,
                trajectory,
                self.task.contacts.allowed.clone(),
            ));
        }
        None
    }

    /// The pose of the hand at which the object first meets something, whatever the arm
    /// itself would touch on the way.
    fn contact(&self) -> Option<Pose> {
        for height in self.task.heights(REASON_STEP) {
            let group = self.task.group(height);
            let start = group.now(self.task.world);
            let mut task = self.task.line_task(height, &group);
            let (path, met) = task.follow(&start, None, None);
            let to_goal = self.contact_on(&task, &path, &group, &start);
            if to_goal.is_some() {
                return to_goal;
            }
            if !matches!(met, CartesianEnd::Complete) {
                continue;
            }
            lower(&mut task, self.depth);
            let reached = path.points.last()?.clone();
            let (down, _) = task.follow(&reached, None, None);
            return self.contact_on(&task, &down, &group, &reached);
        }
        None
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
                .any(|hit| hit.moving == self.object)
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
