//! Cups, bowls and plates: rings of boxes work well in contact but look like barrels, so they
//! are drawn as the round things that they stand for.

use nalgebra::Vector3;

use crate::picture::surface::Surface;
use spatial::{PlacedShape, Pose, Shape};

/// Minimum number of boxes that count as a ring.
const MIN_COUNT: usize = 6;

/// Tolerance (m) for the positions of a ring's boxes and for the axes of a vessel's rings.
const RING_TOLERANCE: f64 = 1e-6;
const AXIS_TOLERANCE: f64 = 2e-3;

/// A part of an object to be drawn.
pub(super) enum Part<'a> {
    /// The shape itself.
    Shape(&'a PlacedShape),
    /// Something round and hollow.
    Vessel {
        /// Its surface, around the z axis.
        surface: Surface,
        /// Pose of the surface's frame in the object's frame.
        at: Pose,
    },
}

/// A ring of boxes that stand upright or all lean outwards alike.
struct Ring {
    /// Centre (m) in the object's frame.
    middle: [f64; 3],
    /// Distance from the axis to the middle of the boxes (m).
    radius: f64,
    /// Thickness along the radius, and height, of the boxes as they stand (m).
    thickness: f64,
    height: f64,
}

/// What to draw for the shapes of an object.
pub(crate) fn parts_of(shapes: &[PlacedShape]) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut left = shapes;
    while let Some((first, rest)) = left.split_first() {
        let base = base(first);
        let (rings, after) = rings(if base.is_some() { rest } else { left });
        let vessel = rings.first().filter(|ring| match base {
            Some((middle, ..)) => is_around(ring, middle),
            None => true,
        });
        if let Some(ring) = vessel {
            parts.push(Part::Vessel {
                surface: Surface::lathed(&line(base, &rings)),
                at: Pose::translation(ring.middle[0], ring.middle[1], 0.0),
            });
            left = after;
        } else {
            parts.push(Part::Shape(first));
            left = rest;
        }
    }
    parts
}

/// Middle (m), radius and length (m) of an upright cylinder.
type Base = ([f64; 3], f64, f64);

fn base(placed: &PlacedShape) -> Option<Base> {
    match placed.shape {
        Shape::Cylinder { radius, length } if is_upright(&placed.pose) => {
            Some((placed.pose.translation.vector.into(), radius, length))
        }
        _ => None,
    }
}

fn is_upright(pose: &Pose) -> bool {
    let q = pose.rotation.quaternion();
    q.i.abs() < 1e-9 && q.j.abs() < 1e-9
}

/// How much of a box's height (as a share) is along the object's axis: 1 for an upright box,
/// less for one that leans.
fn uprightness(pose: &Pose) -> f64 {
    (pose.rotation * Vector3::z()).z
}

fn is_around(ring: &Ring, [x, y, _]: [f64; 3]) -> bool {
    let [a, b, _] = ring.middle;
    (a - x).abs() < AXIS_TOLERANCE && (b - y).abs() < AXIS_TOLERANCE
}

/// The rings about one axis that the shapes start with, in ascending order, and the rest.
fn rings(mut shapes: &[PlacedShape]) -> (Vec<Ring>, &[PlacedShape]) {
    let mut rings: Vec<Ring> = Vec::new();
    while let Some((ring, rest)) = ring(shapes) {
        let goes_on = rings
            .last()
            .is_none_or(|below| is_around(below, ring.middle) && below.middle[2] < ring.middle[2]);
        if !goes_on {
            break;
        }
        rings.push(ring);
        shapes = rest;
    }
    (rings, shapes)
}

/// The ring that the shapes start with.
fn ring(shapes: &[PlacedShape]) -> Option<(Ring, &[PlacedShape])> {
    let first = shapes.first()?;
    let Shape::Box {
        size: [thickness, _, height],
    } = first.shape
    else {
        return None;
    };
    let upright = uprightness(&first.pose);
    let is_stave =
        |s: &&PlacedShape| s.shape == first.shape && (uprightness(&s.pose) - upright).abs() < 1e-9;
    let same = shapes.iter().take_while(is_stave).count();
    // Two rings of the same boxes are distinguished by their heights.
    let level =
        |s: &&PlacedShape| (s.pose.translation.z - first.pose.translation.z).abs() < RING_TOLERANCE;
    let count = shapes.iter().take(same).take_while(level).count();
    let (staves, rest) = shapes.split_at(count);
    if count < MIN_COUNT {
        return None;
    }
    let mean = |axis: usize| {
        staves
            .iter()
            .map(|s| s.pose.translation.vector[axis])
            .sum::<f64>()
            / count as f64
    };
    let middle = [mean(0), mean(1), mean(2)];
    let distance = |s: &PlacedShape| {
        let at = s.pose.translation.vector;
        libm::hypot(at.x - middle[0], at.y - middle[1])
    };
    let radius = distance(first);
    let is_ring = staves
        .iter()
        .all(|s| (distance(s) - radius).abs() < RING_TOLERANCE && leans_outwards(s, middle))
        && radius > thickness;
    let ring = Ring {
        middle,
        radius,
        thickness: thickness / upright,
        height: height * upright,
    };
    is_ring.then_some((ring, rest))
}

/// Whether the box stands upright, or leans away from the middle (m).
fn leans_outwards(stave: &PlacedShape, middle: [f64; 3]) -> bool {
    let up = stave.pose.rotation * Vector3::z();
    let lean = libm::hypot(up.x, up.y);
    let out = stave.pose.translation.vector - Vector3::from(middle);
    let along = up.x * out.x + up.y * out.y;
    up.z > 0.0 && (along - lean * libm::hypot(out.x, out.y)).abs() < RING_TOLERANCE
}

/// Half of the section through a vessel, as distances from the axis and heights (m): outwards
/// along the bottom, up the outside, down the inside. Rings of different radii are joined by
/// slopes.
fn line(base: Option<Base>, rings: &[Ring]) -> Vec<[f64; 2]> {
    let (Some(lowest), Some(highest)) = (rings.first(), rings.last()) else {
        return Vec::new();
    };
    let bottom = match base {
        Some((middle, _, length)) => middle[2] - length / 2.0,
        None => lowest.middle[2] - lowest.height / 2.0,
    };
    let floor = base.map_or(bottom, |(_, _, length)| bottom + length);
    let top = highest.middle[2] + highest.height / 2.0;
    // How the radius grows at both ends of the stack of rings.
    let slope = |pair: Option<&[Ring]>| match pair {
        Some([a, b]) => (b.radius - a.radius) / (b.middle[2] - a.middle[2]),
        _ => 0.0,
    };
    let lowest_slope = slope(rings.windows(2).next());
    let highest_slope = slope(rings.windows(2).last());
    let side = |sign: f64| {
        let wall = move |ring: &Ring| ring.radius + sign * ring.thickness / 2.0;
        let begin = if sign > 0.0 { bottom } else { floor };
        let first = wall(lowest) - lowest_slope * (lowest.middle[2] - begin);
        let first = match base {
            Some((_, radius, _)) if sign > 0.0 && rings.len() > 1 => radius,
            _ => first.max(0.2 * lowest.radius),
        };
        let last = wall(highest) + highest_slope * (top - highest.middle[2]);
        let mut points = vec![[first, begin]];
        if rings.len() > 1 {
            points.extend(rings.iter().map(|ring| [wall(ring), ring.middle[2]]));
        }
        points.push([last, top]);
        points
    };
    let mut line = Vec::new();
    line.extend(base.map(|_| [0.0, bottom]));
    line.extend(side(1.0));
    line.extend(side(-1.0).into_iter().rev());
    match base {
        Some(_) => line.push([0.0, floor]),
        // Without a bottom, the wall's outline closes on itself.
        None => line.extend(line.first().copied()),
    }
    line
}

#[cfg(test)]
mod tests {
    use crate::picture::looks::vessel::*;
    use robotics::world::object_library::{OBJECTS, ObjectLibrary};

    fn kinds(name: &str) -> String {
        let library = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").unwrap();
        let parts = parts_of(&library.get(name).unwrap().shapes).into_iter();
        parts
            .map(|part| match part {
                Part::Shape(_) => 's',
                Part::Vessel { .. } => 'v',
            })
            .collect()
    }

    #[test]
    fn rings_with_their_bottom_are_one_vessel() {
        assert_eq!(kinds("bowl"), "v");
        assert_eq!(kinds("plate"), "v");
        assert_eq!(kinds("cup"), "v");
        assert_eq!(kinds("mug"), "vsss");
        assert_eq!(kinds("pot"), "vss");
    }

    #[test]
    fn other_objects_are_drawn_as_they_are() {
        assert_eq!(kinds("bottle"), "sss");
        assert_eq!(kinds("tray"), "sssss");
        assert_eq!(kinds("cube"), "s");
    }

    #[test]
    fn a_ring_without_a_bottom_is_a_tube() {
        let text = "(object o :mass 1 :color (0 0 0)
                     :shapes ((ring :count 8 :radius 1 :stave (0.1 0.8 1))))";
        let library = ObjectLibrary::from_sexp(text, "o.sexp").unwrap();
        let parts = parts_of(&library.get("o").unwrap().shapes);
        let [Part::Vessel { surface, .. }] = parts.as_slice() else {
            panic!("{} parts", parts.len());
        };
        let heights = surface.corners.iter().map(|c| c.point.z.abs());
        assert!(heights.map(|z| (z - 0.5).abs()).all(|e| e < 1e-12));
    }
}
