//! The shapes of the robot's links against points on its true surfaces.
//!
//! Two figures tell how good the shapes of a link are, together with those of its fixed
//! neighbours: how far a point of the true surface lies outside of all of them (too short: a
//! collision would be missed), and how far the surface of the shapes is from the true one (too
//! large: a gap looks blocked).

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;

use crate::perception::mesh::Mesh;
use crate::robot::{JointKind, KinematicTree, LinkId};
use crate::tests::world::fixture::models;
use crate::world::solid::Solid;
use spatial::{PlacedShape, Pose, Shape};

/// Maximum distance (m) of a point of the true surface from the shapes.
const MAX_SHORT: f64 = 0.005;

/// Maximum distance (m) of 95 % of the shapes' surface from the true one.
const MAX_OUT: f64 = 0.025;

/// Distance (m) between samples of the shapes' surface.
const SPACING: f64 = 0.01;

/// Points (m) of the true surfaces, by the names of the links, left links included.
fn true_surfaces() -> BTreeMap<String, Vec<Point3<f64>>> {
    let mut measured: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut link = "";
    for line in include_str!("pr2_surfaces.txt").lines() {
        if line.starts_with(|c: char| c.is_ascii_lowercase()) {
            link = line;
        } else if !line.is_empty() && !line.starts_with('#') {
            let numbers = line.split_whitespace().map(|n| n.parse::<f64>().unwrap());
            let points = measured.entry(link.to_owned()).or_default();
            points.extend(numbers.map(|mm| mm / 1000.0));
        }
    }
    let points = |numbers: &Vec<f64>, side: f64| -> Vec<Point3<f64>> {
        let points = numbers.chunks_exact(3);
        points
            .map(|p| Point3::new(p[0], p[1] * side, p[2]))
            .collect()
    };
    let mut surfaces = BTreeMap::new();
    for (link, numbers) in &measured {
        surfaces.insert(link.clone(), points(numbers, 1.0));
        let fingers = [
            (link.clone(), 1.0),
            (link.replace("_l_finger", "_r_finger"), -1.0),
        ];
        for (name, side) in fingers {
            surfaces.insert(name.clone(), points(numbers, side));
            if let Some(of_right) = name.strip_prefix("r_") {
                surfaces.insert(format!("l_{of_right}"), points(numbers, side));
            }
        }
    }
    surfaces
}

/// The link at the other end of the fixed joints that lead to this one.
fn fixed_root(tree: &KinematicTree, mut link: LinkId) -> LinkId {
    while let Some(id) = tree.link(link).parent_joint {
        let joint = tree.joint(id);
        if joint.kind != JointKind::Fixed {
            break;
        }
        link = joint.parent;
    }
    link
}

/// Points on the surface of a shape with the area (m²) that each stands for.
fn samples(placed: &PlacedShape) -> Vec<(Point3<f64>, f64)> {
    let mesh = Mesh::of(&placed.shape);
    let mut samples = Vec::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| placed.pose * mesh.corners[i as usize]);
        let (u, v) = (b - a, c - a);
        let area = u.cross(&v).norm() / 2.0;
        let longest = u.norm().max(v.norm()).max((c - b).norm());
        let parts = (longest / SPACING).ceil() as usize;
        let step = 1.0 / parts as f64;
        // The middles of the equal triangles that it is divided into.
        for i in 0..parts {
            for j in 0..(parts - i) {
                let mut add = |third: f64| {
                    let [s, t] = [i, j].map(|n| (n as f64 + third) * step);
                    samples.push((a + u * s + v * t, area * step * step));
                };
                add(1.0 / 3.0);
                if i + j + 1 < parts {
                    add(2.0 / 3.0);
                }
            }
        }
    }
    samples
}

fn distance(solid: &Solid, point: &Point3<f64>) -> f64 {
    let point = Vector::new(point.x, point.y, point.z);
    solid.shape.distance_to_point(&solid.pose, point, true)
}

/// How well shapes fit points of the true surface.
struct Fit {
    /// Maximum distance (m) of a point from the shapes.
    short: f64,
    /// Distance (m) from the points that 95 % of the shapes' surface keep.
    out: f64,
}

fn fit(shapes: &[PlacedShape], points: &[Point3<f64>]) -> Fit {
    let solids = Solid::all(shapes);
    assert_eq!(solids.len(), shapes.len());
    let outside = |p| {
        let distances = solids.iter().map(|s| distance(s, p));
        distances.fold(f64::INFINITY, f64::min)
    };
    let short = points.iter().map(outside).fold(0.0, f64::max);
    let mut gaps = Vec::new();
    for (i, shape) in shapes.iter().enumerate() {
        for (sample, area) in samples(shape) {
            let mut others = solids.iter().enumerate().filter(|(j, _)| *j != i);
            // What lies within another shape is no surface.
            if others.any(|(_, other)| distance(other, &sample) == 0.0) {
                continue;
            }
            let squares = points.iter().map(|p| (p - sample).norm_squared());
            gaps.push((squares.fold(f64::INFINITY, f64::min).sqrt(), area));
        }
    }
    gaps.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut beyond = 0.05 * gaps.iter().map(|(_, area)| area).sum::<f64>();
    let farthest = gaps.iter().find(|(_, area)| {
        beyond -= area;
        beyond < 0.0
    });
    Fit {
        short,
        out: farthest.map_or(0.0, |(gap, _)| *gap),
    }
}

/// Links that are fixed to one another: their names, shapes and true surface.
type Group<'a> = (Vec<&'a str>, Vec<PlacedShape>, Vec<Point3<f64>>);

#[test]
fn links_are_as_large_as_the_robot_s() {
    let models = models();
    let tree = &models.robot;
    let zero = tree.zero_positions();
    let mut groups: BTreeMap<usize, Group<'_>> = BTreeMap::new();
    let surfaces = true_surfaces();
    for (name, surface) in &surfaces {
        let id = tree.link_named(name).unwrap();
        let root = fixed_root(tree, id);
        let pose = tree.relative_pose(root, id, &zero).unwrap();
        let (names, shapes, points) = groups.entry(root.index()).or_default();
        names.push(name);
        shapes.extend(tree.link(id).collisions.iter().map(|s| PlacedShape {
            pose: pose * s.pose,
            ..s.clone()
        }));
        points.extend(surface.iter().map(|p| pose * p));
    }
    assert_eq!(groups.len(), 27);
    let mut wrong = Vec::new();
    for (names, shapes, points) in groups.values() {
        let Fit { short, out } = fit(shapes, points);
        let [s, o] = [short, out].map(|m| 1000.0 * m);
        println!(
            "{s:5.1} mm short, {o:5.1} mm out, {:2} shapes: {names:?}",
            shapes.len()
        );
        if short > MAX_SHORT || out > MAX_OUT {
            wrong.push(names);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

#[test]
fn both_arms_have_the_same_shapes() {
    let models = models();
    let tree = &models.robot;
    for (id, link) in tree.links() {
        if let Some(of_right) = link.name.strip_prefix("r_") {
            let left = tree.link_named(&format!("l_{of_right}")).unwrap();
            assert_eq!(
                tree.link(left).collisions,
                tree.link(id).collisions,
                "{of_right}"
            );
        }
    }
}

#[test]
fn the_fit_of_a_box_to_a_box_is_measured() {
    let cube = |size: f64, x: f64| PlacedShape {
        shape: Shape::Box { size: [size; 3] },
        pose: Pose::translation(x, 0.0, 0.0),
        color: None,
    };
    let points: Vec<_> = samples(&cube(0.2, 0.0)).iter().map(|s| s.0).collect();
    let own = fit(&[cube(0.2, 0.0)], &points);
    assert!(own.short < 1e-9 && own.out < 1e-9);
    // 10 mm larger on each side; its corners are sqrt(3) times as far out.
    let larger = fit(&[cube(0.22, 0.0)], &points);
    assert!(larger.short < 1e-9, "{}", larger.short);
    assert!((0.01..0.018).contains(&larger.out), "{}", larger.out);
    let moved = fit(&[cube(0.2, 0.03)], &points);
    assert!((moved.short - 0.03).abs() < 0.004, "{}", moved.short);
    // A second shape within the first has no surface.
    let both = fit(&[cube(0.2, 0.0), cube(0.05, 0.0)], &points);
    assert!(both.out < 1e-9, "{}", both.out);
}

#[test]
fn samples_stand_for_the_whole_surface() {
    let cylinder = PlacedShape {
        shape: Shape::Cylinder {
            radius: 0.1,
            length: 0.3,
        },
        pose: Pose::identity(),
        color: None,
    };
    let area: f64 = samples(&cylinder).iter().map(|s| s.1).sum();
    let expected = std::f64::consts::TAU * 0.1 * (0.1 + 0.3);
    assert!((area / expected - 1.0).abs() < 0.02, "{area}");
    let middle: Vector3<f64> = samples(&cylinder).iter().map(|s| s.0.coords * s.1).sum();
    assert!(middle.norm() < 1e-9, "{middle}");
}
