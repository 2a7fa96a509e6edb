//! A place for the base of the robot.

/// A pose of the base: x (m), y (m), heading (rad, not wrapped) in the map frame.
pub type BasePlace = [f64; 3];
