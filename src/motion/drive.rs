//! Driving the base to a pose in the map, around what is in the way.
//!
//! The goal is checked first, then a path is searched for the robot as it stands: with its
//! arms where they are and with what they hold. Other jobs may move arms and torso
//! meanwhile. Then the way ahead is looked at again and again; where it has become blocked
//! the base slows down, stops, and looks for another path as soon as the posture is steady.

use super::base_path::{BasePathFailure, BasePlace, FloorArea, find_base_path};
use super::failure::MotionFailure;
use super::follower::Follower;
use super::guard;
use super::job::{Motion, MotionOutcome, MotionStatus, ProcessModule, Progress};
use super::patience::Patience;
use super::trajectory::{AxisGroup, Corners, Trajectory};
use crate::robot::JointPositions;
use crate::spatial::{Pose, pose};
use crate::world::{AllowedPairs, CollisionHit, RobotConfiguration, World};

/// How far ahead (s) the way is looked at while driving.
const LOOK_AHEAD: f64 = 0.6;
/// Steps between two looks ahead.
const LOOK_EVERY: u32 = 12;
/// Robot and world must have been still for this long (s) before another path is searched.
const STEADY: f64 = 0.05;
/// How often another path is searched before giving up.
const MOST_PLANS: u32 = 8;
/// What the robot's links add (m) to the distance of their frames from the base's axis.
const LINK_EXTENT: f64 = 0.15;
/// Free floor (m) that is searched around robot, goal and furniture.
const AREA_BORDER: f64 = 1.0;
/// Places around an occupied goal that are tried (m): spacing and greatest distance.
const NEARBY: (f64, u32) = (0.05, 16);

/// Drives the base to a pose.
#[derive(Clone, Debug)]
pub struct Drive {
    goal: BasePlace,
    way: Option<Follower>,
    /// The arms and the torso when the way ahead was last looked at.
    seen: JointPositions,
    ticks: u32,
    plans: u32,
    brake: bool,
    patience: Patience,
    ended: bool,
}

impl Drive {
    /// To the pose in the map frame, of which only x, y and the heading count.
    pub fn new(goal: &Pose) -> Self {
        let t = goal.translation;
        Self {
            goal: [t.x, t.y, pose::yaw(goal)],
            way: None,
            seen: JointPositions::default(),
            ticks: 0,
            plans: 0,
            brake: false,
            patience: Patience::default(),
            ended: false,
        }
    }

    fn plan(&mut self, world: &World) -> Result<Follower, MotionFailure> {
        self.plans += 1;
        let path = plan_drive(world, self.goal)?;
        let (drive, turn) = (
            world.models().description.base.drive,
            world.models().description.base.turn,
        );
        let limits = [
            AxisGroup {
                axes: 0..2,
                velocity: drive.velocity,
                acceleration: drive.acceleration,
            },
            AxisGroup::single(2, turn.velocity, turn.acceleration),
        ];
        let points: Vec<Vec<f64>> = path.iter().map(|p| p.to_vec()).collect();
        let round = Trajectory::new(&points, &limits, Corners::Round);
        // Rounding leaves the path that was checked, so what comes out is checked again.
        let free = points.len() <= 2 || is_way_free(world, &round, world.robot_configuration());
        Ok(Follower::new(if free {
            round
        } else {
            Trajectory::new(&points, &limits, Corners::Stop)
        }))
    }

    /// Looks at the way ahead when arms or torso have moved since the last look.
    fn look_ahead(&mut self, world: &World) {
        self.ticks += 1;
        let robot = world.robot_configuration();
        if !self.ticks.is_multiple_of(LOOK_EVERY) || (robot.joints == self.seen && !self.brake) {
            return;
        }
        self.seen.clone_from(&robot.joints);
        let Some(way) = &self.way else { return };
        let mut checker = world.collision_checker();
        self.brake = [0.25, 0.5, 0.75, 1.0].iter().any(|part| {
            let there = at_place(robot, &way.ahead(part * LOOK_AHEAD));
            !checker.is_free(&there, &AllowedPairs::none(), -guard::GUARD_DEPTH)
        });
    }

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        self.look_ahead(world);
        let way = self.way.as_mut()?;
        if way.is_at_end() {
            return Some(MotionStatus::Done(MotionOutcome::Arrived));
        }
        if let Some(stuck) = guard::stuck_object(world, |_| true) {
            return Some(MotionStatus::failed(MotionFailure::HeldObjectStuck(
                Box::new(stuck),
            )));
        }
        let next = at_place(world.robot_configuration(), &way.next());
        match guard::obstacle(world, &next, &AllowedPairs::none()) {
            None => {
                if self.brake {
                    way.brake()
                } else {
                    way.advance()
                }
                self.patience.reset();
                world.set_robot_configuration(&next);
                None
            }
            Some(hit) => {
                way.hold();
                self.wait(world, hit)
            }
        }
    }

    /// Something is in the way: waits until everything is steady, then looks for another path.
    fn wait(&mut self, world: &World, hit: CollisionHit) -> Option<MotionStatus> {
        if self.patience.wait(world) < STEADY {
            return None;
        }
        if self.plans >= MOST_PLANS {
            let goal = self.goal;
            return Some(MotionStatus::failed(MotionFailure::DriveBlocked {
                goal,
                hit: hit.into(),
            }));
        }
        self.patience.reset();
        match self.plan(world) {
            Ok(way) => {
                self.way = Some(way);
                self.brake = false;
                None
            }
            Err(failure) => Some(MotionStatus::failed(failure)),
        }
    }
}

impl Motion for Drive {
    fn module(&self) -> ProcessModule {
        ProcessModule::Navigation
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        if self.ended {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        if self.way.is_none() {
            self.seen.clone_from(&world.robot_configuration().joints);
            match self.plan(world) {
                Ok(way) => self.way = Some(way),
                Err(failure) => {
                    self.ended = true;
                    return MotionStatus::failed(failure);
                }
            }
        }
        match self.step(world) {
            None => MotionStatus::Running,
            Some(end) => {
                self.ended = true;
                end
            }
        }
    }

    fn cancel(&mut self) {
        self.ended = true;
    }

    fn progress(&self) -> Progress {
        let fraction = self.way.as_ref().map_or(0.0, Follower::fraction);
        Progress {
            what: "driving",
            fraction,
        }
    }
}

/// The configuration with the base elsewhere; its height stays.
fn at_place(robot: &RobotConfiguration, place: &[f64]) -> RobotConfiguration {
    let mut there = robot.clone();
    if let [x, y, yaw] = *place {
        there.base = pose::from_xy_yaw(x, y, yaw);
        there.base.translation.z = robot.base.translation.z;
    }
    there
}

/// Whether the robot touches nothing all along the trajectory, sampled every 4 cm or so.
fn is_way_free(world: &World, way: &Trajectory, robot: &RobotConfiguration) -> bool {
    let mut checker = world.collision_checker();
    let parts = (way.duration() / 0.04).ceil() as u32;
    (0..=parts).all(|i| {
        let place = way.position(way.duration() * f64::from(i) / f64::from(parts.max(1)));
        checker.is_free(&at_place(robot, &place), &AllowedPairs::none(), 0.0)
    })
}

/// The path of the base from where it is, for the robot's present posture.
pub fn plan_drive(world: &World, goal: BasePlace) -> Result<Vec<BasePlace>, MotionFailure> {
    let robot = world.robot_configuration().clone();
    let t = robot.base.translation;
    let start = [t.x, t.y, pose::yaw(&robot.base)];
    let mut checker = world.collision_checker();
    let none = AllowedPairs::none();
    // A robot that touches something already must be able to drive away from it.
    let touching = checker.all_hits(&robot, &none, 0.0);
    let allowed = touching
        .into_iter()
        .filter(|hit| hit.depth < guard::GREATEST_LAG)
        .fold(AllowedPairs::none(), |all, hit| {
            all.and(hit.moving, hit.other)
        });
    let mut there = robot.clone();
    let mut poses = Vec::new();
    let tree = &world.models().robot;
    tree.forward_kinematics(&Pose::identity(), &robot.joints, &mut poses);
    let in_base = poses.clone();
    let mut blocked = |place: &BasePlace, margin: f64| {
        let base = pose::from_xy_yaw(place[0], place[1], place[2]);
        there.base = base;
        for (pose, link) in poses.iter_mut().zip(&in_base) {
            *pose = base * link;
        }
        checker.first_hit_at(&poses, &allowed, margin)
    };
    let reach = in_base
        .iter()
        .map(|p| libm::hypot(p.translation.x, p.translation.y))
        .fold(0.0, f64::max);
    let found = find_base_path(
        start,
        goal,
        floor_area(world, &start, &goal),
        reach + LINK_EXTENT,
        &mut |p, m| blocked(p, m).map(Obstacle),
    );
    found.map_err(|failure| match failure {
        BasePathFailure::StartOccupied(hit) => {
            MotionFailure::DriveStartOccupied { hit: hit.0.into() }
        }
        BasePathFailure::GoalOccupied(hit) => {
            let nearest_free = nearby(&goal)
                .into_iter()
                .find(|p| blocked(p, 0.0).is_none());
            MotionFailure::GoalOccupied {
                goal,
                hit: hit.0.into(),
                nearest_free,
            }
        }
        BasePathFailure::Enclosed { blockers } => MotionFailure::Enclosed {
            goal,
            blockers: blockers.into_iter().map(|b| b.0.other).collect(),
        },
    })
}

/// A hit that equals another one with the same obstacle, wherever they touch.
#[derive(Clone, Debug)]
struct Obstacle(CollisionHit);

impl PartialEq for Obstacle {
    fn eq(&self, other: &Self) -> bool {
        self.0.other == other.0.other
    }
}

/// Places around the goal with the goal's heading, the nearest first.
fn nearby(goal: &BasePlace) -> Vec<BasePlace> {
    let (spacing, rings) = NEARBY;
    let mut places = Vec::new();
    for ring in 1..=rings {
        for turn in 0..16 {
            let (s, c) =
                crate::spatial::trig::sin_cos(f64::from(turn) * std::f64::consts::FRAC_PI_8);
            let r = f64::from(ring) * spacing;
            places.push([goal[0] + r * c, goal[1] + r * s, goal[2]]);
        }
    }
    places
}

/// The floor that holds the robot, its goal and all furniture.
fn floor_area(world: &World, start: &BasePlace, goal: &BasePlace) -> FloorArea {
    let links = world.models().kitchen.links();
    let furniture = links
        .filter(|(_, link)| !link.collisions.is_empty())
        .map(|(id, _)| {
            let t = world.furniture_pose(id).translation;
            [t.x, t.y]
        });
    let ends = [[start[0], start[1]], [goal[0], goal[1]]];
    let mut area = FloorArea {
        min: [f64::MAX; 2],
        max: [f64::MIN; 2],
    };
    for p in furniture.chain(ends) {
        for (i, v) in p.into_iter().enumerate() {
            area.min[i] = area.min[i].min(v - AREA_BORDER);
            area.max[i] = area.max[i].max(v + AREA_BORDER);
        }
    }
    area
}
