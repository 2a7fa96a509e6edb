//! `subtypep`: is every value of one type a value of the other?

use std::cmp::Ordering;

use super::compare;
use super::complex_numbers;
use super::specifier::{Answers, Bound, RealKind, Type};
use super::test::contains;
use crate::image::Image;
use crate::value::{Value, known};

/// An answer, which may be unknown.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Verdict {
    /// Certainly.
    Yes,
    /// Certainly not.
    No,
    /// Undecided.
    Unknown,
}

use Verdict::{No, Unknown, Yes};

impl Verdict {
    fn from_bool(yes: bool) -> Verdict {
        if yes { Yes } else { No }
    }

    /// Yes if all are, no if one is not.
    pub(super) fn all(verdicts: impl Iterator<Item = Verdict>) -> Verdict {
        let mut result = Yes;
        for verdict in verdicts {
            match verdict {
                Yes => {}
                No => return No,
                Unknown => result = Unknown,
            }
        }
        result
    }

    /// Yes if one is, no if none is.
    pub(super) fn any(verdicts: impl Iterator<Item = Verdict>) -> Verdict {
        let mut result = No;
        for verdict in verdicts {
            match verdict {
                Yes => return Yes,
                No => {}
                Unknown => result = Unknown,
            }
        }
        result
    }
}

/// Is `a` a subset of `b`?
pub(crate) fn is_subset(image: &Image, a: &Type, b: &Type) -> Verdict {
    match (a, b) {
        (Type::Nothing, _) | (_, Type::Any) => Yes,
        (Type::Or(parts), _) => Verdict::all(parts.iter().map(|p| is_subset(image, p, b))),
        (_, Type::And(parts)) => Verdict::all(parts.iter().map(|p| is_subset(image, a, p))),
        (Type::Member(values), _) => Verdict::all(values.iter().map(|value| {
            match contains(image, b, value, &mut Answers::default()) {
                Ok(yes) => Verdict::from_bool(yes),
                Err(_) => Unknown,
            }
        })),
        (Type::Not(x), Type::Not(y)) => is_subset(image, y, x),
        (_, Type::Not(y)) => are_disjoint(image, a, y),
        (Type::And(parts), _) => {
            let verdict = Verdict::any(parts.iter().map(|p| is_subset(image, p, b)));
            let disjoint = Verdict::any(parts.iter().map(|p| are_disjoint(image, p, b)));
            match (verdict, disjoint) {
                (Yes, _) => Yes,
                (_, Yes) if is_nonempty(image, parts) == Yes => No,
                _ => Unknown,
            }
        }
        (_, Type::Or(parts)) => {
            let verdict = Verdict::any(parts.iter().map(|p| is_subset(image, a, p)));
            match (verdict, a) {
                (No, Type::Real(kind, low, high)) => covers(*kind, low, high, parts),
                (No, Type::Complex(_)) => {
                    let shared = |p: &&Type| are_disjoint(image, a, p) != Yes;
                    // Several may have together what none of them has.
                    if parts.iter().filter(shared).count() > 1 {
                        Unknown
                    } else {
                        No
                    }
                }
                _ => verdict,
            }
        }
        (Type::Satisfies(x), Type::Satisfies(y)) if x.is_eql(y) => Yes,
        (Type::Satisfies(_), _) | (_, Type::Satisfies(_)) => Unknown,
        (Type::Any | Type::Not(_), _) | (_, Type::Nothing) => No,
        _ => is_atomic_subset(image, a, b),
    }
}

/// The same for types that are not combinations.
fn is_atomic_subset(image: &Image, a: &Type, b: &Type) -> Verdict {
    Verdict::from_bool(match (a, b) {
        (Type::Class(x), Type::Class(y)) => x.is_within(y),
        (Type::Real(kind, low, high), Type::Real(other, from, to)) => {
            kind == other && !starts_before(low, from) && !ends_after(high, to)
        }
        (Type::Complex(x), Type::Complex(y)) => return is_subset(image, x, y),
        (Type::Cons(a1, d1), Type::Cons(a2, d2)) => {
            return Verdict::all([is_subset(image, a1, a2), is_subset(image, d1, d2)].into_iter());
        }
        (
            Type::Array {
                simple,
                element,
                dimensions,
            },
            Type::Array {
                simple: wanted_simple,
                element: wanted_element,
                dimensions: wanted,
            },
        ) => {
            (*simple || !wanted_simple)
                && (wanted_element.is_none() || element == wanted_element)
                && is_within(dimensions.as_deref(), wanted.as_deref())
        }
        (Type::StandardCharacters, Type::StandardCharacters) => true,
        (Type::StandardCharacters, Type::Class(y)) => y.name == known::CHARACTER,
        (Type::CompiledFunction, Type::CompiledFunction) => true,
        (Type::CompiledFunction, Type::Class(y)) => y.name == known::FUNCTION,
        _ => false,
    })
}

/// Is there no value that both sets have?
pub(super) fn are_disjoint(image: &Image, a: &Type, b: &Type) -> Verdict {
    match (a, b) {
        (Type::Nothing, _) | (_, Type::Nothing) => Yes,
        (Type::Any, other) | (other, Type::Any) => match other {
            Type::Satisfies(_) | Type::And(_) => Unknown,
            _ => No,
        },
        (Type::Or(parts), other) | (other, Type::Or(parts)) => {
            Verdict::all(parts.iter().map(|p| are_disjoint(image, p, other)))
        }
        (Type::Member(values), other) | (other, Type::Member(values)) => {
            Verdict::all(values.iter().map(|v| {
                match contains(image, other, v, &mut Answers::default()) {
                    Ok(yes) => Verdict::from_bool(!yes),
                    Err(_) => Unknown,
                }
            }))
        }
        (Type::Not(x), other) | (other, Type::Not(x)) => is_subset(image, other, x),
        (Type::And(parts), other) | (other, Type::And(parts)) => {
            match Verdict::any(parts.iter().map(|p| are_disjoint(image, p, other))) {
                Yes => Yes,
                _ => Unknown,
            }
        }
        (Type::Satisfies(_), _) | (_, Type::Satisfies(_)) => Unknown,
        (Type::Class(x), Type::Class(y)) => Verdict::from_bool(!x.is_within(y) && !y.is_within(x)),
        (Type::Real(kind, low, high), Type::Real(other, from, to)) => {
            Verdict::from_bool(kind != other || is_gap(high, from) || is_gap(to, low))
        }
        (Type::Cons(a1, d1), Type::Cons(a2, d2)) => {
            Verdict::any([are_disjoint(image, a1, a2), are_disjoint(image, d1, d2)].into_iter())
        }
        (
            Type::Array {
                element: Some(x), ..
            },
            Type::Array {
                element: Some(y), ..
            },
        ) if x != y => Yes,
        (Type::Array { .. }, Type::Array { .. }) => No,
        (Type::StandardCharacters, Type::StandardCharacters) => No,
        (Type::StandardCharacters, Type::Class(c)) | (Type::Class(c), Type::StandardCharacters) => {
            Verdict::from_bool(c.name != known::CHARACTER)
        }
        (Type::CompiledFunction, Type::Class(c)) | (Type::Class(c), Type::CompiledFunction) => {
            Verdict::from_bool(c.name != known::FUNCTION)
        }
        (Type::Complex(x), Type::Complex(y)) => complex_numbers::have_disjoint_parts(image, x, y),
        (Type::CompiledFunction, Type::CompiledFunction) => No,
        _ => Yes,
    }
}

/// Does an intersection certainly have a value?
fn is_nonempty(image: &Image, parts: &[Type]) -> Verdict {
    let pairs = parts.iter().enumerate();
    let overlap = pairs.flat_map(|(i, a)| {
        parts[i + 1..]
            .iter()
            .map(move |b| match are_disjoint(image, a, b) {
                Yes => No,
                No => Yes,
                Unknown => Unknown,
            })
    });
    Verdict::all(overlap)
}

/// The bound's number, and whether it belongs to the range.
fn limit(bound: &Bound) -> Option<(&Value, bool)> {
    match bound {
        Bound::None => None,
        Bound::Inclusive(n) => Some((n, true)),
        Bound::Exclusive(n) => Some((n, false)),
    }
}

/// Does a range with this lower bound begin before the other?
pub(super) fn starts_before(low: &Bound, other: &Bound) -> bool {
    match (limit(low), limit(other)) {
        (_, None) => false,
        (None, Some(_)) => true,
        (Some((a, a_in)), Some((b, b_in))) => match compare(a, b) {
            Some(Ordering::Less) => true,
            Some(Ordering::Equal) => a_in && !b_in,
            _ => false,
        },
    }
}

/// Does a range with this upper bound end after the other?
pub(super) fn ends_after(high: &Bound, other: &Bound) -> bool {
    match (limit(high), limit(other)) {
        (_, None) => false,
        (None, Some(_)) => true,
        (Some((a, a_in)), Some((b, b_in))) => match compare(a, b) {
            Some(Ordering::Greater) => true,
            Some(Ordering::Equal) => a_in && !b_in,
            _ => false,
        },
    }
}

/// Does a range that ends at `high` lie wholly before one that begins at `low`?
pub(super) fn is_gap(high: &Bound, low: &Bound) -> bool {
    match (limit(high), limit(low)) {
        (Some((a, a_in)), Some((b, b_in))) => match compare(a, b) {
            Some(Ordering::Less) => true,
            Some(Ordering::Equal) => !(a_in && b_in),
            _ => false,
        },
        _ => false,
    }
}

/// Do the ranges and numbers among `parts` together cover a range?
pub(super) fn covers(kind: RealKind, low: &Bound, high: &Bound, parts: &[Type]) -> Verdict {
    let mut ranges: Vec<(Bound, Bound)> = Vec::new();
    for part in parts {
        match part {
            Type::Real(k, lo, hi) if *k == kind => ranges.push((lo.clone(), hi.clone())),
            Type::Member(values) => {
                let counts = |value: &&Value| kind.has(value) && has_both_zeros(value, parts);
                for value in values.iter().filter(counts) {
                    let point = Bound::Inclusive(value.clone());
                    ranges.push((point.clone(), point));
                }
            }
            _ => {}
        }
    }
    let mut from = low.clone();
    let mut used = vec![false; ranges.len()];
    loop {
        let next = ranges
            .iter()
            .enumerate()
            .find(|(i, (lo, _))| !used[*i] && !starts_before(&from, lo))
            .map(|(i, (_, hi))| (i, hi));
        let Some((i, reached)) = next else {
            return No;
        };
        used[i] = true;
        if !ends_after(high, reached) {
            return Yes;
        }
        let following = match reached {
            Bound::None => return Yes,
            Bound::Inclusive(Value::Int(n)) if kind == RealKind::Integer => {
                Bound::Inclusive(Value::Int(n.saturating_add(1)))
            }
            Bound::Inclusive(n) => Bound::Exclusive(n.clone()),
            Bound::Exclusive(n) => Bound::Inclusive(n.clone()),
        };
        if starts_before(&from, &following) {
            from = following;
        }
    }
}

/// Have the types the other zero, too, if a number is a zero with a sign? A range has both.
fn has_both_zeros(number: &Value, parts: &[Type]) -> bool {
    let other = match number {
        Value::Single(0.0) => Value::Single(if is_negative(number) { 0.0 } else { -0.0 }),
        Value::Double(0.0) => Value::Double(if is_negative(number) { 0.0 } else { -0.0 }),
        _ => return true,
    };
    parts.iter().any(|part| match part {
        Type::Member(values) => values.iter().any(|value| value.is_eql(&other)),
        _ => false,
    })
}

fn is_negative(number: &Value) -> bool {
    match number {
        Value::Single(x) => x.is_sign_negative(),
        Value::Double(x) => x.is_sign_negative(),
        _ => false,
    }
}

fn is_within(sizes: Option<&[Option<usize>]>, wanted: Option<&[Option<usize>]>) -> bool {
    match (sizes, wanted) {
        (_, None) => true,
        (None, Some(_)) => false,
        (Some(sizes), Some(wanted)) => {
            sizes.len() == wanted.len()
                && sizes
                    .iter()
                    .zip(wanted)
                    .all(|(size, wanted)| wanted.is_none() || size == wanted)
        }
    }
}
