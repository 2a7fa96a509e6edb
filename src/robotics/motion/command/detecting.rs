//! Looking for objects in the camera's picture.

use super::{ArgumentError, ArgumentKind, Arguments, Command, MotionKey, MotionType};
use crate::motion::jobs::detect::{Detect, DetectQuery};
use crate::motion::jobs::job::Motion;

/// Looks for objects.
#[derive(Clone, Debug, PartialEq)]
pub struct Detecting {
    /// Which objects are looked for.
    pub query: DetectQuery,
}

impl Command for Detecting {
    const TYPE: MotionType = MotionType {
        name: "DETECTING",
        aliases: &[],
        keys: &[
            MotionKey::required(
                "OBJECT",
                ArgumentKind::Described,
                "a description of the object",
            ),
            MotionKey::optional(
                "CAMERA",
                ArgumentKind::Member(&["HEAD"]),
                "the camera; the head has one",
            ),
        ],
        one_of: &[],
        about: &["OBJECT"],
        is_known_by_keys: false,
        doc: "Looks for an object in the camera's picture as it is.",
        example: "(a motion (type detecting) (object (an object (type bottle))))",
    };

    fn new(arguments: &Arguments) -> Result<Self, ArgumentError> {
        let query = arguments.described("OBJECT")?;
        Ok(Self { query })
    }

    fn job(self) -> Box<dyn Motion> {
        Box::new(Detect::new(self.query))
    }
}
