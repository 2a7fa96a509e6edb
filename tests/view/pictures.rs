//! What is to be seen in pictures of the world.

use crate::measured::{models, parked as carry};
use nalgebra::Point3;
use robotics::perception::{Camera, Sight};
use robotics::world::{PartKey, World};
use spatial::Pose;
use spatial::pose::from_xyz_rpy;
use view::picture::animation::{Shot, write_gif};
use view::picture::render::segments;
use view::picture::scene::{Kind, Owner};
use view::picture::{
    CameraPicture, FloorMap, Image, Looks, Scene, View, ViewError, map_scene, render,
};

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
    let widest = found.iter().map(|p| wide(p[1])).max().unwrap();
    assert!(4 * wide(top + 1.0) < 3 * widest);
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

/// For every pixel of the view, row by row, whether it shows a thing of the kind and name.
fn shown(scene: &Scene, camera: &Camera, is_it: impl Fn(&Owner) -> bool) -> Vec<bool> {
    let owner = |place: usize| &scene.bodies[place].owner;
    let pixels = segments(scene, camera).into_iter();
    pixels
        .map(|body| body.is_some_and(|body| is_it(owner(body))))
        .collect()
}

/// Pixels in both over pixels in one or the other.
fn agreement(a: &[bool], b: &[bool]) -> f64 {
    assert_eq!(a.len(), b.len());
    let count = |is: &dyn Fn(bool, bool) -> bool| {
        let pairs = a.iter().zip(b);
        pairs.filter(|(a, b)| is(**a, **b)).count() as f64
    };
    count(&|a, b| a && b) / count(&|a, b| a || b)
}

#[test]
fn things_look_as_large_as_the_robot_s_camera_takes_them_to_be() {
    let mut world = world();
    for (i, kind) in ["bowl", "mug", "cup", "milk", "cereal", "pot", "plate"]
        .into_iter()
        .enumerate()
    {
        let place = at(-1.95 + 0.2 * i as f64, -1.15, 0.86);
        world.spawn(kind, kind, &place, None, None).unwrap();
    }
    world.settle(3.0);
    let scene = Scene::of(&world);
    let camera = Camera {
        far: 50.0,
        ..camera(&world, View::Table)
    };
    let sight = Sight::take(&world, camera, 0.9);
    let kept = |is: &dyn Fn(PartKey) -> bool| -> Vec<bool> {
        let keys = sight.picture().keys().iter();
        keys.map(|key| key.is_some_and(is)).collect()
    };
    let robot = shown(&scene, &camera, |owner| owner.kind == Kind::Robot);
    let body = kept(&|key| matches!(key, PartKey::Robot(_)));
    assert!(
        agreement(&robot, &body) > 0.85,
        "{}",
        agreement(&robot, &body)
    );
    for object in world.objects() {
        let seen = shown(&scene, &camera, |owner| &*owner.name == object.name());
        let solid = kept(&|key| key == object.key());
        let agreement = agreement(&seen, &solid);
        assert!(agreement > 0.7, "{}: {agreement}", object.name());
    }
}

#[test]
fn one_can_look_through_the_handle_of_a_mug() {
    let mut world = world();
    let place = at(-1.3, -0.9, 0.83);
    world.spawn("MUG", "mug", &place, None, None).unwrap();
    world.settle(3.0);
    let pose = world.object_pose("MUG").unwrap();
    let look = |from: Point3<f64>, at: Point3<f64>| View::Free {
        from: pose * from,
        at: pose * at,
        vertical_fov: 0.3,
    };
    let view = look(Point3::new(0.06, -0.7, 0.0), Point3::new(0.06, 0.0, -0.008));
    let scene = Scene::of(&world);
    let camera = camera(&world, view);
    let is_mug = shown(&scene, &camera, |owner| &*owner.name == "MUG");
    // The middle of the picture looks through the handle; the handle is around it.
    let middle = (HEIGHT / 2) * WIDTH + WIDTH / 2;
    let row = &is_mug[middle - WIDTH / 2..middle + WIDTH / 2];
    assert!(!is_mug[middle]);
    assert!(row[WIDTH / 2..].contains(&true) && row[..WIDTH / 2].contains(&true));
}

#[test]
fn shoulders_are_blue_on_the_left_and_orange_on_the_right() {
    let world = world();
    let view = View::Free {
        from: Point3::new(-1.447, -2.6, 1.5),
        at: Point3::new(-1.447, -0.15, 1.0),
        vertical_fov: 0.6,
    };
    let image = picture(&world, view);
    let mean = |is: &dyn Fn([u8; 3]) -> bool| {
        let columns: Vec<usize> = (0..WIDTH)
            .flat_map(|column| (0..HEIGHT).map(move |row| (column, row)))
            .filter(|&(column, row)| is(image.pixel(column, row).unwrap()))
            .map(|(column, _)| column)
            .collect();
        assert!(columns.len() > 100, "{}", columns.len());
        columns.iter().sum::<usize>() / columns.len()
    };
    // Observation from in front the robot's left is to the right.
    let blue = mean(&|[r, _, b]| b > 90 && b / 2 > r);
    let orange = mean(&|[r, g, b]| r > 150 && r / 3 > g / 2 && b < 60);
    assert!(
        blue > WIDTH / 2 + 10 && orange + 10 < WIDTH / 2,
        "{blue} {orange}"
    );
}

#[test]
fn the_map_tells_free_floor_from_blocked() {
    let world = world();
    let [from, to] = View::map_area(WIDTH, HEIGHT);
    let map = FloorMap::of(&world, from, to);
    // Where the robot stands, in the middle of the kitchen, in the table, in a wall.
    assert_eq!(map.is_free(-1.447, -0.15), Some(true));
    assert_eq!(map.is_free(0.8, 1.0), Some(true));
    assert_eq!(map.is_free(-1.4, -1.0), Some(false));
    assert_eq!(map.is_free(-0.6, 1.5), Some(false));
    assert_eq!(map.is_free(100.0, 0.0), None);
    let scene = map_scene(&world, &Looks::of(world.models()), &map);
    let camera = camera(&world, View::Map);
    let image = render(&scene, &camera);
    let pixel = |x: f64, y: f64| {
        let [column, row] = camera.pixel_of(&Point3::new(x, y, 0.0)).unwrap();
        image.pixel(column as usize, row as usize).unwrap()
    };
    let [r, g, b] = pixel(0.3, 0.8);
    assert!(g > r && g > b, "{r} {g} {b}");
    let [r, g, b] = pixel(-1.62, 1.5);
    assert!(r > g + 30 && r > b + 30, "{r} {g} {b}");
}

#[test]
fn the_camera_s_picture_outlines_what_is_hidden() {
    let mut world = world();
    let looks = Looks::of(world.models());
    let sought = vec!["BOTTLE".to_owned()];
    let pink = |world: &World| {
        let shown = CameraPicture::take(world, &looks, &sought, 960);
        let colours = shown.image.bytes().chunks(3);
        let outline = colours.filter(|c| *c == [255, 96, 208]).count();
        (outline, shown.sought[0].fraction(), shown.image)
    };
    let mut robot = world.robot_configuration().clone();
    let tilt = world.models().robot.joint_named("head_tilt_joint").unwrap();
    robot.joints.set(tilt, 0.7);
    world.teleport_robot(&robot);
    let (_, seen, open) = pink(&world);
    // Something in front of the bottle hides it, but not its outline.
    let front = at(-1.58, -0.72, 0.9);
    world
        .spawn("BOX", "cereal-box", &front, None, None)
        .unwrap();
    let (outline, hidden, image) = pink(&world);
    assert!(hidden < seen, "{hidden} {seen}");
    assert!(outline > 150, "{outline}");
    assert_eq!((image.width(), open.width()), (960, 960));
    // Nothing of the name is sought: nothing is outlined.
    let nobody = CameraPicture::take(&world, &looks, &["NOBODY".to_owned()], 960);
    assert!(nobody.sought.is_empty());
}

#[test]
fn a_gif_tells_every_frame_and_always_the_same() {
    let mut world = world();
    let looks = Looks::of(world.models());
    let mut shots = Vec::new();
    for step in 0..4 {
        // Between the second and the third shot nothing changes.
        let x = -1.7 + 0.1 * f64::from(if step == 2 { 1 } else { step });
        world.move_object("BOTTLE", &at(x, -0.9, 0.83)).unwrap();
        shots.push(Shot {
            scene: looks.scene(&world),
            camera: camera(&world, View::Table),
        });
    }
    let bytes = |shots: &[Shot]| {
        let mut bytes = Vec::new();
        write_gif(shots, 7, &mut bytes).unwrap();
        bytes
    };
    let gif = bytes(&shots);
    assert!(gif == bytes(&shots));
    let mut decoder = gif::DecodeOptions::new().read_info(gif.as_slice()).unwrap();
    assert_eq!((decoder.width(), decoder.height()), (320, 240));
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        delays.push((frame.delay, frame.width < 320));
    }
    assert_eq!(delays, [(7, false), (14, true), (7, true)]);
}

/// The pose of an upright thing at a position (m).
fn at(x: f64, y: f64, z: f64) -> Pose {
    from_xyz_rpy([x, y, z], [0.0; 3])
}
