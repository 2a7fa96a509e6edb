//! Powers, roots, logarithms, trigonometric and hyperbolic functions.

use crate::builtin::{Builtin, pure};
use crate::value::{Value, number};

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "EXPT",
        "base power",
        "The base to the power.",
        &[
            "(expt 2 10) => 1024",
            "(expt 2 0.5) => 1.4142135",
            "(expt 2 -1) => 1/2",
        ],
        |_, args| number::expt(&args[0], &args[1]),
    ),
    pure(
        "SQRT",
        "number",
        "The square root; that of a negative number is complex.",
        &[
            "(sqrt 2d0) => 1.4142135623730951d0",
            "(sqrt -1) => #C(0.0 1.0)",
        ],
        |_, args| number::sqrt(&args[0]),
    ),
    pure(
        "EXP",
        "number",
        "e to the power of the number.",
        &["(exp 0) => 1.0"],
        |_, args| number::exp(&args[0]),
    ),
    pure(
        "LOG",
        "number &optional base",
        "The natural logarithm, or that to a base.",
        &["(log 8 2) => 3.0", "(log 10d0) => 2.302585092994046d0"],
        |_, args| match args.get(1) {
            Some(base) => number::log_base(&args[0], base),
            None => number::log(&args[0]),
        },
    ),
    pure(
        "SIN",
        "radians",
        "The sine of an angle in rad.",
        &["(sin 0) => 0.0", "(sin (/ pi 6)) => 0.49999999999999994d0"],
        |_, args| number::sin(&args[0]),
    ),
    pure(
        "COS",
        "radians",
        "The cosine of an angle in rad.",
        &["(cos pi) => -1.0d0"],
        |_, args| number::cos(&args[0]),
    ),
    pure(
        "TAN",
        "radians",
        "The tangent of an angle in rad.",
        &["(tan 0) => 0.0"],
        |_, args| number::tan(&args[0]),
    ),
    pure(
        "ASIN",
        "number",
        "The angle in rad whose sine is the number.",
        &["(asin 1) => 1.5707964"],
        |_, args| number::asin(&args[0]),
    ),
    pure(
        "ACOS",
        "number",
        "The angle in rad whose cosine is the number.",
        &["(acos 1.0) => 0.0"],
        |_, args| number::acos(&args[0]),
    ),
    pure(
        "ATAN",
        "y &optional x",
        "The angle in rad whose tangent is y, or that of the vector (x, y).",
        &["(atan 1) => 0.7853982", "(atan -1 -1) => -2.3561945"],
        |_, args| match args.get(1) {
            Some(x) => number::atan2(&args[0], x),
            None => number::atan(&args[0]),
        },
    ),
    pure(
        "SINH",
        "number",
        "The hyperbolic sine.",
        &["(sinh 1d0) => 1.1752011936438014d0"],
        |_, args| number::sinh(&args[0]),
    ),
    pure(
        "COSH",
        "number",
        "The hyperbolic cosine.",
        &["(cosh 0) => 1.0"],
        |_, args| number::cosh(&args[0]),
    ),
    pure(
        "TANH",
        "number",
        "The hyperbolic tangent.",
        &["(tanh 0) => 0.0"],
        |_, args| number::tanh(&args[0]),
    ),
    pure(
        "ASINH",
        "number",
        "The inverse of the hyperbolic sine.",
        &["(asinh 0) => 0.0"],
        |_, args| number::asinh(&args[0]),
    ),
    pure(
        "ACOSH",
        "number",
        "The inverse of the hyperbolic cosine.",
        &["(acosh 1) => 0.0"],
        |_, args| number::acosh(&args[0]),
    ),
    pure(
        "ATANH",
        "number",
        "The inverse of the hyperbolic tangent.",
        &["(atanh 0) => 0.0"],
        |_, args| number::atanh(&args[0]),
    ),
    pure(
        "COMPLEX",
        "realpart &optional imagpart",
        "The complex number with these parts.",
        &["(complex 1 2) => #C(1 2)", "(complex 1 0) => 1"],
        |_, args| match args.get(1) {
            Some(imaginary) => number::complex(&args[0], imaginary),
            None => number::complex(&args[0], &Value::Int(0)),
        },
    ),
    pure(
        "REALPART",
        "number",
        "The real part.",
        &["(realpart #c(1 2)) => 1"],
        |_, args| number::real_part(&args[0]),
    ),
    pure(
        "IMAGPART",
        "number",
        "The imaginary part.",
        &["(imagpart #c(1 2)) => 2", "(imagpart 5) => 0"],
        |_, args| number::imaginary_part(&args[0]),
    ),
    pure(
        "CONJUGATE",
        "number",
        "The complex conjugate.",
        &["(conjugate #c(1 2)) => #C(1 -2)"],
        |_, args| number::conjugate(&args[0]),
    ),
    pure(
        "PHASE",
        "number",
        "The angle in rad of the number in the plane.",
        &["(phase -1) => 3.1415927"],
        |_, args| number::phase(&args[0]),
    ),
    pure(
        "CIS",
        "radians",
        "The complex number of magnitude one at an angle in rad.",
        &["(cis 0) => #C(1.0 0.0)"],
        |_, args| number::cis(&args[0]),
    ),
];
