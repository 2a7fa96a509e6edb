//! The functors that the language itself knows.

use super::engine::{Action, Collection, Engine, Goal, Result};
use super::term::Variable;
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::lisp::value::equality;
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::package::PackageTable;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::plan::designator::check;
use crate::plan::designator::value;

/// What a goal with this functor asks for; `None` if the functor is not known.
/// `clause` is where `!` cuts to.
pub(crate) fn apply(
    engine: &mut Engine,
    image: &mut Image,
    functor: Sym,
    args: &Value,
    clause: usize,
) -> Result<Option<Action>> {
    let goals: Vec<Value> = args.iter_list().collect();
    let barrier = engine.choice_count();
    let prove = |goal: &Value| Goal::Prove(goal.clone());
    let name = image.name(functor).to_owned();
    let action = match (name.as_str(), goals.as_slice()) {
        ("AND", goals) => Action::Then(goals.iter().map(prove).collect()),
        ("OR", []) => Action::Fail,
        ("OR", [first, rest @ ..]) => {
            if rest.is_empty() {
                return Ok(Some(Action::Then(vec![prove(first)])));
            }
            let others = Value::list_with_tail([functor.into()], Value::list(rest.to_vec()));
            Action::Either(vec![prove(first)], vec![Goal::Prove(others)])
        }
        ("NOT", [goal]) => Action::Either(
            vec![prove(goal), Goal::Cut(barrier), Goal::Fail],
            Vec::new(),
        ),
        ("->", [condition, then, otherwise @ ..]) => Action::Either(
            vec![prove(condition), Goal::Cut(barrier), prove(then)],
            otherwise
                .first()
                .map_or(vec![Goal::Fail], |e| vec![prove(e)]),
        ),
        ("*->", [condition, then, otherwise @ ..]) => {
            let number = engine.next_number();
            Action::Either(
                vec![prove(condition), Goal::Forget(number), prove(then)],
                otherwise
                    .first()
                    .map_or(vec![Goal::Fail], |e| vec![prove(e)]),
            )
        }
        ("!", []) => Action::Then(vec![Goal::Cut(clause)]),
        ("TRUE", []) => Action::Succeed,
        // Nothing is projected: what runs is the simulation itself.
        ("FAIL", []) | ("PROJECTION-RUNNING", [_]) => Action::Fail,
        ("CALL", [goal]) => Action::Then(vec![prove(goal)]),
        ("CALL", [functor, more @ ..]) => {
            let goal = Value::list_with_tail([functor.clone()], Value::list(more.to_vec()));
            Action::Then(vec![Goal::Prove(goal)])
        }
        ("ONCE", goals) => {
            let mut steps: Vec<Goal> = goals.iter().map(prove).collect();
            steps.push(Goal::Cut(barrier));
            Action::Then(steps)
        }
        ("FORALL", [condition, action]) => {
            let not_action = Value::list([known::NOT.into(), action.clone()]);
            let both = Value::list([known::AND.into(), condition.clone(), not_action]);
            Action::Either(
                vec![Goal::Prove(both), Goal::Cut(barrier), Goal::Fail],
                Vec::new(),
            )
        }
        ("FINDALL", [template, goal, result]) => collect(template, goal, result, Collection::All),
        ("BAGOF", [template, goal, result]) => collect(template, goal, result, Collection::Some),
        ("SETOF", [template, goal, result]) => {
            collect(template, goal, result, Collection::Distinct)
        }
        ("==" | "EQUAL", [a, b]) => holds(engine.bindings.unify(a, b)),
        ("BOUND", [term]) => holds(
            engine
                .bindings
                .walk(term)
                .as_foreign::<Variable>()
                .is_none(),
        ),
        ("GROUND", [term]) => holds(engine.bindings.is_ground(term)?),
        ("MEMBER", [item, list]) => {
            let list = engine.bindings.resolve(list)?;
            Action::Items(item.clone(), list.iter_list().collect())
        }
        ("LENGTH", [list, length]) => {
            let count = engine.bindings.resolve(list)?.iter_list().count();
            holds(engine.bindings.unify(length, &Value::from(count)))
        }
        ("APPEND", [first, second, both]) => append(engine, first, second, both)?,
        ("MAX", [list, result]) => {
            let list = engine.bindings.resolve(list)?;
            let greatest = greatest(list.iter_list())?;
            holds(greatest.is_some_and(|g| engine.bindings.unify(result, &g)))
        }
        ("SORT", [list, predicate, result]) => Action::CallFor {
            function: image.intern(PackageTable::CL, "SORT").into(),
            args: vec![
                Value::list(
                    engine
                        .bindings
                        .resolve(list)?
                        .iter_list()
                        .collect::<Vec<_>>(),
                ),
                function(engine, predicate)?,
            ],
            result: result.clone(),
        },
        ("REDUCE", [reducer, list, result]) => Action::CallFor {
            function: image.intern(PackageTable::CL, "REDUCE").into(),
            args: vec![function(engine, reducer)?, engine.shown(list)?],
            result: result.clone(),
        },
        ("LISP-FUN", [callee, args @ .., result]) => Action::CallFor {
            function: function(engine, callee)?,
            args: shown(engine, args)?,
            result: result.clone(),
        },
        ("LISP-PRED", [callee, args @ ..]) => Action::CallTest {
            function: function(engine, callee)?,
            args: shown(engine, args)?,
        },
        ("LISP-TYPE" | "INSTANCE-OF" | "ASSERT-TYPE", [a, b, ..]) => {
            let (object, kind) = if name == "INSTANCE-OF" {
                (b, a)
            } else {
                (a, b)
            };
            Action::CallTest {
                function: known::TYPEP.into(),
                args: vec![engine.shown(object)?, engine.shown(kind)?],
            }
        }
        ("SYMBOL-VALUE", [symbol, result]) => Action::CallFor {
            function: known::SYMBOL_VALUE.into(),
            args: vec![engine.shown(symbol)?],
            result: result.clone(),
        },
        ("SLOT-VALUE", [object, slot, result]) => Action::CallFor {
            function: known::SLOT_VALUE.into(),
            args: vec![engine.shown(object)?, engine.shown(slot)?],
            result: result.clone(),
        },
        ("GENERATE-VALUES", [result, callee, args @ ..]) => Action::CallItems {
            function: function(engine, callee)?,
            args: shown(engine, args)?,
            term: result.clone(),
        },
        ("FORMAT", args) => {
            let mut all = vec![Value::T];
            all.extend(shown(engine, args)?);
            Action::CallOnly {
                function: known::FORMAT.into(),
                args: all,
            }
        }
        ("WARN" | "ERROR", args) => Action::CallOnly {
            function: if name == "WARN" {
                known::WARN
            } else {
                known::ERROR
            }
            .into(),
            args: shown(engine, args)?,
        },
        ("PROPERTY" | "PROPERTY-MEMBER" | "DESIG-PROP", [designator, property]) => {
            let is_checked = name != "DESIG-PROP";
            designator_property(engine, image, designator, property, is_checked)?
        }
        ("CURRENT-DESIGNATOR", [designator, current]) => {
            let newest = value::current(&engine.bindings.walk(designator));
            holds(engine.bindings.unify(current, &newest))
        }
        _ => return handler(engine, image, functor, &goals),
    };
    Ok(Some(action))
}

fn holds(is_so: bool) -> Action {
    if is_so { Action::Succeed } else { Action::Fail }
}

fn collect(template: &Value, goal: &Value, result: &Value, kind: Collection) -> Action {
    Action::Collect {
        template: template.clone(),
        goal: goal.clone(),
        result: result.clone(),
        kind,
    }
}

fn shown(engine: &Engine, terms: &[Value]) -> Result<Vec<Value>> {
    terms.iter().map(|t| engine.shown(t)).collect()
}

/// A function as goals write it: a symbol, `#'symbol`, or a function.
fn function(engine: &Engine, term: &Value) -> Result<Value> {
    let term = engine.shown(term)?;
    let is_quoted = matches!(
        term.car_or_nil().as_symbol(),
        Some(known::FUNCTION | known::QUOTE)
    );
    Ok(if is_quoted {
        term.cdr_or_nil().car_or_nil()
    } else {
        term
    })
}

fn greatest(items: impl Iterator<Item = Value>) -> Result<Option<Value>> {
    let mut best: Option<Value> = None;
    for item in items {
        best = Some(match best {
            Some(best) => number::maximum(&best, &item)?,
            None => item,
        });
    }
    Ok(best)
}

/// Joins two lists, or splits one in all ways.
fn append(engine: &mut Engine, first: &Value, second: &Value, both: &Value) -> Result<Action> {
    if let Some(items) = engine.bindings.resolve(first)?.list_to_vec() {
        let joined = Value::list_with_tail(items, second.clone());
        return Ok(holds(engine.bindings.unify(both, &joined)));
    }
    let Some(items) = engine.bindings.resolve(both)?.list_to_vec() else {
        return Ok(Action::Fail);
    };
    let splits = (0..=items.len())
        .map(|i| {
            let (head, tail) = items.split_at(i);
            Value::list([Value::list(head.to_vec()), Value::list(tail.to_vec())])
        })
        .collect();
    let pattern = Value::list([first.clone(), second.clone()]);
    Ok(Action::Items(pattern, splits))
}

/// `(property ?designator (:key ?value))`.
fn designator_property(
    engine: &Engine,
    image: &mut Image,
    designator: &Value,
    property: &Value,
    is_checked: bool,
) -> Result<Action> {
    let designator = engine.bindings.walk(designator);
    let Some(designator) = value::as_designator(&designator) else {
        return Ok(Action::Fail);
    };
    let property = engine.bindings.walk(property);
    let wanted = engine.bindings.walk(&property.car_or_nil());
    let is_open = wanted.as_foreign::<Variable>().is_some();
    let mut items = Vec::new();
    for (key, values) in designator.properties() {
        let is_wanted = is_open || key.is_eql(&wanted) || equality::equal(&key, &wanted);
        if !is_wanted {
            continue;
        }
        if is_checked && let Some(name) = key.as_symbol().map(|s| image.name(s).to_owned()) {
            check::check_property(image, designator, &name, &values.car_or_nil())?;
        }
        items.push(Value::cons(key, values));
    }
    Ok(Action::Items(property, items))
}

/// A functor of `def-prolog-handler`.
fn handler(
    engine: &mut Engine,
    image: &mut Image,
    functor: Sym,
    goals: &[Value],
) -> Result<Option<Action>> {
    let Some(function) = crate::plan::prolog::facts::of(image).handler(functor) else {
        let known = [
            "NOT",
            "->",
            "*->",
            "!",
            "TRUE",
            "FAIL",
            "CALL",
            "FORALL",
            "FINDALL",
            "BAGOF",
            "SETOF",
            "==",
            "EQUAL",
            "BOUND",
            "GROUND",
            "MEMBER",
            "LENGTH",
            "APPEND",
            "MAX",
            "SORT",
            "REDUCE",
            "LISP-FUN",
            "LISP-TYPE",
            "INSTANCE-OF",
            "ASSERT-TYPE",
            "SYMBOL-VALUE",
            "SLOT-VALUE",
            "PROPERTY",
            "DESIG-PROP",
            "CURRENT-DESIGNATOR",
        ];
        let name = image.name(functor);
        if known.contains(&name) {
            return Err(Raise::simple(format!(
                "The Prolog goal {} does not take {} argument{}.",
                print::to_string(image, &functor.into(), true),
                goals.len(),
                if goals.len() == 1 { "" } else { "s" }
            )));
        }
        return Ok(None);
    };
    let mut args = vec![engine.solution()?];
    let mut variables = Vec::new();
    for goal in goals {
        let term = engine.bindings.resolve(goal)?;
        if term.as_foreign::<Variable>().is_some() {
            variables.push(term.clone());
        }
        args.push(engine.shown(&term)?);
    }
    Ok(Some(Action::CallBindings {
        function,
        args,
        variables,
    }))
}
