//! Builtins called with arguments of all kinds return or signal a condition; they never
//! panic.

use planwright::dialogue::{Evaluate, Event};
use planwright::lisp::Image;
use planwright::session::Session;

/// Arguments of all kinds.
const ARGUMENTS: &[&str] = &[
    "nil",
    "t",
    "0",
    "1",
    "-1",
    "5",
    "100000000000000000000",
    "1/2",
    "1.5",
    "-2d0",
    "\"abc\"",
    "\"\"",
    "\"naïve\"",
    "#\\a",
    "'a",
    "'car",
    ":start",
    ":end",
    ":key",
    ":test",
    ":count",
    "(list 1 2 3)",
    "(list \"b\" \"a\")",
    "(list 'a 1 'b 2)",
    "(list (cons 'a 1) (cons 'b 2))",
    "(cons 1 2)",
    "(vector 1 2 3)",
    "(vector)",
    "(copy-seq #*101)",
    "(make-array '(2 2) :initial-element 0)",
    "(make-array nil)",
    "(make-array 3 :fill-pointer 1 :initial-element 7)",
    "(make-array 2 :element-type 'character :fill-pointer 1 :initial-element #\\x)",
    "(make-hash-table)",
    "(make-string-input-stream \"one (two) 3\")",
    "(make-string-output-stream)",
    "(make-concatenated-stream (make-string-input-stream \"x\"))",
    "(find-package :cl)",
    "(make-symbol \"U\")",
    "#'car",
    "#'<",
    "(lambda (&rest r) (first r))",
    "(lambda () 1)",
    "'list",
    "'vector",
    "'string",
    "'(vector t 2)",
    "'setf",
    "'(setf car)",
    "(make-condition 'error)",
    "(find-class 'integer)",
];

/// Builtins that leave, wait, touch files, or change what the test itself stands on.
const LEFT_OUT: &[&str] = &[
    "QUIT",
    "EXIT",
    "OPEN",
    "DELETE-FILE",
    "RENAME-FILE",
    "ENSURE-DIRECTORIES-EXIST",
    "LOAD",
    "SLEEP",
    "BREAK",
    "INVOKE-DEBUGGER",
];

/// A small generator of numbers: the same ones on every run.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % limit
    }
}

#[test]
fn no_arguments_make_a_builtin_panic() {
    let mut numbers = Numbers(1);
    let mut names: Vec<(String, usize)> = Vec::new();
    let image = Image::new();
    for (sym, builtin) in &image.builtins {
        if LEFT_OUT.contains(&builtin.name) {
            continue;
        }
        let package = image.symbol(*sym).package.expect("builtins have packages");
        let package = image.packages.get(package).name.clone();
        names.push((
            format!("{package}::{}", builtin.name),
            usize::from(builtin.arity().0),
        ));
    }
    for (name, least) in names {
        let mut session = Session::new();
        for round in 0..40 {
            let count = if round % 3 == 0 {
                least + numbers.below(4)
            } else {
                least + round % 2 * 2
            };
            let arguments: Vec<&str> = (0..count)
                .map(|_| ARGUMENTS[numbers.below(ARGUMENTS.len())])
                .collect();
            let form = format!(
                "(ignore-errors (|{}| {}) nil)",
                name.replace("::", "|::|"),
                arguments.join(" ")
            );
            session.evaluate("robustness", &form, &mut |event| {
                if let Event::Aborted(abort) = event {
                    // Conditions that are no errors may reach the top.
                    let _ = abort;
                }
            });
        }
    }
}
