//! The names of bodies in reports.

use std::fmt;
use std::sync::Arc;

use serde::Serialize;

use crate::robot::LinkId;

/// A link with its name.
#[derive(Clone, Debug, Serialize)]
pub struct LinkName {
    /// The link in its tree.
    pub id: LinkId,
    /// Its name in the URDF.
    pub name: Arc<str>,
}

impl PartialEq for LinkName {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for LinkName {}

/// Anything in the world that can be touched.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub enum BodyName {
    /// A link of the robot.
    Robot(LinkName),
    /// A link of the kitchen.
    Furniture(LinkName),
    /// An object, by its name.
    Object(String),
    /// The floor.
    Floor,
}

impl BodyName {
    /// The name of the object, if it is one.
    pub fn object(&self) -> Option<&str> {
        match self {
            Self::Object(name) => Some(name),
            _ => None,
        }
    }

    /// The robot's link, if it is one.
    pub(crate) fn robot_link(&self) -> Option<LinkId> {
        match self {
            Self::Robot(link) => Some(link.id),
            _ => None,
        }
    }
}

impl fmt::Display for BodyName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Robot(link) | Self::Furniture(link) => &link.name,
            Self::Object(name) => name,
            Self::Floor => "floor",
        })
    }
}
