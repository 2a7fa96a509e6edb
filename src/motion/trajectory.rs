//! Trajectories: timed motions along a path.
//!
//! A path is a polyline of points with one number per axis (rad or m). Every leg is
//! traversed at constant speed, the highest that all limits allow, so all axes arrive
//! together; the resulting piecewise linear motion is then averaged over two sliding windows.
//! Properties of the result:
//! - it starts and ends at rest, exactly at the first and the last point;
//! - position, velocity and acceleration are continuous (the jerk is bounded);
//! - velocities are averages of the legs' velocities and so never exceed a limit;
//! - accelerations are differences of legs' velocities divided by the first window, which
//!   is made long enough for the acceleration limits;
//! - it cuts corners of the polyline on the inside, unless it stops there.
//!
//! A continuous joint is an axis like any other: the caller unwinds its values first.
//! Nothing here knows of robots or collisions.

use std::ops::Range;

/// Limits that apply to some neighbouring axes together: to the Euclidean norms of their
/// velocities and accelerations. A single joint is a group of one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AxisGroup {
    /// The axes of the group.
    pub(crate) axes: Range<usize>,
    /// Greatest speed (rad/s or m/s), positive.
    pub(crate) velocity: f64,
    /// Greatest acceleration (rad/s² or m/s²), positive.
    pub(crate) acceleration: f64,
}

impl AxisGroup {
    /// The limits of a single axis.
    pub(crate) fn single(axis: usize, velocity: f64, acceleration: f64) -> Self {
        Self {
            axes: axis..axis + 1,
            velocity,
            acceleration,
        }
    }

    /// Norm of the group's part of a vector.
    fn norm(&self, vector: impl Fn(usize) -> f64) -> f64 {
        self.axes
            .clone()
            .map(|a| vector(a) * vector(a))
            .sum::<f64>()
            .sqrt()
    }
}

/// What a trajectory does at the corners of its path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Corners {
    /// Rounds them: faster and smoother, but cuts inside the polyline.
    Round,
    /// Stops at them: never leaves the polyline.
    Stop,
}

/// Length of the second window, which bounds the jerk, relative to the first.
const JERK_WINDOW: f64 = 0.5;
/// Legs that would take less time than this (s) are dropped.
const SHORTEST_LEG: f64 = 1e-9;

/// One timed leg of the path, before averaging.
#[derive(Clone, Debug, PartialEq)]
struct Leg {
    start: f64,
    end: f64,
    velocity: Vec<f64>,
}

/// A timed motion along a path within limits; see the module documentation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Trajectory {
    first: Vec<f64>,
    last: Vec<f64>,
    legs: Vec<Leg>,
    /// Lengths of the two averaging windows (s); zero if there is no motion.
    windows: [f64; 2],
    duration: f64,
}

impl Trajectory {
    /// The fastest motion of this kind along the points; all have as many numbers as the first,
    /// and missing ones mean that the axis does not move. An empty path is a motion of no axis.
    pub(crate) fn new(points: &[Vec<f64>], limits: &[AxisGroup], corners: Corners) -> Self {
        let first = points.first().cloned().unwrap_or_default();
        let last = points.last().cloned().unwrap_or_default();
        let mut at_rest = Self {
            first,
            last,
            legs: Vec::new(),
            windows: [0.0; 2],
            duration: 0.0,
        };

        let moves: Vec<(Vec<f64>, f64)> = points
            .windows(2)
            .map(|pair| displacement(&pair[0], &pair[1]))
            .map(|step| {
                let time = limits.iter().map(|g| g.norm(|a| at(&step, a)) / g.velocity);
                let time = time.fold(0.0, f64::max);
                (step, time)
            })
            .filter(|(_, time)| *time > SHORTEST_LEG)
            .collect();
        if moves.is_empty() {
            return at_rest;
        }

        // At full speed the legs take `base` and the first window must have length `ramp`;
        // both scale with the speed, in opposite directions.
        let speeds: Vec<Vec<f64>> = moves
            .iter()
            .map(|(s, t)| s.iter().map(|d| d / t).collect())
            .collect();
        let ramp = longest_ramp(&speeds, limits, corners);
        let stops = match corners {
            Corners::Round => 1.0,
            Corners::Stop => moves.len() as f64,
        };
        let base: f64 = moves.iter().map(|(_, t)| t).sum();
        let scale = (base / (stops * ramp * (1.0 + JERK_WINDOW)))
            .sqrt()
            .min(1.0);
        let windows = [ramp * scale, ramp * scale * JERK_WINDOW];
        let pause = match corners {
            Corners::Round => 0.0,
            Corners::Stop => windows[0] + windows[1],
        };

        let mut now = 0.0;
        for ((_, time), speed) in moves.iter().zip(speeds) {
            let end = now + time / scale;
            let velocity = speed.iter().map(|v| v * scale).collect();
            at_rest.legs.push(Leg {
                start: now,
                end,
                velocity,
            });
            now = end + pause;
        }
        at_rest.duration = now - pause + windows[0] + windows[1];
        at_rest.windows = windows;
        at_rest
    }

    /// How long the motion takes (s).
    pub(crate) fn duration(&self) -> f64 {
        self.duration
    }

    /// The point where the motion ends.
    pub(crate) fn last(&self) -> &[f64] {
        &self.last
    }

    /// Positions `t` seconds after the start: the first point before it, the last after the end.
    pub(crate) fn position(&self, t: f64) -> Vec<f64> {
        if t <= 0.0 {
            return self.first.clone();
        }
        if t >= self.duration {
            return self.last.clone();
        }
        self.blend(&self.first, t, ramp_integral)
    }

    /// Velocities `t` seconds after the start; zero before the start and after the end.
    #[cfg(test)]
    pub(crate) fn velocity(&self, t: f64) -> Vec<f64> {
        let zero = vec![0.0; self.first.len()];
        if t <= 0.0 || t >= self.duration {
            zero
        } else {
            self.blend(&zero, t, step_integral)
        }
    }

    /// Sum over the legs of velocity × (response since the leg's start − response since its end).
    fn blend(&self, from: &[f64], t: f64, response: fn(f64, [f64; 2]) -> f64) -> Vec<f64> {
        let mut sum = from.to_vec();
        for leg in self.legs.iter().take_while(|leg| leg.start < t) {
            let since_start = response(t - leg.start, self.windows);
            let since_end = response(t - leg.end, self.windows);
            for (value, velocity) in sum.iter_mut().zip(&leg.velocity) {
                *value += velocity * (since_start - since_end);
            }
        }
        sum
    }
}

/// An element of a vector, 0 beyond its end.
fn at(vector: &[f64], axis: usize) -> f64 {
    vector.get(axis).copied().unwrap_or(0.0)
}

fn displacement(from: &[f64], to: &[f64]) -> Vec<f64> {
    from.iter().zip(to).map(|(a, b)| b - a).collect()
}

/// The time (s) needed to change from any of the speeds, or rest, to any other.
fn longest_ramp(speeds: &[Vec<f64>], limits: &[AxisGroup], corners: Corners) -> f64 {
    let mut longest = 0.0_f64;
    for group in limits {
        for (i, a) in speeds.iter().enumerate() {
            longest = longest.max(group.norm(|x| at(a, x)) / group.acceleration);
            if corners == Corners::Stop {
                continue;
            }
            for b in &speeds[..i] {
                let change = group.norm(|x| at(a, x) - at(b, x));
                longest = longest.max(change / group.acceleration);
            }
        }
    }
    longest
}

/// A unit step at 0, averaged over both windows: the integral of the averaged impulse.
#[cfg(test)]
fn step_integral(t: f64, [a, b]: [f64; 2]) -> f64 {
    if t >= a + b {
        return 1.0;
    }
    let square = |t: f64| if t > 0.0 { t * t / 2.0 } else { 0.0 };
    (square(t) - square(t - a) - square(t - b) + square(t - a - b)) / (a * b)
}

/// A unit ramp that starts at 0, averaged over both windows.
fn ramp_integral(t: f64, [a, b]: [f64; 2]) -> f64 {
    if t >= a + b {
        return t - (a + b) / 2.0;
    }
    let cube = |t: f64| if t > 0.0 { t * t * t / 6.0 } else { 0.0 };
    (cube(t) - cube(t - a) - cube(t - b) + cube(t - a - b)) / (a * b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn one_axis(velocity: f64, acceleration: f64) -> Vec<AxisGroup> {
        vec![AxisGroup::single(0, velocity, acceleration)]
    }

    #[test]
    fn a_path_of_one_point_takes_no_time() {
        let t = Trajectory::new(&[vec![1.0]], &one_axis(1.0, 1.0), Corners::Round);
        assert_eq!((t.duration(), t.position(0.5)), (0.0, vec![1.0]));
    }

    #[test]
    fn a_long_leg_is_driven_at_the_speed_limit() {
        let t = Trajectory::new(
            &[vec![0.0], vec![10.0]],
            &one_axis(2.0, 4.0),
            Corners::Round,
        );
        // 5 s at full speed, 0.5 s of ramp and half of that for the jerk.
        assert!((t.duration() - 5.75).abs() < 1e-12);
        assert!((t.velocity(t.duration() / 2.0)[0] - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_short_leg_does_not_wait_for_a_speed_it_never_reaches() {
        let t = Trajectory::new(
            &[vec![0.0], vec![0.01]],
            &one_axis(1.0, 1.0),
            Corners::Round,
        );
        assert!(t.duration() < 0.25, "{}", t.duration());
    }

    #[test]
    fn stopping_in_corners_touches_every_point() {
        let points = [vec![0.0, 0.0], vec![1.0, 0.0], vec![1.0, 1.0]];
        let limits = [AxisGroup {
            axes: 0..2,
            velocity: 1.0,
            acceleration: 1.0,
        }];
        let nearest = |corners| {
            let t = Trajectory::new(&points, &limits, corners);
            (0..=2000)
                .map(|i| t.position(t.duration() * f64::from(i) / 2000.0))
                .map(|p| (p[0] - 1.0).hypot(p[1]))
                .fold(f64::MAX, f64::min)
        };
        assert!(nearest(Corners::Stop) < 1e-9);
        assert!(nearest(Corners::Round) > 0.01);
    }

    fn paths() -> impl Strategy<Value = Vec<Vec<f64>>> {
        prop::collection::vec(prop::collection::vec(-3.0..3.0, 3), 2..8)
    }

    proptest! {
        #[test]
        fn limits_hold_and_acceleration_is_continuous(
            points in paths(), stop in any::<bool>(),
            velocity in 0.1..3.0, acceleration in 0.1..5.0,
        ) {
            let limits = [
                AxisGroup { axes: 0..2, velocity, acceleration },
                AxisGroup::single(2, 1.0, 2.0),
            ];
            let corners = if stop { Corners::Stop } else { Corners::Round };
            let t = Trajectory::new(&points, &limits, corners);
            prop_assert_eq!(&t.position(0.0), &points[0]);
            prop_assert_eq!(&t.position(t.duration()), &points[points.len() - 1]);
            // Just before the end the sum must already be at the last point: no jump onto it.
            for (a, b) in t.position(t.duration() * (1.0 - 1e-12)).iter().zip(t.last()) {
                prop_assert!((a - b).abs() < 1e-8);
            }

            let h = t.duration() / 4000.0;
            let velocity = |i: i32| t.velocity(f64::from(i) * h);
            let mut before: Option<Vec<f64>> = None;
            for i in 0..4000 {
                let (v, next) = (velocity(i), velocity(i + 1));
                let a: Vec<f64> = v.iter().zip(&next).map(|(v, n)| (n - v) / h).collect();
                for g in &limits {
                    prop_assert!(g.norm(|x| v[x]) <= g.velocity * (1.0 + 1e-9));
                    prop_assert!(g.norm(|x| a[x]) <= g.acceleration * (1.0 + 1e-6));
                    if let Some(b) = &before {
                        // The largest change within h that the jerk window allows.
                        let jerk = 2.0 * g.acceleration / t.windows[1];
                        prop_assert!(g.norm(|x| a[x] - b[x]) <= jerk * h * (1.0 + 1e-6) + 1e-6);
                    }
                }
                before = Some(a);
            }
        }
    }
}
