//! Putting a held object down.
//!
//! The hand moves slowly and straight to the goal, if need be from another posture, and stops as soon as something carries the
//! object: before the goal if the surface is higher, below the goal if it is lower. If nothing
//! within reach below the goal would carry the object, or if it would not stand there, the hand
//! does not even begin, and keeps the object.

use super::job::{Job, MotionOutcome, check_finite, numbers_of};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use super::move_tcp::{PoseGoal, in_base, missed};
use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::holding::held_objects;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::cartesian_path::tcp_in_base;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::planning::pose_goal::{PathSearch, PoseGoalTask};
use crate::motion::planning::put_plan::{PutMotion, PutPlan, no_way_down, nothing_below};
use crate::robot::{LinkId, Side};
use crate::world::{BodyName, CollisionHit, World};

/// How far (m) below the goal to look for a surface.
const DEPTH: f64 = 0.05;
/// Force (N) above which something counts as carrying the object.
const CARRIED: f64 = 0.5;
/// The fraction of the trajectory during which the surface the object stood on is ignored.
const LEAVING: f64 = 0.1;

/// Puts down what a hand holds.
pub type Put = Job<JointMotion<PutGoal>>;

/// The goal of putting down a held object.
#[derive(Clone, Debug)]
pub struct PutGoal {
    side: Side,
    /// Pose of the tool.
    pose: PoseGoal,
    /// Name of the object that the hand holds.
    object: String,
    /// Whether the arm first moves to where it can begin.
    is_detour: bool,
    /// Whether the goal has got the errors of the robot.
    has_erred: bool,
}

impl Put {
    /// Puts the object down with the tool centre point at the pose.
    pub fn new(side: Side, pose: PoseGoal) -> Self {
        Self::begin(JointMotion::to(PutGoal {
            side,
            pose,
            object: String::new(),
            is_detour: false,
            has_erred: false,
        }))
    }
}

impl PutGoal {
    /// What carries the object, if anything does.
    fn support(&self, world: &World) -> Option<BodyName> {
        let forces = world.carrying_forces(&self.object).ok()?;
        let most = forces
            .into_iter()
            .max_by(|a, b| a.force.total_cmp(&b.force))?;
        (most.force > CARRIED).then_some(most.body)
    }

    fn outcome(&self, world: &World, support: Option<BodyName>) -> MotionOutcome {
        let base = world.believed_base();
        let hand = tcp_in_base(world, self.side);
        let raised = hand.translation.z - in_base(self.pose, &base).translation.z;
        MotionOutcome::Put { support, raised }
    }
}

impl JointGoal for PutGoal {
    const MODULE: ProcessModule = ProcessModule::Arms;
    const BLOCKED_TIMEOUT: f64 = 0.3;
    const MAX_PLANS: u32 = 3;
    const SEARCHES: bool = true;

    fn what(&self) -> &'static str {
        "putting down"
    }

    fn err(&mut self, world: &mut World) {
        if !self.has_erred {
            self.has_erred = true;
            self.pose = missed(self.pose, self.side, world);
        }
    }

    fn plan(&mut self, world: &World, plans: u32) -> Result<JointPlan, MotionFailure> {
        let side = self.side;
        let held = held_objects(world, side).into_iter().next();
        self.object = held.ok_or(MotionFailure::HoldsNothing { side })?;
        let goal = in_base(self.pose, &world.believed_base());
        check_finite(Self::MODULE, &numbers_of(&goal))?;
        let goals = vec![(side, goal)];
        let contacts = ExpectedContacts::of(
            world,
            [side].into_iter(),
            CollisionMode::AllowAll,
            Some(&self.object),
        );
        let task = PoseGoalTask {
            world,
            goals,
            contacts,
            search: PathSearch::Long,
            leaves_room: false,
        };
        let plan = PutPlan {
            task,
            side,
            object: &self.object,
            depth: DEPTH,
        };
        let (plan, is_detour) = match plan.plan(plans)? {
            PutMotion::Down(plan) => (plan, false),
            PutMotion::Detour(plan) => (plan, true),
        };
        self.is_detour = is_detour;
        Ok(plan)
    }

    fn carriers(&self, world: &World) -> Vec<LinkId> {
        vec![world.models().description.arm(self.side).gripper.palm]
    }

    fn met(&self, world: &World, fraction: f64) -> Option<MotionOutcome> {
        let is_down = !self.is_detour && fraction > LEAVING;
        let support = self.support(world).filter(|_| is_down)?;
        Some(self.outcome(world, Some(support)))
    }

    /// What was to carry the object is not there, or the way down begins here.
    fn arrived(&mut self, world: &mut World) -> Arrival {
        if self.is_detour {
            return Arrival::Missed(no_way_down(self.side, &self.object));
        }
        match nothing_below(world, &self.object, DEPTH) {
            Ok(failure) => Arrival::Failed(failure),
            Err(error) => Arrival::Failed(MotionFailure::UnknownName(error.to_string())),
        }
    }

    fn blocked(&self, _: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::ArmBlocked { hit: hit.into() }
    }
}
