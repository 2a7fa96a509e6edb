//! What is in vessels, and where it goes when they are tilted.

use super::fixture::{carry, models};
use crate::world::World;
use crate::world::content::tilt_of;
use spatial::pose::from_xyz_rpy;

/// A cup above a bowl, which stands on the floor, at a distance (m) from its middle, tilted by an angle (rad)
/// away from the robot, with so much (ml) in it.
fn cup_above_bowl(aside: f64, tilt: f64, volume: f64) -> World {
    let models = models();
    let robot = carry(&models, [0.0, 0.0, 0.0], 0.15);
    let mut world = World::new(models, robot);
    let bowl = from_xyz_rpy([-1.0, 0.8, 0.05], [0.0; 3]);
    world.spawn("bowl", "bowl", &bowl, None, None).unwrap();
    world.settle(5.0);
    let cup = from_xyz_rpy([-1.0 + aside, 0.8, 0.25], [0.0, tilt, 0.0]);
    world.spawn("cup", "cup", &cup, None, None).unwrap();
    world.set_content("cup", "water", volume).unwrap();
    world
}

fn volumes(world: &World) -> [f64; 3] {
    let cup = world.object("cup").unwrap().content();
    let bowl = world.object("bowl").unwrap().content();
    [cup.volume, bowl.volume, cup.spilled]
}

#[test]
fn what_leaves_a_lip_above_a_mouth_is_caught() {
    let mut world = cup_above_bowl(-0.06, 1.2, 200.0);
    world.step();
    let [cup, bowl, spilled] = volumes(&world);
    assert!(cup < 60.0, "{cup}");
    assert_eq!(spilled, 0.0);
    assert!((cup + bowl - 200.0).abs() < 1e-9, "{cup} {bowl}");
    assert_eq!(world.object("bowl").unwrap().content().what, "water");
}

#[test]
fn what_leaves_a_lip_beside_a_mouth_is_spilled() {
    let mut world = cup_above_bowl(0.1, 1.2, 200.0);
    world.step();
    let [cup, bowl, spilled] = volumes(&world);
    assert_eq!(bowl, 0.0);
    assert!((cup + spilled - 200.0).abs() < 1e-9, "{cup} {spilled}");
}

#[test]
fn what_no_longer_fits_is_spilled_and_two_contents_mix() {
    let mut world = cup_above_bowl(-0.06, 1.2, 200.0);
    let capacity = world.object("bowl").unwrap().cavity().unwrap().capacity();
    world.set_content("bowl", "milk", capacity - 50.0).unwrap();
    world.step();
    let [cup, bowl, spilled] = volumes(&world);
    // The bowl may lean by a trace on the floor.
    assert!((bowl - capacity).abs() < 1.0, "{bowl} of {capacity}");
    assert!((cup + bowl - (capacity - 50.0) + spilled - 200.0).abs() < 1.0);
    assert!(spilled > 50.0, "{spilled}");
    assert_eq!(world.object("bowl").unwrap().content().what, "mixture");
}

#[test]
fn an_upright_vessel_keeps_its_content_and_a_snapshot_gives_it_back() {
    let mut world = cup_above_bowl(-0.06, 0.0, 200.0);
    assert!(tilt_of(&world.object_pose("cup").unwrap()) < 1e-6);
    let full = world.snapshot();
    let hash = world.hash();
    world.set_content("cup", "milk", 10.0).unwrap();
    assert_ne!(world.hash(), hash);
    world.restore(&full);
    assert_eq!(world.hash(), hash);
    world.step();
    assert_eq!(volumes(&world), [200.0, 0.0, 0.0]);
}
