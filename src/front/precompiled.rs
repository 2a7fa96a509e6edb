//! The code of the library and the built-in plans, compiled when the program was built.

/// What the build script has written.
pub(crate) static CODE: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/precompiled"));

/// Lets all sessions that are made in this process from now on start from the library as it was compiled when
/// the program was built: each begins in about a quarter of the time (`cargo bench --bench language`), and does
/// the same, to the bit. A program calls it once, before its first [`Session`](crate::Session).
pub fn use_compiled_library() {
    lisp::image::precompiled::provide(CODE);
}
