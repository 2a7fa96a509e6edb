//! What things are put on: furniture or an object.

use crate::robot::LinkId;
use crate::world::{Extent, Ground, World, WorldError};

/// What something may stand on.
#[derive(Clone, Debug, PartialEq)]
pub enum Support {
    /// A link of the kitchen that has a shape.
    Furniture(LinkId),
    /// An object, by its name in the world.
    Object(String),
}

impl Support {
    /// Its name.
    pub fn name(&self, world: &World) -> String {
        match self {
            Self::Furniture(link) => world.models().kitchen.link(*link).name.clone(),
            Self::Object(name) => name.clone(),
        }
    }

    /// The box around it; an error if it is not there, or has no shape.
    pub fn extent(&self, world: &World) -> Result<Extent, WorldError> {
        match self {
            Self::Furniture(link) => {
                let missing = || WorldError::UnknownObject {
                    name: self.name(world),
                    closest: None,
                };
                world.assembly_extent(*link).ok_or_else(missing)
            }
            Self::Object(name) => world.object_extent(name),
        }
    }

    /// What a thing on it stands on.
    pub fn ground(&self, world: &World) -> Result<Ground, WorldError> {
        Ok(match self {
            Self::Furniture(_) => Ground::Furniture,
            Self::Object(name) => Ground::Object(world.object(name)?.key()),
        })
    }
}
