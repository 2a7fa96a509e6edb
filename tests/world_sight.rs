//! What the PR2 sees of three bottles on the table.

mod world_support;

use planwright::perception::{Camera, Sight};
use planwright::world::World;
use world_support::{at, bottle, carry, models, set_joint};

fn kitchen_with_bottles(pan: f64, tilt: f64) -> World {
    let models = models();
    let mut robot = carry(&models, [-1.447, -0.15, -90.0], 0.3);
    set_joint(&models, &mut robot, "head_pan_joint", pan.to_radians());
    set_joint(&models, &mut robot, "head_tilt_joint", tilt.to_radians());
    let mut world = World::new(models, robot);
    for (name, x, y) in [("A", -1.6, -0.9), ("B", -2.0, -0.9), ("C", -1.0, -0.75)] {
        world.spawn(name, &bottle(), &at(x, y, 0.8208)).unwrap();
    }
    world.settle(5.0);
    world
}

#[test]
fn bottles_are_seen_as_the_tutorial_says() {
    // Pan and tilt (degrees) of the looks down, left and right.
    for (pan, tilt) in [(6.0, 58.9), (46.5, 35.4), (-46.5, 35.4)] {
        let world = kitchen_with_bottles(pan, tilt);
        let frame = world
            .models()
            .robot
            .link_named("narrow_stereo_optical_frame")
            .unwrap();
        let camera = Camera::of_head(world.link_pose(frame));
        let sight = Sight::take(&world, camera);
        for name in ["A", "B", "C"] {
            let pose = world.object_pose(name).unwrap();
            let pixel = camera.pixel_of(&pose.translation.vector.into());
            println!("{pan} {name} {pixel:?} {}", sight.visibility(name).unwrap());
        }
    }
}
