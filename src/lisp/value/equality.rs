//! `equal`, `equalp` and hashing under the four equalities; loops, no recursion.

use super::element_type::ElementType;
use std::hash::{Hash, Hasher};
use std::mem::replace;
use std::rc::Rc;

use super::Value;
use super::array::Vector;
use super::cons;
use super::hash_table::HashTest;
use crate::guard::Pace;

/// `equal`: same structure of pairs, strings and bit vectors, `eql` leaves.
pub fn equal(a: &Value, b: &Value) -> bool {
    same(a, b, false)
}

/// `equalp`: like `equal`, but numbers by value, letters ignoring case, arrays, structures and hash
/// tables by their elements.
pub fn equalp(a: &Value, b: &Value) -> bool {
    same(a, b, true)
}

fn same(a: &Value, b: &Value, loosely: bool) -> bool {
    match (a, b) {
        // The most frequent values need no list of what is still to be compared.
        (Value::Symbol(..), _) | (Value::Int(_), Value::Int(_)) => return a.is_eq(b),
        (Value::Str(x), Value::Str(y)) if !loosely => return *x.borrow() == *y.borrow(),
        _ => {}
    }
    let mut pending = Vec::new();
    let mut next = Some((a.clone(), b.clone()));
    let mut pace = Pace::default();
    while let Some((a, b)) = next.take().or_else(|| pending.pop()) {
        pace.step();
        if a.is_eql(&b) {
            continue;
        }
        match (&a, &b) {
            (Value::Cons(x), Value::Cons(y)) => {
                let (mut x, mut y) = (Rc::clone(x), Rc::clone(y));
                // Along both lists, as long as their elements are told apart at once.
                loop {
                    let (car, other) = (x.car(), y.car());
                    match (&car, &other) {
                        (Value::Symbol(..), Value::Symbol(..)) | (Value::Int(_), Value::Int(_)) => {
                            if !car.is_eq(&other) {
                                return false;
                            }
                        }
                        _ => {
                            pending.push((x.cdr(), y.cdr()));
                            next = Some((car, other));
                            break;
                        }
                    }
                    let (Some(after), Some(other)) = (x.cdr_cons(), y.cdr_cons()) else {
                        next = Some((x.cdr(), y.cdr()));
                        break;
                    };
                    if Rc::ptr_eq(&after, &other) {
                        break;
                    }
                    pace.step();
                    cons::release(replace(&mut x, after));
                    cons::release(replace(&mut y, other));
                }
            }
            (Value::Str(x), Value::Str(y)) => {
                let (x, y) = (x.borrow(), y.borrow());
                let equal = *x == *y
                    || loosely
                        && x.chars()
                            .flat_map(char::to_lowercase)
                            .eq(y.chars().flat_map(char::to_lowercase));
                if !equal {
                    return false;
                }
            }
            (Value::Vector(x), Value::Vector(y))
                if x.element_type == ElementType::Bit && y.element_type == ElementType::Bit =>
            {
                let (x, y) = (x.to_vec(), y.to_vec());
                let are_equal = x.len() == y.len() && x.iter().zip(&y).all(|(a, b)| a.is_eql(b));
                if !are_equal {
                    return false;
                }
            }
            (Value::Foreign(x), Value::Foreign(_)) => {
                if !x.object().is_equal(&b) {
                    return false;
                }
            }
            _ if !loosely => return false,
            (Value::Char(x), Value::Char(y)) => {
                if !x.to_lowercase().eq(y.to_lowercase()) {
                    return false;
                }
            }
            (Value::Vector(x), Value::Vector(y)) => {
                let (x, y) = (x.to_vec(), y.to_vec());
                if x.len() != y.len() {
                    return false;
                }
                pending.extend(x.into_iter().zip(y));
            }
            (Value::Str(s), Value::Vector(v)) | (Value::Vector(v), Value::Str(s)) => {
                let characters: Vec<Value> = s.borrow().chars().map(Value::Char).collect();
                let items = v.to_vec();
                if characters.len() != items.len() {
                    return false;
                }
                pending.extend(characters.into_iter().zip(items));
            }
            (Value::Array(x), Value::Array(y)) => {
                if x.dimensions != y.dimensions {
                    return false;
                }
                let (x, y) = (x.items.to_vec(), y.items.to_vec());
                pending.extend(x.into_iter().zip(y));
            }
            (Value::Instance(x), Value::Instance(y)) => {
                if x.class().kind != crate::value::class::ClassKind::Structure
                    || !Rc::ptr_eq(&x.class(), &y.class())
                {
                    return false;
                }
                let (x, y) = (x.slots.borrow().clone(), y.slots.borrow().clone());
                pending.extend(x.into_iter().zip(y));
            }
            (Value::Hash(x), Value::Hash(y)) => {
                if x.test != y.test || x.len() != y.len() {
                    return false;
                }
                for (key, value) in x.pairs() {
                    match y.get(&key) {
                        Some(other) => pending.push((value, other)),
                        None => return false,
                    }
                }
            }
            _ => {
                if !crate::value::number::equal_by_value(&a, &b) {
                    return false;
                }
            }
        }
    }
    true
}

/// Feeds a key into a hasher so that keys that are equal under `test` hash alike.
pub fn hash<H: Hasher>(value: &Value, test: HashTest, state: &mut H) {
    // Deep keys are distinguished by their first few leaves only.
    let mut budget = 64;
    let structural = matches!(test, HashTest::Equal | HashTest::Equalp);
    hash_within(value, test, structural, state, &mut budget);
}

/// The budget limits the depth of the recursion, too.
fn hash_within<H: Hasher>(
    value: &Value,
    test: HashTest,
    structural: bool,
    state: &mut H,
    budget: &mut u32,
) {
    let mut rest = match value {
        Value::Cons(pair) if structural => pair.clone(),
        atom => return hash_one(atom, test, state),
    };
    while *budget > 0 {
        *budget -= 1;
        1u8.hash(state);
        hash_within(&rest.car(), test, structural, state, budget);
        rest = match rest.cdr() {
            Value::Cons(next) => next,
            end => return hash_one(&end, test, state),
        };
    }
}

fn hash_one<H: Hasher>(value: &Value, test: HashTest, state: &mut H) {
    let structural = matches!(test, HashTest::Equal | HashTest::Equalp);
    let loosely = test == HashTest::Equalp;
    match value {
        Value::Symbol(s, ..) => s.hash(state),
        Value::Int(_) | Value::Single(_) | Value::Double(_) | Value::Big(_) | Value::Ratio(_)
            if loosely =>
        {
            // The sum makes one zero of both.
            let number = crate::value::number::to_f64(value).unwrap_or(0.0) + 0.0;
            number.to_bits().hash(state);
        }
        Value::Int(n) => n.hash(state),
        Value::Single(x) => x.to_bits().hash(state),
        Value::Double(x) => x.to_bits().hash(state),
        Value::Big(n) if test != HashTest::Eq => n.hash(state),
        Value::Ratio(r) if test != HashTest::Eq => {
            r.numerator.hash(state);
            r.denominator.hash(state);
        }
        Value::Char(c) if loosely => c.to_lowercase().for_each(|c| c.hash(state)),
        Value::Char(c) => c.hash(state),
        Value::Str(s) if loosely => s
            .borrow()
            .chars()
            .flat_map(char::to_lowercase)
            .for_each(|c| c.hash(state)),
        Value::Str(s) if structural => s.borrow().hash(state),
        Value::Vector(v) if loosely => hash_vector(v, state),
        Value::Vector(v) if structural && v.element_type == ElementType::Bit => {
            for bit in v.to_vec() {
                if let Value::Int(bit) = bit {
                    bit.hash(state);
                }
            }
        }
        Value::Array(a) if loosely => a.dimensions.borrow().hash(state),
        Value::Instance(_) | Value::Hash(_) | Value::Foreign(_) if structural => {}
        Value::Package(p) => p.hash(state),
        other => address(other).hash(state),
    }
}

/// A vector of characters hashes like the string that it equals.
fn hash_vector<H: Hasher>(vector: &Vector, state: &mut H) {
    let items = vector.to_vec();
    if !items.iter().all(|item| matches!(item, Value::Char(_))) {
        items.len().hash(state);
        return;
    }
    for item in items {
        if let Value::Char(c) = item {
            c.to_lowercase().for_each(|c| c.hash(state));
        }
    }
}

/// The address of a value's object. It only spreads hash buckets; tables iterate in order
/// of insertion, so it never shows.
fn address(value: &Value) -> usize {
    match value {
        Value::Big(r) => Rc::as_ptr(r) as usize,
        Value::Ratio(r) => Rc::as_ptr(r) as usize,
        Value::Cons(r) => Rc::as_ptr(r) as usize,
        Value::Str(r) => Rc::as_ptr(r) as usize,
        Value::Vector(r) => Rc::as_ptr(r) as usize,
        Value::Array(r) => Rc::as_ptr(r) as usize,
        Value::Function(r) => Rc::as_ptr(r) as usize,
        Value::Hash(r) => Rc::as_ptr(r) as usize,
        Value::Instance(r) => Rc::as_ptr(r) as usize,
        Value::Class(r) => Rc::as_ptr(r) as usize,
        Value::Stream(r) => Rc::as_ptr(r) as usize,
        Value::Foreign(r) => Rc::as_ptr(r) as usize,
        _ => 0,
    }
}
