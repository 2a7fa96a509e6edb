//! Trajectories: timed motions along a path.
//!
//! A path is a polyline of points with one number per axis (rad or m). Its corners are rounded
//! or stopped at ([`rounded_path`]), and the fastest motion within the limits along it is found
//! ([`time_scaling`](super::time_scaling)). That motion is sampled, and the polyline of the samples
//! is averaged over two sliding windows of time. Properties of the result:
//! - it starts and ends at rest, exactly at the first and the last point;
//! - position, velocity and acceleration are continuous (the jerk is bounded);
//! - velocities and accelerations are averages of those of the fastest motion, and so never
//!   exceed a limit;
//! - it stays within a millimetre or two of its path, and within none of a point where it stops.
//!
//! A continuous joint is an axis like any other: the caller unwinds its values first.
//! Nothing here knows of robots or collisions.

use super::axis_group::AxisGroup;
use super::rounded_path::{IsFree, Piece, rounded_path};
use super::time_scaling::{Stretch, fastest};

/// Greatest time (s) between two samples, and length of the first window.
const SAMPLE: f64 = 1.0 / 60.0;
/// Length (s) of the second window, which bounds the jerk.
const JERK_WINDOW: f64 = 0.06;

/// A timed motion along a path within limits; see the module documentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    limits: Vec<AxisGroup>,
    first: Vec<f64>,
    last: Vec<f64>,
    /// Points of the motion before averaging, each the same time after the one before it.
    samples: Vec<Vec<f64>>,
    /// Lengths of the two averaging windows (s). The first is the time between two samples.
    windows: [f64; 2],
    duration: f64,
}

impl Trajectory {
    /// The fastest motion along the points that stops at all corners, so that it never leaves the
    /// polyline. All points have as many numbers as the first, and missing ones mean that the axis
    /// does not move. An empty path is a motion of no axis.
    pub fn new(points: &[Vec<f64>], limits: &[AxisGroup]) -> Self {
        Self::along(points, limits, None)
    }

    /// As [`Self::new`], but with corners rounded where `is_free` accepts the points beside them.
    pub fn rounded(points: &[Vec<f64>], limits: &[AxisGroup], is_free: &mut IsFree<'_>) -> Self {
        Self::along(points, limits, Some(is_free))
    }

    fn along(points: &[Vec<f64>], limits: &[AxisGroup], is_free: Option<&mut IsFree<'_>>) -> Self {
        let pieces = rounded_path(points, limits, is_free);
        let stretches = fastest(&pieces, limits);
        // The averaged motion reaches a stop when both windows lie between samples in the pause.
        let pause = 3.0 * SAMPLE + JERK_WINDOW;
        let (samples, step) = samples(&pieces, &stretches, pause);
        Self {
            first: points.first().cloned().unwrap_or_default(),
            last: points.last().cloned().unwrap_or_default(),
            ..Self::through(samples, step, limits)
        }
    }

    /// A motion through points at equal times (s), which keeps limits of velocity by itself. The limits are those
    /// of braking.
    pub(super) fn through(points: Vec<Vec<f64>>, step: f64, limits: &[AxisGroup]) -> Self {
        let windows = [step, JERK_WINDOW];
        let duration = match points.len().checked_sub(1) {
            // There are far fewer points than an f64 can count.
            Some(count) => step * count as f64 + windows[0] + windows[1],
            None => 0.0,
        };
        Self {
            limits: limits.to_vec(),
            first: points.first().cloned().unwrap_or_default(),
            last: points.last().cloned().unwrap_or_default(),
            samples: points,
            windows,
            duration,
        }
    }

    /// How long the motion takes (s).
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The point where the motion ends.
    pub fn last(&self) -> &[f64] {
        &self.last
    }

    /// The limits that the motion keeps.
    pub(super) fn limits(&self) -> &[AxisGroup] {
        &self.limits
    }

    /// Positions `t` seconds after the start: the first point before it, the last after the end.
    pub fn position(&self, t: f64) -> Vec<f64> {
        if t <= 0.0 {
            return self.first.clone();
        }
        if t >= self.duration {
            return self.last.clone();
        }
        let complete = self.legs_in_window(t).start;
        let from = self.samples.get(complete).unwrap_or(&self.first).clone();
        self.blend(from, t, ramp_integral)
    }

    /// Velocities `t` seconds after the start; zero before the start and after the end.
    pub(super) fn velocity(&self, t: f64) -> Vec<f64> {
        self.blend(vec![0.0; self.first.len()], t, step_integral)
    }

    /// Accelerations `t` seconds after the start; zero before the start and after the end.
    pub(super) fn acceleration(&self, t: f64) -> Vec<f64> {
        self.blend(vec![0.0; self.first.len()], t, impulse_integral)
    }

    /// Numbers of the legs between samples that begin before `t` and have an influence then.
    fn legs_in_window(&self, t: f64) -> std::ops::Range<usize> {
        let [step, window] = self.windows;
        let count = self.samples.len().saturating_sub(1);
        // The casts saturate at 0.
        let begun = ((t / step).ceil() as usize).min(count);
        let complete = ((t - step - window) / step).floor() as usize;
        complete.min(begun)..begun
    }

    /// Sum over the legs between samples of velocity × (response since the leg's start − response
    /// since its end).
    fn blend(&self, from: Vec<f64>, t: f64, response: fn(f64, [f64; 2]) -> f64) -> Vec<f64> {
        let mut sum = from;
        if t <= 0.0 || t >= self.duration {
            return sum;
        }
        let step = self.windows[0];
        for leg in self.legs_in_window(t) {
            let [Some(from), Some(to)] = [leg, leg + 1].map(|i| self.samples.get(i)) else {
                break;
            };
            // There are far fewer samples than an f64 can count.
            let since = t - leg as f64 * step;
            let weight = response(since, self.windows) - response(since - step, self.windows);
            for ((value, from), to) in sum.iter_mut().zip(from).zip(to) {
                *value += (to - from) / step * weight;
            }
        }
        sum
    }
}

/// Points of the motion at equal times, and the time (s) between them. Where it stops it pauses
/// for that time (s).
fn samples(pieces: &[Piece], stretches: &[Stretch], pause: f64) -> (Vec<Vec<f64>>, f64) {
    let time_of = |stretch: &Stretch| {
        let pause = if stretch.stops { pause } else { 0.0 };
        stretch.duration() + pause
    };
    let total: f64 = stretches.iter().map(time_of).sum();
    if stretches.is_empty() {
        return (Vec::new(), SAMPLE);
    }
    let count = (total / SAMPLE).ceil().max(1.0);
    let step = total / count;
    let mut samples = Vec::new();
    let mut begun = 0.0;
    let mut rest = stretches;
    // A motion takes minutes at most.
    for i in 0..=count as u32 {
        let t = f64::from(i) * step;
        while let Some((stretch, later)) = rest.split_first() {
            let end = begun + time_of(stretch);
            if t <= end || later.is_empty() {
                let piece = &pieces[stretch.piece];
                let along = stretch.travelled((t - begun).min(stretch.duration()));
                samples.push(piece.point(stretch.along + along));
                break;
            }
            begun = end;
            rest = later;
        }
    }
    (samples, step)
}

/// A unit step at 0, averaged over both windows: the integral of the averaged impulse.
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

/// A unit impulse at 0, averaged over both windows and differentiated once.
fn impulse_integral(t: f64, [a, b]: [f64; 2]) -> f64 {
    let ramp = |t: f64| t.max(0.0);
    (ramp(t) - ramp(t - a) - ramp(t - b) + ramp(t - a - b)) / (a * b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn one_axis(velocity: f64, acceleration: f64) -> Vec<AxisGroup> {
        vec![AxisGroup::single(0, velocity, acceleration)]
    }

    /// What the windows add to a duration (s).
    const WINDOWS: f64 = SAMPLE + JERK_WINDOW;

    #[test]
    fn a_path_of_one_point_takes_no_time() {
        let t = Trajectory::new(&[vec![1.0]], &one_axis(1.0, 1.0));
        assert_eq!((t.duration(), t.position(0.5)), (0.0, vec![1.0]));
    }

    #[test]
    fn a_long_leg_is_driven_at_the_speed_limit() {
        let t = Trajectory::new(&[vec![0.0], vec![10.0]], &one_axis(2.0, 4.0));
        // 5 s at full speed, half of 0.5 s for speeding up, and the same for slowing down.
        let fastest = 5.5;
        let more = t.duration() - fastest;
        assert!((0.0..WINDOWS + 0.005).contains(&more), "{more}");
        assert!((t.velocity(t.duration() / 2.0)[0] - 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_short_leg_does_not_wait_for_a_speed_it_never_reaches() {
        let t = Trajectory::new(&[vec![0.0], vec![0.01]], &one_axis(1.0, 1.0));
        let more = t.duration() - 0.2;
        assert!((0.0..WINDOWS + 0.005).contains(&more), "{more}");
    }

    #[test]
    fn only_the_axis_that_needs_most_time_decides_at_each_place() {
        // One axis is slow on the first leg, the other on the second.
        let points = [vec![0.0, 0.0], vec![3.0, 0.2], vec![3.2, 6.0]];
        let limits = [
            AxisGroup::single(0, 1.0, 2.0),
            AxisGroup::single(1, 2.0, 4.0),
        ];
        let t = Trajectory::rounded(&points, &limits, &mut |_| true);
        // With a stop at the corner it would be 7.
        assert!(t.duration() < 6.8, "{}", t.duration());
    }

    const CORNER: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

    fn corner() -> (Vec<Vec<f64>>, [AxisGroup; 1]) {
        let limits = AxisGroup {
            axes: 0..2,
            velocity: 1.0,
            acceleration: 1.0,
        };
        (CORNER.map(|p| p.to_vec()).to_vec(), [limits])
    }

    /// How close (m) the trajectory comes to the corner.
    fn distance_of_corner(t: &Trajectory) -> f64 {
        (0..=2000)
            .map(|i| t.position(t.duration() * f64::from(i) / 2000.0))
            .map(|p| (p[0] - 1.0).hypot(p[1]))
            .fold(f64::MAX, f64::min)
    }

    #[test]
    fn stopping_in_corners_touches_every_point() {
        let (points, limits) = corner();
        let stopping = Trajectory::new(&points, &limits);
        assert!(distance_of_corner(&stopping) < 1e-9);
        let round = Trajectory::rounded(&points, &limits, &mut |_| true);
        assert!(distance_of_corner(&round) > 0.01);
        assert!(round.duration() < stopping.duration());
    }

    #[test]
    fn a_corner_is_rounded_as_far_as_there_is_room() {
        let (points, limits) = corner();
        // A column inside the corner.
        let is_free = |p: &[f64]| (p[0] - 0.9).hypot(p[1] - 0.1) > 0.06;
        let round = Trajectory::rounded(&points, &limits, &mut |p| is_free(p));
        let stopping = Trajectory::new(&points, &limits);
        assert!(round.duration() < stopping.duration());
        for i in 0..=1000 {
            let p = round.position(round.duration() * f64::from(i) / 1000.0);
            assert!(is_free(&p), "{p:?}");
        }
        let never = Trajectory::rounded(&points, &limits, &mut |_| false);
        assert_eq!(never, stopping);
    }

    #[test]
    fn a_corner_of_nanometres_does_not_stop_the_motion_for_ever() {
        let limits = [
            AxisGroup::single(0, 1.0, 2.0),
            AxisGroup::single(1, 1.0, 2.0),
        ];
        let end = 0.5 + 3e-9;
        let points = [[0.0, 0.0], [0.5, 0.0], [end, 3e-9], [0.5, 0.5]].map(|p| p.to_vec());
        let t = Trajectory::rounded(&points, &limits, &mut |_| true);
        assert!(t.duration() < 2.2, "{}", t.duration());
        assert_eq!(t.position(t.duration()), points[3]);
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
            let t = if stop {
                Trajectory::new(&points, &limits)
            } else {
                Trajectory::rounded(&points, &limits, &mut |_| true)
            };
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
                    prop_assert!(g.norm(&v) <= g.velocity * (1.0 + 1e-6));
                    prop_assert!(g.norm(&a) <= g.acceleration * (1.0 + 1e-5));
                    if let Some(b) = &before {
                        // The largest change within h that the jerk window allows.
                        let jerk = 2.0 * g.acceleration / t.windows[1];
                        let change: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
                        prop_assert!(g.norm(&change) <= jerk * h * (1.0 + 1e-5) + 1e-6);
                    }
                }
                before = Some(a);
            }
        }
    }
}
