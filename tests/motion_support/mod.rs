//! A PR2 in the kitchen that carries out motions, for tests and measurements of motions.
#![allow(dead_code)]

use std::sync::Arc;

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};
use planwright::motion::{
    CollisionMode, Drive, GripperCommand, LetGo, Motion, MotionFailure, MotionOutcome,
    MotionStatus, MoveGripper, MoveJoints, MoveTcp, MoveTorso, Put, TcpGoal, TcpPath, held_objects,
    take_hold,
};
use planwright::robot::{RobotDescription, Side};
use planwright::spatial::Pose;
use planwright::spatial::pose::{from_xy_yaw, from_xyz_rpy};
use planwright::world::{AllowedPairs, BodyName, LinkName, Models, RobotConfiguration, World};

#[path = "../world_support/mod.rs"]
mod world_support;
pub use world_support::{bottle, models};

/// What a motion came to.
pub type Outcome = Result<MotionOutcome, MotionFailure>;

/// A robot in a kitchen.
pub struct Kitchen {
    pub body: Arc<RobotDescription>,
    pub world: World,
    /// Whether every step is checked for penetration.
    pub checked: bool,
    /// Pairs that may overlap now.
    pub declared: AllowedPairs,
}

pub fn description(models: &Models) -> Arc<RobotDescription> {
    let text = include_str!("../../world/pr2.sexp");
    Arc::new(RobotDescription::from_sexp(text, "pr2.sexp", &models.robot).unwrap())
}

impl Kitchen {
    /// The robot as after start-up: at the origin, arms tucked.
    pub fn new() -> Self {
        let models = models();
        let body = description(&models);
        let joints = body.start_positions(&models.robot);
        let world = World::new(
            models,
            RobotConfiguration {
                base: Pose::identity(),
                joints,
            },
        );
        Self {
            body,
            world,
            checked: true,
            declared: AllowedPairs::none(),
        }
    }

    /// The robot with parked arms.
    pub fn parked(x: f64, y: f64, yaw_degrees: f64, torso: f64) -> Self {
        let mut kitchen = Self::new();
        let mut robot = kitchen.world.robot_configuration().clone();
        robot.base = from_xy_yaw(x, y, yaw_degrees.to_radians());
        robot.joints.set(kitchen.body.torso.joint, torso);
        for arm in &kitchen.body.arms {
            arm.set_positions(&mut robot.joints, arm.posture("park").unwrap());
        }
        kitchen.world.teleport_robot(&robot);
        kitchen
    }

    pub fn spawn_bottle(&mut self, x: f64, y: f64, z: f64) {
        self.world
            .spawn("bottle-1", &bottle(), &from_xyz_rpy([x, y, z], [0.0; 3]))
            .unwrap();
        assert!(self.world.settle(5.0));
    }

    /// The hand and the object may touch, and the object may touch what it stands on.
    pub fn declare_grasp(&mut self, side: Side, object: &str) {
        let object = BodyName::Object(object.to_owned());
        let models = Arc::clone(self.world.models());
        let name = |id| {
            BodyName::Robot(LinkName {
                id,
                name: models.robot.link(id).name.as_str().into(),
            })
        };
        let hand = self.body.arm(side).gripper.links().map(name);
        self.declared = AllowedPairs::none().and_all(hand, &object);
    }

    /// Runs the motions at the same time until all have ended.
    pub fn run(&mut self, motions: &mut [&mut dyn Motion]) -> Vec<Outcome> {
        let mut ends: Vec<Option<Outcome>> = motions.iter().map(|_| None).collect();
        let mut steps = 0;
        while ends.iter().any(Option::is_none) {
            for (motion, end) in motions
                .iter_mut()
                .zip(&mut ends)
                .filter(|(_, e)| e.is_none())
            {
                match motion.tick(&mut self.world) {
                    MotionStatus::Running => {}
                    MotionStatus::Done(outcome) => *end = Some(Ok(outcome)),
                    MotionStatus::Failed(failure) => *end = Some(Err(*failure)),
                }
            }
            self.world.step();
            steps += 1;
            assert!(steps < 240 * 120, "a motion does not end");
            if self.checked {
                let hit = self.world.deepest_penetration(&self.declared, 0.002);
                assert!(hit.is_none(), "at {:.2} s: {hit:?}", self.world.time());
            }
        }
        ends.into_iter().flatten().collect()
    }

    /// Runs one motion.
    pub fn run_one(&mut self, mut motion: impl Motion) -> Outcome {
        self.run(&mut [&mut motion]).remove(0)
    }

    pub fn drive(&self, x: f64, y: f64, yaw_degrees: f64) -> Drive {
        Drive::new(
            Arc::clone(&self.body),
            &from_xy_yaw(x, y, yaw_degrees.to_radians()),
        )
    }

    pub fn torso(&self, height: f64) -> MoveTorso {
        MoveTorso::new(Arc::clone(&self.body), height)
    }

    pub fn park(&self, left: bool, right: bool) -> MoveJoints {
        let posture = |side: Side, wanted: bool| {
            wanted.then(|| self.body.arm(side).posture("park").unwrap().to_vec())
        };
        MoveJoints::new(
            Arc::clone(&self.body),
            posture(Side::Left, left),
            posture(Side::Right, right),
        )
    }

    pub fn gripper(&self, side: Side, command: GripperCommand) -> MoveGripper {
        MoveGripper::new(Arc::clone(&self.body), side, command)
    }

    pub fn tcp(&self, side: Side, pose: Pose, path: TcpPath, mode: CollisionMode) -> MoveTcp {
        let goal = Some(TcpGoal::InBase(pose));
        let (left, right) = match side {
            Side::Left => (goal, None),
            Side::Right => (None, goal),
        };
        MoveTcp::new(Arc::clone(&self.body), left, right, path, mode)
    }

    /// The five poses of the grasp of an object, in the frame of the base.
    pub fn grasp_poses(&self, grasp: &Grasp, object_in_base: &Pose) -> [Pose; 5] {
        let at = |offset: [f64; 3]| {
            let t = Translation3::from(grasp.translation) * Translation3::from(offset);
            let in_object = Pose::from_parts(t, grasp.rotation());
            object_in_base * in_object * self.body.arms[0].tool_axes
        };
        let [pre, second] = grasp.offsets;
        [
            at(pre),
            at(second),
            at([0.0; 3]),
            at([0.0, 0.0, 0.15]),
            at([0.0, 0.0, 0.15]),
        ]
    }

    /// The flow of CRAM's picking-up. Stops at the first failure that matters.
    pub fn pick(&mut self, side: Side, grasp: &Grasp, object: &str, in_base: &Pose) -> Outcome {
        let [pre, second, at, lift, _] = self.grasp_poses(grasp, in_base);
        let mut open = self.gripper(side, GripperCommand::Position(0.10));
        let mut reach = self.tcp(side, pre, TcpPath::Free, CollisionMode::AvoidAll);
        let ends = self.run(&mut [&mut open, &mut reach]);
        for (what, end) in ["open", "pregrasp"].iter().zip(&ends) {
            if let Err(failure) = end {
                eprintln!("{what}: {failure}");
            }
        }
        self.run_one(self.tcp(side, second, TcpPath::Free, CollisionMode::AvoidAll))?;
        self.declare_grasp(side, object);
        self.run_one(self.tcp(side, at, TcpPath::Straight, CollisionMode::AllowHand))?;
        let grip = GripperCommand::Grip {
            object: Some(object.to_owned()),
        };
        let gripped = self.run_one(self.gripper(side, grip))?;
        take_hold(&self.body, &mut self.world, side, object)?;
        self.run_one(self.tcp(side, lift, TcpPath::Straight, CollisionMode::AllowHand))?;
        Ok(gripped)
    }

    /// The flow of CRAM's placing.
    pub fn place(&mut self, side: Side, grasp: &Grasp, target_in_base: &Pose) -> Outcome {
        let [pre, second, at, lift, _] = self.grasp_poses(grasp, target_in_base);
        let object = held_objects(&self.body, &self.world, side).remove(0);
        self.run_one(self.tcp(side, lift, TcpPath::Free, CollisionMode::AvoidAll))?;
        let put = self.run_one(Put::new(Arc::clone(&self.body), side, TcpGoal::InBase(at)))?;
        let raised = match put {
            MotionOutcome::Put { raised, .. } => Translation3::new(0.0, 0.0, raised),
            _ => Translation3::identity(),
        };
        // The object is let go before the fingers open, as long as they hold it upright.
        self.run_one(LetGo::new(Arc::clone(&self.body), side, Some(object)))?;
        self.run_one(self.gripper(side, GripperCommand::Open))?;
        self.run_one(self.tcp(
            side,
            raised * second,
            TcpPath::Straight,
            CollisionMode::AllowHand,
        ))?;
        self.declared = AllowedPairs::none();
        self.run_one(self.tcp(
            side,
            raised * pre,
            TcpPath::Straight,
            CollisionMode::AvoidAll,
        ))?;
        Ok(put)
    }

    /// The object's pose in the frame of the base.
    pub fn in_base(&self, object: &str) -> Pose {
        let base = self.world.robot_configuration().base;
        base.inverse() * self.world.object_pose(object).unwrap()
    }
}

/// How a bottle is grasped: values of CRAM's object knowledge.
pub struct Grasp {
    pub translation: [f64; 3],
    pub rows: [[f64; 3]; 3],
    /// First and second pregrasp.
    pub offsets: [[f64; 3]; 2],
}

impl Grasp {
    fn rotation(&self) -> UnitQuaternion<f64> {
        let [a, b, c] = self.rows;
        let m = Matrix3::from_rows(&[a.into(), b.into(), c.into()]);
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(m))
    }
}

pub const LEFT_SIDE: Grasp = Grasp {
    translation: [0.0, -0.02, 0.005],
    rows: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
    offsets: [[0.0, 0.15, 0.15], [0.0, 0.15, 0.0]],
};
pub const RIGHT_SIDE: Grasp = Grasp {
    translation: [0.0, 0.02, 0.005],
    rows: [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    offsets: [[0.0, -0.15, 0.15], [0.0, -0.15, 0.0]],
};
pub const BACK: Grasp = Grasp {
    translation: [0.02, 0.0, 0.005],
    rows: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    offsets: [[-0.15, 0.0, 0.15], [-0.15, 0.0, 0.0]],
};
pub const FRONT: Grasp = Grasp {
    translation: [-0.02, 0.0, 0.005],
    rows: [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    offsets: [[0.15, 0.0, 0.15], [0.15, 0.0, 0.0]],
};
