//! Files, by the names that the machine knows them by: opening, finding, deleting, renaming. Relative
//! names begin in the directory that the program was started in; texts are UTF-8.

use crate::value::string::LispString;
use std::io::{Error, ErrorKind};
use std::rc::Rc;
use std::sync::Arc;

use super::shown::shown;
use super::strings::string;
use crate::builtin::Builtin;
use crate::files::{Contents, Files, Opening, utf8};
use crate::image::Image;
use crate::stream::{Stream, StreamKind};
use crate::typed::FromValue;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::pathname::Pathname;
use crate::value::raise::Raise;
use crate::value::stream::{Elements, Target};
use closest_name::closest_name;

type Outcome = Result<Value, Box<Raise>>;

/// The name of one file.
struct FilePath(String);

impl FromValue<'_> for FilePath {
    fn from_value(_: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        path(value).map(FilePath)
    }
}

fn path(value: &Value) -> Result<String, Box<Raise>> {
    let path = string(value)?.text();
    if path.contains('*') {
        return Err(Raise::new(
            known::FILE_ERROR,
            format!("\"{path}\" stands for several files; one is needed here."),
        )
        .with(known::K_PATHNAME, Value::foreign(Pathname::parse(&path))));
    }
    Ok(path)
}

/// Why a file could not be used; not in the system's own words where these differ between platforms.
pub(super) fn reason(error: &Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file or directory".to_owned(),
        ErrorKind::PermissionDenied => "permission denied".to_owned(),
        ErrorKind::AlreadyExists => {
            "the file exists; :IF-EXISTS :SUPERSEDE or :APPEND would write it".to_owned()
        }
        _ => error.to_string(),
    }
}

fn file_error(doing: &str, path: &str, error: &Error) -> Box<Raise> {
    Raise::new(
        known::FILE_ERROR,
        format!("Error {doing} \"{path}\": {}.", reason(error)),
    )
    .with(known::K_PATHNAME, Value::foreign(Pathname::parse(path)))
}

/// What the elements of a file are: characters, or so many bits, with a sign if negative.
fn elements(size: &Value) -> Elements {
    match size {
        Value::Int(bits) => Elements::Integers {
            bits: u32::try_from(bits.unsigned_abs()).unwrap_or(u32::MAX),
            signed: *bits < 0,
        },
        _ => Elements::Characters,
    }
}

/// Opens a file. The size is that of its elements in bits, negative if they have a sign; `NIL` for
/// characters.
///
/// `(system::%open-file "no-such-file.txt" nil :if-does-not-exist nil)` => `NIL`
#[builtin("%OPEN-FILE")]
fn open(
    image: &mut Image,
    name: &Value,
    size: &Value,
    #[key] direction: Option<&Value>,
    #[key] if_exists: Option<&Value>,
    #[key] if_does_not_exist: Option<&Value>,
    #[key] _element_type: Option<&Value>,
    #[key] _external_format: Option<&Value>,
) -> Outcome {
    let path = path(name)?;
    let elements = elements(size);
    let kind = match direction {
        None | Some(Value::Symbol(known::K_INPUT, ..)) => {
            open_input(&*image.files, &path, elements, if_does_not_exist)?
        }
        Some(Value::Symbol(known::K_OUTPUT, ..)) => {
            open_output(image, &path, if_exists, if_does_not_exist)?
        }
        Some(Value::Symbol(known::K_IO, ..)) => {
            open_both(image, &path, if_exists, if_does_not_exist)?
        }
        Some(Value::Symbol(known::K_PROBE, ..)) => {
            open_probe(&*image.files, &path, if_does_not_exist)?
        }
        Some(other) => {
            return Err(Raise::simple(format!(
                "{} is no direction to open a file in; :INPUT, :OUTPUT, :IO and :PROBE are.",
                shown(image, other)
            )));
        }
    };
    Ok(kind.map_or(Value::NIL, |kind| {
        Value::Stream(Rc::new(Stream::of_file(kind, &path, elements)))
    }))
}

type Opened = Result<Option<StreamKind>, Box<Raise>>;

fn is_folder(image: &Image, path: &str) -> bool {
    let known = image.files.facts(path);
    known.is_ok_and(|known| known.is_folder)
}

/// Looks whether a file is there.
fn open_probe(files: &dyn Files, path: &str, if_does_not_exist: Option<&Value>) -> Opened {
    if files.facts(path).is_err() {
        match if_does_not_exist {
            Some(Value::Symbol(known::K_ERROR, ..)) => {
                let error = Error::from(ErrorKind::NotFound);
                return Err(file_error("opening", path, &error));
            }
            Some(Value::Symbol(known::K_CREATE, ..)) => {
                files
                    .write(path, &[])
                    .map_err(|error| file_error("creating", path, &error))?;
            }
            _ => return Ok(None),
        }
    }
    Ok(Some(StreamKind::Closed))
}

fn open_input(
    files: &dyn Files,
    path: &str,
    elements: Elements,
    if_does_not_exist: Option<&Value>,
) -> Opened {
    let bytes = match files.read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => match if_does_not_exist {
            Some(Value::Symbol(known::NIL, ..)) => return Ok(None),
            Some(Value::Symbol(known::K_CREATE, ..)) => {
                files
                    .write(path, &[])
                    .map_err(|error| file_error("creating", path, &error))?;
                Vec::new()
            }
            _ => return Err(file_error("opening", path, &error)),
        },
        result => result.map_err(|error| file_error("opening", path, &error))?,
    };
    if elements != Elements::Characters {
        return Ok(Some(StreamKind::FileContents {
            bytes,
            position: 0,
            target: None,
        }));
    }
    let text = utf8(bytes).map_err(|error| file_error("opening", path, &error))?;
    Ok(Some(StreamKind::StringInput {
        text: text.into(),
        position: 0,
    }))
}

/// Opens a file for both directions. What is written is in the file once the stream is closed, or its
/// output finished.
fn open_both(
    image: &Image,
    path: &str,
    if_exists: Option<&Value>,
    if_does_not_exist: Option<&Value>,
) -> Opened {
    // Opening it for writing creates or empties it, as is wished.
    let Some(kind) = open_output(image, path, if_exists, if_does_not_exist)? else {
        return Ok(None);
    };
    drop(kind);
    let read = image.files.read(path);
    let bytes = read.map_err(|error| file_error("opening", path, &error))?;
    let position = match if_exists {
        Some(Value::Symbol(known::K_APPEND, ..)) => bytes.len(),
        _ => 0,
    };
    Ok(Some(StreamKind::FileContents {
        bytes,
        position,
        target: Some(Target {
            files: Arc::clone(&image.files),
            is_changed: false,
        }),
    }))
}

fn open_output(
    image: &Image,
    path: &str,
    if_exists: Option<&Value>,
    if_does_not_exist: Option<&Value>,
) -> Opened {
    let known = image.files.facts(path).ok();
    let mut opening = Opening {
        creates: false,
        contents: Contents::Overwrite,
    };
    if known.is_some() {
        opening.contents = match if_exists {
            Some(Value::Symbol(known::NIL, ..)) => return Ok(None),
            None | Some(Value::Symbol(known::K_ERROR, ..)) => {
                let error = Error::from(ErrorKind::AlreadyExists);
                return Err(file_error("opening", path, &error));
            }
            Some(Value::Symbol(known::K_APPEND, ..)) => Contents::Append,
            Some(Value::Symbol(known::K_OVERWRITE, ..)) => Contents::Overwrite,
            Some(Value::Symbol(
                known::K_SUPERSEDE
                | known::K_RENAME
                | known::K_RENAME_AND_DELETE
                | known::K_NEW_VERSION,
                ..,
            )) => Contents::Drop,
            Some(other) => {
                return Err(Raise::simple(format!(
                    "{} is no value of :IF-EXISTS; :SUPERSEDE, :APPEND, :OVERWRITE, :ERROR and NIL are.",
                    shown(image, other)
                )));
            }
        };
    } else {
        // A file to which something is to be added, or of which a part is to be replaced, must exist.
        let needs_file = matches!(
            if_exists,
            Some(Value::Symbol(known::K_APPEND | known::K_OVERWRITE, ..))
        );
        let default = needs_file.then(|| Value::from(known::K_ERROR));
        match if_does_not_exist.or(default.as_ref()) {
            Some(Value::Symbol(known::NIL, ..)) => return Ok(None),
            Some(Value::Symbol(known::K_ERROR, ..)) => {
                let error = Error::from(ErrorKind::NotFound);
                return Err(file_error("opening", path, &error));
            }
            _ => opening.creates = true,
        };
    }
    let opened = image.files.open(path, opening);
    let file = opened.map_err(|error| file_error("opening", path, &error))?;
    let length = match opening.contents {
        Contents::Drop => 0,
        Contents::Overwrite | Contents::Append => known.map_or(0, |known| known.length),
    };
    let position = match opening.contents {
        Contents::Append => length,
        Contents::Drop | Contents::Overwrite => 0,
    };
    Ok(Some(StreamKind::FileOutput {
        file,
        column: 0,
        position,
        length,
    }))
}

/// The name of a file without links, or `NIL`.
///
/// `(system::%true-name "no-such-file.txt")` => `NIL`
// The name of a file without links, or `NIL` if there is no such file; that of a folder ends with a slash.
#[builtin("%TRUE-NAME")]
fn true_name(image: &mut Image, name: FilePath) -> Outcome {
    let path = name.0;
    let here = if path.is_empty() { "." } else { path.as_str() };
    let Ok(found) = image.files.true_name(here) else {
        return Ok(Value::NIL);
    };
    let is_folder = is_folder(image, &found);
    let needs_slash = is_folder && !found.ends_with('/');
    Ok(Value::string(if needs_slash { found + "/" } else { found }))
}

/// Deletes a file.
#[builtin("%DELETE-FILE")]
fn delete_file(image: &mut Image, name: FilePath) -> Outcome {
    let path = name.0;
    let removed = image.files.remove(&path);
    removed.map_err(|error| file_error("deleting", &path, &error))?;
    Ok(Value::T)
}

/// Renames a file.
#[builtin("%RENAME-FILE")]
fn rename_file(image: &mut Image, name: FilePath, new_name: FilePath) -> Outcome {
    let (old, new) = (name.0, new_name.0);
    let renamed = image.files.rename(&old, &new);
    renamed.map_err(|error| file_error("renaming", &old, &error))?;
    Ok(Value::T)
}

/// Seconds from the beginning of universal time, 1900, to that of the machine's, 1970.
const UNIVERSAL_TO_UNIX: u64 = 2_208_988_800;

/// The universal time at which a file was written last.
#[builtin("%FILE-DATE")]
fn file_date(image: &mut Image, name: FilePath) -> Outcome {
    let path = name.0;
    let known = image.files.facts(&path);
    let known = known.map_err(|error| file_error("looking at", &path, &error))?;
    let date = known
        .modified
        .map(|since| since.saturating_add(UNIVERSAL_TO_UNIX));
    let date = date.and_then(|date| i64::try_from(date).ok());
    Ok(date.map_or(Value::NIL, Value::Int))
}

/// Makes a folder and those around it; was it missing?
///
/// `(system::%make-directories "")` => `NIL`
// Makes a folder and those around it; was it missing?
#[builtin("%MAKE-DIRECTORIES")]
fn make_directories(image: &mut Image, name: FilePath) -> Outcome {
    let path = name.0;
    if path.is_empty() || is_folder(image, &path) {
        return Ok(Value::NIL);
    }
    let made = image.files.create_folders(&path);
    made.map_err(|error| file_error("making", &path, &error))?;
    Ok(Value::T)
}

/// The names in a folder, sorted; those of folders end with a slash. `NIL` if there is no such
/// folder.
///
/// `(system:file-names "no-such-folder")` => `NIL`
#[builtin]
fn file_names(image: &mut Image, folder: &Rc<LispString>) -> Outcome {
    let folder = folder.text();
    let Ok(mut names) = image.files.names(&folder) else {
        return Ok(Value::NIL);
    };
    names.sort_unstable();
    Ok(Value::list(names.into_iter().map(Value::string)))
}

/// The value of an environment variable, or `NIL`.
///
/// `(system:environment-variable "NO_SUCH_VARIABLE_HERE")` => `NIL`
#[builtin]
fn environment_variable(name: String) -> Value {
    let is_name = !name.is_empty() && !name.contains(['=', '\0']);
    let value = is_name.then(|| std::env::var(&name).ok()).flatten();
    value.map_or(Value::NIL, Value::string)
}

/// The name that was probably meant, or `NIL`.
///
/// `(system:closest-name "iterat" '("fiveam" "iterate"))` => `"iterate"`
#[builtin("CLOSEST-NAME", "name names")]
fn closest(name_argument: &Rc<LispString>, names: &Value) -> Outcome {
    let name = name_argument.text();
    let names: Vec<String> = names
        .iter_list()
        .map(|name| Ok(string(&name)?.text()))
        .collect::<Result<_, Box<Raise>>>()?;
    let near = closest_name(&name, names.iter().map(String::as_str));
    Ok(near.map_or(Value::NIL, Value::string))
}

/// What the library needs to find files, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    environment_variable,
    file_names,
    closest,
    open,
    true_name,
    delete_file,
    rename_file,
    file_date,
    make_directories,
];
