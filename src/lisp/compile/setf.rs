//! Generalised places: `setf` and the macros that modify a place.

use crate::evaluator::nested;
use crate::image::Image;
use crate::image::setf_expander::SetfExpander;
use crate::print;
use crate::value::Value;
use crate::value::form::form;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym, VariableKind};

/// A setf expansion: evaluate `values` into `temps` in order, bind `stores` to the new values, then
/// evaluate `setter`; `getter` reads the place.
pub struct Expansion {
    /// Variables for the place's subforms.
    pub(crate) temps: Vec<Value>,
    /// The subforms.
    pub values: Vec<Value>,
    /// Variables for the new values.
    pub(crate) stores: Vec<Value>,
    /// The form that stores.
    pub setter: Value,
    /// The form that reads.
    pub(crate) getter: Value,
}

/// The setf expansion of a place.
pub fn expansion(image: &mut Image, place: &Value) -> Result<Expansion, Box<Raise>> {
    let cons = match place {
        Value::Symbol(..) => {
            if let Some(inner) = symbol_macro(image, place)? {
                return expansion(image, &inner);
            }
            let store = gensym(image, "NEW");
            return Ok(Expansion {
                temps: Vec::new(),
                values: Vec::new(),
                setter: Value::list([known::SETQ.into(), place.clone(), store.clone()]),
                stores: vec![store],
                getter: place.clone(),
            });
        }
        Value::Cons(cons) => cons,
        other => return Err(not_a_place(image, other)),
    };
    let Some(name) = cons.car().as_symbol() else {
        return Err(not_a_place(image, place));
    };
    let Some(args) = cons.cdr().list_to_vec() else {
        return Err(not_a_place(image, place));
    };
    let environment = image.environment.clone();
    match super::environment::expand_locally(image, place, &environment)? {
        Some(Some(inner)) => return expansion(image, &inner),
        Some(None) => return function_expansion(image, place, name, args),
        None => {}
    }
    if let Some(expander) = image.setf_expanders.get(&name).cloned() {
        return user_expansion(image, place, args, expander);
    }
    match name {
        known::THE => {
            let inner = args.get(1).cloned().unwrap_or(Value::NIL);
            return expansion(image, &inner);
        }
        known::VALUES => return values_expansion(image, &args),
        known::GETF => {
            return nested_expansion(image, &args, known::PUTF, known::GETF, 0);
        }
        known::LDB | known::MASK_FIELD => {
            let setter = if name == known::LDB {
                known::DPB
            } else {
                known::DEPOSIT_FIELD
            };
            return byte_expansion(image, &args, setter, name);
        }
        _ => {}
    }
    if image.symbol(name).setf_function.is_none()
        && let Some(inner) = expand_place(image, place, name)?
    {
        return expansion(image, &inner);
    }
    function_expansion(image, place, name, args)
}

/// The form that a symbol stands for as a variable, if it is a symbol macro.
fn symbol_macro(image: &mut Image, name: &Value) -> Result<Option<Value>, Box<Raise>> {
    let environment = image.environment.clone();
    super::macroexpand_1_in(image, name, &environment)
}

/// A place whose setter is a function.
fn function_expansion(
    image: &mut Image,
    place: &Value,
    name: Sym,
    args: Vec<Value>,
) -> Result<Expansion, Box<Raise>> {
    let temps: Vec<Value> = args.iter().map(|_| gensym(image, "ARG")).collect();
    let store = gensym(image, "NEW");
    let getter = Value::cons(name.into(), Value::list(temps.clone()));
    let setter = if name == known::APPLY {
        apply_setter(image, &args, &temps, &store)?
    } else {
        let function = Value::list([
            known::FUNCTION.into(),
            Value::list([known::SETF.into(), name.into()]),
        ]);
        Value::list_with_tail(
            [known::FUNCALL.into(), function, store.clone()],
            Value::list(temps.clone()),
        )
    };
    if let (Value::Cons(from), Value::Cons(to)) = (place, &setter) {
        to.set_place(from.place());
    }
    Ok(Expansion {
        temps,
        values: args,
        stores: vec![store],
        setter,
        getter,
    })
}

fn gensym(image: &mut Image, prefix: &str) -> Value {
    image.gensym(prefix)
}

fn not_a_place(image: &Image, place: &Value) -> Box<Raise> {
    let shown = print::to_string(image, place, true);
    Raise::program(format!("{shown} is not a place that can be set."))
}

/// A place that is a macro call, expanded once.
fn expand_place(image: &mut Image, place: &Value, name: Sym) -> Result<Option<Value>, Box<Raise>> {
    match image.symbol(name).function {
        FunctionCell::Macro(_) | FunctionCell::Builtin => super::macroexpand_1(image, place),
        _ => Ok(None),
    }
}

fn apply_setter(
    image: &mut Image,
    args: &[Value],
    temps: &[Value],
    store: &Value,
) -> Result<Value, Box<Raise>> {
    // (apply #'name args…) → (apply #'(setf name) new args…)
    let name = args
        .first()
        .filter(|f| {
            matches!(
                f.car_or_nil().as_symbol(),
                Some(known::FUNCTION | known::QUOTE)
            )
        })
        .map(|f| f.cdr_or_nil().car_or_nil());
    let Some(name) = name else {
        let shown = Value::cons(known::APPLY.into(), Value::list(args.to_vec()));
        return Err(not_a_place(image, &shown));
    };
    let function = Value::list([
        known::FUNCTION.into(),
        Value::list([known::SETF.into(), name]),
    ]);
    let rest: Vec<Value> = temps.iter().skip(1).cloned().collect();
    Ok(Value::list_with_tail(
        [known::APPLY.into(), function, store.clone()],
        Value::list(rest),
    ))
}

fn values_expansion(image: &mut Image, places: &[Value]) -> Result<Expansion, Box<Raise>> {
    let mut all = Expansion {
        temps: Vec::new(),
        values: Vec::new(),
        stores: Vec::new(),
        setter: Value::NIL,
        getter: Value::NIL,
    };
    let (mut setters, mut getters) = (Vec::new(), Vec::new());
    for place in places {
        let one = expansion(image, place)?;
        all.temps.extend(one.temps);
        all.values.extend(one.values);
        // Each place takes one value, also one of several variables: those after the first get NIL.
        let mut stores = one.stores.into_iter();
        let first = stores.next().unwrap_or_else(|| gensym(image, "NEW"));
        all.stores.push(first);
        let others: Vec<Value> = stores.collect();
        setters.push(if others.is_empty() {
            one.setter
        } else {
            Value::list([known::LET.into(), Value::list(others), one.setter])
        });
        getters.push(one.getter);
    }
    all.setter = Value::cons(known::VALUES.into(), Value::list(setters));
    all.getter = Value::cons(known::VALUES.into(), Value::list(getters));
    Ok(all)
}

/// `(getf place indicator [default])`: its setter stores a new property list in the inner place.
fn nested_expansion(
    image: &mut Image,
    args: &[Value],
    update: Sym,
    reader: Sym,
    inner_index: usize,
) -> Result<Expansion, Box<Raise>> {
    let place = args.get(inner_index).cloned().unwrap_or(Value::NIL);
    let mut inner = expansion(image, &place)?;
    let store = gensym(image, "NEW");
    let mut extra = Vec::new();
    for (i, arg) in args.iter().enumerate() {
        if i != inner_index {
            let temp = gensym(image, "ARG");
            inner.temps.push(temp.clone());
            inner.values.push(arg.clone());
            extra.push(temp);
        }
    }
    let key = extra.first().cloned().unwrap_or(Value::NIL);
    let updated = Value::list([update.into(), inner.getter.clone(), key, store.clone()]);
    let bindings: Vec<Value> = inner
        .stores
        .iter()
        .map(|s| Value::list([s.clone(), updated.clone()]))
        .collect();
    let setter = Value::list([
        known::LET.into(),
        Value::list(bindings),
        inner.setter,
        store.clone(),
    ]);
    let getter = Value::list_with_tail([reader.into(), inner.getter], Value::list(extra));
    Ok(Expansion {
        temps: inner.temps,
        values: inner.values,
        stores: vec![store],
        setter,
        getter,
    })
}

/// `(ldb bytespec place)`.
fn byte_expansion(
    image: &mut Image,
    args: &[Value],
    update: Sym,
    reader: Sym,
) -> Result<Expansion, Box<Raise>> {
    let spec = args.first().cloned().unwrap_or(Value::NIL);
    let place = args.get(1).cloned().unwrap_or(Value::NIL);
    let inner = expansion(image, &place)?;
    let store = gensym(image, "NEW");
    let temp = gensym(image, "ARG");
    let updated = Value::list([
        update.into(),
        store.clone(),
        temp.clone(),
        inner.getter.clone(),
    ]);
    let bindings: Vec<Value> = inner
        .stores
        .iter()
        .map(|s| Value::list([s.clone(), updated.clone()]))
        .collect();
    let setter = Value::list([
        known::LET.into(),
        Value::list(bindings),
        inner.setter,
        store.clone(),
    ]);
    let mut temps = vec![temp.clone()];
    temps.extend(inner.temps);
    let mut values = vec![spec];
    values.extend(inner.values);
    Ok(Expansion {
        temps,
        values,
        stores: vec![store],
        setter,
        getter: Value::list([reader.into(), temp, inner.getter]),
    })
}

fn user_expansion(
    image: &mut Image,
    place: &Value,
    args: Vec<Value>,
    expander: SetfExpander,
) -> Result<Expansion, Box<Raise>> {
    let name = place.car_or_nil();
    match expander {
        SetfExpander::Update(update) => {
            let temps: Vec<Value> = args.iter().map(|_| gensym(image, "ARG")).collect();
            let store = gensym(image, "NEW");
            let mut call = vec![update.into()];
            call.extend(temps.iter().cloned());
            call.push(store.clone());
            Ok(Expansion {
                getter: Value::cons(name, Value::list(temps.clone())),
                temps,
                values: args,
                stores: vec![store],
                setter: Value::list(call),
            })
        }
        SetfExpander::Long(function, store_count) => {
            let temps: Vec<Value> = args.iter().map(|_| gensym(image, "ARG")).collect();
            let stores: Vec<Value> = (0..store_count).map(|_| gensym(image, "NEW")).collect();
            let mut call_args = vec![Value::list(stores.clone())];
            call_args.extend(temps.iter().cloned());
            let setter = nested::call_nested(image, function, call_args)?;
            Ok(Expansion {
                getter: Value::cons(name, Value::list(temps.clone())),
                temps,
                values: args,
                stores,
                setter,
            })
        }
        SetfExpander::Expander(function) => {
            let result = {
                let environment = image.environment.clone();
                nested::call_nested_values(image, function, vec![place.clone(), environment])?
            };
            let mut parts = result.into_iter();
            let mut next = || parts.next().unwrap_or(Value::NIL);
            let (temps, values, stores) = (next(), next(), next());
            let (setter, getter) = (next(), next());
            Ok(Expansion {
                temps: temps.iter_list().collect(),
                values: values.iter_list().collect(),
                stores: stores.iter_list().collect(),
                setter,
                getter,
            })
        }
    }
}

/// The form that sets one place to the value of a form.
fn setf_one(image: &mut Image, place: &Value, value: &Value) -> Result<Value, Box<Raise>> {
    if let Value::Symbol(..) = place {
        return Ok(Value::list([
            known::SETQ.into(),
            place.clone(),
            value.clone(),
        ]));
    }
    let parts = expansion(image, place)?;
    let mut bindings: Vec<Value> = parts
        .temps
        .iter()
        .zip(&parts.values)
        .map(|(t, v)| Value::list([t.clone(), v.clone()]))
        .collect();
    if let [store] = parts.stores.as_slice() {
        bindings.push(Value::list([store.clone(), value.clone()]));
        return Ok(Value::list([
            known::LET_STAR.into(),
            Value::list(bindings),
            parts.setter,
        ]));
    }
    let body = Value::list([
        known::MULTIPLE_VALUE_BIND.into(),
        Value::list(parts.stores),
        value.clone(),
        parts.setter,
    ]);
    Ok(Value::list([
        known::LET_STAR.into(),
        Value::list(bindings),
        body,
    ]))
}

/// `(setf {place value}*)`.
pub(super) fn expand_setf(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let parts: Vec<Value> = form.cdr_or_nil().iter_list().collect();
    if !parts.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of args to SETF"));
    }
    let mut forms = Vec::new();
    for pair in parts.chunks_exact(2) {
        forms.push(setf_one(image, &pair[0], &pair[1])?);
    }
    Ok(match forms.len() {
        1 => forms.remove(0),
        _ => Value::cons(known::PROGN.into(), Value::list(forms)),
    })
}

/// `(psetf {place value}*)`: all values are computed before any place is set.
pub(super) fn expand_psetf(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let parts: Vec<Value> = form.cdr_or_nil().iter_list().collect();
    if !parts.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of args to PSETF"));
    }
    let mut bound = Vec::new();
    let mut setters = Vec::new();
    for pair in parts.chunks_exact(2) {
        let expanded = expansion(image, &pair[0])?;
        let temps: Vec<Value> = pairs(&expanded).collect();
        setters.push(expanded.setter);
        bound.push((temps, expanded.stores, pair[1].clone()));
    }
    setters.push(Value::NIL);
    // From the last pair outwards, since a place may take several values.
    let mut forms = Value::list(setters);
    let mut bindings: Vec<Value> = Vec::new();
    for (temps, stores, value) in bound.into_iter().rev() {
        if let [store] = stores.as_slice() {
            bindings.insert(0, Value::list([store.clone(), value]));
            bindings.splice(0..0, temps);
            continue;
        }
        if !bindings.is_empty() {
            let inner = Value::list(std::mem::take(&mut bindings));
            forms = form![form![known::LET_STAR, inner; forms]];
        }
        let several = form![known::MULTIPLE_VALUE_BIND, Value::list(stores), value; forms];
        forms = form![several];
        bindings = temps;
    }
    Ok(form![known::LET_STAR, Value::list(bindings); forms])
}

fn pairs(expanded: &Expansion) -> impl Iterator<Item = Value> + '_ {
    expanded
        .temps
        .iter()
        .zip(&expanded.values)
        .map(|(t, v)| Value::list([t.clone(), v.clone()]))
}

/// A form that replaces a place's value by a function of it: `new_value` maps the form that reads
/// the place to the form for the new value. The variable in `before` is bound before the place's
/// parts are evaluated, those in `operands` after that, and before the place is read.
pub(crate) fn modify(
    image: &mut Image,
    place: &Value,
    before: Option<(Value, Value)>,
    operands: Vec<(Value, Value)>,
    new_value: impl FnOnce(&mut Image, Value) -> Value,
) -> Result<Value, Box<Raise>> {
    let bound = |(var, form)| Value::list([var, form]);
    let mut bindings: Vec<Value> = before.into_iter().map(bound).collect();
    if matches!(place, Value::Symbol(..)) && symbol_macro(image, place)?.is_none() {
        bindings.extend(operands.into_iter().map(bound));
        let new = new_value(image, place.clone());
        let set = Value::list([known::SETQ.into(), place.clone(), new]);
        if bindings.is_empty() {
            return Ok(set);
        }
        return Ok(Value::list([
            known::LET_STAR.into(),
            Value::list(bindings),
            set,
        ]));
    }
    let expanded = expansion(image, place)?;
    bindings.extend(pairs(&expanded));
    bindings.extend(operands.into_iter().map(bound));
    let new = new_value(image, expanded.getter.clone());
    let store = expanded.stores.first().cloned().unwrap_or(Value::NIL);
    bindings.push(Value::list([store, new]));
    Ok(Value::list([
        known::LET_STAR.into(),
        Value::list(bindings),
        expanded.setter,
    ]))
}

fn incremented(image: &mut Image, form: &Value, operator: Sym) -> Result<Value, Box<Raise>> {
    let args = form.cdr_or_nil();
    let place = args.car_or_nil();
    let delta = match args.cdr_or_nil() {
        Value::Cons(c) => c.car(),
        _ => Value::Int(1),
    };
    let (bound, delta) = operand(image, "DELTA", delta, false);
    modify(
        image,
        &place,
        None,
        bound.into_iter().collect(),
        |_, getter| Value::list([operator.into(), getter, delta]),
    )
}

/// A form that is evaluated before what comes after it, as a variable and its binding; it stays as
/// it is if that makes no difference. `may_change`: may what comes after it assign variables?
pub(crate) fn operand(
    image: &mut Image,
    name: &str,
    form: Value,
    may_change: bool,
) -> (Option<(Value, Value)>, Value) {
    let is_bound = match &form {
        Value::Cons(_) => form.car_or_nil().as_symbol() != Some(known::QUOTE),
        Value::Symbol(name, ..) => may_change && image.symbol(*name).kind != VariableKind::Constant,
        _ => false,
    };
    if !is_bound {
        return (None, form);
    }
    let var = gensym(image, name);
    (Some((var.clone(), form)), var)
}

pub(super) fn expand_incf(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    incremented(image, form, known::PLUS)
}

pub(super) fn expand_decf(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    incremented(image, form, known::MINUS)
}

/// `(push item place)`.
pub(super) fn expand_push(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let args = form.cdr_or_nil();
    let item = args.car_or_nil();
    let place = args.cdr_or_nil().car_or_nil();
    if matches!(place, Value::Symbol(..)) {
        let new = Value::list([known::CONS.into(), item, place.clone()]);
        return Ok(Value::list([known::SETQ.into(), place, new]));
    }
    let (before, item) = operand(image, "ITEM", item, true);
    modify(image, &place, before, Vec::new(), |_, getter| {
        Value::list([known::CONS.into(), item, getter])
    })
}

/// `(pop place)`.
pub(super) fn expand_pop(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let place = form.cdr_or_nil().car_or_nil();
    let expanded = expansion(image, &place)?;
    let list = gensym(image, "LIST");
    let mut bindings: Vec<Value> = pairs(&expanded).collect();
    bindings.push(Value::list([list.clone(), expanded.getter.clone()]));
    let store = expanded.stores.first().cloned().unwrap_or(Value::NIL);
    bindings.push(Value::list([
        store,
        Value::list([known::CDR.into(), list.clone()]),
    ]));
    Ok(Value::list([
        known::LET_STAR.into(),
        Value::list(bindings),
        expanded.setter,
        Value::list([known::CAR.into(), list]),
    ]))
}
