//! Letting simulated time pass. Any number of motions may wait at once, beside all others.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::jobs::job::{Activity, Job, Motion, MotionOutcome, MotionStatus, Progress};
use crate::world::World;
use crate::world::physics::STEP_SECONDS;

/// Waits.
#[derive(Clone, Debug, PartialEq)]
pub struct Waiting {
    /// How long (s).
    duration: f64,
}

impl Command for Waiting {
    const TYPE: MotionType = MotionType {
        name: "WAITING",
        aliases: &[],
        keys: &[MotionKey::required(
            "DURATION",
            ArgumentKind::Number,
            "how long (s), in simulated time",
        )],
        one_of: &[],
        about: &[],
        is_known_by_keys: false,
        doc: "Lets time pass. Other motions go on meanwhile.",
        example: "(a motion (type waiting) (duration 2))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let duration = arguments.number("DURATION")?;
        if duration < 0.0 {
            return Err(ArgumentError::Negative {
                key: "DURATION",
                number: duration,
            });
        }
        Ok(Self { duration })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(Job::begin(Wait {
            steps: (self.duration / STEP_SECONDS).ceil(),
            passed: 0.0,
        }))
    }
}

/// It counts steps of the world, so that time in which it is suspended does not count.
#[derive(Clone, Debug)]
struct Wait {
    steps: f64,
    passed: f64,
}

impl Activity for Wait {
    const MODULE: ProcessModule = ProcessModule::Clock;

    fn step(&mut self, _: &mut World) -> Option<MotionStatus> {
        // The world takes a step after each of these, after the last one, too.
        self.passed += 1.0;
        let is_over = self.passed >= self.steps;
        is_over.then_some(MotionStatus::Done(MotionOutcome::Arrived))
    }

    fn progress(&self) -> Progress {
        Progress {
            what: "waiting",
            fraction: self.passed / self.steps.max(1.0),
        }
    }
}
