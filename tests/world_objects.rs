//! Objects in the kitchen: where they come to rest, what moves them.

mod world_support;

use world_support::{at, bottle, cube, sausage, world};

/// Spawns, settles, and returns the height (m) at which the object rests.
fn rest_height(description: &planwright::world::ObjectDescription, x: f64, y: f64, z: f64) -> f64 {
    let mut world = world();
    world.spawn("THING", description, &at(x, y, z)).unwrap();
    assert!(world.settle(10.0), "the object does not come to rest");
    let pose = world.object_pose("THING").unwrap();
    println!("{pose}");
    pose.translation.z
}

#[test]
fn bottles_of_the_tutorial_stand_on_the_table() {
    for (x, y, z) in [(-1.6, -0.9, 0.82), (-2.0, -0.9, 0.86), (-1.0, -0.75, 0.86)] {
        let height = rest_height(&bottle(), x, y, z);
        assert!((height - 0.8208).abs() < 5e-4, "{height}");
    }
}

#[test]
fn an_object_that_is_spawned_inside_furniture_ends_on_top_of_it() {
    let on_island = rest_height(&bottle(), -1.0, 0.75, 0.86);
    assert!((on_island - 0.9608).abs() < 2e-3, "{on_island}");
    let on_counter = rest_height(&cube(), 1.44, 1.28, 0.85);
    assert!((on_counter - 0.887).abs() < 2e-3, "{on_counter}");
}

#[test]
fn a_sausage_comes_to_rest_on_the_counter() {
    let height = rest_height(&sausage(), 1.5, 1.0, 1.0);
    assert!((height - 0.8678).abs() < 2e-3, "{height}");
}
