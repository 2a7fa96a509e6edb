//! Numbers in words and in Roman numerals.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, ToPrimitive, Zero};

const ONES: [&str; 20] = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
];

const TENS: [&str; 10] = [
    "", "ten", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety",
];

const PERIODS: [&str; 22] = [
    "",
    "thousand",
    "million",
    "billion",
    "trillion",
    "quadrillion",
    "quintillion",
    "sextillion",
    "septillion",
    "octillion",
    "nonillion",
    "decillion",
    "undecillion",
    "duodecillion",
    "tredecillion",
    "quattuordecillion",
    "quindecillion",
    "sexdecillion",
    "septendecillion",
    "octodecillion",
    "novemdecillion",
    "vigintillion",
];

/// A number from 1 to 999; the indices are below the lengths of the tables.
fn below_thousand(n: usize) -> String {
    let (hundreds, rest) = (n / 100, n % 100);
    let mut words = Vec::new();
    if hundreds > 0 {
        words.push(format!("{} hundred", ONES[hundreds % 10]));
    }
    if rest >= 20 {
        let tens = TENS[rest / 10];
        words.push(match rest % 10 {
            0 => tens.to_owned(),
            ones => format!("{tens}-{}", ONES[ones]),
        });
    } else if rest > 0 {
        words.push(ONES[rest].to_owned());
    }
    words.join(" ")
}

/// `forty-two`; `None` if there is no word for so large a number.
pub(super) fn cardinal(n: &BigInt) -> Option<String> {
    if n.is_zero() {
        return Some(ONES[0].to_owned());
    }
    let thousand = BigInt::from(1000);
    let mut rest = n.abs();
    let mut groups = Vec::new();
    while !rest.is_zero() {
        let (quotient, group) = rest.div_rem(&thousand);
        groups.push(group.to_usize().unwrap_or(0));
        rest = quotient;
    }
    let mut words = Vec::new();
    for (i, group) in groups.iter().enumerate().rev() {
        let period = PERIODS.get(i)?;
        match (*group, i) {
            (0, _) => {}
            (group, 0) => words.push(below_thousand(group)),
            (group, _) => words.push(format!("{} {period}", below_thousand(group))),
        }
    }
    let sign = if n.is_negative() { "negative " } else { "" };
    Some(format!("{sign}{}", words.join(" ")))
}

/// `forty-second`.
pub(super) fn ordinal(n: &BigInt) -> Option<String> {
    let cardinal = cardinal(n)?;
    let at = cardinal.rfind([' ', '-']).map_or(0, |i| i + 1);
    let (before, last) = cardinal.split_at(at);
    let last = match last {
        "one" => "first".to_owned(),
        "two" => "second".to_owned(),
        "three" => "third".to_owned(),
        "five" => "fifth".to_owned(),
        "eight" => "eighth".to_owned(),
        "nine" => "ninth".to_owned(),
        "twelve" => "twelfth".to_owned(),
        other => match other.strip_suffix('y') {
            Some(stem) => format!("{stem}ieth"),
            None => format!("{other}th"),
        },
    };
    Some(format!("{before}{last}"))
}

/// Roman numerals, the old style without subtraction; `None` outside 1 to 3999 (4999 in
/// the old style).
pub(super) fn roman(n: &BigInt, old: bool) -> Option<String> {
    const NEW: &[(u32, &str)] = &[
        (1000, "M"),
        (900, "CM"),
        (500, "D"),
        (400, "CD"),
        (100, "C"),
        (90, "XC"),
        (50, "L"),
        (40, "XL"),
        (10, "X"),
        (9, "IX"),
        (5, "V"),
        (4, "IV"),
        (1, "I"),
    ];
    let most = if old { 4999 } else { 3999 };
    let mut rest = n.to_u32().filter(|n| (1..=most).contains(n))?;
    let mut text = String::new();
    for (value, letters) in NEW.iter().filter(|(_, l)| !old || l.len() == 1) {
        while rest >= *value {
            text.push_str(letters);
            rest -= value;
        }
    }
    Some(text)
}
