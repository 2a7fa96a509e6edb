//! Things that stand close to what is grasped: they are left where they are, or the action fails.

use super::cook::Cook;

/// Objects on the table: name, type, x, y and yaw (m, rad).
type Scene = [(&'static str, &'static str, f64, f64, f64)];

/// Spawns the scene, looks for a bottle and picks it up with the arm as the tutorial does. Nothing
/// but that bottle may have moved unless the action failed.
fn pick_up(scene: &Scene, arm: &str) -> (Cook, bool) {
    let mut cook = Cook::watched();
    for (name, kind, x, y, yaw) in scene {
        let (s, c) = (yaw / 2.0).sin_cos();
        cook.done(&format!(
            "(spawn-object '(({x} {y} 0.83) (0 0 {s} {c})) :{kind} '{name})"
        ));
    }
    let before: Vec<_> = scene.iter().map(|(name, ..)| cook.pose(name)).collect();
    let said = cook.say(&format!(
        "(with-simulated-robot
           (get-ready-at *place-at-table*)
           (let ((bottle (find-object :bottle)))
             (pick-up-object bottle {arm})
             (format t \"~&picked ~a~%\" (get-object-name bottle))))"
    ));
    let picked = match &said {
        Ok(printed) => printed
            .lines()
            .find_map(|line| line.strip_prefix("picked ")),
        Err(_) => None,
    };
    if let Some(picked) = picked {
        for ((name, ..), before) in scene.iter().zip(&before) {
            if *name != picked {
                let moved = cook.distance(name, before);
                assert!(
                    moved < 0.005,
                    "{name} was moved by {moved} m without a word"
                );
            }
        }
    }
    cook.assert_no_overlap();
    (cook, said.is_ok())
}

#[test]
fn nothing_is_thrown_over_where_the_hand_has_little_room() {
    let scene: &Scene = &[
        ("D-0", "bottle", -1.5186, -0.7100, -1.8756),
        ("D-1", "cup", -1.7784, -0.7100, 2.2574),
        ("D-2", "milk", -2.0213, -0.8479, -1.1954),
        ("BOTTLE-1", "bottle", -1.6800, -0.7600, -2.5655),
    ];
    for arm in [":right", ":left"] {
        pick_up(scene, arm);
    }
}

#[test]
fn a_bottle_between_others_is_taken_or_refused_with_what_is_in_the_way() {
    let scene: &Scene = &[
        ("BOTTLE-1", "bottle", -1.6, -0.9, 0.0),
        ("N-1", "bottle", -1.6, -0.985, 0.0),
        ("N-2", "bottle", -1.68, -0.94, 0.0),
        ("N-3", "cup", -1.52, -0.86, 0.0),
    ];
    pick_up(scene, ":right");
}

#[test]
fn a_neighbour_that_the_hand_must_not_touch_is_named() {
    let mut cook = Cook::at_table_with_bottle();
    // Where the hand has to be for the grasp from the left.
    cook.done("(spawn-object '((-1.6 -0.80 0.82) (0 0 0 1)) :bottle 'in-the-way)");
    let before = cook.pose("IN-THE-WAY");
    let said = cook.say(
        "(with-simulated-robot
           (let ((?b *bottle*))
             (perform (an action (type picking-up) (arm right) (grasp left-side) (object ?b)))))",
    );
    let (report, condition) = said.unwrap_err();
    assert!(report.contains("IN-THE-WAY"), "{condition}: {report}");
    assert!(cook.distance("IN-THE-WAY", &before) < 0.005);
}
