//! A PR2 in the kitchen, for tests and measurements of the world.
#![allow(dead_code)]

use std::sync::Arc;

use planwright::robot::{KinematicTree, LinkId};
use planwright::spatial::pose::{from_xy_yaw, from_xyz_rpy};
use planwright::spatial::{PlacedShape, Pose, Shape};
use planwright::world::{HandRoles, Models, ObjectDescription, RobotConfiguration, Roles, World};

pub fn models() -> Arc<Models> {
    let robot = KinematicTree::from_urdf(include_str!("../../world/pr2.urdf"), "pr2.urdf").unwrap();
    let kitchen =
        KinematicTree::from_urdf(include_str!("../../world/kitchen.urdf"), "kitchen.urdf").unwrap();
    let roles = roles(&robot);
    Arc::new(Models::new(robot, kitchen, roles))
}

fn roles(tree: &KinematicTree) -> Roles {
    let link = |name: &str| tree.link_named(name).unwrap_or_else(|| panic!("{name}"));
    let links = |names: &[&str]| names.iter().map(|n| link(n)).collect::<Vec<_>>();
    let hand = |side: &str| {
        let part = |name: &str| link(&format!("{side}_gripper_{name}"));
        HandRoles {
            palm: part("palm_link"),
            fingers: [
                vec![part("l_finger_link"), part("l_finger_tip_link")],
                vec![part("r_finger_link"), part("r_finger_tip_link")],
            ],
        }
    };
    let mut touching = vec![
        links(&[
            "base_link",
            "base_bellow_link",
            "torso_lift_link",
            "head_pan_link",
            "laser_tilt_mount_link",
        ]),
        links(&["head_pan_link", "head_tilt_link"]),
    ];
    for side in ["l", "r"] {
        let arm = |names: &[&str]| {
            names
                .iter()
                .map(|n| link(&format!("{side}_{n}")))
                .collect::<Vec<_>>()
        };
        touching.push(arm(&[
            "shoulder_pan_link",
            "shoulder_lift_link",
            "upper_arm_roll_link",
            "upper_arm_link",
        ]));
        touching.push(arm(&[
            "upper_arm_roll_link",
            "upper_arm_link",
            "elbow_flex_link",
            "forearm_roll_link",
            "forearm_link",
        ]));
        touching.push(arm(&[
            "forearm_roll_link",
            "forearm_link",
            "wrist_flex_link",
            "wrist_roll_link",
            "gripper_palm_link",
        ]));
        touching.push(arm(&[
            "wrist_flex_link",
            "wrist_roll_link",
            "gripper_palm_link",
            "gripper_l_finger_link",
            "gripper_r_finger_link",
            "gripper_l_finger_tip_link",
            "gripper_r_finger_tip_link",
        ]));
        for shoulder in ["shoulder_pan_link", "shoulder_lift_link"] {
            touching.push(vec![
                link("torso_lift_link"),
                link(&format!("{side}_{shoulder}")),
            ]);
        }
    }
    let wheels: Vec<LinkId> = tree
        .links()
        .filter(|(_, l)| l.name.contains("caster"))
        .map(|(id, _)| id)
        .collect();
    let idle_joints = tree
        .joints()
        .filter(|(_, j)| j.name.contains("caster") || j.name.contains("_motor_"))
        .map(|(_, j)| j.name.clone())
        .collect();
    Roles {
        hands: [hand("l"), hand("r")],
        touching,
        wheels,
        idle_joints,
    }
}

const CARRY_LEFT: [f64; 7] = [
    1.9652919379,
    -0.2649981673,
    1.3837617139,
    -2.1224566064,
    16.9964611894,
    -0.0735078959,
    0.0,
];
const CARRY_RIGHT: [f64; 7] = [
    -1.7125874496,
    -0.2567290370,
    -1.4633501126,
    -2.1221670650,
    1.7663253482,
    -0.0794266925,
    0.0510625816,
];
const TUCKED_LEFT: [f64; 7] = [
    0.1709440185,
    1.1472294790,
    1.9124515765,
    -1.6670079484,
    6.2554719316,
    -0.0747663077,
    -14.7079336142,
];
const TUCKED_RIGHT: [f64; 7] = [
    -0.0818142862,
    0.9781030555,
    -1.4665572091,
    -1.6859729116,
    -27.7248137442,
    -0.1062194855,
    7.6626716736,
];

/// The robot at (x, y, yaw degrees) with parked arms and the torso at the height (m).
pub fn carry(models: &Models, at: [f64; 3], torso: f64) -> RobotConfiguration {
    posture(models, at, torso, &CARRY_LEFT, &CARRY_RIGHT)
}

/// The robot with tucked arms.
pub fn tucked(models: &Models, at: [f64; 3], torso: f64) -> RobotConfiguration {
    posture(models, at, torso, &TUCKED_LEFT, &TUCKED_RIGHT)
}

fn posture(
    models: &Models,
    [x, y, degrees]: [f64; 3],
    torso: f64,
    left: &[f64; 7],
    right: &[f64; 7],
) -> RobotConfiguration {
    let mut robot = RobotConfiguration {
        base: from_xy_yaw(x, y, degrees.to_radians()),
        joints: models.robot.zero_positions(),
    };
    set_joint(models, &mut robot, "torso_lift_joint", torso);
    let names = [
        "shoulder_pan",
        "shoulder_lift",
        "upper_arm_roll",
        "elbow_flex",
        "forearm_roll",
        "wrist_flex",
        "wrist_roll",
    ];
    for (i, name) in names.iter().enumerate() {
        set_joint(models, &mut robot, &format!("l_{name}_joint"), left[i]);
        set_joint(models, &mut robot, &format!("r_{name}_joint"), right[i]);
    }
    robot
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
