//! Poses, transforms, vectors and quaternions as values of plans.
//!
//! Functions that need the robot or the world (looking up a transform, the robot's pose) are
//! elsewhere. Lengths are in metres, angles in radians, quaternions in the order x y z w. A
//! quaternion is stored as given, for printing, and normalised for every computation.

pub(crate) mod algebra;
pub mod argument;
pub(crate) mod construct;
pub mod names;
pub(crate) mod pose_functions;
pub mod rotation;
pub mod stamped;
pub mod tutorial;
pub mod value;

use super::packages::{ensure, name_symbol};
use lisp::image::Image;
use lisp::object::define::ClassDefinition;
use lisp::value::Value;
use lisp::value::class::ClassKind;
use lisp::value::known;
use lisp::value::package::Access;
use lisp::value::symbol::Sym;

/// Classes: symbol, its name, superclass, and whether it is one of the stamped ones.
const CLASSES: &[(Sym, &str, Sym, bool)] = &[
    (names::VECTOR_3D, "3D-VECTOR", known::T, false),
    (names::QUATERNION, "QUATERNION", known::T, false),
    (names::POSE, "POSE", known::T, false),
    (names::TRANSFORM, "TRANSFORM", known::T, false),
    (names::POSE_STAMPED, "POSE-STAMPED", names::POSE, true),
    (
        names::TRANSFORM_STAMPED,
        "TRANSFORM-STAMPED",
        names::TRANSFORM,
        true,
    ),
];

/// Defines the packages, classes, variables and functions.
pub fn install(image: &mut Image) {
    let plain = ensure(image, "CL-TRANSFORMS", &[]);
    let stamped = ensure(image, "CL-TRANSFORMS-STAMPED", &["CL-TF", "CL-TF2"]);
    let cram = ensure(image, "CRAM-TF", &[]);
    let tutorial = ensure(image, "CRAM-PICK-PLACE-TUTORIAL", &["PP-TUT"]);
    for (symbol, name, superclass, is_stamped) in CLASSES {
        let home = if *is_stamped { stamped } else { plain };
        name_symbol(image, *symbol, home, name);
        // The table is consistent: superclasses precede their subclasses.
        let _ = image.define_unchecked(ClassDefinition {
            name: *symbol,
            kind: ClassKind::Builtin,
            superclasses: vec![*superclass],
            slots: Vec::new(),
            default_initargs: Vec::new(),
            doc: None,
        });
    }
    for table in [
        construct::TABLE,
        algebra::TABLE,
        rotation::TABLE,
        pose_functions::TABLE,
    ] {
        image.install(plain, table);
    }
    for package in [stamped, cram] {
        image.packages.use_package(package, plain);
    }
    image.install(stamped, stamped::TABLE);
    image.packages.use_package(cram, stamped);
    image.install(cram, stamped::CRAM_TABLE);
    image.install(tutorial, tutorial::TABLE);
    // Both `cl-tf:make-3d-vector` and `cl-transforms:make-3d-vector` are in use.
    let names: Vec<Sym> = image
        .packages
        .get(plain)
        .symbols
        .values()
        .filter(|(_, external)| *external)
        .map(|(sym, _)| *sym)
        .collect();
    for sym in names {
        let name = image.name(sym).to_owned();
        let taken = matches!(
            image.packages.find_symbol(stamped, &name),
            Some((_, Access::External | Access::Internal))
        );
        if !taken {
            image.packages.export(&mut image.symbols, stamped, sym);
        }
    }
    // What the robot calls its frames is known where there is a robot.
    let fixed = image.export_symbol(cram, "*FIXED-FRAME*");
    image.define_special(fixed, Value::string("map"));
}

#[cfg(test)]
mod tests;
