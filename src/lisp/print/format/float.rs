//! `~F`, `~E`, `~G` and `~$`.

use super::fixed::{Digits, rounded, shortest, significant};
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

/// The parameters of a float directive.
#[derive(Clone, Default)]
pub(super) struct FloatStyle {
    pub(super) width: Option<i64>,
    pub(super) places: Option<i64>,
    /// Digits of the exponent.
    pub(super) exponent: Option<i64>,
    /// Power of ten by which the number is multiplied.
    pub(super) scale: Option<i64>,
    /// Fills the field if the number does not fit.
    pub(super) overflow: Option<char>,
    pub(super) pad: Option<char>,
    /// The exponent marker.
    pub(super) marker: Option<char>,
    /// Is a plus sign written?
    pub(super) sign: bool,
}

/// The widest field that is filled.
const MAX_WIDTH: i64 = 100_000;

fn is_negative(value: &Value) -> bool {
    match value {
        Value::Single(x) => x.is_sign_negative(),
        Value::Double(x) => x.is_sign_negative(),
        _ => false,
    }
}

fn sign_text(value: &Value, plus: bool) -> &'static str {
    match (is_negative(value), plus) {
        (true, _) => "-",
        (false, true) => "+",
        (false, false) => "",
    }
}

fn count(text: &str) -> i64 {
    i64::try_from(text.chars().count()).unwrap_or(i64::MAX)
}

fn repeat(c: char, count: i64) -> String {
    let count = usize::try_from(count.clamp(0, MAX_WIDTH)).unwrap_or(0);
    c.to_string().repeat(count)
}

/// Puts a number into its field.
fn in_field(sign: &str, body: &str, style: &FloatStyle) -> String {
    let text = format!("{sign}{body}");
    let Some(width) = style.width else {
        return text;
    };
    let missing = width - count(&text);
    match style.overflow {
        Some(c) if missing < 0 => repeat(c, width),
        _ => format!("{}{text}", repeat(style.pad.unwrap_or(' '), missing)),
    }
}

/// `~F`
pub(super) fn fixed(value: &Value, style: &FloatStyle) -> String {
    let sign = sign_text(value, style.sign);
    let scale = style.scale.unwrap_or(0);
    let room = style.width.map(|width| width - count(sign));
    let scaled = |digits: Digits| Digits {
        point: if digits.digits.is_empty() {
            0
        } else {
            digits.point + scale
        },
        ..digits
    };
    let body = match (style.places, room) {
        (Some(places), _) => scaled(rounded(value, places + scale)).with_point(Some(places)),
        (None, None) => scaled(shortest(value)).with_point(None),
        (None, Some(room)) => {
            // As many places as fit beside the digits before the point.
            let digits = scaled(shortest(value));
            let whole = digits.with_point(None);
            if count(&whole) <= room {
                whole
            } else {
                let places = (room - 1 - digits.point.max(0)).max(0);
                let cut = scaled(rounded(value, places + scale));
                let length = i64::try_from(cut.digits.len()).unwrap_or(0);
                cut.with_point(Some((length - cut.point).clamp(0, places)))
            }
        }
    };
    let mut body = body;
    let mut left = room.map(|room| room - count(&body));
    let no_places = style.places == Some(0);
    // The zero before the point is dropped if there is no room for it.
    if body.starts_with('.') && (left.is_none_or(|left| left > 0) || body == ".") {
        body.insert(0, '0');
        left = left.map(|left| left - 1);
    }
    if body.ends_with('.') && !no_places && left.is_none_or(|left| left > 0) {
        body.push('0');
    }
    in_field(sign, &body, style)
}

/// The letter before the exponent.
fn marker(value: &Value, style: &FloatStyle, float_format: Sym) -> char {
    let is_double_default = matches!(float_format, known::DOUBLE_FLOAT | known::LONG_FLOAT);
    style.marker.unwrap_or(match value {
        Value::Double(_) if is_double_default => 'e',
        Value::Double(_) => 'd',
        _ if is_double_default => 'f',
        _ => 'e',
    })
}

/// `~E`
pub(super) fn exponential(value: &Value, style: &FloatStyle, float_format: Sym) -> String {
    let sign = sign_text(value, style.sign);
    let scale = style.scale.unwrap_or(1);
    let mut digits = shortest(value);
    let power_of = |digits: &Digits| {
        if digits.digits.is_empty() {
            0
        } else {
            digits.point - scale
        }
    };
    let exponent_text = |power: i64| {
        let magnitude = power.unsigned_abs().to_string();
        let zeros = repeat('0', style.exponent.unwrap_or(1) - count(&magnitude));
        let sign = if power < 0 { '-' } else { '+' };
        format!(
            "{}{sign}{zeros}{magnitude}",
            marker(value, style, float_format)
        )
    };
    // Places after the point, from the parameter or from the room that is left.
    let places = style.places.or_else(|| {
        let room = style.width? - count(sign) - count(&exponent_text(power_of(&digits)));
        let most = room - 1 - scale.max(0) - i64::from(scale <= 0);
        let needed = i64::try_from(digits.digits.len()).unwrap_or(0) - scale;
        (needed > most).then_some(most.max(i64::from(scale <= 0)))
    });
    if let Some(places) = places {
        // A scale of k puts k digits before the point, or zeros after it.
        let kept = if style.places.is_some() && scale > 0 {
            places + 1
        } else {
            places + scale
        };
        digits = significant(value, kept.max(1));
    }
    let power = power_of(&digits);
    let mantissa = Digits {
        point: if digits.digits.is_empty() {
            scale.clamp(0, 1)
        } else {
            scale
        },
        digits: digits.digits,
    };
    let shown = match (style.places, scale > 0) {
        (Some(places), true) => Some(places + 1 - scale),
        (Some(places), false) => Some(places),
        (None, _) => None,
    };
    let mut body = mantissa.with_point(shown.map(|p| p.max(0)));
    let exponent = exponent_text(power);
    let mut left = style
        .width
        .map(|width| width - count(sign) - count(&body) - count(&exponent));
    if body.ends_with('.') && style.places.is_none() && left.is_none_or(|left| left > 0) {
        body.push('0');
        left = left.map(|left| left - 1);
    }
    if body.starts_with('.') && left.is_none_or(|left| left > 0) {
        body.insert(0, '0');
    }
    in_field(sign, &format!("{body}{exponent}"), style)
}

/// `~G`: fixed with room for an exponent after it, or exponential.
pub(super) fn general(value: &Value, style: &FloatStyle, float_format: Sym) -> String {
    let digits = shortest(value);
    let n = digits.point;
    let places = style.places.unwrap_or_else(|| {
        let text = digits.with_point(None);
        let needed = (count(&text) - 1).max(1);
        needed.max(n.min(7))
    });
    let blanks = style.exponent.map_or(4, |e| e + 2);
    let after = places - n;
    if !(0..=places).contains(&after) {
        return exponential(value, style, float_format);
    }
    let inner = FloatStyle {
        width: style.width.map(|width| width - blanks),
        places: Some(after),
        scale: None,
        ..style.clone()
    };
    format!("{}{}", fixed(value, &inner), repeat(' ', blanks))
}

/// `~$`: at least `before` digits before the point, `places` after it.
pub(super) fn money(
    value: &Value,
    places: i64,
    before: i64,
    style: &FloatStyle,
    sign_first: bool,
) -> String {
    let sign = sign_text(value, style.sign);
    let places = places.clamp(0, MAX_WIDTH);
    let body = rounded(value, places).with_point(Some(places));
    let whole = body
        .find('.')
        .and_then(|i| i64::try_from(i).ok())
        .unwrap_or(0);
    let body = format!("{}{body}", repeat('0', before - whole));
    let missing = style.width.unwrap_or(0) - count(sign) - count(&body);
    let padding = repeat(style.pad.unwrap_or(' '), missing);
    if sign_first {
        format!("{sign}{padding}{body}")
    } else {
        format!("{padding}{sign}{body}")
    }
}
