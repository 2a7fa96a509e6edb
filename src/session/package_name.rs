//! Names of packages as users see them.

use lisp::image::Image;
use lisp::value::package::{PackageId, PackageTable};

/// The name of a package, or a nickname, as prompts show it.
pub(super) fn prompt_name(image: &Image, package: PackageId) -> String {
    if package == PackageTable::USER {
        return "CL-USER".to_owned();
    }
    short_name(image, package)
}

/// The shortest name of a package.
pub(crate) fn short_name(image: &Image, package: PackageId) -> String {
    let package = image.packages.get(package);
    std::iter::once(&package.name)
        .chain(&package.nicknames)
        .min_by_key(|name| name.chars().count())
        .map_or_else(String::new, |name| name.to_string())
}
