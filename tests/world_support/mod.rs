//! A PR2 in the kitchen, for tests and measurements of the world.
#![allow(dead_code)]

use std::sync::Arc;

use planwright::robot::{KITCHEN_URDF, KinematicTree, PR2_DESCRIPTION, PR2_URDF, RobotDescription};
use planwright::spatial::pose::{from_xy_yaw, from_xyz_rpy};
use planwright::spatial::{PlacedShape, Pose, Shape};
use planwright::world::{Models, ObjectDescription, RobotConfiguration, World};

pub fn models() -> Arc<Models> {
    let robot = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").unwrap();
    let description = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &robot).unwrap();
    let kitchen = KinematicTree::from_urdf(KITCHEN_URDF, "kitchen.urdf").unwrap();
    Arc::new(Models::new(robot, description, kitchen))
}

/// The robot at (x, y, yaw degrees) with parked arms and the torso at the height (m).
pub fn carry(models: &Models, at: [f64; 3], torso: f64) -> RobotConfiguration {
    posture(models, at, torso, "park")
}

/// The robot with tucked arms.
pub fn tucked(models: &Models, at: [f64; 3], torso: f64) -> RobotConfiguration {
    posture(models, at, torso, "tucked")
}

fn posture(
    models: &Models,
    [x, y, degrees]: [f64; 3],
    torso: f64,
    name: &str,
) -> RobotConfiguration {
    let mut joints = models.robot.zero_positions();
    joints.set(models.description.torso.joint, torso);
    for arm in &models.description.arms {
        arm.set_positions(&mut joints, arm.posture(name).unwrap());
    }
    RobotConfiguration {
        base: from_xy_yaw(x, y, degrees.to_radians()),
        joints,
    }
}

pub fn set_joint(models: &Models, robot: &mut RobotConfiguration, name: &str, position: f64) {
    robot
        .joints
        .set(models.robot.joint_named(name).unwrap(), position);
}

/// A world with the robot tucked at the map's origin.
pub fn world() -> World {
    let models = models();
    let robot = tucked(&models, [0.0, 0.0, 0.0], 0.15);
    World::new(models, robot)
}

pub fn at(x: f64, y: f64, z: f64) -> Pose {
    from_xyz_rpy([x, y, z], [0.0; 3])
}

fn placed(shape: Shape, xyz: [f64; 3], rpy: [f64; 3]) -> PlacedShape {
    PlacedShape {
        shape,
        pose: from_xyz_rpy(xyz, rpy),
        color: None,
    }
}

fn described(type_name: &str, shapes: Vec<PlacedShape>) -> ObjectDescription {
    ObjectDescription {
        type_name: type_name.to_owned(),
        shapes,
        color: [1.0, 0.0, 0.0, 1.0],
        mass: 0.2,
    }
}

pub fn bottle() -> ObjectDescription {
    let part = |radius, length, z| {
        placed(
            Shape::Cylinder { radius, length },
            [0.0005, -0.0007, z],
            [0.0; 3],
        )
    };
    described(
        "bottle",
        vec![
            part(0.0357, 0.151, -0.0253),
            part(0.031, 0.011, 0.0557),
            part(0.0178, 0.0195, 0.0709),
        ],
    )
}

pub fn cube() -> ObjectDescription {
    described(
        "cube",
        vec![placed(Shape::Box { size: [0.07; 3] }, [0.0; 3], [0.0; 3])],
    )
}

pub fn sausage() -> ObjectDescription {
    let lying = [0.0, std::f64::consts::FRAC_PI_2, 0.0];
    described(
        "weisswurst",
        vec![placed(
            Shape::Cylinder {
                radius: 0.0158,
                length: 0.11,
            },
            [0.0; 3],
            lying,
        )],
    )
}
