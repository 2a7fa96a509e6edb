//! Values as the reader writes them, results as `type value`.

use super::*;
use crate::reader::numeric::parse_number;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

fn n(text: &str) -> Value {
    parse_number(text, 10, known::SINGLE_FLOAT)
        .expect("a number")
        .expect("in range")
}

fn show(value: &Value) -> String {
    match value {
        Value::Int(n) => n.to_string(),
        Value::Big(n) => n.to_string(),
        Value::Ratio(r) => format!("{}/{}", r.numerator, r.denominator),
        Value::Single(x) => format!("{x:?}"),
        Value::Double(x) => format!("{x:?}d0"),
        _ => "?".to_owned(),
    }
}

fn ok(result: error::NumberResult) -> String {
    match result {
        Ok(value) => show(&value),
        Err(raise) => class(&raise),
    }
}

fn class(raise: &Raise) -> String {
    match raise {
        Raise::Make { class, .. } if *class == known::DIVISION_BY_ZERO => "division by zero",
        Raise::Make { class, .. } if *class == known::FLOATING_POINT_OVERFLOW => "overflow",
        Raise::Make { class, .. } if *class == known::TYPE_ERROR => "type error",
        _ => "another error",
    }
    .to_owned()
}

fn both(result: Result<(Value, Value), Box<Raise>>) -> String {
    match result {
        Ok((q, r)) => format!("{} {}", show(&q), show(&r)),
        Err(raise) => class(&raise),
    }
}

#[test]
fn integers_overflow_into_big_ones_and_back() {
    assert_eq!(
        ok(add(&n("1"), &n("9223372036854775807"))),
        "9223372036854775808"
    );
    assert_eq!(
        ok(sub(&n("9223372036854775808"), &n("1"))),
        "9223372036854775807"
    );
    assert_eq!(
        ok(mul(&n("-9223372036854775808"), &n("-1"))),
        "9223372036854775808"
    );
    assert_eq!(
        ok(negate(&n("-9223372036854775808"))),
        "9223372036854775808"
    );
    assert!(matches!(
        sub(&n("9223372036854775808"), &n("1")),
        Ok(Value::Int(_))
    ));
}

#[test]
fn ratios_stay_in_lowest_terms() {
    assert_eq!(ok(div(&n("-6"), &n("4"))), "-3/2");
    assert_eq!(ok(div(&n("6"), &n("-3"))), "-2");
    assert_eq!(ok(add(&n("1/2"), &n("1/3"))), "5/6");
    assert_eq!(ok(mul(&n("1/2"), &n("4"))), "2");
    assert_eq!(ok(div(&n("5"), &n("0"))), "division by zero");
    assert_eq!(ok(div(&n("5"), &n("0.0"))), "division by zero");
}

#[test]
fn floats_are_contagious() {
    assert_eq!(ok(add(&n("1"), &n("1.0"))), "2.0");
    assert_eq!(ok(add(&n("1.0"), &n("1d0"))), "2.0d0");
    assert_eq!(ok(sub(&n("1.0"), &n("0.9"))), "0.100000024");
    assert_eq!(ok(mul(&n("1.1"), &n("1.1"))), "1.21");
    assert_eq!(ok(mul(&n("1d200"), &n("1d200"))), "overflow");
    assert_eq!(ok(add(&n("1"), &Value::NIL)), "type error");
    assert_eq!(ok(to_single(&n("1/3"))), "0.33333334");
    assert_eq!(ok(to_double(&n("1/3"))), "0.3333333333333333d0");
}

#[test]
fn comparison_is_exact() {
    assert!(!number_equal(&n("0.1"), &n("0.1d0")).ok().unwrap());
    assert!(number_equal(&n("0.5"), &n("1/2")).ok().unwrap());
    assert!(!number_equal(&n("0.1d0"), &n("1/10")).ok().unwrap());
    assert!(less(&n("16777216.0"), &n("16777217")).ok().unwrap());
    assert!(
        less(&n("9007199254740992d0"), &n("9007199254740993"))
            .ok()
            .unwrap()
    );
    assert!(less(&n("1/3"), &n("1/2")).ok().unwrap());
    assert!(equal_by_value(&n("-0.0"), &n("0")));
}

#[test]
fn quotients_are_rounded_four_ways() {
    assert_eq!(both(floor(&n("-7"), &n("2"))), "-4 1");
    assert_eq!(both(floor(&n("7"), &n("-2"))), "-4 -1");
    assert_eq!(both(ceiling(&n("7"), &n("2"))), "4 -1");
    assert_eq!(both(truncate(&n("-7"), &n("2"))), "-3 -1");
    assert_eq!(both(round(&n("7"), &n("2"))), "4 -1");
    assert_eq!(both(round(&n("-7"), &n("2"))), "-4 1");
    assert_eq!(both(round(&n("5"), &n("2"))), "2 1");
    assert_eq!(both(round(&n("7/2"), &n("1"))), "4 -1/2");
    assert_eq!(both(round(&n("2.5"), &n("1"))), "2 0.5");
    assert_eq!(both(round(&n("2.6"), &n("1"))), "3 -0.4000001");
    assert_eq!(both(truncate(&n("-7.9"), &n("1"))), "-7 -0.9000001");
    assert_eq!(both(floor(&n("7.5"), &n("2"))), "3 1.5");
    assert_eq!(
        both(round(&n("1000000000000.5d0"), &n("1"))),
        "1000000000000 0.5d0"
    );
    assert_eq!(
        both(truncate(&n("1d20"), &n("1"))),
        "100000000000000000000 0.0d0"
    );
    assert_eq!(
        both(divide_to_float(&n("7"), &n("2"), Rounding::Floor)),
        "3.0 1"
    );
    assert_eq!(
        both(floor(&n("-9223372036854775808"), &n("-1"))),
        "9223372036854775808 0"
    );
    assert_eq!(both(floor(&n("7"), &n("0"))), "division by zero");
    assert_eq!(ok(modulo(&n("-7"), &n("3"))), "2");
    assert_eq!(ok(remainder(&n("5.5"), &n("2"))), "1.5");
}

#[test]
fn powers_and_roots() {
    assert_eq!(
        ok(expt(&n("2"), &n("100"))),
        "1267650600228229401496703205376"
    );
    assert_eq!(ok(expt(&n("2"), &n("-2"))), "1/4");
    assert_eq!(ok(expt(&n("2.0"), &n("3"))), "8.0");
    assert_eq!(ok(expt(&n("2"), &n("0.5"))), "1.4142135");
    assert_eq!(ok(expt(&n("-1"), &n("1000000000000000000001"))), "-1");
    assert_eq!(ok(expt(&n("0"), &n("0"))), "1");
    assert_eq!(ok(expt(&n("0"), &n("-1"))), "division by zero");
    assert_eq!(ok(expt(&n("2"), &n("1000000000000"))), "another error");
    assert_eq!(ok(sqrt(&n("1/4"))), "0.5");
    assert_eq!(ok(sqrt(&n("15"))), "3.8729835");
    assert_eq!(ok(isqrt(&n("17"))), "4");
    assert_eq!(ok(lcm(&n("4"), &n("-6"))), "12");
}

#[test]
fn transcendental_functions() {
    assert_eq!(ok(log_base(&n("8"), &n("2"))), "3.0");
    assert_eq!(ok(log(&n("2.718281828"))), "0.99999994");
    assert_eq!(ok(log(&n("0"))), "division by zero");
    assert_eq!(ok(exp(&n("-1000"))), "0.0");
    assert_eq!(ok(exp(&n("1000d0"))), "overflow");
    assert_eq!(ok(sin(&n("1d0"))), "0.8414709848078965d0");
    assert_eq!(ok(sinh(&n("1d0"))), "1.1752011936438014d0");
    assert_eq!(ok(tanh(&n("0.5d0"))), "0.46211715726000974d0");
    assert_eq!(ok(atan2(&n("-1"), &n("-1"))), "-2.3561945");
}

#[test]
fn rationals_of_floats() {
    assert_eq!(ok(rational(&n("0.1"))), "13421773/134217728");
    assert_eq!(ok(rationalize(&n("0.1"))), "1/10");
    assert_eq!(ok(rationalize(&n("0.333"))), "333/1000");
    assert_eq!(ok(rationalize(&n("3.0"))), "3");
}

#[test]
fn floats_come_apart() {
    let parts = |text: &str| {
        let parts = integer_decode(&n(text)).ok().unwrap();
        parts.iter().map(show).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(parts("1.0"), "8388608 -23 1");
    assert_eq!(parts("-1d0"), "4503599627370496 -52 -1");
    assert_eq!(parts("0.0"), "0 0 1");
}

#[test]
fn bits_of_integers() {
    let byte = ByteSpecifier {
        size: 4,
        position: 60,
    };
    assert_eq!(ok(ash(&n("-8"), &n("-1"))), "-4");
    assert_eq!(ok(ash(&n("1"), &n("64"))), "18446744073709551616");
    assert_eq!(ok(ash(&n("-1"), &n("-1000"))), "-1");
    assert_eq!(ok(extract(byte, &n("-1"))), "15");
    assert_eq!(ok(deposit(&n("15"), byte, &n("0"))), "17293822569102704640");
    assert_eq!(ok(bit_count(&n("-256"))), "8");
    assert_eq!(ok(bit_length(&n("-256"))), "8");
}

#[test]
fn random_numbers_stay_below_the_limit() {
    let mut generator = rand_pcg::Pcg64::new(1, 1);
    for limit in ["1", "7", "100000000000000000000", "1.0", "0.5d0"] {
        let limit = n(limit);
        for _ in 0..100 {
            let drawn = random(&mut generator, &limit).ok().unwrap();
            assert!(less(&drawn, &limit).ok().unwrap());
            assert!(!is_minus(&drawn).ok().unwrap());
        }
    }
    assert_eq!(ok(random(&mut generator, &n("0"))), "type error");
}

#[test]
fn negative_numbers_have_complex_roots_and_logarithms() {
    let parts = |value: error::NumberResult| match value {
        Ok(z) if is_complex(&z) => format!("{} {}", ok(real_part(&z)), ok(imaginary_part(&z))),
        other => ok(other),
    };
    let z = |re: &str, im: &str| complex(&n(re), &n(im)).ok().unwrap();
    assert_eq!(parts(sqrt(&n("-1"))), "0.0 1.0");
    assert_eq!(parts(sqrt(&n("-4d0"))), "0.0d0 2.0d0");
    assert_eq!(parts(log(&n("-1"))), "0.0 3.1415927");
    assert_eq!(parts(add(&z("1", "2"), &z("3", "-2"))), "4");
    assert_eq!(parts(mul(&z("0", "1"), &z("0", "1"))), "-1");
    assert_eq!(parts(div(&z("1", "2"), &z("3", "4"))), "11/25 2/25");
    assert_eq!(parts(expt(&z("0", "1"), &n("3"))), "0 -1");
    assert_eq!(parts(expt(&n("-8"), &n("1/3"))), "1.0 1.7320508");
    assert_eq!(parts(abs(&z("3", "4"))), "5.0");
    assert_eq!(parts(complex(&n("1.0"), &n("2"))), "1.0 2.0");
    assert!(number_equal(&z("1", "2"), &z("1.0", "2.0")).ok().unwrap());
    assert!(z("1", "2").is_eql(&z("1", "2")));
    assert!(less(&z("1", "2"), &n("1")).is_err());
}

#[test]
fn trigonometric_functions_are_defined_in_the_whole_plane() {
    let parts = |value: error::NumberResult| match value {
        Ok(z) if is_complex(&z) => format!("{} {}", ok(real_part(&z)), ok(imaginary_part(&z))),
        other => ok(other),
    };
    let z = complex(&n("1.0"), &n("2.0")).ok().unwrap();
    assert_eq!(parts(sin(&z)), "3.1657784 1.959601");
    assert_eq!(parts(cos(&z)), "2.032723 -3.0518978");
    assert_eq!(parts(tan(&z)), "0.033812825 1.0147936");
    assert_eq!(parts(asin(&z)), "0.42707857 1.5285709");
    assert_eq!(parts(acos(&z)), "1.1437178 -1.5285709");
    assert_eq!(parts(atan(&z)), "1.3389726 0.4023595");
    assert_eq!(parts(sinh(&z)), "-0.48905626 1.4031192");
    assert_eq!(parts(cosh(&z)), "-0.64214814 1.0686074");
    assert_eq!(parts(tanh(&z)), "1.1667362 -0.2434582");
    assert_eq!(parts(asinh(&z)), "1.4693518 1.06344");
    assert_eq!(parts(acosh(&z)), "1.5285709 1.1437178");
    assert_eq!(parts(atanh(&z)), "0.1732868 1.1780972");
    assert_eq!(parts(asin(&n("2"))), "1.5707964 -1.316958");
    assert_eq!(parts(asin(&n("-2"))), "-1.5707964 1.316958");
    assert_eq!(parts(acos(&n("2"))), "0.0 1.316958");
    assert_eq!(parts(acosh(&n("-2"))), "1.316958 3.1415927");
    assert_eq!(parts(atanh(&n("3"))), "0.3465736 1.5707964");
    assert_eq!(parts(atanh(&n("-3"))), "-0.3465736 -1.5707964");
}
