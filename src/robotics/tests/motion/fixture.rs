//! A PR2 in the kitchen that carries out motions, for the tests of motions.

use crate::motion::jobs::gripper::{GripperCommand, MoveGripper};
use crate::motion::jobs::move_torso::MoveTorso;
use crate::motion::{
    CollisionMode, Drive, LetGo, Motion, MotionFailure, MotionOutcome, MotionStatus, MoveJoints,
    MoveTcp, PoseGoal, Put, TcpPath, held_objects, take_hold,
};
use crate::robot::Side;
use crate::world::grasp_library::{GRASPS, GraspLibrary, ToolPoses};
use crate::world::{AllowedPairs, BodyName, RobotConfiguration, World};
use nalgebra::Translation3;
use spatial::Pose;
use spatial::pose::{from_xy_yaw, from_xyz_rpy};

pub(crate) use crate::tests::world::fixture::models;

/// What a motion came to.
pub(crate) type Outcome = Result<MotionOutcome, MotionFailure>;

/// A robot in a kitchen.
pub(crate) struct Kitchen {
    pub(crate) world: World,
    /// Whether every step is checked for penetration.
    pub(crate) checked: bool,
    /// Pairs that may overlap now.
    pub(crate) declared: AllowedPairs,
}

impl Kitchen {
    /// The robot as after start-up: at the origin, arms tucked.
    pub(crate) fn new() -> Self {
        let models = models();
        let joints = models.description.start_positions(&models.robot);
        let robot = RobotConfiguration {
            base: Pose::identity(),
            joints,
        };
        let world = World::new(models, robot);
        let declared = AllowedPairs::none();
        Self {
            world,
            checked: true,
            declared,
        }
    }

    /// The robot with parked arms.
    pub(crate) fn parked(x: f64, y: f64, yaw_degrees: f64, torso: f64) -> Self {
        let mut kitchen = Self::new();
        let mut robot = kitchen.world.robot_configuration().clone();
        robot.base = from_xy_yaw(x, y, yaw_degrees.to_radians());
        let description = &kitchen.world.models().description;
        description.torso.set_height(&mut robot.joints, torso);
        for arm in &kitchen.world.models().description.arms {
            arm.set_positions(&mut robot.joints, arm.posture("park").unwrap());
        }
        kitchen.world.teleport_robot(&robot);
        kitchen
    }

    /// The smallest distance (m) of a robot, and of what it holds, from what is no part of it, up to the greatest one asked
    /// for; negative where they overlap.
    pub(crate) fn room(&self, robot: &RobotConfiguration, most: f64) -> f64 {
        let mut checker = self.world.collision_checker();
        let near = checker.all_hits(robot, &AllowedPairs::none(), most);
        let near = near
            .into_iter()
            .filter(|hit| hit.other.robot_link().is_none());
        near.map(|hit| -hit.depth).fold(most, f64::min)
    }

    pub(crate) fn spawn_bottle(&mut self, x: f64, y: f64, z: f64) {
        let at = from_xyz_rpy([x, y, z], [0.0; 3]);
        self.world
            .spawn("bottle-1", "bottle", &at, None, None)
            .unwrap();
        assert!(self.world.settle(5.0));
    }

    /// The hand and the object may touch, and the object may touch what it stands on.
    pub(crate) fn declare_grasp(&mut self, side: Side, object: &str) {
        let object = BodyName::Object(object.to_owned());
        let models = self.world.models();
        let hand = models
            .description
            .arm(side)
            .gripper
            .links()
            .map(|link| models.robot_body(link));
        self.declared = AllowedPairs::none().and_all(hand, &object);
    }

    /// Runs the motions at the same time until all have ended.
    pub(crate) fn run(&mut self, motions: &mut [&mut dyn Motion]) -> Vec<Outcome> {
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
    pub(crate) fn run_one(&mut self, mut motion: impl Motion) -> Outcome {
        self.run(&mut [&mut motion]).remove(0)
    }

    pub(crate) fn drive(&self, x: f64, y: f64, yaw_degrees: f64) -> Drive {
        Drive::new(&from_xy_yaw(x, y, yaw_degrees.to_radians()))
    }

    pub(crate) fn torso(&self, height: f64) -> MoveTorso {
        MoveTorso::new(height)
    }

    pub(crate) fn park(&self, left: bool, right: bool) -> MoveJoints {
        let posture = |side: Side, wanted: bool| {
            wanted.then(|| {
                self.world
                    .models()
                    .description
                    .arm(side)
                    .posture("park")
                    .unwrap()
                    .to_vec()
            })
        };
        MoveJoints::new(posture(Side::Left, left), posture(Side::Right, right))
    }

    pub(crate) fn gripper(&self, side: Side, command: GripperCommand) -> MoveGripper {
        MoveGripper::new(side, command)
    }

    pub(crate) fn tcp(
        &self,
        side: Side,
        pose: Pose,
        path: TcpPath,
        mode: CollisionMode,
    ) -> MoveTcp {
        let goal = Some(PoseGoal::InBase(pose));
        let (left, right) = match side {
            Side::Left => (goal, None),
            Side::Right => (None, goal),
        };
        MoveTcp::new(left, right, path, mode)
    }

    /// The poses of the tool for a grasp of a bottle, in the frame of the bottle's pose.
    pub(crate) fn grasp_poses(&self, side: Side, grasp: &str, bottle: &Pose) -> ToolPoses {
        let library = GraspLibrary::from_sexp(GRASPS, "grasps.sexp").unwrap();
        let definition = library.get("bottle", side, grasp).unwrap();
        let axes = self.world.models().description.arm(side).tool_axes;
        definition.tool_poses(bottle, &axes).unwrap()
    }

    /// The flow of CRAM's picking-up with a grasp of the library.
    pub(crate) fn pick(
        &mut self,
        side: Side,
        grasp: &str,
        object: &str,
        in_base: &Pose,
    ) -> Outcome {
        let poses = self.grasp_poses(side, grasp, in_base);
        self.pick_at(side, &poses, object)
    }

    /// The flow of CRAM's picking-up; stops at the first failure that matters.
    pub(crate) fn pick_at(&mut self, side: Side, poses: &ToolPoses, object: &str) -> Outcome {
        let mut open = self.gripper(side, GripperCommand::Position(0.10));
        let mut reach = self.tcp(side, poses.pregrasp, TcpPath::Free, CollisionMode::AvoidAll);
        let ends = self.run(&mut [&mut open, &mut reach]);
        for (what, end) in ["open", "pregrasp"].iter().zip(&ends) {
            if let Err(failure) = end {
                eprintln!("{what}: {failure}");
            }
        }
        self.run_one(self.tcp(
            side,
            poses.second_pregrasp,
            TcpPath::Free,
            CollisionMode::AvoidAll,
        ))?;
        self.declare_grasp(side, object);
        self.run_one(self.tcp(
            side,
            poses.grasp,
            TcpPath::Straight,
            CollisionMode::AllowHand,
        ))?;
        let grip = GripperCommand::Grip {
            object: Some(object.to_owned()),
            effort: None,
            together: false,
        };
        let gripped = self.run_one(self.gripper(side, grip))?;
        take_hold(&mut self.world, side, object)?;
        self.run_one(self.tcp(
            side,
            poses.lift,
            TcpPath::Straight,
            CollisionMode::AllowHand,
        ))?;
        Ok(gripped)
    }

    /// The flow of CRAM's placing.
    pub(crate) fn place(&mut self, side: Side, grasp: &str, target_in_base: &Pose) -> Outcome {
        let poses = self.grasp_poses(side, grasp, target_in_base);
        let object = held_objects(&self.world, side).remove(0);
        self.run_one(self.tcp(side, poses.lift, TcpPath::Free, CollisionMode::AvoidAll))?;
        let put = self.run_one(Put::new(side, PoseGoal::InBase(poses.grasp)))?;
        let raised = match put {
            MotionOutcome::Put { raised, .. } => Translation3::new(0.0, 0.0, raised),
            _ => Translation3::identity(),
        };
        // The object is let go before the fingers open, as long as they hold it upright.
        self.run_one(LetGo::new(side, Some(object)))?;
        self.run_one(self.gripper(side, GripperCommand::Open))?;
        self.run_one(self.tcp(
            side,
            raised * poses.second_pregrasp,
            TcpPath::Straight,
            CollisionMode::AllowHand,
        ))?;
        self.declared = AllowedPairs::none();
        self.run_one(self.tcp(
            side,
            raised * poses.pregrasp,
            TcpPath::Straight,
            CollisionMode::AvoidAll,
        ))?;
        Ok(put)
    }

    /// The object's pose in the frame of the base.
    pub(crate) fn in_base(&self, object: &str) -> Pose {
        let base = self.world.robot_configuration().base;
        base.inverse() * self.world.object_pose(object).unwrap()
    }
}
