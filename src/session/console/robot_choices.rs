//! Ways to go on that are aimed at the robot.

use super::choices::Choice;
use crate::session::Session;

impl Session {
    /// What can be chosen about the actions that are being carried out, with labels.
    pub(super) fn robot_choices(&mut self) -> Vec<(Choice, String)> {
        Vec::new()
    }
}
