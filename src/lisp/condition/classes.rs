//! The standard condition classes.

use crate::image::Image;
use crate::object::define::ClassDefinition;
use crate::value::Value;
use crate::value::class::{ClassKind, Initform, SlotDefinition};
use crate::value::known;
use crate::value::package::PackageTable;

/// One condition class.
struct Entry {
    /// The name; `%` marks one of the package `SYSTEM`.
    name: &'static str,
    /// Direct superclasses, defined before it.
    superclasses: &'static [&'static str],
    /// Slots. The initarg is the keyword of the same name; `?` marks a slot that is
    /// unbound unless given, others begin as `NIL`.
    slots: &'static [&'static str],
}

const fn entry(
    name: &'static str,
    superclasses: &'static [&'static str],
    slots: &'static [&'static str],
) -> Entry {
    Entry {
        name,
        superclasses,
        slots,
    }
}

/// All standard conditions, and those that only this implementation has: the name of each of the
/// latter ends in the name of the standard condition by which programs handle it.
const TABLE: &[Entry] = &[
    entry("CONDITION", &["T"], &["REPORT"]),
    entry("WARNING", &["CONDITION"], &[]),
    entry("SERIOUS-CONDITION", &["CONDITION"], &[]),
    entry("ERROR", &["SERIOUS-CONDITION"], &[]),
    entry("STORAGE-CONDITION", &["SERIOUS-CONDITION"], &[]),
    entry("STYLE-WARNING", &["WARNING"], &[]),
    entry(
        "SIMPLE-CONDITION",
        &["CONDITION"],
        &["FORMAT-CONTROL", "FORMAT-ARGUMENTS"],
    ),
    entry("SIMPLE-ERROR", &["SIMPLE-CONDITION", "ERROR"], &[]),
    entry("SIMPLE-WARNING", &["SIMPLE-CONDITION", "WARNING"], &[]),
    entry("TYPE-ERROR", &["ERROR"], &["?DATUM", "?EXPECTED-TYPE"]),
    entry(
        "SIMPLE-TYPE-ERROR",
        &["SIMPLE-CONDITION", "TYPE-ERROR"],
        &[],
    ),
    entry("CELL-ERROR", &["ERROR"], &["?NAME"]),
    entry("UNBOUND-VARIABLE", &["CELL-ERROR"], &[]),
    entry("UNDEFINED-FUNCTION", &["CELL-ERROR"], &[]),
    entry("UNBOUND-SLOT", &["CELL-ERROR"], &["?INSTANCE"]),
    entry("CONTROL-ERROR", &["ERROR"], &[]),
    entry("PROGRAM-ERROR", &["ERROR"], &[]),
    entry("ARITHMETIC-ERROR", &["ERROR"], &["OPERATION", "OPERANDS"]),
    entry("DIVISION-BY-ZERO", &["ARITHMETIC-ERROR"], &[]),
    entry("FLOATING-POINT-OVERFLOW", &["ARITHMETIC-ERROR"], &[]),
    entry("FLOATING-POINT-UNDERFLOW", &["ARITHMETIC-ERROR"], &[]),
    entry("FLOATING-POINT-INEXACT", &["ARITHMETIC-ERROR"], &[]),
    entry(
        "FLOATING-POINT-INVALID-OPERATION",
        &["ARITHMETIC-ERROR"],
        &[],
    ),
    entry("PARSE-ERROR", &["ERROR"], &[]),
    entry("STREAM-ERROR", &["ERROR"], &["?STREAM"]),
    entry("END-OF-FILE", &["STREAM-ERROR"], &[]),
    entry("READER-ERROR", &["PARSE-ERROR", "STREAM-ERROR"], &[]),
    entry("PACKAGE-ERROR", &["ERROR"], &["?PACKAGE"]),
    entry("FILE-ERROR", &["ERROR"], &["?PATHNAME"]),
    entry("PRINT-NOT-READABLE", &["ERROR"], &["?OBJECT"]),
    entry(
        "%SIMPLE-PROGRAM-ERROR",
        &["SIMPLE-CONDITION", "PROGRAM-ERROR"],
        // The function that was called with a wrong number of arguments.
        &["?NAME"],
    ),
    entry(
        "%SIMPLE-CONTROL-ERROR",
        &["SIMPLE-CONDITION", "CONTROL-ERROR"],
        &[],
    ),
    entry(
        "%SIMPLE-READER-ERROR",
        &["READER-ERROR", "SIMPLE-CONDITION"],
        &[],
    ),
    entry(
        "%READER-PACKAGE-ERROR",
        &["READER-ERROR", "PACKAGE-ERROR"],
        &[],
    ),
    entry(
        "%SIMPLE-PARSE-ERROR",
        &["SIMPLE-CONDITION", "PARSE-ERROR"],
        &[],
    ),
    entry(
        "%SIMPLE-PACKAGE-ERROR",
        &["SIMPLE-CONDITION", "PACKAGE-ERROR"],
        &[],
    ),
    entry(
        "%SIMPLE-STYLE-WARNING",
        &["SIMPLE-CONDITION", "STYLE-WARNING"],
        &[],
    ),
    entry(
        "%SIMPLE-FILE-ERROR",
        &["SIMPLE-CONDITION", "FILE-ERROR"],
        &[],
    ),
    entry("%ARG-COUNT-ERROR", &["PROGRAM-ERROR"], &[]),
    entry(
        "%CASE-TYPE-ERROR",
        &["TYPE-ERROR"],
        &["?NAME", "?POSSIBILITIES"],
    ),
    entry("%INDEX-TYPE-ERROR", &["TYPE-ERROR"], &[]),
    entry("%ARRAY-INDEX-TYPE-ERROR", &["TYPE-ERROR"], &[]),
    entry("%BOUNDING-INDICES-TYPE-ERROR", &["TYPE-ERROR"], &[]),
    entry("%STACK-STORAGE-CONDITION", &["STORAGE-CONDITION"], &[]),
    entry(
        "%HEAP-EXHAUSTED-ERROR",
        &["ERROR", "STORAGE-CONDITION"],
        &[],
    ),
    entry(
        "%NO-APPLICABLE-METHOD-ERROR",
        &["ERROR"],
        &["GENERIC-FUNCTION", "ARGUMENTS"],
    ),
    entry(
        "%NO-NEXT-METHOD-ERROR",
        &["ERROR"],
        &["METHOD", "ARGUMENTS"],
    ),
    entry("%CLASS-NOT-FOUND-ERROR", &["CELL-ERROR"], &[]),
    entry(
        "%LOCKED-PACKAGE-ERROR",
        &["SIMPLE-CONDITION", "PACKAGE-ERROR"],
        // The symbol whose meaning would change.
        &["?NAME"],
    ),
    entry("%FORMAT-ERROR", &["ERROR"], &[]),
    entry("%COMPILED-PROGRAM-ERROR", &["PROGRAM-ERROR"], &[]),
    entry("%INTERACTIVE-INTERRUPT", &["SERIOUS-CONDITION"], &[]),
];

/// Defines all standard conditions in an image.
pub fn define(image: &mut Image) {
    for entry in TABLE {
        let name = image.class_symbol(entry.name);
        let superclasses = entry
            .superclasses
            .iter()
            .map(|s| image.class_symbol(s))
            .collect();
        let slots = entry.slots.iter().map(|s| slot(image, s)).collect();
        // The table is consistent: each superclass is defined above.
        let _ = image.define_unchecked(ClassDefinition {
            name,
            kind: ClassKind::Condition,
            superclasses,
            slots,
            default_initargs: Vec::new(),
            doc: None,
        });
    }
}

fn slot(image: &mut Image, name: &str) -> SlotDefinition {
    let (name, initform) = match name.strip_prefix('?') {
        Some(name) => (name, None),
        None => (name, Some(Initform::Value(Value::NIL))),
    };
    // A name that `COMMON-LISP` already has, such as STREAM, is that symbol.
    let sym = match image.packages.find_symbol(PackageTable::CL, name) {
        Some((sym, _)) => sym,
        None => image.export_symbol(PackageTable::SYSTEM, name),
    };
    let mut slot = SlotDefinition::new(sym);
    slot.initargs.push(image.keyword(name));
    slot.initform = if sym == known::REPORT { None } else { initform };
    slot
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::testing;

    #[test]
    fn a_simple_program_error_is_a_program_error_and_a_simple_condition() {
        let image = testing::image();
        let class = image.class(known::SIMPLE_PROGRAM_ERROR).cloned();
        let class = class.expect("defined");
        assert!(class.is_subclass_of(known::PROGRAM_ERROR));
        assert!(class.is_subclass_of(known::SIMPLE_CONDITION));
        assert!(class.is_subclass_of(known::ERROR));
        assert!(!class.is_subclass_of(known::WARNING));
    }

    #[test]
    fn every_condition_descends_from_condition() {
        let mut image = testing::image();
        for entry in TABLE {
            let name = image.class_symbol(entry.name);
            let class = image.class(name).cloned().expect("defined");
            assert!(class.is_subclass_of(known::CONDITION), "{}", entry.name);
        }
    }
}
