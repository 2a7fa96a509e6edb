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

/// Why a motion that was tried cannot be.
pub(super) enum Misfit {
    /// It fails.
    Fails(Box<MotionFailure>),
    /// It would let something fail that goes on already.
    Disturbs,
}

/// Carries out a motion in a copy of the world, together with others that go on there. May be abandoned by an interrupt,
/// as searches are.
pub(super) fn try_motion(
    world: &World,
    mut motion: Box<dyn Motion>,
    mut companions: Vec<Box<dyn Motion>>,
) -> Result<Trial, Misfit> {
    let mut world = world.clone();
    let mut begun = None;
    let mut trace = vec![world.robot_configuration().clone()];
    let steps = (MAX_SECONDS / STEP_SECONDS) as usize;
    while trace.len() < steps {
        interruption::look();
        let mut disturbs = false;
        companions.retain_mut(|companion| match companion.tick(&mut world) {
            MotionStatus::Running => true,
            MotionStatus::Done(_) => false,
            MotionStatus::Failed(_) => {
                disturbs = true;
                false
            }
        });
        if disturbs {
            return Err(Misfit::Disturbs);
        }
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
            MotionStatus::Failed(failure) => return Err(Misfit::Fails(failure)),
        }
        trace.push(world.robot_configuration().clone());
        world.step();
    }
    let module = motion.module();
    Err(Misfit::Fails(Box::new(MotionFailure::Stalled { module })))
}
