//! A motion through points at given times, as others plan it.
//!
//! Between two points, each axis follows a cubic polynomial if both have velocities, and a straight line
//! otherwise: as controllers of ROS 2 do (`joint_trajectory_controller`, "spline interpolation").

use super::axis_group::AxisGroup;
use super::trajectory::Trajectory;

/// Time (s) between two samples of the motion.
const SAMPLE: f64 = 1.0 / 60.0;
/// By how much (as a share) a speed may be above its limit: numbers of others are rounded.
const ROUNDING: f64 = 1e-3;

/// A point of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedPoint {
    /// When (s) it is to be reached, since the begin.
    pub time: f64,
    /// Positions of the axes (rad or m).
    pub positions: Vec<f64>,
    /// Their velocities then (rad/s or m/s), if given.
    pub velocities: Option<Vec<f64>>,
}

/// A velocity that no axis may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Excess {
    /// The axis.
    pub(crate) axis: usize,
    /// When (s).
    pub(crate) time: f64,
    /// How fast (rad/s or m/s) it would have to move.
    pub(crate) velocity: f64,
}

/// Positions at a time between two points.
fn between(from: &TimedPoint, to: &TimedPoint, time: f64) -> Vec<f64> {
    let length = to.time - from.time;
    let part = ((time - from.time) / length).clamp(0.0, 1.0);
    let (a, b) = (&from.positions, &to.positions);
    let (Some(u), Some(v)) = (&from.velocities, &to.velocities) else {
        return a.iter().zip(b).map(|(a, b)| a + (b - a) * part).collect();
    };
    let (square, cube) = (part * part, part * part * part);
    let ends = a.iter().zip(b).zip(u.iter().zip(v));
    ends.map(|((a, b), (u, v))| {
        let slope = length * (cube - 2.0 * square + part) * u + length * (cube - square) * v;
        a + (b - a) * (3.0 * square - 2.0 * cube) + slope
    })
    .collect()
}

/// The motion through the points at equal times, from the first to the last, and the time (s) between two of these.
/// The times of the points rise.
pub(crate) fn sampled(points: &[TimedPoint]) -> (Vec<Vec<f64>>, f64) {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return (Vec::new(), SAMPLE);
    };
    let length = last.time - first.time;
    let count = (length / SAMPLE).ceil().max(1.0);
    let step = length.max(SAMPLE) / count;
    let mut legs = points.windows(2).peekable();
    let mut samples = vec![first.positions.clone()];
    // A motion takes minutes at most.
    for number in 1..count as u32 {
        let time = first.time + f64::from(number) * step;
        while legs.next_if(|leg| leg[1].time < time).is_some() {}
        let sample = legs.peek().map(|leg| between(&leg[0], &leg[1], time));
        samples.push(sample.unwrap_or_else(|| last.positions.clone()));
    }
    samples.push(last.positions.clone());
    (samples, step)
}

/// The first velocity above its limit (rad/s or m/s), of which there is one for each axis.
pub(crate) fn excess(samples: &[Vec<f64>], step: f64, limits: &[f64]) -> Option<Excess> {
    for (number, pair) in samples.windows(2).enumerate() {
        let ways = pair[0].iter().zip(&pair[1]).zip(limits);
        for (axis, ((from, to), limit)) in ways.enumerate() {
            let velocity = (to - from).abs() / step;
            if velocity > limit * (1.0 + ROUNDING) {
                return Some(Excess {
                    axis,
                    time: number as f64 * step,
                    velocity,
                });
            }
        }
    }
    None
}

/// The motion as a trajectory, which runs within 0.1 s after it and as close to it as [`Trajectory`] says.
pub(crate) fn trajectory(samples: Vec<Vec<f64>>, step: f64, limits: &[AxisGroup]) -> Trajectory {
    Trajectory::through(samples, step, limits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(time: f64, position: f64, velocity: Option<f64>) -> TimedPoint {
        TimedPoint {
            time,
            positions: vec![position],
            velocities: velocity.map(|velocity| vec![velocity]),
        }
    }

    #[test]
    fn a_line_without_velocities_and_a_cubic_with_them() {
        let line = [point(0.0, 1.0, None), point(2.0, 3.0, None)];
        assert_eq!(between(&line[0], &line[1], 0.5), vec![1.5]);
        let cubic = [point(0.0, 0.0, Some(0.0)), point(1.0, 1.0, Some(0.0))];
        assert_eq!(between(&cubic[0], &cubic[1], 0.5), vec![0.5]);
        assert!((between(&cubic[0], &cubic[1], 0.25)[0] - 0.15625).abs() < 1e-12);
        // One with the velocity of a straight line is one.
        let even = [point(0.0, 0.0, Some(2.0)), point(1.0, 2.0, Some(2.0))];
        assert!((between(&even[0], &even[1], 0.3)[0] - 0.6).abs() < 1e-12);
    }

    #[test]
    fn samples_go_from_the_first_to_the_last_point_through_all_others() {
        let points = [
            point(0.0, 0.0, None),
            point(0.5, 1.0, None),
            point(0.51, 1.0, None),
            point(1.0, 0.0, None),
        ];
        let (samples, step) = sampled(&points);
        assert_eq!((samples[0][0], samples[samples.len() - 1][0]), (0.0, 0.0));
        assert!((step * (samples.len() - 1) as f64 - 1.0).abs() < 1e-12);
        let highest = samples.iter().map(|s| s[0]).fold(0.0, f64::max);
        assert!((highest - 1.0).abs() < 0.03, "{highest}");
        // A single point, and one that is there at once.
        assert_eq!(sampled(&points[..1]).0, vec![vec![0.0], vec![0.0]]);
        assert_eq!(sampled(&[]).0, Vec::<Vec<f64>>::new());
    }

    #[test]
    fn what_is_too_fast_is_found_where_it_is() {
        let points = [
            point(0.0, 0.0, None),
            point(1.0, 0.5, None),
            point(1.5, 1.5, None),
        ];
        let (samples, step) = sampled(&points);
        assert_eq!(excess(&samples, step, &[2.0]), None);
        let found = excess(&samples, step, &[1.0]).expect("it is too fast");
        assert!((found.time - 1.0).abs() < 0.02 && (found.velocity - 2.0).abs() < 0.1);
        assert_eq!(excess(&samples, step, &[0.1]).map(|e| e.time), Some(0.0));
    }

    #[test]
    fn the_trajectory_keeps_to_the_times_and_ends_at_the_last_point() {
        let points = [point(0.0, 0.0, Some(0.0)), point(2.0, 1.0, Some(0.0))];
        let (samples, step) = sampled(&points);
        let limits = [AxisGroup::single(0, 2.0, 4.0)];
        let made = trajectory(samples, step, &limits);
        assert!((2.0..2.1).contains(&made.duration()), "{}", made.duration());
        assert_eq!(made.position(made.duration()), vec![1.0]);
        for number in 0..=20 {
            let time = 0.1 * f64::from(number);
            let wanted = between(&points[0], &points[1], time)[0];
            let lag = (made.position(time)[0] - wanted).abs();
            assert!(lag < 0.04, "{time}: {lag}");
        }
    }
}
