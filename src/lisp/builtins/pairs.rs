//! Pairs and positions in lists: `car` to `cddddr`, `first` to `tenth`, `nth`, `last`.

use std::rc::Rc;

use crate::lisp::builtin::Builtin;
use crate::lisp::image::Image;
use crate::lisp::value::cons::{self, Cons};
use crate::lisp::value::cycles;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::{Rounds, Value};
use crate::lisp::{builtin, builtins};

use crate::lisp::value::sequence;

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

/// A fresh pair; with a list as `cdr`, that list with an element in front.
///
/// `(cons 1 '(2))` => `(1 2)`
/// `(cons 1 2)` => `(1 . 2)`
#[builtin]
fn cons(car: Value, cdr: Value) -> Outcome {
    Ok(Value::cons(car, cdr))
}

fn pair(value: &Value) -> Result<&Rc<Cons>, Box<Raise>> {
    value
        .as_cons()
        .ok_or_else(|| Raise::type_error(value, known::CONS))
}

/// Replaces the car of a pair; returns the pair.
///
/// `(rplaca (list 1 2) 'a)` => `(A 2)`
#[builtin]
fn rplaca(cons: &Value, value: &Value) -> Outcome {
    let pair = pair(cons)?;
    cycles::note(pair, value);
    pair.set_car(value.clone());
    Ok(cons.clone())
}

/// Replaces the cdr of a pair; returns the pair.
///
/// `(rplacd (list 1 2) '(b))` => `(1 B)`
#[builtin]
fn rplacd(cons: &Value, value: &Value) -> Outcome {
    let pair = pair(cons)?;
    cycles::note(pair, value);
    pair.set_cdr(value.clone());
    Ok(cons.clone())
}

/// The element of a list at an index from 0, or `NIL` beyond the end.
///
/// `(nth 1 '(a b c))` => `B`
#[builtin]
fn nth(n: usize, list: &Value) -> Outcome {
    car_of(&nth_cdr(n, list)?)
}

/// Replaces the element of a list at an index from 0.
#[builtin("NTH")]
fn set_nth(value: &Value, n: usize, list: &Value) -> Outcome {
    set_nth_of(n, list, value)
}

/// The list without its first `n` elements.
///
/// `(nthcdr 2 '(a b c))` => `(C)`
#[builtin]
fn nthcdr(n: usize, list: &Value) -> Outcome {
    nth_cdr(n, list)
}

/// The last `n` (1) pairs of a list.
///
/// `(last '(1 2 3))` => `(3)`
/// `(last '(1 2 3) 2)` => `(2 3)`
// Walks to the end of a list that may be dotted, with a second pointer `count` pairs
// behind.
#[builtin]
fn last(list: &Value, #[default(1)] n: usize) -> Outcome {
    let count = n;
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

/// A copy of a list without its last `n` (1) elements.
///
/// `(butlast '(1 2 3))` => `(1 2)`
#[builtin]
fn butlast(list: &Value, #[default(1)] n: usize) -> Outcome {
    let count = n;
    let mut items = elements(list)?;
    items.truncate(items.len().saturating_sub(count));
    Ok(Value::list(items))
}

/// Is the list at its end? An error for anything but a list.
///
/// `(endp nil)` => `T`
#[builtin]
fn endp(list: &Value) -> Outcome {
    match list {
        Value::Cons(_) => Ok(Value::NIL),
        Value::Symbol(known::NIL, ..) => Ok(Value::T),
        other => Err(Raise::type_error(other, known::LIST)),
    }
}

/// The car of a list.
///
/// `(car '(x))` => `X`
#[builtin(_, "list")]
fn car(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10>(image, args)
}

/// The cdr of a list.
///
/// `(cdr '(1 . x))` => `X`
#[builtin(_, "list")]
fn cdr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11>(image, args)
}

/// The car of the car of a list.
///
/// `(caar '((x)))` => `X`
#[builtin(_, "list")]
fn caar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b100>(image, args)
}

/// The car of the cdr of a list.
///
/// `(cadr '(1 x))` => `X`
#[builtin(_, "list")]
fn cadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b101>(image, args)
}

/// The cdr of the car of a list.
///
/// `(cdar '((1 . x)))` => `X`
#[builtin(_, "list")]
fn cdar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b110>(image, args)
}

/// The cdr of the cdr of a list.
///
/// `(cddr '(1 1 . x))` => `X`
#[builtin(_, "list")]
fn cddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b111>(image, args)
}

/// The car of the car of the car of a list.
///
/// `(caaar '(((x))))` => `X`
#[builtin(_, "list")]
fn caaar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1000>(image, args)
}

/// The car of the car of the cdr of a list.
///
/// `(caadr '(1 (x)))` => `X`
#[builtin(_, "list")]
fn caadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1001>(image, args)
}

/// The car of the cdr of the car of a list.
///
/// `(cadar '((1 x)))` => `X`
#[builtin(_, "list")]
fn cadar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1010>(image, args)
}

/// The car of the cdr of the cdr of a list.
///
/// `(caddr '(1 1 x))` => `X`
#[builtin(_, "list")]
fn caddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1011>(image, args)
}

/// The cdr of the car of the car of a list.
///
/// `(cdaar '(((1 . x))))` => `X`
#[builtin(_, "list")]
fn cdaar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1100>(image, args)
}

/// The cdr of the car of the cdr of a list.
///
/// `(cdadr '(1 (1 . x)))` => `X`
#[builtin(_, "list")]
fn cdadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1101>(image, args)
}

/// The cdr of the cdr of the car of a list.
///
/// `(cddar '((1 1 . x)))` => `X`
#[builtin(_, "list")]
fn cddar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1110>(image, args)
}

/// The cdr of the cdr of the cdr of a list.
///
/// `(cdddr '(1 1 1 . x))` => `X`
#[builtin(_, "list")]
fn cdddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b1111>(image, args)
}

/// The car of the car of the car of the car of a list.
///
/// `(caaaar '((((x)))))` => `X`
#[builtin(_, "list")]
fn caaaar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10000>(image, args)
}

/// The car of the car of the car of the cdr of a list.
///
/// `(caaadr '(1 ((x))))` => `X`
#[builtin(_, "list")]
fn caaadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10001>(image, args)
}

/// The car of the car of the cdr of the car of a list.
///
/// `(caadar '((1 (x))))` => `X`
#[builtin(_, "list")]
fn caadar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10010>(image, args)
}

/// The car of the car of the cdr of the cdr of a list.
///
/// `(caaddr '(1 1 (x)))` => `X`
#[builtin(_, "list")]
fn caaddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10011>(image, args)
}

/// The car of the cdr of the car of the car of a list.
///
/// `(cadaar '(((1 x))))` => `X`
#[builtin(_, "list")]
fn cadaar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10100>(image, args)
}

/// The car of the cdr of the car of the cdr of a list.
///
/// `(cadadr '(1 (1 x)))` => `X`
#[builtin(_, "list")]
fn cadadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10101>(image, args)
}

/// The car of the cdr of the cdr of the car of a list.
///
/// `(caddar '((1 1 x)))` => `X`
#[builtin(_, "list")]
fn caddar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10110>(image, args)
}

/// The car of the cdr of the cdr of the cdr of a list.
///
/// `(cadddr '(1 1 1 x))` => `X`
#[builtin(_, "list")]
fn cadddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b10111>(image, args)
}

/// The cdr of the car of the car of the car of a list.
///
/// `(cdaaar '((((1 . x)))))` => `X`
#[builtin(_, "list")]
fn cdaaar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11000>(image, args)
}

/// The cdr of the car of the car of the cdr of a list.
///
/// `(cdaadr '(1 ((1 . x))))` => `X`
#[builtin(_, "list")]
fn cdaadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11001>(image, args)
}

/// The cdr of the car of the cdr of the car of a list.
///
/// `(cdadar '((1 (1 . x))))` => `X`
#[builtin(_, "list")]
fn cdadar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11010>(image, args)
}

/// The cdr of the car of the cdr of the cdr of a list.
///
/// `(cdaddr '(1 1 (1 . x)))` => `X`
#[builtin(_, "list")]
fn cdaddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11011>(image, args)
}

/// The cdr of the cdr of the car of the car of a list.
///
/// `(cddaar '(((1 1 . x))))` => `X`
#[builtin(_, "list")]
fn cddaar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11100>(image, args)
}

/// The cdr of the cdr of the car of the cdr of a list.
///
/// `(cddadr '(1 (1 1 . x)))` => `X`
#[builtin(_, "list")]
fn cddadr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11101>(image, args)
}

/// The cdr of the cdr of the cdr of the car of a list.
///
/// `(cdddar '((1 1 1 . x)))` => `X`
#[builtin(_, "list")]
fn cdddar(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11110>(image, args)
}

/// The cdr of the cdr of the cdr of the cdr of a list.
///
/// `(cddddr '(1 1 1 1 . x))` => `X`
#[builtin(_, "list")]
fn cddddr(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11111>(image, args)
}

/// The first element of a list, or `NIL`.
///
/// `(first '(1 2 3 4 5 6 7 8 9 10))` => `1`
#[builtin(_, "list")]
fn first(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<0>(image, args)
}

/// The second element of a list, or `NIL`.
///
/// `(second '(1 2 3 4 5 6 7 8 9 10))` => `2`
#[builtin(_, "list")]
fn second(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<1>(image, args)
}

/// The third element of a list, or `NIL`.
///
/// `(third '(1 2 3 4 5 6 7 8 9 10))` => `3`
#[builtin(_, "list")]
fn third(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<2>(image, args)
}

/// The fourth element of a list, or `NIL`.
///
/// `(fourth '(1 2 3 4 5 6 7 8 9 10))` => `4`
#[builtin(_, "list")]
fn fourth(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<3>(image, args)
}

/// The fifth element of a list, or `NIL`.
///
/// `(fifth '(1 2 3 4 5 6 7 8 9 10))` => `5`
#[builtin(_, "list")]
fn fifth(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<4>(image, args)
}

/// The sixth element of a list, or `NIL`.
///
/// `(sixth '(1 2 3 4 5 6 7 8 9 10))` => `6`
#[builtin(_, "list")]
fn sixth(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<5>(image, args)
}

/// The seventh element of a list, or `NIL`.
///
/// `(seventh '(1 2 3 4 5 6 7 8 9 10))` => `7`
#[builtin(_, "list")]
fn seventh(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<6>(image, args)
}

/// The eighth element of a list, or `NIL`.
///
/// `(eighth '(1 2 3 4 5 6 7 8 9 10))` => `8`
#[builtin(_, "list")]
fn eighth(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<7>(image, args)
}

/// The ninth element of a list, or `NIL`.
///
/// `(ninth '(1 2 3 4 5 6 7 8 9 10))` => `9`
#[builtin(_, "list")]
fn ninth(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<8>(image, args)
}

/// The tenth element of a list, or `NIL`.
///
/// `(tenth '(1 2 3 4 5 6 7 8 9 10))` => `10`
#[builtin(_, "list")]
fn tenth(image: &mut Image, args: &[Value]) -> Outcome {
    ordinal::<9>(image, args)
}

/// The list without its first element.
///
/// `(rest '(1 2 3))` => `(2 3)`
#[builtin(_, "list")]
fn rest(image: &mut Image, args: &[Value]) -> Outcome {
    cxr::<0b11>(image, args)
}

/// Replaces the car of a list.
#[builtin("CAR", "value list")]
fn set_car(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10>(image, args)
}

/// Replaces the cdr of a list.
#[builtin("CDR", "value list")]
fn set_cdr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11>(image, args)
}

/// Replaces the car of the car of a list.
#[builtin("CAAR", "value list")]
fn set_caar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b100>(image, args)
}

/// Replaces the car of the cdr of a list.
#[builtin("CADR", "value list")]
fn set_cadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b101>(image, args)
}

/// Replaces the cdr of the car of a list.
#[builtin("CDAR", "value list")]
fn set_cdar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b110>(image, args)
}

/// Replaces the cdr of the cdr of a list.
#[builtin("CDDR", "value list")]
fn set_cddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b111>(image, args)
}

/// Replaces the car of the car of the car of a list.
#[builtin("CAAAR", "value list")]
fn set_caaar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1000>(image, args)
}

/// Replaces the car of the car of the cdr of a list.
#[builtin("CAADR", "value list")]
fn set_caadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1001>(image, args)
}

/// Replaces the car of the cdr of the car of a list.
#[builtin("CADAR", "value list")]
fn set_cadar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1010>(image, args)
}

/// Replaces the car of the cdr of the cdr of a list.
#[builtin("CADDR", "value list")]
fn set_caddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1011>(image, args)
}

/// Replaces the cdr of the car of the car of a list.
#[builtin("CDAAR", "value list")]
fn set_cdaar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1100>(image, args)
}

/// Replaces the cdr of the car of the cdr of a list.
#[builtin("CDADR", "value list")]
fn set_cdadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1101>(image, args)
}

/// Replaces the cdr of the cdr of the car of a list.
#[builtin("CDDAR", "value list")]
fn set_cddar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1110>(image, args)
}

/// Replaces the cdr of the cdr of the cdr of a list.
#[builtin("CDDDR", "value list")]
fn set_cdddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b1111>(image, args)
}

/// Replaces the car of the car of the car of the car of a list.
#[builtin("CAAAAR", "value list")]
fn set_caaaar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10000>(image, args)
}

/// Replaces the car of the car of the car of the cdr of a list.
#[builtin("CAAADR", "value list")]
fn set_caaadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10001>(image, args)
}

/// Replaces the car of the car of the cdr of the car of a list.
#[builtin("CAADAR", "value list")]
fn set_caadar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10010>(image, args)
}

/// Replaces the car of the car of the cdr of the cdr of a list.
#[builtin("CAADDR", "value list")]
fn set_caaddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10011>(image, args)
}

/// Replaces the car of the cdr of the car of the car of a list.
#[builtin("CADAAR", "value list")]
fn set_cadaar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10100>(image, args)
}

/// Replaces the car of the cdr of the car of the cdr of a list.
#[builtin("CADADR", "value list")]
fn set_cadadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10101>(image, args)
}

/// Replaces the car of the cdr of the cdr of the car of a list.
#[builtin("CADDAR", "value list")]
fn set_caddar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10110>(image, args)
}

/// Replaces the car of the cdr of the cdr of the cdr of a list.
#[builtin("CADDDR", "value list")]
fn set_cadddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b10111>(image, args)
}

/// Replaces the cdr of the car of the car of the car of a list.
#[builtin("CDAAAR", "value list")]
fn set_cdaaar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11000>(image, args)
}

/// Replaces the cdr of the car of the car of the cdr of a list.
#[builtin("CDAADR", "value list")]
fn set_cdaadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11001>(image, args)
}

/// Replaces the cdr of the car of the cdr of the car of a list.
#[builtin("CDADAR", "value list")]
fn set_cdadar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11010>(image, args)
}

/// Replaces the cdr of the car of the cdr of the cdr of a list.
#[builtin("CDADDR", "value list")]
fn set_cdaddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11011>(image, args)
}

/// Replaces the cdr of the cdr of the car of the car of a list.
#[builtin("CDDAAR", "value list")]
fn set_cddaar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11100>(image, args)
}

/// Replaces the cdr of the cdr of the car of the cdr of a list.
#[builtin("CDDADR", "value list")]
fn set_cddadr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11101>(image, args)
}

/// Replaces the cdr of the cdr of the cdr of the car of a list.
#[builtin("CDDDAR", "value list")]
fn set_cdddar(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11110>(image, args)
}

/// Replaces the cdr of the cdr of the cdr of the cdr of a list.
#[builtin("CDDDDR", "value list")]
fn set_cddddr(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11111>(image, args)
}

/// Replaces the first element of a list.
#[builtin("FIRST", "value list")]
fn set_first(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<0>(image, args)
}

/// Replaces the second element of a list.
#[builtin("SECOND", "value list")]
fn set_second(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<1>(image, args)
}

/// Replaces the third element of a list.
#[builtin("THIRD", "value list")]
fn set_third(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<2>(image, args)
}

/// Replaces the fourth element of a list.
#[builtin("FOURTH", "value list")]
fn set_fourth(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<3>(image, args)
}

/// Replaces the fifth element of a list.
#[builtin("FIFTH", "value list")]
fn set_fifth(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<4>(image, args)
}

/// Replaces the sixth element of a list.
#[builtin("SIXTH", "value list")]
fn set_sixth(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<5>(image, args)
}

/// Replaces the seventh element of a list.
#[builtin("SEVENTH", "value list")]
fn set_seventh(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<6>(image, args)
}

/// Replaces the eighth element of a list.
#[builtin("EIGHTH", "value list")]
fn set_eighth(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<7>(image, args)
}

/// Replaces the ninth element of a list.
#[builtin("NINTH", "value list")]
fn set_ninth(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<8>(image, args)
}

/// Replaces the tenth element of a list.
#[builtin("TENTH", "value list")]
fn set_tenth(image: &mut Image, args: &[Value]) -> Outcome {
    set_ordinal::<9>(image, args)
}

/// Replaces what follows a list's first element.
#[builtin("REST", "value list")]
fn set_rest(image: &mut Image, args: &[Value]) -> Outcome {
    set_cxr::<0b11>(image, args)
}

/// Access to pairs and list elements.
pub(crate) static TABLE: &[Builtin] = builtins![
    car, cdr, caar, cadr, cdar, cddr, caaar, caadr, cadar, caddr, cdaar, cdadr, cddar, cdddr,
    caaaar, caaadr, caadar, caaddr, cadaar, cadadr, caddar, cadddr, cdaaar, cdaadr, cdadar, cdaddr,
    cddaar, cddadr, cdddar, cddddr, first, second, third, fourth, fifth, sixth, seventh, eighth,
    ninth, tenth, rest, cons, rplaca, rplacd, nth, nthcdr, last, butlast, endp,
];

/// The same places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![
    set_car,
    set_cdr,
    set_caar,
    set_cadr,
    set_cdar,
    set_cddr,
    set_caaar,
    set_caadr,
    set_cadar,
    set_caddr,
    set_cdaar,
    set_cdadr,
    set_cddar,
    set_cdddr,
    set_caaaar,
    set_caaadr,
    set_caadar,
    set_caaddr,
    set_cadaar,
    set_cadadr,
    set_caddar,
    set_cadddr,
    set_cdaaar,
    set_cdaadr,
    set_cdadar,
    set_cdaddr,
    set_cddaar,
    set_cddadr,
    set_cdddar,
    set_cddddr,
    set_first,
    set_second,
    set_third,
    set_fourth,
    set_fifth,
    set_sixth,
    set_seventh,
    set_eighth,
    set_ninth,
    set_tenth,
    set_rest,
    set_nth,
];
