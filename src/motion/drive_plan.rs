//! Planning a drive: the path of the base for the robot as it stands.

use super::base_path::{BasePathFailure, BasePlace, FloorArea, find_base_path};
use super::failure::MotionFailure;
use super::guard;
use super::trajectory::Trajectory;
use crate::spatial::{Pose, pose};
use crate::world::{AllowedPairs, CollisionHit, RobotConfiguration, World};

/// What the robot's links add (m) to the distance of their frames from the base's axis.
const LINK_EXTENT: f64 = 0.15;
/// Free floor (m) that is searched around robot, goal and furniture.
const AREA_BORDER: f64 = 1.0;
/// Places around an occupied goal that are tried (m): spacing and number of rings.
const NEARBY: (f64, u32) = (0.05, 16);

/// The configuration with the base elsewhere; its height stays.
pub(super) fn at_place(robot: &RobotConfiguration, place: &[f64]) -> RobotConfiguration {
    let mut there = robot.clone();
    if let [x, y, yaw] = *place {
        there.base = pose::from_xy_yaw(x, y, yaw);
        there.base.translation.z = robot.base.translation.z;
    }
    there
}

/// Whether the robot touches nothing all along the trajectory, sampled every 4 cm or so.
pub(super) fn is_way_free(world: &World, way: &Trajectory, robot: &RobotConfiguration) -> bool {
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
