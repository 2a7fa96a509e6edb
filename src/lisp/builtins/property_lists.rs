//! Property lists, those of symbols included.

use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::value::{Rounds, Value};

use crate::value::sequence::{ListWalk, circular};

type Outcome = Result<Value, Box<Raise>>;

/// The pair of a property list that holds the value of an indicator.
fn find(plist: &Value, indicator: &Value) -> Result<Option<Value>, Box<Raise>> {
    let mut walk = ListWalk::new(plist.clone());
    while let Some(cons) = walk.next_cons()? {
        if walk.next_cons()?.is_none() {
            return Err(malformed(plist));
        }
        if cons.car().is_eq(indicator) {
            return Ok(Some(cons.cdr()));
        }
    }
    Ok(None)
}

fn malformed(plist: &Value) -> Box<Raise> {
    Raise::new(
        known::SIMPLE_TYPE_ERROR,
        "A property list has an odd number of elements.",
    )
    .with(known::K_DATUM, plist.clone())
    .with(known::K_EXPECTED_TYPE, known::LIST.into())
}

fn lookup(plist: &Value, indicator: &Value, default: Option<&Value>) -> Outcome {
    Ok(match find(plist, indicator)? {
        Some(place) => place.car_or_nil(),
        None => default.cloned().unwrap_or(Value::NIL),
    })
}

/// The property list with a value for an indicator; an existing entry is changed.
fn put(plist: &Value, indicator: &Value, value: &Value) -> Outcome {
    if let Some(Value::Cons(place)) = find(plist, indicator)? {
        place.set_car(value.clone());
        return Ok(plist.clone());
    }
    Ok(Value::list_with_tail(
        [indicator.clone(), value.clone()],
        plist.clone(),
    ))
}

/// Removes an indicator from a property list; returns the list and whether it was there.
fn remove(plist: &Value, indicator: &Value) -> Result<(Value, bool), Box<Raise>> {
    let mut before: Option<Value> = None;
    let mut rest = plist.clone();
    let mut rounds = Rounds::default();
    while let Value::Cons(cons) = &rest {
        if rounds.is_closed_by(cons) {
            return Err(circular(plist));
        }
        let after = match cons.cdr() {
            Value::Cons(value) => value.cdr(),
            _ => return Err(malformed(plist)),
        };
        if cons.car().is_eq(indicator) {
            return match before.as_ref().and_then(|b| b.as_cons()) {
                Some(value) => {
                    value.set_cdr(after);
                    Ok((plist.clone(), true))
                }
                None => Ok((after, true)),
            };
        }
        before = Some(cons.cdr());
        rest = after;
    }
    Ok((plist.clone(), false))
}

/// The value of an indicator in a property list.
///
/// `(getf '(:a 1 :b 2) :b)` => `2`
/// `(getf '(:a 1) :z :none)` => `:NONE`
#[builtin]
fn getf(plist: &Value, indicator: &Value, default: Option<&Value>) -> Outcome {
    lookup(plist, indicator, default)
}

/// The property list with a value for an indicator; an existing entry is changed.
///
/// `(system::putf '(:a 1) :b 2)` => `(:B 2 :A 1)`
#[builtin]
fn putf(plist: &Value, indicator: &Value, value: &Value) -> Outcome {
    put(plist, indicator, value)
}

/// The property list without an indicator, and whether it was there.
///
/// `(system::remove-property (list :a 1 :b 2) :b)` => `(:A 1) ; T`
#[builtin("REMOVE-PROPERTY")]
fn removef(plist: &Value, indicator: &Value) -> Outcome {
    let (plist, found) = remove(plist, indicator)?;
    Ok(Value::values(vec![plist, found.into()]))
}

/// The first indicator of a property list that is among the given ones, its value, and the list
/// from there.
///
/// `(get-properties '(:a 1 :b 2) '(:b :c))` => `:B ; 2 ; (:B 2)`
#[builtin]
fn get_properties(plist: &Value, indicators: &Value) -> Outcome {
    let mut walk = ListWalk::new(plist.clone());
    while let Some(cons) = walk.next_cons()? {
        let Some(value) = walk.next()? else {
            return Err(malformed(plist));
        };
        let mut indicators = indicators.iter_list();
        let is_among = indicators.any(|i| i.is_eq(&cons.car()));
        if !is_among && !indicators.rest.is_nil() {
            return Err(Raise::type_error(&indicators.rest, known::LIST));
        }
        if is_among {
            return Ok(Value::values(vec![cons.car(), value, Value::Cons(cons)]));
        }
    }
    Ok(Value::values(vec![Value::NIL; 3]))
}

/// A value as a symbol.
pub(crate) fn symbol(value: &Value) -> Result<Sym, Box<Raise>> {
    value
        .as_symbol()
        .ok_or_else(|| Raise::type_error(value, known::SYMBOL))
}

/// The value of an indicator in a symbol's property list.
///
/// `(get 'no-such-thing 'color 'grey)` => `GREY`
#[builtin]
fn get(image: &mut Image, symbol: Sym, indicator: &Value, default: Option<&Value>) -> Outcome {
    let plist = &image.symbol(symbol).plist;
    lookup(plist, indicator, default)
}

/// Sets an indicator in a symbol's property list.
#[builtin("GET")]
fn set_get(
    image: &mut Image,
    value: &Value,
    symbol: Sym,
    indicator: &Value,
    _default: Option<&Value>,
) -> Outcome {
    let sym = symbol;
    let plist = put(&image.symbol(sym).plist, indicator, value)?;
    image.symbols.get_mut(sym).plist = plist;
    Ok(value.clone())
}

/// Takes an indicator out of a symbol's property list.
///
/// `(remprop 'no-such-thing 'color)` => `NIL`
#[builtin]
fn remprop(image: &mut Image, symbol: Sym, indicator: &Value) -> Outcome {
    let sym = symbol;
    let (plist, found) = remove(&image.symbol(sym).plist, indicator)?;
    image.symbols.get_mut(sym).plist = plist;
    Ok(found.into())
}

/// A symbol's property list.
///
/// `(symbol-plist 'no-such-thing)` => `NIL`
#[builtin]
fn symbol_plist(image: &mut Image, symbol: Sym) -> Outcome {
    Ok(image.symbol(symbol).plist.clone())
}

/// Replaces a symbol's property list.
#[builtin("SYMBOL-PLIST")]
fn set_symbol_plist(image: &mut Image, value: &Value, symbol: Sym) -> Outcome {
    let sym = symbol;
    image.symbols.get_mut(sym).plist = value.clone();
    Ok(value.clone())
}

/// Property lists.
pub(crate) static TABLE: &[Builtin] = builtins![getf, get_properties, get, remprop, symbol_plist,];

/// What `setf` and `remf` of `getf` expand into; in `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![putf, removef,];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_get, set_symbol_plist,];
