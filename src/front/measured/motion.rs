//! Planning of motions.

use std::hint::black_box;

use super::{AT_TABLE, Stopwatch, models, parked, spawn};
use robotics::motion::AxisGroup;
use robotics::motion::Trajectory;
use robotics::motion::plan_drive;
use robotics::motion::{CollisionMode, Motion, MoveJoints, MoveTcp, PoseGoal, TcpPath};
use robotics::robot::Side;
use robotics::world::grasp_library::{GRASPS, GraspLibrary};
use robotics::world::{RobotConfiguration, World};
use spatial::Pose;

/// Time parametrisation of a path.
pub fn trajectories(stopwatch: &mut dyn Stopwatch) {
    let points: Vec<Vec<f64>> = (0..16)
        .map(|i| (0..8).map(|j| f64::from(i * j) * 0.01).collect())
        .collect();
    let limits: Vec<_> = (0..8)
        .map(|axis| AxisGroup::single(axis, 1.5, 4.0))
        .collect();
    stopwatch.repeated("trajectory of 16 points and 8 axes", &mut || {
        black_box(Trajectory::rounded(&points, &limits, &mut |_| true));
    });
    let trajectory = Trajectory::rounded(&points, &limits, &mut |_| true);
    stopwatch.repeated("a place on it", &mut || {
        black_box(trajectory.position(trajectory.duration() / 2.0));
    });
}

/// Planning paths of the base.
pub fn drives(stopwatch: &mut dyn Stopwatch) {
    use std::f64::consts::{FRAC_PI_2, PI};
    let cases = [
        ("straight", [0.0; 3], [-1.447, -0.15, -FRAC_PI_2]),
        ("from the table to the island", AT_TABLE, [-0.15, 2.0, PI]),
        ("through the passage", [0.0; 3], [-2.6, 1.5, 0.7]),
    ];
    for (name, start, goal) in cases {
        let models = models();
        let robot = parked(&models, start, 0.0);
        let world = World::new(models, robot);
        stopwatch.repeated(&format!("plan a drive, {name}"), &mut || {
            black_box(plan_drive(&world, goal).is_ok());
        });
    }
}

/// The first tick of a motion: its planning.
fn first_tick<M: Motion + Clone + 'static>(
    stopwatch: &mut dyn Stopwatch,
    name: &str,
    world: &World,
    motion: &M,
) {
    stopwatch.prepared(name, &mut || {
        let (mut world, mut motion) = (world.clone(), motion.clone());
        Box::new(move || {
            black_box(motion.tick(&mut world));
        })
    });
}

/// Planning paths of the arms.
pub fn arms(stopwatch: &mut dyn Stopwatch) {
    let models = models();
    let start = RobotConfiguration {
        base: Pose::identity(),
        joints: models.description.start_positions(&models.robot),
    };
    let park = |side| {
        let posture = models.description.arm(side).posture("park");
        Some(posture.expect("arms can be parked").to_vec())
    };
    let park = MoveJoints::new(park(Side::Left), park(Side::Right));
    let name = "plan parking both arms from the start";
    first_tick(stopwatch, name, &World::new(models.clone(), start), &park);

    let mut world = World::new(models.clone(), parked(&models, AT_TABLE, 0.3));
    spawn(&mut world, "bottle-1", "bottle", [-1.6, -0.9, 0.83]);
    assert!(world.settle(5.0));
    let bottle = world.object_pose("bottle-1").expect("it has been spawned");
    let in_base = world.robot_configuration().base.inverse() * bottle;
    let grasps = GraspLibrary::from_sexp(GRASPS, "grasps.sexp").expect("the grasps are right");
    let poses = |grasp| {
        let grasp = grasps.get("bottle", Side::Right, grasp);
        let axes = &models.description.arm(Side::Right).tool_axes;
        let poses = grasp
            .expect("it is in the library")
            .tool_poses(&in_base, axes);
        poses.expect("it is a grasp for a bottle that stands")
    };
    let reach = |pose| {
        let goal = Some(PoseGoal::InBase(pose));
        MoveTcp::new(None, goal, TcpPath::Free, CollisionMode::AllowHand)
    };
    let near = reach(poses("left-side").second_pregrasp);
    first_tick(stopwatch, "plan reaching for a bottle", &world, &near);
    let far = reach(poses("right-side").grasp);
    first_tick(
        stopwatch,
        "find out that a pose is unreachable",
        &world,
        &far,
    );
}
