//! Is a combination of types empty? A type is a subtype of another if what it has and the other has
//! not is nothing. That is written as a union of intersections, each of types that are not
//! combinations, or of what is not in such a type.

use crate::image::Image;
use crate::types::specifier::{Answers, Bound, RealKind, Type};
use crate::types::subtype::{
    Verdict, are_disjoint, covers, ends_after, is_gap, is_subset, starts_before,
};
use crate::types::test::contains;
use crate::value::Value;
use crate::value::known;

use Verdict::{No, Unknown, Yes};

/// The most intersections that are examined.
const MAX_PARTS: usize = 256;
/// Integer ranges of at most so many numbers are examined number by number.
const SMALL_RANGE: i64 = 1000;

/// What is in all the types of one list, and in none of the other.
#[derive(Clone, Default)]
struct Intersection {
    within: Vec<Type>,
    without: Vec<Type>,
}

/// Is `a` a subtype of `b`?
pub(crate) fn is_subtype(image: &Image, a: &Type, b: &Type) -> Verdict {
    let direct = is_subset(image, a, b);
    if direct == Yes {
        return Yes;
    }
    let difference = Type::And(vec![a.clone(), Type::Not(Box::new(b.clone()))]);
    match is_empty(image, &difference) {
        // What is said of types that are no combinations is certain.
        Unknown if !is_combination(a) && !is_combination(b) => direct,
        verdict => verdict,
    }
}

fn is_combination(of: &Type) -> bool {
    matches!(
        of,
        Type::And(_) | Type::Or(_) | Type::Not(_) | Type::Cons(..)
    )
}

/// Has a type no values?
fn is_empty(image: &Image, of: &Type) -> Verdict {
    match intersections(of, true) {
        Some(parts) => Verdict::all(parts.iter().map(|part| part.is_empty(image))),
        None => Unknown,
    }
}

/// The intersections whose union is a type, or what is not in it; none if they are too many.
fn intersections(of: &Type, is_within: bool) -> Option<Vec<Intersection>> {
    let everything = || vec![Intersection::default()];
    Some(match (of, is_within) {
        (Type::Any, true) | (Type::Nothing, false) => everything(),
        (Type::Any, false) | (Type::Nothing, true) => Vec::new(),
        (Type::Not(inner), _) => return intersections(inner, !is_within),
        (Type::Or(parts), true) | (Type::And(parts), false) => {
            let mut union = Vec::new();
            for part in parts {
                union.extend(intersections(part, is_within)?);
            }
            union
        }
        (Type::And(parts), true) | (Type::Or(parts), false) => {
            let mut product = everything();
            for part in parts {
                let others = intersections(part, is_within)?;
                if product.len() * others.len() > MAX_PARTS {
                    return None;
                }
                product = product
                    .iter()
                    .flat_map(|one| others.iter().map(|other| one.and(other)))
                    .collect();
            }
            product
        }
        (atom, true) => vec![Intersection {
            within: vec![atom.clone()],
            without: Vec::new(),
        }],
        (atom, false) => vec![Intersection {
            within: Vec::new(),
            without: vec![atom.clone()],
        }],
    })
}

impl Intersection {
    fn and(&self, other: &Intersection) -> Intersection {
        let mut both = self.clone();
        both.within.extend(other.within.iter().cloned());
        both.without.extend(other.without.iter().cloned());
        both
    }

    fn is_empty(&self, image: &Image) -> Verdict {
        let excludes = |a: &Type| self.without.iter().any(|b| is_subset(image, a, b) == Yes);
        if self.within.iter().any(excludes) {
            return Yes;
        }
        for (i, a) in self.within.iter().enumerate() {
            let others = &self.within[i + 1..];
            if others.iter().any(|b| are_disjoint(image, a, b) == Yes) {
                return Yes;
            }
        }
        let verdict = self.is_empty_by_kind(image);
        let is_opaque = |part: &Type| matches!(part, Type::Satisfies(_));
        if verdict == No && self.within.iter().chain(&self.without).any(is_opaque) {
            return Unknown;
        }
        verdict
    }

    fn is_empty_by_kind(&self, image: &Image) -> Verdict {
        let Some(first) = self
            .within
            .iter()
            .find(|p| !matches!(p, Type::Satisfies(_)))
        else {
            // No few types have everything.
            return No;
        };
        let members = self.within.iter().find_map(|part| match part {
            Type::Member(values) => Some(values),
            _ => None,
        });
        if let Some(values) = members {
            return Verdict::all(values.iter().map(|value| self.lacks(image, value)));
        }
        match first {
            Type::Real(kind, ..) => self.is_range_empty(image, *kind),
            Type::Cons(..) => self.are_pairs_missing(image),
            Type::StandardCharacters => self.are_characters_missing(),
            Type::Class(class) if class.name == known::CHARACTER => self.are_characters_missing(),
            Type::Complex(_) => self.are_complex_numbers_missing(image),
            Type::Class(_) => self.is_one_certain(image),
            // Several of these may have all of another together.
            _ if self.rivals(image, first).count() < 2 => self.is_one_certain(image),
            _ => Unknown,
        }
    }

    /// The types without that may share values with a type.
    fn rivals<'a>(&'a self, image: &'a Image, of: &'a Type) -> impl Iterator<Item = &'a Type> {
        self.without
            .iter()
            .filter(move |part| are_disjoint(image, of, part) != Yes)
    }

    /// Not empty if one of the types is within all others, as none of those without has all of it.
    fn is_one_certain(&self, image: &Image) -> Verdict {
        let is_least = |a: &&Type| self.within.iter().all(|b| is_subset(image, a, b) == Yes);
        let may_be_split = |part: &Type| matches!(part, Type::CompiledFunction | Type::Member(_));
        match self.within.iter().find(is_least) {
            Some(least) if !self.rivals(image, least).any(may_be_split) => No,
            _ => Unknown,
        }
    }

    /// Is a value not in this?
    fn lacks(&self, image: &Image, value: &Value) -> Verdict {
        let within = self.within.iter().map(|part| (part, true));
        let without = self.without.iter().map(|part| (part, false));
        Verdict::any(within.chain(without).map(|(part, wanted)| {
            match contains(image, part, value, &mut Answers::default()) {
                Ok(is_in) if is_in == wanted => No,
                Ok(_) => Yes,
                Err(_) => Unknown,
            }
        }))
    }

    fn is_range_empty(&self, image: &Image, kind: RealKind) -> Verdict {
        let (mut low, mut high) = (Bound::None, Bound::None);
        for part in &self.within {
            if let Type::Real(_, from, to) = part {
                if starts_before(&low, from) {
                    low = from.clone();
                }
                if ends_after(&high, to) {
                    high = to.clone();
                }
            }
        }
        if is_gap(&high, &low) {
            return Yes;
        }
        if let (
            RealKind::Integer,
            Bound::Inclusive(Value::Int(from)),
            Bound::Inclusive(Value::Int(to)),
        ) = (kind, &low, &high)
            && to.saturating_sub(*from) <= SMALL_RANGE
        {
            return Verdict::all((*from..=*to).map(|n| self.lacks(image, &Value::Int(n))));
        }
        covers(kind, &low, &high, &self.without)
    }

    fn are_pairs_missing(&self, image: &Image) -> Verdict {
        let (mut firsts, mut rests) = (Vec::new(), Vec::new());
        for part in &self.within {
            if let Type::Cons(first, rest) = part {
                firsts.push((**first).clone());
                rests.push((**rest).clone());
            }
        }
        let (first, rest) = (Type::And(firsts), Type::And(rests));
        let halves = Verdict::any([is_empty(image, &first), is_empty(image, &rest)].into_iter());
        if halves != No {
            return halves;
        }
        let excluded: Vec<Verdict> = self
            .without
            .iter()
            .filter_map(|part| match part {
                Type::Cons(a, d) => Some(Verdict::all(
                    [is_subtype(image, &first, a), is_subtype(image, &rest, d)].into_iter(),
                )),
                _ => None,
            })
            .collect();
        match excluded.as_slice() {
            [] => No,
            [one] => *one,
            several if several.contains(&Yes) => Yes,
            _ => Unknown,
        }
    }

    fn are_complex_numbers_missing(&self, image: &Image) -> Verdict {
        let parts = self.within.iter().filter_map(|part| match part {
            Type::Complex(part) => Some((**part).clone()),
            _ => None,
        });
        let part = Type::And(parts.collect());
        // Of two zeros, no complex number is made.
        let zero = Type::Member(vec![Value::Int(0)]);
        match is_subtype(image, &part, &zero) {
            No if self.within.len() == 1 && self.without.is_empty() => No,
            // Several may have together what none of them has.
            No if self.rivals(image, &self.within[0]).count() > 1 => Unknown,
            No => self.is_one_certain(image),
            verdict => verdict,
        }
    }

    fn are_characters_missing(&self) -> Verdict {
        // Standard ones, and the rest.
        let set = |part: &Type| match part {
            Type::StandardCharacters => 0b01_u8,
            _ => 0b11,
        };
        let kept = self.within.iter().fold(0b11, |kept, part| kept & set(part));
        let is_of_characters = |part: &&Type| match part {
            Type::StandardCharacters => true,
            Type::Class(class) => class.name == known::CHARACTER,
            _ => false,
        };
        let without = self.without.iter().filter(is_of_characters);
        let kept = without.fold(kept, |kept, part| kept & !set(part));
        if kept == 0 { Yes } else { No }
    }
}
