//! Makes the packages used in plans, and their exported symbols.

use lisp::image::Image;
use lisp::value::package::{PackageId, PackageTable};
use lisp::value::symbol::Sym;

use crate::package_table::{IMPORTS, PACKAGES, USES};

/// The package with that name, made if necessary, with the nicknames.
pub(crate) fn ensure(image: &mut Image, name: &str, nicknames: &[&str]) -> PackageId {
    let id = match image.packages.find(name) {
        Some(id) => id,
        // The name is free, so `make` fails only if there are 65536 packages.
        None => image.packages.make(name, &[]).unwrap_or(PackageTable::USER),
    };
    for nickname in nicknames {
        image.packages.add_nickname(id, nickname);
    }
    id
}

/// The exported symbol of a package; package and symbol are made if necessary.
pub fn symbol(image: &mut Image, package: &str, name: &str) -> Sym {
    let id = ensure(image, package, &[]);
    image.export_symbol(id, name)
}

/// Gives a symbol without a name a name and a home package, from which it is exported.
pub(crate) fn name_symbol(image: &mut Image, sym: Sym, package: PackageId, name: &str) {
    let data = image.symbols.get_mut(sym);
    data.name = name.into();
    data.package = Some(package);
    image.packages.export(&mut image.symbols, package, sym);
}

/// Makes all packages of the table, with their symbols.
pub fn install(image: &mut Image) {
    for row in PACKAGES {
        let id = ensure(image, row.name, row.nicknames);
        use_packages(image, id, row.uses);
    }
    for (package, from, names, exported) in IMPORTS {
        let (id, from) = (ensure(image, package, &[]), ensure(image, from, &[]));
        for name in names.split_whitespace() {
            let sym = image.export_symbol(from, name);
            image.packages.import(&mut image.symbols, id, sym);
            if *exported {
                image.packages.export(&mut image.symbols, id, sym);
            }
        }
    }
    for row in PACKAGES {
        let id = ensure(image, row.name, &[]);
        for name in row.exports.split_whitespace() {
            image.export_symbol(id, name);
        }
    }
    for (package, used) in USES {
        let id = ensure(image, package, &[]);
        use_packages(image, id, used);
    }
}

/// Makes a package inherit from those of the named packages that exist.
fn use_packages(image: &mut Image, id: PackageId, names: &[&str]) {
    for name in names {
        if let Some(used) = image.packages.find(name) {
            image.packages.use_package(id, used);
        }
    }
}
