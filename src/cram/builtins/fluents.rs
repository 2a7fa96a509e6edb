//! Fluents: creating, reading, setting, waiting, callbacks.

use super::arithmetic::Seconds;
use crate::Result;
use crate::fluent::{self, FluentRef};
use crate::request::Request;
use crate::state::Plan;
use crate::task::TaskRef;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::print;
use lisp::typed::FromValue;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::equality;
use lisp::value::known;
use lisp::value::raise::Raise;
use lisp::vm::callable::builtin_name;
use lisp::vm::calls::run;
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

/// The value of a fluent; anything else is its own value. It can be set with SETF.
///
/// `(let ((f (cpl:make-fluent :value 1))) (incf (cpl:value f)) (cpl:value f))` => `2`
/// `(cpl:value 5)` => `5`
#[builtin("VALUE")]
fn value_builtin(machine: &mut Machine<'_>, fluent: &Value) -> Result<Step> {
    value(machine, fluent, false)
}

/// The value of a fluent without taking notice of a pulse.
///
/// `(let* ((f (cpl:make-fluent)) (p (cpl:pulsed f))) (cpl:pulse f) (list (cpl:peek-value p) (cpl:value p) (cpl:value p)))` => `(T T NIL)`
#[builtin]
fn peek_value(machine: &mut Machine<'_>, fluent: &Value) -> Result<Step> {
    value(machine, fluent, true)
}

/// Wakes those who wait for pulses of the fluent; its value stays.
///
/// `(cpl:pulse (cpl:make-fluent))` => `NIL`
#[builtin]
fn pulse(machine: &mut Machine<'_>, fluent: FluentRef) -> Result<Step> {
    fluent::pulse(machine, &fluent)
}

/// Forgets the callback of that name; was there one?
///
/// `(cpl:remove-update-callback (cpl:make-fluent) 'see)` => `NIL`
#[builtin]
fn remove_update_callback(fluent: FluentRef, name: &Value) -> bool {
    fluent.get().remove_callback(name)
}

/// The callback of that name, or NIL.
///
/// `(cpl:get-update-callback (cpl:make-fluent) 'see)` => `NIL`
#[builtin]
fn get_update_callback(fluent: FluentRef, name: &Value) -> Option<Value> {
    fluent.get().callback(name)
}

/// A fluent that holds a value; TEST (EQL) tells whether a new value is a change.
///
/// `(cpl:make-fluent :name 'door :value :open)` => `#<FLUENT DOOR [:OPEN]>`
#[builtin(_, "&key name value test")]
fn make_fluent(
    image: &mut Image,
    #[key] name: Option<Value>,
    #[key] value: Option<Value>,
    #[key] test: Option<Value>,
    #[key] _allow_tracing: Option<&Value>,
    #[key] _max_tracing_freq: Option<&Value>,
    #[key] _class: Option<&Value>,
    #[key] _pulse_count: Option<&Value>,
) -> Value {
    let value = value.unwrap_or(Value::NIL);
    let test = test.unwrap_or(Value::NIL);
    FluentRef::value_fluent(&Plan::of(image), name, value, test).value()
}

fn value(machine: &mut Machine<'_>, fluent: &Value, peek: bool) -> Result<Step> {
    match FluentRef::from_value(fluent) {
        Some(fluent) => fluent::read(machine, &fluent, peek),
        None => Ok(Step::Return(fluent.clone())),
    }
}

impl FromValue<'_> for FluentRef {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self> {
        let fluent = FluentRef::from_value(value);
        fluent.ok_or_else(|| Raise::type_error(value, Plan::of(image).names.fluent))
    }
}

/// Stores a value in a fluent.
#[builtin("VALUE", "new-value fluent")]
fn set_value(machine: &mut Machine<'_>, new_value: Value, fluent_value: Value) -> Result<Step> {
    let new = new_value;
    let fluent = FluentRef::from_value(&fluent_value).filter(|f| f.get().is_settable());
    let Some(fluent) = fluent else {
        let expected = Plan::of(machine.image).names.value_fluent;
        return Err(Raise::type_error(&fluent_value, expected));
    };
    let old = fluent.get().known_value().unwrap_or(Value::NIL);
    let test = fluent.get().test();
    let same = match builtin_name(&test) {
        _ if test.is_nil() => old.is_eql(&new),
        Some(known::EQL) => old.is_eql(&new),
        Some(known::EQ) => old.is_eq(&new),
        Some(known::EQUAL) => equality::equal(&old, &new),
        Some(known::EQUALP) => equality::equalp(&old, &new),
        _ => {
            return run(machine, "VALUE", |calls| async move {
                if calls.call2(&test, old, new.clone()).await.is_true() {
                    return Ok(Step::Return(new));
                }
                calls
                    .with(move |machine| fluent::store(machine, &fluent, new))
                    .await
            });
        }
    };
    if same {
        return Ok(Step::Return(new));
    }
    fluent::store(machine, &fluent, new)
}

/// Waits until the fluent's value is not NIL and returns it; NIL after so many simulated seconds.
///
/// `(cpl:wait-for (cpl:make-fluent :value 7))` => `7`
/// `(cpl:wait-for (cpl:make-fluent) :timeout 10)` => `NIL`
#[builtin(_, "fluent &key timeout")]
fn wait_for(
    machine: &mut Machine<'_>,
    fluent: &Value,
    #[key] timeout: Option<&Value>,
    #[key] _wait_status: Option<&Value>,
) -> Result<Step> {
    let Some(source) = FluentRef::from_value(fluent) else {
        if fluent.is_nil() {
            return Err(Raise::simple("wait-for called with nil argument."));
        }
        return Ok(Step::Return(fluent.clone()));
    };
    let until = match timeout {
        Some(timeout) if timeout.is_true() => {
            // A timeout of zero or less has already expired.
            let seconds = if is_negative(timeout) {
                0.0
            } else {
                Seconds::from_value(machine.image, timeout)?.0
            };
            Some(Plan::of(machine.image).after(seconds)?)
        }
        _ => None,
    };
    wait_until_true(machine, source, until)
}

fn is_negative(value: &Value) -> bool {
    lisp::value::number::to_f64(value).is_some_and(|x| x < 0.0)
}

/// Waits until the fluent's value is not `NIL`, or until a time.
fn wait_until_true(
    machine: &mut Machine<'_>,
    fluent: FluentRef,
    until: Option<f64>,
) -> Result<Step> {
    run(machine, "WAIT-FOR", |calls| async move {
        loop {
            let value = fluent::value(&calls, &fluent).await?;
            if value.is_true() {
                return Ok(value);
            }
            if let Some(until) = until
                && until <= calls.with(|machine| Plan::of(machine.image).now()).await
            {
                return Ok(Value::NIL);
            }
            let fluent = fluent.clone();
            calls.request(Request::Wait { fluent, until }).await;
        }
    })
}

/// Calls the function with the value at each change and pulse of the fluent.
///
/// `(let ((f (cpl:make-fluent)) (seen nil)) (cpl:register-update-callback f 'see (lambda (v) (push v seen))) (setf (cpl:value f) 1) seen)` => `(1)`
#[builtin("REGISTER-UPDATE-CALLBACK")]
fn register_callback(
    machine: &mut Machine<'_>,
    fluent: FluentRef,
    name: Value,
    function: Value,
) -> Result<Step> {
    run(machine, "VALUE", |calls| async move {
        // Changes of a network are relative to its present value.
        fluent::value(&calls, &fluent).await?;
        if fluent.add_callback(&name, &function) {
            return Ok(function.clone());
        }
        let name = calls.with(move |machine| print::to_string(machine.image, &name, false));
        Err(Raise::simple(format!(
            "Callback with name {} is already registered.",
            name.await
        )))
    })
}

/// The name of a fluent, a task or a policy.
///
/// `(cpl-impl:name (cpl:make-fluent :name 'door))` => `DOOR`
#[builtin]
fn name(image: &mut Image, object: &Value) -> Result<Value> {
    if let Some(fluent) = FluentRef::from_value(object) {
        return Ok(match fluent.get().given_name() {
            Some(name) => name,
            None => {
                let name = fluent.get().name(image);
                image.symbols.make_passing(name.into())
            }
        });
    }
    if let Some(task) = TaskRef::from_value(object) {
        return Ok(Value::string(task.get().name.to_string()));
    }
    if let Some(name) = super::policies::policy_name(object) {
        return Ok(name);
    }
    Err(Raise::type_error(object, Plan::of(image).names.fluent))
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_fluent,
    value_builtin,
    peek_value,
    pulse,
    wait_for,
    register_callback,
    remove_update_callback,
    get_update_callback,
    name,
];

/// Places.
pub(crate) static SETTERS: &[Builtin] = builtins![set_value,];
