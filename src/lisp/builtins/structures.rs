//! Builtins on structures.

use crate::builtin::{Builtin, Operator, pure};
use crate::structure::define::{copy_structure, define_structure, make_structure};
use crate::structure::expand::expand_defstruct;
use crate::structure::typed::define_typed_structure;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[pure(
    "COPY-STRUCTURE",
    "structure",
    "A structure of the same type with the same slot values.",
    &["(progn (defstruct spot x) (copy-structure (make-spot :x 1))) => #S(SPOT :X 1)"],
    |_, args| copy_structure(&args[0]),
)];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "%DEFINE-STRUCTURE",
        "name parent slots copier predicate documentation conc-name",
        "Defines a structure as DEFSTRUCT describes it.",
        &[],
        define_structure,
    ),
    pure(
        "%DEFINE-TYPED-STRUCTURE",
        "name elements copier predicate",
        "Defines a structure that is a list or a vector.",
        &[],
        define_typed_structure,
    ),
    pure(
        "%MAKE-STRUCTURE",
        "name &rest slot-values",
        "Makes a structure from the values of its slots in order.",
        &[],
        make_structure,
    ),
];

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[Operator {
    name: "DEFSTRUCT",
    lambda_list: "name-and-options &rest slots",
    doc: "Defines a structure with its constructor, accessors, predicate and copier. A slot is a name or (name default :type type :read-only flag); options are :conc-name :constructor :copier :predicate :include :print-function :print-object :type :named :initial-offset.",
    examples: &[
        "(progn (defstruct spot x y) (make-spot :x 1)) => #S(SPOT :X 1 :Y NIL)",
        "(progn (defstruct spot x y) (spot-x (make-spot :x 1))) => 1",
    ],
    expand: Some(expand_defstruct),
}];
