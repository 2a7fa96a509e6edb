//! What is to be seen in pictures of the world.

#[path = "world_support/mod.rs"]
mod world_support;

use nalgebra::Point3;
use planwright::perception::camera::Camera;
use planwright::spatial::Pose;
use planwright::viewer::{Image, Scene, View, ViewError, render};
use planwright::world::World;
use world_support::{at, carry, models};

const WIDTH: usize = 320;
const HEIGHT: usize = 240;

/// The robot at the table, on which a red bottle stands.
fn world() -> World {
    let models = models();
    let robot = carry(&models, [-1.447, -0.15, -90.0], 0.3);
    let mut world = World::new(models, robot);
    let red = Some([0.7, 0.0, 0.0, 1.0]);
    let place = at(-1.6, -0.9, 0.83);
    world.spawn("BOTTLE", "bottle", &place, red, None).unwrap();
    world
}

fn camera(world: &World, view: View) -> Camera {
    view.camera(world, WIDTH, HEIGHT).unwrap()
}

fn picture(world: &World, view: View) -> Image {
    render(&Scene::of(world), &camera(world, view))
}

/// Columns and rows of the pixels that are clearly red.
fn red(image: &Image) -> Vec<[f64; 2]> {
    let is_red = |[r, g, b]: [u8; 3]| r > 60 && r / 3 > g && r / 3 > b;
    let pixels = (0..HEIGHT).flat_map(|row| (0..WIDTH).map(move |column| (column, row)));
    pixels
        .filter(|&(column, row)| is_red(image.pixel(column, row).unwrap()))
        .map(|(column, row)| [column as f64 + 0.5, row as f64 + 0.5])
        .collect()
}

#[test]
fn the_bottle_is_seen_where_it_stands() {
    let world = world();
    let camera = camera(&world, View::Table);
    let found = red(&picture(&world, View::Table));
    let pose = world.object_pose("BOTTLE").unwrap();
    let corner = |i: usize| {
        let side = |bit: usize, size: f64| if (i >> bit) & 1 == 0 { -size } else { size };
        let corner = Point3::new(side(0, 0.0375), side(1, 0.0375), side(2, 0.101));
        camera.pixel_of(&(pose * corner)).unwrap()
    };
    let corners: Vec<_> = (0..8).map(corner).collect();
    for axis in 0..2 {
        let low = corners
            .iter()
            .map(|c| c[axis])
            .fold(f64::INFINITY, f64::min);
        let high = corners.iter().map(|c| c[axis]).fold(0.0, f64::max);
        assert!(
            found
                .iter()
                .all(|p| (low - 1.0..high + 1.0).contains(&p[axis]))
        );
    }
    let [column, row] = camera.pixel_of(&(pose * Point3::origin())).unwrap();
    let near = |p: &&[f64; 2]| (p[0] - column).abs() < 2.0 && (p[1] - row).abs() < 2.0;
    assert!(found.iter().filter(near).count() >= 9);
    // A bottle has a neck: its upper part is narrower than its lower one.
    let top = found.first().unwrap()[1];
    let wide = |row: f64| found.iter().filter(|p| p[1] == row).count();
    let bottom = found.last().unwrap()[1];
    assert!(2 * wide(top + 1.0) < 2 * wide(bottom - 4.0) - wide(bottom - 4.0) / 2);
}

#[test]
fn a_red_bottle_is_what_makes_a_picture_red() {
    let mut world = world();
    world.remove("BOTTLE").unwrap();
    assert_eq!(red(&picture(&world, View::Table)), Vec::<[f64; 2]>::new());
}

#[test]
fn the_same_world_gives_the_same_bytes() {
    for view in View::NAMED {
        let png = |world: &World| {
            let mut bytes = Vec::new();
            picture(world, view).write_png(&mut bytes).unwrap();
            bytes
        };
        assert!(png(&world()) == png(&world()), "{view}");
    }
}

#[test]
fn the_robot_is_white_in_the_middle_of_its_base() {
    let world = world();
    let view = View::Free {
        from: Point3::new(-1.447, 2.5, 1.2),
        at: Point3::new(-1.447, -0.15, 0.6),
        vertical_fov: 0.8,
    };
    let base = world.robot_configuration().base;
    // The upper edge of the base, at the robot's back.
    let back = base * Point3::new(-0.333, 0.0, 0.2);
    let [column, row] = camera(&world, view).pixel_of(&back).unwrap();
    let here = picture(&world, view)
        .pixel(column as usize, row as usize)
        .unwrap();
    let [low, high] = [here.iter().min().unwrap(), here.iter().max().unwrap()];
    assert!(*low > 90 && high - low < 40, "{here:?}");
}

#[test]
fn axes_are_red_green_and_blue() {
    let world = world();
    let view = View::Free {
        from: Point3::new(0.5, -2.0, 5.0),
        at: Point3::new(-2.0, 1.0, 2.0),
        vertical_fov: 0.5,
    };
    let camera = camera(&world, view);
    let mut scene = Scene::of(&world);
    scene.add_axes(&Pose::translation(-2.0, 1.0, 2.0), 0.8);
    let image = render(&scene, &camera);
    for (axis, step) in [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]]
        .iter()
        .enumerate()
    {
        let point = Point3::new(-2.0 + step[0], 1.0 + step[1], 2.0 + step[2]);
        let [column, row] = camera.pixel_of(&point).unwrap();
        let pixel = image.pixel(column as usize, row as usize).unwrap();
        let strongest = pixel.iter().max().unwrap();
        assert_eq!(
            pixel.iter().position(|c| c == strongest),
            Some(axis),
            "{pixel:?}"
        );
    }
}

#[test]
fn a_view_from_where_it_looks_is_refused() {
    let place = Point3::new(1.0, 2.0, 3.0);
    let view = View::Free {
        from: place,
        at: place,
        vertical_fov: 0.7,
    };
    let error = view.camera(&world(), 10, 10);
    assert_eq!(error, Err(ViewError::NoDirection(place)));
    let view = View::Free {
        from: Point3::new(f64::NAN, 0.0, 0.0),
        at: place,
        vertical_fov: 0.7,
    };
    assert!(matches!(
        view.camera(&world(), 10, 10),
        Err(ViewError::Impossible(_))
    ));
}
