//! `defgeneric` and `defmethod`: their expansions, and the builtins behind them.

use std::rc::Rc;

use super::combination::combination_named;
use super::method::{
    MethodDefinition, MethodObject, changed, define_method, ensure_generic, method_value,
    specializer,
};
use crate::image::Image;
use crate::typed::{self, builtin};
use crate::value::Value;
use crate::value::form::{doc_form, form, quote, split_body};
use crate::value::function::Function;
use crate::value::known;
use crate::value::parameters::Parameters;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// `(defmethod name qualifiers… lambda-list body…)`.
pub(crate) fn expand_defmethod(image: &mut Image, whole: &Value) -> Result<Value, Box<Raise>> {
    let mut items = whole.iter_list();
    items.next();
    let name = items.next().unwrap_or(Value::NIL);
    let mut qualifiers = Vec::new();
    let lambda_list = loop {
        match items.next() {
            Some(list) if list.is_list() => break list,
            Some(Value::Cons(_)) | None => {
                return Err(Raise::program(
                    "DEFMETHOD takes a name, qualifiers, a lambda list and a body.",
                ));
            }
            // Any object but a list: symbols and numbers for example.
            Some(qualifier) => qualifiers.push(qualifier),
        }
    };
    let (plain, specializers) = split_lambda_list(image, &lambda_list)?;
    let split = split_body(&items.rest);
    let takes_next = asks_for_next(image, &split.forms);
    let doc = doc_form(split.doc.as_ref());
    let function = method_function(image, &name, &plain, split, takes_next);
    Ok(form![
        known::SYS_ADD_METHOD,
        quote(name),
        quote(Value::list(qualifiers)),
        form![known::LIST; Value::list(specializers)],
        quote(plain),
        Value::bool(takes_next),
        doc,
        function,
    ])
}

/// The lambda list without specializers, and a form for each specializer.
fn split_lambda_list(
    image: &Image,
    lambda_list: &Value,
) -> Result<(Value, Vec<Value>), Box<Raise>> {
    let mut plain = Vec::new();
    let mut specializers = Vec::new();
    let mut items = lambda_list.iter_list();
    while let Some(item) = items.next() {
        match &item {
            Value::Symbol(sym, ..) if image.name(*sym).starts_with('&') => {
                return Ok((
                    Value::list_with_tail(plain, Value::cons(item, items.rest)),
                    specializers,
                ));
            }
            Value::Symbol(..) => {
                plain.push(item);
                specializers.push(Value::T);
            }
            Value::Cons(parameter) => {
                plain.push(parameter.car());
                let wanted = parameter.cdr().car_or_nil();
                specializers.push(match wanted.car_or_nil().as_symbol() {
                    Some(known::EQL) => {
                        let object = wanted.cdr_or_nil().car_or_nil();
                        form![known::LIST, quote(known::EQL), object]
                    }
                    _ => quote(wanted),
                });
            }
            other => {
                return Err(Raise::program(format!(
                    "{} is not a parameter of a method.",
                    super::text(image, other)
                )));
            }
        }
    }
    Ok((Value::list(plain), specializers))
}

/// The function of a method: it takes the function that calls the next method, if its body uses
/// that, and accepts any keyword, because the generic function checks them.
fn method_function(
    image: &mut Image,
    name: &Value,
    lambda_list: &Value,
    body: crate::value::form::Body,
    takes_next: bool,
) -> Value {
    let lambda_list = with_other_keys(lambda_list);
    if !takes_next {
        let forms = Value::list_with_tail(body.declarations, body.forms);
        return form![known::NAMED_LAMBDA, name.clone(), lambda_list; forms];
    }
    let next = image.gensym("NEXT-METHOD");
    let args = image.gensym("ARGS");
    // (or next (%no-next-method 'name)): the function to call.
    let callee = form![
        known::OR,
        next.clone(),
        form![known::SYS_NO_NEXT_METHOD, quote(name.clone())],
    ];
    let is_there = form![known::IF, next.clone(), Value::T, Value::NIL];
    let rest = form![known::L_REST, args.clone()];
    let inner = if names_function(&body.forms) {
        form![
            known::FLET,
            form![
                form![
                    known::CALL_NEXT_METHOD,
                    rest,
                    form![known::APPLY, callee, args],
                ],
                form![known::NEXT_METHOD_P, Value::NIL, is_there],
            ];
            body.forms
        ]
    } else {
        form![
            known::MACROLET,
            form![
                form![
                    known::CALL_NEXT_METHOD,
                    rest,
                    form![known::LIST_STAR, quote(known::FUNCALL), quote(callee), args],
                ],
                form![known::NEXT_METHOD_P, Value::NIL, quote(is_there)],
            ];
            body.forms
        ]
    };
    let forms = Value::list_with_tail(body.declarations, form![inner]);
    form![known::NAMED_LAMBDA, name.clone(), form![next; lambda_list]; forms]
}

/// The lambda list with `&allow-other-keys` if it has `&key`.
fn with_other_keys(lambda_list: &Value) -> Value {
    let items: Vec<Value> = lambda_list.iter_list().collect();
    let position = |sym: Sym| items.iter().position(|i| i.as_symbol() == Some(sym));
    if position(known::L_KEY).is_none() || position(known::L_ALLOW_OTHER_KEYS).is_some() {
        return lambda_list.clone();
    }
    let end = position(known::L_AUX).unwrap_or(items.len());
    let mut all = items;
    all.insert(end, known::L_ALLOW_OTHER_KEYS.into());
    Value::list(all)
}

/// May the body call the next method? It may if it names the operator, or uses a macro of the
/// program, which may expand into a call.
fn asks_for_next(image: &Image, forms: &Value) -> bool {
    any_part(forms, |part| match part {
        Value::Symbol(known::CALL_NEXT_METHOD | known::NEXT_METHOD_P, ..) => true,
        Value::Cons(cons) => cons
            .car()
            .as_symbol()
            .is_some_and(|operator| image.symbol(operator).function.is_macro_of_program()),
        _ => false,
    })
}

/// Does the body use `call-next-method` as a function object?
fn names_function(forms: &Value) -> bool {
    any_part(forms, |part| {
        part.car_or_nil().as_symbol() == Some(known::FUNCTION)
            && matches!(
                part.cdr_or_nil().car_or_nil().as_symbol(),
                Some(known::CALL_NEXT_METHOD | known::NEXT_METHOD_P)
            )
    })
}

/// Does some part of a form, itself included, pass the test?
fn any_part(form: &Value, test: impl Fn(&Value) -> bool) -> bool {
    let mut pending = vec![form.clone()];
    while let Some(part) = pending.pop() {
        if test(&part) {
            return true;
        }
        if let Value::Cons(cons) = &part {
            pending.push(cons.cdr());
            pending.push(cons.car());
        }
    }
    false
}

/// Defines a method as DEFMETHOD describes it.
#[builtin("%ADD-METHOD")]
pub(crate) fn add_method(
    image: &mut Image,
    name: Value,
    qualifiers: &Value,
    specializers: &Value,
    lambda_list: &Value,
    takes_next: bool,
    documentation: &Value,
    function: Rc<Function>,
) -> Result<Value, Box<Raise>> {
    let specializers = specializers
        .iter_list()
        .map(|s| specializer(image, &s))
        .collect::<Result<_, _>>()?;
    let parameters = Parameters::parse(image, lambda_list)?;
    let method = define_method(
        image,
        MethodDefinition {
            name,
            qualifiers: qualifiers.iter_list().collect(),
            specializers,
            parameters,
            function,
            takes_next,
            accessor: None,
            doc: documentation.as_text().map(Into::into),
        },
    )?;
    Ok(method_value(&method))
}

/// `(defgeneric name lambda-list options… methods…)`.
pub(crate) fn expand_defgeneric(image: &mut Image, whole: &Value) -> Result<Value, Box<Raise>> {
    let parts = whole.list_to_vec().unwrap_or_default();
    let [_, name, lambda_list, options @ ..] = parts.as_slice() else {
        return Err(Raise::program(
            "DEFGENERIC takes a name, a lambda list and options.",
        ));
    };
    let mut doc = Value::NIL;
    let mut combination = Value::list([known::STANDARD.into()]);
    let mut methods = Vec::new();
    let mut order = Value::NIL;
    let mut ignored = Vec::new();
    for option in options {
        let rest = option.cdr_or_nil();
        match option.car_or_nil().as_symbol() {
            Some(known::K_DOCUMENTATION) if doc.is_true() => {
                return Err(Raise::program(
                    "The :DOCUMENTATION of a generic function is given twice.",
                ));
            }
            Some(known::K_DOCUMENTATION) => doc = rest.car_or_nil(),
            Some(known::K_METHOD_COMBINATION) => combination = rest,
            Some(known::K_METHOD) => methods.push(form![
                known::SYS_OWN_METHOD,
                form![known::DEFMETHOD, name.clone(); rest],
            ]),
            Some(known::K_ARGUMENT_PRECEDENCE_ORDER) => order = rest,
            Some(known::DECLARE) => {}
            Some(known::K_GENERIC_FUNCTION_CLASS)
                if rest.car_or_nil().as_symbol() == Some(known::STANDARD_GENERIC_FUNCTION) => {}
            Some(known::K_METHOD_CLASS)
                if rest.car_or_nil().as_symbol() == Some(known::STANDARD_METHOD) => {}
            Some(known::K_GENERIC_FUNCTION_CLASS | known::K_METHOD_CLASS) => {
                ignored.push(super::warning_of_ignored(image, option));
            }
            _ => {
                return Err(Raise::program(format!(
                    "Invalid option {} of DEFGENERIC.",
                    super::text(image, option)
                )));
            }
        }
    }
    // A combination of the program is adapted to the generic function.
    let combination = if super::combination::is_builtin(&combination.car_or_nil()) {
        quote(combination)
    } else {
        form![
            known::SYS_COMBINATION_FOR,
            quote(combination),
            quote(name.clone()),
            quote(lambda_list.clone()),
        ]
    };
    let ensure = form![
        known::SYS_ENSURE_GENERIC,
        quote(name.clone()),
        quote(lambda_list.clone()),
        combination,
        doc,
        quote(order),
        Value::NIL,
    ];
    if methods.is_empty() && ignored.is_empty() {
        return Ok(ensure);
    }
    ignored.extend(methods);
    Ok(form![known::PROG1, ensure; Value::list(ignored)])
}

/// Defines a generic function as DEFGENERIC describes it.
#[builtin("%ENSURE-GENERIC")]
pub(crate) fn ensure_generic_function(
    image: &mut Image,
    name: &Value,
    lambda_list: &Value,
    combination: &Value,
    documentation: &Value,
    precedence: &Value,
    keeps_methods: bool,
) -> Result<Value, Box<Raise>> {
    let parameters = Parameters::parse(image, lambda_list)?;
    let found = combination_named(image, &combination.car_or_nil())?;
    let precedence = precedence_order(image, lambda_list, precedence, parameters.required)?;
    let function = ensure_generic(image, name, &parameters)?;
    if let Some(generic) = function.as_generic() {
        let own = if keeps_methods {
            Vec::new()
        } else {
            generic.own_methods.take()
        };
        generic
            .methods
            .borrow_mut()
            .retain(|m| !own.iter().any(|o| Rc::ptr_eq(o, m)));
        if let Some(method) = generic.methods.borrow().first()
            && (method.parameters.required, method.parameters.optional)
                != (parameters.required, parameters.optional)
            && !method.is_builtin
        {
            return Err(Raise::program(format!(
                "The lambda list {} does not agree with the methods of {}.",
                super::text(image, lambda_list),
                super::text(image, &Value::Function(function.clone()))
            )));
        }
        *generic.parameters.borrow_mut() = parameters;
        generic.is_declared.set(true);
        *generic.precedence.borrow_mut() = precedence;
        if !keeps_methods {
            generic.combination.set(found);
            let order = combination.cdr_or_nil().car_or_nil().as_symbol();
            generic
                .most_specific_last
                .set(order == Some(known::K_MOST_SPECIFIC_LAST));
        }
        if let Some(text) = documentation.as_text() {
            *generic.doc.borrow_mut() = Some(text.into());
        }
        changed(generic);
    }
    Ok(Value::Function(function))
}

/// The order of required parameters that an option names, as indices; none for their own order.
fn precedence_order(
    image: &Image,
    lambda_list: &Value,
    order: &Value,
    required: usize,
) -> Result<Vec<usize>, Box<Raise>> {
    if order.is_nil() {
        return Ok(Vec::new());
    }
    let names: Vec<Value> = lambda_list.iter_list().take(required).collect();
    let place = |name: Value| names.iter().position(|n| n.is_eql(&name));
    let indices: Option<Vec<usize>> = order.iter_list().map(place).collect();
    indices
        .filter(|indices| {
            let mut sorted = indices.clone();
            sorted.sort_unstable();
            sorted.into_iter().eq(0..required)
        })
        .ok_or_else(|| {
            Raise::program(format!(
                "The order {} does not name each of the required parameters {} once.",
                super::text(image, order),
                super::text(image, &Value::list(names.clone()))
            ))
        })
}

/// Notes that a method was made by a DEFGENERIC.
#[builtin("%OWN-METHOD")]
pub(crate) fn own_method(image: &mut Image, method: &Value) {
    if let Some(object) = method.as_foreign::<MethodObject>()
        && let Some(function) = image.named_function(&object.0.name)
        && let Some(generic) = function.as_generic()
    {
        generic.own_methods.borrow_mut().push(object.0.clone());
    }
}
