//! Errors of sensors and motors, which are absent unless they are asked for.
//!
//! The robot does not know its errors. What it believes of its own place, and of where its hands are,
//! differs from the truth by them, and so things end beside their targets.
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
    /// Standard deviation of a detected position, along each axis (m), up to 1 m from the camera.
    pub position: f64,
    /// Standard deviation of a detected object's yaw (rad).
    pub yaw: f64,
    /// Probability that an object in sight is overlooked, up to 1 m ahead of the camera.
    pub misses: f64,
    /// Probability that an object is taken for one of another type.
    pub(crate) false_types: f64,
    /// Standard deviation of where the robot is from where it takes itself to be, along x and y (m).
    pub(crate) odometry_position: f64,
    /// The same for its heading (rad).
    pub(crate) odometry_yaw: f64,
    /// Standard deviation of where a hand arrives that approaches an object or puts one down, along
    /// each axis (m), from one such motion to the next.
    pub(crate) grasp_position: f64,
    /// Standard deviation of the yaw of such a hand (rad).
    pub(crate) grasp_yaw: f64,
    /// Standard deviation, over arms, of how far an arm's calibration is off, along each axis (m). It is
    /// the same in all motions of an arm.
    pub(crate) calibration_position: f64,
    /// The same for the yaw of its hand (rad).
    pub(crate) calibration_yaw: f64,
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
    /// All of them. The usual values are those of a PR2 in a laboratory:
    ///
    /// - the pose of an object in a depth image is good to some millimetres at 1 m (K. Khoshelham and
    ///   S. O. Elberink, "Accuracy and resolution of Kinect depth data", Sensors 12, 2012);
    /// - a robot with a laser scanner knows its place to about a centimetre and a degree (C. M. Costa et
    ///   al., "Robust and accurate localization system for mobile manipulators in cluttered
    ///   environments", ICIT 2015);
    /// - a hand that is guided by a camera alone arrives with an error of about a centimetre after
    ///   calibration (O. Limoyo et al., "Self-calibration of mobile manipulator kinematic and sensor
    ///   extrinsic parameters through contact-based interaction", ICRA 2018);
    /// - misses and false types are assumptions: they depend on the recognition that is used.
    pub(crate) const ALL: &[NoiseSetting] = &[
        Self::new("position", 0.5, 0.005, |l| &mut l.position),
        Self::new("yaw", 3.0, 0.05, |l| &mut l.yaw),
        Self::new("misses", 1.0, 0.02, |l| &mut l.misses),
        Self::new("false-types", 1.0, 0.01, |l| &mut l.false_types),
        Self::new("odometry-position", 0.5, 0.01, |l| &mut l.odometry_position),
        Self::new("odometry-yaw", 3.0, 0.02, |l| &mut l.odometry_yaw),
        Self::new("grasp-position", 0.5, 0.002, |l| &mut l.grasp_position),
        Self::new("grasp-yaw", 3.0, 0.01, |l| &mut l.grasp_yaw),
        Self::new("calibration-position", 0.5, 0.005, |l| {
            &mut l.calibration_position
        }),
        Self::new("calibration-yaw", 3.0, 0.01, |l| &mut l.calibration_yaw),
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
    let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * yaw);
    Pose::from_parts(
        Translation3::from(pose.translation.vector + by),
        turn * pose.rotation,
    )
}

/// Where an object is in the sight of the camera.
#[derive(Clone, Copy, Debug)]
pub struct Sighting {
    /// Its distance from the camera (m).
    pub distance: f64,
    /// The cosine of the angle between it and the optical axis.
    pub cosine: f64,
}

impl Sighting {
    /// By how much errors of position grow beyond 1 m: with the square of the distance, as those of
    /// depth images do (the source is named at [`NoiseSetting::ALL`]).
    fn blur(&self) -> f64 {
        (self.distance * self.distance).max(1.0)
    }

    /// By how much misses become more probable: an object has fewer pixels, by the square of its
    /// distance, and towards the edge of the picture less light, by the fourth power of the cosine.
    fn dimness(&self) -> f64 {
        let square = self.cosine * self.cosine;
        self.blur() / (square * square).max(0.01)
    }
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
        moved(truth, &Vector3::from(error), yaw)
    }
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
        let levels = &self.levels;
        let is_missed = draws.unit() < levels.misses * sighting.dimness();
        let position = levels.position * sighting.blur();
        let other_type = (draws.unit() < levels.false_types).then(|| draws.unit());
        Perceived {
            is_missed,
            other_type,
            error: (
                [(); 3].map(|()| draws.normal() * position),
                draws.normal() * levels.yaw,
            ),
        }
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

impl super::World {
    /// The errors of sensors and motors; `None` if there are none.
    pub fn noise(&self) -> Option<&Noise> {
        self.state.noise.as_ref()
    }

    /// The same, to be changed.
    pub(crate) fn noise_mut(&mut self) -> Option<&mut Noise> {
        self.state.noise.as_mut()
    }

    /// Where the robot takes its base to be, in the map: where it is, without noise.
    pub fn believed_base(&self) -> Pose {
        let base = self.robot_configuration().base;
        let Some(noise) = &self.state.noise else {
            return base;
        };
        let [x, y, yaw] = noise.base;
        moved(&base, &-Vector3::new(x, y, 0.0), -yaw)
    }

    /// The true pose in the map of what the robot takes to be at a pose in the map.
    pub fn from_belief(&self, believed: &Pose) -> Pose {
        match &self.state.noise {
            None => *believed,
            Some(_) => self.robot_configuration().base * self.believed_base().inverse() * believed,
        }
    }

    /// Where the robot takes something to be, in the map, that is at a pose in the map.
    pub fn to_belief(&self, truth: &Pose) -> Pose {
        match &self.state.noise {
            None => *truth,
            Some(_) => self.believed_base() * self.robot_configuration().base.inverse() * truth,
        }
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
