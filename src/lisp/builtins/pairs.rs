//! Pairs and positions in lists: `car` to `cddddr`, `first` to `tenth`, `nth`, `last`.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
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

/// Sets the place at the end of a path.
fn set_path(path: u32, list: &Value, value: Value) -> Outcome {
    // All letters but the first lead to the pair that is changed.
    let length = 31 - path.leading_zeros();
    let first = path >> (length - 1) & 1;
    let before = path & !(0b11 << (length - 1)) | 1 << (length - 1);
    let place = follow(before, list)?;
    let Value::Cons(cons) = &place else {
        return Err(Raise::type_error(&place, known::CONS));
    };
    cycles::note(cons, &value);
    if first == 0 {
        cons.set_car(value.clone());
    } else {
        cons.set_cdr(value.clone());
    }
    Ok(value)
}

/// Functions that follow a path, and the same as places.
macro_rules! paths {
    ($($name:ident $set:ident $lisp_name:literal $path:literal $what:literal $example:literal;)*) => {
        $(
            #[doc = concat!("The ", $what, ".")]
            #[doc = ""]
            #[doc = $example]
            #[builtin]
            fn $name(list: &Value) -> Outcome {
                follow($path, list)
            }

            #[doc = concat!("Replaces the ", $what, ".")]
            #[builtin($lisp_name)]
            fn $set(value: Value, list: &Value) -> Outcome {
                set_path($path, list, value)
            }
        )*

        /// Cars and cdrs.
        pub(crate) static PATHS: &[Builtin] = builtins![$($name),*];

        /// The same places for `setf`; the new value is the first argument.
        pub(crate) static PATH_SETTERS: &[Builtin] = builtins![$($set),*];
    };
}

paths! {
    car set_car "CAR" 0b10 "car of a list" "`(car '(x))` => `X`";
    cdr set_cdr "CDR" 0b11 "cdr of a list" "`(cdr '(1 . x))` => `X`";
    caar set_caar "CAAR" 0b100 "car of the car of a list" "`(caar '((x)))` => `X`";
    cadr set_cadr "CADR" 0b101 "car of the cdr of a list" "`(cadr '(1 x))` => `X`";
    cdar set_cdar "CDAR" 0b110 "cdr of the car of a list" "`(cdar '((1 . x)))` => `X`";
    cddr set_cddr "CDDR" 0b111 "cdr of the cdr of a list" "`(cddr '(1 1 . x))` => `X`";
    caaar set_caaar "CAAAR" 0b1000 "car of the car of the car of a list" "`(caaar '(((x))))` => `X`";
    caadr set_caadr "CAADR" 0b1001 "car of the car of the cdr of a list" "`(caadr '(1 (x)))` => `X`";
    cadar set_cadar "CADAR" 0b1010 "car of the cdr of the car of a list" "`(cadar '((1 x)))` => `X`";
    caddr set_caddr "CADDR" 0b1011 "car of the cdr of the cdr of a list" "`(caddr '(1 1 x))` => `X`";
    cdaar set_cdaar "CDAAR" 0b1100 "cdr of the car of the car of a list" "`(cdaar '(((1 . x))))` => `X`";
    cdadr set_cdadr "CDADR" 0b1101 "cdr of the car of the cdr of a list" "`(cdadr '(1 (1 . x)))` => `X`";
    cddar set_cddar "CDDAR" 0b1110 "cdr of the cdr of the car of a list" "`(cddar '((1 1 . x)))` => `X`";
    cdddr set_cdddr "CDDDR" 0b1111 "cdr of the cdr of the cdr of a list" "`(cdddr '(1 1 1 . x))` => `X`";
    caaaar set_caaaar "CAAAAR" 0b10000 "car of the car of the car of the car of a list" "`(caaaar '((((x)))))` => `X`";
    caaadr set_caaadr "CAAADR" 0b10001 "car of the car of the car of the cdr of a list" "`(caaadr '(1 ((x))))` => `X`";
    caadar set_caadar "CAADAR" 0b10010 "car of the car of the cdr of the car of a list" "`(caadar '((1 (x))))` => `X`";
    caaddr set_caaddr "CAADDR" 0b10011 "car of the car of the cdr of the cdr of a list" "`(caaddr '(1 1 (x)))` => `X`";
    cadaar set_cadaar "CADAAR" 0b10100 "car of the cdr of the car of the car of a list" "`(cadaar '(((1 x))))` => `X`";
    cadadr set_cadadr "CADADR" 0b10101 "car of the cdr of the car of the cdr of a list" "`(cadadr '(1 (1 x)))` => `X`";
    caddar set_caddar "CADDAR" 0b10110 "car of the cdr of the cdr of the car of a list" "`(caddar '((1 1 x)))` => `X`";
    cadddr set_cadddr "CADDDR" 0b10111 "car of the cdr of the cdr of the cdr of a list" "`(cadddr '(1 1 1 x))` => `X`";
    cdaaar set_cdaaar "CDAAAR" 0b11000 "cdr of the car of the car of the car of a list" "`(cdaaar '((((1 . x)))))` => `X`";
    cdaadr set_cdaadr "CDAADR" 0b11001 "cdr of the car of the car of the cdr of a list" "`(cdaadr '(1 ((1 . x))))` => `X`";
    cdadar set_cdadar "CDADAR" 0b11010 "cdr of the car of the cdr of the car of a list" "`(cdadar '((1 (1 . x))))` => `X`";
    cdaddr set_cdaddr "CDADDR" 0b11011 "cdr of the car of the cdr of the cdr of a list" "`(cdaddr '(1 1 (1 . x)))` => `X`";
    cddaar set_cddaar "CDDAAR" 0b11100 "cdr of the cdr of the car of the car of a list" "`(cddaar '(((1 1 . x))))` => `X`";
    cddadr set_cddadr "CDDADR" 0b11101 "cdr of the cdr of the car of the cdr of a list" "`(cddadr '(1 (1 1 . x)))` => `X`";
    cdddar set_cdddar "CDDDAR" 0b11110 "cdr of the cdr of the cdr of the car of a list" "`(cdddar '((1 1 1 . x)))` => `X`";
    cddddr set_cddddr "CDDDDR" 0b11111 "cdr of the cdr of the cdr of the cdr of a list" "`(cddddr '(1 1 1 1 . x))` => `X`";
}

/// The list without its first element.
///
/// `(rest '(1 2 3))` => `(2 3)`
#[builtin]
fn rest(list: &Value) -> Outcome {
    cdr_of(list)
}

/// Replaces what follows a list's first element.
#[builtin("REST")]
fn set_rest(value: Value, list: &Value) -> Outcome {
    set_path(0b11, list, value)
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

/// Functions that access an element, and the same as places.
macro_rules! ordinals {
    ($($name:ident $set:ident $lisp_name:literal $index:literal $what:literal $example:literal;)*) => {
        $(
            #[doc = concat!("The ", $what, ", or `NIL`.")]
            #[doc = ""]
            #[doc = $example]
            #[builtin]
            fn $name(list: &Value) -> Outcome {
                car_of(&nth_cdr($index, list)?)
            }

            #[doc = concat!("Replaces the ", $what, ".")]
            #[builtin($lisp_name)]
            fn $set(value: &Value, list: &Value) -> Outcome {
                set_nth_of($index, list, value)
            }
        )*

        /// Elements by number.
        pub(crate) static ORDINALS: &[Builtin] = builtins![$($name),*];

        /// The same places for `setf`; the new value is the first argument.
        pub(crate) static ORDINAL_SETTERS: &[Builtin] = builtins![$($set),*];
    };
}

ordinals! {
    first set_first "FIRST" 0 "first element of a list" "`(first '(1 2 3 4 5 6 7 8 9 10))` => `1`";
    second set_second "SECOND" 1 "second element of a list" "`(second '(1 2 3 4 5 6 7 8 9 10))` => `2`";
    third set_third "THIRD" 2 "third element of a list" "`(third '(1 2 3 4 5 6 7 8 9 10))` => `3`";
    fourth set_fourth "FOURTH" 3 "fourth element of a list" "`(fourth '(1 2 3 4 5 6 7 8 9 10))` => `4`";
    fifth set_fifth "FIFTH" 4 "fifth element of a list" "`(fifth '(1 2 3 4 5 6 7 8 9 10))` => `5`";
    sixth set_sixth "SIXTH" 5 "sixth element of a list" "`(sixth '(1 2 3 4 5 6 7 8 9 10))` => `6`";
    seventh set_seventh "SEVENTH" 6 "seventh element of a list" "`(seventh '(1 2 3 4 5 6 7 8 9 10))` => `7`";
    eighth set_eighth "EIGHTH" 7 "eighth element of a list" "`(eighth '(1 2 3 4 5 6 7 8 9 10))` => `8`";
    ninth set_ninth "NINTH" 8 "ninth element of a list" "`(ninth '(1 2 3 4 5 6 7 8 9 10))` => `9`";
    tenth set_tenth "TENTH" 9 "tenth element of a list" "`(tenth '(1 2 3 4 5 6 7 8 9 10))` => `10`";
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

/// Access to pairs and list elements.
pub(crate) static TABLE: &[Builtin] =
    builtins![rest, cons, rplaca, rplacd, nth, nthcdr, last, butlast, endp];

/// The same places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_rest, set_nth];
