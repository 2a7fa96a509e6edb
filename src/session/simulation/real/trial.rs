//! Trying a motion in a copy of the world.

use robotics::motion::{Motion, MotionFailure, MotionOutcome, MotionStatus, interruption};
use robotics::world::physics::STEP_SECONDS;
use robotics::world::{RobotConfiguration, World};

/// How long (s) a motion may take.
const MAX_SECONDS: f64 = 600.0;

/// What has come of a motion that was tried.
pub(super) struct Trial {
    /// How the robot was in each step, from before the first one on.
    pub(super) trace: Vec<RobotConfiguration>,
    /// What the motion has led to.
    pub(super) outcome: MotionOutcome,
    /// The world then.
    pub(super) world: World,
    /// The motion after its first step, so that nothing is planned twice; `None` if it ended with that.
    pub(super) begun: Option<Box<dyn Motion>>,
}

/// Carries out a motion in a copy of the world. May be abandoned by an interrupt, as searches are.
pub(super) fn try_motion(
    world: &World,
    mut motion: Box<dyn Motion>,
) -> Result<Trial, Box<MotionFailure>> {
    let mut world = world.clone();
    let mut begun = None;
    let mut trace = vec![world.robot_configuration().clone()];
    let steps = (MAX_SECONDS / STEP_SECONDS) as usize;
    while trace.len() < steps {
        interruption::look();
        match motion.tick(&mut world) {
            MotionStatus::Running if trace.len() == 1 => begun = motion.copied(),
            MotionStatus::Running => {}
            MotionStatus::Done(outcome) => {
                trace.push(world.robot_configuration().clone());
                return Ok(Trial {
                    trace,
                    outcome,
                    world,
                    begun,
                });
            }
            MotionStatus::Failed(failure) => return Err(failure),
        }
        trace.push(world.robot_configuration().clone());
        world.step();
    }
    let module = motion.module();
    Err(Box::new(MotionFailure::Stalled { module }))
}
