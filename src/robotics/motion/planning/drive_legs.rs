//! The legs of which a base drives from one place to another.
//!
//! An omnidirectional base drives straight, turning meanwhile. A differential one turns on the spot, drives
//! straight ahead or back, and turns on the spot again.

use crate::motion::failure::base_place::BasePlace;
use crate::robot::description::DriveKind;
use spatial::trig;

/// Shorter ways (m) are turns on the spot.
const NO_WAY: f64 = 1e-6;
/// Cost of a radian of turning, in metres of driving.
pub(super) const TURN_COST: f64 = 0.5;
/// How much more (share) it costs to drive back than to drive ahead: the robot does not look there.
pub(super) const BACK_COST: f64 = 0.5;

/// The places at the ends of the legs from one place to another. The heading of the last may differ from the
/// given one by full turns.
pub(super) fn legs(drive: DriveKind, from: &BasePlace, to: &BasePlace) -> Vec<BasePlace> {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let way = libm::hypot(dx, dy);
    if drive != DriveKind::Differential || way < NO_WAY {
        return vec![*to];
    }
    let ahead = trig::atan2(dy, dx);
    let driving = |heading: f64, back: f64| {
        let heading = from[2] + trig::wrap(heading - from[2]);
        let end = heading + trig::wrap(to[2] - heading);
        let turns = (heading - from[2]).abs() + (end - heading).abs();
        (turns * TURN_COST + way * back, heading, end)
    };
    let forward = driving(ahead, 0.0);
    let backward = driving(ahead + std::f64::consts::PI, BACK_COST);
    let (_, heading, end) = if backward.0 < forward.0 {
        backward
    } else {
        forward
    };
    let all = [
        [from[0], from[1], heading],
        [to[0], to[1], heading],
        [to[0], to[1], end],
    ];
    let mut at = *from;
    let mut legs = Vec::with_capacity(all.len());
    for place in all {
        if place != at {
            legs.push(place);
            at = place;
        }
    }
    legs
}

/// A path with all its legs, whose headings are continuous.
pub(super) fn with_legs(drive: DriveKind, path: &[BasePlace]) -> Vec<BasePlace> {
    let mut all: Vec<BasePlace> = path.first().copied().into_iter().collect();
    for to in path.iter().skip(1) {
        if let Some(at) = all.last().copied() {
            all.extend(legs(drive, &at, to));
        }
    }
    all
}

/// Cost (m) of the legs from one place to another: driving and turning at the same time cost as much as the
/// longer of the two.
pub(super) fn cost(drive: DriveKind, from: &BasePlace, to: &BasePlace) -> f64 {
    let mut at = *from;
    let costs = legs(drive, from, to).into_iter().map(|to| {
        let from = std::mem::replace(&mut at, to);
        let way = libm::hypot(to[0] - from[0], to[1] - from[1]);
        let (s, c) = trig::sin_cos(from[2]);
        let is_back = (to[0] - from[0]) * c + (to[1] - from[1]) * s < 0.0;
        let dearer = drive == DriveKind::Differential && is_back;
        let way = if dearer { way * (1.0 + BACK_COST) } else { way };
        way.max((to[2] - from[2]).abs() * TURN_COST)
    });
    costs.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    const DIFFERENTIAL: DriveKind = DriveKind::Differential;

    #[test]
    fn a_differential_base_turns_drives_and_turns() {
        let all = legs(DIFFERENTIAL, &[0.0; 3], &[0.0, 1.0, 0.0]);
        let expected = [
            [0.0, 0.0, FRAC_PI_2],
            [0.0, 1.0, FRAC_PI_2],
            [0.0, 1.0, 0.0],
        ];
        assert_eq!(all.len(), expected.len(), "{all:?}");
        for (leg, expected) in all.iter().flatten().zip(expected.iter().flatten()) {
            assert!((leg - expected).abs() < 1e-12, "{all:?}");
        }
    }

    #[test]
    fn it_backs_up_rather_than_turn_twice() {
        let all = legs(DIFFERENTIAL, &[0.0; 3], &[-0.3, 0.0, 0.0]);
        assert_eq!(all, vec![[-0.3, 0.0, 0.0]]);
    }

    #[test]
    fn it_drives_ahead_where_it_must_turn_anyway() {
        let all = legs(DIFFERENTIAL, &[0.0; 3], &[-2.0, 0.0, PI]);
        assert_eq!(all.len(), 2, "{all:?}");
        assert!((all[0][2].abs() - PI).abs() < 1e-12, "{all:?}");
    }

    #[test]
    fn on_each_leg_a_differential_base_drives_along_its_heading_or_turns() {
        for i in 0..200 {
            let at = |k: i32| f64::from((i * k) % 23) * 0.3 - 3.0;
            let (from, to) = ([at(3), at(5), at(7)], [at(11), at(13), at(17)]);
            let mut before = from;
            for leg in legs(DIFFERENTIAL, &from, &to) {
                let (s, c) = trig::sin_cos(before[2]);
                let [dx, dy] = [leg[0] - before[0], leg[1] - before[1]];
                assert!(
                    (dy * c - dx * s).abs() < 1e-9,
                    "sideways from {from:?} to {to:?}"
                );
                assert!(libm::hypot(dx, dy) < 1e-9 || leg[2] == before[2]);
                before = leg;
            }
            assert!(trig::wrap(before[2] - to[2]).abs() < 1e-9);
            assert_eq!(before[..2], to[..2]);
        }
    }
}
