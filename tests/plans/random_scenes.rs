//! Questions to the world, answered in random scenes, against something else that knows the answer: the forces
//! of contacts, rays through a camera's pixels, a grid of postures.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;
use robotics::robot::Side;
use robotics::world::{AllowedPairs, BodyName, World};
use session::{Session, SessionOptions};
use spatial::Pose;

use super::rays::{Body, Eye};
use super::{said, said_and_printed};

/// What stands on what in a kitchen.
const TYPES: [&str; 9] = [
    "bottle", "cup", "bowl", "plate", "milk", "mug", "cereal", "spoon", "apple",
];
/// Surfaces: x, y (m) between which things are put on them, height (m), and where the robot stands before them.
const SURFACES: [([f64; 2], [f64; 2], f64, &str); 2] = [
    (
        [-1.75, -1.25],
        [-1.15, -0.7],
        0.72,
        "((-1.447 -0.15 0) (0 0 -0.7071 0.7071))",
    ),
    (
        [-1.05, -0.7],
        [1.25, 2.1],
        0.86,
        "((-1.75 1.7 0) (0 0 0 1))",
    ),
];

/// A kitchen in which a seed decides what is where.
struct Scene {
    session: Session,
    numbers: Pcg64Mcg,
}

impl Scene {
    fn new() -> Self {
        let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
        said(
            &mut session,
            "(in-package :btr)
             (defun rows-of (variables goal)
               (mapcar (lambda (answer)
                         (mapcar (lambda (variable) (cut:var-value variable answer)) variables))
                       (cut:force-ll (prolog-?w goal))))",
        );
        Self {
            session,
            numbers: Pcg64Mcg::new(0),
        }
    }

    /// A number from 0 to 1.
    fn share(&mut self) -> f64 {
        (self.numbers.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, [least, most]: [f64; 2]) -> f64 {
        least + self.share() * (most - least)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.share() * count as f64) as usize
    }

    /// Two to eight things on a surface, before which the robot stands and to which it looks, more or less; some
    /// of the things are let fall on others.
    fn arrange(&mut self, seed: u64) {
        self.numbers = Pcg64Mcg::new(0x5eed << 64 | u128::from(seed));
        let (along, across, height, stand) = SURFACES[self.below(SURFACES.len())];
        let [pan, tilt] = [self.between([-0.5, 0.5]), self.between([0.5, 0.9])];
        let mut text = format!(
            "(progn (pp-tut:init-projection)
               (rows-of '() '(assert (object-pose ?w :robot {stand})))
               (%set-joint :robot \"head_pan_joint\" {pan})
               (%set-joint :robot \"head_tilt_joint\" {tilt})"
        );
        let mut last: Option<[f64; 2]> = None;
        for index in 0..2 + self.below(7) {
            let kind = TYPES[self.below(TYPES.len())];
            let [x, y, z] = match last {
                Some([x, y]) if self.share() < 0.4 => {
                    let aside = [self.between([-0.04, 0.04]), self.between([-0.04, 0.04])];
                    [x + aside[0], y + aside[1], height + 0.3]
                }
                _ => [self.between(along), self.between(across), height + 0.1],
            };
            last = Some([x, y]);
            let half = self.between([0.0, std::f64::consts::PI]);
            text += &format!(
                "(btr-utils:spawn-object 'thing-{index} :{kind} :pose '(({x} {y} {z}) (0 0 {} {})))",
                half.sin(),
                half.cos()
            );
        }
        text += "(simulate *current-bullet-world* 4) nil)";
        said(&mut self.session, &text);
    }

    fn world(&self) -> &World {
        self.session.simulation().world()
    }

    /// The answers to a question as rows of words, in lower case.
    fn rows(&mut self, variables: &str, goal: &str) -> Vec<Vec<String>> {
        let form = format!("(format t \"~(~{{~{{~a ~}}~%~}}~)\" (rows-of '({variables}) '{goal}))");
        let printed = said_and_printed(&mut self.session, &form);
        printed
            .lines()
            .filter(|line| *line != "NIL")
            .map(|line| line.split_whitespace().map(str::to_owned).collect())
            .filter(|row: &Vec<String>| !row.is_empty())
            .collect()
    }

    fn things(&self) -> Vec<String> {
        self.world()
            .objects()
            .map(|o| o.name().to_owned())
            .collect()
    }
}

/// The name of a body in answers: robot and furniture are one each.
fn named(body: &BodyName) -> String {
    match body {
        BodyName::Object(name) => name.to_lowercase(),
        BodyName::Robot(_) => "robot".to_owned(),
        BodyName::Furniture(_) => "kitchen".to_owned(),
        BodyName::Floor => "floor".to_owned(),
    }
}

/// The full run looks at so many scenes.
const MANY: u64 = 200;

/// What supports a thing presses it up with its weight, and nothing else does; what loses its only support falls. There
/// must be more than so many things at rest, and of those that fall.
fn supports_agree(scenes: u64, [least_resting, least_fallen]: [u32; 2]) {
    let mut scene = Scene::new();
    let (mut resting, mut unpressed, mut fallen) = (0, 0, 0);
    for seed in 0..scenes {
        scene.arrange(seed);
        let rows = scene.rows("?t ?b", "(supported-by ?w ?t ?b)");
        let world = scene.world();
        for object in world.objects() {
            let name = object.name();
            if world.moving_objects().any(|moving| moving.name() == name) {
                continue;
            }
            let told: Vec<&str> = rows
                .iter()
                .filter(|row| row[0] == name.to_lowercase())
                .map(|row| {
                    if row[1].ends_with("pr2") {
                        "robot"
                    } else {
                        &*row[1]
                    }
                })
                .collect();
            assert!(!told.is_empty(), "scene {seed}: nothing supports {name}");
            resting += 1;
            let (mut by_told, mut by_others) = (0.0, 0.0);
            for press in world.presses(object) {
                match told.contains(&&*named(&press.body)) {
                    true => by_told += press.force.z,
                    false => by_others += f64::max(0.0, press.force.z),
                }
            }
            if by_told == 0.0 && by_others == 0.0 {
                // The engine lets some things rest without a contact that presses.
                unpressed += 1;
            } else {
                // Friction, which these forces leave out, bears the rest of what leans.
                let weight = object.mass() * 9.81;
                assert!(
                    by_told > 0.7 * weight && by_others < 0.1 * weight,
                    "scene {seed}: {told:?} bear {by_told:.2} of {weight:.2} N of {name}, others {by_others:.2} N"
                );
            }
            if let [only] = told[..]
                && only.starts_with("thing")
            {
                let mut without = world.clone();
                without.remove(&only.to_uppercase()).unwrap();
                without.settle(1.0);
                let height = |world: &World| world.object_pose(name).unwrap().translation.z;
                let drop = height(world) - height(&without);
                assert!(drop > 0.001, "scene {seed}: {name} stays up without {only}");
                fallen += 1;
            }
        }
    }
    println!(
        "{resting} things at rest, {unpressed} of them not pressed; {fallen} fell without what carried them"
    );
    assert!(resting > least_resting && fallen > least_fallen);
    assert!(unpressed < 20, "{unpressed} things are pressed by nothing");
}

/// What is visible is what rays through the camera's pixels hit. There must be more than so much that is seen, and that is
/// not.
fn sights_agree(scenes: u64, least: [u32; 2]) {
    let mut scene = Scene::new();
    let (mut seen, mut unseen, mut near) = (0, 0, 0);
    for seed in 0..scenes {
        scene.arrange(seed);
        let visible = scene.rows("?o", "(visible ?w ?r ?o)");
        let world = scene.world();
        let camera = world.models().description.camera();
        let eye = Eye {
            pose: world.link_pose(camera.frame),
            size: [camera.width, camera.height],
            half_height: (camera.vertical_view / 2.0).tan(),
            range: [camera.near, camera.far],
        };
        let shapes = world.shapes();
        let bodies: Vec<Body<'_>> = shapes
            .iter()
            .map(|shape| Body::new(shape.key, shape.shape, shape.pose))
            .collect();
        for object in world.objects() {
            let name = object.name();
            let middle = world.object_pose(name).unwrap();
            let share = eye.share_in_sight(&bodies, object.key(), &middle);
            let told = visible.iter().any(|row| row[0] == name.to_lowercase());
            // The share that must be in sight is 0.9.
            if (share - 0.9).abs() < 0.03 {
                near += 1;
                continue;
            }
            let expected = share > 0.9;
            assert_eq!(
                told, expected,
                "scene {seed}: {share:.3} of {name} is in sight"
            );
            match told {
                true => seen += 1,
                false => unseen += 1,
            }
        }
    }
    println!("{seen} seen, {unseen} not, {near} near the threshold");
    assert!(seen > least[0] && unseen > least[1]);
    assert!(near < seen + unseen, "{near} decide nothing");
}

/// Whether, on a grid of heights of the torso and of the arm's free angle, a posture brings the tool to a pose (in
/// the frame of the base) and keeps a distance (m) from everything; the hand may touch an object.
fn grid_reaches(
    world: &World,
    side: Side,
    tool: &Pose,
    opening: f64,
    touched: Option<&str>,
    room: f64,
    steps: u32,
) -> bool {
    let models = world.models();
    let body = &models.description;
    let arm = body.arm(side);
    let mut allowed = AllowedPairs::none();
    if let Some(name) = touched {
        let hand = arm.gripper.links().map(|link| models.robot_body(link));
        allowed = allowed.and_all(hand, &BodyName::Object(name.to_owned()));
    }
    let mut world = world.clone();
    let mut robot = world.robot_configuration().clone();
    robot
        .joints
        .set(arm.gripper.joint, arm.gripper.position_for_opening(opening));
    let limits = body.torso.limits;
    let range = limits.upper - limits.lower;
    let heights = (0..=steps).map(|i| limits.lower + range * f64::from(i) / f64::from(steps));
    for height in std::iter::once(body.torso.height(&robot.joints)).chain(heights) {
        body.torso.set_height(&mut robot.joints, height);
        world.teleport_robot(&robot);
        let shoulder = world.link_pose(arm.base);
        let goal = robot.base * tool;
        let wrist = shoulder.inverse() * arm.wrist_for_tool(&goal);
        for positions in arm.kinematics.solutions(&wrist, 0.1) {
            let mut posture = robot.clone();
            arm.set_positions(&mut posture.joints, &positions);
            world.teleport_robot(&posture);
            if world.deepest_penetration(&allowed, -room).is_none() {
                return true;
            }
        }
    }
    false
}

/// What is reachable is reached by postures of a grid, and what these reach with room to spare is reachable. There must be
/// more than so many grasps of either kind.
fn reaches_agree(scenes: u64, least: [u32; 2]) {
    let mut scene = Scene::new();
    let (mut reached, mut missed) = (0, 0);
    for seed in 0..scenes {
        scene.arrange(seed);
        let rows = scene.rows("?o ?s ?g", "(reachable ?w ?r ?o ?s ?g)");
        let library = scene.session.simulation().grasp_library().clone();
        for thing in scene.things().into_iter().take(2) {
            let world = scene.world();
            let kind = world.object(&thing).unwrap().type_name().to_owned();
            let base = world.robot_configuration().base;
            let object = base.inverse() * world.object_pose(&thing).unwrap();
            for side in [Side::Left, Side::Right] {
                for grasp in library.grasps(&kind) {
                    let Some(definition) = library.get(&kind, side, grasp) else {
                        continue;
                    };
                    let arm = if side == Side::Left { "left" } else { "right" };
                    let told = rows.contains(&vec![
                        thing.to_lowercase(),
                        arm.into(),
                        grasp.to_lowercase(),
                    ]);
                    let axes = &world.models().description.arm(side).tool_axes;
                    let poses = definition.tool_poses(&object, axes).unwrap();
                    let opening = library.opening(&kind, definition);
                    let reach = |tool: &Pose, touched: Option<&str>, room: f64, steps: u32| {
                        grid_reaches(world, side, tool, opening, touched, room, steps)
                    };
                    if told {
                        reached += 1;
                        for (tool, touched) in [
                            (&poses.second_pregrasp, None),
                            (&poses.grasp, Some(&*thing)),
                        ] {
                            assert!(
                                reach(tool, touched, -0.001, 60),
                                "scene {seed}: no posture of the grid grasps {thing} ({kind}) {arm} {grasp}"
                            );
                        }
                        continue;
                    }
                    let way = [
                        (&poses.grasp, Some(&*thing)),
                        (&poses.second_pregrasp, None),
                        (&poses.lift, Some(&*thing)),
                        (&poses.pregrasp, None),
                    ];
                    assert!(
                        !way.iter()
                            .all(|(tool, touched)| reach(tool, *touched, 0.005, 12)),
                        "scene {seed}: the grid grasps {thing} ({kind}) {arm} {grasp}"
                    );
                    missed += 1;
                }
            }
        }
    }
    println!("{reached} grasps reached, {missed} not");
    assert!(reached > least[0] && missed > least[1]);
}

#[test]
fn what_supports_carries_the_weight_and_nothing_else_does() {
    supports_agree(24, [64, 4]);
}

#[test]
fn what_is_visible_is_hit_by_rays_through_the_camera_s_pixels() {
    sights_agree(16, [16, 16]);
}

#[test]
fn what_is_reachable_is_reached_by_a_grid_of_inverse_kinematics() {
    reaches_agree(12, [5, 100]);
}

/// What blocks an object is found without a look at each of the others, and is what that look finds.
#[test]
fn what_blocks_is_what_a_hand_can_do_without() {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    let told = said_and_printed(
        &mut session,
        "(in-package :btr)
         (pp-tut:init-projection)
         (defun looked-for (item sides)
           (unless (%reached-grasps (list item) sides :object)
             (loop for other in (remove item (pw::%objects-of-world))
                   when (%reached-grasps (list item) sides :object (list other))
                     collect other)))
         (defvar *blocked* 0)
         (defvar *different* '())
         (dolist (count '(9 5 10 6 11 7))
           (btr-utils:kill-all-objects)
           (dotimes (i count)
             (btr-utils:spawn-object
              (intern (format nil \"THING-~a\" i)) (nth (random 5) '(:bottle :cup :bowl :mug :milk))
              :pose (list (list (- -1.0 (random 0.4)) (+ 0.6 (random 0.5)) 0.97) '(0 0 0 1))))
           (prolog-?w (list 'assert (list 'object-pose '?w :robot
                                          (list (list (- -0.2 (random 0.4)) (+ 0.7 (random 0.5)) 0)
                                                '(0 0 1 0)))))
           (dolist (item (pw::%objects-of-world))
             (dolist (sides '((:left :right) (:left) (:right)))
               (let ((others (looked-for item sides)))
                 (when others (incf *blocked*))
                 (unless (equal others (blockers item sides))
                   (push (list item sides others (blockers item sides)) *different*))))))
         (format t \"~a different, ~a\" *different* (if (> *blocked* 3) \"enough\" *blocked*))",
    );
    assert!(told.contains("NIL different, enough"), "{told}");
}

/// What is stable is where it was after five seconds in which nothing is done, while a ball falls, rolls and comes to
/// rest: also in the moment in which the hand lets go of it, at which nothing moves yet.
#[test]
fn what_is_stable_stays_while_something_falls_and_rolls() {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    said(
        &mut session,
        "(in-package :btr)
         (pp-tut:init-projection)
         (btr-utils:spawn-object 'plate-1 :plate :pose '((-0.9 1.2 0.9) (0 0 0 1)))
         (btr-utils:spawn-object 'cup-1 :cup :pose '((-0.9 1.2 1.0) (0 0 0 1)))
         (btr-utils:spawn-object 'bottle-1 :bottle :pose '((-0.9 1.6 1.0) (0 0 0 1)))
         (%spawn-shape 'ball-1 :sphere '(0.04) '((-0.75 1.9 0.95) (0 0 0 1)) 0.2 nil)
         (prolog-?w '(assert (attached ?w :robot \"l_gripper_tool_frame\" ball-1 :top)))
         (prolog-?w '(assert (object-pose ?w :robot ((0.12 0 0) (0 0 0 1)))))
         (%set-joint :robot \"torso_lift_joint\" 0.3)
         (defun stable-now ()
           (sort (mapcar (lambda (answer) (cut:var-value '?o answer))
                         (cut:force-ll (prolog-?w '(stable ?w ?o))))
                 #'string<))
         (defun staying ()
           (let ((before (mapcar #'btr-utils:object-pose (pw::%objects-of-world))))
             (with-trial
               (%let-pass 5)
               (sort (loop for object in (pw::%objects-of-world)
                           for pose in before
                           for now = (btr-utils:object-pose object)
                           when (and (<= (cl-transforms:v-dist (cl-transforms:origin pose)
                                                               (cl-transforms:origin now))
                                         0.005)
                                     (<= (cl-transforms:angle-between-quaternions
                                          (cl-transforms:orientation pose)
                                          (cl-transforms:orientation now))
                                         0.15))
                             collect object)
                     #'string<))))",
    );
    let told = |session: &mut Session, form: &str| {
        let printed = said_and_printed(session, &format!("(format t \"~a\" {form})"));
        printed.trim_end_matches("NIL").to_owned()
    };
    assert_eq!(
        told(&mut session, "(stable-now)"),
        "(BALL-1 BOTTLE-1 CUP-1 PLATE-1)"
    );
    said(&mut session, "(%take-from-hand 'ball-1)");
    assert_eq!(
        told(&mut session, "(stable-now)"),
        "(BOTTLE-1 CUP-1 PLATE-1)"
    );
    said(&mut session, "(%begin-trial)");
    let (mut rolls, mut rests) = (0, 0);
    for _ in 0..14 {
        said(&mut session, "(%let-pass 0.2)");
        let stable = told(&mut session, "(stable-now)");
        assert_eq!(stable, told(&mut session, "(staying)"));
        match stable.contains("BALL-1") {
            true => rests += 1,
            false => rolls += 1,
        }
    }
    assert!(rolls > 3 && rests > 1, "{rolls} {rests}");
    // What stood on something that is taken away falls.
    said(&mut session, "(btr-utils:kill-object 'plate-1)");
    let stable = told(&mut session, "(stable-now)");
    assert!(!stable.contains("CUP-1"), "{stable}");
}

/// One question about all objects answers like one for each grasp, and one as if others were not there like one in a
/// trial in which they are gone; also while a hand holds something.
#[test]
fn one_question_about_all_objects_answers_like_many() {
    let mut scene = Scene::new();
    said(
        &mut scene.session,
        "(defun one-by-one (item side grasp)
           (pp-tut:grasp-reachable-p item side grasp))
         (defun rows-one-by-one ()
           (loop for item in (pw::%objects-of-world)
                 append (loop for side in '(:left :right)
                              append (loop for grasp in (%grasps-of (pw::%type-of-object item) side)
                                           when (one-by-one item side grasp)
                                             collect (list item side grasp)))))
         (defun any-without-p (item others)
           (with-trial
             (mapc #'btr-utils:kill-object others)
             (loop for side in '(:left :right)
                   thereis (some (lambda (grasp) (one-by-one item side grasp))
                                 (%grasps-of (pw::%type-of-object item) side)))))
         (defun blocking-one-by-one ()
           (loop for item in (pw::%objects-of-world)
                 unless (any-without-p item '())
                   append (loop for other in (remove item (pw::%objects-of-world))
                                when (any-without-p item (list other))
                                  collect (list item other))))",
    );
    let (mut reached, mut blocking) = (0, 0);
    for seed in 0..10 {
        scene.arrange(seed);
        if seed % 3 == 0 {
            said(
                &mut scene.session,
                "(%put-in-hand (first (pw::%objects-of-world)) :left :top)",
            );
        }
        let told = |scene: &mut Scene, form: &str| {
            said_and_printed(&mut scene.session, &format!("(format t \"~(~a~)\" {form})"))
        };
        let all = told(
            &mut scene,
            "(rows-of '(?o ?s ?g) '(reachable ?w ?r ?o ?s ?g))",
        );
        let each = told(&mut scene, "(rows-one-by-one)");
        assert_eq!(all, each, "scene {seed}");
        reached += all.matches(") (").count();
        let all = told(&mut scene, "(rows-of '(?o ?x) '(blocking ?w ?r ?o ?x))");
        let each = told(&mut scene, "(blocking-one-by-one)");
        assert_eq!(all, each, "scene {seed}");
        blocking += all.matches(") (").count();
    }
    assert!(reached > 10 && blocking > 1, "{reached} {blocking}");
}

#[test]
#[ignore = "takes minutes"]
fn questions_agree_in_200_scenes() {
    supports_agree(MANY, [800, 100]);
    sights_agree(MANY, [400, 200]);
    reaches_agree(MANY, [200, 1000]);
}
