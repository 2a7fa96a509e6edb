//! The part of the language that is written in Lisp itself.
//!
//! To add a definition, write it into a file of `library/` (the files are in the order of the
//! standard's chapters), beginning in the first column: only such forms are found. Its docstring
//! has one or two sentences; after a line `Examples:` each line is an example `FORM => VALUES`,
//! which the manual shows and a test runs:
//!
//! ```lisp
//! (defmacro unless (test &body body)
//!   "Evaluates the body if the test is NIL.
//!   Examples:
//!   (unless nil 1) => 1"
//!   `(if ,test nil (progn ,@body)))
//! ```
//!
//! To add a file, write it, let it begin with `(in-package …)`, and list it in [`LIBRARY`];
//! a layer above has a list of its own and installs it with [`install`].
//!
//! - A definition's name is exported from the file's package, or from the one that it is
//!   written with (`alexandria:if-let`). A name that begins with `%` is a helper: it belongs
//!   to `SYSTEM`, and the manual leaves it out.
//! - Symbols that the file's package does not have belong to `SYSTEM`, so that reading a definition
//!   leaves nothing behind in packages that users look into. Symbols of other packages are written
//!   with their prefix.
//! - `defun`, `defmacro` and `define-modify-macro` cost nothing until the first call, which
//!   reads and compiles the definition ([`deferred`]). Any other form is evaluated whenever
//!   an image is made, after the definitions of all files are known.
//! - Macros are compiled without places, so that what they expand into has the place of the user's
//!   form; functions have places, but error messages give the caller's place instead.
//!
//! An error in a definition fails the test that compiles all of them
//! (`tests/language/library.rs`).

pub mod deferred;
mod index;

use std::rc::Rc;
use std::sync::LazyLock;

use definition::{Definition, File, Kind};

pub use super::image::definition;

use super::builtin::Entry;
use super::condition;
use super::image::Image;
use super::print;
use super::value::Value;
use super::value::function::{Deferred, Function};
use super::value::package::PackageTable;
use super::value::raise::Raise;
use super::value::symbol::{FunctionCell, Sym};

/// The definitions of one layer, found once per process.
pub struct Library {
    /// What is compiled when it is first called.
    pub definitions: Vec<Definition>,
    /// Other forms: what an image evaluates when it is made.
    pub forms: Vec<Definition>,
}

/// One file in the list of a layer.
#[doc(hidden)]
#[macro_export]
macro_rules! __library_file {
    ($folder:literal, $name:literal) => {
        $crate::library::definition::File {
            name: concat!($folder, "/", $name),
            text: include_str!($name),
        }
    };
}
pub use __library_file as library_file;

/// The files of Common Lisp and alexandria, in the order of the standard's chapters.
static FILES: &[File] = &[
    library_file!("src/lisp/library", "definitions.lisp"),
    library_file!("src/lisp/library", "objects.lisp"),
    library_file!("src/lisp/library", "method-combinations.lisp"),
    library_file!("src/lisp/library", "metaobjects.lisp"),
    library_file!("src/lisp/library", "trivial-garbage.lisp"),
    library_file!("src/lisp/library", "control.lisp"),
    library_file!("src/lisp/library", "places.lisp"),
    library_file!("src/lisp/library", "conditions.lisp"),
    library_file!("src/lisp/library", "packages.lisp"),
    library_file!("src/lisp/library", "lists.lisp"),
    library_file!("src/lisp/library", "trees.lisp"),
    library_file!("src/lisp/library", "sets.lisp"),
    library_file!("src/lisp/library", "streams.lisp"),
    library_file!("src/lisp/library", "gray-streams.lisp"),
    library_file!("src/lisp/library", "readtables.lisp"),
    library_file!("src/lisp/library", "printer.lisp"),
    library_file!("src/lisp/library", "pretty-printer.lisp"),
    library_file!("src/lisp/library", "alexandria-symbols.lisp"),
    library_file!("src/lisp/library", "alexandria-macros.lisp"),
    library_file!("src/lisp/library", "alexandria-lambda-lists.lisp"),
    library_file!("src/lisp/library", "alexandria-functions.lisp"),
    library_file!("src/lisp/library", "alexandria-control.lisp"),
    library_file!("src/lisp/library", "alexandria-conditions.lisp"),
    library_file!("src/lisp/library", "alexandria-hash-tables.lisp"),
    library_file!("src/lisp/library", "alexandria-lists.lisp"),
    library_file!("src/lisp/library", "alexandria-sequences.lisp"),
    library_file!("src/lisp/library", "alexandria-combinations.lisp"),
    library_file!("src/lisp/library", "alexandria-numbers.lisp"),
    library_file!("src/lisp/library", "alexandria-arrays.lisp"),
    library_file!("src/lisp/library", "alexandria-types.lisp"),
    library_file!("src/lisp/library", "alexandria-files.lisp"),
    library_file!("src/lisp/library", "alexandria-2.lisp"),
    library_file!("src/lisp/library", "pathnames.lisp"),
    library_file!("src/lisp/library", "logical-pathnames.lisp"),
    library_file!("src/lisp/library", "files.lisp"),
    library_file!("src/lisp/library", "time.lisp"),
    library_file!("src/lisp/library", "environment.lisp"),
    library_file!("src/lisp/library", "tracing.lisp"),
    library_file!("src/lisp/library", "package-locks.lisp"),
    library_file!("src/lisp/library", "macroexpand-all.lisp"),
];

/// The library of the language without robots.
pub static LIBRARY: LazyLock<Library> = LazyLock::new(|| Library::of(FILES));

impl Library {
    /// Finds the definitions in files.
    pub fn of(files: &'static [File]) -> Library {
        let mut library = Library {
            definitions: Vec::new(),
            forms: Vec::new(),
        };
        for file in files {
            index::find(file, &mut library);
        }
        library
    }
}

/// Makes the names of a library known in an image, and evaluates its other forms. The
/// packages of its files must exist.
pub fn install(image: &mut Image, library: &'static Library) {
    image.library.compile = Some(deferred::compile);
    for definition in &library.definitions {
        install_definition(image, definition);
    }
    for form in &library.forms {
        if let Err(raise) = deferred::evaluate(image, form) {
            tell_failure(image, form, &raise);
        }
    }
}

/// Reports that a form of the library has failed, where the user sees it before anything else.
fn tell_failure(image: &mut Image, form: &Definition, raise: &Raise) {
    let report = match condition::make(image, raise) {
        Ok(condition) => print::to_string(image, &condition, false),
        Err(_) => "an error that cannot be described".to_owned(),
    };
    let text = format!("{} fails: {report}\n", form.location());
    image.output.write(&text);
}

/// What all definitions of the libraries of an image, and the plans that it has loaded, are compiled
/// to, if the image keeps that.
pub fn precompile(image: &mut Image) -> Result<Vec<u8>, Box<Raise>> {
    for (number, definition) in image.library.definitions.clone().into_iter().enumerate() {
        if let Some(name) = symbol(image, definition) {
            image.force(&Deferred::new(name, number))?;
        }
    }
    let precompiler = image.library.precompiler.take().unwrap_or_default();
    Ok(precompiler.finish())
}

fn install_definition(image: &mut Image, definition: &'static Definition) {
    let Some(name) = symbol(image, definition) else {
        let raise = Raise::program("There is no such package.");
        return tell_failure(image, definition, &raise);
    };
    let number = image.library.definitions.len();
    image.library.definitions.push(definition);
    let function = Rc::new(Function::deferred(Deferred::new(name, number)));
    let data = image.symbols.get_mut(name);
    match definition.kind {
        Kind::Function => data.function = FunctionCell::Function(function),
        Kind::Macro => data.function = FunctionCell::Macro(function),
        Kind::Setter => {
            data.setf_function = Some(function);
            return;
        }
        Kind::Form => return,
    }
    image.entries.insert(name, Entry::Library(definition));
}

/// The symbol that a definition defines, exported from its package.
fn symbol(image: &mut Image, definition: &Definition) -> Option<Sym> {
    let package = match definition.is_helper() {
        true => PackageTable::SYSTEM,
        false => image.packages.find(&definition.package)?,
    };
    Some(image.export_symbol(package, &definition.name))
}

/// The definition of a function or macro of the library, or none.
pub fn definition_of(image: &Image, function: &Function) -> Option<&'static Definition> {
    let number = function.as_deferred()?.number;
    image.library.definitions.get(number).copied()
}

/// The value of `*package*` while a form of this package is read.
fn standard_value(image: &Image, package: &str) -> Value {
    match image.packages.find(package) {
        Some(id) => Value::Package(id),
        None => Value::Package(PackageTable::SYSTEM),
    }
}
