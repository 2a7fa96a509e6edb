//! Paths with rounded corners: the geometry of a trajectory.
//!
//! The legs of a polyline are straight. A corner is replaced by a parabola that begins and ends
//! on its two legs, at the same distance from it and in their directions, so that the direction is
//! continuous and can be followed without stopping. The parabola is as long as full speed
//! requires, or shorter if the legs are, or if something is in the way of it; if even a short one
//! is blocked, the motion stops at the corner.
//!
//! The length of a path is measured in seconds at full speed: no axis may move faster than with
//! one unit of length per second.

use super::axis_group::AxisGroup;

/// Legs that are shorter than this (s) are dropped.
const MIN_LEG: f64 = 1e-9;
/// Half of a parabola has at least this length (s).
const MIN_HALF: f64 = 1e-4;
/// A corner whose parabola could be shorter than this (s) is none.
const STRAIGHT: f64 = 1e-9;
/// How many times a parabola in the way of which there is something is halved.
const HALVINGS: u32 = 4;
/// Distance (s) of the points of a parabola that are checked.
const CHECK_EVERY: f64 = 0.005;
/// A parabola that stays this close (rad or m) to its corner is not checked.
const UNCHECKED: f64 = 2e-4;

/// Tells whether a point of a path may be taken.
pub(super) type IsFree<'a> = dyn FnMut(&[f64]) -> bool + 'a;

/// A piece of a path, with constant curvature. Vectors have one number per axis (rad or m).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    /// Where the piece begins.
    start: Vec<f64>,
    /// Its direction there: the derivative by the length.
    direction: Vec<f64>,
    /// The second derivative by the length; empty if the piece is straight.
    curvature: Vec<f64>,
    /// Its length (s), positive.
    pub(super) length: f64,
    /// Whether a motion has to stop at its end.
    pub(super) stops: bool,
}

impl Piece {
    /// The point at a distance (s) from the start.
    pub(super) fn point(&self, along: f64) -> Vec<f64> {
        let mut point = self.start.clone();
        for (x, direction) in point.iter_mut().zip(&self.direction) {
            *x += direction * along;
        }
        for (x, curvature) in point.iter_mut().zip(&self.curvature) {
            *x += curvature * along * along / 2.0;
        }
        point
    }

    /// The direction at a distance (s) from the start.
    pub(super) fn direction(&self, along: f64) -> Vec<f64> {
        let mut direction = self.direction.clone();
        for (x, curvature) in direction.iter_mut().zip(&self.curvature) {
            *x += curvature * along;
        }
        direction
    }

    /// The second derivative by the length; empty if the piece is straight.
    pub(super) fn curvature(&self) -> &[f64] {
        &self.curvature
    }
}

/// A straight leg of a polyline.
struct Leg {
    start: Vec<f64>,
    direction: Vec<f64>,
    length: f64,
}

/// The path along the points. At corners the motion stops, unless there is a check, `is_free`:
/// then they are rounded where the points of the parabola pass it.
pub(super) fn rounded_path(
    points: &[Vec<f64>],
    limits: &[AxisGroup],
    mut is_free: Option<&mut IsFree<'_>>,
) -> Vec<Piece> {
    let legs = legs(points, limits);
    let mut pieces = Vec::new();
    let mut begun = 0.0;
    for (i, leg) in legs.iter().enumerate() {
        let corner = legs
            .get(i + 1)
            .map(|next| corner(leg, next, limits, &mut is_free));
        let (cut, parabola) = match &corner {
            Some(Corner::Parabola(piece)) => (piece.length / 2.0, Some(piece.clone())),
            _ => (0.0, None),
        };
        let length = leg.length - begun - cut;
        if length > MIN_LEG {
            let mut piece = Piece {
                start: leg.start.clone(),
                direction: leg.direction.clone(),
                curvature: Vec::new(),
                length,
                stops: matches!(corner, Some(Corner::Stop)),
            };
            piece.start = piece.point(begun);
            pieces.push(piece);
        }
        pieces.extend(parabola);
        begun = cut;
    }
    pieces
}

/// The legs between the points, without those that have no length.
fn legs(points: &[Vec<f64>], limits: &[AxisGroup]) -> Vec<Leg> {
    let mut legs: Vec<Leg> = Vec::new();
    let Some((mut start, rest)) = points.split_first() else {
        return legs;
    };
    for end in rest {
        let way: Vec<f64> = start.iter().zip(end).map(|(a, b)| b - a).collect();
        let length = limits
            .iter()
            .map(|group| group.norm(&way) / group.velocity)
            .fold(0.0, f64::max);
        if length > MIN_LEG {
            legs.push(Leg {
                start: start.clone(),
                direction: way.iter().map(|x| x / length).collect(),
                length,
            });
            start = end;
        }
    }
    legs
}

/// What to do between two legs.
enum Corner {
    /// Nothing: the second leg continues the first.
    None,
    /// Follow this piece.
    Parabola(Piece),
    /// Stop.
    Stop,
}

fn corner(
    leg: &Leg,
    next: &Leg,
    limits: &[AxisGroup],
    is_free: &mut Option<&mut IsFree<'_>>,
) -> Corner {
    let turn: Vec<f64> = (leg.direction.iter().zip(&next.direction))
        .map(|(a, b)| b - a)
        .collect();
    // Full speed along a parabola of length 2 d takes an acceleration of turn / (2 d).
    let wanted = limits
        .iter()
        .map(|group| group.norm(&turn) / (2.0 * group.acceleration))
        .fold(0.0, f64::max);
    if wanted < STRAIGHT {
        return Corner::None;
    }
    let Some(is_free) = is_free else {
        return Corner::Stop;
    };
    let longest = leg.length.min(next.length) / 2.0;
    let mut half = wanted.max(MIN_HALF).min(longest);
    let widest = turn.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for _ in 0..=HALVINGS {
        let piece = parabola(leg, &turn, half);
        if widest * half / 4.0 < UNCHECKED || is_piece_free(&piece, is_free) {
            return Corner::Parabola(piece);
        }
        half /= 2.0;
    }
    Corner::Stop
}

/// The parabola that begins and ends that far (s) from the end of the leg.
fn parabola(leg: &Leg, turn: &[f64], half: f64) -> Piece {
    let from_start = leg.length - half;
    Piece {
        start: (leg.start.iter().zip(&leg.direction))
            .map(|(x, direction)| x + direction * from_start)
            .collect(),
        direction: leg.direction.clone(),
        curvature: turn.iter().map(|x| x / (2.0 * half)).collect(),
        length: 2.0 * half,
        stops: false,
    }
}

fn is_piece_free(piece: &Piece, is_free: &mut IsFree<'_>) -> bool {
    // The cast saturates, and the length is that of a motion.
    let parts = (piece.length / CHECK_EVERY).ceil().max(2.0) as u32;
    (1..parts).all(|i| is_free(&piece.point(piece.length * f64::from(i) / f64::from(parts))))
}
