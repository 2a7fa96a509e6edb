//! Arguments of motions: plain data, in whatever language they were written.

use crate::motion::jobs::detect::DetectQuery;
use crate::motion::jobs::move_tcp::PoseGoal;
use crate::robot::Side;
use spatial::{Pose, Shortest};

/// The kind of value that a key of a motion takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArgumentKind {
    /// A finite number.
    Number,
    /// A list of finite numbers.
    Numbers,
    /// A pose of the map, whatever frame it names.
    MapPose,
    /// A pose in its frame.
    Place,
    /// The name of a frame that exists.
    Frame,
    /// A word, such as a direction.
    Word,
    /// One of these words; upper case.
    Member(&'static [&'static str]),
    /// An arm of the robot.
    Side,
    /// One or more arms of the robot.
    Sides,
    /// A description of objects.
    Described,
    /// A description of an object: the object of the world that it names, if it names one.
    InWorld,
}

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub enum Argument {
    /// Of [`ArgumentKind::Number`].
    Number(f64),
    /// Of [`ArgumentKind::Numbers`].
    Numbers(Vec<f64>),
    /// Of [`ArgumentKind::MapPose`].
    MapPose(Pose),
    /// Of [`ArgumentKind::Place`].
    Place(PoseGoal),
    /// The text of a frame or a word; words are in upper case.
    Word(String),
    /// Of [`ArgumentKind::Side`] and [`ArgumentKind::Sides`].
    Sides(Vec<Side>),
    /// Of [`ArgumentKind::Described`].
    Described(DetectQuery),
    /// Of [`ArgumentKind::InWorld`].
    InWorld(Option<String>),
}

/// Why the arguments do not make a motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ArgumentError {
    /// A required argument is missing.
    #[error("({} …) is needed", .0.to_lowercase())]
    Missing(&'static str),
    /// The direction is unknown.
    #[error(
        "{0} direction is unknown for PR2 projection PTU\n\
         the head looks forward, left, right, up or down"
    )]
    UnknownDirection(String),
    /// An object without a name cannot be found.
    #[error("the object of ({} …) has no name: detect it first", .0.to_lowercase())]
    Nameless(&'static str),
    /// A number that must not be negative.
    #[error("({} {}) is negative", key.to_lowercase(), Shortest(*.number))]
    Negative {
        /// The key.
        key: &'static str,
        /// The number.
        number: f64,
    },
}

/// The arguments of a motion by key.
#[derive(Clone, Debug, Default)]
pub struct Arguments(Vec<(&'static str, Argument)>);

impl Arguments {
    /// Adds an argument.
    pub fn insert(&mut self, key: &'static str, argument: Argument) {
        self.0.push((key, argument));
    }

    fn get(&self, key: &str) -> Option<&Argument> {
        let mut arguments = self.0.iter();
        arguments
            .find(|(name, _)| *name == key)
            .map(|(_, argument)| argument)
    }

    /// A number.
    pub(super) fn number(&self, key: &'static str) -> Result<f64, ArgumentError> {
        match self.get(key) {
            Some(Argument::Number(number)) => Ok(*number),
            _ => Err(ArgumentError::Missing(key)),
        }
    }

    /// A list of numbers, if given.
    pub(super) fn numbers(&self, key: &str) -> Option<Vec<f64>> {
        match self.get(key) {
            Some(Argument::Numbers(numbers)) => Some(numbers.clone()),
            _ => None,
        }
    }

    /// A pose of the map.
    pub(super) fn map_pose(&self, key: &'static str) -> Result<Pose, ArgumentError> {
        match self.get(key) {
            Some(Argument::MapPose(pose)) => Ok(*pose),
            _ => Err(ArgumentError::Missing(key)),
        }
    }

    /// A pose in its frame, if given.
    pub(super) fn place(&self, key: &str) -> Option<PoseGoal> {
        match self.get(key) {
            Some(Argument::Place(place)) => Some(*place),
            _ => None,
        }
    }

    /// A word or the name of a frame, if given.
    pub(super) fn word(&self, key: &str) -> Option<&str> {
        match self.get(key) {
            Some(Argument::Word(word)) => Some(word),
            _ => None,
        }
    }

    /// Arms.
    pub(super) fn sides(&self, key: &'static str) -> Result<Vec<Side>, ArgumentError> {
        match self.get(key) {
            Some(Argument::Sides(sides)) => Ok(sides.clone()),
            _ => Err(ArgumentError::Missing(key)),
        }
    }

    /// An arm.
    pub(super) fn side(&self, key: &'static str) -> Result<Side, ArgumentError> {
        let sides = self.sides(key)?;
        sides.first().copied().ok_or(ArgumentError::Missing(key))
    }

    /// A description of objects.
    pub(super) fn described(&self, key: &'static str) -> Result<DetectQuery, ArgumentError> {
        match self.get(key) {
            Some(Argument::Described(query)) => Ok(query.clone()),
            _ => Err(ArgumentError::Missing(key)),
        }
    }

    /// An object in the world, if given; inside it, its name, if it has one.
    pub(super) fn in_world(&self, key: &str) -> Option<Option<String>> {
        match self.get(key) {
            Some(Argument::InWorld(name)) => Some(name.clone()),
            _ => None,
        }
    }
}
