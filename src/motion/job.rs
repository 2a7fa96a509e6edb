//! What all motions have in common: a job that is polled once per simulation step.

use std::fmt;

use super::failure::MotionFailure;
use super::trajectory::Trajectory;
use crate::robot::JointId;
use crate::spatial::Pose;
use crate::world::{BodyName, World};

/// The part of the robot that a motion needs for itself. At most one job per module may be
/// active at a time; jobs of different modules write different joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum ProcessModule {
    /// The base.
    Navigation,
    /// The torso lift.
    Torso,
    /// Pan and tilt of the head.
    Neck,
    /// The cameras.
    Perception,
    /// The fingers of both hands.
    Grippers,
    /// Both arms, and the torso when a hand's goal needs another height.
    Arms,
    /// Nothing of the robot: any number of jobs may only let time pass.
    Clock,
}

impl ProcessModule {
    /// Must a job of this module wait for one of the other?
    pub(crate) fn excludes(self, other: ProcessModule) -> bool {
        self == other && self != Self::Clock
    }
}

impl fmt::Display for ProcessModule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Navigation => "navigation",
            Self::Torso => "torso",
            Self::Neck => "neck",
            Self::Perception => "perception",
            Self::Grippers => "grippers",
            Self::Arms => "arms",
            Self::Clock => "clock",
        })
    }
}

/// What a motion has brought about.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MotionOutcome {
    /// The goal is reached.
    Arrived,
    /// Objects that the camera sees.
    Detected(Vec<DetectedObject>),
    /// Both fingers press on the object.
    Gripped {
        /// Name of the object.
        object: String,
    },
    /// A held object was put down as far as something carries it.
    Put {
        /// What carries it; `None` when nothing was met below the goal.
        support: Option<BodyName>,
        /// How much higher (m) than its goal the hand is; negative below the goal. Poses for
        /// retracting that were derived from the same goal must be raised by as much.
        raised: f64,
    },
    /// An object was let go.
    Released {
        /// Name of the object.
        object: String,
        /// Whether it came to rest in time.
        at_rest: bool,
    },
}

/// An object that a camera sees.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DetectedObject {
    /// Name in the world.
    pub(crate) name: String,
    /// Type in the object library.
    pub(crate) type_name: String,
    /// Pose in the frame of the robot's base.
    pub(crate) pose_in_base: Pose,
    /// Pose in the map frame.
    pub(crate) pose_in_map: Pose,
}

/// How a motion stands after a tick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum MotionStatus {
    /// It goes on.
    Running,
    /// It has ended well.
    Done(MotionOutcome),
    /// It has ended otherwise; the robot is at rest.
    Failed(Box<MotionFailure>),
}

/// Fails when one of the numbers is infinite or none.
pub(super) fn check_finite(module: ProcessModule, goal: &[f64]) -> Result<(), MotionFailure> {
    let finite = goal.iter().all(|v| v.is_finite());
    if finite {
        Ok(())
    } else {
        Err(MotionFailure::NotFinite { module })
    }
}

/// Position and quaternion of a pose as numbers.
pub(super) fn numbers_of(pose: &Pose) -> Vec<f64> {
    pose.translation
        .vector
        .iter()
        .chain(pose.rotation.coords.iter())
        .copied()
        .collect()
}

impl MotionStatus {
    /// The end with that failure.
    pub(super) fn failed(failure: MotionFailure) -> Self {
        Self::Failed(Box::new(failure))
    }
}

/// What a motion is doing, for a line that shows it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Progress {
    /// What is going on, such as "driving".
    pub(crate) what: &'static str,
    /// How much of it is done, 0..1.
    pub(crate) fraction: f64,
}

/// A motion of the robot as a job that is advanced step by step.
///
/// `tick` is called once before every [`World::step`] until it returns something else than
/// [`MotionStatus::Running`]; planning happens in the first tick. Several jobs of different
/// modules may be active at once; they are polled one after the other in a fixed order.
pub(crate) trait Motion {
    /// The part of the robot that the job needs for itself.
    fn module(&self) -> ProcessModule;

    /// Sets the robot's joints for the next step, or reports the end.
    fn tick(&mut self, world: &mut World) -> MotionStatus;

    /// Ends the job at once. The robot stays where it is, at rest; later ticks do nothing.
    fn cancel(&mut self);

    /// What the job is doing.
    fn progress(&self) -> Progress;

    /// The trajectory that it follows, once that is planned, for those who want to see it.
    fn planned(&self) -> Option<PlannedTrajectory<'_>>;

    /// A copy to go back to, when the next tick may plan and so be given up half-way (see
    /// [`super::interruption`]).
    fn before_planning(&self) -> Option<Box<dyn Motion>>;
}

/// What one kind of motion does, step by step, from its start to its end.
pub(crate) trait Activity: Clone + 'static {
    /// The part of the robot that it needs for itself.
    const MODULE: ProcessModule;

    /// Sets the robot's joints for the next step; or says how it has ended.
    fn step(&mut self, world: &mut World) -> Option<MotionStatus>;

    /// What it is doing.
    fn progress(&self) -> Progress;

    /// The trajectory that it follows, once that is planned.
    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        None
    }

    /// Whether the next step may search for a path, which may take seconds.
    fn may_search(&self) -> bool {
        false
    }
}

/// An activity as a job: it ends once, and does nothing afterwards.
#[derive(Clone, Debug)]
pub(crate) struct Job<A> {
    pub(super) activity: A,
    has_ended: bool,
}

impl<A> Job<A> {
    /// The activity at its start.
    pub(super) fn begin(activity: A) -> Self {
        Self {
            activity,
            has_ended: false,
        }
    }
}

impl<A: Activity> Motion for Job<A> {
    fn module(&self) -> ProcessModule {
        A::MODULE
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        if self.has_ended {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        match self.activity.step(world) {
            None => MotionStatus::Running,
            Some(end) => {
                self.has_ended = true;
                end
            }
        }
    }

    fn cancel(&mut self) {
        self.has_ended = true;
    }

    fn progress(&self) -> Progress {
        self.activity.progress()
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        self.activity.planned()
    }

    fn before_planning(&self) -> Option<Box<dyn Motion>> {
        let may_search = !self.has_ended && self.activity.may_search();
        may_search.then(|| Box::new(self.clone()) as Box<dyn Motion>)
    }
}

/// A trajectory that was planned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlannedTrajectory<'a> {
    /// What the numbers of the trajectory mean.
    pub(crate) axes: TrajectoryAxes<'a>,
    /// Where the axes are when.
    pub(crate) trajectory: &'a Trajectory,
}

/// What moves along a trajectory.
#[derive(Clone, Copy, Debug)]
pub(crate) enum TrajectoryAxes<'a> {
    /// The base: x, y (m) and heading (rad) in the map.
    Base,
    /// Joints (rad or m); axes of the trajectory beyond them move nothing.
    Joints(&'a [JointId]),
}
