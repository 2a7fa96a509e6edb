//! Integers in columns: padding, signs and groups of digits.

use num_bigint::BigInt;
use num_traits::Signed;

use crate::value::number::large::to_text;

/// How an integer is written.
pub(super) struct IntegerStyle {
    pub(super) radix: u32,
    pub(super) width: usize,
    pub(super) pad: char,
    /// Between groups of digits, if any.
    pub(super) comma: Option<(char, usize)>,
    /// Is a plus sign written?
    pub(super) sign: bool,
}

/// The integer's text.
pub(super) fn integer(n: &BigInt, style: &IntegerStyle) -> String {
    let digits = to_text(&n.abs(), style.radix).to_uppercase();
    let digits = match style.comma {
        Some((comma, interval)) if interval > 0 => grouped(&digits, comma, interval),
        _ => digits,
    };
    let sign = match (n.is_negative(), style.sign) {
        (true, _) => "-",
        (false, true) => "+",
        (false, false) => "",
    };
    let text = format!("{sign}{digits}");
    let missing = style.width.saturating_sub(text.chars().count());
    format!("{}{text}", style.pad.to_string().repeat(missing))
}

fn grouped(digits: &str, comma: char, interval: usize) -> String {
    let length = digits.len();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (length - i).is_multiple_of(interval) {
            text.push(comma);
        }
        text.push(digit);
    }
    text
}
