//! The stacks of the threads that evaluate.

/// Bytes of stack for a thread: the compiler recurses as deep as forms are nested.
pub(super) const THREAD_STACK: usize = 64 << 20;

/// Bytes of it for nested forms.
pub(super) const COMPILER_STACK: usize = 48 << 20;
