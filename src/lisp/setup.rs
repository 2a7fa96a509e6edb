//! A new image: standard packages, classes, variables, functions and macros.

use std::rc::Rc;

use super::builtins::{implementation, number_constants, number_theory, readtables, registry};
use super::condition;
use super::image::{Image, precompiled};
use super::library;
use super::stream;
use super::value::Value;
use super::value::hash_table::{HashTable, HashTest};
use super::value::known;
use super::value::package::PackageTable;
use super::value::symbol::Sym;

impl Image {
    /// The image that sessions start with, in `COMMON-LISP-USER`.
    pub fn new() -> Image {
        let mut image = Image::bare();
        image.library.precompiled = precompiled::provided();
        image.set_up();
        image
    }

    /// The same, made of the texts of the library; it keeps what they are compiled to.
    pub fn precompiling() -> Image {
        let mut image = Image::bare();
        image.library.precompiler = Some(Box::default());
        image.set_up();
        image
    }

    fn set_up(&mut self) {
        let image = self;
        image.define_constant(known::NIL, Value::NIL);
        image.define_constant(known::T, Value::T);
        image.define_constant(known::PI, Value::Double(std::f64::consts::PI));
        image.define_standard_classes();
        condition::classes::define(image);
        image.define_library_classes();
        registry::install(image);
        define_variables(image);
        number_constants::define(image);
        number_theory::define_constants(image);
        implementation::define_constants(image);
        readtables::define_variables(image);
        library::install(image, &library::LIBRARY);
    }
}

impl Default for Image {
    fn default() -> Image {
        Image::new()
    }
}

fn define_variables(image: &mut Image) {
    stream::install(image);
    let features: Vec<Value> = [
        "PLANWRIGHT",
        "COMMON-LISP",
        "ANSI-CL",
        "CRAM",
        "LITTLE-ENDIAN",
    ]
    .iter()
    .map(|name| image.keyword(name).into())
    .collect();
    let history: [Sym; 9] = [
        known::TIMES,
        known::V_STAR,
        known::V_STAR3,
        known::PLUS,
        known::V_PLUS2,
        known::V_PLUS3,
        known::DIVIDE,
        known::V_SLASH2,
        known::V_SLASH3,
    ];
    for sym in history {
        image.define_special(sym, Value::NIL);
    }
    image.define_special(known::MINUS, Value::NIL);
    for (variable, value) in [
        (known::V_PACKAGE, Value::Package(PackageTable::USER)),
        (known::V_PRINT_ESCAPE, Value::T),
        (known::V_PRINT_PRETTY, Value::T),
        (known::V_PRINT_BASE, Value::Int(10)),
        (known::V_PRINT_RADIX, Value::NIL),
        (known::V_PRINT_CASE, Value::symbol(known::K_UPCASE)),
        (known::V_PRINT_LENGTH, Value::NIL),
        (known::V_PRINT_LEVEL, Value::NIL),
        (known::V_PRINT_CIRCLE, Value::NIL),
        (known::V_PRINT_GENSYM, Value::T),
        (known::V_PRINT_ARRAY, Value::T),
        (known::V_PRINT_READABLY, Value::NIL),
        (known::V_PRINT_LINES, Value::NIL),
        (known::V_PRINT_RIGHT_MARGIN, Value::NIL),
        (known::V_PRINT_MISER_WIDTH, Value::NIL),
        (
            known::V_PRINT_PPRINT_DISPATCH,
            Value::Hash(Rc::new(HashTable::new(HashTest::Equal))),
        ),
        (known::V_DEBUGGER_HOOK, Value::NIL),
        (known::V_READ_SUPPRESS, Value::NIL),
        (known::V_PRINT_DEPTH, Value::Int(0)),
        (known::V_PRINT_LABELS, Value::NIL),
        (known::V_READ_BASE, Value::Int(10)),
        (
            known::V_READ_DEFAULT_FLOAT_FORMAT,
            Value::symbol(known::SINGLE_FLOAT),
        ),
        (known::V_READ_EVAL, Value::T),
        (known::V_READTABLE, Value::NIL),
        (known::V_FEATURES, Value::list(features)),
        (known::V_RANDOM_STATE, Value::NIL),
        (known::V_GENSYM_COUNTER, Value::Int(97)),
        (known::V_MACROEXPAND_HOOK, Value::symbol(known::FUNCALL)),
        (known::V_BREAK_ON_SIGNALS, Value::NIL),
        (known::V_LOAD_PATHNAME, Value::NIL),
        (known::V_LOAD_TRUENAME, Value::NIL),
        (known::V_LOCKS_IGNORED, Value::NIL),
        (known::V_IN_REPORT, Value::NIL),
        (known::V_STANDARD_FIRST, Value::NIL),
        (known::V_AS_COMPILED, Value::NIL),
    ] {
        image.define_special(variable, value);
    }
}
