//! What a session starts with.

use thiserror::Error;

use super::simulation::LogLevel;
use crate::robot::{KITCHEN_URDF, KinematicTree, PR2_DESCRIPTION, PR2_URDF, RobotDescription};
use crate::world::Models;
use crate::world::object_library::{OBJECTS, ObjectLibrary};

/// What a session starts with.
#[derive(Clone, Debug)]
pub struct SessionOptions {
    /// Seed of everything random.
    pub seed: u64,
    /// Name and text of a URDF in place of the built-in robot's.
    pub robot: Option<(String, String)>,
    /// Name and text of a URDF in place of the built-in kitchen's.
    pub world: Option<(String, String)>,
    /// Least severe log lines that are shown.
    pub log_level: LogLevel,
    /// How many simulated seconds pass in a real one; as many as possible if none.
    pub realtime: Option<f64>,
}

impl Default for SessionOptions {
    fn default() -> SessionOptions {
        SessionOptions {
            seed: 0,
            robot: None,
            world: None,
            log_level: LogLevel::Info,
            realtime: None,
        }
    }
}

/// Why a session cannot start.
#[derive(Debug, Error)]
pub enum SessionError {
    /// A description of the robot, the kitchen or the objects is wrong.
    #[error("{0}")]
    Models(String),
    /// A built-in plan is wrong.
    #[error("the built-in plan {name} cannot be loaded: {report}")]
    Plan {
        /// The file.
        name: String,
        /// What is wrong.
        report: String,
    },
}

impl SessionOptions {
    /// Reads the descriptions of robot, kitchen and objects.
    pub(super) fn models(&self) -> Result<Models, SessionError> {
        let tree = |given: &Option<(String, String)>, text: &str, name: &str| {
            let (name, text) = match given {
                Some((name, text)) => (name.as_str(), text.as_str()),
                None => (name, text),
            };
            KinematicTree::from_urdf(text, name).map_err(|e| SessionError::Models(e.to_string()))
        };
        let robot = tree(&self.robot, PR2_URDF, "pr2.urdf")?;
        let kitchen = tree(&self.world, KITCHEN_URDF, "kitchen.urdf")?;
        let description = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &robot)
            .map_err(|e| SessionError::Models(e.to_string()))?;
        let objects = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp")
            .map_err(|e| SessionError::Models(e.to_string()))?;
        Ok(Models::new(robot, description, kitchen, objects))
    }
}
