//! The part of the plan language that is written in Lisp. For how to write the files, see
//! [`lisp::library`].

use std::sync::LazyLock;

use lisp::library::definition::File;
use lisp::library::{Library, library_file};

/// Files that need no designators; installed with the plan language.
static LANGUAGE_FILES: &[File] = &[
    library_file!("src/cram/library", "fluents.lisp"),
    library_file!("src/cram/library", "combinators.lisp"),
    library_file!("src/cram/library", "failure-handling.lisp"),
    library_file!("src/cram/library", "plans.lisp"),
    library_file!("src/cram/library", "goals.lisp"),
    library_file!("src/cram/library", "policies.lisp"),
    library_file!("src/cram/library", "suspension.lisp"),
];

/// Lazy lists, patterns, bindings and proofs, which are CRAM's utilities, and the registration of what
/// resolves locations; the loader of systems. They need nothing from the plan language.
static UTILITY_FILES: &[File] = &[
    library_file!("src/cram/library", "lazy-lists.lisp"),
    library_file!("src/cram/library", "patterns.lisp"),
    library_file!("src/cram/library", "proofs.lisp"),
    library_file!("src/cram/library", "locations.lisp"),
    library_file!("src/cram/library", "systems.lisp"),
    library_file!("src/cram/library", "absent-systems.lisp"),
    library_file!("src/cram/library", "system-files.lisp"),
    library_file!("src/cram/library", "system-tests.lisp"),
    library_file!("src/cram/library", "system-definitions.lisp"),
    library_file!("src/cram/library", "uiop.lisp"),
    library_file!("src/cram/library", "threads.lisp"),
];

/// Files that need designators; installed after those.
static DESIGNATOR_FILES: &[File] = &[
    library_file!("src/cram/library", "process-modules.lisp"),
    library_file!("src/cram/library", "tracing.lisp"),
];

/// The library of the plan language.
pub(super) static LANGUAGE: LazyLock<Library> = LazyLock::new(|| Library::of(LANGUAGE_FILES));

/// The library of CRAM's utilities.
pub(super) static UTILITIES: LazyLock<Library> = LazyLock::new(|| Library::of(UTILITY_FILES));

/// The library of plans with designators.
pub(super) static DESIGNATORS: LazyLock<Library> = LazyLock::new(|| Library::of(DESIGNATOR_FILES));
