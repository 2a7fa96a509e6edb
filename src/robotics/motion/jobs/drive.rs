//! Driving the base to a pose in the map, around what is in the way.
//!
//! The goal is checked first, then a path is searched for the robot in its present posture
//! and with what it holds. Other jobs may move arms and torso meanwhile. While they do, the
//! base keeps a larger distance from everything ahead; where it cannot, it slows down and
//! stops, and continues once the posture is steady. If the path has become blocked, it then
//! plans another one. Whatever ends a drive before its goal, the base brakes first, within its
//! limits of acceleration; only a step that would collide is not taken.

use super::job::{Activity, Job, MotionOutcome, MotionStatus, Progress, check_finite};
use super::replanning::{Attempt, Replanning};
use crate::motion::contact::guard;
use crate::motion::contact::pushing::Pushing;
use crate::motion::failure::base_place::BasePlace;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::base_checker::BaseChecker;
use crate::motion::planning::base_path::MIN_MARGIN;
use crate::motion::planning::configuration::at_place;
use crate::motion::planning::drive_plan::plan_drive;
use crate::motion::trajectories::axis_group::AxisGroup;
use crate::motion::trajectories::planned_trajectory::{PlannedTrajectory, TrajectoryAxes};
use crate::motion::trajectories::trajectory::Trajectory;
use crate::motion::trajectories::trajectory_follower::TrajectoryFollower;
use crate::robot::JointId;
use crate::robot::description::DriveKind;
use crate::world::physics::STEP_SECONDS;
use crate::world::{AllowedPairs, CollisionHit, MovingParts, Pairs, RobotConfiguration, World};
use spatial::{Pose, pose};

/// Times ahead (s) at which the path is checked: beyond the one that it takes to stop.
const LOOK_AHEAD: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
/// Steps between two such checks while the posture changes or something is in the way, and
/// otherwise.
const LOOK_EVERY: u32 = 12;
const LOOK_SOMETIMES: u32 = 24;
/// Clearance (m) that is kept ahead while the posture changes.
const CHANGING_MARGIN: f64 = 0.10;
/// How many times the base slows down for that reason.
const MAX_YIELDS: u32 = 3;
/// A posture is steady when it has not changed for this long (s).
const STEADY: f64 = 0.05;
/// How long (s) the robot may stand still without a path before the drive fails: if there has
/// been none yet, and if there was one that became blocked. The arms wait less long, so that
/// they get out of the way.
const FIRST_TIMEOUT: f64 = 0.1;
const LATER_TIMEOUT: f64 = 1.0;
/// How many paths are found, and then blocked, before giving up.
const MAX_PLANS: u32 = 8;

/// Drives the base to a pose.
pub type Drive = Job<BaseMotion>;

/// A motion of the base to a pose.
#[derive(Clone, Debug)]
pub struct BaseMotion {
    goal: BasePlace,
    follower: Option<TrajectoryFollower>,
    /// The world's step when the base began to move.
    began: Option<u64>,
    /// Torso and arm joints in the last tick, and for how long (s) they have not changed.
    posture: Vec<f64>,
    steady: f64,
    ticks: u32,
    /// What the robot would come too close to on the path ahead.
    ahead: Option<CollisionHit>,
    /// Why the drive ends as soon as the base has stopped.
    trouble: Option<MotionFailure>,
    pushing: Pushing,
    /// How many times the base has slowed down because of a changing posture.
    yields: u32,
    /// Whether the posture was steady when that was found.
    ahead_is_sure: bool,
    /// Number of paths found so far.
    plans: u32,
    /// How far the base is beside where the robot takes it to be at the end of the path, and at its
    /// beginning: x, y (m) and heading (rad).
    drift: BasePlace,
    former_drift: BasePlace,
    replanning: Replanning,
}

impl Drive {
    /// Drives to the pose in the map frame, of which only x, y and the heading count.
    pub fn new(goal: &Pose) -> Self {
        let t = goal.translation;
        Self::begin(BaseMotion {
            goal: [t.x, t.y, pose::yaw(goal)],
            follower: None,
            began: None,
            posture: Vec::new(),
            steady: 0.0,
            ticks: 0,
            ahead: None,
            trouble: None,
            pushing: Pushing::default(),
            yields: 0,
            ahead_is_sure: false,
            plans: 0,
            drift: [0.0; 3],
            former_drift: [0.0; 3],
            replanning: Replanning::default(),
        })
    }
}

impl BaseMotion {
    fn watch_posture(&mut self, world: &World) {
        let joints = &world.robot_configuration().joints;
        let posture: Vec<f64> = posture_joints(world).map(|j| joints.get(j)).collect();
        self.steady = if posture == self.posture {
            self.steady + STEP_SECONDS
        } else {
            0.0
        };
        self.posture = posture;
    }

    fn is_steady(&self) -> bool {
        self.steady >= STEADY
    }

    /// A trajectory, and the length of its path (m).
    fn plan(&self, world: &World) -> Result<(TrajectoryFollower, f64), MotionFailure> {
        check_finite(ProcessModule::Navigation, &self.goal)?;
        let path = plan_drive(world, self.goal)?;
        let base = &world.models().description.base;
        let drive = AxisGroup {
            axes: 0..2,
            velocity: base.drive.velocity,
            acceleration: base.drive.acceleration,
        };
        let turn = AxisGroup::single(2, base.turn.velocity, base.turn.acceleration);
        let limits = [drive, turn];
        let points: Vec<Vec<f64>> = path.iter().map(|p| p.to_vec()).collect();
        let mut checker = BaseChecker::new(world);
        let mut is_free = |place: &[f64]| {
            let place = <BasePlace>::try_from(place);
            place.is_ok_and(|place| checker.blocked(&place, MIN_MARGIN).is_none())
        };
        let trajectory = match base.kind {
            DriveKind::Omnidirectional | DriveKind::Fixed => {
                Trajectory::rounded(&points, &limits, &mut is_free)
            }
            // It stops between driving and turning.
            DriveKind::Differential => Trajectory::new(&points, &limits),
        };
        Ok((TrajectoryFollower::new(trajectory), length_of(&path)))
    }

    /// Searches for a path; what is in the way while the posture changes may be gone later.
    fn try_plan(&mut self, world: &World) -> Option<MotionStatus> {
        let timeout = if self.plans == 0 {
            FIRST_TIMEOUT
        } else {
            LATER_TIMEOUT
        };
        match self.replanning.next(world, timeout) {
            Attempt::Later => return None,
            Attempt::GiveUp(failure) => return Some(MotionStatus::failed(failure)),
            Attempt::Now => {}
        }
        match self.plan(world) {
            Ok((follower, way)) => {
                self.plans += 1;
                self.replanning.reset();
                self.ahead = None;
                self.follower = Some(follower);
                if let Some(noise) = world.noise() {
                    self.former_drift = noise.base_error();
                    self.drift = noise.of_drive(world.steps(), way);
                }
                None
            }
            Err(failure) if failure.may_pass() => {
                self.replanning.failed(world, failure);
                None
            }
            Err(failure) => Some(MotionStatus::failed(failure)),
        }
    }

    /// Checks the path ahead, more often while arms or torso move, or something was in the way.
    fn look_ahead(&mut self, world: &World) {
        let is_calm = self.is_steady() && self.ahead.is_none();
        let every = if is_calm { LOOK_SOMETIMES } else { LOOK_EVERY };
        if !self.ticks.is_multiple_of(every) {
            return;
        }
        let Some(follower) = &self.follower else {
            return;
        };
        // Arms that wait for the base and a base that waits for the arms would creep along
        // together, so the base yields only a few times.
        let yields = !self.is_steady() && self.yields < MAX_YIELDS;
        let margin = if yields {
            CHANGING_MARGIN
        } else {
            -guard::GUARD_DEPTH
        };
        let robot = world.robot_configuration();
        let mut checker = world.collision_checker();
        let moving = MovingParts::of_base(&world.models().robot);
        checker.expect(moving, Pairs::Changing);
        // Ignore what is close already: driving on did not cause that.
        let near = checker.all_hits(robot, &AllowedPairs::none(), margin);
        let allowed = near.into_iter().fold(AllowedPairs::none(), |all, hit| {
            all.and(hit.moving, hit.other)
        });
        let was_free = self.ahead.is_none();
        self.ahead_is_sure = !yields;
        self.ahead = LOOK_AHEAD.iter().find_map(|seconds| {
            checker.first_hit(
                &at_place(robot, &follower.ahead(*seconds)),
                &allowed,
                margin,
            )
        });
        if yields && was_free && self.ahead.is_some() {
            self.yields += 1;
        }
    }

    fn follow(&mut self, world: &mut World) -> Option<MotionStatus> {
        self.look_ahead(world);
        let follower = self.follower.as_mut()?;
        let began = *self.began.get_or_insert(world.steps());
        if self.trouble.is_none() {
            self.trouble = guard::trouble_with_held(world, began, |_| true).or_else(|| {
                let pushed = self.pushing.pushed(world, &AllowedPairs::none())?;
                let goal = self.goal;
                Some(MotionFailure::DrivePushes { goal, pushed })
            });
        }
        if !follower.is_moving()
            && let Some(failure) = self.trouble.take()
        {
            return Some(MotionStatus::failed(failure));
        }
        if follower.is_at_end() {
            return Some(MotionStatus::Done(MotionOutcome::Arrived));
        }
        if follower.is_stopped()
            && self.ahead_is_sure
            && let Some(hit) = self.ahead.take()
        {
            return self.give_up_trajectory(hit);
        }
        let (next, error) = next_place(follower, [&self.former_drift, &self.drift], world);
        if let Some(hit) = guard::obstacle(world, &next, &AllowedPairs::none()) {
            return match self.trouble.take() {
                Some(failure) => Some(MotionStatus::failed(failure)),
                None => self.give_up_trajectory(hit),
            };
        }
        if self.ahead.is_some() || self.trouble.is_some() {
            follower.brake()
        } else {
            follower.advance()
        }
        world.set_robot_configuration(&next);
        note_error(world, error);
        None
    }

    /// Sets the base for a step of braking; a step that would collide is not taken.
    fn slow_down(&mut self, world: &mut World) {
        let Some(follower) = &mut self.follower else {
            return;
        };
        let (next, error) = next_place(follower, [&self.former_drift, &self.drift], world);
        if guard::obstacle(world, &next, &AllowedPairs::none()).is_some() {
            follower.stop();
            return;
        }
        follower.brake();
        world.set_robot_configuration(&next);
        note_error(world, error);
    }

    /// Stops; another path is searched for in the next ticks.
    fn give_up_trajectory(&mut self, hit: CollisionHit) -> Option<MotionStatus> {
        self.follower = None;
        let (goal, hit) = (self.goal, Box::new(hit));
        (self.plans >= MAX_PLANS)
            .then(|| MotionStatus::failed(MotionFailure::DriveBlocked { goal, hit }))
    }
}

/// The robot after the next step along the path, beside which the base drifts, and how far it is beside
/// where the robot takes it to be then. That has been the first drift at the beginning of the path and is
/// the second one at its end.
fn next_place(
    follower: &TrajectoryFollower,
    [former, drift]: [&BasePlace; 2],
    world: &World,
) -> (RobotConfiguration, BasePlace) {
    let mut place = follower.next();
    // A cubic, so that the drift changes the speed of the base nowhere at once.
    let fraction = follower.fraction();
    let share = fraction * fraction * (3.0 - 2.0 * fraction);
    for (axis, drift) in place.iter_mut().zip(drift) {
        *axis += drift * share;
    }
    let mut error = *drift;
    for (error, former) in error.iter_mut().zip(former) {
        *error += (former - *error) * (1.0 - share);
    }
    (at_place(world.robot_configuration(), &place), error)
}

/// Sets how far the base is beside where the robot takes it to be.
fn note_error(world: &mut World, error: BasePlace) {
    if let Some(noise) = world.noise_mut() {
        noise.set_base_error(error);
    }
}

/// The length of a path of the base (m), in which a turn counts as much as a circle of half a metre's
/// radius.
fn length_of(path: &[BasePlace]) -> f64 {
    let legs = path.iter().zip(path.iter().skip(1));
    legs.map(|([x, y, yaw], [to_x, to_y, to_yaw])| {
        libm::hypot(to_x - x, to_y - y) + 0.5 * (to_yaw - yaw).abs()
    })
    .sum()
}

/// The torso's and the arms' joints.
fn posture_joints(world: &World) -> impl Iterator<Item = JointId> {
    let description = &world.models().description;
    let arms = description
        .arms
        .iter()
        .flat_map(|arm| arm.joints().iter().copied());
    description.torso.joint.into_iter().chain(arms)
}

impl Activity for BaseMotion {
    const MODULE: ProcessModule = ProcessModule::Navigation;

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        self.ticks += 1;
        self.watch_posture(world);
        if self.follower.is_none()
            && let Some(end) = self.try_plan(world)
        {
            return Some(end);
        }
        self.follow(world)
    }

    fn is_moving(&self) -> bool {
        let follower = self.follower.as_ref();
        follower.is_some_and(TrajectoryFollower::is_moving)
    }

    fn drives_to(&self) -> Option<Pose> {
        let [x, y, heading] = self.goal;
        Some(pose::from_xy_yaw(x, y, heading))
    }

    fn brake(&mut self, world: &mut World) {
        self.slow_down(world);
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        self.follower.as_ref().map(|follower| PlannedTrajectory {
            axes: TrajectoryAxes::Base,
            trajectory: follower.trajectory(),
        })
    }

    fn may_search(&self) -> bool {
        self.follower.is_none()
    }

    fn progress(&self) -> Progress {
        let fraction = self
            .follower
            .as_ref()
            .map_or(0.0, TrajectoryFollower::fraction);
        Progress {
            what: "driving",
            fraction,
        }
    }
}
