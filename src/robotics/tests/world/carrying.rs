//! What carries what, in scenes with things on and in things.

use super::fixture::{at, spawn, world};
use crate::world::BodyName;

/// The names of what carries an object, from above to below.
fn carriers(world: &crate::world::World, name: &str) -> Vec<String> {
    let chain = world.carriers(name).unwrap();
    chain.iter().map(BodyName::to_string).collect()
}

#[test]
fn what_stands_on_and_in_things_is_carried_by_them_and_by_what_carries_them() {
    for (base, height, rider, rider_height) in [
        ("plate", 0.867, "cup", 0.911),
        ("plate", 0.867, "apple", 0.915),
        ("cube", 0.896, "cube", 0.967),
        ("tray", 0.862, "milk", 0.98),
        ("bread", 0.89, "bowl", 0.96),
        ("bowl", 0.894, "weisswurst", 0.885),
    ] {
        let mut world = world();
        spawn(&mut world, "BASE", base, &at(-0.85, 1.5, height));
        spawn(&mut world, "RIDER", rider, &at(-0.85, 1.5, rider_height));
        world.come_to_rest("RIDER", 5.0).unwrap();
        assert_eq!(
            carriers(&world, "BASE"),
            ["kitchen_island_surface"],
            "{base}"
        );
        assert_eq!(
            carriers(&world, "RIDER"),
            ["BASE", "kitchen_island_surface"],
            "{rider} on {base}"
        );
    }
}
