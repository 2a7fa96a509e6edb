//! Macros that the compiler translates itself, for speed, as if they were special operators. To programs
//! they are macros: `macroexpand` and programs that walk code see what they stand for.

use crate::image::Image;
use crate::print;
use crate::value::Value;
use crate::value::form::form;
use crate::value::known;
use crate::value::raise::Raise;

type Expansion = Result<Value, Box<Raise>>;

/// `(lambda …)` is `(function (lambda …))`.
pub(super) fn lambda(_: &mut Image, form: &Value) -> Expansion {
    Ok(form![known::FUNCTION, form.clone()])
}

/// `(and first rest…)`: the rest if the first is true.
pub(super) fn and(_: &mut Image, form: &Value) -> Expansion {
    let args = form.cdr_or_nil();
    let (first, rest) = (args.car_or_nil(), args.cdr_or_nil());
    Ok(match (args.is_nil(), rest.is_nil()) {
        (true, _) => Value::T,
        (_, true) => first,
        _ => form![known::IF, first, form![known::AND; rest]],
    })
}

/// `(or first rest…)`: the value of the first if it is true, else the rest.
pub(super) fn or(image: &mut Image, form: &Value) -> Expansion {
    let args = form.cdr_or_nil();
    let (first, rest) = (args.car_or_nil(), args.cdr_or_nil());
    if rest.is_nil() {
        return Ok(first);
    }
    let value = image.gensym("VALUE");
    let test = form![
        known::IF,
        value.clone(),
        value.clone(),
        form![known::OR; rest]
    ];
    Ok(form![known::LET, form![form![value, first]], test])
}

/// `(prog1 first rest…)`: the value of the first, kept in a variable.
pub(super) fn prog1(image: &mut Image, form: &Value) -> Expansion {
    let args = form.cdr_or_nil();
    if args.is_nil() {
        return Err(Raise::program("PROG1 takes a form whose value it returns."));
    }
    let value = image.gensym("VALUE");
    let binding = form![form![value.clone(), args.car_or_nil()]];
    let rest = args.cdr_or_nil();
    Ok(form![
        known::LET,
        binding,
        Value::cons(known::PROGN.into(), rest),
        value
    ])
}

/// `(multiple-value-bind variables form body…)`: a call of a function with these parameters.
pub(super) fn multiple_value_bind(image: &mut Image, form: &Value) -> Expansion {
    let args = form.cdr_or_nil();
    let (variables, rest) = (args.car_or_nil(), args.cdr_or_nil());
    let names = variables.iter_list().filter_map(|name| name.as_symbol());
    if let Some(name) = super::lambda_list::repeated(names) {
        return Err(Raise::program(format!(
            "The variable {} occurs more than once in the MULTIPLE-VALUE-BIND.",
            print::to_string(image, &name.into(), true)
        )));
    }
    let others = image.gensym("OTHERS");
    let mut parameters = vec![known::L_OPTIONAL.into()];
    parameters.extend(variables.iter_list());
    parameters.extend([known::L_REST.into(), others.clone()]);
    let unused = form![known::DECLARE, form![known::IGNORE, others]];
    let lambda = form![known::LAMBDA, Value::list(parameters), unused; rest.cdr_or_nil()];
    let function = form![known::FUNCTION, lambda];
    Ok(form![
        known::MULTIPLE_VALUE_CALL,
        function,
        rest.car_or_nil()
    ])
}

/// `(handler-bind bindings body…)`: a call with a function of the body, types and handlers.
pub(super) fn handler_bind(image: &mut Image, form: &Value) -> Expansion {
    let args = form.cdr_or_nil();
    let mut call = vec![
        known::SYS_CALL_WITH_HANDLERS.into(),
        thunk(args.cdr_or_nil()),
    ];
    for binding in args.car_or_nil().iter_list() {
        check_binding(image, &binding)?;
        call.push(form![known::QUOTE, binding.car_or_nil()]);
        call.push(binding.cdr_or_nil().car_or_nil());
    }
    Ok(Value::list(call))
}

/// Signals an error unless this is a binding of `handler-bind`.
pub(super) fn check_binding(image: &Image, binding: &Value) -> Result<(), Box<Raise>> {
    if binding.list_to_vec().is_some_and(|parts| parts.len() == 2) {
        return Ok(());
    }
    let hint = match binding {
        Value::Cons(_) => "",
        _ => "; a pair of parentheses is missing around it",
    };
    Err(Raise::program(format!(
        "{} is not a binding of HANDLER-BIND: (type function) was expected{hint}.",
        print::to_string(image, binding, true)
    )))
}

/// `(with-restarts list body…)`: a call with the list and a function of the body.
pub(super) fn with_restarts(_: &mut Image, form: &Value) -> Expansion {
    let args = form.cdr_or_nil();
    let body = thunk(args.cdr_or_nil());
    Ok(form![
        known::SYS_CALL_WITH_RESTARTS,
        args.car_or_nil(),
        body
    ])
}

/// The form of a function without parameters.
fn thunk(body: Value) -> Value {
    form![
        known::FUNCTION,
        form![known::LAMBDA, Value::NIL, form![known::LOCALLY; body]]
    ]
}
