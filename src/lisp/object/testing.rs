//! A small image for the tests of this layer.

use indexmap::IndexMap;
use rand_pcg::Pcg64;

use crate::lisp::image::{Image, Output};
use crate::lisp::known;
use crate::lisp::package::PackageTable;
use crate::lisp::symbol::SymbolTable;
use crate::lisp::value::Value;
use crate::reader::source::Sources;

/// An image with the known symbols and the standard classes, without functions.
pub fn image() -> Image {
    let mut symbols = SymbolTable::new();
    let mut packages = PackageTable::default();
    for name in ["COMMON-LISP", "KEYWORD", "COMMON-LISP-USER", "SYSTEM"] {
        let _ = packages.make(name, &[]);
    }
    known::intern_all(&mut symbols, &mut packages);
    packages.use_package(PackageTable::USER, PackageTable::CL);
    let mut image = Image {
        symbols,
        packages,
        classes: IndexMap::new(),
        types: IndexMap::new(),
        sources: Sources::default(),
        output: Output::default(),
        random: Pcg64::new(1, 1),
        builtins: IndexMap::new(),
        operators: IndexMap::new(),
        identities: Default::default(),
    };
    image.define_special(known::V_PACKAGE, Value::Package(PackageTable::USER));
    image.define_standard_classes();
    image
}
