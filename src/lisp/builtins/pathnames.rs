//! Pathnames: taking them apart and putting them together. All else is written in Lisp.

use super::strings::string;
use crate::builtin::{Builtin, pure};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::pathname::Pathname;
use crate::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

fn pathnamep(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(args[0].as_foreign::<Pathname>().is_some()))
}

fn parse(_: &mut Image, args: &[Value]) -> Outcome {
    let name = string(&args[0])?.text();
    Ok(Value::foreign(Pathname::parse(&name)))
}

fn assemble(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::foreign(Pathname {
        host: args.get(4).cloned().unwrap_or(Value::NIL),
        directory: args[0].clone(),
        name: args[1].clone(),
        kind: args[2].clone(),
        version: args[3].clone(),
    }))
}

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

fn namestring(_: &mut Image, args: &[Value]) -> Outcome {
    match args[0].as_foreign::<Pathname>() {
        Some(pathname) => Ok(Value::string(pathname.namestring())),
        None => Err(Raise::type_error(&args[0], known::PATHNAME)),
    }
}

/// Pathnames.
pub(crate) static TABLE: &[Builtin] = &[pure(
    "PATHNAMEP",
    "object",
    "Is the object a pathname?",
    &[
        "(pathnamep #P\"a.lisp\") => T",
        "(pathnamep \"a.lisp\") => NIL",
    ],
    pathnamep,
)];

/// What the library makes pathnames with, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "%PARSE-PATHNAME",
        "name",
        "The pathname of a name.",
        &["(system::%parse-pathname \"plans/a.lisp\") => #P\"plans/a.lisp\""],
        parse,
    ),
    pure(
        "%PATHNAME-OF-PARTS",
        "directory name type version &optional host",
        "The pathname with these parts.",
        &["(system::%pathname-of-parts '(:relative \"plans\") \"a\" nil nil) => #P\"plans/a\""],
        assemble,
    ),
    pure(
        "%PATHNAME-PARTS",
        "pathname",
        "Directory, name, type, version and host of a pathname.",
        &[
            "(system::%pathname-parts #P\"plans/a.lisp\") => (:RELATIVE \"plans\") ; \"a\" ; \"lisp\" ; NIL ; NIL",
        ],
        parts,
    ),
    pure(
        "%NAMESTRING",
        "pathname",
        "The name of a pathname.",
        &["(system::%namestring #P\"plans/a.lisp\") => \"plans/a.lisp\""],
        namestring,
    ),
];
