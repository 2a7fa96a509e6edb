//! What the robot touches: its hands and what they hold, the contacts that a motion expects, and the
//! guard over every step.

pub(crate) mod expected_contacts;
pub(crate) mod grip_torque;
pub(crate) mod guard;
pub(crate) mod hand;
pub(crate) mod holding;
pub(crate) mod level;
mod payload;
pub(crate) mod pushing;
pub(crate) mod touching;
