//! The functions of the plan language, by topic.

mod arithmetic;
mod code_search;
pub mod combinators;
mod common;
mod companions;
mod failures;
mod fluents;
mod handlers;
mod networks;
mod policies;
mod tasks;
mod trace;
mod tree;

use lisp::builtin::Builtin;

/// Functions of package `CRAM-LANGUAGE-IMPLEMENTATION`, which `CRAM-LANGUAGE` exports, too.
pub static FUNCTIONS: &[&[Builtin]] = &[
    failures::TABLE,
    fluents::TABLE,
    networks::TABLE,
    policies::TABLE,
    tasks::TABLE,
    tree::TABLE,
];

/// Functions of package `CRAM-LANGUAGE` itself, which replace those of Common Lisp.
pub static LANGUAGE: &[&[Builtin]] = &[arithmetic::TABLE];

/// Functions of package `PLAN-SYSTEM`.
pub static SYSTEM: &[&[Builtin]] = &[
    code_search::SYSTEM_TABLE,
    combinators::SYSTEM_TABLE,
    companions::SYSTEM_TABLE,
    handlers::SYSTEM_TABLE,
    policies::SYSTEM_TABLE,
    tasks::SYSTEM_TABLE,
    trace::SYSTEM_TABLE,
    tree::SYSTEM_TABLE,
];

/// What `setf` calls for places in the plan language.
pub(crate) static SETTERS: &[&[Builtin]] = &[fluents::SETTERS];

/// Functions of package `COMMON-LISP` that need the scheduler.
pub(crate) static COMMON_LISP: &[Builtin] = common::TABLE;

/// The clock, which the library of the language asks for the time.
pub(crate) static CLOCK: &[Builtin] = common::CLOCK;
