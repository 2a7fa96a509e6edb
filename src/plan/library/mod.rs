//! The part of the plan language that is written in Lisp: the same kind of files as in
//! [`crate::lisp::library`], which says how to write them.

use std::sync::LazyLock;

use crate::lisp::library::definition::File;
use crate::lisp::library::{Library, library_file};

/// What needs no designators; installed with the plan language.
static LANGUAGE_FILES: &[File] = &[library_file!("src/plan/library", "policies.lisp")];

/// What needs designators; installed after them.
static DESIGNATOR_FILES: &[File] = &[library_file!("src/plan/library", "process-modules.lisp")];

/// The library of the plan language.
pub(super) static LANGUAGE: LazyLock<Library> = LazyLock::new(|| Library::of(LANGUAGE_FILES));

/// The library of plans with designators.
pub(super) static DESIGNATORS: LazyLock<Library> = LazyLock::new(|| Library::of(DESIGNATOR_FILES));
