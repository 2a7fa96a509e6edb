//! What is written of the engine's state so that it takes little memory.

use std::sync::Arc;

use rapier3d_f64::dynamics::{CCDSolver, MultibodyJointSet, SoftBodySet};
use rapier3d_f64::geometry::SharedShape;
use serde::{Deserialize, Serialize};

use super::Sets;
use crate::world::packing::{PackingError, Reader, Writer};

/// The enumeration as which the engine writes shapes. They are left out, and kept shared.
pub(crate) const LEFT_OUT: &str = "TypedShape";
/// The same as it is read.
pub(crate) const LEFT_OUT_AS_READ: &str = "DeserializableTypedShape";

/// The shapes of all colliders, in the order in which these are written.
pub(crate) type Shapes = Arc<[SharedShape]>;

impl Sets {
    /// Whether what is written says everything: joints that were made or removed since the last step are not yet among
    /// what the engine writes.
    pub(crate) fn can_be_packed(&self) -> bool {
        !self.has_new_joints
    }

    /// The shapes of the colliders: those that are known, if they are the same.
    pub(crate) fn shapes(&self, known: &Shapes) -> Shapes {
        let own = || self.colliders.iter().map(|(_, c)| c.shared_shape());
        let is_known = own().len() == known.len()
            && own()
                .zip(known.iter())
                .all(|(own, known)| Arc::ptr_eq(&own.0, &known.0));
        match is_known {
            true => Arc::clone(known),
            false => own().cloned().collect(),
        }
    }

    /// Writes everything but the shapes. There are neither multibodies nor soft bodies; what else the engine does not
    /// write it calculates anew in each step.
    pub(crate) fn write(&self, writer: &mut Writer<'_>) -> Result<(), PackingError> {
        self.bodies.serialize(&mut *writer)?;
        self.colliders.serialize(&mut *writer)?;
        self.islands.serialize(&mut *writer)?;
        self.broad_phase.serialize(&mut *writer)?;
        self.narrow_phase.serialize(&mut *writer)?;
        self.impulse_joints.serialize(&mut *writer)?;
        self.is_edited.serialize(&mut *writer)
    }

    /// Reads what [`Sets::write`] has written.
    pub(crate) fn read(reader: &mut Reader<'_>) -> Result<Self, PackingError> {
        Ok(Self {
            bodies: Deserialize::deserialize(&mut *reader)?,
            colliders: Deserialize::deserialize(&mut *reader)?,
            islands: Deserialize::deserialize(&mut *reader)?,
            broad_phase: Deserialize::deserialize(&mut *reader)?,
            narrow_phase: Deserialize::deserialize(&mut *reader)?,
            impulse_joints: Deserialize::deserialize(&mut *reader)?,
            multibody_joints: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd_solver: CCDSolver::new(),
            is_edited: Deserialize::deserialize(&mut *reader)?,
            has_new_joints: false,
        })
    }
}
