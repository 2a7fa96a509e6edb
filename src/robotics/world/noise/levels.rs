//! How large the errors of a robot are: settings by name, and their usual values.

use closest_name::closest_name;
use spatial::Shortest;
use thiserror::Error;

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

#[cfg(test)]
mod tests {
    use super::*;

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
