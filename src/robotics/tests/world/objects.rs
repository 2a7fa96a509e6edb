//! Objects in the kitchen: where they come to rest, what moves them.

use parry3d_f64::math::Vector;
use parry3d_f64::query::Ray;
use proptest::prelude::*;

use crate::tests::world::fixture::{at, models, spawn, world};
use crate::world::BodyName;
use crate::world::hash::Hasher;
use crate::world::solid::{Solid, bounds_of};
use spatial::pose::from_xyz_rpy;

/// Spawns, settles, and returns the height (m) at which the object rests.
fn rest_height(type_name: &str, x: f64, y: f64, z: f64) -> f64 {
    let mut world = world();
    spawn(&mut world, "THING", type_name, &at(x, y, z));
    assert!(world.settle(10.0), "the object does not come to rest");
    world.object_pose("THING").unwrap().translation.z
}

#[test]
fn bottles_of_the_tutorial_stand_on_the_table() {
    for (x, y, z) in [(-1.6, -0.9, 0.82), (-2.0, -0.9, 0.86), (-1.0, -0.75, 0.86)] {
        let height = rest_height("bottle", x, y, z);
        assert!((height - 0.8208).abs() < 5e-4, "{height}");
    }
}

#[test]
fn an_object_that_is_spawned_inside_furniture_ends_on_top_of_it() {
    let on_island = rest_height("bottle", -1.0, 0.75, 0.86);
    assert!((on_island - 0.9608).abs() < 2e-3, "{on_island}");
    let on_counter = rest_height("cube", 1.44, 1.28, 0.85);
    assert!((on_counter - 0.887).abs() < 2e-3, "{on_counter}");
}

#[test]
fn a_stack_of_ten_cubes_stands_and_none_is_pressed_into_another_by_a_millimetre() {
    const SIZE: f64 = 0.07;
    let mut world = world();
    for i in 0..10 {
        let z = 0.76 + f64::from(i) * (SIZE + 5e-4);
        spawn(&mut world, &format!("CUBE-{i}"), "cube", &at(-1.4, -0.9, z));
        world.settle(2.0);
    }
    world.settle(10.0);
    let mut below = 0.72;
    for i in 0..10 {
        let t = world.object_pose(&format!("CUBE-{i}")).unwrap().translation;
        let overlap = below - (t.z - SIZE / 2.0);
        assert!((0.0..0.001).contains(&overlap), "{i}: {overlap} m");
        assert!((t.x + 1.4).abs() < 1e-3 && (t.y + 0.9).abs() < 1e-3, "{i}");
        below = t.z + SIZE / 2.0;
    }
}

#[test]
fn what_is_at_rest_costs_nothing_however_much_of_it_there_is() {
    let mut world = world();
    // The kitchen falls asleep; the robot is far away.
    (0..240).for_each(|_| world.step());
    let mut most = 0;
    for i in 0..16 {
        let name = format!("CUP-{i}");
        let (x, y) = (f64::from(i % 4), f64::from(i / 4));
        let place = at(-0.9 - 0.2 * x, -0.72 - 0.15 * y, 0.8);
        spawn(&mut world, &name, "cup", &place);
        assert!(world.come_to_rest(&name, 10.0).unwrap());
        world.step();
        most = most.max(world.awake());
    }
    assert_eq!(most, 0);
}

#[test]
fn a_sausage_comes_to_rest_on_the_counter() {
    let height = rest_height("weisswurst", 1.5, 1.0, 1.0);
    assert!((height - 0.8678).abs() < 2e-3, "{height}");
}

#[test]
fn every_type_of_the_library_comes_to_rest_on_the_table() {
    let mut world = world();
    let types: Vec<_> = world
        .models()
        .objects
        .types()
        .map(|t| t.name.clone())
        .collect();
    for name in types {
        let report = spawn(&mut world, "THING", &name, &at(-1.4, -1.05, 0.85));
        assert!(world.settle(3.0), "{name} does not come to rest");
        let pose = world.object_pose("THING").unwrap();
        let moved = pose.translation.vector - report.pose.translation.vector;
        // A sausage rolls a little, everything else stays where it lands.
        assert!(moved.xy().norm() < 0.1, "{name} moved by {moved:?}");
        assert!(
            (0.71..0.85).contains(&pose.translation.z),
            "{name} is at {pose:?}"
        );
        world.remove("THING").unwrap();
    }
}

#[test]
fn an_object_of_a_known_name_is_moved_but_does_not_change_its_type() {
    let mut world = world();
    spawn(&mut world, "THING", "bottle", &at(-1.4, -1.05, 0.85));
    let place = at(-1.0, -0.9, 0.85);
    let report = spawn(&mut world, "THING", "bottle", &place);
    assert!(!report.is_new);
    let other = world.spawn("THING", "cube", &place, None, None);
    assert_eq!(
        other.unwrap_err().to_string(),
        "THING is a bottle, and does not become a cube: remove it first, or choose another name"
    );
    assert_eq!(world.object("THING").unwrap().type_name(), "bottle");
    assert_eq!(world.objects().len(), 1);
}

#[test]
fn what_is_spawned_into_an_object_ends_on_top_of_it() {
    let mut world = world();
    spawn(&mut world, "BELOW", "cube", &at(-1.4, -1.05, 0.755));
    world.settle(2.0);
    let report = spawn(&mut world, "ABOVE", "cube", &at(-1.4, -1.05, 0.77));
    assert_eq!(
        report.blocked_by,
        Some(BodyName::Object("BELOW".to_owned()))
    );
    assert_eq!(report.support, report.blocked_by);
    assert!(world.settle(2.0));
    let height = world.object_pose("ABOVE").unwrap().translation.z;
    assert!((height - 0.825).abs() < 1e-3, "{height}");
}

#[test]
fn what_is_spawned_into_a_wall_ends_beside_it() {
    let mut world = world();
    let report = spawn(&mut world, "THING", "bottle", &at(-2.5, 2.98, 0.11));
    assert_eq!(report.blocked_by.unwrap().to_string(), "kitchen_wall_3");
    assert!(
        report.shifted > 0.0 && report.shifted < 0.1,
        "{}",
        report.shifted
    );
    assert!((report.lifted + 0.0092).abs() < 1e-3, "{}", report.lifted);
}

#[test]
fn what_rested_on_a_removed_object_falls() {
    let mut world = world();
    spawn(&mut world, "BELOW", "cube", &at(-1.4, -1.05, 0.755));
    spawn(&mut world, "ABOVE", "cube", &at(-1.4, -1.05, 0.825));
    world.settle(2.0);
    for _ in 0..480 {
        world.step();
    }
    world.remove("BELOW").unwrap();
    world.settle(2.0);
    let height = world.object_pose("ABOVE").unwrap().translation.z;
    assert!((height - 0.755).abs() < 1e-3, "{height}");
}

#[test]
fn mistakes_say_what_is_there_instead() {
    let mut world = world();
    spawn(&mut world, "BOTTLE-1", "bottle", &at(-1.4, -1.05, 0.85));
    let unknown = world
        .spawn("X", "botle", &at(0.0, 1.0, 1.0), None, None)
        .unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "there is no object type botle; did you mean bottle?"
    );
    let unknown = world.object_pose("BOTTLE-2").unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "there is no object named BOTTLE-2; did you mean BOTTLE-1?"
    );
    let nowhere = at(f64::NAN, 0.0, 0.0);
    assert!(world.move_object("BOTTLE-1", &nowhere).is_err());
    assert!(
        world
            .spawn("Y", "cup", &at(0.0, 1.0, 1.0), None, Some(0.0))
            .is_err()
    );
    assert_eq!(world.objects().len(), 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Wherever an object appears, nothing throws it.
    #[test]
    fn spawning_anywhere_is_harmless(
        x in -3.9f64..1.9,
        y in -1.9f64..3.1,
        z in -0.1f64..1.5,
        yaw in -3.0f64..3.0,
        tilt in -1.0f64..1.0,
        kind in 0usize..4,
    ) {
        let mut world = world();
        let pose = from_xyz_rpy([x, y, z], [tilt, 0.0, yaw]);
        let name = ["bottle", "cup", "plate", "breakfast-cereal"][kind];
        let report = spawn(&mut world, "THING", name, &pose);
        let mut before = report.pose.translation.z;
        for _ in 0..480 {
            world.step();
            let now = world.object_pose("THING").unwrap().translation.z;
            let speed = (now - before) * 240.0;
            // Things that topple rise a little; things that are thrown rise fast.
            prop_assert!(speed < 1.5, "{name} flies up at {speed} m/s from {report:?}");
            before = now;
        }
        prop_assert!(before > -0.01, "{name} fell through the floor");
    }
}

#[test]
fn vessels_have_no_holes() {
    let models = models();
    for name in [
        "bowl",
        "cup",
        "mug",
        "plate",
        "blue-metal-plate",
        "red-metal-plate",
        "pot",
    ] {
        let solids = Solid::all(&models.objects.get(name).unwrap().shapes);
        let brim = bounds_of(&solids).unwrap().maxs.z - 1e-4;
        // From the middle of the opening, in all directions below the brim.
        let directions = 20_000;
        let gone = (0..directions).filter(|i| {
            let down = -(f64::from(*i) + 0.5) / f64::from(directions);
            let (sin, cos) = (f64::from(*i) * 2.399_963).sin_cos();
            let out = (1.0 - down * down).sqrt();
            let ray = Ray::new(
                Vector::new(0.0, 0.0, brim),
                Vector::new(out * cos, out * sin, down),
            );
            !solids
                .iter()
                .any(|s| s.shape.intersects_ray(&s.pose, &ray, 1.0))
        });
        assert_eq!(gone.count(), 0, "{name}");
    }
}

#[test]
fn a_spawned_object_does_not_wait_for_one_that_never_comes_to_rest() {
    let mut world = world();
    spawn(&mut world, "CUBE-1", "cube", &at(-1.4, -0.9, 0.8));
    assert!(world.come_to_rest("CUBE-1", 20.0).unwrap());
    // It falls, and would for a long time.
    let body = spawn(&mut world, "BALL", "bottle", &at(0.9, 0.0, 9.0));
    assert!(body.support.is_none(), "{body:?}");
    world.step();
    let before = world.steps();
    spawn(&mut world, "CUBE-2", "cube", &at(-1.2, -0.9, 0.8));
    assert!(world.come_to_rest("CUBE-2", 20.0).unwrap());
    assert!(
        world.steps() - before < 240,
        "{} steps",
        world.steps() - before
    );
}

/// The axes of inertia come from a decomposition with an arc cosine and cosines, which C libraries
/// round in different ways.
#[test]
fn the_mass_properties_of_all_types_have_the_same_bits_on_every_system() {
    let types: Vec<String> = models().objects.types().map(|t| t.name.clone()).collect();
    let mut hasher = Hasher::default();
    for name in &types {
        let mut world = world();
        spawn(&mut world, "THING", name, &at(-1.5, -0.9, 1.2));
        hasher.text(name);
        for bits in world.mass_properties_bits("THING") {
            hasher.integer(bits);
        }
    }
    assert_eq!(
        hasher.finish(),
        0x1b2e_1699_a78b_abac,
        "{} types",
        types.len()
    );
}
