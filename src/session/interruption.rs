//! How the searches of the robot are interrupted by the image's interrupts.

use std::sync::Arc;

use lisp::image::Image;
use robotics::motion::interruption::Interruption;

/// What ends a search for this image, and what it does meanwhile.
pub(crate) fn interruption(image: &Image) -> Interruption {
    Interruption {
        flag: Arc::clone(image.interrupt()),
        breathe: image.polls().breathe(),
    }
}
