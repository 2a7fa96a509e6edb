//! Builtins on structures.

use crate::builtin::{Builtin, Operator};
use crate::image::Image;
use crate::structure::define::{copy_structure, define_structure, make_structure};
use crate::structure::expand::expand_defstruct;
use crate::structure::typed::define_typed_structure;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::raise::Raise;

/// A structure of the same type with the same slot values.
///
/// `(progn (defstruct spot x) (copy-structure (make-spot :x 1)))` => `#S(SPOT :X 1)`
#[builtin("COPY-STRUCTURE")]
fn copy_structure_builtin(structure: &Value) -> Result<Value, Box<Raise>> {
    copy_structure(structure)
}

/// Defines a structure as DEFSTRUCT describes it.
#[builtin(
    "%DEFINE-STRUCTURE",
    "name parent slots copier predicate documentation conc-name"
)]
fn define_structure_builtin(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    define_structure(image, args)
}

/// Defines a structure that is a list or a vector.
#[builtin("%DEFINE-TYPED-STRUCTURE", "name elements copier predicate")]
fn define_typed_structure_builtin(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    define_typed_structure(image, args)
}

/// Makes a structure from the values of its slots in order.
#[builtin("%MAKE-STRUCTURE", "name &rest slot-values")]
fn make_structure_builtin(image: &mut Image, slot_values: &[Value]) -> Result<Value, Box<Raise>> {
    make_structure(image, slot_values)
}

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

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![copy_structure_builtin,];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    define_structure_builtin,
    define_typed_structure_builtin,
    make_structure_builtin,
];
