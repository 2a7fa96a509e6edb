//! Questions about the implementation.

use super::array_make::MAX_RANK;
use crate::builtin::Builtin;
use crate::guard::MAX_ELEMENTS;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::package::PackageTable;
use crate::value::raise::Raise;
use crate::value::symbol::VariableKind;

/// The name of the implementation.
///
/// `(lisp-implementation-type)` => `"planwright"`
#[builtin(_, "")]
fn lisp_implementation_type() -> Result<Value, Box<Raise>> {
    Ok("planwright".into())
}

/// The version of the implementation.
///
/// `(stringp (lisp-implementation-version))` => `T`
#[builtin(_, "")]
fn lisp_implementation_version() -> Result<Value, Box<Raise>> {
    Ok(env!("CARGO_PKG_VERSION").into())
}

/// Defines the constants that tell limits, and what lambda lists may contain.
pub(crate) fn define_constants(image: &mut Image) {
    let most_elements = i64::try_from(MAX_ELEMENTS).unwrap_or(i64::MAX);
    for (name, value) in [
        ("CHAR-CODE-LIMIT", i64::from(u32::from(char::MAX)) + 1),
        ("ARRAY-DIMENSION-LIMIT", most_elements + 1),
        ("ARRAY-TOTAL-SIZE-LIMIT", most_elements + 1),
        (
            "ARRAY-RANK-LIMIT",
            i64::try_from(MAX_RANK).unwrap_or(i64::MAX) + 1,
        ),
        ("CALL-ARGUMENTS-LIMIT", most_elements),
        ("MULTIPLE-VALUES-LIMIT", most_elements),
        ("LAMBDA-PARAMETERS-LIMIT", i64::from(u16::MAX)),
        ("INTERNAL-TIME-UNITS-PER-SECOND", 1_000_000),
    ] {
        let sym = image.export_symbol(PackageTable::CL, name);
        image.define_constant(sym, Value::Int(value));
    }
    let keywords: Vec<Value> = [
        "&OPTIONAL",
        "&REST",
        "&KEY",
        "&ALLOW-OTHER-KEYS",
        "&AUX",
        "&BODY",
        "&WHOLE",
        "&ENVIRONMENT",
    ]
    .into_iter()
    .map(|name| image.export_symbol(PackageTable::CL, name).into())
    .collect();
    let sym = image.export_symbol(PackageTable::CL, "LAMBDA-LIST-KEYWORDS");
    image.define_constant(sym, Value::list(keywords));
    let sym = image.export_symbol(PackageTable::CL, "*MODULES*");
    image.define_special(sym, Value::list([Value::string("ALEXANDRIA")]));
}

/// Does the form always have the same value?
///
/// `(constantp 5)` => `T`
/// `(constantp '(+ 1 2))` => `NIL`
#[builtin]
fn constantp(
    image: &mut Image,
    form: &Value,
    _environment: Option<&Value>,
) -> Result<Value, Box<Raise>> {
    let is_constant = match form {
        Value::Symbol(sym, ..) => image.symbol(*sym).kind == VariableKind::Constant,
        Value::Cons(cons) => cons.car().as_symbol() == Some(known::QUOTE),
        _ => true,
    };
    Ok(is_constant.into())
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    constantp,
    lisp_implementation_type,
    lisp_implementation_version,
];
