//! All tables of builtins and operators, by package.

use super::*;
use crate::builtin::{Builtin, Operator};
use crate::compile;
use crate::image::Image;
use crate::loop_macro;
use crate::value::package::PackageTable;

/// Functions of package `COMMON-LISP`.
pub static FUNCTIONS: &[&[Builtin]] = &[
    characters::COMPARISONS,
    characters::TABLE,
    conditions::TABLE,
    definitions::TABLE,
    documentation::TABLE,
    evaluation::TABLE,
    generic_functions::TABLE,
    list_search::TABLE,
    lists::TABLE,
    implementation::TABLE,
    loading::TABLE,
    mapping::TABLE,
    object_printing::TABLE,
    objects::TABLE,
    pairs::PATHS,
    pairs::ORDINALS,
    pairs::TABLE,
    property_lists::TABLE,
    sequence_access::TABLE,
    sequence_change::TABLE,
    sequence_duplicates::TABLE,
    sequence_find::TABLE,
    sequence_map::TABLE,
    sequence_search::TABLE,
    restarts::TABLE,
    signalling::TABLE,
    sort::TABLE,
    string_compare::TABLE,
    string_compare::COMPARISONS,
    strings::TABLE,
    types::TABLE,
    array_adjust::TABLE,
    array_make::TABLE,
    arrays::TABLE,
    bits::TABLE,
    bits::OPERATIONS,
    pathnames::TABLE,
    fill_pointers::TABLE,
    hash_tables::TABLE,
    help::TABLE,
    packages::TABLE,
    package_symbols::TABLE,
    streams::TABLE,
    stream_elements::TABLE,
    stream_parts::TABLE,
    symbols::TABLE,
    structures::TABLE,
    format::TABLE,
    number_theory::TABLE,
    numbers::TABLE,
    printing::TABLE,
    reading::TABLE,
    readtables::TABLE,
    transcendental::TABLE,
];

/// Functions of package `SYSTEM`: what macros expand into.
pub(crate) static SYSTEM_FUNCTIONS: &[&[Builtin]] = &[
    arguments::SYSTEM_TABLE,
    definitions::SYSTEM_TABLE,
    format::SYSTEM_TABLE,
    generic_functions::SYSTEM_TABLE,
    objects::SYSTEM_TABLE,
    property_lists::SYSTEM_TABLE,
    restarts::SYSTEM_TABLE,
    signalling::SYSTEM_TABLE,
    types::SYSTEM_TABLE,
    weak_pointers::SYSTEM_TABLE,
    hash_tables::SYSTEM_TABLE,
    loop_macro::SYSTEM_TABLE,
    package_macros::SYSTEM_TABLE,
    packages::SYSTEM_TABLE,
    stream_parts::SYSTEM_TABLE,
    metaobjects::SYSTEM_TABLE,
    reading::SYSTEM_TABLE,
    readtables::SYSTEM_TABLE,
    files::SYSTEM_TABLE,
    pathnames::SYSTEM_TABLE,
    structures::SYSTEM_TABLE,
    printing::SYSTEM_TABLE,
    pretty_printing::SYSTEM_TABLE,
];

/// What `setf` calls for places of package `COMMON-LISP`.
pub(crate) static SETTERS: &[&[Builtin]] = &[
    pairs::PATH_SETTERS,
    pairs::ORDINAL_SETTERS,
    pairs::SETTERS,
    property_lists::SETTERS,
    sequence_access::SETTERS,
    strings::SETTERS,
    arrays::SETTERS,
    fill_pointers::SETTERS,
    hash_tables::SETTERS,
    readtables::SETTERS,
    symbols::SETTERS,
    documentation::SETTERS,
    objects::SETTERS,
];

/// Special operators and macros of package `COMMON-LISP`.
pub static OPERATORS: &[&[Operator]] = &[
    compile::SPECIAL_FORMS,
    compile::OPERATORS,
    loop_macro::OPERATORS,
    generic_functions::OPERATORS,
    objects::OPERATORS,
    structures::OPERATORS,
    format::OPERATORS,
];

/// Special operators and macros of package `SYSTEM`.
pub(crate) static SYSTEM_OPERATORS: &[&[Operator]] =
    &[compile::SYSTEM_FORMS, compile::SYSTEM_OPERATORS];

/// Installs everything in an image.
pub fn install(image: &mut Image) {
    for table in FUNCTIONS {
        image.install(PackageTable::CL, table);
    }
    for table in SYSTEM_FUNCTIONS {
        image.install(PackageTable::SYSTEM, table);
    }
    for table in SETTERS {
        image.install_setf(PackageTable::CL, table);
    }
    for table in OPERATORS {
        image.install_operators(PackageTable::CL, table);
    }
    for table in SYSTEM_OPERATORS {
        image.install_operators(PackageTable::SYSTEM, table);
    }
    standard_names::install(image);
    make_alexandria(image);
}

/// Makes the packages that the library's alexandria fills.
fn make_alexandria(image: &mut Image) {
    let packages: [(&str, &[&str]); 2] = [
        ("ALEXANDRIA", &["ALEXANDRIA-1", "ALEXANDRIA.1.0.0"]),
        ("ALEXANDRIA-2", &["ALEXANDRIA.2"]),
    ];
    for (name, nicknames) in packages {
        if let Some(package) = image.packages.make(name, nicknames) {
            image.packages.use_package(package, PackageTable::CL);
        }
    }
}
