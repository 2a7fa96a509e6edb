//! How the PR2 looks.

use super::look::Look;

/// Name of the robot that looks like this.
pub(super) const NAME: &str = "pr2";

/// The looks of a link; none for one that looks as its model says.
pub(super) fn looks_of(_link: &str) -> Option<Vec<Look>> {
    None
}
