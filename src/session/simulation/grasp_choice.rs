//! Choosing an arm and a grasp for an object from where the robot stands: one that also leads
//! to where the object is to be put down, and to which there is a path.

use super::Simulation;
use super::target_checks::{PlacingTarget, TargetChecks, Way};
use robotics::motion::{
    Candidates, Effort, GraspChoice, GraspChooser, GraspObstacle, GraspQuestion, MotionFailure,
    PathSearch, needed, plan_grasp,
};
use spatial::Pose;

/// Maximum number of grasps for which a path is searched.
const MAX_PATHS: usize = 6;
/// For how many of them it is searched longer, if none is found soon.
const MAX_LONG_SEARCHES: usize = 1;

impl Simulation {
    /// The nearest grasp by which an object can be picked up from where the robot stands, by a
    /// path that the arm finds from its present posture; and put down at the target, if there is
    /// one.
    pub(crate) fn choose_grasp(
        &self,
        question: &GraspQuestion,
        target: Option<&PlacingTarget>,
        base: Option<&Pose>,
    ) -> Result<GraspChoice, MotionFailure> {
        let candidates = Candidates::new(&self.models, &self.grasps, question);
        let chooser = GraspChooser::new(&self.world, question, &candidates);
        let mut paths = 0;
        let mut unsure = Vec::new();
        let here = self.base();
        let mut targets = TargetChecks::default();
        let choice = chooser.choose(base.unwrap_or(&here), Effort::THOROUGH, |choice| {
            if let Some(target) = target {
                let way = Way {
                    side: choice.side,
                    grasp: &choice.grasp,
                    turn: choice.turn,
                };
                targets.check(self, question, target, way)?;
            }
            if base.is_some() {
                return Ok(());
            }
            paths += 1;
            if paths > MAX_PATHS {
                let report = "too many others have none".to_owned();
                return Err(GraspObstacle::NoPath { report });
            }
            self.path_to(question, choice, PathSearch::Short)
                .map_err(|report| {
                    unsure.push(choice.clone());
                    GraspObstacle::NoPath { report }
                })
        });
        choice.or_else(|nothing| {
            // A long search may find what a short one has not.
            let mut unsure = unsure.into_iter().take(MAX_LONG_SEARCHES);
            unsure
                .find(|choice| self.path_to(question, choice, PathSearch::Long).is_ok())
                .ok_or(MotionFailure::NoGrasp(nothing))
        })
    }

    /// Whether a path leads to a grasp, and off again, from where the robot stands; or what the search reports.
    fn path_to(
        &self,
        question: &GraspQuestion,
        choice: &GraspChoice,
        search: PathSearch,
    ) -> Result<(), String> {
        let object = &question.object;
        if let Some(report) = self.vain_paths.known(&self.world, object, choice, search) {
            return Err(report);
        }
        let planned = plan_grasp(
            &self.world,
            choice.side,
            object,
            choice.opening,
            &choice.poses.pregrasp,
            &needed(&choice.poses),
            search,
        );
        planned.map_err(|failure| {
            let report = failure.to_string().lines().collect::<Vec<_>>().join(" ");
            self.vain_paths
                .note(&self.world, object, choice, search, &report);
            report
        })
    }
}
