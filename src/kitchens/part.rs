//! What kind of thing a link of a generated kitchen is, whichever row it belongs to.

use crate::settings::ROWS;

/// The kind of furniture that a link, or its name in the language, is: `drawer handle` for
/// `back_3_drawer_2_handle`. Other bodies keep their names.
pub fn kind_of_part(name: &str) -> String {
    let lower = name.to_lowercase().replace('-', "_");
    let mut parts: Vec<&str> = lower.split('_').collect();
    let is_number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    let second = parts.get(1).copied().unwrap_or_default();
    let is_row = ROWS.contains(&parts[0]) && (is_number(second) || second == "counter");
    let is_numbered = [
        "stool", "wall", "fridge", "sink", "hob", "hood", "table", "room",
    ]
    .contains(&parts[0]);
    if !is_row && !is_numbered {
        return name.to_owned();
    }
    parts.retain(|part| !is_number(part) && *part != "main");
    // An island is a place of its own; the rows along walls, and the walls, are much the same.
    parts.retain(|part| *part == "island" || (!ROWS.contains(part) && *part != "front"));
    match parts.as_slice() {
        [] => "cabinet".to_owned(),
        ["island"] => "island cabinet".to_owned(),
        parts => parts.join(" "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_told_by_what_they_are() {
        for (name, kind) in [
            ("back_3_drawer_2_handle", "drawer handle"),
            ("left_1_drawer_1_main", "drawer"),
            ("BACK-6-HANGING", "hanging"),
            ("right_2", "cabinet"),
            ("back_counter_2", "counter"),
            ("island_counter", "island counter"),
            ("island_2_drawer_1_main", "island drawer"),
            ("fridge_main", "fridge"),
            ("fridge_door_handle", "fridge door handle"),
            ("stool_2", "stool"),
            ("wall_left", "wall"),
            ("TABLE", "table"),
            // The robot's, and things.
            ("l_forearm_link", "l_forearm_link"),
            ("left_finger_2", "left_finger_2"),
            ("CUP-2", "CUP-2"),
            ("", ""),
        ] {
            assert_eq!(kind_of_part(name), kind, "{name}");
        }
    }
}
