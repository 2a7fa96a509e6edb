//! `collect`, `append`, `nconc`, `sum`, `count`, `maximize`, `minimize`.

use super::assign;
use super::parser::Parser;
use super::plan::{Accumulator, Building, Plan};
use super::support;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// How a clause adds to a result.
#[derive(Clone, Copy)]
pub(crate) enum Adding {
    /// An element at the end of a list.
    Collect,
    /// The elements of a list, copied.
    Append,
    /// A list itself.
    Nconc,
    /// A number.
    Sum,
    /// One, if the form is true.
    Count,
    /// The largest number.
    Maximize,
    /// The smallest number.
    Minimize,
}

impl Adding {
    /// What a word of a clause means.
    pub(crate) fn named(word: &str) -> Option<Adding> {
        Some(match word {
            "COLLECT" | "COLLECTING" => Adding::Collect,
            "APPEND" | "APPENDING" => Adding::Append,
            "NCONC" | "NCONCING" => Adding::Nconc,
            "SUM" | "SUMMING" => Adding::Sum,
            "COUNT" | "COUNTING" => Adding::Count,
            "MAXIMIZE" | "MAXIMIZING" => Adding::Maximize,
            "MINIMIZE" | "MINIMIZING" => Adding::Minimize,
            _ => return None,
        })
    }

    fn building(self) -> Building {
        match self {
            Adding::Collect | Adding::Append | Adding::Nconc => Building::List,
            Adding::Sum | Adding::Count => Building::Total,
            Adding::Maximize | Adding::Minimize => Building::Extreme,
        }
    }
}

/// Reads what follows the form of an accumulation, and builds the form that adds.
pub(crate) fn parse(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    word: &str,
    adding: Adding,
    form: Value,
) -> Result<Value, Box<Raise>> {
    let into = if parser.accept(&["INTO"]) {
        let variable = parser.form("INTO")?;
        match variable.as_symbol() {
            Some(sym) if sym != known::NIL && !parser.image.is_keyword(sym) => {
                assign::only_once(parser, plan, &variable)?;
                Some(variable)
            }
            _ => {
                return Err(Raise::program(format!(
                    "INTO in LOOP is followed by a variable, not {}.",
                    parser.shown(&variable)
                )));
            }
        }
    } else {
        None
    };
    let of_type = if adding.building() == Building::List {
        None
    } else {
        assign::variable_type(parser, word)?
    };
    let index = accumulator(parser, plan, word, adding, into)?;
    // `accumulator` returns the index of an element.
    let Some(accumulator) = plan.accumulators.get(index) else {
        return Ok(form);
    };
    let adds = add(parser, accumulator, adding, form);
    // A sum or number of floats starts at zero of their type.
    if let Some(of_type) = of_type
        && let (Adding::Sum | Adding::Count, start @ (Value::Single(_) | Value::Double(_))) =
            (adding, assign::default_value(Some(&of_type)))
    {
        let variable = accumulator.variable.clone();
        plan.initially.insert(0, set(&variable, start));
    }
    Ok(adds)
}

fn accumulator(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    word: &str,
    adding: Adding,
    into: Option<Value>,
) -> Result<usize, Box<Raise>> {
    let same = |a: &Option<Value>, b: &Option<Value>| match (a, b) {
        (Some(a), Some(b)) => a.is_eq(b),
        (None, None) => true,
        _ => false,
    };
    let found = plan.accumulators.iter().position(|a| same(&a.into, &into));
    if let Some(index) = found {
        let compatible = plan
            .accumulators
            .get(index)
            .is_some_and(|a| a.building == adding.building());
        if !compatible {
            return Err(Raise::program(format!(
                "{word} in LOOP adds to a result of another kind; give one of them a variable with INTO."
            )));
        }
        return Ok(index);
    }
    let variable = match &into {
        Some(variable) => variable.clone(),
        None => parser.fresh("RESULT"),
    };
    plan.accumulators.push(Accumulator {
        building: adding.building(),
        variable,
        front: parser.fresh("FRONT"),
        tail: parser.fresh("TAIL"),
        into,
    });
    Ok(plan.accumulators.len() - 1)
}

fn call(function: impl Into<Value>, args: impl IntoIterator<Item = Value>) -> Value {
    let args: Vec<Value> = args.into_iter().collect();
    Value::cons(function.into(), Value::list(args))
}

fn set(variable: &Value, form: Value) -> Value {
    call(known::SETQ, [variable.clone(), form])
}

fn add(parser: &mut Parser<'_>, to: &Accumulator, adding: Adding, form: Value) -> Value {
    let variable = to.variable.clone();
    let tail = to.tail.clone();
    let extend = match adding {
        Adding::Collect => "EXTEND-LIST",
        Adding::Append => "EXTEND-LIST-COPYING",
        Adding::Nconc => "EXTEND-LIST-JOINING",
        Adding::Sum => {
            return set(&variable, call(known::PLUS, [variable.clone(), form]));
        }
        Adding::Count => {
            let more = set(&variable, call(known::ONE_PLUS, [variable.clone()]));
            return call(known::WHEN, [form, more]);
        }
        Adding::Maximize | Adding::Minimize => {
            let choose = match adding {
                Adding::Maximize => support::common(parser.image, "MAX"),
                _ => support::common(parser.image, "MIN"),
            };
            let candidate = call(
                known::IF,
                [
                    variable.clone(),
                    call(choose.clone(), [variable.clone(), tail.clone()]),
                    call(choose, [tail.clone()]),
                ],
            );
            return call(known::SETQ, [tail, form, variable, candidate]);
        }
    };
    let extend = support::system(parser.image, extend);
    let extended = call(extend, [tail.clone(), form]);
    match to.into {
        // The user may read the list at any time.
        Some(_) => call(
            known::SETQ,
            [
                tail,
                extended,
                variable,
                call(known::CDR, [to.front.clone()]),
            ],
        ),
        None => set(&tail, extended),
    }
}
