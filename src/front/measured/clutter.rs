//! Motions among many things: what planning them costs, and how long they take compared with the
//! shortest time that is possible.

use std::ops::Range;
use std::time::Duration;

use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::{AT_TABLE, models, parked};
use robotics::motion::{
    CollisionMode, Drive, Motion, MotionStatus, MoveJoints, MoveTcp, PlannedTrajectory, PoseGoal,
    TcpPath, TrajectoryAxes,
};
use robotics::robot::{RobotDescription, Side};
use robotics::world::grasp_library::{GRASPS, GraspLibrary};
use robotics::world::{RobotConfiguration, World};
use spatial::pose::{from_xy_yaw, from_xyz_rpy};

/// What stands on the table: types with grasps, and their height (m) when they are spawned.
const TYPES: [(&str, f64); 5] = [
    ("bottle", 0.83),
    ("cup", 0.80),
    ("milk", 0.85),
    ("bowl", 0.78),
    ("breakfast-cereal", 0.86),
];
/// Where on the table (m): smallest and largest x and y.
const ON_TABLE: [[f64; 2]; 2] = [[-1.85, -0.95], [-1.05, -0.72]];
/// Where on the floor (m) drives start and end.
const ON_FLOOR: [[f64; 2]; 2] = [[-3.5, -1.7], [0.9, 2.8]];

/// A planned motion.
#[derive(Clone, Debug)]
pub struct PlannedMotion {
    /// Number of the scene.
    pub scene: u64,
    /// What was planned.
    pub what: String,
    /// The time that planning took.
    pub planning: Duration,
    /// How long (s) the motion takes, and the least time (s) in which the axis that needs most
    /// could get from its start to its goal, at rest at both; nothing if there is no path.
    pub times: Option<[f64; 2]>,
}

/// Plans motions of the arms among three to eight objects on the table, each from where the last
/// one ended: to graspable objects, and back to the parked arms.
pub fn cluttered_arms(
    scenes: Range<u64>,
    clock: &mut dyn FnMut() -> Duration,
    visit: &mut dyn FnMut(PlannedMotion),
) {
    let models = models();
    let grasps = GraspLibrary::from_sexp(GRASPS, "grasps.sexp").expect("the grasps are right");
    for scene in scenes {
        let mut rng = Pcg64::seed_from_u64(scene);
        let mut world = World::new(models.clone(), parked(&models, AT_TABLE, 0.3));
        let count = 3 + rng.next_u64() % 6;
        let mut objects = Vec::new();
        for i in 0..count {
            let (type_name, z) = TYPES[pick(&mut rng, TYPES.len())];
            let [min, max] = ON_TABLE;
            let [x, y] = [0, 1].map(|i| between(&mut rng, min[i], max[i]));
            let yaw = between(&mut rng, -0.5, 0.5);
            let name = format!("{type_name}-{i}");
            let pose = from_xyz_rpy([x, y, z], [0.0, 0.0, yaw]);
            if world.spawn(&name, type_name, &pose, None, None).is_ok() {
                objects.push((name, type_name));
            }
        }
        world.settle(2.0);
        let mut is_parked = true;
        for _ in 0..3 {
            let (name, type_name) = &objects[pick(&mut rng, objects.len())];
            let side = Side::BOTH[pick(&mut rng, 2)];
            let object = world.object_pose(name).expect("it has been spawned");
            let in_base = world.robot_configuration().base.inverse() * object;
            let axes = &models.description.arm(side).tool_axes;
            // The first grasp for which there is a path.
            for grasp in grasps.grasps(type_name) {
                let poses = grasps.get(type_name, side, grasp);
                let Some(Ok(poses)) = poses.map(|grasp| grasp.tool_poses(&in_base, axes)) else {
                    continue;
                };
                let goal = Some(PoseGoal::InBase(poses.second_pregrasp));
                let goals = match side {
                    Side::Left => (goal, None),
                    Side::Right => (None, goal),
                };
                let reach = MoveTcp::new(goals.0, goals.1, TcpPath::Free, CollisionMode::AvoidAll);
                let what = format!("{side} hand, {grasp} of {name}");
                let reached = planned(&mut world, scene, what, reach, clock);
                let is_reached = reached.times.is_some();
                visit(reached);
                if is_reached {
                    is_parked = false;
                    break;
                }
            }
        }
        if is_parked {
            continue;
        }
        let park = |side| {
            let posture = models.description.arm(side).posture("park");
            posture.map(|posture| posture.to_vec())
        };
        let park = MoveJoints::new(park(Side::Left), park(Side::Right));
        visit(planned(&mut world, scene, "park".to_owned(), park, clock));
    }
}

/// Plans drives between free places of the kitchen, around five objects on the floor.
pub fn cluttered_drives(
    scenes: Range<u64>,
    clock: &mut dyn FnMut() -> Duration,
    visit: &mut dyn FnMut(PlannedMotion),
) {
    let models = models();
    for scene in scenes {
        let mut rng = Pcg64::seed_from_u64(scene);
        let mut world = World::new(models.clone(), parked(&models, [0.0; 3], 0.2));
        let [min, max] = ON_FLOOR;
        for i in 0..5 {
            let [x, y] = [0, 1].map(|i| between(&mut rng, min[i], max[i]));
            let pose = from_xyz_rpy([x, y, 0.1], [0.0; 3]);
            // A place that is taken is no loss.
            let _report = world.spawn(&format!("cube-{i}"), "cube", &pose, None, None);
        }
        world.settle(2.0);
        let mut free_place = |world: &World| loop {
            let [x, y] = [0, 1].map(|i| between(&mut rng, min[i], max[i]));
            let robot = RobotConfiguration {
                base: from_xy_yaw(x, y, between(&mut rng, -3.1, 3.1)),
                ..world.robot_configuration().clone()
            };
            let mut checker = world.collision_checker();
            if checker.is_free(&robot, &robotics::world::AllowedPairs::none(), 0.001) {
                break robot;
            }
        };
        let start = free_place(&world);
        world.teleport_robot(&start);
        let goal = free_place(&world).base;
        let t = goal.translation;
        let what = format!("to ({:.2}, {:.2})", t.x, t.y);
        visit(planned(&mut world, scene, what, Drive::new(&goal), clock));
    }
}

/// Plans the motion and moves the robot to its end.
fn planned(
    world: &mut World,
    scene: u64,
    what: String,
    mut motion: impl Motion,
    clock: &mut dyn FnMut() -> Duration,
) -> PlannedMotion {
    let before = world.robot_configuration().clone();
    let begin = clock();
    let status = motion.tick(world);
    let planning = clock().saturating_sub(begin);
    let mut what = what;
    if let MotionStatus::Failed(failure) = &status {
        what = format!("{what}: {failure}");
    }
    let mut end = before.clone();
    let times = motion.planned().map(|plan| {
        let duration = plan.trajectory.duration();
        let bound = bound(&world.models().description, &plan);
        if let TrajectoryAxes::Joints(joints) = plan.axes {
            for (joint, position) in joints.iter().zip(plan.trajectory.last()) {
                end.joints.set(*joint, *position);
            }
        }
        [duration, bound]
    });
    world.teleport_robot(&end);
    PlannedMotion {
        scene,
        what,
        planning,
        times,
    }
}

/// The least time (s) from the start to the goal for the axis that needs most.
fn bound(description: &RobotDescription, plan: &PlannedTrajectory<'_>) -> f64 {
    let first = plan.trajectory.position(0.0);
    let ways = first.iter().zip(plan.trajectory.last());
    let ways: Vec<f64> = ways.map(|(a, b)| (b - a).abs()).collect();
    let time = |way: f64, velocity: f64, acceleration: f64| {
        if way * acceleration < velocity * velocity {
            2.0 * (way / acceleration).sqrt()
        } else {
            way / velocity + velocity / acceleration
        }
    };
    match (plan.axes, ways.as_slice()) {
        (TrajectoryAxes::Joints(joints), _) => {
            let times = joints.iter().zip(&ways).map(|(joint, way)| {
                let speed = description.speed(*joint);
                time(*way, speed.velocity, speed.acceleration)
            });
            times.fold(0.0, f64::max)
        }
        (TrajectoryAxes::Base, [x, y, yaw]) => {
            let (drive, turn) = (&description.base.drive, &description.base.turn);
            let driven = time(libm::hypot(*x, *y), drive.velocity, drive.acceleration);
            driven.max(time(*yaw, turn.velocity, turn.acceleration))
        }
        (TrajectoryAxes::Base, _) => 0.0,
    }
}

/// A random number in that range.
fn between(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    low + (high - low) * ((rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64)
}

fn pick(rng: &mut Pcg64, count: usize) -> usize {
    // The remainder is less than a usize.
    (rng.next_u64() % count as u64) as usize
}
