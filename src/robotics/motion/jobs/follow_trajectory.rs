//! Following a trajectory that somebody else has planned.

use super::job::Job;
use super::joint_motion::{JointGoal, JointMotion};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::failure::wrong_trajectory::WrongTrajectory;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::timed_path::{Excess, TimedPoint, excess, sampled, trajectory};
use crate::robot::{Joint, JointId, Side};
use crate::world::{AllowedPairs, CollisionHit, World};
use spatial::trig;

/// Moves the joints of an arm along a trajectory.
pub(crate) type FollowArm = Job<JointMotion<TimedGoal<false>>>;
/// Moves the torso along a trajectory.
pub(crate) type FollowTorso = Job<JointMotion<TimedGoal<true>>>;

/// How far (rad or m) a joint may be from where a trajectory begins.
const START_TOLERANCE: f64 = 0.03;
/// Maximum number of points, and of seconds.
const MAX_POINTS: usize = 10_000;
const MAX_SECONDS: f64 = 600.0;
/// A velocity (rad/s or m/s) below this is rest.
const REST: f64 = 1e-3;

/// Points at some times (s), of whose numbers, one row after the other, each has an equal share. A remainder makes rows too long,
/// which is refused later.
pub(crate) fn points_of_rows(
    times: &[f64],
    positions: &[f64],
    velocities: Option<&[f64]>,
) -> Vec<TimedPoint> {
    let row = |numbers: &[f64], number: usize| {
        let width = numbers.len().div_ceil(times.len().max(1)).max(1);
        let row = numbers.chunks(width).nth(number);
        row.map(<[f64]>::to_vec).unwrap_or_default()
    };
    let points = times.iter().enumerate().map(|(number, time)| TimedPoint {
        time: *time,
        positions: row(positions, number),
        velocities: velocities.map(|all| row(all, number)),
    });
    points.collect()
}

/// A trajectory of an arm's joints, from the shoulder to the wrist, or of the torso's.
#[derive(Clone, Debug)]
pub(crate) struct TimedGoal<const IS_TORSO: bool> {
    /// The arms whose joints come one after the other, unless it is the torso.
    sides: Vec<Side>,
    points: Vec<TimedPoint>,
}

impl FollowArm {
    /// Along points with positions (rad) for all joints of the arm, or of one arm and then of the other.
    pub fn new(sides: &[Side], points: Vec<TimedPoint>) -> Self {
        let sides = sides.to_vec();
        Self::begin(JointMotion::to(TimedGoal { sides, points }))
    }
}

impl FollowTorso {
    /// Along points with the position (m) of the lift joint.
    pub fn new(points: Vec<TimedPoint>) -> Self {
        let sides = Vec::new();
        Self::begin(JointMotion::to(TimedGoal { sides, points }))
    }
}

impl<const IS_TORSO: bool> TimedGoal<IS_TORSO> {
    fn joints(&self, world: &World) -> Vec<JointId> {
        let body = &world.models().description;
        match IS_TORSO {
            true => body.torso.joint.into_iter().collect(),
            false => {
                let arms = self.sides.iter().map(|side| body.arm(*side));
                arms.flat_map(|arm| arm.joints().iter().copied()).collect()
            }
        }
    }

    /// The points, if all numbers are what they should be.
    fn checked(&self, count: usize) -> Result<&[TimedPoint], WrongTrajectory> {
        let (Some(_), Some(last)) = (self.points.first(), self.points.last()) else {
            return Err(WrongTrajectory::Empty);
        };
        if self.points.len() > MAX_POINTS || last.time > MAX_SECONDS {
            return Err(WrongTrajectory::TooLong {
                points: MAX_POINTS,
                seconds: MAX_SECONDS,
            });
        }
        let mut before = None;
        for (number, point) in self.points.iter().enumerate() {
            let given = [Some(&point.positions), point.velocities.as_ref()];
            for numbers in given.into_iter().flatten() {
                if numbers.len() != count {
                    return Err(WrongTrajectory::Count {
                        point: number,
                        given: numbers.len(),
                        expected: count,
                    });
                }
                if numbers.iter().any(|number| !number.is_finite()) {
                    return Err(WrongTrajectory::NotFinite { point: number });
                }
            }
            // False for what is no number, too.
            let is_later = before.map_or(point.time >= 0.0, |before| point.time > before);
            if !is_later {
                return Err(WrongTrajectory::Times { point: number });
            }
            before = Some(point.time);
        }
        let velocities = last.velocities.iter().flatten();
        match velocities.copied().find(|velocity| velocity.abs() > REST) {
            Some(velocity) => Err(WrongTrajectory::EndsMoving { velocity }),
            None => Ok(&self.points),
        }
    }

    /// The points from where the joints are, with continuous joints unwound.
    fn starting_here(
        &self,
        joints: &[&Joint],
        now: &[f64],
    ) -> Result<Vec<TimedPoint>, WrongTrajectory> {
        let mut points = self.checked(joints.len())?.to_vec();
        let turns: Vec<f64> = match points.first() {
            Some(first) => {
                let ends = joints.iter().zip(now).zip(&first.positions);
                ends.map(|((joint, now), to)| match joint.limits {
                    Some(_) => 0.0,
                    None => now + trig::wrap(to - now) - to,
                })
                .collect()
            }
            None => Vec::new(),
        };
        for point in &mut points {
            for ((joint, position), turn) in joints.iter().zip(&mut point.positions).zip(&turns) {
                *position += turn;
                if let Some(limits) = joint.limits.filter(|l| l.excess(*position) > 1e-6) {
                    return Err(WrongTrajectory::BeyondLimits {
                        joint: joint.name.clone(),
                        position: *position,
                        lower: limits.lower,
                        upper: limits.upper,
                        time: point.time,
                    });
                }
            }
        }
        let Some(first) = points.first_mut() else {
            return Ok(points);
        };
        if first.time > 0.0 {
            let still = first.velocities.as_ref().map(|_| vec![0.0; now.len()]);
            let here = TimedPoint {
                time: 0.0,
                positions: now.to_vec(),
                velocities: still,
            };
            points.insert(0, here);
            return Ok(points);
        }
        for ((joint, now), wanted) in joints.iter().zip(now).zip(&mut first.positions) {
            if (*now - *wanted).abs() > START_TOLERANCE {
                return Err(WrongTrajectory::BeginsElsewhere {
                    joint: joint.name.clone(),
                    position: *now,
                    begin: *wanted,
                });
            }
            *wanted = *now;
        }
        Ok(points)
    }
}

impl<const IS_TORSO: bool> JointGoal for TimedGoal<IS_TORSO> {
    const MODULE: ProcessModule = if IS_TORSO {
        ProcessModule::Torso
    } else {
        ProcessModule::Arms
    };
    const BLOCKED_TIMEOUT: f64 = 0.3;

    fn what(&self) -> &'static str {
        "following a trajectory"
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        let (tree, body) = (&world.models().robot, &world.models().description);
        let ids = self.joints(world);
        let joints: Vec<&Joint> = ids.iter().map(|id| tree.joint(*id)).collect();
        let configuration = &world.robot_configuration().joints;
        let now: Vec<f64> = ids.iter().map(|id| configuration.get(*id)).collect();
        let points = self.starting_here(&joints, &now)?;
        let (samples, step) = sampled(&points);
        let limit = |id: &JointId| {
            let speed = body.speed(*id).velocity;
            tree.joint(*id).max_velocity.unwrap_or(speed)
        };
        let limits: Vec<f64> = ids.iter().map(limit).collect();
        if let Some(Excess {
            axis,
            time,
            velocity,
        }) = excess(&samples, step, &limits)
        {
            return Err(WrongTrajectory::TooFast {
                joint: joints
                    .get(axis)
                    .map_or_else(String::new, |j| j.name.clone()),
                velocity,
                limit: limits.get(axis).copied().unwrap_or_default(),
                time,
            }
            .into());
        }
        let speeds = speeds::limits_of(body, &ids);
        let trajectory = trajectory(samples, step, &speeds);
        Ok(JointPlan::new(ids, trajectory, AllowedPairs::none()))
    }

    fn blocked(&self, world: &World, hit: CollisionHit) -> MotionFailure {
        match IS_TORSO {
            false => MotionFailure::ArmBlocked { hit: hit.into() },
            true => {
                let last = self.points.last().and_then(|point| point.positions.first());
                let torso = &world.models().description.torso;
                MotionFailure::TorsoBlocked {
                    goal: last.copied().unwrap_or_default(),
                    height: torso.height(&world.robot_configuration().joints),
                    hit: hit.into(),
                }
            }
        }
    }
}
