//! Evaluation and calls: `eval`, `funcall`, `apply`, `values`, macro expansion.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::compile::{self, is_executed};
use crate::guard::{descend, look_patiently};
use crate::image::Image;
use crate::image::locks::Meaning;
use crate::image::warnings::Warning;
use crate::source::Place;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::{FunctionCell, Sym};
use crate::vm::calls::{Args, Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The object.
///
/// `(identity 1)` => `1`
#[builtin]
fn identity(object: Value) -> Result<Value> {
    Ok(object)
}

/// T if the object is NIL.
///
/// `(not nil)` => `T`
#[builtin]
fn not(object: &Value) -> Result<Value> {
    Ok(object.is_nil().into())
}

/// Are they the same object?
///
/// `(eq 'a 'a)` => `T`
#[builtin]
fn eq(a: &Value, b: &Value) -> Result<Value> {
    Ok(a.is_eq(b).into())
}

/// Are they the same object, or equal numbers of one type?
///
/// `(eql 1 1.0)` => `NIL`
#[builtin]
fn eql(a: &Value, b: &Value) -> Result<Value> {
    Ok(a.is_eql(b).into())
}

/// Have they the same structure and contents?
///
/// `(equal '(1 "a") '(1 "a"))` => `T`
#[builtin]
fn equal(a: &Value, b: &Value) -> Result<Value> {
    Ok(crate::value::equality::equal(a, b).into())
}

/// Like EQUAL; numbers by value, letters without case, arrays by element.
///
/// `(equalp "A" "a")` => `T`
#[builtin]
fn equalp(a: &Value, b: &Value) -> Result<Value> {
    Ok(crate::value::equality::equalp(a, b).into())
}

/// Is it a function?
///
/// `(functionp #'car)` => `T`
#[builtin]
fn functionp(object: &Value) -> Result<Value> {
    Ok(matches!(object, Value::Function(_)).into())
}

/// Evaluates forms one after the other, so that each sees what the ones before defined; they are judged
/// if that is wanted.
fn evaluate_sequence(machine: &mut Machine<'_>, forms: Value, is_judged: bool) -> Result<Step> {
    let mut forms: Vec<Value> = forms.iter_list().collect();
    let Some(last) = forms.pop() else {
        return Ok(Step::Return(Value::NIL));
    };
    if forms.is_empty() {
        return evaluate_form(machine, &last, is_judged);
    }
    run(machine, "EVAL", |calls| async move {
        for form in forms {
            calls
                .with(move |machine| machine.image.want_warnings(is_judged))
                .await;
            calls.call1(&known::EVAL.into(), form).await;
        }
        calls
            .with(move |machine| evaluate_form(machine, &last, is_judged))
            .await
    })
}

/// A form at top level as it is evaluated: no macro call, and no definition that has to ask or to tell
/// first.
fn expanded(image: &mut Image, form: &Value) -> Result<Value> {
    let mut form = form.clone();
    loop {
        look_patiently();
        let place = match &form {
            Value::Cons(cons) => cons.place(),
            _ => Place::NONE,
        };
        if let Some(guarded) = compile::guarded_definition(image, &form, place) {
            return Ok(guarded);
        }
        match compile::macroexpand_1(image, &form)? {
            Some(expansion) => form = expansion,
            None => return Ok(form),
        }
    }
}

/// Evaluates a form at top level.
pub fn evaluate(machine: &mut Machine<'_>, form: &Value) -> Result<Step> {
    let is_judged = machine.image.take_wanted();
    evaluate_form(machine, form, is_judged)
}

fn evaluate_form(machine: &mut Machine<'_>, form: &Value, is_judged: bool) -> Result<Step> {
    descend()?;
    let form = expanded(machine.image, form)?;
    if let Value::Cons(cons) = &form {
        match cons.car().as_symbol() {
            Some(known::PROGN) => return evaluate_sequence(machine, cons.cdr(), is_judged),
            Some(known::EVAL_WHEN) => {
                let inner = Value::cons(known::PROGN.into(), cons.cdr().cdr_or_nil());
                if is_executed(machine.image, &cons.cdr().car_or_nil()) {
                    return evaluate_form(machine, &inner, is_judged);
                }
            }
            _ => {}
        }
    }
    let (code, warnings) = match is_judged {
        true => compile::compile_judged(machine.image, &form)?,
        false => (compile::compile_form(machine.image, &form)?, Vec::new()),
    };
    let function = Value::Function(Rc::new(Function::closure(code, Vec::new())));
    let start = Step::TailCall {
        function,
        args: Vec::new(),
    };
    if warnings.is_empty() {
        return Ok(start);
    }
    run(machine, "EVAL", |calls| async move {
        signal_warnings(&calls, warnings).await;
        Ok(start)
    })
}

/// Signals warnings, one after the other.
pub(super) async fn signal_warnings(calls: &Calls, warnings: Vec<Warning>) {
    for warning in warnings {
        let arguments = Args::Many(warning.arguments());
        calls.call(&known::WARN.into(), arguments).await;
    }
}

/// Evaluates a form.
///
/// `(eval '(+ 1 2))` => `3`
#[builtin]
fn eval(machine: &mut Machine<'_>, form: &Value) -> Result<Step> {
    evaluate(machine, form)
}

/// Calls a function.
///
/// `(funcall #'+ 1 2)` => `3`
#[builtin(_, "function &rest arguments")]
fn funcall(_: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let mut args = args.into_iter();
    let function = args.next().unwrap_or(Value::NIL);
    Ok(Step::TailCall {
        function,
        args: args.collect(),
    })
}

/// Calls a function; the last argument is a list of further arguments.
///
/// `(apply #'+ 1 '(2 3))` => `6`
#[builtin(_, "function argument &rest arguments")]
fn apply(_: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let mut args = args.into_iter();
    let function = args.next().unwrap_or(Value::NIL);
    let mut args: Vec<Value> = args.collect();
    let list = args.pop().unwrap_or(Value::NIL);
    match list.list_to_vec() {
        Some(more) => args.extend(more),
        None => return Err(Raise::type_error(&list, known::LIST)),
    }
    Ok(Step::TailCall { function, args })
}

/// Returns the values.
///
/// `(values 1 2)` => `1 ; 2`
#[builtin]
fn values(values: &[Value]) -> Result<Value> {
    Ok(Value::values(values.to_vec()))
}

/// Returns the elements of a list as values.
///
/// `(values-list '(1 2))` => `1 ; 2`
#[builtin]
fn values_list(list: &Value) -> Result<Value> {
    match list.list_to_vec() {
        Some(items) => Ok(Value::values(items)),
        None => {
            let mut items = list.iter_list();
            items.by_ref().for_each(drop);
            Err(Raise::type_error(&items.rest, known::LIST))
        }
    }
}

/// A function that always returns the value.
///
/// `(funcall (constantly 1) 2 3)` => `1`
#[builtin(_, "value")]
fn constantly(value_value: Value) -> Result<Value> {
    let constant = Function::pure_of(known::CONSTANTLY, (0, None), value_value, |value, _, _| {
        Ok(value.clone())
    });
    Ok(Value::Function(constant))
}

/// The function that is true when the function is false.
///
/// `(funcall (complement #'oddp) 2)` => `T`
#[builtin]
fn complement(function: Value) -> Result<Value> {
    let complement = Function::control_of(
        known::COMPLEMENT,
        (0, None),
        function,
        |function, machine, args| {
            let function = function.clone();
            run(machine, "COMPLEMENT", |calls| async move {
                let value = calls.call(&function, Args::Many(args)).await;
                Ok(Value::bool(value.is_nil()))
            })
        },
    );
    Ok(Value::Function(complement))
}

/// Expands a macro call until it is none; was it one?
///
/// `(macroexpand '(when a b))` => `(IF A B) ; T`
#[builtin]
fn macroexpand(image: &mut Image, form: &Value, environment: Option<&Value>) -> Result<Value> {
    let (form, expanded) =
        compile::macroexpand_in(image, form, environment.unwrap_or(&Value::NIL))?;
    Ok(Value::values(vec![form, expanded.into()]))
}

/// Expands a macro call once; was it one?
///
/// `(macroexpand-1 '(when a b))` => `(IF A B) ; T`
#[builtin]
fn macroexpand_1(image: &mut Image, form: &Value, environment: Option<&Value>) -> Result<Value> {
    let expansion = compile::macroexpand_1_in(image, form, environment.unwrap_or(&Value::NIL))?;
    let expanded = expansion.is_some();
    let form = expansion.unwrap_or_else(|| form.clone());
    Ok(Value::values(vec![form, expanded.into()]))
}

/// The function: everything is compiled. Was there any warning? Was there one that is not only about
/// style?
///
/// `(funcall (compile nil '(lambda (x) (* x x))) 3)` => `9`
#[builtin("COMPILE", "name &optional definition")]
fn compile_function(
    machine: &mut Machine<'_>,
    name: Value,
    definition: Option<Value>,
) -> Result<Step> {
    let image = &mut *machine.image;
    let Some(definition @ Value::Cons(_)) = definition else {
        return Ok(Step::Return(with_outcome(name, &[])));
    };
    let function_name = name.as_symbol().filter(|_| name.is_true());
    if let Some(name) = function_name {
        image.check_lock(name, Meaning::Function)?;
    }
    if let Value::Cons(lambda) = &definition {
        image.noted_form = lambda.place();
    }
    let (function, notes) = image.noting(|image| compile::compile_lambda(image, &definition));
    let function = function?;
    let compiled = match function_name {
        Some(sym) => {
            image.set_function(sym, function);
            name
        }
        None => Value::Function(function),
    };
    let warnings = image.judged(&notes);
    let values = with_outcome(compiled, &warnings);
    if warnings.is_empty() {
        return Ok(Step::Return(values));
    }
    run(machine, "COMPILE", |calls| async move {
        signal_warnings(&calls, warnings).await;
        Ok(values)
    })
}

/// The values of COMPILE.
fn with_outcome(compiled: Value, warnings: &[Warning]) -> Value {
    let fails = warnings.iter().any(|warning| !warning.is_style);
    Value::values(vec![
        compiled,
        Value::bool(!warnings.is_empty()),
        Value::bool(fails),
    ])
}

/// Does the symbol name a special operator?
///
/// `(special-operator-p 'if)` => `T`
#[builtin]
fn special_operator_p(image: &mut Image, symbol: &Value) -> Result<Value> {
    let Some(name) = symbol.as_symbol() else {
        return Err(Raise::type_error(symbol, known::SYMBOL));
    };
    // A declaration is no form.
    let is_special =
        name != known::DECLARE && image.operator(name).is_some_and(|o| o.expand.is_none());
    Ok(is_special.into())
}

/// The expander of a macro, or NIL.
///
/// `(macro-function 'car)` => `NIL`
#[builtin]
fn macro_function(image: &mut Image, symbol: Sym, environment: Option<&Value>) -> Result<Value> {
    if let Some(local) = environment.and_then(|scope| compile::local_macro(scope, symbol)) {
        return Ok(local);
    }
    Ok(match &image.symbol(symbol).function {
        FunctionCell::Macro(f) => Value::Function(f.clone()),
        FunctionCell::Builtin => match image.operator(symbol).and_then(|o| o.expand) {
            Some(expand) => {
                let function =
                    Function::pure_of(symbol, (2, Some(2)), (), move |(), image, args| {
                        let environment = args.get(1).cloned().unwrap_or(Value::NIL);
                        image.expand_with(expand, &args[0], environment)
                    });
                Value::Function(function)
            }
            None => Value::NIL,
        },
        _ => Value::NIL,
    })
}

/// NIL, T and the function's name.
///
/// `(function-lambda-expression #'car)` => `NIL ; T ; CAR`
#[builtin]
fn function_lambda_expression(function: &Value) -> Result<Value> {
    let Value::Function(function) = function else {
        return Err(Raise::type_error(function, known::FUNCTION));
    };
    let name = match &function.body {
        Body::Closure { code, .. } => code.name.value(),
        Body::Native(native) => native.name.into(),
        Body::Generic(generic) => generic.name.clone(),
        Body::Deferred(deferred) => deferred.name.into(),
    };
    Ok(Value::values(vec![Value::NIL, Value::T, name]))
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    eval,
    funcall,
    apply,
    values,
    values_list,
    identity,
    not,
    eq,
    eql,
    equal,
    equalp,
    constantly,
    complement,
    functionp,
    macroexpand,
    macroexpand_1,
    compile_function,
    special_operator_p,
    macro_function,
    function_lambda_expression,
];
