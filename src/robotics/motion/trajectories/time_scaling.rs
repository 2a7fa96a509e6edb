//! The fastest motion along a path under limits of velocity and acceleration.
//!
//! The method is that of Pham and Pham, "A new approach to time-optimal path parameterization
//! based on reachability analysis" (IEEE Transactions on Robotics, 2018). With `x` for the square
//! of the path velocity and `u` for the path acceleration, the axes move with velocities `q' √x`
//! and accelerations `q' u + q'' x`, and `x` grows by `2 u Δ` over an interval of length `Δ` with
//! constant `u`. A pass backwards finds the greatest `x` at each node from which the end can be
//! reached within the limits; a pass forwards accelerates as much as these allow. On pieces
//! whose `q''` is constant, limits that hold at both ends of an interval hold inside it.

use super::axis_group::AxisGroup;
use super::rounded_path::Piece;

/// Length (s) of an interval, unless a piece gets fewer or more intervals than these.
const INTERVAL: f64 = 0.01;
const STRAIGHT_INTERVALS: (f64, f64) = (2.0, 200.0);
const CURVED_INTERVALS: (f64, f64) = (4.0, 16.0);
/// Number of bisections of the greatest `x`; the result is the lower bound.
const BISECTIONS: u32 = 26;
/// An interval that takes longer than this (s) at less than this share of the top speed is one
/// at both ends of which the motion all but stops.
const HALTING: (f64, f64) = (1.0, 0.01);
/// A limit that does not depend on `u`: `q'` is 0.
const INDEPENDENT: f64 = 1e-18;

/// An interval of a path, with the speed of a motion along it.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    /// Number of the piece.
    pub(super) piece: usize,
    /// Where in the piece it begins (s).
    pub(super) along: f64,
    /// How long it is (s).
    pub(super) length: f64,
    /// Path velocities at its ends.
    pub(super) speeds: [f64; 2],
    /// Whether the motion stops at the end to start anew.
    pub(super) stops: bool,
}

impl Stretch {
    /// The time (s) that the motion takes on it.
    pub(super) fn duration(&self) -> f64 {
        2.0 * self.length / (self.speeds[0] + self.speeds[1])
    }

    /// The distance (s) from its start after that time (s).
    pub(super) fn travelled(&self, time: f64) -> f64 {
        let [from, to] = self.speeds;
        let acceleration = (to * to - from * from) / (2.0 * self.length);
        (time * (from + acceleration * time / 2.0)).clamp(0.0, self.length)
    }
}

/// A limit of acceleration, `a u² + 2 b u x + c x² ≤ 1`.
#[derive(Clone, Copy)]
struct Bound {
    a: f64,
    b: f64,
    c: f64,
}

/// An interval before its speeds are known.
struct Interval {
    piece: usize,
    along: f64,
    length: f64,
    bounds: Vec<Bound>,
    /// Greatest `x` at its ends.
    most: [f64; 2],
    stops: bool,
}

impl Interval {
    fn new(
        number: usize,
        piece: &Piece,
        along: f64,
        length: f64,
        stops: bool,
        limits: &[AxisGroup],
    ) -> Self {
        let curvature = piece.curvature();
        let mut bounds = Vec::new();
        let mut most = [f64::INFINITY; 2];
        for (end, at) in [along, along + length].into_iter().enumerate() {
            let direction = piece.direction(at);
            for group in limits {
                let square = group.dot(&direction, &direction);
                most[end] = most[end].min(group.velocity * group.velocity / square);
                if end == 1 && curvature.is_empty() {
                    continue;
                }
                // At the end x has grown: q' u + q'' (x + 2 u Δ).
                let with = if end == 0 { 0.0 } else { 2.0 * length };
                let grown: Vec<f64> = if curvature.is_empty() {
                    direction.clone()
                } else {
                    (direction.iter().zip(curvature))
                        .map(|(d, c)| d + with * c)
                        .collect()
                };
                let scale = 1.0 / (group.acceleration * group.acceleration);
                bounds.push(Bound {
                    a: group.dot(&grown, &grown) * scale,
                    b: group.dot(&grown, curvature) * scale,
                    c: group.dot(curvature, curvature) * scale,
                });
            }
        }
        Self {
            piece: number,
            along,
            length,
            bounds,
            most,
            stops,
        }
    }

    /// Least and greatest `u` at that `x` within the limits of acceleration, if there are any.
    fn range(&self, x: f64) -> Option<(f64, f64)> {
        let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
        for Bound { a, b, c } in &self.bounds {
            let rest = c * x * x - 1.0;
            if *a < INDEPENDENT {
                if rest > 0.0 {
                    return None;
                }
                continue;
            }
            let root = (b * x) * (b * x) - a * rest;
            if root < 0.0 {
                return None;
            }
            let root = root.sqrt();
            least = least.max((-b * x - root) / a);
            most = most.min((-b * x + root) / a);
        }
        (least <= most).then_some((least, most))
    }

    /// An `x` for the middle of the interval that can be reached from rest and left to rest: half
    /// of what each kind of acceleration permits, so that their sum is within the limits.
    fn between_halts(&self) -> f64 {
        let mut most = self.most[0].min(self.most[1]);
        for Bound { a, c, .. } in &self.bounds {
            if *a >= INDEPENDENT {
                most = most.min(self.length / a.sqrt() / 2.0);
            }
            if *c > 0.0 {
                most = most.min(0.5 / c.sqrt());
            }
        }
        most
    }

    /// The stretches of a motion on it from one path velocity to another.
    fn stretches(&self, [from, to]: [f64; 2]) -> Vec<Stretch> {
        let stretch = |along: f64, length: f64, speeds, stops| Stretch {
            piece: self.piece,
            along,
            length,
            speeds,
            stops,
        };
        let whole = stretch(self.along, self.length, [from, to], self.stops);
        let (time, speed) = HALTING;
        let middle = self.between_halts().sqrt();
        let halts = from + to < 2.0 * speed && whole.duration() > time && middle > from.max(to);
        if !halts {
            return vec![whole];
        }
        let half = self.length / 2.0;
        vec![
            stretch(self.along, half, [from, middle], false),
            stretch(self.along + half, half, [middle, to], self.stops),
        ]
    }

    /// Whether the motion can go on from `x` at the start to at most `end` at the end.
    fn continues(&self, x: f64, end: f64) -> bool {
        self.range(x).is_some_and(|(least, most)| {
            let least = least.max(-x / (2.0 * self.length));
            least <= most.min((end - x) / (2.0 * self.length))
        })
    }

    /// The greatest `x` up to `most` from which the motion can go on to at most `end`.
    fn greatest(&self, most: f64, end: f64) -> f64 {
        if self.continues(most, end) {
            return most;
        }
        // Those from which it can are an interval that begins at 0.
        let (mut can, mut cannot) = (0.0, most);
        for _ in 0..BISECTIONS {
            let middle = (can + cannot) / 2.0;
            if self.continues(middle, end) {
                can = middle;
            } else {
                cannot = middle;
            }
        }
        can
    }
}

/// The fastest motion along the pieces from rest to rest.
pub(super) fn fastest(pieces: &[Piece], limits: &[AxisGroup]) -> Vec<Stretch> {
    let intervals = intervals(pieces, limits);
    let count = intervals.len();
    // The greatest x at each node: the end of the interval before it and the start of the next.
    let mut most = vec![0.0_f64; count + 1];
    for i in (0..count).rev() {
        let interval = &intervals[i];
        let before = i.checked_sub(1).map(|j| &intervals[j]);
        let cap = match before {
            Some(before) if !before.stops => before.most[1].min(interval.most[0]),
            _ => 0.0,
        };
        most[i] = interval.greatest(cap, most[i + 1].min(interval.most[1]));
    }
    let mut x = 0.0_f64;
    let mut stretches = Vec::with_capacity(count);
    for (interval, end) in intervals.into_iter().zip(&most[1..]) {
        let grown = 2.0 * interval.length;
        let u = interval.range(x).map_or(0.0, |(_, most)| most);
        let next = (x + grown * u).clamp(0.0, end.min(interval.most[1]));
        stretches.extend(interval.stretches([x.sqrt(), next.sqrt()]));
        x = next;
    }
    stretches
}

fn intervals(pieces: &[Piece], limits: &[AxisGroup]) -> Vec<Interval> {
    let mut intervals = Vec::new();
    for (number, piece) in pieces.iter().enumerate() {
        let (least, most) = if piece.curvature().is_empty() {
            STRAIGHT_INTERVALS
        } else {
            CURVED_INTERVALS
        };
        let count = (piece.length / INTERVAL).ceil().clamp(least, most);
        let length = piece.length / count;
        // The count has been clamped to a small number.
        let count = count as u32;
        for i in 0..count {
            let along = f64::from(i) * length;
            let stops = piece.stops && i + 1 == count;
            intervals.push(Interval::new(number, piece, along, length, stops, limits));
        }
    }
    intervals
}
