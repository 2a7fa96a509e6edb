//! What the language does, without robots.

mod array_elements;
mod arrays;
mod builtin_robustness;
mod classes_by_name;
mod complex_types;
mod debugger_and_packages;
mod files;
mod formatters;
mod generic_functions;
mod gray_streams;
mod handler_types;
mod last_corners;
mod macros;
mod malformed_forms;
mod metaobjects;
mod method_combinations;
mod package_locks;
mod passing_symbols;
mod pathnames;
mod pretty_printer;
mod printing;
mod reader_round_trip;
mod reading;
mod readtables;
mod redefined_classes;
mod restarts;
mod standard;
mod standard_variables;
mod type_specifiers;
mod weak_pointers;

/// A folder for files that tests write.
fn scratch_folder() -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("planwright-lisp-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder can be made");
    folder
}
