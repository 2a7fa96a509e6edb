//! The demos that people run: setting a table, and cleaning it.

use std::time::Instant;

use super::cook::Cook;
use nalgebra::Vector3;
use session::dialogue::{Evaluate, Outcome};
use session::{Session, SessionOptions};
use spatial::Pose;

const DEMO: &str = include_str!("../../plans/demos/table-setting.plan");
const LOAD: &str = "(ros-load:load-system \"cram_pr2_pick_place_demo\")";
const LOAD_HOUSEHOLD: &str = "(ros-load:load-system \"cram_projection_demos\")";
const VARIED: &str = include_str!("../../world/varied-kitchen.urdf");
/// Drawers and doors that are open.
const OPEN: &str = "(remove-if-not #'pw:open-p (mapcar #'first (pw:list-containers)))";

/// How far (m) from where it was to be put a thing may stand.
const NEAR: f64 = 0.05;

/// How far (m) the things of the demo are from their places.
fn off_their_places(cook: &Cook) -> Vec<f64> {
    let places = [
        ("BREAKFAST-CEREAL-1", [-0.78, 0.9]),
        ("CUP-1", [-0.79, 1.35]),
        ("BOWL-1", [-0.76, 1.19]),
        ("SPOON-1", [-0.78, 1.5]),
        ("MILK-1", [-0.75, 1.7]),
    ];
    let off = |(name, [x, y]): (&str, [f64; 2])| {
        let t = cook.pose(name).translation;
        libm::hypot(t.x - x, t.y - y)
    };
    places.map(off).to_vec()
}

/// Whether the robot stands at the origin of the map, with empty hands.
fn is_home(cook: &mut Cook) -> bool {
    let base = cook.session.simulation().world().robot_configuration().base;
    let off = base.translation.vector.norm() + base.rotation.angle();
    let held = cook.done("(mapcan #'pp-plans::objects-in-hand '(:left :right))");
    off < 0.01 && held == "NIL\n"
}

#[test]
fn the_table_is_set_and_not_again() {
    let mut cook = Cook::watched();
    let said = cook.done(DEMO);
    let off = off_their_places(&cook);
    assert!(off.iter().all(|off| *off < NEAR), "{off:?}\n{said}");
    assert!(!said.contains("Skipping"), "{said}");
    assert_eq!(cook.done(OPEN), "NIL\n");
    assert!(is_home(&mut cook));
    cook.assert_no_overlap();
    let before = cook.session.simulation().now();
    cook.done("(with-simulated-robot (mapc #'bring (mapcar #'first *setting*)))");
    assert_eq!(cook.session.simulation().now(), before, "no motion");
}

#[test]
fn the_steps_of_the_demo_are_made_by_hand() {
    let mut cook = Cook::watched();
    cook.done(LOAD);
    cook.done("(demo::spawn-objects-on-sink-counter) (demo::go-to-sink-or-island :sink)");
    let base = cook.session.simulation().world().robot_configuration().base;
    assert!((base.translation.vector - Vector3::new(0.75, 0.7, 0.0)).norm() < 0.01);
    cook.done("(demo::pick-object :cup :left)");
    assert_eq!(
        cook.done("(pp-plans::objects-in-hand :left)"),
        "(CRAM-PR2-PICK-PLACE-DEMO::CUP-1)\n"
    );
    cook.done("(demo::place-object (demo::pose-of '((-0.79 1.35 0.9) 90)) :left)");
    assert!(off_their_places(&cook)[1] < NEAR);
    // The drawer is opened and closed for what is in it.
    cook.done("(demo::pick-object :spoon :right)");
    assert_eq!(
        cook.done("(pp-plans::objects-in-hand :right)"),
        "(CRAM-PR2-PICK-PLACE-DEMO::SPOON-1)\n"
    );
    assert_eq!(cook.done(OPEN), "NIL\n");
    for (step, report) in [
        (
            "(demo::go-to-sink-or-island :table)",
            "The robot goes to :SINK or to :ISLAND, not to :TABLE.",
        ),
        (
            "(demo::pick-object :fork)",
            ":FORK is none of the things of the demo, which are :breakfast-cereal, :cup, :bowl, :spoon, :milk.",
        ),
        (
            "(demo::place-object (demo::pose-of '((-0.79 1.35 0.9) 90)) :left)",
            "The left hand holds nothing to put down.",
        ),
    ] {
        let (said, _) = cook.say(step).unwrap_err();
        assert_eq!(said, report);
    }
    cook.assert_no_overlap();
}

#[test]
fn a_system_with_plans_is_loaded_once() {
    let mut cook = Cook::new();
    let missing = cook.say("(demo::demo-hard-coded)").unwrap_err().0;
    assert!(
        missing.starts_with("Package DEMO does not exist."),
        "{missing}"
    );
    cook.done(LOAD);
    // A definition of the user's stays.
    cook.done("(defun demo::name-of (type) type)");
    cook.done(LOAD_HOUSEHOLD);
    assert_eq!(cook.done("(demo::name-of :cup)"), ":CUP\n");
    cook.done("(asdf:load-system \"cram_projection_demos\" :force t)");
    assert_eq!(
        cook.done("(demo::name-of :cup)"),
        "CRAM-PR2-PICK-PLACE-DEMO::CUP-1\n"
    );
    let report = cook.say("(demos::household-demo :object-list '(:fork))");
    assert!(
        report
            .unwrap_err()
            .0
            .contains(":FORK is none of the things")
    );
    let report = cook.say("(demos::household-demo :varied-kitchen t)");
    assert!(
        report
            .unwrap_err()
            .0
            .contains("--world world/varied-kitchen.urdf")
    );
}

#[test]
fn a_bowl_is_set_out_from_its_drawer_and_cleaned_away() {
    let mut cook = Cook::watched();
    cook.done(LOAD_HOUSEHOLD);
    cook.done("(demos::initialize) (demos::spawn-objects '(:bowl)) (demos::set-table '(:bowl))");
    let at = cook.pose("BOWL-1").translation;
    assert!(at.x < -0.667 && at.z > 0.86, "{at}");
    assert_eq!(cook.done(OPEN), "NIL\n");
    cook.done("(demos::clean-table '(:bowl))");
    let at = cook.pose("BOWL-1").translation;
    assert!(at.x > 1.2 && (0.43..0.5).contains(&at.z), "{at}");
    assert_eq!(cook.done(OPEN), "NIL\n");
    cook.assert_no_overlap();
}

/// The kitchen of `world/varied-kitchen.urdf` has the furniture of the built-in one, at other places.
#[test]
fn the_varied_kitchen_differs_in_where_furniture_stands_alone() {
    let body = |text: &'static str| text.split_once("<robot").unwrap().1.lines();
    let [varied, usual] = [VARIED, descriptions::KITCHEN_URDF].map(body);
    assert_eq!(varied.clone().count(), usual.clone().count());
    let different = varied.zip(usual).filter(|(a, b)| a != b);
    let origins = different.inspect(|(a, _)| assert!(a.trim().starts_with("<origin"), "{a}"));
    assert_eq!(origins.count(), 5);
}

/// What a demo has achieved, thing by thing, and as a whole.
struct Achieved {
    /// Which of the five things are where they should be.
    things: [bool; 5],
    /// All drawers and doors are closed, nothing is on the floor, and at the end the robot is at its
    /// place.
    is_tidy: [bool; 3],
    /// What was said of failures.
    failures: Vec<String>,
}

const THINGS: [&str; 5] = ["BOWL-1", "SPOON-1", "CUP-1", "MILK-1", "BREAKFAST-CEREAL-1"];

/// The middles of the places for bowls on the island (m), of three for the context
/// TABLE-SETTING-COUNTER: two rows along the edges inside the paddings, 0.1 m from these.
const SLOTS: [[f64; 2]; 3] = [[-0.867, 1.069], [-0.867, 1.669], [-1.267, 1.369]];

fn is_upright(pose: &Pose) -> bool {
    (pose.rotation * Vector3::z()).z > 0.99
}

fn is_on_island(pose: &Pose) -> bool {
    let t = pose.translation;
    (-1.4675..-0.6675).contains(&t.x) && (0.494..2.944).contains(&t.y) && t.z > 0.855
}

/// Whether the random demo has put the things where they belong: the bowl in a slot, the others
/// beside it as a person sees it who sits at the edge towards the aisle.
fn set_as_described(cook: &Cook) -> [bool; 5] {
    let poses = THINGS.map(|name| cook.pose(name));
    let bowl = poses[0].translation.vector;
    let way = |i: usize| poses[i].translation.vector - bowl;
    let in_slot = SLOTS
        .iter()
        .any(|[x, y]| (bowl.x - x).abs() < 0.08 && (bowl.y - y).abs() < 0.08);
    // Half a spoon and half a bowl are 0.103 m wide.
    let gap = way(1).y - 0.103;
    let spoon_axis = poses[1].rotation * Vector3::x();
    let is_aligned = spoon_axis.x.abs() > 10f64.to_radians().cos();
    let relations = [
        in_slot,
        is_aligned && gap > 0.0 && gap < 0.1 && way(1).x.abs() < 0.1,
        way(2).y > 0.0 && way(2).x < 0.0 && way(2).norm() < 0.35,
        way(3).y < 0.0 && way(3).norm() > 0.2,
        true,
    ];
    std::array::from_fn(|i| {
        relations[i] && is_on_island(&poses[i]) && (i == 1 || is_upright(&poses[i]))
    })
}

/// Where things are brought when the table is cleaned.
const CLEANED: [&str; 5] = [
    "sink_area_left_middle_drawer_main",
    "sink_area_left_middle_drawer_main",
    "sink_area_left_middle_drawer_main",
    "iai_fridge_main",
    "oven_area_area_right_drawer_main",
];

/// Which things stand on, or in, those pieces of furniture.
fn carried_by(cook: &mut Cook, furniture: [&str; 5]) -> [bool; 5] {
    std::array::from_fn(|i| {
        let support = cook.done(&format!("(pp-plans::support-of 'demo::{})", THINGS[i]));
        support.contains(furniture[i])
    })
}

fn achieved(cook: &mut Cook, things: [bool; 5], said: &str, is_end: bool) -> Achieved {
    let is_closed = cook.done(OPEN) == "NIL\n";
    let on_floor = THINGS
        .iter()
        .any(|name| cook.pose(name).translation.z < 0.2);
    let failures = said
        .lines()
        .filter(|line| line.contains("Failure happened"));
    Achieved {
        things,
        is_tidy: [is_closed, !on_floor, !is_end || is_home(cook)],
        failures: failures.map(str::to_owned).collect(),
    }
}

fn random_demo(seed: u64) -> Achieved {
    let mut cook = Cook::new();
    cook.done(LOAD);
    let said = cook.done(&format!("(demo::demo-random t demo::*types* :seed {seed})"));
    let things = set_as_described(&cook);
    achieved(&mut cook, things, &said, true)
}

#[test]
fn the_table_is_set_from_random_places() {
    let achieved = random_demo(0);
    assert_eq!(achieved.things, [true; 5], "{:?}", achieved.failures);
    assert_eq!(achieved.is_tidy, [true; 3]);
}

/// A hand that grasps a cup presses on it in this world, gives up, and used to take the cup along then.
#[test]
fn a_cup_on_which_a_hand_has_pressed_is_not_dragged_along() {
    let achieved = random_demo(21);
    assert_eq!(achieved.things, [true; 5], "{:?}", achieved.failures);
    assert_eq!(achieved.is_tidy, [true; 3]);
}

/// Prints a table of what demos achieve, and the sums.
fn table(runs: impl Iterator<Item = (u64, Achieved)>) {
    let mark = |done: bool| if done { "yes" } else { "NO" };
    println!(
        "| seed | bowl | spoon | cup | milk | cereal | closed | nothing on the floor | home |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let (mut right, mut all, mut tidy) = (0, 0, 0);
    for (seed, run) in runs {
        let marks: Vec<&str> = run
            .things
            .iter()
            .chain(&run.is_tidy)
            .map(|d| mark(*d))
            .collect();
        println!("| {seed} | {} |", marks.join(" | "));
        for failure in &run.failures {
            println!("  {failure}");
        }
        right += run.things.iter().filter(|done| **done).count();
        all += run.things.len();
        tidy += usize::from(run.is_tidy == [true; 3]);
    }
    let runs = all / THINGS.len();
    println!("{right} of {all} things where they belong, {tidy} of {runs} runs tidy");
}

/// The range in a variable of the environment, as FROM..TO, or the usual one.
pub(super) fn range(variable: &str, usual: std::ops::Range<u64>) -> std::ops::Range<u64> {
    let Ok(text) = std::env::var(variable) else {
        return usual;
    };
    let (from, to) = text.split_once("..").expect("FROM..TO");
    from.parse().expect("a number")..to.parse().expect("a number")
}

/// The seeds in the environment's `SEEDS`.
fn seeds() -> std::ops::Range<u64> {
    range("SEEDS", 0..100)
}

#[test]
#[ignore = "takes minutes; prints how often the random demo succeeds"]
fn how_often_the_random_demo_succeeds() {
    table(seeds().map(|seed| (seed, random_demo(seed))));
}

#[test]
#[ignore = "takes minutes; prints how often the household demo succeeds"]
fn how_often_the_household_demo_succeeds() {
    table(seeds().flat_map(|seed| household_demo(seed).map(|achieved| (seed, achieved))));
}

/// What the household demo has achieved when the table is set, and when it is cleaned.
fn household_demo(seed: u64) -> [Achieved; 2] {
    let world = std::env::var("VARIED").ok();
    let world = world.map(|_| ("varied-kitchen.urdf".to_owned(), VARIED.to_owned()));
    let mut cook = Cook::with(&SessionOptions {
        seed,
        world,
        ..SessionOptions::default()
    });
    cook.done(LOAD_HOUSEHOLD);
    let said = cook.done("(demos::initialize) (demos::spawn-objects) (demos::set-table)");
    let set = carried_by(&mut cook, ["kitchen_island"; 5]);
    let set = achieved(&mut cook, set, &said, false);
    let said = cook.done("(demos::clean-table) (demo::initialize-or-finalize)");
    let cleaned = carried_by(&mut cook, CLEANED);
    [set, achieved(&mut cook, cleaned, &said, true)]
}

/// `cargo test --release --lib -- --ignored --nocapture how_long_it_takes_to_set_the_table`
#[test]
#[ignore = "prints how long it takes to set the table"]
fn how_long_it_takes_to_set_the_table() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let start = Instant::now();
    let outcome = session.evaluate("demo", DEMO, &mut |_| {});
    assert_ne!(outcome, Outcome::Aborted);
    eprintln!("{:.2} s", start.elapsed().as_secs_f64());
}

const BREAKFAST: &str = include_str!("../../plans/demos/breakfast.plan");

/// Poured, sliced, cleared and wiped: each step is judged by the demo itself, and the world once more here.
#[test]
#[ignore = "takes a minute"]
fn breakfast_is_made_and_cleared_away() {
    let mut cook = Cook::watched();
    let said = cook.done(BREAKFAST);
    assert!(said.contains("7 of 7 steps have worked."), "{said}");
    assert!(!said.contains("failed: "), "{said}");
    let poured = cook.done(
        "(list (< (abs (- 950 (second (content-of 'demo::breakfast-cereal-1)))) 25)
               (< (abs (- 500 (second (content-of 'demo::milk-1)))) 20)
               (< (+ (spilled-from 'demo::milk-1) (spilled-from 'demo::breakfast-cereal-1)) 2))",
    );
    assert_eq!(poured, "(T T T)\n");
    assert_eq!(cook.done(OPEN), "NIL\n");
    assert!(is_home(&mut cook));
    cook.assert_no_overlap();
}
