//! Pathnames: taking them apart and putting them together. All else is written in Lisp.

use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::pathname::Pathname;
use crate::value::raise::Raise;
use crate::value::string::LispString;
use std::rc::Rc;

type Outcome = Result<Value, Box<Raise>>;

/// Is the object a pathname?
///
/// `(pathnamep #P"a.lisp")` => `T`
/// `(pathnamep "a.lisp")` => `NIL`
#[builtin]
fn pathnamep(object: &Value) -> bool {
    object.as_foreign::<Pathname>().is_some()
}

/// The pathname of a name.
///
/// `(system::%parse-pathname "plans/a.lisp")` => `#P"plans/a.lisp"`
#[builtin("%PARSE-PATHNAME")]
fn parse(name: &Rc<LispString>) -> Outcome {
    let name = name.text();
    Ok(Value::foreign(Pathname::parse(&name)))
}

/// The pathname with these parts.
///
/// `(system::%pathname-of-parts '(:relative "plans") "a" nil nil)` => `#P"plans/a"`
#[builtin("%PATHNAME-OF-PARTS", "directory name type version &optional host")]
fn assemble(
    directory_value: Value,
    name_value: Value,
    type_: Value,
    version_value: Value,
    host_value: Option<&Value>,
) -> Outcome {
    Ok(Value::foreign(Pathname {
        host: host_value.cloned().unwrap_or(Value::NIL),
        directory: directory_value,
        name: name_value,
        kind: type_,
        version: version_value,
    }))
}

/// Directory, name, type, version and host of a pathname.
///
/// `(system::%pathname-parts #P"plans/a.lisp")` => `(:RELATIVE "plans") ; "a" ; "lisp" ; NIL ; NIL`
#[builtin("%PATHNAME-PARTS", "pathname")]
fn parts(pathname_value: &Value) -> Outcome {
    match pathname_value.as_foreign::<Pathname>() {
        Some(pathname) => Ok(Value::values(vec![
            pathname.directory.clone(),
            pathname.name.clone(),
            pathname.kind.clone(),
            pathname.version.clone(),
            pathname.host.clone(),
        ])),
        None => Err(Raise::type_error(pathname_value, known::PATHNAME)),
    }
}

/// The name of a pathname.
///
/// `(system::%namestring #P"plans/a.lisp")` => `"plans/a.lisp"`
#[builtin("%NAMESTRING", "pathname")]
fn namestring(pathname_value: &Value) -> Outcome {
    match pathname_value.as_foreign::<Pathname>() {
        Some(pathname) => Ok(Value::string(pathname.namestring())),
        None => Err(Raise::type_error(pathname_value, known::PATHNAME)),
    }
}

/// Pathnames.
pub(crate) static TABLE: &[Builtin] = builtins![pathnamep,];

/// What the library makes pathnames with, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![parse, assemble, parts, namestring,];
