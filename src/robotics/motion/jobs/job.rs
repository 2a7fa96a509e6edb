//! What all motions have in common: a job that is polled once per simulation step.

use nalgebra::Point3;

use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::trajectories::planned_trajectory::PlannedTrajectory;
use crate::world::{BodyName, World};
use spatial::Pose;

/// The result of a motion.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionOutcome {
    /// The goal is reached.
    Arrived,
    /// Objects that the camera sees.
    Detected(Vec<DetectedObject>),
    /// Both fingers press on the object, or on a handle.
    Gripped {
        /// Name of the object, or of the handle.
        object: String,
    },
    /// A held object was put down.
    Put {
        /// What carries it; `None` if nothing was met below the goal.
        support: Option<BodyName>,
        /// How much higher (m) than its goal the hand is; negative below the goal. Retract poses
        /// derived from the same goal must be raised by the same amount.
        raised: f64,
    },
    /// An object was released.
    Released {
        /// Name of the object.
        object: String,
        /// Whether it came to rest in time.
        at_rest: bool,
    },
}

/// An object that a camera sees.
#[derive(Clone, Debug, PartialEq)]
pub struct DetectedObject {
    /// Name in the world.
    pub name: String,
    /// Type in the object library.
    pub type_name: String,
    /// Pose in the frame of the robot's base.
    pub pose_in_base: Pose,
    /// Pose in the map frame.
    pub pose_in_map: Pose,
}

/// The status of a motion after a tick.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionStatus {
    /// The motion continues.
    Running,
    /// It has succeeded.
    Done(MotionOutcome),
    /// It has failed; the robot is at rest.
    Failed(Box<MotionFailure>),
}

/// Fails if one of the numbers is infinite or NaN.
pub(super) fn check_finite(module: ProcessModule, goal: &[f64]) -> Result<(), MotionFailure> {
    let finite = goal.iter().all(|v| v.is_finite());
    if finite {
        Ok(())
    } else {
        Err(MotionFailure::NotFinite { module })
    }
}

/// Components of the position and quaternion of a pose.
pub(super) fn numbers_of(pose: &Pose) -> Vec<f64> {
    pose.translation
        .vector
        .iter()
        .chain(pose.rotation.coords.iter())
        .copied()
        .collect()
}

impl MotionStatus {
    /// The status for that failure.
    pub(super) fn failed(failure: MotionFailure) -> Self {
        Self::Failed(Box::new(failure))
    }
}

/// What a motion is doing, for a progress line.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// The activity, such as "driving".
    pub what: &'static str,
    /// The fraction that is done, 0..1.
    pub fraction: f64,
}

/// A motion of the robot as a job that is polled step by step.
///
/// `tick` is called once before every [`World::step`] until it returns something other than
/// [`MotionStatus::Running`]; planning happens in the first tick. Several jobs of different
/// modules may be active at once; they are polled one after another in a fixed order.
pub trait Motion {
    /// The part of the robot that the job uses exclusively.
    fn module(&self) -> ProcessModule;

    /// Sets the robot's joints for the next step, or reports the end.
    fn tick(&mut self, world: &mut World) -> MotionStatus;

    /// Ends the job: later ticks do nothing. What it has set in motion comes to a stop by
    /// [`Self::brake`].
    fn cancel(&mut self);

    /// Whether the robot is moving, so that it has to brake before the job may be left alone.
    fn is_moving(&self) -> bool;

    /// Instead of a tick: sets the robot's joints for a step of braking, within the limits of
    /// acceleration. A job that has not been cancelled goes on with the next tick.
    fn brake(&mut self, world: &mut World);

    /// What the job is doing.
    fn progress(&self) -> Progress;

    /// The trajectory that the job follows, once it is planned, for display.
    fn planned(&self) -> Option<PlannedTrajectory<'_>>;

    /// A copy of the job as it is now; `None` if there cannot be two of it.
    fn copied(&self) -> Option<Box<dyn Motion>>;

    /// Whether it is not the robot of the world here that moves: braking takes real time then, and no steps.
    fn is_elsewhere(&self) -> bool {
        false
    }

    /// The point (m) of the map at which the job aims the head, if it does so.
    fn aims_at(&self, _: &World) -> Option<Point3<f64>> {
        None
    }

    /// The pose in the map to which the job drives the base, if it does so.
    fn drives_to(&self) -> Option<Pose> {
        None
    }

    /// The force (N) of each finger that the job closes around something, if it says so.
    fn grip_effort(&self) -> Option<f64> {
        None
    }

    /// A copy to restore, if the next tick may plan and so be abandoned half-way (see
    /// [`crate::motion::interruption`]).
    fn before_planning(&self) -> Option<Box<dyn Motion>>;
}

/// What one kind of motion does, step by step, from its start to its end.
pub(crate) trait Activity: Clone + 'static {
    /// The part of the robot that it uses exclusively.
    const MODULE: ProcessModule;

    /// Sets the robot's joints for the next step, or reports the end.
    fn step(&mut self, world: &mut World) -> Option<MotionStatus>;

    /// What it is doing.
    fn progress(&self) -> Progress;

    /// Whether the robot would not be at rest if there were no further step.
    fn is_moving(&self) -> bool {
        false
    }

    /// Sets the robot's joints for a step of braking.
    fn brake(&mut self, _: &mut World) {}

    /// The trajectory that it follows, once it is planned.
    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        None
    }

    /// Whether the next step may search for a path, which may take seconds.
    fn may_search(&self) -> bool {
        false
    }

    /// The point (m) of the map at which it aims the head.
    fn aims_at(&self, _: &World) -> Option<Point3<f64>> {
        None
    }

    /// The pose in the map to which it drives the base.
    fn drives_to(&self) -> Option<Pose> {
        None
    }

    /// The force (N) of each finger that it closes around something.
    fn grip_effort(&self) -> Option<f64> {
        None
    }
}

/// An activity as a job: it ends once and does nothing afterwards.
#[derive(Clone, Debug)]
pub struct Job<A> {
    pub(super) activity: A,
    has_ended: bool,
}

impl<A> Job<A> {
    /// A job that starts the activity.
    pub(crate) fn begin(activity: A) -> Self {
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

    fn is_moving(&self) -> bool {
        self.activity.is_moving()
    }

    fn brake(&mut self, world: &mut World) {
        self.activity.brake(world);
    }

    fn progress(&self) -> Progress {
        self.activity.progress()
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        self.activity.planned()
    }

    fn copied(&self) -> Option<Box<dyn Motion>> {
        Some(Box::new(self.clone()))
    }

    fn aims_at(&self, world: &World) -> Option<Point3<f64>> {
        self.activity.aims_at(world)
    }

    fn drives_to(&self) -> Option<Pose> {
        self.activity.drives_to()
    }

    fn grip_effort(&self) -> Option<f64> {
        self.activity.grip_effort()
    }

    fn before_planning(&self) -> Option<Box<dyn Motion>> {
        let may_search = !self.has_ended && self.activity.may_search();
        may_search.then(|| Box::new(self.clone()) as Box<dyn Motion>)
    }
}
