//! How objects look: a bottle has a neck, a bowl is hollow, a mug has a handle. Types not
//! listed here look as the library describes them, with rings of boxes drawn as vessels.
//!
//! Surfaces without a colour here have that of the object.

use std::sync::Arc;

use super::look::Look;
use super::vessel::{Part, parts_of};
use crate::picture::loft::{Along, Section, lofted, section, tube};
use crate::picture::scene::Finish;
use crate::picture::surface::Surface;
use crate::spatial::{PlacedShape, trig};

/// Greatest width (m) of bevelled edges.
const BEVEL: f64 = 0.006;

/// Linear colours.
const PAPER: [f32; 4] = [0.80, 0.79, 0.74, 1.0];
const LID: [f32; 4] = [0.82, 0.82, 0.80, 1.0];
const DARK: [f32; 4] = [0.03, 0.03, 0.033, 1.0];
const STEEL: [f32; 4] = [0.48, 0.49, 0.50, 1.0];
const SUN: [f32; 4] = [0.80, 0.42, 0.03, 1.0];

/// The looks of an object of this type with these shapes.
pub(crate) fn looks_of(kind: &str, shapes: &[PlacedShape]) -> Vec<Look> {
    match kind {
        "bottle" => bottle(),
        "buttermilk" => buttermilk(),
        "mondamin" => mondamin(),
        "milk" => milk(),
        "cereal" | "breakfast-cereal" => cereal(),
        "mug" => with_handle(shapes, [0.0405, 0.0775], [-0.046, 0.027], 0.0062),
        "cup" => with_handle(shapes, [0.0345, 0.058], [-0.018, 0.026], 0.0042),
        "pot" => pot(shapes),
        "spoon" => spoon(),
        "fork" => fork(),
        "knife" => knife(),
        "spatula" => spatula(),
        "weisswurst" => weisswurst(),
        "cap" => cap(),
        _ => as_described(shapes),
    }
}

/// The shapes themselves, hollow where they form rings.
fn as_described(shapes: &[PlacedShape]) -> Vec<Look> {
    let look = |part| match part {
        Part::Shape(placed) => Look::of_shape(placed, BEVEL, Finish::Gloss),
        Part::Vessel { surface, at } => Look {
            surface: Arc::new(surface),
            at,
            color: None,
            finish: Finish::Gloss,
        },
    };
    parts_of(shapes).into_iter().map(look).collect()
}

/// A surface in the object's own colour.
fn own(surface: Surface) -> Look {
    Look {
        color: None,
        ..Look::of_surface(surface, PAPER, Finish::Gloss)
    }
}

fn painted(surface: Surface, color: [f32; 4]) -> Look {
    Look::of_surface(surface, color, Finish::Gloss)
}

/// A surface of revolution about an upright axis through (x, y).
fn turned(line: &[[f64; 2]], at: [f64; 2], color: Option<[f32; 4]>) -> Look {
    let look = Look::turned(Along::Z, line, at, color.unwrap_or(PAPER));
    Look { color, ..look }
}

/// A flat thing between two heights.
fn slab(along: Along, sections: &[Section], end: f64) -> Surface {
    lofted(along, sections, [end; 2])
}

fn bottle() -> Vec<Look> {
    let middle = [0.0005, -0.0007];
    let body = [
        [0.0, -0.1008],
        [0.0315, -0.1008],
        [0.0350, -0.0985],
        [0.0357, -0.0945],
        [0.0357, 0.0220],
        [0.0350, 0.0310],
        [0.0328, 0.0395],
        [0.0290, 0.0470],
        [0.0235, 0.0530],
        [0.0185, 0.0570],
        [0.0160, 0.0605],
        [0.0152, 0.0640],
        [0.0, 0.0645],
    ];
    let lid = [
        [0.0, 0.0625],
        [0.0170, 0.0625],
        [0.0176, 0.0635],
        [0.0176, 0.0780],
        [0.0166, 0.0800],
        [0.0145, 0.0807],
        [0.0, 0.0807],
    ];
    let label = [
        [0.0352, -0.0800],
        [0.0361, -0.0795],
        [0.0361, -0.0385],
        [0.0352, -0.0380],
    ];
    vec![
        turned(&body, middle, None),
        turned(&lid, middle, Some(LID)),
        turned(&label, middle, Some(PAPER)),
    ]
}

fn buttermilk() -> Vec<Look> {
    let middle = [0.0005, -0.0001];
    let body = [
        [0.0, -0.0792],
        [0.0340, -0.0792],
        [0.0372, -0.0760],
        [0.0374, -0.0700],
        [0.0374, 0.0130],
        [0.0362, 0.0240],
        [0.0325, 0.0360],
        [0.0270, 0.0490],
        [0.0215, 0.0600],
        [0.0195, 0.0680],
        [0.0, 0.0690],
    ];
    let lid = [
        [0.0, 0.0660],
        [0.0210, 0.0660],
        [0.0210, 0.0905],
        [0.0190, 0.0934],
        [0.0, 0.0934],
    ];
    let label = [
        [0.0370, -0.0600],
        [0.0378, -0.0595],
        [0.0378, 0.0055],
        [0.0370, 0.0060],
    ];
    vec![
        turned(&body, middle, None),
        turned(&lid, middle, Some(LID)),
        turned(&label, middle, Some(PAPER)),
    ]
}

/// A flat bottle.
fn mondamin() -> Vec<Look> {
    let body = [
        section(-0.106, [0.044, 0.025], 0.02),
        section(-0.09, [0.0466, 0.027], 0.022),
        section(0.03, [0.0466, 0.027], 0.022),
        section(0.06, [0.0400, 0.026], 0.022),
        section(0.082, [0.0250, 0.023], 0.022),
    ];
    let label = [-0.075, 0.015].map(|z| section(z, [0.0469, 0.0273], 0.022));
    vec![
        own(lofted(Along::Z, &body, [0.004, 0.0])),
        turned(
            &[
                [0.0, 0.080],
                [0.0245, 0.080],
                [0.025, 0.083],
                [0.0235, 0.103],
                [0.0215, 0.106],
                [0.0, 0.106],
            ],
            [0.0; 2],
            Some(LID),
        ),
        painted(lofted(Along::Z, &label, [0.0; 2]), PAPER),
    ]
}

/// A carton with a gable.
fn milk() -> Vec<Look> {
    let middle = [0.0018, -0.0009];
    let carton = |from: f64, to: f64, more: f64| {
        let half = [0.0382 + more, 0.038 + more];
        slab(
            Along::Z,
            &[from, to].map(|z| section(z, half, 0.003).at(middle)),
            0.0,
        )
    };
    let gable = [
        section(0.0925, [0.0382, 0.038], 0.003).at(middle),
        section(0.110, [0.0382, 0.004], 0.002).at(middle),
        section(0.1159, [0.0382, 0.0025], 0.001).at(middle),
    ];
    vec![
        own(carton(-0.1125, 0.0925, 0.0)),
        own(slab(Along::Z, &gable, 0.0)),
        painted(carton(-0.085, 0.02, 0.0005), PAPER),
        turned(
            &[
                [0.0, 0.096],
                [0.0125, 0.096],
                [0.0125, 0.111],
                [0.0115, 0.1125],
                [0.0, 0.1125],
            ],
            [0.0018, -0.019],
            Some(LID),
        ),
    ]
}

/// A box with a picture on it.
fn cereal() -> Vec<Look> {
    let (x, y, z) = (-0.0012, -0.001, 0.0099);
    let carton = [-0.1118, 0.1118].map(|up| section(z + up, [0.0737, 0.029], 0.001).at([x, y]));
    let mut looks = vec![own(slab(Along::Z, &carton, 0.001))];
    let strip = [0.052, 0.088].map(|up| section(z + up, [0.0740, 0.0293], 0.001).at([x, y]));
    looks.push(painted(slab(Along::Z, &strip, 0.0), PAPER));
    for side in [-1.0, 1.0] {
        let face = y + side * 0.0293;
        let (from, to) = (face - 0.0006, face + 0.0006);
        let bowl = [[0.0, from], [0.046, from], [0.046, to], [0.0, to]];
        looks.push(Look::turned(Along::Y, &bowl, [z - 0.03, x], PAPER));
        let (from, to) = (face - 0.0009, face + 0.0009);
        let flakes = [[0.0, from], [0.034, from], [0.034, to], [0.0, to]];
        looks.push(Look::turned(Along::Y, &flakes, [z - 0.03, x], SUN));
    }
    looks
}

/// The vessel that the shapes start with, and a handle in the direction of x between two
/// heights (m) and two distances from the axis (m); boxes that stand for the handle are
/// omitted.
fn with_handle(
    shapes: &[PlacedShape],
    [inner, outer]: [f64; 2],
    [low, high]: [f64; 2],
    radius: f64,
) -> Vec<Look> {
    let mut looks: Vec<Look> = parts_of(shapes)
        .into_iter()
        .filter_map(|part| match part {
            Part::Vessel { surface, at } => Some(Look { at, ..own(surface) }),
            Part::Shape(_) => None,
        })
        .collect();
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let steps = 12;
    let path: Vec<_> = (0..=steps)
        .map(|i| {
            let turn = std::f64::consts::PI * (f64::from(i) / f64::from(steps) - 0.5);
            let (s, c) = trig::sin_cos(turn);
            // Rounder than an ellipse, like a D.
            let out = libm::sqrt(c.max(0.0));
            let at = [
                inner + (outer - inner - radius) * out,
                0.0,
                middle + half * s,
            ];
            (at, radius)
        })
        .collect();
    looks.push(own(tube(&path, [0.0, -1.0, 0.0])));
    looks
}

fn pot(shapes: &[PlacedShape]) -> Vec<Look> {
    let mut looks: Vec<Look> = parts_of(shapes)
        .into_iter()
        .filter_map(|part| match part {
            Part::Vessel { surface, at } => Some(Look { at, ..own(surface) }),
            Part::Shape(_) => None,
        })
        .collect();
    let rim = [
        [0.121, 0.066],
        [0.127, 0.067],
        [0.129, 0.070],
        [0.127, 0.073],
        [0.121, 0.073],
    ];
    looks.push(turned(&rim, [0.0; 2], Some(STEEL)));
    for side in [-1.0, 1.0] {
        let steps = 10;
        let path: Vec<_> = (0..=steps)
            .map(|i| {
                let turn = std::f64::consts::PI * f64::from(i) / f64::from(steps);
                let (s, c) = trig::sin_cos(turn);
                let out = libm::sqrt(s.max(0.0));
                ([0.042 * c, side * (0.116 + 0.066 * out), 0.0575], 0.009)
            })
            .collect();
        looks.push(painted(tube(&path, [0.0, 0.0, -side]), DARK));
    }
    looks
}

/// Lying, its long axis along x.
fn spoon() -> Vec<Look> {
    let handle = [
        section(-0.1105, [0.008, 0.0022], 0.0022),
        section(-0.095, [0.0082, 0.0022], 0.0022),
        section(0.0, [0.0045, 0.0022], 0.0022),
        section(0.056, [0.0040, 0.0024], 0.0024),
    ];
    let steps = 10;
    let scoop: Vec<_> = (0..=steps)
        .map(|i| {
            let turn = std::f64::consts::PI * f64::from(i) / f64::from(steps);
            let (s, c) = trig::sin_cos(turn);
            let wide = (0.022 * s).max(0.002);
            let along = 0.0795 - 0.0265 * c;
            let deep = 0.0022 + 0.0026 * s;
            section(along, [wide, deep], deep).at([0.0, -0.004 * s])
        })
        .collect();
    vec![
        own(lofted(Along::X, &handle, [0.0; 2])),
        own(lofted(Along::X, &scoop, [0.0; 2])),
    ]
}

/// Lying, its long axis along y.
fn fork() -> Vec<Look> {
    // The sections of a body along y are given by z and x.
    let handle = [
        section(-0.0557, [0.002, 0.0075], 0.002),
        section(-0.02, [0.002, 0.0065], 0.002),
        section(0.045, [0.002, 0.0036], 0.002),
        section(0.062, [0.002, 0.0085], 0.002),
        section(0.072, [0.0018, 0.0094], 0.0018),
        section(0.078, [0.0018, 0.0094], 0.0018),
    ];
    let mut looks = vec![own(lofted(Along::Y, &handle, [0.0; 2]))];
    for place in 0..4 {
        let x = -0.0078 + 0.0052 * f64::from(place);
        let tine = [
            section(0.076, [0.0016, 0.0015], 0.0012).at([0.0, x]),
            section(0.1097, [0.0012, 0.0008], 0.0008).at([0.0005, x]),
        ];
        looks.push(own(lofted(Along::Y, &tine, [0.0; 2])));
    }
    looks
}

/// Lying, its long axis along y.
fn knife() -> Vec<Look> {
    let handle = [
        section(-0.0921, [0.0036, 0.0070], 0.0030).at([0.0, 0.0014]),
        section(-0.05, [0.0040, 0.0085], 0.0036).at([0.0, 0.0014]),
        section(-0.004, [0.0034, 0.0070], 0.0030).at([0.0, 0.0014]),
    ];
    let blade = [
        section(-0.006, [0.0012, 0.0068], 0.0010).at([0.0, 0.0014]),
        section(0.04, [0.0011, 0.0090], 0.0010).at([0.0, 0.0014]),
        section(0.07, [0.0010, 0.0075], 0.0010).at([0.0, 0.0022]),
        section(0.0875, [0.0008, 0.0010], 0.0008).at([0.0, 0.0070]),
    ];
    vec![
        own(lofted(Along::Y, &handle, [0.003, 0.0])),
        painted(lofted(Along::Y, &blade, [0.0; 2]), STEEL),
    ]
}

/// Lying, its long axis along x.
fn spatula() -> Vec<Look> {
    let handle = [
        section(-0.1625, [0.011, 0.0065], 0.006).at([0.0, -0.0027]),
        section(-0.08, [0.0120, 0.0075], 0.007).at([0.0, -0.0027]),
        section(0.0, [0.0060, 0.0050], 0.005).at([0.0, -0.0027]),
        section(0.075, [0.0060, 0.0035], 0.0035).at([0.0, -0.0015]),
    ];
    let blade = [
        section(0.070, [0.012, 0.0022], 0.002).at([0.0, 0.0]),
        section(0.090, [0.0235, 0.0020], 0.002).at([0.0, 0.001]),
        section(0.1655, [0.0245, 0.0014], 0.001).at([0.0, 0.004]),
    ];
    vec![
        own(lofted(Along::X, &handle, [0.005, 0.0])),
        own(lofted(Along::X, &blade, [0.0; 2])),
    ]
}

/// Lying, slightly curved.
fn weisswurst() -> Vec<Look> {
    let steps = 14;
    let path: Vec<_> = (0..=steps)
        .map(|i| {
            let along = f64::from(i) / f64::from(steps) * 2.0 - 1.0;
            let bend = 0.0032 - 0.0145 * along * along;
            let end = libm::sqrt((1.0 - libm::pow(along.abs(), 8.0)).max(0.02));
            ([0.0545 * along, bend, 0.0], 0.0158 * end)
        })
        .collect();
    vec![own(tube(&path, [0.0, 0.0, 1.0]))]
}

/// A cap with its peak along -y.
fn cap() -> Vec<Look> {
    let crown = [
        [0.0, 0.0005],
        [0.0436, 0.0005],
        [0.0436, 0.010],
        [0.0420, 0.022],
        [0.0370, 0.033],
        [0.0270, 0.041],
        [0.0130, 0.0442],
        [0.0, 0.0446],
    ];
    let peak = [
        section(-0.075, [0.0020, 0.022], 0.0018).at([0.0045, 0.0]),
        section(-0.064, [0.0022, 0.031], 0.0020).at([0.0060, 0.0]),
        section(-0.035, [0.0022, 0.035], 0.0020).at([0.0080, 0.0]),
        section(-0.010, [0.0022, 0.035], 0.0020).at([0.0080, 0.0]),
    ];
    vec![
        turned(&crown, [0.0, 0.0127], None),
        own(lofted(Along::Y, &peak, [0.0; 2])),
    ]
}

#[cfg(test)]
mod tests {
    use crate::picture::looks::objects::*;
    use crate::world::object_library::{OBJECTS, ObjectLibrary};

    /// Least and greatest coordinates (m) of the corners.
    fn bounds(looks: &[Look]) -> [[f64; 3]; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for look in looks {
            for corner in &look.surface.corners {
                let point = look.at * corner.point;
                for axis in 0..3 {
                    bounds[0][axis] = bounds[0][axis].min(point[axis]);
                    bounds[1][axis] = bounds[1][axis].max(point[axis]);
                }
            }
        }
        bounds
    }

    #[test]
    fn objects_are_as_large_as_what_touches() {
        let library = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp").unwrap();
        for kind in library.types() {
            let shapes: Vec<_> = kind.shapes.iter().collect();
            let plain: Vec<_> = shapes
                .iter()
                .map(|s| Look::of_shape(s, 0.0, Finish::Matt))
                .collect();
            let (seen, touched) = (bounds(&looks_of(&kind.name, &kind.shapes)), bounds(&plain));
            // A cup's handle is only drawn; cutlery is drawn thinner than its boxes.
            let most = if kind.name == "cup" { 0.022 } else { 0.012 };
            for axis in 0..3 {
                let low = seen[0][axis] - touched[0][axis];
                let high = touched[1][axis] - seen[1][axis];
                let fits = |gap: f64| (-most..0.012).contains(&gap);
                assert!(
                    fits(low) && fits(high),
                    "{} along {axis}: {low:.4} {high:.4}",
                    kind.name
                );
            }
        }
    }
}
