//! Spawned objects: they are at rest, where they were put, or else that is said.

use super::cook::Cook;

/// The warnings of a text.
fn warnings(cook: &mut Cook, text: &str) -> Vec<String> {
    let said = cook.done(text);
    let lines = said
        .lines()
        .filter(|line| line.contains("SPAWN-OBJECT) WARN"));
    lines.map(str::to_owned).collect()
}

#[test]
fn what_rolls_off_the_table_does_so_before_spawning_returns() {
    let mut cook = Cook::new();
    cook.done(
        "(spawn-object '((-1.5420 -1.3900 0.83) (0 0 0.4457 0.8952)) :bottle 'd-0)
         (spawn-object '((-1.7084 -1.1539 0.83) (0 0 -0.1377 0.9905)) :cup 'd-1)
         (spawn-object '((-1.6883 -1.3900 0.83) (0 0 -0.8569 0.5156)) :milk 'd-2)",
    );
    let said = warnings(
        &mut cook,
        "(spawn-object '((-1.6066 -1.3703 0.83) (0 0 0.0276 0.9996)))",
    );
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].contains("BOTTLE-1 does not fit at (-1.61 -1.37 0.83)"),
        "{said:?}"
    );
    let lies = cook.pose("BOTTLE-1");
    cook.done("(cpl:sleep 10)");
    let moved = cook.distance("BOTTLE-1", &lies);
    assert!(
        moved < 0.01,
        "it was said to be at rest, and moved by {moved} m"
    );
}

#[test]
fn what_touches_something_that_goes_on_moving_does_not_sink() {
    let mut cook = Cook::new();
    // The mug leans on the first carton, and wobbles for long.
    cook.done(
        "(spawn-object '((-1.4184063556884792 -0.78907156478675011 0.8) (0 0 -0.97880851396570379 0.20477766721068649)) :milk 'thing-0)
         (spawn-object '((-1.4962315822406385 -0.9139640570155716 0.8) (0 0 -0.84624064325183335 0.53280087622743577)) :milk 'thing-1)
         (spawn-object '((-1.3916099602933851 -1.0226446185685849 0.8) (0 0 -0.53534668434796884 0.84463242156433715)) :bowl 'thing-2)
         (spawn-object '((-1.8000924765918591 -0.80775856721331063 0.8) (0 0 -0.46974675963091161 0.88280121308041859)) :bowl 'thing-3)
         (spawn-object '((-1.6814944228757931 -1.0153990400291044 0.8) (0 0 0.94399075461746074 0.32997190061694187)) :milk 'thing-4)
         (spawn-object '((-1.3350121457374651 -0.89686934503523585 0.8) (0 0 -0.73885679249897929 0.67386247868398219)) :mug 'thing-5)
         (spawn-object '((-1.1935176385807291 -0.78235169857436637 0.8) (0 0 -0.90917576930401667 0.41641256046191677)) :bottle 'thing-6)",
    );
    let stood = cook.pose("THING-0");
    cook.done("(cpl:sleep 5)");
    let moved = cook.distance("THING-0", &stood);
    assert!(moved < 0.005, "it was moved by {moved} m");
}

#[test]
fn rough_figures_of_the_tutorial_are_met_without_a_word() {
    let mut cook = Cook::new();
    for (kind, place) in [
        ("bottle", "-1.6 -0.9 0.82"),
        ("bottle", "-2 -0.9 0.86"),
        ("bottle", "-1.0 0.75 0.86"),
        ("cube", "1.44 1.28 0.85"),
        ("weisswurst", "0 1 0.1"),
    ] {
        let text = format!("(spawn-object '(({place}) (0 0 0 1)) :{kind} 'thing)");
        assert_eq!(warnings(&mut cook, &text), [] as [String; 0], "{text}");
        cook.done("(btr-utils:kill-object 'thing)");
    }
}

#[test]
fn what_is_spawned_into_furniture_and_ends_elsewhere_is_told() {
    let mut cook = Cook::new();
    let said = warnings(&mut cook, "(spawn-object '((-2.17 -1.42 0.4) (0 0 0 1)))");
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].contains("BOTTLE-1 does not fit at (-2.17 -1.42 0.40), where table_area_main is.")
            && said[0].ends_with("It is at (-2.17 -1.42 0.82), on table_area_main."),
        "{said:?}"
    );
    // Behind the drawers of the island is a gap.
    let said = warnings(
        &mut cook,
        "(spawn-object '((-1.44 1.15 0.5) (0 0 0 1)) :cup 'cup-1)",
    );
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].contains("CUP-1 did not stay at (-1.44 1.15 0.50).")
            && said[0].ends_with(" 0.04), on floor."),
        "{said:?}"
    );
}

#[test]
fn what_stands_on_an_edge_has_fallen_over_when_it_counts_as_at_rest() {
    let mut cook = Cook::new();
    // A cube on one of its edges, turned by 45 degrees about x; and one on a corner.
    for (name, q) in [
        ("EDGE", "0.38268 0 0 0.92388"),
        ("CORNER", "0.325 0.325 0 0.888"),
    ] {
        cook.done(&format!(
            "(spawn-object '((-1.4 -0.9 0.80) ({q})) :cube '{name})"
        ));
        let lies = cook.pose(name);
        cook.done("(cpl:sleep 5)");
        assert!(cook.distance(name, &lies) < 0.005, "{name}");
        cook.done(&format!("(btr-utils:kill-object '{name})"));
    }
}

#[test]
fn what_stands_on_a_spawned_object_falls_when_that_goes_away() {
    let stack = "(spawn-object '((-1.4 -1.05 0.755) (0 0 0 1)) :cube 'below)
         (spawn-object '((-1.4 -1.05 0.825) (0 0 0 1)) :cube 'above)";
    for goes in [
        "(btr-utils:kill-object 'below)",
        "(btr-utils:move-object 'below (make-pose \"map\" '((-1.7 -0.9 0.8) (0 0 0 1))))",
    ] {
        let mut cook = Cook::new();
        cook.done(stack);
        let stood = cook.pose("ABOVE").translation.z;
        cook.done(goes);
        cook.done("(cpl:sleep 1)");
        let fell = stood - cook.pose("ABOVE").translation.z;
        assert!((fell - 0.07).abs() < 0.005, "{goes}: it fell by {fell} m");
    }
}
