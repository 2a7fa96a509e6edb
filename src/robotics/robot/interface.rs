//! By which names programs outside drive a robot, how long they wait for it, and how far beside a goal still counts as
//! there.
//!
//! The records `(interface PART :name … :time-out … :tolerance …)` of a description; what they leave out is as
//! CRAM's process modules of the PR2 have it.

use super::Side;

/// A part of a robot that is moved by an action of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RobotPart {
    /// The mobile base.
    Base,
    /// The lift of the torso.
    Torso,
    /// What turns the camera.
    Neck,
    /// An arm.
    Arm(Side),
    /// The fingers of a hand.
    Gripper(Side),
}

impl RobotPart {
    /// All parts that robots may have.
    pub const ALL: [Self; 7] = [
        Self::Base,
        Self::Torso,
        Self::Neck,
        Self::Arm(Side::Left),
        Self::Arm(Side::Right),
        Self::Gripper(Side::Left),
        Self::Gripper(Side::Right),
    ];

    /// Its name in descriptions.
    pub fn name(self) -> &'static str {
        match self {
            Self::Base => "base",
            Self::Torso => "torso",
            Self::Neck => "neck",
            Self::Arm(Side::Left) => "left-arm",
            Self::Arm(Side::Right) => "right-arm",
            Self::Gripper(Side::Left) => "left-gripper",
            Self::Gripper(Side::Right) => "right-gripper",
        }
    }
}

/// The action by which a part is moved.
#[derive(Clone, Debug, PartialEq)]
pub struct PartInterface {
    /// The part.
    pub part: RobotPart,
    /// The name of the action.
    pub name: String,
    /// How long (s) a goal may take, beyond the duration of its trajectory if it has one.
    pub time_out: f64,
    /// How far beside its goal the part may be: m for base, torso and grippers, rad for the joints of others.
    pub tolerance: f64,
    /// By how much (rad) the base may be turned away from its goal.
    pub turn_tolerance: f64,
}

/// How a robot is driven from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotInterface {
    /// Its parts.
    pub parts: Vec<PartInterface>,
    /// The frame in which goals of the base are, and poses of objects.
    pub map: String,
    /// The topics on which its joints are told.
    pub joint_states: Vec<String>,
    /// The service that tells what its camera sees.
    pub perception: String,
    /// How long (s) to wait for a server.
    pub server_time_out: f64,
    /// How old (s) what is known of joints may be, and of the place of the base.
    pub max_joint_age: f64,
    /// As above.
    pub max_frame_age: f64,
}

impl Default for RobotInterface {
    fn default() -> Self {
        let part = |part, name: &str, time_out, tolerance| PartInterface {
            part,
            name: name.to_owned(),
            time_out,
            tolerance,
            turn_tolerance: 0.1,
        };
        let arm = |side: Side| {
            let name = format!("/{side}_arm_controller/follow_joint_trajectory");
            part(RobotPart::Arm(side), &name, 10.0, 0.17)
        };
        let gripper = |side: Side| {
            let name = format!("/{side}_gripper_controller/gripper_cmd");
            part(RobotPart::Gripper(side), &name, 10.0, 0.001)
        };
        let torso = "/torso_controller/follow_joint_trajectory";
        Self {
            // Time-outs and tolerances: CRAM's cram_pr2_low_level.
            parts: vec![
                part(RobotPart::Base, "/navigate_to_pose", 60.0, 0.05),
                part(RobotPart::Torso, torso, 20.0, 0.005),
                part(
                    RobotPart::Neck,
                    "/head_controller/point_head_action",
                    5.0,
                    0.05,
                ),
                arm(Side::Left),
                arm(Side::Right),
                gripper(Side::Left),
                gripper(Side::Right),
            ],
            map: "map".to_owned(),
            joint_states: vec!["/joint_states".to_owned()],
            perception: "/detect_objects".to_owned(),
            server_time_out: 10.0,
            max_joint_age: 0.5,
            max_frame_age: 1.0,
        }
    }
}

impl RobotInterface {
    /// The action of a part.
    pub fn part(&self, part: RobotPart) -> Option<&PartInterface> {
        self.parts.iter().find(|known| known.part == part)
    }

    pub(super) fn part_mut(&mut self, name: &str) -> Option<&mut PartInterface> {
        self.parts
            .iter_mut()
            .find(|known| known.part.name() == name)
    }
}
