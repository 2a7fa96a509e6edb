//! Who keeps the inputs of a session.

use session::dialogue::Serve;

/// Keeps inputs, so that the session can be resumed.
pub(crate) trait Keep {
    /// The evaluation of an input begins.
    fn begins(&mut self, text: &str, session: &mut dyn Serve);

    /// The evaluation has ended.
    fn ends(&mut self, session: &mut dyn Serve);
}
