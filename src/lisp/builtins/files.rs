//! Files: opening, finding, deleting, renaming. Names are strings, relative to the
//! directory that the program was started in; texts are UTF-8.

use std::fs::{self, File, OpenOptions};
use std::io::{BufWriter, Error, ErrorKind};
use std::rc::Rc;

use super::keywords;
use super::shown::shown;
use super::strings::string;
use crate::closest_name::closest_name;
use crate::lisp::builtin::{Builtin, pure};
use crate::lisp::image::Image;
use crate::lisp::stream::{Stream, StreamKind};
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

fn path(value: &Value) -> Result<String, Box<Raise>> {
    Ok(string(value)?.text())
}

/// Why a file could not be used; not in the system's own words where these differ between platforms.
pub(super) fn reason(error: &Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file or directory".to_owned(),
        ErrorKind::PermissionDenied => "permission denied".to_owned(),
        ErrorKind::AlreadyExists => {
            "the file exists; :IF-EXISTS :SUPERSEDE or :APPEND would write it".to_owned()
        }
        ErrorKind::InvalidData => "the file is not UTF-8 text".to_owned(),
        _ => error.to_string(),
    }
}

fn file_error(doing: &str, path: &str, error: &Error) -> Box<Raise> {
    Raise::new(
        known::FILE_ERROR,
        format!("Error {doing} \"{path}\": {}.", reason(error)),
    )
    .with(known::K_PATHNAME, Value::string(path))
}

fn open(image: &mut Image, args: &[Value]) -> Outcome {
    let [direction, if_exists, if_does_not_exist, _, _] = keywords::parse(
        image,
        &args[1..],
        [
            known::K_DIRECTION,
            known::K_IF_EXISTS,
            known::K_IF_DOES_NOT_EXIST,
            known::K_ELEMENT_TYPE,
            known::K_EXTERNAL_FORMAT,
        ],
    )?;
    let path = path(&args[0])?;
    match direction.as_ref() {
        None | Some(Value::Symbol(known::K_INPUT, ..)) => {
            open_input(&path, if_does_not_exist.as_ref())
        }
        Some(Value::Symbol(known::K_OUTPUT, ..)) => {
            open_output(image, &path, if_exists.as_ref(), if_does_not_exist.as_ref())
        }
        Some(Value::Symbol(known::K_PROBE, ..)) => {
            let exists = fs::metadata(&path).is_ok();
            let stream = Stream::new(StreamKind::Closed);
            Ok(if exists {
                Value::Stream(Rc::new(stream))
            } else {
                Value::NIL
            })
        }
        Some(other) => Err(Raise::simple(format!(
            "{} is no direction to open a file in; :INPUT, :OUTPUT and :PROBE are.",
            shown(image, other)
        ))),
    }
}

fn open_input(path: &str, if_does_not_exist: Option<&Value>) -> Outcome {
    let read = || fs::read_to_string(path);
    let text = match read() {
        Err(error) if error.kind() == ErrorKind::NotFound => match if_does_not_exist {
            Some(Value::Symbol(known::NIL, ..)) => return Ok(Value::NIL),
            Some(Value::Symbol(known::K_CREATE, ..)) => {
                File::create(path).map_err(|error| file_error("creating", path, &error))?;
                String::new()
            }
            _ => return Err(file_error("opening", path, &error)),
        },
        result => result.map_err(|error| file_error("opening", path, &error))?,
    };
    Ok(Value::Stream(Rc::new(Stream::from_text(text))))
}

fn open_output(
    image: &Image,
    path: &str,
    if_exists: Option<&Value>,
    if_does_not_exist: Option<&Value>,
) -> Outcome {
    let exists = fs::metadata(path).is_ok();
    let mut options = OpenOptions::new();
    options.write(true);
    if exists {
        match if_exists {
            Some(Value::Symbol(known::NIL, ..)) => return Ok(Value::NIL),
            None | Some(Value::Symbol(known::K_ERROR, ..)) => {
                let error = Error::from(ErrorKind::AlreadyExists);
                return Err(file_error("opening", path, &error));
            }
            Some(Value::Symbol(known::K_APPEND, ..)) => options.append(true),
            Some(Value::Symbol(known::K_OVERWRITE, ..)) => &mut options,
            Some(Value::Symbol(
                known::K_SUPERSEDE
                | known::K_RENAME
                | known::K_RENAME_AND_DELETE
                | known::K_NEW_VERSION,
                ..,
            )) => options.truncate(true),
            Some(other) => {
                return Err(Raise::simple(format!(
                    "{} is no value of :IF-EXISTS; :SUPERSEDE, :APPEND, :OVERWRITE, :ERROR and NIL are.",
                    shown(image, other)
                )));
            }
        };
    } else {
        match if_does_not_exist {
            Some(Value::Symbol(known::NIL, ..)) => return Ok(Value::NIL),
            Some(Value::Symbol(known::K_ERROR, ..)) => {
                let error = Error::from(ErrorKind::NotFound);
                return Err(file_error("opening", path, &error));
            }
            _ => options.create(true),
        };
    }
    let file = options
        .open(path)
        .map_err(|error| file_error("opening", path, &error))?;
    Ok(Value::Stream(Rc::new(Stream::new(
        StreamKind::FileOutput {
            file: BufWriter::new(file),
            column: 0,
            position: 0,
        },
    ))))
}

fn probe_file(_: &mut Image, args: &[Value]) -> Outcome {
    let path = path(&args[0])?;
    Ok(if fs::metadata(&path).is_ok() {
        args[0].clone()
    } else {
        Value::NIL
    })
}

fn delete_file(_: &mut Image, args: &[Value]) -> Outcome {
    let path = path(&args[0])?;
    fs::remove_file(&path).map_err(|error| file_error("deleting", &path, &error))?;
    Ok(Value::T)
}

fn rename_file(_: &mut Image, args: &[Value]) -> Outcome {
    let (old, new) = (path(&args[0])?, path(&args[1])?);
    fs::rename(&old, &new).map_err(|error| file_error("renaming", &old, &error))?;
    Ok(Value::values(vec![
        args[1].clone(),
        args[0].clone(),
        args[1].clone(),
    ]))
}

fn file_names(_: &mut Image, args: &[Value]) -> Outcome {
    let folder = path(&args[0])?;
    let Ok(entries) = fs::read_dir(&folder) else {
        return Ok(Value::NIL);
    };
    // Names that are no text cannot be given to OPEN either.
    let mut names: Vec<String> = entries
        .flatten()
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let is_folder = fs::metadata(entry.path()).is_ok_and(|data| data.is_dir());
            Some(if is_folder { name + "/" } else { name })
        })
        .collect();
    names.sort_unstable();
    Ok(Value::list(names.into_iter().map(Value::string)))
}

fn closest(_: &mut Image, args: &[Value]) -> Outcome {
    let name = string(&args[0])?.text();
    let names: Vec<String> = args[1]
        .iter_list()
        .map(|name| Ok(string(&name)?.text()))
        .collect::<Result<_, Box<Raise>>>()?;
    let near = closest_name(&name, names.iter().map(String::as_str));
    Ok(near.map_or(Value::NIL, Value::string))
}

/// What the library needs to find files, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "FILE-NAMES",
        "folder",
        "The names in a folder, sorted; those of folders end with a slash. `NIL` if there is no such folder.",
        &["(system:file-names \"no-such-folder\") => NIL"],
        file_names,
    ),
    pure(
        "CLOSEST-NAME",
        "name names",
        "The name that was probably meant, or `NIL`.",
        &["(system:closest-name \"iterat\" '(\"fiveam\" \"iterate\")) => \"iterate\""],
        closest,
    ),
];

/// Files.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "OPEN",
        "path &key direction if-exists if-does-not-exist element-type external-format",
        "Opens a file for reading (the default) or writing; `with-open-file` closes it again.",
        &["(open \"no-such-file.txt\" :if-does-not-exist nil) => NIL"],
        open,
    ),
    pure(
        "PROBE-FILE",
        "path",
        "The path if there is such a file, else `NIL`.",
        &["(probe-file \"no-such-file.txt\") => NIL"],
        probe_file,
    ),
    pure("DELETE-FILE", "path", "Deletes a file.", &[], delete_file),
    pure(
        "RENAME-FILE",
        "path new-path",
        "Renames a file.",
        &[],
        rename_file,
    ),
];
