//! The chapter on Prolog goals: the functors that need no rules.

use super::{code, line};
use cram::prolog::facts;
use lisp::image::Image;

pub(crate) fn write(to: &mut String, image: &Image) {
    line(to, "\n## Prolog goals\n");
    line(
        to,
        "Goals of `(prolog:prolog goal)` and of rules in `prolog:def-fact-group`, beside those that rules define. A functor is known by its name, in whatever package that is written.\n",
    );
    line(to, "| goal | holds when |\n|---|---|");
    for functor in facts::of(image).functors() {
        let goal = match functor.arguments {
            "" => format!("({})", functor.name),
            arguments => format!("({} {arguments})", functor.name),
        };
        line(to, &format!("| {} | {} |", code(&goal), functor.doc));
    }
}
