//! The chapter on failures: the tree of their classes.

use std::rc::Rc;

use super::{code, line};
use lisp::image::Image;
use lisp::value::class::Class;

pub(crate) fn write(to: &mut String, image: &Image) {
    line(to, "\n## Failures\n");
    line(
        to,
        "Plans handle these with `with-failure-handling`; a handler of a class gets the \
         classes below it, too. Behind a class: the keywords that `make-condition` and `fail` \
         take besides those of the classes above it. A class with several superclasses stands \
         below each.\n",
    );
    for (package, name) in [
        ("CRAM-LANGUAGE", "PLAN-FAILURE"),
        ("CRAM-LANGUAGE", "POLICY-CONDITION"),
    ] {
        let class = image
            .packages
            .find(package)
            .and_then(|id| image.packages.find_symbol(id, name))
            .and_then(|(sym, _)| image.class(sym));
        if let Some(class) = class {
            write_tree(to, image, class);
        }
    }
}

/// The class and its subclasses, indented. Superclasses form no cycles, so the recursion ends.
fn write_tree(to: &mut String, image: &Image, root: &Rc<Class>) {
    let mut open = vec![(0, root.clone())];
    while let Some((depth, class)) = open.pop() {
        let keywords: Vec<String> = class
            .direct_slots
            .borrow()
            .iter()
            .flat_map(|slot| slot.initargs.clone())
            .map(|keyword| format!("`:{}`", image.name(keyword).to_lowercase()))
            .collect();
        let name = code(image.name(class.name));
        let shown = if keywords.is_empty() {
            name
        } else {
            format!("{name}: {}", keywords.join(", "))
        };
        line(to, &format!("{:1$}- {shown}", "", 2 * depth));
        let below = class.direct_subclasses.borrow();
        open.extend(below.iter().rev().map(|sub| (depth + 1, sub.clone())));
    }
}
