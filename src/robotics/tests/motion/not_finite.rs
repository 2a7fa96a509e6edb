//! Goals that are no numbers are refused by every motion, and nothing moves.

use super::fixture::Kitchen;
use crate::motion::jobs::gripper::{GripperCommand, MoveGripper};
use crate::motion::jobs::move_torso::MoveTorso;
use crate::motion::{
    CollisionMode, Drive, Look, LookTarget, Motion, MotionFailure, MotionStatus, MoveJoints,
    MoveTcp, PoseGoal, TcpPath,
};
use crate::robot::Side;
use spatial::Pose;

#[test]
fn goals_that_are_no_numbers_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let pose = Pose::translation(bad, 0.0, 0.0);
        let tcp = Some(PoseGoal::InBase(pose));
        let motions: Vec<Box<dyn Motion>> = vec![
            Box::new(Drive::new(&pose)),
            Box::new(MoveTorso::new(bad)),
            Box::new(Look::new(LookTarget::InMap(pose))),
            Box::new(MoveGripper::new(Side::Left, GripperCommand::Position(bad))),
            Box::new(MoveJoints::new(Some(vec![bad; 7]), None)),
            Box::new(MoveTcp::new(
                tcp,
                None,
                TcpPath::Straight,
                CollisionMode::AvoidAll,
            )),
        ];
        for mut motion in motions {
            let mut kitchen = Kitchen::new();
            let before = kitchen.world.robot_configuration().clone();
            let module = motion.module();
            let end = loop {
                match motion.tick(&mut kitchen.world) {
                    MotionStatus::Running => kitchen.world.step(),
                    end => break end,
                }
            };
            let expected = MotionFailure::NotFinite { module };
            assert_eq!(end, MotionStatus::Failed(Box::new(expected)));
            assert_eq!(*kitchen.world.robot_configuration(), before);
        }
    }
}
