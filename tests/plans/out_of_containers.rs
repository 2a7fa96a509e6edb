//! How often things are brought out of closed drawers and the fridge to the island, and back.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use super::container_measurements::somewhere;
use super::cook::Cook;
use super::deliveries::REACHABLE_P;
use session::SessionOptions;
use spatial::{pose, trig};

/// Where something is that is to be brought to the island.
struct Store {
    kind: &'static str,
    furniture: &'static str,
    /// On which of the boards, if there are several.
    level: Option<u32>,
    joint: &'static str,
    /// The joint's position (m, rad) when it is open.
    open: f64,
    /// In how many worlds, and in how many of a hundred it has to arrive at least.
    worlds: u64,
    wanted: u64,
}

impl Store {
    /// Whether it is in the list: its kind, or its furniture, or all are asked for.
    fn is_asked_for(&self, list: &str) -> bool {
        list.is_empty()
            || list
                .split(',')
                .any(|name| name == self.kind || name == self.furniture)
    }
}

const STORES: [Store; 6] = [
    Store {
        kind: "spoon",
        furniture: "sink-area-left-upper-drawer-main",
        level: None,
        joint: "sink_area_left_upper_drawer_main_joint",
        open: 0.48,
        worlds: 100,
        wanted: 95,
    },
    Store {
        kind: "milk",
        furniture: "iai-fridge-main",
        level: None,
        joint: "iai_fridge_door_joint",
        open: 1.57,
        worlds: 40,
        wanted: 90,
    },
    Store {
        kind: "cup",
        furniture: "kitchen-island-left-upper-drawer-main",
        level: None,
        joint: "kitchen_island_left_upper_drawer_main_joint",
        open: 0.48,
        worlds: 40,
        wanted: 90,
    },
    Store {
        kind: "bowl",
        furniture: "sink-area-left-middle-drawer-main",
        level: None,
        joint: "sink_area_left_middle_drawer_main_joint",
        open: 0.48,
        worlds: 40,
        wanted: 90,
    },
    milk_on_board(3),
    // Nothing is above this one.
    milk_on_board(4),
];

/// Milk on a board of the tall drawer, counted from below.
const fn milk_on_board(level: u32) -> Store {
    Store {
        kind: "milk",
        furniture: "oven-area-area-right-drawer-main",
        level: Some(level),
        joint: "oven_area_area_right_drawer_joint",
        open: 0.48,
        worlds: 40,
        wanted: 90,
    }
}

const PLAN: &str = "
    (in-package :pp-tut)
    (defvar *thing*)
    (defvar *level* nil)
    (defun in-furniture (?name)
      (let ((?level *level*))
        (a location (in (an object (urdf-name ?name) (part-of kitchen)))
           (desig:when ?level (level ?level)))))
    (defun put-somewhere-in (?type ?name)
      (let* ((?for (an object (type ?type)))
             (?level *level*)
             (?in (an object (urdf-name ?name) (part-of kitchen))))
        (spawn-object (desig:reference (a location (in ?in) (for ?for)
                                          (desig:when ?level (level ?level))))
                      ?type 'thing)))
    (defun on-island (?thing)
      (let ((?island (an object (urdf-name kitchen-island-surface) (part-of kitchen))))
        (a location (on ?island) (for ?thing))))
    (defun bring (?type name)
      (let* ((?thing (an object (type ?type)))
             (?from (in-furniture name))
             (?to (on-island ?thing)))
        (setf *thing* ?thing)
        (with-simulated-robot
          (perform (an action (type transporting) (object ?thing) (location ?from)
                       (target ?to))))))
    (defun bring-back (?name)
      (let* ((?thing *thing*)
             (?level *level*)
             (?to (a location (in (an object (urdf-name ?name) (part-of kitchen)))
                     (for ?thing) (desig:when ?level (level ?level)))))
        (with-simulated-robot
          (perform (an action (type transporting) (object ?thing) (target ?to))))))
    (defun in-reach-p (type joint open)
      \"Could the thing be picked up from anywhere if the container were open?\"
      (move-kitchen-joint :joint-name joint :joint-angle open)
      (let ((usual (list-defined-grasps type)))
        (reachable-p type (append usual
                                  (set-difference (pp-plans::grasps-from-above type) usual)))))";

fn seeded(seed: u64) -> SessionOptions {
    SessionOptions {
        seed,
        ..SessionOptions::default()
    }
}

/// Why a thing did not get to where it was to be, or what has not been tidied up.
fn flaw(cook: &mut Cook, store: &Store, form: &str, is_there: &str) -> Option<String> {
    if let Err((report, _)) = cook.say(form) {
        return Some(report.replace('\n', " "));
    }
    let support = cook.done("(pp-plans::support-of 'thing)");
    if !support.contains(is_there) {
        return Some(format!("on {support}"));
    }
    let world = cook.session.simulation().world();
    let open = world.kitchen_joint(store.joint).unwrap();
    if open.abs() > 0.02 {
        return Some(format!("left open by {open:.2}"));
    }
    cook.overlap()
}

/// Whether the thing cannot be picked up from anywhere on a grid, with the container open.
fn is_out_of_reach(cook: &mut Cook, store: &Store) -> bool {
    let Store {
        kind, joint, open, ..
    } = store;
    let form = format!("(in-reach-p :{kind} \"{joint}\" {open})");
    cook.done(&form) == "NIL\n"
}

/// `cargo test --release --lib -- --ignored --nocapture how_often_things_are_brought_out_of_containers`;
/// `KINDS`, separated by commas, for some of the things or pieces of furniture, and `WORLDS=FROM..TO` for some of the worlds.
#[test]
#[ignore = "takes minutes; prints how often things are brought out of containers"]
fn how_often_things_are_brought_out_of_containers() {
    let kinds = std::env::var("KINDS").unwrap_or_default();
    println!(
        "| thing | out of | brought to the island | and back | out of reach |\n|---|---|---|---|---|"
    );
    for store in &STORES {
        if !store.is_asked_for(&kinds) {
            continue;
        }
        let worlds = super::demos::range("WORLDS", 0..store.worlds);
        let (mut all, mut brought, mut back, mut out_of_reach) = (0, 0, 0, 0);
        for seed in worlds {
            let mut cook = Cook::watched_with(&seeded(seed));
            cook.done(REACHABLE_P);
            cook.done(PLAN);
            if let Some(level) = store.level {
                cook.done(&format!("(setf *level* {level})"));
            }
            let mut rng = Pcg64::seed_from_u64(seed);
            let place @ [x, y, yaw] = somewhere(&cook, &mut rng);
            let (s, c) = trig::sin_cos(yaw / 2.0);
            cook.done(&format!(
                "(btr-utils:move-robot '(({x} {y} 0) (0 0 {s} {c})))
                 (put-somewhere-in :{} :{})",
                store.kind, store.furniture
            ));
            let stood = cook.pose("THING");
            let form = format!("(bring :{} :{})", store.kind, store.furniture);
            if let Some(why) = flaw(&mut cook, store, &form, "kitchen_island") {
                let (t, yaw) = (stood.translation, pose::yaw(&stood));
                let at = format!(
                    "{} {seed} at {:.3} {:.3}, yaw {yaw:.2}, the robot at {place:?}",
                    store.kind, t.x, t.y
                );
                if why.contains("could not be fetched") && is_out_of_reach(&mut cook, store) {
                    out_of_reach += 1;
                    println!("  {at}: out of reach");
                } else {
                    all += 1;
                    println!("  {at}: {why}");
                }
                continue;
            }
            (all, brought) = (all + 1, brought + 1);
            let form = format!("(bring-back :{})", store.furniture);
            let part = store.furniture.replace('-', "_");
            match flaw(&mut cook, store, &form, &part) {
                None => back += 1,
                Some(why) => println!("  {} {seed}, back: {why}", store.kind),
            }
        }
        println!(
            "| {} | {} | {brought} of {all} | {back} of {brought} | {out_of_reach} |",
            store.kind, store.furniture
        );
        assert!(brought * 100 >= all * store.wanted, "{}", store.kind);
    }
}

/// Beside it, there is no room for a hand: its sides face the corners of the fridge.
#[test]
fn milk_that_stands_askew_at_the_back_of_the_fridge_is_taken_over_its_edge() {
    let fridge = &STORES[1];
    let mut cook = Cook::watched();
    cook.done(PLAN);
    cook.done(
        "(spawn-object (list '(1.62 -0.98 0.68) (list 0 0 (sin 0.5) (cos 0.5))) :milk 'thing)",
    );
    let form = format!("(bring :milk :{})", fridge.furniture);
    assert_eq!(flaw(&mut cook, fridge, &form, "kitchen_island"), None);
}

/// Most headings at which it might stand there ask for a hand that comes from the back of the fridge.
#[test]
fn milk_is_grasped_for_a_place_in_the_fridge_where_it_can_be_put_down() {
    let fridge = &STORES[1];
    for seed in [1, 2, 3, 5] {
        let mut cook = Cook::with(&seeded(seed));
        cook.done(PLAN);
        cook.done(
            "(let ((?for (an object (type milk))))
               (spawn-object (desig:reference (on-island ?for)) :milk 'thing)
               (setf *thing* ?for))",
        );
        let printed = cook.done(&format!("(bring-back :{})", fridge.furniture));
        assert!(printed.contains("for the next place"), "{seed}: {printed}");
        assert!(
            !printed.contains("new placing location"),
            "{seed}: {printed}"
        );
        let support = cook.done("(pp-plans::support-of 'thing)");
        assert!(support.contains("iai_fridge"), "{seed}: {support}");
    }
}
