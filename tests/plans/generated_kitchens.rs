//! Kitchens that are drawn from a seed.

use super::cook::Cook;
use robotics::location::containers;
use robotics::world::{AllowedPairs, CollisionHit, World};
use session::{LogLevel, Session, SessionOptions};
use sweep::Ending;

/// A session in the generated kitchen of a seed.
fn in_kitchen(seed: u64) -> Session {
    let mut options = SessionOptions {
        log_level: LogLevel::None,
        ..SessionOptions::default()
    };
    options
        .set_generated_world(&format!("generated:{seed}"))
        .unwrap();
    Session::new(&options).unwrap()
}

/// The two that touch.
fn shown(hit: &CollisionHit) -> String {
    format!("{} and {}", hit.moving, hit.other)
}

/// What the robot touches where it starts.
fn touched(world: &World) -> Vec<String> {
    let robot = world.robot_configuration();
    let hits = world
        .collision_checker()
        .all_hits(robot, &AllowedPairs::none(), 0.0);
    hits.iter().map(shown).collect()
}

#[test]
fn what_opens_does_so_without_hitting_anything() {
    for seed in 0..24 {
        let session = in_kitchen(seed);
        let world = session.simulation().world();
        assert!(touched(world).is_empty(), "{seed}: {:?}", touched(world));
        let models = world.models();
        let all = containers(models);
        assert!(all.len() >= 4, "{seed}");
        for container in all {
            let joint = models.kitchen.joint(container.joint);
            let limit = joint.limits.unwrap().upper;
            let hit = (1..=10).find_map(|i| {
                let at = limit * f64::from(i) / 10.0;
                world.moved(&world.part(container.joint), at).hit()
            });
            let hit = hit.as_ref().map(shown);
            assert_eq!(hit, None, "{seed}: {}", joint.name);
        }
    }
}

#[test]
fn a_generated_kitchen_has_names_for_plans() {
    let mut cook = Cook::with(&{
        let mut options = SessionOptions::default();
        options.set_generated_world("generated:3").unwrap();
        options
    });
    assert_eq!(
        cook.done("(not (null (fd-plans::kitchen-place :table)))")
            .trim(),
        "T"
    );
    assert_eq!(
        cook.done("(not (null (fd-plans::usual-location :milk :table-setting)))")
            .trim(),
        "T"
    );
    let error = SessionOptions::default()
        .set_generated_world("generated:seven")
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "generated:seven names no generated kitchen: generated:SEED was expected, with a whole number \
         from 0 to 18446744073709551615"
    );
}

#[test]
fn another_kitchen_can_be_undone() {
    let mut cook = Cook::unwatched();
    cook.done("(init-projection)");
    cook.done("(spawn-object '((-1.5 -0.9 0.85) (0 0 0 1)) :bottle 'bottle-1)");
    let before = cook.session.simulation().world().hash();
    let names = cook.done("(list-surfaces)");
    let facts = cook.done("(new-kitchen 5)");
    assert!(facts.contains(":ARRANGEMENT"), "{facts}");
    assert_ne!(cook.done("(list-surfaces)"), names);
    assert_eq!(
        cook.done("(btr-utils:object-exists 'bottle-1)").trim(),
        "NIL"
    );
    assert_eq!(cook.done("(getf rob-int:*kitchen* :stores)").trim(), "NIL");
    cook.done("(rewind)");
    assert_eq!(cook.done("(list-surfaces)"), names);
    assert_eq!(cook.session.simulation().world().hash(), before);
    assert_ne!(cook.done("(getf rob-int:*kitchen* :stores)").trim(), "NIL");
    // And back by name.
    cook.done("(new-kitchen 5)");
    assert_eq!(cook.done("(new-kitchen)").trim(), "NIL");
    assert_eq!(cook.done("(list-surfaces)"), names);
}

#[test]
fn a_sweep_draws_kitchens() {
    let text = "(in-package :pp-tut)
        (defsweep s ()
          (vary (home (kitchen)) (from (surface)) (cup (object cup :on from)))
          (run (list home)) (expect (there (on-surface-p cup from))))";
    let mut options = SessionOptions {
        log_level: LogLevel::None,
        ..SessionOptions::default()
    };
    options.seed = 1;
    let run = |numbers: &[u64]| -> Vec<(u64, String)> {
        let mut session = Session::new(&options).unwrap();
        session.run("sweep.plan", text).unwrap();
        let records = numbers.iter().map(|number| {
            let record = session.run_sweep_world("s", 42, *number, &[], 100_000, None);
            assert_eq!(record.outcome, Ending::Success, "{record:?}");
            (*number, format!("{:?} {:?}", record.draws, record.hash))
        });
        let mut records: Vec<_> = records.collect();
        records.sort();
        records
    };
    // Nothing depends on which worlds ran before in the same session.
    let all = run(&[0, 1, 2, 3]);
    assert_eq!(all, run(&[3, 1, 0, 2]));
    assert!(all[0].1.contains("home.arrangement"), "{}", all[0].1);
    assert_ne!(all[0].1, all[1].1);
}
