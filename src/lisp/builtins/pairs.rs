//! Pairs and positions in lists: `car` to `cddddr`, `first` to `tenth`, `nth`, `last`.

use std::rc::Rc;

use crate::builtin::{Builtin, pure};
use crate::image::Image;
use crate::value::cons::{self, Cons};
use crate::value::cycles;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::{Rounds, Value};

use crate::value::sequence;

type Outcome = Result<Value, Box<Raise>>;

/// Car of a list.
fn car_of(list: &Value) -> Outcome {
    match list {
        Value::Cons(cons) => Ok(cons.car()),
        Value::Symbol(known::NIL, ..) => Ok(Value::NIL),
        _ => Err(Raise::type_error(list, known::LIST)),
    }
}

/// Cdr of a list.
fn cdr_of(list: &Value) -> Outcome {
    match list {
        Value::Cons(cons) => Ok(cons.cdr()),
        Value::Symbol(known::NIL, ..) => Ok(Value::NIL),
        _ => Err(Raise::type_error(list, known::LIST)),
    }
}

/// Follows a path of cars (0) and cdrs (1), given as the letters of a `c…r` name in order after a
/// leading 1; the last letter is applied first.
fn follow(path: u32, list: &Value) -> Outcome {
    let mut value = list.clone();
    let mut path = path;
    while path > 1 {
        value = if path & 1 == 0 {
            car_of(&value)?
        } else {
            cdr_of(&value)?
        };
        path >>= 1;
    }
    Ok(value)
}

fn cxr<const PATH: u32>(_: &mut Image, args: &[Value]) -> Outcome {
    follow(PATH, &args[0])
}

/// Sets the place at the end of a path; the arguments are the new value and the list.
fn set_cxr<const PATH: u32>(_: &mut Image, args: &[Value]) -> Outcome {
    // All letters but the first lead to the pair that is changed.
    let length = 31 - PATH.leading_zeros();
    let first = PATH >> (length - 1) & 1;
    let before = PATH & !(0b11 << (length - 1)) | 1 << (length - 1);
    let place = follow(before, &args[1])?;
    let Value::Cons(cons) = &place else {
        return Err(Raise::type_error(&place, known::CONS));
    };
    cycles::note(cons, &args[0]);
    if first == 0 {
        cons.set_car(args[0].clone());
    } else {
        cons.set_cdr(args[0].clone());
    }
    Ok(args[0].clone())
}

fn nth_cdr(count: usize, list: &Value) -> Outcome {
    let mut rest = list.clone();
    for _ in 0..count {
        match &rest {
            Value::Cons(_) => {
                if let Some(cons) = rest.take_pair() {
                    cons.copy_cdr_into(&mut rest);
                    cons::release(cons);
                }
            }
            Value::Symbol(known::NIL, ..) => break,
            _ => rest = cdr_of(&rest)?,
        }
    }
    Ok(rest)
}

fn ordinal<const N: usize>(_: &mut Image, args: &[Value]) -> Outcome {
    car_of(&nth_cdr(N, &args[0])?)
}

fn set_nth_of(index: usize, list: &Value, value: &Value) -> Outcome {
    let place = nth_cdr(index, list)?;
    match &place {
        Value::Cons(cons) => {
            cycles::note(cons, value);
            cons.set_car(value.clone());
        }
        _ if list.is_nil() => return Err(Raise::type_error(list, known::CONS)),
        _ => {
            let length = sequence::list_length(list)?;
            return Err(sequence::index_too_large(index, "list", length));
        }
    }
    Ok(value.clone())
}

fn set_ordinal<const N: usize>(_: &mut Image, args: &[Value]) -> Outcome {
    set_nth_of(N, &args[1], &args[0])
}

fn cons(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::cons(args[0].clone(), args[1].clone()))
}

fn pair(value: &Value) -> Result<&Rc<Cons>, Box<Raise>> {
    value
        .as_cons()
        .ok_or_else(|| Raise::type_error(value, known::CONS))
}

fn rplaca(_: &mut Image, args: &[Value]) -> Outcome {
    let pair = pair(&args[0])?;
    cycles::note(pair, &args[1]);
    pair.set_car(args[1].clone());
    Ok(args[0].clone())
}

fn rplacd(_: &mut Image, args: &[Value]) -> Outcome {
    let pair = pair(&args[0])?;
    cycles::note(pair, &args[1]);
    pair.set_cdr(args[1].clone());
    Ok(args[0].clone())
}

fn nth(_: &mut Image, args: &[Value]) -> Outcome {
    car_of(&nth_cdr(sequence::index(&args[0])?, &args[1])?)
}

fn set_nth(_: &mut Image, args: &[Value]) -> Outcome {
    set_nth_of(sequence::index(&args[1])?, &args[2], &args[0])
}

fn nthcdr(_: &mut Image, args: &[Value]) -> Outcome {
    nth_cdr(sequence::index(&args[0])?, &args[1])
}

/// Walks to the end of a list that may be dotted, with a second pointer `count` pairs
/// behind.
fn last(_: &mut Image, args: &[Value]) -> Outcome {
    let count = args.get(1).map_or(Ok(1), sequence::index)?;
    let list = &args[0];
    if !list.is_list() {
        return Err(Raise::type_error(list, known::LIST));
    }
    let (mut front, mut back) = (list.clone(), list.clone());
    let mut lead = 0;
    let mut rounds = Rounds::default();
    while let Value::Cons(cons) = &front {
        if rounds.is_closed_by(cons) {
            return Err(sequence::circular(list));
        }
        let next = cons.cdr();
        front = next;
        if lead < count {
            lead += 1;
        } else {
            back = back.cdr_or_nil();
        }
    }
    Ok(back)
}

/// The elements of a list that may be dotted.
fn elements(list: &Value) -> Result<Vec<Value>, Box<Raise>> {
    if list.is_list() {
        Ok(list.iter_list().collect())
    } else {
        Err(Raise::type_error(list, known::LIST))
    }
}

fn butlast(_: &mut Image, args: &[Value]) -> Outcome {
    let count = args.get(1).map_or(Ok(1), sequence::index)?;
    let mut items = elements(&args[0])?;
    items.truncate(items.len().saturating_sub(count));
    Ok(Value::list(items))
}

fn endp(_: &mut Image, args: &[Value]) -> Outcome {
    match &args[0] {
        Value::Cons(_) => Ok(Value::NIL),
        Value::Symbol(known::NIL, ..) => Ok(Value::T),
        other => Err(Raise::type_error(other, known::LIST)),
    }
}

/// Access to pairs and list elements.
#[rustfmt::skip]
pub static TABLE: &[Builtin] = &[
    pure("CAR", "list", "The car of a list.", &["(car '(x)) => X"], cxr::<0b10>),
    pure("CDR", "list", "The cdr of a list.", &["(cdr '(1 . x)) => X"], cxr::<0b11>),
    pure("CAAR", "list", "The car of the car of a list.", &["(caar '((x))) => X"], cxr::<0b100>),
    pure("CADR", "list", "The car of the cdr of a list.", &["(cadr '(1 x)) => X"], cxr::<0b101>),
    pure("CDAR", "list", "The cdr of the car of a list.", &["(cdar '((1 . x))) => X"], cxr::<0b110>),
    pure("CDDR", "list", "The cdr of the cdr of a list.", &["(cddr '(1 1 . x)) => X"], cxr::<0b111>),
    pure("CAAAR", "list", "The car of the car of the car of a list.", &["(caaar '(((x)))) => X"], cxr::<0b1000>),
    pure("CAADR", "list", "The car of the car of the cdr of a list.", &["(caadr '(1 (x))) => X"], cxr::<0b1001>),
    pure("CADAR", "list", "The car of the cdr of the car of a list.", &["(cadar '((1 x))) => X"], cxr::<0b1010>),
    pure("CADDR", "list", "The car of the cdr of the cdr of a list.", &["(caddr '(1 1 x)) => X"], cxr::<0b1011>),
    pure("CDAAR", "list", "The cdr of the car of the car of a list.", &["(cdaar '(((1 . x)))) => X"], cxr::<0b1100>),
    pure("CDADR", "list", "The cdr of the car of the cdr of a list.", &["(cdadr '(1 (1 . x))) => X"], cxr::<0b1101>),
    pure("CDDAR", "list", "The cdr of the cdr of the car of a list.", &["(cddar '((1 1 . x))) => X"], cxr::<0b1110>),
    pure("CDDDR", "list", "The cdr of the cdr of the cdr of a list.", &["(cdddr '(1 1 1 . x)) => X"], cxr::<0b1111>),
    pure("CAAAAR", "list", "The car of the car of the car of the car of a list.", &["(caaaar '((((x))))) => X"], cxr::<0b10000>),
    pure("CAAADR", "list", "The car of the car of the car of the cdr of a list.", &["(caaadr '(1 ((x)))) => X"], cxr::<0b10001>),
    pure("CAADAR", "list", "The car of the car of the cdr of the car of a list.", &["(caadar '((1 (x)))) => X"], cxr::<0b10010>),
    pure("CAADDR", "list", "The car of the car of the cdr of the cdr of a list.", &["(caaddr '(1 1 (x))) => X"], cxr::<0b10011>),
    pure("CADAAR", "list", "The car of the cdr of the car of the car of a list.", &["(cadaar '(((1 x)))) => X"], cxr::<0b10100>),
    pure("CADADR", "list", "The car of the cdr of the car of the cdr of a list.", &["(cadadr '(1 (1 x))) => X"], cxr::<0b10101>),
    pure("CADDAR", "list", "The car of the cdr of the cdr of the car of a list.", &["(caddar '((1 1 x))) => X"], cxr::<0b10110>),
    pure("CADDDR", "list", "The car of the cdr of the cdr of the cdr of a list.", &["(cadddr '(1 1 1 x)) => X"], cxr::<0b10111>),
    pure("CDAAAR", "list", "The cdr of the car of the car of the car of a list.", &["(cdaaar '((((1 . x))))) => X"], cxr::<0b11000>),
    pure("CDAADR", "list", "The cdr of the car of the car of the cdr of a list.", &["(cdaadr '(1 ((1 . x)))) => X"], cxr::<0b11001>),
    pure("CDADAR", "list", "The cdr of the car of the cdr of the car of a list.", &["(cdadar '((1 (1 . x)))) => X"], cxr::<0b11010>),
    pure("CDADDR", "list", "The cdr of the car of the cdr of the cdr of a list.", &["(cdaddr '(1 1 (1 . x))) => X"], cxr::<0b11011>),
    pure("CDDAAR", "list", "The cdr of the cdr of the car of the car of a list.", &["(cddaar '(((1 1 . x)))) => X"], cxr::<0b11100>),
    pure("CDDADR", "list", "The cdr of the cdr of the car of the cdr of a list.", &["(cddadr '(1 (1 1 . x))) => X"], cxr::<0b11101>),
    pure("CDDDAR", "list", "The cdr of the cdr of the cdr of the car of a list.", &["(cdddar '((1 1 1 . x))) => X"], cxr::<0b11110>),
    pure("CDDDDR", "list", "The cdr of the cdr of the cdr of the cdr of a list.", &["(cddddr '(1 1 1 1 . x)) => X"], cxr::<0b11111>),
    pure("FIRST", "list", "The first element of a list, or `NIL`.", &["(first '(1 2 3 4 5 6 7 8 9 10)) => 1"], ordinal::<0>),
    pure("SECOND", "list", "The second element of a list, or `NIL`.", &["(second '(1 2 3 4 5 6 7 8 9 10)) => 2"], ordinal::<1>),
    pure("THIRD", "list", "The third element of a list, or `NIL`.", &["(third '(1 2 3 4 5 6 7 8 9 10)) => 3"], ordinal::<2>),
    pure("FOURTH", "list", "The fourth element of a list, or `NIL`.", &["(fourth '(1 2 3 4 5 6 7 8 9 10)) => 4"], ordinal::<3>),
    pure("FIFTH", "list", "The fifth element of a list, or `NIL`.", &["(fifth '(1 2 3 4 5 6 7 8 9 10)) => 5"], ordinal::<4>),
    pure("SIXTH", "list", "The sixth element of a list, or `NIL`.", &["(sixth '(1 2 3 4 5 6 7 8 9 10)) => 6"], ordinal::<5>),
    pure("SEVENTH", "list", "The seventh element of a list, or `NIL`.", &["(seventh '(1 2 3 4 5 6 7 8 9 10)) => 7"], ordinal::<6>),
    pure("EIGHTH", "list", "The eighth element of a list, or `NIL`.", &["(eighth '(1 2 3 4 5 6 7 8 9 10)) => 8"], ordinal::<7>),
    pure("NINTH", "list", "The ninth element of a list, or `NIL`.", &["(ninth '(1 2 3 4 5 6 7 8 9 10)) => 9"], ordinal::<8>),
    pure("TENTH", "list", "The tenth element of a list, or `NIL`.", &["(tenth '(1 2 3 4 5 6 7 8 9 10)) => 10"], ordinal::<9>),
    pure("REST", "list", "The list without its first element.", &["(rest '(1 2 3)) => (2 3)"], cxr::<0b11>),
    pure("CONS", "car cdr", "A fresh pair; with a list as `cdr`, that list with an element in front.", &["(cons 1 '(2)) => (1 2)", "(cons 1 2) => (1 . 2)"], cons),
    pure("RPLACA", "cons value", "Replaces the car of a pair; returns the pair.", &["(rplaca (list 1 2) 'a) => (A 2)"], rplaca),
    pure("RPLACD", "cons value", "Replaces the cdr of a pair; returns the pair.", &["(rplacd (list 1 2) '(b)) => (1 B)"], rplacd),
    pure("NTH", "n list", "The element of a list at an index from 0, or `NIL` beyond the end.", &["(nth 1 '(a b c)) => B"], nth),
    pure("NTHCDR", "n list", "The list without its first `n` elements.", &["(nthcdr 2 '(a b c)) => (C)"], nthcdr),
    pure("LAST", "list &optional n", "The last `n` (1) pairs of a list.", &["(last '(1 2 3)) => (3)", "(last '(1 2 3) 2) => (2 3)"], last),
    pure("BUTLAST", "list &optional n", "A copy of a list without its last `n` (1) elements.", &["(butlast '(1 2 3)) => (1 2)"], butlast),
    pure("ENDP", "list", "Is the list at its end? An error for anything but a list.", &["(endp nil) => T"], endp),
];

/// The same places for `setf`; the new value is the first argument.
#[rustfmt::skip]
pub static SETTERS: &[Builtin] = &[
    pure("CAR", "value list", "Replaces the car of a list.", &[], set_cxr::<0b10>),
    pure("CDR", "value list", "Replaces the cdr of a list.", &[], set_cxr::<0b11>),
    pure("CAAR", "value list", "Replaces the car of the car of a list.", &[], set_cxr::<0b100>),
    pure("CADR", "value list", "Replaces the car of the cdr of a list.", &[], set_cxr::<0b101>),
    pure("CDAR", "value list", "Replaces the cdr of the car of a list.", &[], set_cxr::<0b110>),
    pure("CDDR", "value list", "Replaces the cdr of the cdr of a list.", &[], set_cxr::<0b111>),
    pure("CAAAR", "value list", "Replaces the car of the car of the car of a list.", &[], set_cxr::<0b1000>),
    pure("CAADR", "value list", "Replaces the car of the car of the cdr of a list.", &[], set_cxr::<0b1001>),
    pure("CADAR", "value list", "Replaces the car of the cdr of the car of a list.", &[], set_cxr::<0b1010>),
    pure("CADDR", "value list", "Replaces the car of the cdr of the cdr of a list.", &[], set_cxr::<0b1011>),
    pure("CDAAR", "value list", "Replaces the cdr of the car of the car of a list.", &[], set_cxr::<0b1100>),
    pure("CDADR", "value list", "Replaces the cdr of the car of the cdr of a list.", &[], set_cxr::<0b1101>),
    pure("CDDAR", "value list", "Replaces the cdr of the cdr of the car of a list.", &[], set_cxr::<0b1110>),
    pure("CDDDR", "value list", "Replaces the cdr of the cdr of the cdr of a list.", &[], set_cxr::<0b1111>),
    pure("CAAAAR", "value list", "Replaces the car of the car of the car of the car of a list.", &[], set_cxr::<0b10000>),
    pure("CAAADR", "value list", "Replaces the car of the car of the car of the cdr of a list.", &[], set_cxr::<0b10001>),
    pure("CAADAR", "value list", "Replaces the car of the car of the cdr of the car of a list.", &[], set_cxr::<0b10010>),
    pure("CAADDR", "value list", "Replaces the car of the car of the cdr of the cdr of a list.", &[], set_cxr::<0b10011>),
    pure("CADAAR", "value list", "Replaces the car of the cdr of the car of the car of a list.", &[], set_cxr::<0b10100>),
    pure("CADADR", "value list", "Replaces the car of the cdr of the car of the cdr of a list.", &[], set_cxr::<0b10101>),
    pure("CADDAR", "value list", "Replaces the car of the cdr of the cdr of the car of a list.", &[], set_cxr::<0b10110>),
    pure("CADDDR", "value list", "Replaces the car of the cdr of the cdr of the cdr of a list.", &[], set_cxr::<0b10111>),
    pure("CDAAAR", "value list", "Replaces the cdr of the car of the car of the car of a list.", &[], set_cxr::<0b11000>),
    pure("CDAADR", "value list", "Replaces the cdr of the car of the car of the cdr of a list.", &[], set_cxr::<0b11001>),
    pure("CDADAR", "value list", "Replaces the cdr of the car of the cdr of the car of a list.", &[], set_cxr::<0b11010>),
    pure("CDADDR", "value list", "Replaces the cdr of the car of the cdr of the cdr of a list.", &[], set_cxr::<0b11011>),
    pure("CDDAAR", "value list", "Replaces the cdr of the cdr of the car of the car of a list.", &[], set_cxr::<0b11100>),
    pure("CDDADR", "value list", "Replaces the cdr of the cdr of the car of the cdr of a list.", &[], set_cxr::<0b11101>),
    pure("CDDDAR", "value list", "Replaces the cdr of the cdr of the cdr of the car of a list.", &[], set_cxr::<0b11110>),
    pure("CDDDDR", "value list", "Replaces the cdr of the cdr of the cdr of the cdr of a list.", &[], set_cxr::<0b11111>),
    pure("FIRST", "value list", "Replaces the first element of a list.", &[], set_ordinal::<0>),
    pure("SECOND", "value list", "Replaces the second element of a list.", &[], set_ordinal::<1>),
    pure("THIRD", "value list", "Replaces the third element of a list.", &[], set_ordinal::<2>),
    pure("FOURTH", "value list", "Replaces the fourth element of a list.", &[], set_ordinal::<3>),
    pure("FIFTH", "value list", "Replaces the fifth element of a list.", &[], set_ordinal::<4>),
    pure("SIXTH", "value list", "Replaces the sixth element of a list.", &[], set_ordinal::<5>),
    pure("SEVENTH", "value list", "Replaces the seventh element of a list.", &[], set_ordinal::<6>),
    pure("EIGHTH", "value list", "Replaces the eighth element of a list.", &[], set_ordinal::<7>),
    pure("NINTH", "value list", "Replaces the ninth element of a list.", &[], set_ordinal::<8>),
    pure("TENTH", "value list", "Replaces the tenth element of a list.", &[], set_ordinal::<9>),
    pure("REST", "value list", "Replaces what follows a list's first element.", &[], set_cxr::<0b11>),
    pure("NTH", "value n list", "Replaces the element of a list at an index from 0.", &[], set_nth),
];
