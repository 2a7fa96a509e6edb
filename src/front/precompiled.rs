//! The code of the library and the built-in plans, compiled when the program was built.

/// What the build script has written.
pub(crate) static CODE: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/precompiled"));

/// Lets the sessions of this process start from the code.
pub(crate) fn provide() {
    lisp::image::precompiled::provide(CODE);
}
