//! Who keeps the inputs of a session.

use session::dialogue::Serve;

/// Keeps inputs, so that the session can be resumed.
pub(crate) trait Keep {
    /// The evaluation of an input begins.
    fn begins(&mut self, text: &str);

    /// The evaluation has ended.
    fn ends(&mut self, session: &dyn Serve);
}
