//! Lets plans drive a robot over ROS 2, if the program was built so.

#[cfg(feature = "ros2")]
mod desk;
#[cfg(feature = "ros2")]
mod end;
#[cfg(feature = "ros2")]
mod goal_message;
#[cfg(feature = "ros2")]
mod link;

#[cfg(feature = "ros2")]
pub(crate) use link::{Driving, connect};

#[cfg(not(feature = "ros2"))]
pub(crate) use without::{Driving, connect};

/// Without the feature.
#[cfg(not(feature = "ros2"))]
mod without {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use super::super::failure::CommandError;
    use super::super::ros2;
    use session::Session;

    /// Nothing can be driven.
    pub(crate) enum Driving {}

    impl Driving {
        /// There is nothing to stop.
        pub(crate) fn halt(&self) -> Arc<AtomicBool> {
            match *self {}
        }
    }

    /// Refuses.
    pub(crate) fn connect(_: &mut Session, _: &str) -> Result<Driving, CommandError> {
        Err(ros2::missing())
    }
}
