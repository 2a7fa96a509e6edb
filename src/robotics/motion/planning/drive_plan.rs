//! Planning a drive: the path of the base for the robot's present posture.

use std::f64::consts::FRAC_PI_8;

use super::base_checker::BaseChecker;
use super::base_path::{BasePathFailure, FloorArea, find_base_path};
use super::drive_legs::with_legs;
use crate::motion::failure::base_place::BasePlace;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::robot::description::DriveKind;
use crate::world::{CollisionHit, MapArea, World};
use spatial::{pose, trig};

/// A goal this near (m, rad) is where a base that does not drive stands.
const SAME_PLACE: f64 = 1e-3;

/// Poses tried around an occupied goal: spacing (m) and number of rings.
const NEARBY: (f64, u32) = (0.05, 16);

/// The path of the base from its current pose, for the robot's present posture.
pub fn plan_drive(world: &World, goal: BasePlace) -> Result<Vec<BasePlace>, MotionFailure> {
    let base = world.robot_configuration().base;
    let t = base.translation;
    let start = [t.x, t.y, pose::yaw(&base)];
    let map = world.models().map;
    if !map.contains([goal[0], goal[1]]) {
        return Err(MotionFailure::GoalOffMap { goal, map });
    }
    let area = floor_area(&map, &start);
    let mut checker = BaseChecker::new(world);
    let reach = checker.reach();
    let drive = world.models().description.base.kind;
    if drive == DriveKind::Fixed {
        let way = libm::hypot(goal[0] - start[0], goal[1] - start[1]);
        let turn = trig::wrap(goal[2] - start[2]).abs();
        return match way.max(turn) <= SAME_PLACE {
            true => Ok(vec![start]),
            false => Err(MotionFailure::BaseIsFixed { goal }),
        };
    }
    let away = checker.way_out(&start, drive);
    let from = away.unwrap_or(start);
    let found = world.with_explored_floor(|explored| {
        find_base_path(
            from,
            goal,
            (drive, area),
            reach,
            explored,
            &mut |place, margin| checker.blocked(place, margin).map(Obstacle),
        )
    });
    let found = found.map(|path| {
        let path: Vec<BasePlace> = away.map(|_| start).into_iter().chain(path).collect();
        with_legs(drive, &path)
    });
    found.map_err(|failure| match failure {
        BasePathFailure::StartOccupied(hit) => {
            MotionFailure::DriveStartOccupied { hit: hit.0.into() }
        }
        BasePathFailure::GoalOccupied(hit) => {
            let mut places = nearby(&goal)
                .into_iter()
                .filter(|p| map.contains([p[0], p[1]]));
            let nearest_free = places.find(|place| checker.blocked(place, 0.0).is_none());
            MotionFailure::GoalOccupied {
                goal,
                hit: hit.0.into(),
                nearest_free,
            }
        }
        BasePathFailure::Enclosed { blockers } => {
            let blockers = blockers.into_iter().map(|b| b.0.other).collect();
            MotionFailure::Enclosed { goal, blockers }
        }
    })
}

/// A hit that counts as equal to another one with the same obstacle, wherever they touch.
#[derive(Clone, Debug)]
struct Obstacle(CollisionHit);

impl PartialEq for Obstacle {
    fn eq(&self, other: &Self) -> bool {
        self.0.other == other.0.other
    }
}

/// Poses around the goal with the goal's heading, the nearest first.
fn nearby(goal: &BasePlace) -> Vec<BasePlace> {
    let (spacing, rings) = NEARBY;
    let mut places = Vec::new();
    for ring in 1..=rings {
        for turn in 0..16 {
            let (s, c) = trig::sin_cos(f64::from(turn) * FRAC_PI_8);
            let r = f64::from(ring) * spacing;
            places.push([goal[0] + r * c, goal[1] + r * s, goal[2]]);
        }
    }
    places
}

/// The part of the floor that is searched: the map, and the way back to it for a robot that was
/// put elsewhere.
fn floor_area(map: &MapArea, start: &BasePlace) -> FloorArea {
    let [x, y, _] = *start;
    FloorArea {
        min: [map.min[0].min(x), map.min[1].min(y)],
        max: [map.max[0].max(x), map.max[1].max(y)],
    }
}
