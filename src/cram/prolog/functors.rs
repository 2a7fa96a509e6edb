//! The functors of the language itself.

use super::functor::{Call, Functor, functor, holds};
use super::goal::{Action, Collection, Goal};
use super::term::Variable;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::number;
use lisp::value::package::PackageTable;
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The functors.
pub static TABLE: &[Functor] = &[
    functor("AND", "goal…", "All goals hold.", |call| {
        Ok(Action::Then(call.args.iter().map(prove).collect()))
    }),
    functor("OR", "goal…", "One of the goals holds; each is tried.", or),
    functor("NOT", "goal", "The goal cannot be proved.", |call| {
        let steps = vec![prove(&call.arg(0)), Goal::Cut(call.barrier), Goal::Fail];
        Ok(Action::Either(steps, Vec::new()))
    }),
    functor(
        "->",
        "condition then &optional else",
        "THEN holds for the first proof of the condition; ELSE holds if there is none.",
        |call| {
            let then = vec![
                prove(&call.arg(0)),
                Goal::Cut(call.barrier),
                prove(&call.arg(1)),
            ];
            Ok(Action::Either(then, otherwise(&call)))
        },
    ),
    functor(
        "*->",
        "condition then &optional else",
        "Like ->, for every proof of the condition.",
        |call| {
            let then = vec![
                prove(&call.arg(0)),
                Goal::Forget(call.next_choice),
                prove(&call.arg(1)),
            ];
            Ok(Action::Either(then, otherwise(&call)))
        },
    ),
    functor("!", "", "Holds; no other clauses are tried.", |call| {
        Ok(Action::Then(vec![Goal::Cut(call.clause)]))
    }),
    functor("CUT", "", "The same as `!`.", |call| {
        Ok(Action::Then(vec![Goal::Cut(call.clause)]))
    }),
    functor(
        "FILTER-BINDINGS",
        "variables goal…",
        "All goals hold; what they say of other variables than these is forgotten.",
        |call| {
            let kept = call.bindings.resolve(&call.arg(0))?;
            let kept: Vec<Value> = kept.iter_list().collect();
            let goals = Value::list(call.rest(1).to_vec());
            let goals = call.bindings.localized(&goals, &kept)?;
            Ok(Action::Then(goals.iter_list().map(Goal::Prove).collect()))
        },
    ),
    functor("TRUE", "", "Holds.", |_| Ok(Action::Succeed)),
    functor("FAIL", "", "Does not hold.", |_| Ok(Action::Fail)),
    // Everything runs in the simulation itself.
    functor(
        "PROJECTION-RUNNING",
        "environment",
        "Does not hold: nothing is projected.",
        |_| Ok(Action::Fail),
    ),
    functor(
        "CALL",
        "GOAL argument…",
        "The goal holds, or that of a functor and arguments.",
        |call| {
            let goal = match call.rest(1) {
                [] => call.arg(0),
                more => Value::list_with_tail([call.arg(0)], Value::list(more.to_vec())),
            };
            Ok(Action::Then(vec![Goal::Prove(goal)]))
        },
    ),
    functor(
        "ONCE",
        "goal…",
        "All goals hold; only their first proof counts.",
        |call| {
            let mut steps: Vec<Goal> = call.args.iter().map(prove).collect();
            steps.push(Goal::Cut(call.barrier));
            Ok(Action::Then(steps))
        },
    ),
    functor(
        "FORALL",
        "condition action",
        "The action holds for every proof of the condition.",
        |call| {
            let not_action = Value::list([known::NOT.into(), call.arg(1)]);
            let both = Value::list([known::AND.into(), call.arg(0), not_action]);
            let steps = vec![Goal::Prove(both), Goal::Cut(call.barrier), Goal::Fail];
            Ok(Action::Either(steps, Vec::new()))
        },
    ),
    functor(
        "FINDALL",
        "template goal list",
        "The list has the template for every proof of the goal.",
        |call| Ok(collect(&call, Collection::All)),
    ),
    functor(
        "BAGOF",
        "template goal list",
        "Like FINDALL; the goal has a proof.",
        |call| Ok(collect(&call, Collection::Some)),
    ),
    functor(
        "SETOF",
        "template goal list",
        "Like BAGOF; equal elements are kept once.",
        |call| Ok(collect(&call, Collection::Distinct)),
    ),
    functor("==", "a b", "Both terms are made equal.", unify),
    functor("EQUAL", "a b", "Both terms are made equal.", unify),
    functor("=", "A B", "Both numbers are equal.", |call| {
        compare(&call, number::number_equal)
    }),
    functor("<", "A B", "The first number is less.", |call| {
        compare(&call, number::less)
    }),
    functor(">", "A B", "The first number is greater.", |call| {
        compare(&call, number::greater)
    }),
    functor("<=", "A B", "The first number is not greater.", |call| {
        compare(&call, number::less_equal)
    }),
    functor(">=", "A B", "The first number is not less.", |call| {
        compare(&call, number::greater_equal)
    }),
    functor(
        "BOUND",
        "term",
        "The term is no unbound variable.",
        |call| {
            let term = call.bindings.walk(&call.arg(0));
            Ok(holds(term.as_foreign::<Variable>().is_none()))
        },
    ),
    functor(
        "GROUND",
        "term",
        "No unbound variable is in the term.",
        |call| Ok(holds(call.bindings.is_ground(&call.arg(0))?)),
    ),
    functor(
        "MEMBER",
        "item LIST",
        "The item is each element in turn.",
        |call| {
            let list = call.bindings.resolve(&call.arg(1))?;
            Ok(Action::Items(call.arg(0), list.iter_list().collect()))
        },
    ),
    functor(
        "LENGTH",
        "list length",
        "The list has so many elements.",
        |call| {
            let count = call.bindings.resolve(&call.arg(0))?.iter_list().count();
            let length = call.arg(1);
            Ok(call.unify(&length, &Value::from(count)))
        },
    ),
    functor(
        "APPEND",
        "first second both",
        "The third list is the first two joined, or split in all ways.",
        append,
    ),
    functor(
        "MAX",
        "LIST number",
        "The greatest number of the list.",
        |call| {
            let list = call.bindings.resolve(&call.arg(0))?;
            let result = call.arg(1);
            Ok(match greatest(list.iter_list())? {
                Some(greatest) => call.unify(&result, &greatest),
                None => Action::Fail,
            })
        },
    ),
    functor(
        "SORT",
        "LIST PREDICATE sorted",
        "The list in order.",
        |mut call| {
            let list = call.bindings.resolve(&call.arg(0))?;
            let items: Vec<Value> = list.iter_list().collect();
            let predicate = function(&call, &call.arg(1))?;
            Ok(call_for(
                &mut call,
                "SORT",
                vec![Value::list(items), predicate],
            ))
        },
    ),
    functor(
        "REDUCE",
        "FUNCTION LIST result",
        "What the function makes of the list.",
        |mut call| {
            let reducer = function(&call, &call.arg(0))?;
            let list = call.bindings.shown(&call.arg(1))?;
            Ok(call_for(&mut call, "REDUCE", vec![reducer, list]))
        },
    ),
    functor(
        "LISP-FUN",
        "FUNCTION argument… result",
        "The value of a Lisp function.",
        |call| {
            let (result, args) = match call.rest(1).split_last() {
                Some((result, args)) => (result.clone(), args),
                None => return Ok(Action::Fail),
            };
            Ok(Action::CallFor {
                function: function(&call, &call.arg(0))?,
                args: call.shown(args)?,
                result,
            })
        },
    ),
    functor(
        "LISP-PRED",
        "FUNCTION argument…",
        "A Lisp function returns something else than NIL.",
        |call| {
            Ok(Action::CallTest {
                function: function(&call, &call.arg(0))?,
                args: call.shown(call.rest(1))?,
            })
        },
    ),
    functor(
        "LISP-TYPE",
        "object type",
        "The object is of the type.",
        |call| is_of_type(&call, 0, 1),
    ),
    functor(
        "ASSERT-TYPE",
        "object type argument…",
        "The object is of the type.",
        |call| is_of_type(&call, 0, 1),
    ),
    functor(
        "INSTANCE-OF",
        "type object",
        "The object is of the type; an instance is made if there is no object yet, and a type that is unknown is that of the object.",
        instance_of,
    ),
    functor(
        "SYMBOL-VALUE",
        "SYMBOL value",
        "The value of a variable.",
        |call| call_known(&call, known::SYMBOL_VALUE, 1),
    ),
    functor(
        "SET-SYMBOL-VALUE",
        "symbol value",
        "Holds; assigns a variable.",
        |call| {
            let args = call.shown(call.args)?;
            let function = known::SET.into();
            Ok(Action::CallOnly { function, args })
        },
    ),
    functor(
        "SLOT-VALUE",
        "OBJECT SLOT value",
        "The value of a slot, which is stored if it is known.",
        |call| {
            if is_unbound(&call, 2) {
                return call_known(&call, known::SLOT_VALUE, 2);
            }
            let args = call.shown(&[call.arg(2), call.arg(0), call.arg(1)])?;
            let function = known::SET_SLOT_VALUE.into();
            Ok(Action::CallOnly { function, args })
        },
    ),
    functor(
        "GET-SLOT-VALUE",
        "OBJECT SLOT value",
        "The value of a slot.",
        |call| call_known(&call, known::SLOT_VALUE, 2),
    ),
    functor(
        "STRING-CONCAT",
        "string… result",
        "The strings joined.",
        |call| {
            let Some((result, strings)) = call.args.split_last() else {
                return Ok(Action::Fail);
            };
            let mut args = vec![known::STRING.into()];
            args.extend(call.shown(strings)?);
            Ok(Action::CallFor {
                function: call.image.intern(PackageTable::CL, "CONCATENATE").into(),
                args,
                result: result.clone(),
            })
        },
    ),
    functor(
        "GENERATE-VALUES",
        "value FUNCTION argument…",
        "The value is each element in turn of the list that a function returns.",
        |call| {
            Ok(Action::CallItems {
                function: function(&call, &call.arg(1))?,
                args: call.shown(call.rest(2))?,
                term: call.arg(0),
            })
        },
    ),
    functor(
        "FORMAT",
        "control argument…",
        "Holds; writes a formatted text.",
        |call| {
            let mut args = vec![Value::T];
            args.extend(call.shown(call.args)?);
            let function = known::FORMAT.into();
            Ok(Action::CallOnly { function, args })
        },
    ),
    functor("WARN", "control argument…", "Holds; warns.", |call| {
        let args = call.shown(call.args)?;
        let function = known::WARN.into();
        Ok(Action::CallOnly { function, args })
    }),
    functor("ERROR", "control argument…", "Signals an error.", |call| {
        let args = call.shown(call.args)?;
        let function = known::ERROR.into();
        Ok(Action::CallOnly { function, args })
    }),
];

fn prove(goal: &Value) -> Goal {
    Goal::Prove(goal.clone())
}

fn otherwise(call: &Call<'_>) -> Vec<Goal> {
    match call.rest(2).first() {
        Some(otherwise) => vec![prove(otherwise)],
        None => vec![Goal::Fail],
    }
}

fn or(call: Call<'_>) -> Result<Action> {
    Ok(match call.args {
        [] => Action::Fail,
        [only] => Action::Then(vec![prove(only)]),
        [first, rest @ ..] => {
            let others = Value::list_with_tail([call.functor.into()], Value::list(rest.to_vec()));
            Action::Either(vec![prove(first)], vec![Goal::Prove(others)])
        }
    })
}

fn unify(call: Call<'_>) -> Result<Action> {
    let (a, b) = (call.arg(0), call.arg(1));
    Ok(call.unify(&a, &b))
}

/// Compares two numbers; what is not known yet cannot be compared.
fn compare(call: &Call<'_>, compare: fn(&Value, &Value) -> Result<bool>) -> Result<Action> {
    for term in call.args {
        if !call.bindings.is_ground(term)? {
            return Ok(Action::Fail);
        }
    }
    let (a, b) = (
        call.bindings.shown(&call.arg(0))?,
        call.bindings.shown(&call.arg(1))?,
    );
    Ok(holds(compare(&a, &b)?))
}

fn collect(call: &Call<'_>, kind: Collection) -> Action {
    Action::Collect {
        template: call.arg(0),
        goal: call.arg(1),
        result: call.arg(2),
        kind,
    }
}

/// A function as written in goals: a symbol, `#'symbol`, or a function.
fn function(call: &Call<'_>, term: &Value) -> Result<Value> {
    let term = call.bindings.shown(term)?;
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

/// The call of a Common Lisp function, whose value is unified with the third argument.
fn call_for(call: &mut Call<'_>, name: &str, args: Vec<Value>) -> Action {
    Action::CallFor {
        function: call.image.intern(PackageTable::CL, name).into(),
        args,
        result: call.arg(2),
    }
}

/// The call of a function with the first `count` arguments, whose value is unified with the next
/// one.
fn call_known(call: &Call<'_>, function: Sym, count: usize) -> Result<Action> {
    Ok(Action::CallFor {
        function: function.into(),
        args: call.shown(call.args.get(..count).unwrap_or_default())?,
        result: call.arg(count),
    })
}

fn is_of_type(call: &Call<'_>, object: usize, kind: usize) -> Result<Action> {
    Ok(Action::CallTest {
        function: known::TYPEP.into(),
        args: call.shown(&[call.arg(object), call.arg(kind)])?,
    })
}

/// Is an argument an unbound variable?
fn is_unbound(call: &Call<'_>, index: usize) -> bool {
    let term = call.bindings.walk(&call.arg(index));
    term.as_foreign::<Variable>().is_some()
}

fn instance_of(call: Call<'_>) -> Result<Action> {
    let call_of = |function: Sym, argument: usize, result: usize| {
        Ok(Action::CallFor {
            args: call.shown(&[call.arg(argument)])?,
            result: call.arg(result),
            function: function.into(),
        })
    };
    match (is_unbound(&call, 0), is_unbound(&call, 1)) {
        (true, true) => Ok(Action::Fail),
        (false, true) => call_of(known::MAKE_INSTANCE, 0, 1),
        (true, false) => call_of(known::TYPE_OF, 1, 0),
        (false, false) => is_of_type(&call, 1, 0),
    }
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

/// Joins two lists, or splits one in all possible ways.
fn append(call: Call<'_>) -> Result<Action> {
    let (first, second, both) = (call.arg(0), call.arg(1), call.arg(2));
    if let Some(items) = call.bindings.resolve(&first)?.list_to_vec() {
        let joined = Value::list_with_tail(items, second);
        return Ok(call.unify(&both, &joined));
    }
    let Some(items) = call.bindings.resolve(&both)?.list_to_vec() else {
        return Ok(Action::Fail);
    };
    let splits = (0..=items.len())
        .map(|i| {
            let (head, tail) = items.split_at(i);
            Value::list([Value::list(head.to_vec()), Value::list(tail.to_vec())])
        })
        .collect();
    Ok(Action::Items(Value::list([first, second]), splits))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_functor_is_there_twice() {
        for (index, functor) in TABLE.iter().enumerate() {
            let mut others = TABLE.iter().skip(index + 1);
            assert!(
                others.all(|other| other.name != functor.name),
                "{}",
                functor.name
            );
        }
    }
}
