//! Handles in hands: what follows them, what they follow, and what stops them.

use nalgebra::Translation3;

use super::fixture::Kitchen;
use crate::motion::choosing::handle_chooser::HandleChoice;
use crate::motion::jobs::gripper::GripperCommand;
use crate::motion::jobs::move_torso::MoveTorso;
use crate::motion::jobs::pull::Pull;
use crate::motion::{
    CollisionMode, Effort, HandleChooser, HandleQuestion, MotionFailure, MotionOutcome,
    MotionStatus, MoveJoints, TcpPath,
};
use crate::motion::{Motion, MoveTcp, PoseGoal};
use crate::robot::{JointId, LinkId, Side};
use spatial::pose::{from_xy_yaw, from_xyz_rpy};

/// The upper drawer of the sink counter: its joint and handle.
const UPPER: [&str; 2] = [
    "sink_area_left_upper_drawer_main_joint",
    "sink_area_left_upper_drawer_handle",
];
/// The lowest one.
const BOTTOM: [&str; 2] = [
    "sink_area_left_bottom_drawer_main_joint",
    "sink_area_left_bottom_drawer_handle",
];
const FRIDGE: [&str; 2] = ["iai_fridge_door_joint", "iai_fridge_door_handle"];

impl Kitchen {
    fn joint_and_handle(&self, [joint, handle]: [&str; 2]) -> (JointId, LinkId) {
        let kitchen = &self.world.models().kitchen;
        (
            kitchen.joint_named(joint).unwrap(),
            kitchen.link_named(handle).unwrap(),
        )
    }

    /// The way to take a handle for bringing its joint to a position.
    fn choose(&self, names: [&str; 2], position: f64, arms: &[Side]) -> HandleChoice {
        let (joint, handle) = self.joint_and_handle(names);
        let question = HandleQuestion {
            part: self.world.part(joint),
            handle,
            position,
            arms: arms.to_vec(),
            grasps: Vec::new(),
        };
        let chooser = HandleChooser::new(&self.world, &question, Effort::THOROUGH);
        let base = self.world.robot_configuration().base;
        chooser.with_base_at(&base).unwrap()
    }

    /// Takes the handle as chosen, with fingers that press with an effort (N).
    fn take(&mut self, names: [&str; 2], choice: &HandleChoice, effort: f64) {
        let side = choice.side;
        self.run_one(self.gripper(side, GripperCommand::Position(0.06)))
            .unwrap();
        self.run_one(MoveTorso::new(choice.torso)).unwrap();
        let posture = Some(choice.posture.to_vec());
        let [left, right] = match side {
            Side::Left => [posture, None],
            Side::Right => [None, posture],
        };
        self.run_one(MoveJoints::new(left, right)).unwrap();
        self.run_one(to(side, choice.tool)).unwrap();
        let grip = GripperCommand::Grip {
            object: None,
            effort: Some(effort),
            together: false,
        };
        let gripped = self.run_one(self.gripper(side, grip)).unwrap();
        assert_eq!(
            gripped,
            MotionOutcome::Gripped {
                object: names[1].to_owned()
            }
        );
    }

    /// Opens a hand that has taken a handle, and withdraws it by 10 cm.
    fn leave(&mut self, side: Side) -> Result<MotionOutcome, MotionFailure> {
        self.run_one(self.gripper(side, GripperCommand::Position(0.06)))?;
        assert!(self.world.handle_hold(side).is_none());
        let arm = self.world.models().description.arm(side);
        let tool = arm.tool_for_wrist(&self.world.link_pose(arm.wrist));
        self.run_one(to(side, tool * Translation3::new(-0.1, 0.0, 0.0)))
    }

    fn position(&self, names: [&str; 2]) -> f64 {
        self.world.kitchen_joint(names[0]).unwrap()
    }

    /// Pulls, and checks in every step that hand and bar stay together; how it ends.
    fn pull(&mut self, side: Side, position: f64) -> Result<MotionOutcome, MotionFailure> {
        let mut pull = Pull::new(side, position);
        loop {
            let status = pull.tick(&mut self.world);
            self.world.step();
            if let Some(gap) = self.world.handle_gap(side) {
                assert!(gap <= 0.005, "{gap} m between hand and bar");
            }
            let hit = self.world.deepest_penetration(&self.declared, 0.002);
            assert!(hit.is_none(), "{hit:?}");
            match status {
                MotionStatus::Running => {}
                MotionStatus::Done(outcome) => return Ok(outcome),
                MotionStatus::Failed(failure) => return Err(*failure),
            }
        }
    }
}

/// A straight motion of one hand.
fn to(side: Side, pose: spatial::Pose) -> MoveTcp {
    let goal = Some(PoseGoal::InMap(pose));
    let [left, right] = match side {
        Side::Left => [goal, None],
        Side::Right => [None, goal],
    };
    MoveTcp::new(left, right, TcpPath::Straight, CollisionMode::AllowHand)
}

/// The robot in front of the sink counter, holding the handle of the upper drawer.
fn at_drawer(effort: f64) -> (Kitchen, Side) {
    let mut kitchen = Kitchen::parked(0.4, 0.6, 0.0, 0.2);
    let choice = kitchen.choose(UPPER, 0.4, &[Side::Right, Side::Left]);
    kitchen.take(UPPER, &choice, effort);
    (kitchen, choice.side)
}

#[test]
fn a_drawer_follows_the_hand_that_holds_its_handle_and_no_other() {
    let (mut kitchen, side) = at_drawer(50.0);
    assert_eq!(kitchen.position(UPPER), 0.0, "gripping moves nothing");
    assert_eq!(kitchen.pull(side, 0.4), Ok(MotionOutcome::Arrived));
    assert!((kitchen.position(UPPER) - 0.4).abs() < 1e-3);
    let reached = kitchen.position(UPPER);
    assert_eq!(kitchen.leave(side), Ok(MotionOutcome::Arrived));
    assert_eq!(
        kitchen.position(UPPER),
        reached,
        "an open hand moves nothing"
    );
    let end = kitchen.pull(side, 0.0);
    assert_eq!(end, Err(MotionFailure::HoldsNoHandle { side }));
    assert_eq!(
        end.unwrap_err().class_name(),
        "ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED"
    );
}

#[test]
fn fingers_that_press_too_little_slip_off() {
    // 2 × 3 N are less than it takes to move a drawer.
    let (mut kitchen, side) = at_drawer(3.0);
    let failure = kitchen.pull(side, 0.4).unwrap_err();
    assert_eq!(failure.class_name(), "GRIPPER-CLOSED-COMPLETELY");
    let text = failure.to_string();
    assert!(
        text.starts_with("Handle slipped\n") && text.contains("is at 0.000"),
        "{text}"
    );
    assert_eq!(kitchen.position(UPPER), 0.0);
    assert!(kitchen.world.handle_hold(side).is_none());
}

#[test]
fn a_hand_that_leaves_the_way_of_the_handle_loses_it() {
    let (mut kitchen, side) = at_drawer(50.0);
    kitchen.pull(side, 0.1).unwrap();
    let arm = kitchen.world.models().description.arm(side);
    let tool = arm.tool_for_wrist(&kitchen.world.link_pose(arm.wrist));
    // To the side, where the drawer does not go.
    let aside = Translation3::new(0.0, -0.05, 0.0) * tool;
    let failure = kitchen.run_one(to(side, aside)).unwrap_err();
    assert!(
        matches!(failure, MotionFailure::HandleSlipped(_)),
        "{failure}"
    );
    assert!((kitchen.position(UPPER) - 0.1).abs() < 1e-3);
}

#[test]
fn wherever_the_head_looks_the_same_way_to_take_a_handle_is_found() {
    let mut kitchen = Kitchen::parked(0.4, 0.6, 0.0, 0.2);
    let level = kitchen.choose(UPPER, 0.4, &[Side::Right, Side::Left]);
    let neck = kitchen.world.models().description.neck.joints.clone();
    let [pan, tilt] = neck[..] else {
        panic!("{neck:?}")
    };
    // Turned aside and down so far, the head is less than 4.5 mm from the torso.
    for (aside, down) in [(0.4, 1.27), (-0.4, 1.33), (0.0, 1.33), (0.4, 0.5)] {
        let mut robot = kitchen.world.robot_configuration().clone();
        robot.joints.set(pan, aside);
        robot.joints.set(tilt, down);
        kitchen.world.teleport_robot(&robot);
        let choice = kitchen.choose(UPPER, 0.4, &[Side::Right, Side::Left]);
        assert_eq!(choice, level, "{aside} rad aside, {down} rad down");
    }
}

#[test]
fn a_box_in_front_of_a_drawer_stops_it_before_it_begins() {
    let mut kitchen = Kitchen::parked(0.4, 0.5, 0.0, 0.1);
    let choice = kitchen.choose(BOTTOM, 0.4, &[Side::Right, Side::Left]);
    kitchen.take(BOTTOM, &choice, 50.0);
    let at = from_xyz_rpy([0.95, 1.15, 0.15], [0.0; 3]);
    kitchen
        .world
        .spawn("box-1", "breakfast-cereal", &at, None, None)
        .unwrap();
    kitchen.world.settle(5.0);
    let before = kitchen.world.object_pose("box-1").unwrap();
    let failure = kitchen.pull(choice.side, 0.4).unwrap_err();
    let MotionFailure::PartStopped(stopped) = &failure else {
        panic!("{failure}")
    };
    assert_eq!(stopped.hit.other.to_string(), "box-1");
    assert!(
        stopped.ahead.is_some_and(|q| (0.05..0.35).contains(&q)),
        "{failure}"
    );
    assert_eq!(
        failure.class_name(),
        "ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED"
    );
    let after = kitchen.world.object_pose("box-1").unwrap();
    assert!((after.translation.vector - before.translation.vector).norm() < 0.01);
    assert!(kitchen.position(BOTTOM) < 0.01);
}

#[test]
fn a_heavy_box_that_comes_into_the_way_is_not_pushed_on() {
    let mut kitchen = Kitchen::parked(0.4, 0.5, 0.0, 0.1);
    let choice = kitchen.choose(BOTTOM, 0.4, &[Side::Right, Side::Left]);
    kitchen.take(BOTTOM, &choice, 50.0);
    let mut pull = Pull::new(choice.side, 0.4);
    assert_eq!(pull.tick(&mut kitchen.world), MotionStatus::Running);
    // The motion has been planned; now somebody puts 200 kg there.
    let at = from_xyz_rpy([0.95, 1.15, 0.15], [0.0; 3]);
    kitchen
        .world
        .spawn("box-1", "breakfast-cereal", &at, None, Some(200.0))
        .unwrap();
    let before = kitchen.world.object_pose("box-1").unwrap();
    let failure = loop {
        let status = pull.tick(&mut kitchen.world);
        kitchen.world.step();
        match status {
            MotionStatus::Running => {}
            MotionStatus::Done(_) => panic!("it went through"),
            MotionStatus::Failed(failure) => break *failure,
        }
    };
    assert!(
        matches!(&failure, MotionFailure::PartStopped(stopped)
            if stopped.hit.other.to_string() == "box-1"),
        "{failure}"
    );
    let after = kitchen.world.object_pose("box-1").unwrap();
    let moved = (after.translation.vector - before.translation.vector)
        .xy()
        .norm();
    assert!(moved < 0.01, "{moved} m");
    assert!(kitchen.position(BOTTOM) < 0.3);
}

#[test]
fn a_robot_in_the_way_of_its_own_drawer_is_told() {
    let mut kitchen = Kitchen::parked(0.4, 0.5, 0.0, 0.1);
    let choice = kitchen.choose(BOTTOM, 0.1, &[Side::Right, Side::Left]);
    kitchen.take(BOTTOM, &choice, 50.0);
    let (joint, handle) = kitchen.joint_and_handle(BOTTOM);
    let question = |position| HandleQuestion {
        part: kitchen.world.part(joint),
        handle,
        position,
        arms: vec![choice.side.other()],
        grasps: Vec::new(),
    };
    // 0.48 m out, the front reaches the base of a robot that stands so near.
    let near = from_xy_yaw(0.45, 0.89, 0.0);
    let question = question(0.48);
    let chooser = HandleChooser::new(&kitchen.world, &question, Effort::QUICK);
    let nothing = chooser.with_base_at(&near).unwrap_err().to_string();
    assert!(nothing.contains("is in the way of"), "{nothing}");
}

#[test]
fn a_fridge_door_turns_with_the_hand() {
    let mut kitchen = Kitchen::parked(0.35, -0.35, -40.0, 0.2);
    let choice = kitchen.choose(FRIDGE, 0.6, &[Side::Right, Side::Left]);
    kitchen.take(FRIDGE, &choice, 50.0);
    assert_eq!(kitchen.pull(choice.side, 0.6), Ok(MotionOutcome::Arrived));
    assert!((kitchen.position(FRIDGE) - 0.6).abs() < 1e-3);
    assert_eq!(kitchen.pull(choice.side, 0.0), Ok(MotionOutcome::Arrived));
    assert!(kitchen.position(FRIDGE).abs() < 1e-3);
}

/// The same way of the door can be followed with the hand turned about its handle by several angles. After some of
/// them, the wrist is so bent that open fingers would be in the forearm, and the hand is caught.
#[test]
fn a_hand_that_has_opened_a_door_can_leave_its_handle() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.2);
    let before = kitchen.world.snapshot();
    let (joint, handle) = kitchen.joint_and_handle(FRIDGE);
    let bar = kitchen.world.furniture_pose(handle).translation;
    let mut opened = 0;
    for (i, j, k) in
        (-2..=2).flat_map(|i| (-2..=2).flat_map(move |j| (-1..=1).map(move |k| (i, j, k))))
    {
        kitchen.world.restore(&before);
        let mut robot = kitchen.world.robot_configuration().clone();
        let (x, y) = (
            bar.x - 0.6 + f64::from(i) * 0.1,
            bar.y + f64::from(j) * 0.15,
        );
        robot.base = from_xy_yaw(x, y, f64::from(k) * 0.4);
        let question = HandleQuestion {
            part: kitchen.world.part(joint),
            handle,
            position: 1.57,
            arms: vec![Side::Right],
            grasps: Vec::new(),
        };
        let chooser = HandleChooser::new(&kitchen.world, &question, Effort::THOROUGH);
        let Ok(choice) = chooser.with_base_at(&robot.base) else {
            continue;
        };
        kitchen.world.teleport_robot(&robot);
        kitchen.take(FRIDGE, &choice, 50.0);
        assert_eq!(kitchen.pull(choice.side, 1.57), Ok(MotionOutcome::Arrived));
        let left = kitchen.leave(choice.side);
        assert_eq!(left, Ok(MotionOutcome::Arrived), "{i} {j} {k}");
        opened += 1;
        if opened == 6 {
            return;
        }
    }
    panic!("only {opened} stands");
}

#[test]
fn a_restored_hold_goes_on_with_the_same_bits() {
    let (mut kitchen, side) = at_drawer(50.0);
    kitchen.pull(side, 0.1).unwrap();
    let pulled = kitchen.world.snapshot();
    kitchen.pull(side, 0.3).unwrap();
    let hash = kitchen.world.hash();
    kitchen.world.restore(&pulled);
    kitchen.pull(side, 0.3).unwrap();
    assert_eq!(kitchen.world.hash(), hash);
}

/// From most places around a door, its way leads out of the arm's reach; the arm is asked about a few points of
/// it, and followed along it only where it may get to all of them: along 651 points for each place in vain.
#[test]
fn an_arm_is_hardly_followed_along_ways_that_lead_out_of_reach() {
    let kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.1);
    let (joint, handle) = kitchen.joint_and_handle(FRIDGE);
    let question = HandleQuestion {
        part: kitchen.world.part(joint),
        handle,
        position: 1.57,
        arms: vec![Side::Right, Side::Left],
        grasps: Vec::new(),
    };
    let chooser = HandleChooser::new(&kitchen.world, &question, Effort::QUICK);
    let bar = kitchen.world.furniture_pose(handle).translation;
    let (mut refused, mut found) = (0, 0);
    for (i, j, turn) in (-4..=4)
        .flat_map(|i| (-4..=4).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let headings = (-1..=1).map(f64::from);
            headings.map(move |turn| (f64::from(i), f64::from(j), turn * 0.5))
        })
    {
        let (x, y) = (bar.x - 0.7 + i * 0.1, bar.y + j * 0.1);
        let base = from_xy_yaw(x, y, turn);
        if chooser.is_near(&base) {
            match chooser.with_base_at(&base) {
                Ok(_) => found += 1,
                Err(_) => refused += 1,
            }
        }
    }
    let points = chooser.points();
    assert!(refused > 100, "{refused} refused, {found} found");
    assert!(
        points < 800 * refused,
        "{points} points for {refused} places in vain, {found} found"
    );
}
