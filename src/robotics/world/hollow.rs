//! Whether a thing holds others as it stands: a vessel, a plate, a tray.
//!
//! It does if it has a hollow that is open at the top: places on which something lies free to the sky, with
//! walls around them on all sides. Only the shapes tell, so this holds for types of users, too. The room that
//! [`super::cavity`] measures is about one axis; a hollow may be anywhere, as in a tray with compartments.

use parry3d_f64::math::Vector;
use parry3d_f64::query::Ray;

use super::solid::{Solid, bounds_of};
use spatial::trig;

/// Number of places along and across at which it is looked for a hollow.
const PLACES: u32 = 9;
/// How far (m) above its bottom a hollow must have walls.
const DEPTH: f64 = 0.004;
/// Number of directions in which there must be a wall; a gap that only one of them meets is one between the
/// parts of a shape.
const DIRECTIONS: u32 = 32;
/// Least area (m²) of a hollow that holds something.
const AREA: f64 = 6e-4;

/// Whether solids, in their owner's frame with its top at +z, have a hollow that is open at the top.
pub(super) fn is_hollow(solids: &[Solid]) -> bool {
    let Some(bounds) = bounds_of(solids) else {
        return false;
    };
    let (low, size) = (bounds.mins, bounds.extents());
    let above = bounds.maxs.z + 1.0;
    let cell = size.x * size.y / f64::from(PLACES * PLACES);
    let meets = |from: Vector, way: Vector, far: f64| {
        let ray = Ray::new(from, way);
        let hits = solids
            .iter()
            .filter_map(|solid| solid.shape.cast_ray(&solid.pose, &ray, far, true));
        hits.reduce(f64::min)
    };
    let across = size.x + size.y;
    let is_enclosed = |x: f64, y: f64| {
        let Some(down) = meets(
            Vector::new(x, y, above),
            Vector::new(0.0, 0.0, -1.0),
            above - low.z + 1.0,
        ) else {
            return false;
        };
        let from = Vector::new(x, y, above - down + DEPTH);
        if from.z >= bounds.maxs.z {
            return false;
        }
        let mut is_gap = false;
        // The first direction is tried once more at the end.
        (0..=DIRECTIONS).all(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(DIRECTIONS);
            let (sin, cos) = trig::sin_cos(angle);
            let was_gap = is_gap;
            is_gap = meets(from, Vector::new(cos, sin, 0.0), across).is_none();
            !(is_gap && was_gap)
        })
    };
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(PLACES);
    let mut area = 0.0;
    for i in 0..PLACES {
        for j in 0..PLACES {
            if is_enclosed(low.x + size.x * share(i), low.y + size.y * share(j)) {
                area += cell;
            }
            if area >= AREA {
                return true;
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::object_library::{OBJECTS, ObjectLibrary};

    #[test]
    fn vessels_plates_and_trays_are_hollow_and_nothing_else_is() {
        let library = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").expect("it is right");
        let hollow: Vec<&str> = (library.names())
            .filter(|name| {
                let kind = library.get(name);
                kind.is_some_and(|kind| is_hollow(&Solid::all(&kind.shapes)))
            })
            .collect();
        let mut hollow = hollow;
        hollow.sort_unstable();
        hollow.dedup();
        assert_eq!(
            hollow,
            [
                "blue-metal-plate",
                "bowl",
                "cup",
                "ladle",
                "mug",
                "open-box",
                "plate",
                "pot",
                "red-metal-plate",
                "tray",
            ]
        );
    }

    fn is_hollow_text(shapes: &str) -> bool {
        let text = format!("(object o :mass 1 :color (0 0 0) :shapes ({shapes}))");
        let library = ObjectLibrary::from_sexp(&text, "o.sexp").expect("it is right");
        is_hollow(&Solid::all(&library.get("o").expect("it is there").shapes))
    }

    #[test]
    fn a_hollow_that_is_closed_above_or_open_at_a_side_holds_nothing() {
        let walls = "(ring :count 8 :radius 0.05 :stave (0.006 0.045 0.1))";
        let bottom = "(cylinder :radius 0.05 :length 0.006 :at (0 0 -0.05))";
        let lid = "(cylinder :radius 0.053 :length 0.006 :at (0 0 0.05))";
        assert!(is_hollow_text(&format!("{walls} {bottom}")));
        assert!(!is_hollow_text(&format!("{walls} {bottom} {lid}")));
        assert!(!is_hollow_text(walls), "without a bottom");
        let shovel = "(box :size (0.2 0.2 0.01)) (box :size (0.01 0.2 0.1) :at (0.1 0 0.05))
                      (box :size (0.2 0.01 0.1) :at (0 0.1 0.05))
                      (box :size (0.2 0.01 0.1) :at (0 -0.1 0.05))";
        assert!(!is_hollow_text(shovel));
        assert!(!is_hollow_text("(box :size (0.3 0.3 0.01))"));
    }
}
