//! Names of things: symbols in plans, strings with underscores in frames.
//!
//! Names are compared leniently: `BOTTLE-1`, `:BOTTLE-1` and `"bottle_1"` are the same.

use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::foreign::PrintContext;
use lisp::value::known;
use lisp::value::package::PackageId;
use lisp::value::raise::Raise;

/// The name of a symbol in lower case with underscores.
///
/// `(roslisp-utilities:rosify-underscores-lisp-name 'bottle-1)` => `"bottle_1"`
#[builtin]
fn rosify_underscores_lisp_name(image: &mut Image, name: &Value) -> Result<Value, Box<Raise>> {
    Ok(Value::string(rosify(&text(image, name)?)))
}

/// The name of a symbol as in camel case: bottleOne.
///
/// `(roslisp-utilities:rosify-lisp-name 'bottle-one)` => `"bottleOne"`
#[builtin]
fn rosify_lisp_name(image: &mut Image, name: &Value) -> Result<Value, Box<Raise>> {
    Ok(Value::string(camel(&text(image, name)?)))
}

/// The symbol of a name with underscores; in the package, or a keyword.
///
/// `(roslisp-utilities:lispify-ros-underscore-name "bottle_1")` => `:BOTTLE-1`
#[builtin(_, "name &optional package")]
fn lispify_ros_underscore_name(
    image: &mut Image,
    name: &Value,
    package_value: Option<&Value>,
) -> Result<Value, Box<Raise>> {
    let name = canonical(&text(image, name)?);
    let sym = match package_value.and_then(|p| package(image, p)) {
        Some(package) => image.intern(package, &name),
        None => image.keyword(&name),
    };
    Ok(sym.into())
}

/// The symbol of a name in camel case; in the package, or a keyword.
///
/// `(roslisp-utilities:lispify-ros-name "bottleOne")` => `:BOTTLE-ONE`
#[builtin(_, "name &optional package")]
fn lispify_ros_name(
    image: &mut Image,
    name: &Value,
    package_value: Option<&Value>,
) -> Result<Value, Box<Raise>> {
    let name = uncamel(&text(image, name)?);
    let sym = match package_value.and_then(|p| package(image, p)) {
        Some(package) => image.intern(package, &name),
        None => image.keyword(&name),
    };
    Ok(sym.into())
}

fn text(image: &Image, name: &Value) -> Result<String, Box<Raise>> {
    name_text(image, name).ok_or_else(|| Raise::type_error(name, known::SYMBOL))
}

fn package(image: &Image, designator: &Value) -> Option<PackageId> {
    match designator {
        Value::Package(id) => Some(*id),
        Value::Symbol(sym, ..) if designator.is_true() => image.packages.find(image.name(*sym)),
        Value::Str(name) => image.packages.find(&name.text()),
        _ => None,
    }
}

/// The text of a symbol or string.
pub fn name_text(context: &dyn PrintContext, name: &Value) -> Option<String> {
    match name {
        Value::Symbol(sym, ..) => Some(context.name(*sym).to_owned()),
        Value::Str(text) => Some(text.text()),
        _ => None,
    }
}

/// `BOTTLE-1` as `bottle_1`.
pub fn rosify(name: &str) -> String {
    name.to_lowercase().replace('-', "_")
}

/// Any spelling of a name as `BOTTLE-1`.
pub(crate) fn canonical(name: &str) -> String {
    name.to_uppercase().replace('_', "-")
}

fn camel(name: &str) -> String {
    let mut out = String::new();
    let mut upper = false;
    for c in name.chars() {
        if c == '-' {
            upper = true;
        } else if upper {
            out.extend(c.to_uppercase());
            upper = false;
        } else {
            out.extend(c.to_lowercase());
        }
    }
    out
}

fn uncamel(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !out.is_empty() {
            out.push('-');
        }
        out.extend(c.to_uppercase());
    }
    out
}

/// Functions of package `ROSLISP-UTILITIES`.
pub(crate) static TABLE: &[Builtin] = builtins![
    rosify_underscores_lisp_name,
    rosify_lisp_name,
    lispify_ros_underscore_name,
    lispify_ros_name,
];
