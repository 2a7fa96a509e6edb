//! Pictures of 640 × 480 pixels, of the kitchen with the robot and a bottle.

use std::hint::black_box;

use super::{AT_TABLE, Stopwatch, models, parked, spawn};
use robotics::world::World;
use view::picture::{Scene, View, render};

/// Building the scene, drawing it from every view, and encoding a picture.
pub fn pictures(stopwatch: &mut dyn Stopwatch) {
    let models = models();
    let robot = parked(&models, AT_TABLE, 0.3);
    let mut world = World::new(models, robot);
    spawn(&mut world, "BOTTLE", "bottle", [-1.6, -0.9, 0.82]);
    stopwatch.repeated("scene", &mut || {
        black_box(Scene::of(&world));
    });
    let scene = Scene::of(&world);
    let camera = |view: View| {
        let camera = view.camera(&world, 640, 480);
        camera.expect("the built-in kitchen has all that the views look at")
    };
    for view in View::NAMED {
        let camera = camera(view);
        stopwatch.repeated(&format!("picture {view}"), &mut || {
            black_box(render(&scene, &camera));
        });
    }
    let image = render(&scene, &camera(View::Kitchen));
    stopwatch.repeated("PNG", &mut || {
        black_box(image.to_png().is_ok());
    });
}
