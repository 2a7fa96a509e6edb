//! Errors of sensors and motors, which are absent unless they are asked for.
//!
//! The robot does not know its errors. What it believes of its own place, and of where its hands are,
//! differs from the truth by them, and so things end beside their targets.
//!
//! Every error is drawn from a generator of its own, seeded by what it belongs to: the session's
//! seed, the kind of error, and when it occurs. So an error more or less changes no other one, and a
//! world that is restored repeats its errors.

mod belief;
mod levels;
mod sighting;

use std::f64::consts::TAU;

use nalgebra::{Translation3, Vector3};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use super::hash::Hasher;
use crate::robot::Side;
pub use levels::{NoiseError, NoiseLevels};
pub use sighting::{Perceived, Sighting};
use spatial::pose::from_xy_yaw;
use spatial::{Pose, trig};

/// The errors of a world's robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// How large they are.
    pub levels: NoiseLevels,
    /// What all errors depend on: the seed of the session, and how many times noise has begun in it.
    seeds: [u64; 2],
    /// How often the robot has looked for objects.
    looks: u64,
    /// How far the base is from where the robot takes it to be: x, y (m) and heading (rad), in the map.
    base: [f64; 3],
    /// By how much the left and the right hand last missed where they were to go.
    hands: [HandError; 2],
}

/// How far a hand is from where the robot takes it to be: along the axes of the base (m), and its yaw
/// (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct HandError {
    position: [f64; 3],
    yaw: f64,
}

impl HandError {
    /// Where the hand arrives that is to go to a pose in the frame of the base.
    fn arrives(&self, goal: &Pose) -> Pose {
        moved(goal, &Vector3::from(self.position), self.yaw)
    }

    /// Where the robot takes the hand to be that is at a pose in the frame of the base.
    fn believed(&self, truth: &Pose) -> Pose {
        moved(truth, &-Vector3::from(self.position), -self.yaw)
    }
}

/// The pose, moved, and turned about itself by the yaw (rad).
fn moved(pose: &Pose, by: &Vector3<f64>, yaw: f64) -> Pose {
    Pose::from_parts(
        Translation3::from(pose.translation.vector + by),
        from_xy_yaw(0.0, 0.0, yaw).rotation * pose.rotation,
    )
}

/// Errors of different kinds do not depend on one another.
enum Kind {
    Look,
    Drive,
    Approach,
    Calibration,
}

/// After how much way (m) nothing is left of an error of localisation but a share of 1/e: laser and map
/// correct it, while odometry adds new errors. An assumption.
const FORGOTTEN_AFTER: f64 = 2.0;

impl Noise {
    /// Noise whose errors depend on the seeds.
    pub fn new(levels: NoiseLevels, seeds: [u64; 2]) -> Self {
        Self {
            levels,
            seeds,
            looks: 0,
            base: [0.0; 3],
            hands: [HandError::default(); 2],
        }
    }

    /// Notes that the robot looks for objects once more.
    pub fn look(&mut self) {
        self.looks += 1;
    }

    /// What the latest look makes of an object that the camera sees so.
    pub fn perceived(&self, object: &str, sighting: &Sighting) -> Perceived {
        let mut draws = self.draws(&Kind::Look, self.looks, object);
        Perceived::drawn(&self.levels, sighting, &mut draws)
    }

    /// How far the base is beside where the robot takes it to be, x, y (m) and heading (rad), after a
    /// drive over the way (m) that is planned at the step: the error that there was fades, and another
    /// takes its place.
    pub(crate) fn of_drive(&self, step: u64, way: f64) -> [f64; 3] {
        let mut draws = self.draws(&Kind::Drive, step, "");
        let NoiseLevels {
            odometry_position,
            odometry_yaw,
            ..
        } = self.levels;
        let levels = [odometry_position, odometry_position, odometry_yaw];
        let kept = libm::exp(-way / FORGOTTEN_AFTER);
        let new = (1.0 - kept * kept).max(0.0).sqrt();
        let mut errors = self.base;
        for (error, level) in errors.iter_mut().zip(levels) {
            *error = *error * kept + draws.normal() * level * new;
        }
        errors
    }

    /// How far the base is from where the robot takes it to be: x, y (m) and heading (rad).
    pub(crate) fn base_error(&self) -> [f64; 3] {
        self.base
    }

    /// Sets that.
    pub(crate) fn set_base_error(&mut self, error: [f64; 3]) {
        self.base = error;
    }

    /// Where a hand that approaches an object, or puts one down, arrives instead of at the goal, a pose
    /// in the frame of the base. The motion began at the step.
    pub(crate) fn of_approach(&mut self, step: u64, side: Side, goal: &Pose) -> Pose {
        let mut draws = self.draws(&Kind::Approach, step, side.name());
        let mut fixed = self.draws(&Kind::Calibration, 0, side.name());
        let levels = &self.levels;
        let error = HandError {
            position: [(); 3].map(|()| {
                draws.normal() * levels.grasp_position
                    + fixed.normal() * levels.calibration_position
            }),
            yaw: draws.normal() * levels.grasp_yaw + fixed.normal() * levels.calibration_yaw,
        };
        self.hands[side.index()] = error;
        error.arrives(goal)
    }

    /// Where the robot takes a hand to be that is at a pose in the frame of the base, after its last
    /// approach.
    pub fn believed_hand(&self, side: Side, truth: &Pose) -> Pose {
        self.hands[side.index()].believed(truth)
    }

    /// The numbers for one event.
    fn draws(&self, kind: &Kind, number: u64, name: &str) -> Draws {
        let mut hasher = Hasher::default();
        for seed in self.seeds {
            hasher.integer(seed);
        }
        hasher.integer(match kind {
            Kind::Look => 0,
            Kind::Drive => 1,
            Kind::Approach => 2,
            Kind::Calibration => 3,
        });
        hasher.integer(number);
        hasher.text(name);
        Draws(Pcg64::seed_from_u64(hasher.finish()))
    }

    /// Feeds the state.
    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        for (name, value) in self.levels.settings() {
            hasher.text(name);
            hasher.number(value);
        }
        for seed in self.seeds {
            hasher.integer(seed);
        }
        hasher.integer(self.looks);
        let hands = self.hands.iter();
        let hands = hands.flat_map(|hand| hand.position.into_iter().chain([hand.yaw]));
        for number in self.base.into_iter().chain(hands) {
            hasher.number(number);
        }
    }
}

/// Random numbers.
struct Draws(Pcg64);

impl Draws {
    /// A number from 0 up to, but not including, 1.
    fn unit(&mut self) -> f64 {
        // 53 bits fit into a double exactly.
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from the standard normal distribution, by the method of Box and Muller.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        radius * trig::cos(TAU * self.unit())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_the_spread_that_was_asked_for() {
        let mut levels = NoiseLevels::default();
        for (name, value) in [("position", 0.01), ("misses", 0.25), ("false-types", 0.5)] {
            levels.set(name, value).unwrap();
        }
        let near = Sighting {
            distance: 0.8,
            cosine: 1.0,
        };
        let mut noise = Noise::new(levels, [3, 0]);
        let (mut square, mut sum, mut missed, mut mistaken) = (0.0, 0.0, 0, 0);
        const LOOKS: u32 = 4000;
        for _ in 0..LOOKS {
            noise.look();
            let perceived = noise.perceived("cup-1", &near);
            let error = perceived.pose(&Pose::identity()).translation.x;
            sum += error;
            square += error * error;
            missed += u32::from(perceived.is_missed);
            mistaken += u32::from(perceived.other_type.is_some());
        }
        let mean = sum / f64::from(LOOKS);
        let deviation = (square / f64::from(LOOKS)).sqrt();
        assert!(mean.abs() < 5e-4 && (deviation - 0.01).abs() < 5e-4);
        assert!((900..1100).contains(&missed), "{missed}");
        assert!((1900..2100).contains(&mistaken), "{mistaken}");
    }

    #[test]
    fn an_error_depends_on_its_own_circumstances_alone() {
        let noise = |seed| Noise::new(NoiseLevels::usual(), [seed, 0]);
        let mut looked = noise(1);
        looked.look();
        assert_eq!(looked.of_drive(5, 1.0), noise(1).of_drive(5, 1.0));
        assert_ne!(looked.of_drive(5, 1.0), looked.of_drive(6, 1.0));
        assert_ne!(looked.of_drive(5, 1.0), noise(2).of_drive(5, 1.0));
        let seen = |noise: &Noise, name| {
            let near = Sighting {
                distance: 1.0,
                cosine: 1.0,
            };
            noise.perceived(name, &near)
        };
        assert_ne!(seen(&looked, "a"), seen(&looked, "b"));
        assert_ne!(seen(&looked, "a"), seen(&noise(1), "a"));
    }

    #[test]
    fn what_is_far_away_or_at_the_edge_is_missed_more_often() {
        let mut levels = NoiseLevels::default();
        levels.set("misses", 0.1).unwrap();
        let mut noise = Noise::new(levels, [7, 0]);
        let mut missed = |distance, cosine| {
            let sighting = Sighting { distance, cosine };
            let looks = (0..2000).filter(|_| {
                noise.look();
                noise.perceived("cup-1", &sighting).is_missed
            });
            looks.count()
        };
        let (near, far, edge) = (missed(0.7, 1.0), missed(2.0, 1.0), missed(0.7, 0.84));
        assert!((150..250).contains(&near), "{near}");
        assert!((700..900).contains(&far), "{far}");
        assert!((330..470).contains(&edge), "{edge}");
    }

    #[test]
    fn localisation_errs_as_much_as_was_asked_for_however_the_way_is_divided() {
        let mut levels = NoiseLevels::default();
        levels.set("odometry-position", 0.01).unwrap();
        for way in [0.05, 1.0, 20.0] {
            let mut noise = Noise::new(levels, [11, 0]);
            let (mut square, mut step) = (0.0, 0.0);
            const DRIVES: u64 = 20_000;
            for drive in 0..DRIVES {
                let before = noise.base_error()[0];
                noise.set_base_error(noise.of_drive(drive, way));
                let [x, _, yaw] = noise.base_error();
                square += x * x;
                step += (x - before) * (x - before);
                assert_eq!(yaw, 0.0);
            }
            let deviation = (square / DRIVES as f64).sqrt();
            let step = (step / DRIVES as f64).sqrt();
            assert!((deviation - 0.01).abs() < 1.5e-3, "{way}: {deviation}");
            // A short way changes little of the error.
            assert!(
                if way < 0.1 {
                    step < 0.003
                } else {
                    step > 0.005
                },
                "{way}: {step}"
            );
        }
    }
}
