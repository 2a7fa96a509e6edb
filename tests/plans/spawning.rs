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
