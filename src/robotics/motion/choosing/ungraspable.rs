//! Why no hand can grasp objects of a type.

/// Why no hand can grasp objects of a type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ungraspable {
    /// An arm cannot carry them.
    TooHeavy {
        /// Mass (kg) of one, and the maximum.
        mass: f64,
        payload: f64,
    },
    /// There is nothing that fits between fingers.
    TooWide {
        /// Width (m) of the narrowest part that a hand could come at, and the maximum.
        width: f64,
        most: f64,
    },
    /// Where they fit, the surface is too slanted for friction.
    TooSlanted,
    /// Something of the object, or what it stands on, is in the way of the hand.
    NoRoom,
    /// The pads do not bear the torque of its weight.
    TooLongLever,
}

impl std::fmt::Display for Ungraspable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::TooHeavy { mass, payload } => write!(
                f,
                "too heavy by {:.1} kg: it has {mass:.1} kg, and an arm carries {payload:.1} kg",
                mass - payload
            ),
            Self::TooWide { width, most } => write!(
                f,
                "too wide by {:.0} mm: its narrowest part is {:.0} mm wide, and fingers go around {:.0} mm",
                ((width - most) * 1e3).max(1.0),
                width * 1e3,
                most * 1e3
            ),
            Self::TooSlanted => {
                f.write_str("too slanted: where fingers fit around it, they would slip off")
            }
            Self::NoRoom => f.write_str(
                "not accessible: where fingers fit around it, the object itself or what it stands on is in \
                 the way of the hand",
            ),
            Self::TooLongLever => f.write_str(
                "too unbalanced: where fingers fit around it, its weight would turn it in the hand",
            ),
        }
    }
}
