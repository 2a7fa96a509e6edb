//! Choosing an arm and a grasp for an object from where the robot stands: one that also leads
//! to where the object is to be put down, and to which there is a path.

use super::Simulation;
use super::imagined::Imagined;
use robotics::motion::{
    Candidates, Effort, GraspChoice, GraspChooser, GraspObstacle, GraspPart, GraspQuestion,
    HeldGrip, MotionFailure, PathSearch, PutReach, needed, plan_grasp,
};
use robotics::robot::Side;
use robotics::world::World;
use spatial::Pose;

/// Maximum number of grasps for which a path is searched.
const MAX_PATHS: usize = 6;
/// For how many of them it is searched longer, if none is found soon.
const MAX_LONG_SEARCHES: usize = 1;

/// How many base poses at which something is in the way of a few postures are examined again, with
/// more postures, when no other will do.
const MAX_AGAIN: usize = 20;

/// Where an object is to be put down.
#[derive(Clone, Debug)]
pub(crate) struct PlacingTarget {
    /// Pose of the object in the map frame.
    pub pose: Pose,
    /// The base pose in the map frame; if there is none, any around the target will do.
    pub base: Option<Pose>,
}

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
                targets.check(self, question, target, choice)?;
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
                .map_err(|failure| {
                    unsure.push(choice.clone());
                    GraspObstacle::NoPath {
                        report: failure.to_string().lines().collect::<Vec<_>>().join(" "),
                    }
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

    /// Whether a path leads to a grasp, and off again, from where the robot stands.
    fn path_to(
        &self,
        question: &GraspQuestion,
        choice: &GraspChoice,
        search: PathSearch,
    ) -> Result<(), MotionFailure> {
        plan_grasp(
            &self.world,
            choice.side,
            &question.object,
            choice.opening,
            &choice.poses.pregrasp,
            &needed(&choice.poses),
            search,
        )
    }
}

/// The world with an object at its target, and the base poses from which it may be put down.
struct AtTarget {
    world: World,
    bases: Vec<Pose>,
}

/// Whether an object can be put down at its target, for each hand and grasp for which that has been
/// asked. How the grasp is turned does not matter, since a round object may be turned there, too.
#[derive(Default)]
struct TargetChecks {
    done: Vec<(Side, String, Result<(), GraspObstacle>)>,
    /// The world with the object at its target, as it is for each hand, and where the robot could
    /// stand there.
    there: [Option<Option<AtTarget>>; 2],
}

impl TargetChecks {
    /// Whether the object can be put down at the target with the grasp.
    fn check(
        &mut self,
        simulation: &Simulation,
        question: &GraspQuestion,
        target: &PlacingTarget,
        choice: &GraspChoice,
    ) -> Result<(), GraspObstacle> {
        let mut done = self.done.iter();
        let known = done.find(|(side, grasp, _)| *side == choice.side && *grasp == choice.grasp);
        if let Some((_, _, known)) = known {
            return known.clone();
        }
        let checked = self
            .test(simulation, question, target, choice)
            .map_err(|obstacle| GraspObstacle::NotAtTarget {
                obstacle: Box::new(obstacle),
            });
        self.done
            .push((choice.side, choice.grasp.clone(), checked.clone()));
        checked
    }

    fn test(
        &mut self,
        simulation: &Simulation,
        question: &GraspQuestion,
        target: &PlacingTarget,
        choice: &GraspChoice,
    ) -> Result<(), GraspObstacle> {
        let there = self.there[choice.side.index()]
            .get_or_insert_with(|| simulation.at_target(question, target, choice.side));
        let Some(AtTarget { world, bases }) = there else {
            return Err(GraspObstacle::NoPath {
                report: "something else is there".to_owned(),
            });
        };
        let part = GraspPart::Grasp;
        let nowhere = GraspObstacle::OutOfReach { part };
        let kind = &question.kind;
        let Some(grasp) = simulation.definition(kind, choice.side, &choice.grasp) else {
            return Err(nowhere);
        };
        let object = (question.object.as_str(), kind.as_str());
        let opening = simulation.grasps.opening(kind, &grasp);
        let (models, turn) = (&simulation.models, choice.turn);
        let grip = HeldGrip::by(models, choice.side, object, &grasp, turn, opening);
        let Ok(grip) = grip else {
            return Err(nowhere);
        };
        let Ok(put) = PutReach::new(world, &grip) else {
            return Err(nowhere);
        };
        let mut obstacle = nowhere;
        let mut again = Vec::new();
        for base in bases.iter().filter(|base| put.is_near(base)) {
            match put.with_base_at(base, Effort::QUICK) {
                Ok(_) => return Ok(()),
                Err(GraspObstacle::OutOfReach { .. }) => {}
                Err(other) => {
                    obstacle = other;
                    again.push(base);
                }
            }
        }
        let mut again = again.into_iter().take(MAX_AGAIN);
        match again.any(|base| put.with_base_at(base, Effort::PATIENT).is_ok()) {
            true => Ok(()),
            false => Err(obstacle),
        }
    }
}

impl Simulation {
    /// The world with the object at its target, and the base poses from which it may be put down;
    /// `None` if something else is there.
    fn at_target(
        &self,
        question: &GraspQuestion,
        target: &PlacingTarget,
        side: Side,
    ) -> Option<AtTarget> {
        let imagined = Imagined {
            object: &question.object,
            object_pose: Some(target.pose),
            base_pose: None,
            side,
            opening: f64::INFINITY,
        };
        let mut world = imagined.world(&self.world).ok()??;
        world.teleport_robot(self.world.robot_configuration());
        let stands = world.object_pose(&question.object).ok()?;
        let bases = match &target.base {
            Some(base) => vec![*base],
            None => self.places_around(&stands),
        };
        Some(AtTarget { world, bases })
    }
}
