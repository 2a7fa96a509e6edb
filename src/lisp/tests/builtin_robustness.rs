//! Builtins called with arguments of all kinds return or signal a condition; they never
//! panic.

use crate::Image;
use crate::builtin::arity;
use crate::reader::read_all;
use crate::value::known;
use crate::vm::fiber::Fiber;
use crate::vm::machine::Machine;

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
    "WRITE-STRING-INTO-FILE",
    "COPY-FILE",
    "LOAD",
    "SLEEP",
    "BREAK",
    "INVOKE-DEBUGGER",
];

/// A call ends at this look at the interrupt flag at the latest.
const MAX_POLLS: u64 = 1000;

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

/// Evaluates a form; what comes of it does not matter.
fn evaluate(image: &mut Image, text: &str) {
    let source = image.sources.add("robustness", text);
    // Not every random text is well-formed.
    let Ok(forms) = read_all(image, source) else {
        return;
    };
    for (form, _) in forms {
        // Some functions of the library would count to a number that nobody lives to see.
        image.polls().begin(Some(MAX_POLLS));
        let mut fiber = Fiber::default();
        Machine::new(image, &mut fiber).start(known::EVAL.into(), vec![form]);
        Machine::new(image, &mut fiber).unwind_all();
    }
}

#[test]
fn no_arguments_make_a_builtin_panic() {
    let mut numbers = Numbers(1);
    let image = Image::new();
    let functions = image
        .entries
        .iter()
        .filter(|(_, entry)| entry.kind() == "function");
    let functions = functions.filter(|(sym, _)| !LEFT_OUT.contains(&image.name(**sym)));
    let names: Vec<(String, usize)> = functions
        .map(|(sym, entry)| {
            let package = image.symbol(*sym).package.expect("functions have packages");
            let package = &image.packages.get(package).name;
            let name = format!("|{package}|::|{}|", image.name(*sym));
            (name, usize::from(arity(entry.lambda_list()).0))
        })
        .collect();
    for (name, least) in names {
        let mut image = Image::new();
        for round in 0..60 {
            let more = if round % 2 == 0 { numbers.below(5) } else { 0 };
            let arguments: Vec<&str> = (0..least + more)
                .map(|_| ARGUMENTS[numbers.below(ARGUMENTS.len())])
                .collect();
            evaluate(&mut image, &format!("({name} {})", arguments.join(" ")));
        }
    }
}
