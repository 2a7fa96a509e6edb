//! The calls that are open in a fiber, as shown to the user.

use crate::image::open_call::OpenCall;
use crate::source::Place;
use crate::value::function::Body;
use crate::vm::frames::FrameKind;
use crate::vm::machine::Machine;

/// The most frames that are examined.
const MAX_FRAMES: usize = 256;

impl Machine<'_> {
    /// The open calls that can be shown to the user, innermost first.
    pub(super) fn calls(&self) -> Vec<OpenCall> {
        let frames = self.fiber.frames.iter().rev().take(MAX_FRAMES);
        frames
            .filter_map(|frame| match &frame.kind {
                FrameKind::Code { function, pc } => match &function.body {
                    Body::Closure { code, .. } => {
                        let place = code.place_at(pc.get().saturating_sub(1));
                        let subject = None;
                        let sources = &self.image.sources;
                        sources
                            .is_of_program(place)
                            .then_some(OpenCall { place, subject })
                    }
                    _ => None,
                },
                FrameKind::Native { then, .. } => then.annotation().map(|annotation| OpenCall {
                    place: Place::NONE,
                    subject: Some(annotation.subject.clone()),
                }),
                FrameKind::Over => None,
            })
            .collect()
    }
}
