//! Which tokens are numbers, and which numbers they are.

use num_bigint::BigInt;
use num_traits::Zero;

use super::error::ReadErrorKind;
use crate::value::Value;
use crate::value::known;
use crate::value::number;
use crate::value::number::large;
use crate::value::symbol::Sym;

/// The number that a token without escapes denotes; `None` if it is a symbol.
///
/// `radix` is `*read-base*`, `float_format` is `*read-default-float-format*`.
pub(crate) fn parse_number(
    token: &str,
    radix: u32,
    float_format: Sym,
) -> Option<Result<Value, ReadErrorKind>> {
    let bytes = token.as_bytes();
    let first = bytes.first()?;
    // Most symbols end here.
    if radix <= 10 && !(first.is_ascii_digit() || matches!(first, b'+' | b'-' | b'.')) {
        return None;
    }
    if let Some(number) = parse_rational(token, radix) {
        return Some(number);
    }
    if let Some(integer) = token.strip_suffix('.') {
        return parse_integer(integer, 10).map(Ok);
    }
    parse_float(token, float_format)
}

/// The integer or ratio that a token denotes in a radix.
pub(crate) fn parse_rational(token: &str, radix: u32) -> Option<Result<Value, ReadErrorKind>> {
    let Some((numerator, denominator)) = token.split_once('/') else {
        return parse_integer(token, radix).map(Ok);
    };
    let numerator = parse_big(numerator, radix)?;
    if denominator.starts_with(['+', '-']) {
        return None;
    }
    let denominator = parse_big(denominator, radix)?;
    Some(
        number::ratio(numerator, denominator)
            .ok_or_else(|| ReadErrorKind::ZeroDenominator(token.to_owned())),
    )
}

/// The integer that a token denotes in a radix: an optional sign and digits.
pub(crate) fn parse_integer(token: &str, radix: u32) -> Option<Value> {
    let digits = token.strip_prefix(['+', '-']).unwrap_or(token);
    if digits.is_empty() || !digits.chars().all(|c| c.is_digit(radix)) {
        return None;
    }
    match i64::from_str_radix(token, radix) {
        Ok(n) => Some(Value::Int(n)),
        Err(_) => parse_big(token, radix).map(number::from_big),
    }
}

fn parse_big(token: &str, radix: u32) -> Option<BigInt> {
    let digits = token.strip_prefix(['+', '-']).unwrap_or(token);
    if digits.is_empty() || !digits.chars().all(|c| c.is_digit(radix)) {
        return None;
    }
    let magnitude = BigInt::from(large::from_digits(digits, radix));
    Some(if token.starts_with('-') && !magnitude.is_zero() {
        -magnitude
    } else {
        magnitude
    })
}

/// `[sign] digits [. digits] [marker [sign] digits]`, with at least a point followed by
/// digits, or a marker.
fn parse_float(token: &str, float_format: Sym) -> Option<Result<Value, ReadErrorKind>> {
    let unsigned = token.strip_prefix(['+', '-']).unwrap_or(token);
    let marker_at = unsigned.find(|c: char| c.is_ascii_alphabetic());
    let (mantissa, marker, exponent) = match marker_at {
        None => (unsigned, None, ""),
        Some(i) => {
            // The marker is one ASCII letter.
            let (mantissa, rest) = unsigned.split_at(i);
            let (marker, exponent) = rest.split_at(1);
            (mantissa, Some(marker), exponent)
        }
    };
    let all_digits = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let has_point = mantissa.contains('.');
    if !all_digits(whole) || !all_digits(fraction) || whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let is_single = match marker.map(str::to_ascii_uppercase).as_deref() {
        None if has_point && !fraction.is_empty() => is_single_format(float_format),
        None => return None,
        Some("E") => is_single_format(float_format),
        Some("F" | "S") => true,
        Some("D" | "L") => false,
        Some(_) => return None,
    };
    let exponent_digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    if marker.is_some() && (exponent_digits.is_empty() || !all_digits(exponent_digits)) {
        return None;
    }
    let sign = if token.starts_with('-') { "-" } else { "" };
    let exponent = if marker.is_some() { exponent } else { "0" };
    let decimal = format!("{sign}0{whole}.{fraction}0e{exponent}");
    let is_zero = mantissa.bytes().all(|b| matches!(b, b'0' | b'.'));
    Some(float_of(&decimal, is_single, is_zero, token))
}

fn is_single_format(float_format: Sym) -> bool {
    !matches!(float_format, known::DOUBLE_FLOAT | known::LONG_FLOAT)
}

fn float_of(
    decimal: &str,
    is_single: bool,
    is_zero: bool,
    token: &str,
) -> Result<Value, ReadErrorKind> {
    let out_of_range = |direction| ReadErrorKind::FloatRange {
        token: token.to_owned(),
        direction,
    };
    let (value, is_infinite, became_zero) = if is_single {
        // The text was checked to be a decimal float, which always parses.
        let x: f32 = decimal.parse().unwrap_or(0.0);
        (Value::Single(x), x.is_infinite(), x == 0.0)
    } else {
        let x: f64 = decimal.parse().unwrap_or(0.0);
        (Value::Double(x), x.is_infinite(), x == 0.0)
    };
    if is_infinite {
        Err(out_of_range("overflow"))
    } else if became_zero && !is_zero {
        Err(out_of_range("underflow"))
    } else {
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use crate::reader::numeric::*;

    fn double(token: &str) -> Option<f64> {
        match parse_number(token, 10, known::SINGLE_FLOAT)?.ok()? {
            Value::Double(x) => Some(x),
            _ => None,
        }
    }

    fn single(token: &str) -> Option<f32> {
        match parse_number(token, 10, known::SINGLE_FLOAT)?.ok()? {
            Value::Single(x) => Some(x),
            _ => None,
        }
    }

    fn integer(token: &str) -> Option<i64> {
        match parse_number(token, 10, known::SINGLE_FLOAT)?.ok()? {
            Value::Int(n) => Some(n),
            _ => None,
        }
    }

    #[test]
    fn integers_may_end_in_a_point() {
        assert_eq!(integer("+5"), Some(5));
        assert_eq!(integer("-3."), Some(-3));
        assert_eq!(integer("007"), Some(7));
        assert_eq!(integer("4/2"), Some(2));
    }

    #[test]
    fn exponent_markers_choose_the_format() {
        assert_eq!(double("-1.447d0"), Some(-1.447));
        assert_eq!(double("-.5D1"), Some(-5.0));
        assert_eq!(double("1L0"), Some(1.0));
        assert_eq!(single("1e3"), Some(1000.0));
        assert_eq!(single("2.5f-1"), Some(0.25));
        assert_eq!(single("+.5"), Some(0.5));
        assert_eq!(single("1.e2"), Some(100.0));
    }

    #[test]
    fn other_tokens_are_symbols() {
        for token in [
            "1+", "-", "+", ".", "...", "1a", "1e", "e1", "1.2.3", "1/2/3", "/", "1/", "/2",
            "1/-2", "+.", ".5.", "-a", "1d", "1d+", "--1", "1.5.", ".e5", "+1+",
        ] {
            assert!(
                parse_number(token, 10, known::SINGLE_FLOAT).is_none(),
                "{token}"
            );
        }
    }

    #[test]
    fn floats_out_of_range_are_errors() {
        for token in ["1e39", "1d400", "1e-60", "1e99999999999999999999"] {
            let result = parse_number(token, 10, known::SINGLE_FLOAT).unwrap();
            assert!(
                matches!(result, Err(ReadErrorKind::FloatRange { .. })),
                "{token}"
            );
        }
    }
}
