//! A small image for unit tests: the known symbols and the printer's variables.

use indexmap::IndexMap;

use crate::lisp::image::{Image, Output};
use crate::lisp::known;
use crate::lisp::package::PackageTable;
use crate::lisp::symbol::SymbolTable;
use crate::lisp::value::Value;

/// An image without functions, in `COMMON-LISP-USER`.
pub(crate) fn image() -> Image {
    let mut symbols = SymbolTable::new();
    let mut packages = PackageTable::default();
    packages.make("COMMON-LISP", &["CL"]);
    packages.make("KEYWORD", &[]);
    packages.make("COMMON-LISP-USER", &["CL-USER"]);
    packages.make("SYSTEM", &["SYS"]);
    packages.use_package(PackageTable::USER, PackageTable::CL);
    known::intern_all(&mut symbols, &mut packages);
    let mut image = Image {
        symbols,
        packages,
        classes: IndexMap::new(),
        types: IndexMap::new(),
        sources: Default::default(),
        output: Output::default(),
        random: rand_pcg::Pcg64::new(1, 1),
        builtins: IndexMap::new(),
        operators: IndexMap::new(),
        identities: Default::default(),
    };
    image.define_constant(known::NIL, Value::NIL);
    image.define_constant(known::T, Value::T);
    for (variable, value) in [
        (known::V_PACKAGE, Value::Package(PackageTable::USER)),
        (known::V_PRINT_ESCAPE, Value::T),
        (known::V_PRINT_PRETTY, Value::T),
        (known::V_PRINT_BASE, Value::Int(10)),
        (known::V_PRINT_RADIX, Value::NIL),
        (known::V_PRINT_CASE, Value::Symbol(known::K_UPCASE)),
        (known::V_PRINT_LENGTH, Value::NIL),
        (known::V_PRINT_LEVEL, Value::NIL),
        (known::V_PRINT_CIRCLE, Value::NIL),
        (known::V_PRINT_GENSYM, Value::T),
        (known::V_PRINT_ARRAY, Value::T),
        (known::V_PRINT_READABLY, Value::NIL),
        (known::V_PRINT_LINES, Value::NIL),
        (known::V_PRINT_RIGHT_MARGIN, Value::NIL),
        (known::V_PRINT_MISER_WIDTH, Value::NIL),
        (known::V_READ_BASE, Value::Int(10)),
        (
            known::V_READ_DEFAULT_FLOAT_FORMAT,
            Value::Symbol(known::SINGLE_FLOAT),
        ),
        (known::V_READ_EVAL, Value::T),
        (known::V_FEATURES, Value::NIL),
    ] {
        image.define_special(variable, value);
    }
    image
}
