//! Motions of one process module that run at the same time, such as those of both hands.

use super::job::{Motion, MotionOutcome, MotionStatus, Progress};
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::trajectories::planned_trajectory::PlannedTrajectory;
use crate::world::World;

/// Motions that end together: when all have succeeded, or with the first failure.
pub(crate) struct Together {
    module: ProcessModule,
    running: Vec<Box<dyn Motion>>,
}

impl Together {
    /// Runs the motions, all of that module, together.
    pub(crate) fn new(module: ProcessModule, motions: Vec<Box<dyn Motion>>) -> Self {
        Self {
            module,
            running: motions,
        }
    }
}

impl Motion for Together {
    fn module(&self) -> ProcessModule {
        self.module
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        let mut failure = None;
        self.running.retain_mut(|motion| {
            failure.is_some()
                || match motion.tick(world) {
                    MotionStatus::Running => true,
                    MotionStatus::Done(_) => false,
                    MotionStatus::Failed(why) => {
                        failure = Some(why);
                        false
                    }
                }
        });
        match failure {
            Some(failure) => {
                self.cancel();
                MotionStatus::Failed(failure)
            }
            None if self.running.is_empty() => MotionStatus::Done(MotionOutcome::Arrived),
            None => MotionStatus::Running,
        }
    }

    fn cancel(&mut self) {
        self.running.iter_mut().for_each(|motion| motion.cancel());
    }

    fn is_moving(&self) -> bool {
        self.running.iter().any(|motion| motion.is_moving())
    }

    fn brake(&mut self, world: &mut World) {
        let moving = self.running.iter_mut().filter(|motion| motion.is_moving());
        moving.for_each(|motion| motion.brake(world));
    }

    fn progress(&self) -> Progress {
        let first = self.running.first();
        first.map_or_else(
            || Progress {
                what: "moving",
                fraction: 1.0,
            },
            |motion| motion.progress(),
        )
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        None
    }

    fn copied(&self) -> Option<Box<dyn Motion>> {
        let running = self.running.iter().map(|motion| motion.copied());
        Some(Box::new(Self {
            module: self.module,
            running: running.collect::<Option<_>>()?,
        }))
    }

    fn grip_effort(&self) -> Option<f64> {
        let efforts = self
            .running
            .iter()
            .filter_map(|motion| motion.grip_effort());
        efforts.reduce(f64::min)
    }

    fn before_planning(&self) -> Option<Box<dyn Motion>> {
        None
    }
}
