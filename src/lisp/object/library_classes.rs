//! Classes of packages beside `COMMON-LISP`: streams whose elements come from methods of a program,
//! and what describes slots and specializers.

use crate::image::Image;
use crate::value::Value;
use crate::value::class::{ClassKind, Initform, SlotDefinition};
use crate::value::package::{PackageId, PackageTable};
use crate::value::symbol::Sym;

use super::define::ClassDefinition;

/// Name, direct superclasses and slots; superclasses come before their subclasses.
type Row = (
    &'static str,
    &'static [&'static str],
    &'static [&'static str],
);

/// The package of streams that are objects.
pub(crate) const STREAMS: &str = "GRAY-STREAMS";

/// The packages, with other names and classes. Superclasses that a package does not have itself are
/// those of `COMMON-LISP`.
const PACKAGES: &[(&str, &[&str], &[Row])] = &[
    (
        STREAMS,
        &["TRIVIAL-GRAY-STREAMS", "GRAY"],
        &[
            (
                "FUNDAMENTAL-STREAM",
                &["STANDARD-OBJECT", "STREAM"],
                &["IS-CLOSED"],
            ),
            ("FUNDAMENTAL-INPUT-STREAM", &["FUNDAMENTAL-STREAM"], &[]),
            ("FUNDAMENTAL-OUTPUT-STREAM", &["FUNDAMENTAL-STREAM"], &[]),
            ("FUNDAMENTAL-CHARACTER-STREAM", &["FUNDAMENTAL-STREAM"], &[]),
            ("FUNDAMENTAL-BINARY-STREAM", &["FUNDAMENTAL-STREAM"], &[]),
            (
                "FUNDAMENTAL-CHARACTER-INPUT-STREAM",
                &["FUNDAMENTAL-INPUT-STREAM", "FUNDAMENTAL-CHARACTER-STREAM"],
                &[],
            ),
            (
                "FUNDAMENTAL-CHARACTER-OUTPUT-STREAM",
                &["FUNDAMENTAL-OUTPUT-STREAM", "FUNDAMENTAL-CHARACTER-STREAM"],
                &[],
            ),
            (
                "FUNDAMENTAL-BINARY-INPUT-STREAM",
                &["FUNDAMENTAL-INPUT-STREAM", "FUNDAMENTAL-BINARY-STREAM"],
                &[],
            ),
            (
                "FUNDAMENTAL-BINARY-OUTPUT-STREAM",
                &["FUNDAMENTAL-OUTPUT-STREAM", "FUNDAMENTAL-BINARY-STREAM"],
                &[],
            ),
            ("TRIVIAL-GRAY-STREAM-MIXIN", &["STANDARD-OBJECT"], &[]),
            (
                "OBJECT-TWO-WAY-STREAM",
                &[
                    "FUNDAMENTAL-CHARACTER-INPUT-STREAM",
                    "FUNDAMENTAL-CHARACTER-OUTPUT-STREAM",
                    "TWO-WAY-STREAM",
                ],
                &["INPUT", "OUTPUT"],
            ),
            (
                "OBJECT-BROADCAST-STREAM",
                &["FUNDAMENTAL-CHARACTER-OUTPUT-STREAM", "BROADCAST-STREAM"],
                &["OUTPUTS"],
            ),
        ],
    ),
    (
        "CLOSER-MOP",
        &["C2MOP"],
        &[
            (
                "SLOT-DEFINITION",
                &["STANDARD-OBJECT"],
                &[
                    "NAME",
                    "INITARGS",
                    "INITFUNCTION",
                    "TYPE",
                    "ALLOCATION",
                    "DOCUMENTATION",
                ],
            ),
            (
                "DIRECT-SLOT-DEFINITION",
                &["SLOT-DEFINITION"],
                &["READERS", "WRITERS"],
            ),
            (
                "EFFECTIVE-SLOT-DEFINITION",
                &["SLOT-DEFINITION"],
                &["LOCATION"],
            ),
            (
                "STANDARD-DIRECT-SLOT-DEFINITION",
                &["DIRECT-SLOT-DEFINITION"],
                &[],
            ),
            (
                "STANDARD-EFFECTIVE-SLOT-DEFINITION",
                &["EFFECTIVE-SLOT-DEFINITION"],
                &[],
            ),
            ("EQL-SPECIALIZER", &["STANDARD-OBJECT"], &["OBJECT"]),
        ],
    ),
    ("TRIVIAL-GARBAGE", &["TG"], &[]),
];

impl Image {
    /// Makes the packages and their classes. Done once, in a new image, after the standard classes.
    pub(crate) fn define_library_classes(&mut self) {
        for (name, nicknames, rows) in PACKAGES {
            let Some(package) = self.packages.make(name, nicknames) else {
                continue;
            };
            self.packages.use_package(package, PackageTable::CL);
            for row in *rows {
                self.define_library_class(package, row);
            }
        }
    }

    fn define_library_class(&mut self, package: PackageId, (name, superclasses, slots): &Row) {
        let superclasses = superclasses.iter().map(|s| self.intern(package, s));
        let superclasses = superclasses.collect();
        let slots = slots.iter().map(|slot| SlotDefinition {
            initargs: vec![self.keyword(slot)],
            initform: Some(Initform::Value(Value::NIL)),
            ..SlotDefinition::new(self.slot_symbol(package, slot))
        });
        let slots = slots.collect();
        let name = self.export_symbol(package, name);
        // The table is consistent: each superclass is defined above.
        let _ = self.define_unchecked(ClassDefinition {
            name,
            kind: ClassKind::Standard,
            superclasses,
            slots,
            default_initargs: Vec::new(),
            doc: None,
        });
    }

    /// The symbol that the library's files read as the name of a slot.
    fn slot_symbol(&mut self, package: PackageId, name: &str) -> Sym {
        match self.packages.find_symbol(package, name) {
            Some((sym, _)) => sym,
            None => self.intern(PackageTable::SYSTEM, name),
        }
    }

    /// May a program add methods to the functions of a symbol because it belongs to the streams?
    pub(crate) fn is_stream_function(&self, sym: Sym) -> bool {
        let package = self.symbols.get(sym).package;
        package.is_some() && package == self.packages.find(STREAMS)
    }
}
