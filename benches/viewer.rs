//! What a picture costs: 640 x 480, of the kitchen with robot and a bottle.
//!
//! Run with `cargo bench --bench viewer`.

#[path = "../tests/world_support/mod.rs"]
mod world_support;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use planwright::viewer::{Scene, View, render};
use planwright::world::World;
use world_support::{at, carry, models, spawn};

fn pictures(c: &mut Criterion) {
    let models = models();
    let robot = carry(&models, [-1.447, -0.15, -90.0], 0.3);
    let mut world = World::new(models, robot);
    spawn(&mut world, "BOTTLE", "bottle", &at(-1.6, -0.9, 0.82));
    c.bench_function("scene", |b| b.iter(|| black_box(Scene::of(&world))));
    let scene = Scene::of(&world);
    for view in View::NAMED {
        // The built-in kitchen has all that the views look at.
        let camera = view.camera(&world, 640, 480).unwrap();
        c.bench_function(&format!("picture {view}"), |b| {
            b.iter(|| black_box(render(&scene, &camera)));
        });
    }
    let camera = View::Kitchen.camera(&world, 640, 480).unwrap();
    let image = render(&scene, &camera);
    c.bench_function("PNG", |b| {
        b.iter(|| {
            let mut png = Vec::new();
            image.write_png(&mut png).unwrap();
            black_box(png)
        });
    });
}

criterion_group! {
    name = viewer;
    config = Criterion::default().sample_size(20);
    targets = pictures
}
criterion_main!(viewer);
