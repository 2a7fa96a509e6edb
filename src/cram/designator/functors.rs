//! The Prolog functors that query designators.

use super::check;
use super::value;
use crate::prolog::functor::{Call, Functor, functor};
use crate::prolog::goal::Action;
use crate::prolog::term::Variable;
use lisp::value::Value;
use lisp::value::equality;
use lisp::value::raise::Raise;

/// The functors.
pub(crate) static TABLE: &[Functor] = &[
    functor(
        "PROPERTY",
        "designator property",
        "The designator has the property (key value), whose value is of the type that the key takes.",
        |call| property(call, true),
    ),
    functor(
        "PROPERTY-MEMBER",
        "designator property",
        "Like PROPERTY.",
        |call| property(call, true),
    ),
    functor(
        "DESIG-PROP",
        "designator property",
        "The designator has the property (key value).",
        |call| property(call, false),
    ),
    functor(
        "CURRENT-DESIGNATOR",
        "designator newest",
        "The newest designator that is equated with this one.",
        |call| {
            let newest = value::current(&call.bindings.walk(&call.arg(0)));
            let wanted = call.arg(1);
            Ok(call.unify(&wanted, &newest))
        },
    ),
];

fn property(call: Call<'_>, is_checked: bool) -> Result<Action, Box<Raise>> {
    let designator = call.bindings.walk(&call.arg(0));
    let Some(designator) = value::as_designator(&designator) else {
        return Ok(Action::Fail);
    };
    let property = call.bindings.walk(&call.arg(1));
    let wanted = call.bindings.walk(&property.car_or_nil());
    let is_open = wanted.as_foreign::<Variable>().is_some();
    let mut items = Vec::new();
    for (key, values) in designator.properties() {
        let is_wanted = is_open || key.is_eql(&wanted) || equality::equal(&key, &wanted);
        if !is_wanted {
            continue;
        }
        if is_checked && let Some(name) = key.as_symbol().map(|s| call.image.name(s).to_owned()) {
            check::check_property(call.image, designator, &name, &values.car_or_nil())?;
        }
        items.push(Value::cons(key, values));
    }
    Ok(Action::Items(property, items))
}
