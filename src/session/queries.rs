//! Queries about the world for embedding programs, to be used between inputs.
//!
//! Lengths are in metres, angles in radians, times in seconds. Poses are given in the map
//! frame: its origin is on the floor, x points forward, y to the left and z up. Names of
//! links and joints are those of the URDF.

use super::{FramedPose, Session};
use robotics::robot::Side;
use spatial::Pose;

impl Session {
    /// Simulated time (s) since the session began.
    pub fn time(&self) -> f64 {
        self.simulation().now()
    }

    /// Names of the objects in the world, in the order in which they were spawned. The
    /// object that a plan calls `'bottle-1` is `BOTTLE-1` here.
    pub fn objects(&self) -> Vec<&str> {
        let objects = self.simulation().world().objects();
        objects.map(|object| object.name()).collect()
    }

    /// Pose of an object's frame in the map frame (m).
    pub fn object_pose(&self, object: &str) -> Option<Pose> {
        self.simulation().world().object_pose(object).ok()
    }

    /// The pose in the map frame of a pose in any frame; `None` if there is no such frame.
    pub fn in_map(&self, placed: &FramedPose) -> Option<Pose> {
        let frame = self
            .simulation()
            .frame_in_map(&self.evaluator.image, &placed.frame);
        frame.ok().map(|frame| frame * placed.pose)
    }

    /// Pose of the robot's base, on the floor, in the map frame (m).
    pub fn robot_pose(&self) -> Pose {
        self.simulation().world().robot_configuration().base
    }

    /// Pose of the frame of a link of the robot in the map frame (m).
    pub fn link_pose(&self, link: &str) -> Option<Pose> {
        let world = self.simulation().world();
        let link = world.models().robot.link_named(link)?;
        Some(world.link_pose(link))
    }

    /// Position of a joint of the robot (rad, or m for a prismatic joint).
    pub fn joint_position(&self, joint: &str) -> Option<f64> {
        let world = self.simulation().world();
        let robot = &world.models().robot;
        let joint = robot.joint_named(joint)?;
        Some(robot.position(&world.robot_configuration().joints, joint))
    }

    /// How far a drawer or door of the kitchen is open: the position of its joint (m or rad).
    pub fn kitchen_joint_position(&self, joint: &str) -> Option<f64> {
        self.simulation().world().kitchen_joint(joint).ok()
    }

    /// Names of the objects that a hand holds.
    pub fn held_objects(&self, side: Side) -> Vec<String> {
        robotics::motion::held_objects(self.simulation().world(), side)
    }

    /// A hash of all bits of the world's state. The same inputs with the same seed give the
    /// same hash.
    pub fn world_hash(&self) -> u64 {
        self.simulation().world().hash()
    }
}
