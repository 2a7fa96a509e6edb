//! The inverse kinematics of any chain: what it finds, what it says of the rest.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::time::Instant;

use super::chains::{self, chain, read};
use crate::robot::arm_positions::ArmPositions;
use crate::robot::closed_form::ClosedForm;
use crate::robot::{KinematicTree, Miss, NumericKinematics};
use descriptions::PR2_URDF;
use nalgebra::Translation3;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use spatial::Pose;
use spatial::pose::{angle_between, distance_between, from_xyz_rpy};

/// Random postures within the limits.
struct Postures(Pcg64);

impl Postures {
    fn new() -> Self {
        Self(Pcg64::seed_from_u64(7))
    }

    fn next(&mut self, arm: &NumericKinematics) -> ArmPositions {
        let mut share = || f64::from(self.0.next_u32()) / f64::from(u32::MAX);
        let positions = arm.limits().iter().map(|limits| match limits {
            Some(limits) => limits.lower + share() * (limits.upper - limits.lower),
            None => PI * (2.0 * share() - 1.0),
        });
        positions.collect()
    }
}

fn middle(arm: &NumericKinematics) -> ArmPositions {
    let limits = arm.limits().iter();
    limits
        .map(|limits| limits.map_or(0.0, |l| (l.lower + l.upper) / 2.0))
        .collect()
}

fn arm(rows: &[chains::Row]) -> NumericKinematics {
    let (tree, base, tip) = chain(rows);
    NumericKinematics::new(&tree, base, tip).expect("the chain can be solved")
}

fn check(arm: &NumericKinematics, goal: &Pose, found: &ArmPositions) {
    let reached = arm.forward(found);
    assert_eq!(found.len(), arm.joints().len());
    assert!(distance_between(goal, &reached) < 1e-6, "{found:?}");
    assert!(angle_between(goal, &reached) < 1e-5, "{found:?}");
    for (position, limits) in found.iter().zip(arm.limits()) {
        assert!(limits.is_none_or(|l| l.contains(*position)), "{found:?}");
    }
}

/// Solves for the poses of random postures, starting at the middle of the limits.
fn finds_every_reachable_pose(arm: &NumericKinematics, goals: usize) {
    let mut postures = Postures::new();
    let seed = middle(arm);
    let mut reached = 0;
    for _ in 0..goals {
        let goal = arm.forward(&postures.next(arm));
        let found = arm.nearest(&goal, &seed);
        let found = found.unwrap_or_else(|miss| panic!("{miss}"));
        check(arm, &goal, &found);
        for ((position, seed), limits) in found.iter().zip(&seed).zip(arm.limits()) {
            assert!(limits.is_some() || (position - seed).abs() <= PI + 1e-9);
        }
        reached += usize::from(arm.reaches(&goal));
    }
    // The quick answer may miss a few.
    assert!(reached * 100 >= goals * 99, "{reached} of {goals}");
}

fn pr2_arm() -> (KinematicTree, NumericKinematics, ClosedForm) {
    let (tree, base, tip) = read(PR2_URDF, "torso_lift_link", "r_wrist_roll_link");
    let numeric = NumericKinematics::new(&tree, base, tip).expect("the chain can be solved");
    let closed = ClosedForm::new(&tree, base, tip).expect("the arm suits the closed form");
    (tree, numeric, closed)
}

#[test]
fn every_reachable_pose_of_the_pr2_is_found() {
    finds_every_reachable_pose(&pr2_arm().1, 1000);
}

#[test]
fn every_reachable_pose_of_fetch_is_found() {
    finds_every_reachable_pose(&arm(chains::FETCH), 1000);
    finds_every_reachable_pose(&arm(&chains::fetch_with_torso()), 1000);
}

#[test]
fn every_reachable_pose_of_a_ur5_is_found() {
    finds_every_reachable_pose(&arm(chains::UR5), 1000);
}

#[test]
fn every_reachable_pose_of_a_panda_is_found() {
    finds_every_reachable_pose(&arm(chains::PANDA), 1000);
}

#[test]
fn every_reachable_pose_of_a_stretch_is_found() {
    finds_every_reachable_pose(&arm(chains::STRETCH), 1000);
}

#[test]
fn the_tip_is_where_the_tree_and_the_closed_form_have_it() {
    let (tree, numeric, closed) = pr2_arm();
    let [base, tip] = ["torso_lift_link", "r_wrist_roll_link"]
        .map(|name| tree.link_named(name).expect("the PR2 has an arm"));
    assert_eq!(numeric.joints(), closed.joints());
    assert_eq!(numeric.limits(), closed.limits());
    let mut postures = Postures::new();
    for _ in 0..100 {
        let posture = postures.next(&numeric);
        let mut q = tree.zero_positions();
        for (joint, position) in numeric.joints().iter().zip(&posture) {
            q.set(*joint, *position);
        }
        let there = tree
            .relative_pose(base, tip, &q)
            .expect("they are connected");
        let here = numeric.forward(&posture);
        assert!(distance_between(&here, &there) < 1e-12 && angle_between(&here, &there) < 1e-7);
        assert!(closed.reaches(&here));
    }
}

#[test]
fn what_the_closed_form_proves_unreachable_is_not_found() {
    let (_, numeric, closed) = pr2_arm();
    let mut postures = Postures::new();
    let mut unreachable = 0;
    for _ in 0..200 {
        let posture = postures.next(&numeric);
        let goal = numeric.forward(&posture) * Translation3::new(0.0, 0.3, 0.0);
        if !closed.reaches(&goal) {
            unreachable += 1;
            assert!(!numeric.reaches(&goal));
            assert!(numeric.solutions(&goal, 0.1).is_empty());
        }
    }
    assert!(unreachable > 50, "{unreachable}");
}

#[test]
fn a_posture_at_its_goal_stays_and_small_moves_are_small() {
    for arm in [arm(chains::FETCH), arm(chains::PANDA), pr2_arm().1] {
        let mut postures = Postures::new();
        for _ in 0..100 {
            let seed = postures.next(&arm);
            let here = arm.forward(&seed);
            assert_eq!(arm.nearest(&here, &seed).as_ref(), Ok(&seed));
            let goal = Translation3::new(0.0, 0.0, 1e-3) * here;
            // Near limits and singularities a small move may need a great one of the joints.
            if let Ok(found) = arm.nearest(&goal, &seed) {
                check(&arm, &goal, &found);
            }
        }
    }
    let arm = arm(chains::FETCH);
    let seed = ArmPositions::from([0.3, 0.4, -0.5, 1.2, 0.6, 1.0, 0.2]);
    let goal = Translation3::new(0.01, 0.0, 0.0) * arm.forward(&seed);
    let found = arm.nearest(&goal, &seed).expect("it is near");
    assert!(found.iter().zip(&seed).all(|(a, b)| (a - b).abs() < 0.1));
}

#[test]
fn the_same_question_has_the_same_answer_to_the_bit() {
    let (one, other) = (arm(chains::PANDA), arm(chains::PANDA));
    let mut postures = Postures::new();
    for _ in 0..50 {
        let goal = one.forward(&postures.next(&one));
        let bits = |arm: &NumericKinematics| {
            let found = arm.nearest(&goal, &middle(arm)).expect("it is reachable");
            found.iter().map(|p| p.to_bits()).collect::<Vec<_>>()
        };
        let first = bits(&one);
        let _ = one.solutions(&goal, 0.3);
        assert_eq!(first, bits(&one));
        assert_eq!(first, bits(&other));
    }
}

#[test]
fn joints_that_turn_freely_stay_within_half_a_turn_of_the_seed() {
    let arm = arm(chains::FETCH);
    let seed = ArmPositions::from([0.2, 0.5, 40.0, 1.0, -31.0, 0.8, 17.0]);
    let goal = Translation3::new(0.0, 0.02, 0.0) * arm.forward(&seed);
    let found = arm.nearest(&goal, &seed).expect("it is near");
    check(&arm, &goal, &found);
    assert!(
        found.iter().zip(&seed).all(|(a, b)| (a - b).abs() < 0.2),
        "{found:?}"
    );
}

#[test]
fn a_joint_of_several_turns_takes_the_one_of_the_seed() {
    let arm = arm(chains::UR5);
    let near = ArmPositions::try_from([5.0, -1.0, 1.2, -4.0, -1.5, 5.5].as_slice());
    let near = near.expect("six are not too many");
    let goal = arm.forward(&near);
    let elsewhere = ArmPositions::from_iter(near.iter().map(|p| p + 0.05));
    let found = arm.nearest(&goal, &elsewhere).expect("it is near");
    assert!(
        found.iter().zip(&near).all(|(a, b)| (a - b).abs() < 1e-3),
        "{found:?}"
    );
}

#[test]
fn solutions_are_many_and_different() {
    let fetch = arm(chains::FETCH);
    let goal = fetch.forward(&[0.3, 0.4, -0.5, 1.2, 0.6, 1.0, 0.2]);
    let found = fetch.solutions(&goal, 0.2);
    assert!((10..=60).contains(&found.len()), "{}", found.len());
    for (i, one) in found.iter().enumerate() {
        check(&fetch, &goal, one);
        for other in &found[..i] {
            assert!(one.iter().zip(other).any(|(a, b)| (a - b).abs() >= 0.2));
        }
    }
    let ur5 = arm(chains::UR5);
    let goal = ur5.forward(&[0.5, -1.0, 1.2, -0.7, -1.5, 0.3]);
    // Shoulder, elbow and wrist each have two ways.
    let mut ways: Vec<Vec<i64>> = Vec::new();
    for found in ur5.solutions(&goal, 0.1) {
        check(&ur5, &goal, &found);
        let way = found
            .iter()
            .map(|p| (p.rem_euclid(TAU) * 1e3).round() as i64 % 6283);
        ways.push(way.collect());
    }
    ways.sort();
    ways.dedup();
    assert_eq!(ways.len(), 8, "{ways:?}");
}

#[test]
fn what_is_too_far_is_proved_and_the_rest_is_said_as_it_is() {
    let arm = arm(chains::FETCH);
    let away = |x: f64| from_xyz_rpy([x, 0.0, 0.409], [0.0; 3]);
    let seed = middle(&arm);
    // The shoulder is at x = 0.12, and 1.095 m are between it and the tool if all is stretched.
    let miss = arm.nearest(&away(1.525), &seed).expect_err("it is too far");
    assert!(miss.to_string().starts_with("too far: 0.3"), "{miss}");
    assert!(
        miss.to_string().ends_with(" m beyond the arm's length"),
        "{miss}"
    );
    assert!(!arm.reaches(&away(1.525)));
    // Inside of the robot's own shoulder nothing is proved.
    let inside = from_xyz_rpy([0.0, 0.0, 0.2], [0.0, 3.0, 0.0]);
    let miss = arm
        .nearest(&inside, &seed)
        .expect_err("the arm does not fold so");
    let text = miss.to_string();
    assert!(
        text.starts_with("no posture found in 100 tries (nearest: "),
        "{text}"
    );
    assert!(text.ends_with("°)"), "{text}");
    assert!(!arm.reaches(&inside));
    let told = |distance, angle| {
        let tries = 100;
        Miss::NotFound {
            tries,
            distance,
            angle,
        }
        .to_string()
    };
    assert!(told(0.008, 0.035).ends_with("(nearest: 8 mm, 2°)"));
    assert!(told(0.0002, 0.0035).ends_with("(nearest: 0.2 mm, 0.2°)"));
    assert!(told(0.25, 1.0).ends_with("(nearest: 0.25 m, 57°)"));
}

/// A bound that is too small would refuse what can be reached.
#[test]
fn no_reachable_pose_is_called_too_far() {
    let slide = |origin, rpy, axis| ("prismatic", origin, rpy, axis, [-0.2, 0.5]);
    let turn = |origin, rpy, axis| ("revolute", origin, rpy, axis, [-2.0, 2.5]);
    let x = [1.0, 0.0, 0.0];
    let skew = [0.6, 0.0, 0.8];
    let shapes: [&[chains::Row]; 6] = [
        &[slide([0.1, 0.2, 0.3], [0.3, 0.1, 0.2], skew)],
        &[turn([0.1, 0.2, 0.3], [0.3, 0.1, 0.2], skew)],
        &[
            slide([0.0; 3], [0.0; 3], x),
            turn([0.3, 0.1, 0.0], [1.0, 0.0, 0.0], skew),
        ],
        &[
            turn([0.0, 0.1, 0.0], [0.0, 1.0, 0.0], skew),
            turn([0.6, 0.0, 0.8], [0.0, 0.4, 0.0], x),
            slide([0.1, 0.0, 0.2], [0.2; 3], skew),
        ],
        &[
            slide([0.0; 3], [0.0, 0.5, 0.0], skew),
            slide([0.1, 0.1, 0.0], [0.5, 0.0, 0.0], x),
            turn([0.1, 0.1, 0.0], [0.5, 0.0, 0.0], x),
            ("fixed", [0.1, 0.2, 0.3], [0.1, 0.2, 0.3], x, [0.0; 2]),
        ],
        &[
            slide([0.0; 3], [0.0, 0.5, 0.0], skew),
            turn([0.1, 0.1, 0.0], [0.5, 0.0, 0.0], x),
            turn([0.3, 0.0, 0.0], [0.5, 0.0, 0.7], x),
            ("fixed", [0.1, 0.2, 0.3], [0.1, 0.2, 0.3], x, [0.0; 2]),
        ],
    ];
    for rows in shapes {
        let arm = arm(rows);
        let mut postures = Postures::new();
        for _ in 0..200 {
            let posture = postures.next(&arm);
            let goal = arm.forward(&posture);
            let found = arm.nearest(&goal, &posture).expect("it starts there");
            check(&arm, &goal, &found);
        }
    }
}

#[test]
fn a_telescope_of_followers_is_one_joint() {
    let mut text = chains::chain_urdf(chains::STRETCH);
    for follower in ["joint2", "joint3", "joint4"] {
        let from = text
            .find(&format!("joint name=\"{follower}\""))
            .expect("it is there");
        let end = from + text[from..].find("</joint>").expect("it ends");
        text.insert_str(end, "<mimic joint=\"joint1\"/>");
    }
    let (tree, base, tip) = read(&text, "link0", "link9");
    let arm = NumericKinematics::new(&tree, base, tip).expect("the chain can be solved");
    assert_eq!(arm.joints().len(), 5);
    let short = arm.forward(&[0.5, 0.0, 0.0, 0.0, 0.0]);
    let long = arm.forward(&[0.5, 0.1, 0.0, 0.0, 0.0]);
    assert!((distance_between(&short, &long) - 0.4).abs() < 1e-12);
    finds_every_reachable_pose(&arm, 200);
    // What follows a joint elsewhere has no position of its own.
    let [from, to] = ["link2", "link9"].map(|name| tree.link_named(name).expect("it is there"));
    let error = NumericKinematics::new(&tree, from, to).expect_err("its leader is outside");
    assert_eq!(
        error.to_string(),
        "joint \"joint2\" of the arm follows joint \"joint1\", which is not between \"link2\" and \
         \"link9\""
    );
}

#[test]
fn a_joint_that_stands_and_goals_at_limits_are_no_trouble() {
    let mut rows = chains::PANDA.to_vec();
    rows[2].4 = [0.3, 0.3];
    let standing = arm(&rows);
    finds_every_reachable_pose(&standing, 100);
    let panda = arm(chains::PANDA);
    let end = |upper: bool| {
        let limits = panda.limits().iter().flatten();
        limits
            .map(|l| if upper { l.upper } else { l.lower })
            .collect::<ArmPositions>()
    };
    for posture in [end(false), end(true)] {
        let goal = panda.forward(&posture);
        check(
            &panda,
            &goal,
            &panda.nearest(&goal, &posture).expect("it is there"),
        );
    }
}

#[test]
fn what_is_no_number_is_refused_or_left_out() {
    let arm = arm(chains::FETCH);
    let seed = middle(&arm);
    let goal = arm.forward(&seed);
    for x in [f64::NAN, f64::INFINITY] {
        let wrong = Pose::translation(x, 0.0, 0.0);
        assert_eq!(arm.nearest(&wrong, &seed), Err(Miss::NotFinite));
        assert!(!arm.reaches(&wrong) && arm.solutions(&wrong, 0.1).is_empty());
        let seeds = [[x; 7], [0.0, x, 0.0, -x, 0.0, 0.0, x]].map(ArmPositions::from);
        for seed in seeds {
            check(
                &arm,
                &goal,
                &arm.nearest(&goal, &seed).expect("it is reachable"),
            );
        }
    }
    let none = ArmPositions::try_from([].as_slice()).expect("none are not too many");
    check(
        &arm,
        &goal,
        &arm.nearest(&goal, &none).expect("it is reachable"),
    );
    let huge = Pose::translation(1e300, -1e300, 0.0);
    assert!(matches!(
        arm.nearest(&huge, &seed),
        Err(Miss::TooFar { .. })
    ));
    assert!(arm.solutions(&goal, f64::NAN).len() > 5);
}

#[test]
fn chains_that_are_none_are_refused() {
    let refused = |rows: &[chains::Row], base: &str, tip: &str| {
        let (tree, base, tip) = read(&chains::chain_urdf(rows), base, tip);
        let error = NumericKinematics::new(&tree, base, tip).expect_err("it is no arm");
        error.to_string()
    };
    let text = refused(chains::FETCH, "link3", "link3");
    assert!(
        text.contains("has 0 moving joints; it may have 1 to 8"),
        "{text}"
    );
    let text = refused(chains::FETCH, "link7", "link8");
    assert!(text.contains("has 0 moving joints"), "{text}");
    let text = refused(chains::FETCH, "link5", "link2");
    assert!(
        text.contains("\"link2\" does not hang on link \"link5\""),
        "{text}"
    );
    let nine = [("continuous", [0.1; 3], [0.1; 3], [0.0, 0.0, 1.0], [0.0; 2]); 9];
    let text = refused(&nine, "link0", "link9");
    assert!(text.contains("has 9 moving joints"), "{text}");
}

#[test]
fn a_single_joint_and_one_without_a_length_are_solved() {
    let hinge = arm(&[("continuous", [0.0; 3], [0.0; 3], [0.0, 0.0, 1.0], [0.0; 2])]);
    let goal = from_xyz_rpy([0.0; 3], [0.0, 0.0, 2.5]);
    let seed = ArmPositions::from_iter([0.0]);
    let found = hinge.nearest(&goal, &seed).expect("it turns");
    assert!((found[0] - 2.5).abs() < 1e-5);
    let tilted = from_xyz_rpy([0.0; 3], [FRAC_PI_2, 0.0, 0.0]);
    let miss = hinge.nearest(&tilted, &seed).expect_err("it cannot tilt");
    assert!(
        miss.to_string().ends_with("(nearest: 0.0 mm, 90°)"),
        "{miss}"
    );
}

/// `CHAINS="NAME|FILE|BASE|TIP …"` in the environment adds chains of files.
#[test]
#[ignore = "prints a table"]
fn how_fast_chains_are_solved() {
    let mut arms = vec![
        ("PR2 7".to_owned(), pr2_arm().1),
        ("Fetch 7".to_owned(), arm(chains::FETCH)),
        ("Fetch 8".to_owned(), arm(&chains::fetch_with_torso())),
        ("UR5 6".to_owned(), arm(chains::UR5)),
        ("Panda 7".to_owned(), arm(chains::PANDA)),
        ("Stretch 8".to_owned(), arm(chains::STRETCH)),
    ];
    let wanted = std::env::var("CHAINS").unwrap_or_default();
    for row in wanted.split_whitespace() {
        let [name, file, base, tip] = row.split('|').collect::<Vec<_>>()[..] else {
            panic!("{row} is not NAME|FILE|BASE|TIP");
        };
        let text = std::fs::read_to_string(file).expect("the file can be read");
        let (tree, base, tip) = read(&without_shapes(&text), base, tip);
        let arm = NumericKinematics::new(&tree, base, tip).expect("the chain can be solved");
        arms.push((format!("{name} {}", arm.joints().len()), arm));
    }
    println!(
        "chain       found  median    p95    p99 us, reaches  median, soon  misses  median  reaches     soon us, solutions  median number, us"
    );
    for (name, arm) in arms {
        let mut postures = Postures::new();
        let goals: Vec<_> = (0..1000)
            .map(|_| arm.forward(&postures.next(&arm)))
            .collect();
        let seed = middle(&arm);
        let timed = |work: &dyn Fn(&Pose) -> bool, goals: &[Pose]| {
            let mut times = Vec::new();
            let mut found = 0;
            for goal in goals {
                let start = Instant::now();
                found += usize::from(work(goal));
                times.push(start.elapsed().as_nanos() as f64 / 1e3);
            }
            times.sort_by(f64::total_cmp);
            let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
            (found, [at(0.5), at(0.95), at(0.99)])
        };
        let (found, [median, p95, p99]) = timed(&|goal| arm.nearest(goal, &seed).is_ok(), &goals);
        let (reached, [reach, ..]) = timed(&|goal| arm.reaches(goal), &goals);
        let (soon, _) = timed(&|goal| arm.reaches_soon(goal), &goals);
        let turned: Vec<_> = goals
            .iter()
            .map(|g| g * from_xyz_rpy([0.0, 0.0, 0.3], [1.0, 0.5, 2.0]))
            .collect();
        let misses: Vec<_> = turned
            .into_iter()
            .filter(|g| matches!(arm.nearest(g, &seed), Err(Miss::NotFound { .. })))
            .take(100)
            .collect();
        let missed = |work: &dyn Fn(&Pose) -> bool| match misses.is_empty() {
            true => f64::NAN,
            false => timed(work, &misses).1[0],
        };
        let miss = missed(&|goal| arm.nearest(goal, &seed).is_ok());
        let [vain, hasty] = [
            missed(&|goal| arm.reaches(goal)),
            missed(&|goal| arm.reaches_soon(goal)),
        ];
        let many: usize = goals[..50]
            .iter()
            .map(|goal| arm.solutions(goal, 0.2).len())
            .sum();
        let (_, [solutions, ..]) =
            timed(&|goal| !arm.solutions(goal, 0.2).is_empty(), &goals[..50]);
        println!(
            "{name:10} {found:6} {median:7.1} {p95:6.1} {p99:6.1}     {reached:7} {reach:7.1} {soon:5} {:7} {miss:7.1} {vain:8.1} {hasty:8.1}  {:12.1} {solutions:8.1}",
            misses.len(),
            many as f64 / 50.0
        );
    }
}

/// The text of a URDF without its shapes, whose meshes are of no interest here.
fn without_shapes(text: &str) -> String {
    let mut text = text.to_owned();
    for part in ["visual", "collision"] {
        while let Some(from) = text.find(&format!("<{part}")) {
            let end = format!("</{part}>");
            let Some(length) = text[from..].find(&end) else {
                break;
            };
            text.replace_range(from..from + length + end.len(), "");
        }
    }
    text
}
