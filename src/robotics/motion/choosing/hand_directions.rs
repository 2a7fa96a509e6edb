//! The directions from which a hand may come to an object.

use std::f64::consts::{FRAC_PI_4, PI};

use nalgebra::{Matrix3, Vector3};

use spatial::trig;

/// How far (m) the hand approaches and lifts.
pub(super) const AWAY: f64 = 0.15;

/// A direction from which a hand comes, with the axis along which its fingers close.
pub(super) struct Direction {
    pub(super) name: &'static str,
    /// Whether it comes from above.
    pub(super) is_top: bool,
    /// The axes of the hand in the frame of the object: closing, up, ahead.
    pub(super) axes: Matrix3<f64>,
    /// Where it comes from, as in definitions of grasps (m).
    pub(super) pregrasp: [f64; 3],
    pub(super) second_pregrasp: [f64; 3],
}

/// The names of the sides, counter-clockwise from +x: straight, from above, and over a rim.
const SIDES: [[&str; 3]; 8] = [
    ["front", "front-above", "front-rim"],
    ["front-left", "front-left-above", "front-left-rim"],
    ["left-side", "left-side-above", "left-side-rim"],
    ["back-left", "back-left-above", "back-left-rim"],
    ["back", "back-above", "back-rim"],
    ["back-right", "back-right-above", "back-right-rim"],
    ["right-side", "right-side-above", "right-side-rim"],
    ["front-right", "front-right-above", "front-right-rim"],
];

/// All directions that are tried; around a round object, which is grasped from all sides as from one, those
/// from one side.
pub(super) fn directions(is_round: bool) -> Vec<Direction> {
    let mut all = Vec::new();
    let down = -Vector3::z();
    for turn in 0..if is_round { 1 } else { 8 } {
        let (sine, cosine) = trig::sin_cos(f64::from(turn) * PI / 8.0);
        let closing = Vector3::new(sine, cosine, 0.0);
        all.push(Direction {
            name: "top",
            is_top: true,
            axes: Matrix3::from_columns(&[closing, down.cross(&closing), down]),
            pregrasp: [0.0, 0.0, AWAY],
            second_pregrasp: [0.0, 0.0, AWAY],
        });
    }
    let count = if is_round { 1 } else { SIDES.len() };
    for (side, names) in SIDES.iter().take(count).enumerate() {
        let (sine, cosine) = trig::sin_cos(side as f64 * FRAC_PI_4);
        let out = Vector3::new(cosine, sine, 0.0);
        let closing = Vector3::new(sine, -cosine, 0.0);
        let away = out * AWAY;
        all.push(Direction {
            name: names[0],
            is_top: false,
            axes: Matrix3::from_columns(&[closing, Vector3::z(), -out]),
            pregrasp: [away.x, away.y, AWAY],
            second_pregrasp: away.into(),
        });
        let ahead = (down - out).normalize();
        let away = -ahead * AWAY;
        all.push(Direction {
            name: names[1],
            is_top: false,
            axes: Matrix3::from_columns(&[closing, ahead.cross(&closing), ahead]),
            pregrasp: away.into(),
            second_pregrasp: away.into(),
        });
        // One finger over the rim and one under it, 60 degrees off the vertical.
        let ahead = (down - out * 3_f64.sqrt()).normalize();
        let closing = (out - Vector3::z() * 3_f64.sqrt()).normalize();
        let away = -ahead * AWAY;
        all.push(Direction {
            name: names[2],
            is_top: false,
            axes: Matrix3::from_columns(&[closing, ahead.cross(&closing), ahead]),
            pregrasp: away.into(),
            second_pregrasp: away.into(),
        });
    }
    all
}
