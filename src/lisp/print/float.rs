//! Floats as the shortest decimal that is read back as the same float.

use num_bigint::BigInt;
use num_traits::Signed;

use super::settings::Settings;
use crate::value::known;

/// The shortest digits of a positive finite float and the place of the decimal point:
/// `0.DIGITS` times ten to the power of the place.
pub(crate) struct Decimal {
    pub digits: String,
    pub point: i32,
}

/// From Rust's shortest `d.ddde±x`.
fn decimal(scientific: &str) -> Decimal {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let digits = match digits.trim_end_matches('0') {
        "" => "0".to_owned(),
        kept => kept.to_owned(),
    };
    Decimal {
        digits,
        point: exponent.parse().unwrap_or(0) + 1,
    }
}

/// The shortest digits of a double float's magnitude.
pub(crate) fn of_double(x: f64) -> Decimal {
    if x.is_subnormal() {
        return of_subnormal(x.abs(), f64::MANTISSA_DIGITS);
    }
    decimal(&format!("{:e}", x.abs()))
}

/// The shortest digits of a single float's magnitude.
pub(crate) fn of_single(x: f32) -> Decimal {
    if x.is_subnormal() {
        return of_subnormal(f64::from(x.abs()), f32::MANTISSA_DIGITS);
    }
    decimal(&format!("{:e}", x.abs()))
}

/// The shortest digits of a subnormal float, as if its mantissa had all its bits: SBCL
/// prints `least-positive-double-float` as `4.940656458412465d-324`.
fn of_subnormal(x: f64, mantissa_bits: u32) -> Decimal {
    let (_, exponent) = libm::frexp(x);
    // The digits are exact enough within two to the power of this.
    let bits = i64::from(mantissa_bits) + 1 - i64::from(exponent);
    for places in 0..mantissa_bits as usize {
        let text = format!("{x:.places$e}");
        if is_within(&text, x, bits) {
            return decimal(&text);
        }
    }
    decimal(&format!("{x:e}"))
}

/// Is the decimal at most two to the power of minus `bits` away from the float?
fn is_within(text: &str, x: f64, bits: i64) -> bool {
    let Decimal { digits, point } = decimal(text);
    let places = i64::try_from(digits.len()).unwrap_or(0) - i64::from(point);
    let Ok(places) = usize::try_from(places) else {
        return false;
    };
    let digits: BigInt = digits.parse().unwrap_or_default();
    let ten = num_traits::pow(BigInt::from(10), places);
    let (mantissa, exponent, _) = num_traits::float::FloatCore::integer_decode(x);
    let shift = usize::from(exponent.unsigned_abs());
    // Both times ten to the power of `places` and two to the power of `shift`.
    let difference = (digits << shift) - BigInt::from(mantissa) * &ten;
    let spare = usize::try_from(bits).unwrap_or(0);
    (difference.abs() << spare) <= (ten << shift)
}

/// Magnitudes from this one to [`PLAIN_BELOW`] are printed without an exponent.
const PLAIN_FROM: f64 = 1e-3;
const PLAIN_BELOW: f64 = 1e7;

fn float(decimal: &Decimal, magnitude: f64, is_negative: bool, marker: Option<char>) -> String {
    let mut text = String::new();
    if is_negative {
        text.push('-');
    }
    if magnitude == 0.0 {
        text.push_str("0.0");
        if let Some(marker) = marker {
            text.push(marker);
            text.push('0');
        }
        return text;
    }
    if (PLAIN_FROM..PLAIN_BELOW).contains(&magnitude) {
        text.push_str(&plain(decimal));
        if let Some(marker) = marker {
            text.push(marker);
            text.push('0');
        }
        return text;
    }
    let (first, rest) = decimal.digits.split_at(1);
    text.push_str(first);
    text.push('.');
    text.push_str(if rest.is_empty() { "0" } else { rest });
    text.push(marker.unwrap_or('e'));
    text.push_str(&(decimal.point - 1).to_string());
    text
}

/// The decimal without an exponent, with at least one digit on each side of the point.
pub(crate) fn plain(decimal: &Decimal) -> String {
    let digits = &decimal.digits;
    let length = i32::try_from(digits.len()).unwrap_or(i32::MAX);
    let zeros = |n: i32| "0".repeat(usize::try_from(n).unwrap_or(0));
    if decimal.point <= 0 {
        format!("0.{}{digits}", zeros(-decimal.point))
    } else if decimal.point >= length {
        format!("{digits}{}.0", zeros(decimal.point - length))
    } else {
        let (whole, fraction) = digits.split_at(usize::try_from(decimal.point).unwrap_or(0));
        format!("{whole}.{fraction}")
    }
}

fn special(name: &str, x: f64) -> Option<String> {
    if x.is_nan() {
        return Some(format!("#<{name}-FLOAT quiet NaN>"));
    }
    let sign = if x < 0.0 { "NEGATIVE" } else { "POSITIVE" };
    x.is_infinite()
        .then(|| format!("#.SB-EXT:{name}-FLOAT-{sign}-INFINITY"))
}

/// A single float as it is printed.
pub(super) fn single(x: f32, settings: &Settings) -> String {
    let is_default = !matches!(
        settings.float_format,
        known::DOUBLE_FLOAT | known::LONG_FLOAT
    );
    let marker = (!is_default).then_some('f');
    special("SINGLE", f64::from(x)).unwrap_or_else(|| {
        float(
            &of_single(x),
            f64::from(x.abs()),
            x.is_sign_negative(),
            marker,
        )
    })
}

/// A double float as it is printed.
pub(super) fn double(x: f64, settings: &Settings) -> String {
    let is_default = matches!(
        settings.float_format,
        known::DOUBLE_FLOAT | known::LONG_FLOAT
    );
    let marker = (!is_default).then_some('d');
    special("DOUBLE", x)
        .unwrap_or_else(|| float(&of_double(x), x.abs(), x.is_sign_negative(), marker))
}
