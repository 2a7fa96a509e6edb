//! An object that is too heavy for an arm.

use std::fmt;

use serde::Serialize;

use crate::robot::Side;

/// An object that is too heavy for the arm that lifts it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Overload {
    /// Name of the object.
    pub object: String,
    /// Its mass (kg).
    pub mass: f64,
    /// The arm.
    pub side: Side,
    /// What is exceeded.
    pub limit: PayloadLimit,
}

/// What limits the load of an arm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum PayloadLimit {
    /// The mass (kg) that its maker allows.
    Maker(f64),
    /// The torque that the pads of the fingers transmit in the present posture.
    Grip {
        /// The torque (Nm) that the load exerts.
        torque: f64,
        /// The greatest torque (Nm) that they transmit.
        limit: f64,
    },
    /// The torque of a joint in the present posture.
    Joint {
        /// Name of the joint.
        joint: String,
        /// The torque (Nm) that the load exerts.
        torque: f64,
        /// The greatest torque (Nm) of the joint's motor, from the URDF.
        effort: f64,
    },
}

impl fmt::Display for Overload {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            object,
            mass,
            side,
            limit,
        } = self;
        write!(
            f,
            "{object} is too heavy for the {side} arm: it has {mass} kg, "
        )?;
        match limit {
            PayloadLimit::Maker(payload) => {
                write!(f, "and the maker of the arm allows {payload} kg")
            }
            PayloadLimit::Grip { torque, limit } => write!(
                f,
                "which where it is held takes {torque:.1} Nm, and the pads of the fingers transmit \
                 {limit:.1} Nm"
            ),
            PayloadLimit::Joint {
                joint,
                torque,
                effort,
            } => write!(
                f,
                "which in this posture takes {torque:.1} Nm of {joint}, whose limit is {effort:.1} Nm"
            ),
        }
    }
}
