//! The first whole plan, as a person runs it: what comes of it, that it is the same every
//! time, and that nothing goes through anything on the way.

use super::overlaps::Overlaps;
use nalgebra::Vector3;
use robotics::robot::Side;
use session::dialogue::{Evaluate, Event, Outcome};
use session::{Session, SessionOptions};

const PLAN: &str = include_str!("../../plans/tutorial/move-bottle.plan");

fn session() -> Session {
    Session::new(&SessionOptions::default()).unwrap()
}

/// Evaluates a text; what is printed, and how it ended.
fn run(session: &mut Session, text: &str) -> (String, Outcome) {
    let mut printed = String::new();
    let outcome = session.evaluate("plan", text, &mut |event| match event {
        Event::Output(text) => printed.push_str(&text),
        Event::Picture(_) => {}
        Event::Values(values) => printed.push_str(&format!("{}\n", values.join("\n"))),
        Event::Aborted(abort) => {
            printed.push_str(&format!("{}\n{}\n", abort.report, abort.condition));
        }
        _ => {}
    });
    (printed, outcome)
}

#[test]
fn the_bottle_stands_on_the_island_and_nothing_went_through_anything() {
    let mut session = session();
    let overlaps = Overlaps::watch(&mut session);
    let (printed, outcome) = run(&mut session, PLAN);
    assert_eq!(outcome, Outcome::Finished, "{printed}");
    assert_eq!(overlaps.first(), None);
    assert!(overlaps.steps() > 1000);

    let world = session.simulation().world();
    let pose = world.object_pose("BOTTLE-1").unwrap();
    let t = pose.translation;
    assert!((t.x + 0.8).hypot(t.y - 2.0) < 0.02, "{t}");
    assert!(t.z > 0.86, "{t}");
    let up = pose * Vector3::z();
    assert!(up.z > 3f64.to_radians().cos(), "{up}");
    let arm = world.models().description.arm(Side::Right);
    let parked = arm.posture("park").unwrap();
    let positions = arm.positions(&world.robot_configuration().joints);
    for (is, wanted) in positions.iter().zip(parked) {
        let turns = (is - wanted) / std::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-6, "{positions:?}");
    }
}

#[test]
fn two_runs_print_the_same_bytes_and_leave_the_same_world() {
    let runs: Vec<(String, u64)> = (0..2)
        .map(|_| {
            let mut session = session();
            let (printed, _) = run(&mut session, PLAN);
            (printed, session.simulation().world().hash())
        })
        .collect();
    assert_eq!(runs[0], runs[1]);
}

#[test]
fn a_bottle_that_is_out_of_sight_ends_in_a_failure_after_four_warnings() {
    let mut session = session();
    let definitions = PLAN.split("(move-bottle '(").next().unwrap();
    run(&mut session, definitions);
    let (printed, outcome) = run(&mut session, "(move-bottle '((-2 -0.9 0.860) (0 0 0 1)))");
    assert_eq!(outcome, Outcome::Aborted);
    assert_eq!(
        printed.matches("[(PICK-AND-PLACE PERCEIVE) WARN]").count(),
        4
    );
    assert!(printed.contains("PERCEPTION-OBJECT-NOT-FOUND"), "{printed}");
    let (printed, outcome) = run(&mut session, "(+ 1 2)");
    assert_eq!((printed.as_str(), outcome), ("3\n", Outcome::Finished));
}
