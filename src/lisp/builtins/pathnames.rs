//! Pathnames: taking them apart and putting them together. All else is written in Lisp.

use super::strings::string;
use crate::lisp::builtin::Builtin;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::pathname::Pathname;
use crate::lisp::value::raise::Raise;
use crate::lisp::{builtin, builtins};

type Outcome = Result<Value, Box<Raise>>;

/// Is the object a pathname?
///
/// `(pathnamep #P"a.lisp")` => `T`
/// `(pathnamep "a.lisp")` => `NIL`
#[builtin(_, "object")]
fn pathnamep(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(args[0].as_foreign::<Pathname>().is_some()))
}

/// The pathname of a name.
///
/// `(system::%parse-pathname "plans/a.lisp")` => `#P"plans/a.lisp"`
#[builtin("%PARSE-PATHNAME", "name")]
fn parse(_: &mut Image, args: &[Value]) -> Outcome {
    let name = string(&args[0])?.text();
    Ok(Value::foreign(Pathname::parse(&name)))
}

/// The pathname with these parts.
///
/// `(system::%pathname-of-parts '(:relative "plans") "a" nil nil)` => `#P"plans/a"`
#[builtin("%PATHNAME-OF-PARTS", "directory name type version &optional host")]
fn assemble(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::foreign(Pathname {
        host: args.get(4).cloned().unwrap_or(Value::NIL),
        directory: args[0].clone(),
        name: args[1].clone(),
        kind: args[2].clone(),
        version: args[3].clone(),
    }))
}

/// Directory, name, type, version and host of a pathname.
///
/// `(system::%pathname-parts #P"plans/a.lisp")` => `(:RELATIVE "plans") ; "a" ; "lisp" ; NIL ; NIL`
#[builtin("%PATHNAME-PARTS", "pathname")]
fn parts(_: &mut Image, args: &[Value]) -> Outcome {
    match args[0].as_foreign::<Pathname>() {
        Some(pathname) => Ok(Value::values(vec![
            pathname.directory.clone(),
            pathname.name.clone(),
            pathname.kind.clone(),
            pathname.version.clone(),
            pathname.host.clone(),
        ])),
        None => Err(Raise::type_error(&args[0], known::PATHNAME)),
    }
}

/// The name of a pathname.
///
/// `(system::%namestring #P"plans/a.lisp")` => `"plans/a.lisp"`
#[builtin("%NAMESTRING", "pathname")]
fn namestring(_: &mut Image, args: &[Value]) -> Outcome {
    match args[0].as_foreign::<Pathname>() {
        Some(pathname) => Ok(Value::string(pathname.namestring())),
        None => Err(Raise::type_error(&args[0], known::PATHNAME)),
    }
}

/// Pathnames.
pub(crate) static TABLE: &[Builtin] = builtins![pathnamep,];

/// What the library makes pathnames with, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![parse, assemble, parts, namestring,];
