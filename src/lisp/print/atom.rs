//! Values that are printed without parts, and objects that cannot be read back.

use num_bigint::BigInt;

use super::float;
use super::settings::Settings;
use super::symbol;
use crate::image::Image;
use crate::image::identity::identity;
use crate::reader::char_name::char_name;
use crate::stream::StreamKind;
use crate::value::Value;
use crate::value::class::{Class, ClassKind};
use crate::value::function::{Body, Deferred, Function, Native};
use crate::value::hash_table::HashTest;
use crate::value::number::large::to_text;
use crate::value::symbol::Sym;

/// An instance of a class, with what a condition says.
pub(super) fn with_message(
    image: &Image,
    instance: &Value,
    class: Sym,
    settings: &Settings,
    message: Option<String>,
) -> String {
    let name = symbol::symbol(image, class, &settings.clone().with_escape(true));
    let message = message.map_or_else(String::new, |message| string(&message) + " ");
    format!("#<{name} {message}{}>", identity(image, instance))
}

/// A value that is not a list, vector, array, structure or condition report.
pub(super) fn atom(image: &Image, value: &Value, settings: &Settings) -> String {
    match value {
        Value::Symbol(sym, ..) => symbol::symbol(image, *sym, settings),
        Value::Int(n) => integer(&n.to_string(), || BigInt::from(*n), settings),
        Value::Big(n) => integer(&to_text(n, 10), || n.as_ref().clone(), settings),
        Value::Ratio(r) => {
            let numerator = to_text(&r.numerator, settings.base);
            let denominator = to_text(&r.denominator, settings.base);
            let ratio = format!("{numerator}/{denominator}").to_uppercase();
            match (settings.radix, settings.base) {
                (false, _) => ratio,
                (true, base) => format!("{}{ratio}", radix_prefix(base)),
            }
        }
        Value::Single(x) => float::single(*x, settings),
        Value::Double(x) => float::double(*x, settings),
        Value::Char(c) if settings.escape => character(*c),
        Value::Char(c) => c.to_string(),
        Value::Str(s) if settings.escape => string(&s.borrow()),
        Value::Str(s) => s.text(),
        Value::Function(f) => function(image, value, f, settings),
        Value::Hash(table) => {
            let test = match table.test {
                HashTest::Eq => "EQ",
                HashTest::Eql => "EQL",
                HashTest::Equal => "EQUAL",
                HashTest::Equalp => "EQUALP",
            };
            let count = table.len();
            format!(
                "#<HASH-TABLE :TEST {test} :COUNT {count} {}>",
                identity(image, value)
            )
        }
        Value::Class(class) => self::class(image, class),
        Value::Package(id) => {
            let mut escaped = String::new();
            quote(&image.packages.get(*id).name, &mut escaped);
            format!("#<PACKAGE {escaped}>")
        }
        Value::Stream(stream) => {
            let kind = match &*stream.kind.borrow() {
                StreamKind::StringOutput { .. } | StreamKind::Pretty { .. } => {
                    "STRING-OUTPUT-STREAM"
                }
                StreamKind::StringInput { .. } if stream.file.is_none() => "STRING-INPUT-STREAM",
                StreamKind::StringTarget { .. } => "FILL-POINTER-OUTPUT-STREAM",
                StreamKind::Broadcast { .. } => "BROADCAST-STREAM",
                _ => "STREAM",
            };
            format!("#<{kind} {}>", identity(image, value))
        }
        Value::Foreign(object) => object.object().print(image, settings.escape),
        Value::Instance(instance) => {
            let message = super::report::message(image, instance);
            with_message(image, value, instance.class().name, settings, message)
        }
        Value::Cell(_) => "#<CELL>".to_owned(),
        Value::Unbound => "#<UNBOUND>".to_owned(),
        Value::Multiple(_) | Value::Cons(_) | Value::Vector(_) | Value::Array(_) => {
            format!("#<ARRAY {}>", identity(image, value))
        }
    }
}

fn radix_prefix(base: u32) -> String {
    match base {
        2 => "#b".to_owned(),
        8 => "#o".to_owned(),
        16 => "#x".to_owned(),
        other => format!("#{other}r"),
    }
}

fn integer(decimal: &str, n: impl FnOnce() -> BigInt, settings: &Settings) -> String {
    match (settings.base, settings.radix) {
        (10, false) => decimal.to_owned(),
        (10, true) => format!("{decimal}."),
        (base, has_radix) => {
            let digits = to_text(&n(), base).to_uppercase();
            if has_radix {
                format!("{}{digits}", radix_prefix(base))
            } else {
                digits
            }
        }
    }
}

fn character(c: char) -> String {
    match char_name(c) {
        Some(_) if c == ' ' => "#\\ ".to_owned(),
        Some(name) => format!("#\\{name}"),
        None => format!("#\\{c}"),
    }
}

fn string(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len() + 2);
    quote(text, &mut escaped);
    escaped
}

fn quote(text: &str, out: &mut String) {
    out.push('"');
    for c in text.chars() {
        if matches!(c, '"' | '\\') {
            out.push('\\');
        }
        out.push(c);
    }
    out.push('"');
}

/// A class, which cannot be read back: its metaclass, and its name with the package.
fn class(image: &Image, class: &Class) -> String {
    let kind = match class.kind {
        ClassKind::Builtin => "BUILT-IN-CLASS",
        ClassKind::Standard => "STANDARD-CLASS",
        ClassKind::Structure => "STRUCTURE-CLASS",
        ClassKind::Condition => "CONDITION-CLASS",
    };
    let kind = if class.kind == ClassKind::Condition {
        format!("SB-PCL::{kind}")
    } else {
        kind.to_owned()
    };
    format!(
        "#<{kind} {}>",
        crate::print::qualified(image, &class.name.into())
    )
}

fn function(image: &Image, value: &Value, function: &Function, settings: &Settings) -> String {
    let settings = settings.clone().with_escape(true);
    match &function.body {
        Body::Native(Native { name, .. }) | Body::Deferred(Deferred { name, .. }) => {
            format!("#<FUNCTION {}>", symbol::symbol(image, *name, &settings))
        }
        Body::Generic(generic) => {
            let name = crate::print::qualified(image, &generic.name);
            let count = generic.methods.borrow().len();
            format!("#<STANDARD-GENERIC-FUNCTION {name} ({count})>")
        }
        Body::Closure { code, captured } => {
            let kind = if captured.is_empty() {
                "FUNCTION"
            } else {
                "CLOSURE"
            };
            let name = super::to_string(image, code.name.shown(), true);
            if captured.is_empty() && code.name.shown().as_symbol().is_some() {
                format!("#<{kind} {name}>")
            } else {
                format!("#<{kind} {name} {}>", identity(image, value))
            }
        }
    }
}
