//! The reference manual: Markdown made from the tables that the language itself uses.
//!
//! Nothing is written twice: names, lambda lists, texts and examples come from the tables of
//! builtins and operators, the keys of designators from their schema, and the failures from the
//! classes of the image. Only the chapter on differences from Common Lisp is written by hand.

mod designators;
mod entries;
mod failures;
mod functors;
mod objects;

use std::fmt::Write;

use cram::designator::value::Class;
use lisp::image::Image;
use session::Session;

const INTRODUCTION: &str = include_str!("introduction.md");
const DIFFERENCES: &str = include_str!("differences.md");

/// The whole manual of what is defined in a session.
pub(crate) fn markdown(session: &Session) -> String {
    let mut to = String::new();
    let (image, simulation) = (session.image(), session.simulation());
    let packages = entries::packages(image);
    to.push_str(INTRODUCTION);
    to.push('\n');
    for package in &packages {
        let count = package.entries.len();
        line(
            &mut to,
            &format!(
                "- [Package {0}](#package-{1}) ({count})",
                package.name,
                package.name.to_lowercase(),
            ),
        );
    }
    to.push_str(
        "- [Actions](#actions)\n- [Motions](#motions)\n- [Prolog goals](#prolog-goals)\n- [Failures](#failures)\n\
         - [Objects and grasps](#objects-and-grasps)\n\n",
    );
    to.push_str(DIFFERENCES);
    for package in &packages {
        package.write(&mut to);
    }
    designators::write(&mut to, image);
    functors::write(&mut to, image);
    failures::write(&mut to, image);
    objects::write(
        &mut to,
        simulation.object_types(),
        simulation.grasp_library(),
    );
    to
}

/// The actions, with their keys.
pub(crate) fn actions(image: &Image) -> String {
    let mut to = String::new();
    designators::chapter(&mut to, image, Class::Action);
    to
}

/// The motions, with their keys.
pub(crate) fn motions(image: &Image) -> String {
    let mut to = String::new();
    designators::chapter(&mut to, image, Class::Motion);
    to
}

/// The types of objects, with their grasps.
pub(crate) fn object_types(session: &Session) -> String {
    let mut to = String::new();
    let simulation = session.simulation();
    objects::write(
        &mut to,
        simulation.object_types(),
        simulation.grasp_library(),
    );
    to
}

/// Appends a line.
fn line(to: &mut String, text: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(to, "{text}");
}

/// A name as the manual shows it: in lower case, as code.
fn code(name: &str) -> String {
    format!("`{}`", name.to_lowercase())
}

/// Several names as the manual shows them.
fn codes<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let shown: Vec<String> = names.into_iter().map(code).collect();
    shown.join(", ")
}
