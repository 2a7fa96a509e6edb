//! Errors of sensors and motors, which are absent unless they are asked for.
//!
//! Every error is drawn from a generator of its own, seeded by what it belongs to: the session's
//! seed, the kind of error, and when it occurs. So an error more or less changes no other one, and a
//! world that is restored repeats its errors.

use std::f64::consts::TAU;

use nalgebra::{Translation3, UnitQuaternion, Vector3};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use thiserror::Error;

use super::hash::Hasher;
use crate::robot::Side;
use closest_name::closest_name;
use spatial::{Pose, Shortest, trig};

/// How large errors are. Zero means none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NoiseLevels {
    /// Standard deviation of a detected position, along each axis (m).
    pub position: f64,
    /// Standard deviation of a detected object's yaw (rad).
    pub yaw: f64,
    /// Probability that an object in sight is overlooked.
    pub misses: f64,
    /// Probability that an object is taken for one of another type.
    pub(crate) false_types: f64,
    /// Standard deviation of where a drive ends, along x and y (m).
    pub(crate) odometry_position: f64,
    /// Standard deviation of the heading in which a drive ends (rad).
    pub(crate) odometry_yaw: f64,
    /// Standard deviation of where a hand arrives that approaches an object, along each axis (m).
    pub(crate) grasp_position: f64,
    /// Standard deviation of the yaw of such a hand (rad).
    pub(crate) grasp_yaw: f64,
}

/// One of the levels.
pub(crate) struct NoiseSetting {
    /// Its name.
    pub name: &'static str,
    /// The largest value that makes sense.
    pub greatest: f64,
    /// Its value in common noise.
    usual: f64,
    of: fn(&mut NoiseLevels) -> &mut f64,
}

impl NoiseSetting {
    /// All of them.
    pub(crate) const ALL: &[NoiseSetting] = &[
        Self::new("position", 0.5, 0.005, |l| &mut l.position),
        Self::new("yaw", 3.0, 0.05, |l| &mut l.yaw),
        Self::new("misses", 1.0, 0.02, |l| &mut l.misses),
        Self::new("false-types", 1.0, 0.01, |l| &mut l.false_types),
        Self::new("odometry-position", 0.5, 0.01, |l| &mut l.odometry_position),
        Self::new("odometry-yaw", 3.0, 0.02, |l| &mut l.odometry_yaw),
        Self::new("grasp-position", 0.5, 0.002, |l| &mut l.grasp_position),
        Self::new("grasp-yaw", 3.0, 0.01, |l| &mut l.grasp_yaw),
    ];

    const fn new(
        name: &'static str,
        greatest: f64,
        usual: f64,
        of: fn(&mut NoiseLevels) -> &mut f64,
    ) -> Self {
        Self {
            name,
            greatest,
            usual,
            of,
        }
    }
}

/// A setting that cannot be.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoiseError {
    /// A part of a text gives no setting.
    #[error("{0:?} is no setting of noise: NAME=NUMBER was expected, as in position=0.01.")]
    Malformed(String),
    /// There is no such setting.
    #[error("{name} is no kind of noise{}", .closest.map_or_else(
        || format!(": there are {}.", names()),
        |closest| format!("; did you mean {closest}?")
    ))]
    Unknown {
        /// What was asked for.
        name: String,
        /// A similar name.
        closest: Option<&'static str>,
    },
    /// The value is out of range.
    #[error("The noise {name} is a number from 0 to {}, not {}.", Shortest(*.greatest), Shortest(*.value))]
    Range {
        /// The setting.
        name: &'static str,
        /// Its greatest value.
        greatest: f64,
        /// What was asked for.
        value: f64,
    },
}

/// The names of all settings, for messages.
fn names() -> String {
    let names: Vec<&str> = NoiseSetting::ALL.iter().map(|s| s.name).collect();
    names.join(", ")
}

impl NoiseLevels {
    /// As much as well-kept service robots have.
    pub fn usual() -> Self {
        let mut levels = Self::default();
        for setting in NoiseSetting::ALL {
            *(setting.of)(&mut levels) = setting.usual;
        }
        levels
    }

    /// Changes the setting with that name.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), NoiseError> {
        let is_it = |setting: &&NoiseSetting| setting.name.eq_ignore_ascii_case(name);
        let Some(setting) = NoiseSetting::ALL.iter().find(is_it) else {
            let names = NoiseSetting::ALL.iter().map(|setting| setting.name);
            let name = name.to_lowercase();
            let closest = closest_name(&name, names);
            return Err(NoiseError::Unknown { name, closest });
        };
        if !(0.0..=setting.greatest).contains(&value) {
            return Err(NoiseError::Range {
                name: setting.name,
                greatest: setting.greatest,
                value,
            });
        }
        *(setting.of)(self) = value;
        Ok(())
    }

    /// The levels that a text such as `position=0.01,misses=0.1` gives, all others zero; the usual
    /// ones if it is empty.
    pub fn from_text(text: &str) -> Result<Self, NoiseError> {
        if text.is_empty() {
            return Ok(Self::usual());
        }
        let mut levels = Self::default();
        for setting in text.split(',') {
            let given = setting.split_once('=');
            let number = given.and_then(|(name, value)| Some((name, value.trim().parse().ok()?)));
            let Some((name, value)) = number else {
                return Err(NoiseError::Malformed(setting.to_owned()));
            };
            levels.set(name.trim(), value)?;
        }
        Ok(levels)
    }

    /// The settings that are not zero, with their values.
    pub fn settings(mut self) -> Vec<(&'static str, f64)> {
        let all = NoiseSetting::ALL.iter();
        let with_values = all.map(|setting| (setting.name, *(setting.of)(&mut self)));
        with_values.filter(|(_, value)| *value > 0.0).collect()
    }
}

/// The errors of a world's robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// How large they are.
    pub levels: NoiseLevels,
    /// What all errors depend on: the seed of the session, and how many times noise has begun in it.
    seeds: [u64; 2],
    /// How often the robot has looked for objects.
    looks: u64,
}

/// What the camera makes of an object that is in sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perceived {
    /// Whether it is overlooked.
    pub(crate) is_missed: bool,
    /// If it is taken for one of another type, which of them: a number from 0 up to 1.
    pub(crate) other_type: Option<f64>,
    /// The error of its position (m, along the axes of the map) and of its yaw (rad).
    error: ([f64; 3], f64),
}

impl Perceived {
    /// Where an object at the pose, in the map, appears to be.
    pub fn pose(&self, truth: &Pose) -> Pose {
        let (error, yaw) = self.error;
        let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * yaw);
        let moved = Translation3::from(truth.translation.vector + Vector3::from(error));
        Pose::from_parts(moved, turn * truth.rotation)
    }
}

/// Errors of different kinds do not depend on one another.
enum Kind {
    Look,
    Drive,
    Approach,
}

impl Noise {
    /// Noise whose errors depend on the seeds.
    pub fn new(levels: NoiseLevels, seeds: [u64; 2]) -> Self {
        Self {
            levels,
            seeds,
            looks: 0,
        }
    }

    /// Notes that the robot looks for objects once more.
    pub fn look(&mut self) {
        self.looks += 1;
    }

    /// What the latest look makes of an object.
    pub fn perceived(&self, object: &str) -> Perceived {
        let mut draws = self.draws(&Kind::Look, self.looks, object);
        let levels = &self.levels;
        let is_missed = draws.unit() < levels.misses;
        let other_type = (draws.unit() < levels.false_types).then(|| draws.unit());
        Perceived {
            is_missed,
            other_type,
            error: (
                [(); 3].map(|()| draws.normal() * levels.position),
                draws.normal() * levels.yaw,
            ),
        }
    }

    /// By how much a drive that is planned at the step ends beside its goal: x, y (m) and
    /// heading (rad).
    pub(crate) fn of_drive(&self, step: u64) -> [f64; 3] {
        let mut draws = self.draws(&Kind::Drive, step, "");
        let NoiseLevels {
            odometry_position,
            odometry_yaw,
            ..
        } = self.levels;
        [odometry_position, odometry_position, odometry_yaw].map(|level| draws.normal() * level)
    }

    /// Where a hand that approaches an object arrives instead of at the goal, a pose in the frame
    /// of the base. The motion began at the step.
    pub(crate) fn of_approach(&self, step: u64, side: Side, goal: &Pose) -> Pose {
        let mut draws = self.draws(&Kind::Approach, step, side.name());
        let error = [(); 3].map(|()| draws.normal() * self.levels.grasp_position);
        let turn = Vector3::z() * (draws.normal() * self.levels.grasp_yaw);
        let moved = Translation3::from(goal.translation.vector + Vector3::from(error));
        Pose::from_parts(
            moved,
            UnitQuaternion::from_scaled_axis(turn) * goal.rotation,
        )
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

impl super::World {
    /// The errors of sensors and motors; `None` if there are none.
    pub fn noise(&self) -> Option<&Noise> {
        self.state.noise.as_ref()
    }

    /// The same, to be changed.
    pub(crate) fn noise_mut(&mut self) -> Option<&mut Noise> {
        self.state.noise.as_mut()
    }

    /// Sets the errors of sensors and motors.
    pub fn set_noise(&mut self, noise: Option<Noise>) {
        self.state.noise = noise;
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
        let mut noise = Noise::new(levels, [3, 0]);
        let (mut square, mut sum, mut missed, mut mistaken) = (0.0, 0.0, 0, 0);
        const LOOKS: u32 = 4000;
        for _ in 0..LOOKS {
            noise.look();
            let perceived = noise.perceived("cup-1");
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
        assert_eq!(looked.of_drive(5), noise(1).of_drive(5));
        assert_ne!(looked.of_drive(5), looked.of_drive(6));
        assert_ne!(looked.of_drive(5), noise(2).of_drive(5));
        assert_ne!(looked.perceived("a"), looked.perceived("b"));
        assert_ne!(looked.perceived("a"), noise(1).perceived("a"));
    }

    #[test]
    fn settings_have_names_and_ranges() {
        let mut levels = NoiseLevels::default();
        assert_eq!(
            levels.set("postion", 0.1).unwrap_err().to_string(),
            "postion is no kind of noise; did you mean position?"
        );
        for value in [-0.1, 1.1, f64::NAN] {
            assert!(levels.set("misses", value).is_err());
        }
        assert!(levels.settings().is_empty());
        levels.set("MISSES", 0.5).unwrap();
        assert_eq!(levels.settings(), [("misses", 0.5)]);
    }
}
