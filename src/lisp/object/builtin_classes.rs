//! The classes of values that are not instances, and the roots of all others.

use crate::image::Image;
use crate::value::class::ClassKind;
use crate::value::package::PackageTable;

use super::define::ClassDefinition;

use ClassKind::{Builtin, Standard, Structure};

/// Name, kind and direct superclasses; superclasses come before their subclasses. A name that
/// begins with `%` belongs to the package `SYSTEM` (without the sign).
const TABLE: &[(&str, ClassKind, &[&str])] = &[
    ("T", Builtin, &[]),
    ("STANDARD-OBJECT", Standard, &["T"]),
    ("STRUCTURE-OBJECT", Structure, &["T"]),
    ("SYMBOL", Builtin, &["T"]),
    ("KEYWORD", Builtin, &["SYMBOL"]),
    ("SEQUENCE", Builtin, &["T"]),
    ("LIST", Builtin, &["SEQUENCE"]),
    ("CONS", Builtin, &["LIST"]),
    ("NULL", Builtin, &["SYMBOL", "LIST"]),
    ("NUMBER", Builtin, &["T"]),
    ("COMPLEX", Builtin, &["NUMBER"]),
    ("REAL", Builtin, &["NUMBER"]),
    ("FLOAT", Builtin, &["REAL"]),
    ("SINGLE-FLOAT", Builtin, &["FLOAT"]),
    ("DOUBLE-FLOAT", Builtin, &["FLOAT"]),
    ("RATIONAL", Builtin, &["REAL"]),
    ("RATIO", Builtin, &["RATIONAL"]),
    ("INTEGER", Builtin, &["RATIONAL"]),
    ("FIXNUM", Builtin, &["INTEGER"]),
    ("BIGNUM", Builtin, &["INTEGER"]),
    ("CHARACTER", Builtin, &["T"]),
    ("ARRAY", Builtin, &["T"]),
    ("SIMPLE-ARRAY", Builtin, &["ARRAY"]),
    ("VECTOR", Builtin, &["ARRAY", "SEQUENCE"]),
    ("SIMPLE-VECTOR", Builtin, &["VECTOR", "SIMPLE-ARRAY"]),
    ("BIT-VECTOR", Builtin, &["VECTOR"]),
    (
        "SIMPLE-BIT-VECTOR",
        Builtin,
        &["BIT-VECTOR", "SIMPLE-ARRAY"],
    ),
    ("STRING", Builtin, &["VECTOR"]),
    ("SIMPLE-STRING", Builtin, &["STRING", "SIMPLE-ARRAY"]),
    ("FUNCTION", Builtin, &["T"]),
    ("COMPILED-FUNCTION", Builtin, &["FUNCTION"]),
    (
        "GENERIC-FUNCTION",
        Standard,
        &["FUNCTION", "STANDARD-OBJECT"],
    ),
    ("STANDARD-GENERIC-FUNCTION", Standard, &["GENERIC-FUNCTION"]),
    ("METHOD", Standard, &["STANDARD-OBJECT"]),
    ("STANDARD-METHOD", Standard, &["METHOD"]),
    ("METHOD-COMBINATION", Standard, &["STANDARD-OBJECT"]),
    ("CLASS", Standard, &["STANDARD-OBJECT"]),
    ("BUILT-IN-CLASS", Standard, &["CLASS"]),
    ("STANDARD-CLASS", Standard, &["CLASS"]),
    ("STRUCTURE-CLASS", Standard, &["CLASS"]),
    ("%CONDITION-CLASS", Standard, &["CLASS"]),
    ("HASH-TABLE", Builtin, &["T"]),
    ("PACKAGE", Builtin, &["T"]),
    ("STREAM", Builtin, &["T"]),
    ("STRING-STREAM", Builtin, &["STREAM"]),
    ("SYNONYM-STREAM", Builtin, &["STREAM"]),
    ("BROADCAST-STREAM", Builtin, &["STREAM"]),
    ("CONCATENATED-STREAM", Builtin, &["STREAM"]),
    ("TWO-WAY-STREAM", Builtin, &["STREAM"]),
    ("ECHO-STREAM", Builtin, &["STREAM"]),
    ("FILE-STREAM", Builtin, &["STREAM"]),
    ("%ENVIRONMENT", Builtin, &["T"]),
    ("PATHNAME", Builtin, &["T"]),
    ("LOGICAL-PATHNAME", Builtin, &["PATHNAME"]),
    ("RANDOM-STATE", Builtin, &["T"]),
    ("READTABLE", Builtin, &["T"]),
    ("RESTART", Builtin, &["T"]),
];

impl Image {
    /// Defines the builtin classes, the roots of standard objects and structures, and the
    /// standard conditions. Done once, in a new image.
    pub(crate) fn define_standard_classes(&mut self) {
        for (name, kind, superclasses) in TABLE {
            let name = self.class_symbol(name);
            let superclasses = superclasses.iter().map(|s| self.class_symbol(s)).collect();
            // The table is consistent: each superclass is defined above.
            let _ = self.define_unchecked(ClassDefinition {
                name,
                kind: *kind,
                superclasses,
                slots: Vec::new(),
                default_initargs: Vec::new(),
                doc: None,
            });
        }
    }

    /// The symbol of a table entry: in `COMMON-LISP`, or in `SYSTEM` if marked by `%`.
    pub fn class_symbol(&mut self, name: &str) -> crate::Sym {
        match name.strip_prefix('%') {
            Some(name) => self.export_symbol(PackageTable::SYSTEM, name),
            None => self.export_symbol(PackageTable::CL, name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::testing;

    #[test]
    fn every_class_of_the_table_ends_in_t() {
        let mut image = testing::image();
        for (name, _, _) in TABLE {
            let sym = image.class_symbol(name);
            let class = image.class(sym).cloned();
            let last = class.and_then(|c| c.precedence.borrow().last().map(|c| c.name));
            assert_eq!(last, Some(crate::value::known::T), "{name}");
        }
    }
}
