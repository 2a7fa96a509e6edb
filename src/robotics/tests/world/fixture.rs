//! A PR2 in the kitchen, for the tests of the world.

use std::sync::Arc;

use crate::world::{Models, RobotConfiguration, SpawnReport, World};
use spatial::Pose;
use spatial::pose::{from_xy_yaw, from_xyz_rpy};

pub(crate) fn models() -> Arc<Models> {
    Arc::new(Models::pr2_in_kitchen().unwrap())
}

/// The robot at (x, y, yaw degrees) with parked arms and the torso at the height (m).
pub(crate) fn carry(models: &Models, at: [f64; 3], torso: f64) -> RobotConfiguration {
    posture(models, at, torso, "park")
}

/// The robot with tucked arms.
pub(crate) fn tucked(models: &Models, at: [f64; 3], torso: f64) -> RobotConfiguration {
    posture(models, at, torso, "tucked")
}

fn posture(
    models: &Models,
    [x, y, degrees]: [f64; 3],
    torso: f64,
    name: &str,
) -> RobotConfiguration {
    let mut joints = models.robot.zero_positions();
    models.description.torso.set_height(&mut joints, torso);
    for arm in &models.description.arms {
        arm.set_positions(&mut joints, arm.posture(name).unwrap());
    }
    RobotConfiguration {
        base: from_xy_yaw(x, y, degrees.to_radians()),
        joints,
    }
}

pub(crate) fn set_joint(
    models: &Models,
    robot: &mut RobotConfiguration,
    name: &str,
    position: f64,
) {
    robot
        .joints
        .set(models.robot.joint_named(name).unwrap(), position);
}

/// A world with the robot tucked at the map's origin.
pub(crate) fn world() -> World {
    let models = models();
    let robot = tucked(&models, [0.0, 0.0, 0.0], 0.15);
    World::new(models, robot)
}

pub(crate) fn at(x: f64, y: f64, z: f64) -> Pose {
    from_xyz_rpy([x, y, z], [0.0; 3])
}

/// Puts an object of the library into the world.
pub(crate) fn spawn(world: &mut World, name: &str, type_name: &str, pose: &Pose) -> SpawnReport {
    world.spawn(name, type_name, pose, None, None).unwrap()
}
