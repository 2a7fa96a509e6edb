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

/// Nothing touches the robot, and everything that opens does so without hitting anything.
fn opens_everything(session: &Session, kitchen: &str) {
    let world = session.simulation().world();
    assert!(touched(world).is_empty(), "{kitchen}: {:?}", touched(world));
    let models = world.models();
    let all = containers(models);
    assert!(all.len() >= 4, "{kitchen}");
    for container in all {
        let joint = models.kitchen.joint(container.joint);
        let limit = joint.limits.unwrap().upper;
        let hit = (1..=10).find_map(|i| {
            let at = limit * f64::from(i) / 10.0;
            world.moved(&world.part(container.joint), at).hit()
        });
        let hit = hit.as_ref().map(shown);
        assert_eq!(hit, None, "{kitchen}: {}", joint.name);
    }
}

#[test]
fn what_opens_does_so_without_hitting_anything() {
    for seed in 0..24 {
        opens_everything(&in_kitchen(seed), &seed.to_string());
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
    let mut cook = Cook::new();
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

/// Sweeps of the same kitchens: as they are, and with a state and things about.
const STATES: &str = "(in-package :pp-tut)
    (defsweep plain ()
      (vary (home (kitchen 0 400)) (from (surface)) (cup (object cup :on from)))
      (run (list home)))
    (defsweep lived-in ()
      (vary (home (kitchen 0 400 :ajar 0.3 :chair 1 :clutter 1)) (from (surface))
            (cup (object cup :on from)))
      (run (list home))
      (expect (clean (no-penetration-p)))
      (measure (things (length (pw::%objects-of-world)))))";

#[test]
fn state_and_clutter_leave_the_kitchen_as_it_is() {
    let mut options = SessionOptions {
        log_level: LogLevel::None,
        ..SessionOptions::default()
    };
    options.seed = 1;
    let mut session = Session::new(&options).unwrap();
    session.run("sweep.plan", STATES).unwrap();
    let mut run =
        |name: &str, number| session.run_sweep_world(name, 42, number, &[], 100_000, None);
    let (mut open, mut things, mut chairs) = (0.0, 0.0, 0);
    for number in 0..12 {
        let plain = run("plain", number);
        let lived_in = run("lived-in", number);
        assert_eq!(plain.outcome, Ending::Success, "{plain:?}");
        assert_eq!(lived_in.outcome, Ending::Success, "{lived_in:?}");
        // The same draws again give the same bits.
        assert_eq!(run("lived-in", number).line(), lived_in.line());
        assert_eq!(run("plain", number).line(), plain.line());
        let is_of_state = |path: &str| {
            ["home.ajar", "home.chair", "home.clutter"]
                .iter()
                .any(|part| path.starts_with(part))
        };
        for (path, drawn) in plain.draws.iter() {
            assert!(!is_of_state(path), "{path}");
            // A cup that would stand in something is put elsewhere.
            if !path.starts_with("cup") {
                assert_eq!(lived_in.draws.get(path), Some(drawn), "{path}");
            }
        }
        let fact = |name: &str| lived_in.draws.get(name).and_then(sweep::Drawn::number);
        let parts = |part: &str| {
            let paths = lived_in
                .draws
                .iter()
                .filter(|(path, _)| path.starts_with(part));
            paths.count() as f64
        };
        assert_eq!(fact("home.ajar"), Some(parts("home.ajar.")));
        assert_eq!(fact("home.clutter"), Some(parts("home.clutter.")));
        let chair = usize::from(lived_in.draws.get("home.chair").is_some());
        let count = lived_in
            .measures
            .get("things")
            .and_then(sweep::Drawn::number);
        // The cup is a thing, too.
        assert_eq!(count, Some(parts("home.clutter.") + chair as f64 + 1.0));
        open += fact("home.ajar").unwrap();
        things += fact("home.clutter").unwrap();
        chairs += chair;
    }
    assert!(
        open >= 12.0 && things >= 12.0 && chairs >= 9,
        "{open} {things} {chairs}"
    );
}

#[test]
fn kitchens_with_settings_open_without_hitting_anything() {
    for (seed, settings) in [
        (1, "arrangement=one-wall"),
        (5, "island=nil,table=nil,wall-cabinets=nil"),
        (8, "arrangement=l-with-island,aisle=1,counter-height=0.8"),
        (
            9,
            "arrangement=u,drawer-travel=0.5,handle-ahead=0.06,counter-depth=0.7",
        ),
    ] {
        let mut options = SessionOptions {
            log_level: LogLevel::None,
            ..SessionOptions::default()
        };
        options
            .set_generated_world(&format!("generated:{seed},{settings}"))
            .unwrap();
        let session = Session::new(&options).unwrap();
        opens_everything(&session, settings);
    }
}

#[test]
fn kitchens_are_drawn_side_by_side() {
    let folder = std::env::temp_dir().join(format!("planwright-kitchens-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut cook = Cook::new();
    let before = cook.session.simulation().world().hash();
    let mut draw = |name: &str, keys: &str| {
        let file = folder.join(name);
        let form = format!("(kitchens-picture {:?} {keys})", file.display().to_string());
        cook.done(&form);
        std::fs::read(file).unwrap()
    };
    let size = ":columns 2 :width 64 :height 48";
    let three = draw("three.png", &format!(":seeds '(1 2 3) {size}"));
    assert_eq!(draw("again.png", &format!(":seeds '(1 2 3) {size}")), three);
    assert_ne!(
        draw("others.png", &format!(":seeds '(1 2 4) {size}")),
        three
    );
    // Width and height: two columns and two rows, with a gap between.
    assert_eq!(three[16..24], [0, 0, 0, 132, 0, 0, 0, 100]);
    std::fs::remove_dir_all(&folder).unwrap();
    // The robot stays in its kitchen.
    assert_eq!(cook.session.simulation().world().hash(), before);
    for wrong in [
        ":seeds nil",
        ":seeds '(-1)",
        ":seeds '(1) :columns 0",
        ":seeds '(1) :width 9999",
    ] {
        let told = cook.done(&format!(
            "(handler-case (kitchens-picture {wrong}) (error (why) (format nil \"~a\" why)))"
        ));
        let is_told = told.contains("expected") || told.contains("is an integer from 0");
        assert!(is_told, "{wrong}: {told}");
    }
}
