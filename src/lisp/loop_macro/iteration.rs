//! `for` and `as` clauses.

use super::assign;
use super::parser::Parser;
use super::plan::{Assignment, Plan, Step};
use super::support;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// Words that may follow the variable of a `for` clause.
const AFTER_VARIABLE: &[&str] = &[
    "IN", "ON", "ACROSS", "=", "FROM", "UPFROM", "DOWNFROM", "TO", "UPTO", "DOWNTO", "BELOW",
    "ABOVE", "BY", "BEING",
];

/// One clause: what it binds and how it steps.
struct Clause {
    bindings: Vec<Assignment>,
    first: Step,
    next: Step,
}

impl Clause {
    fn same(bindings: Vec<Assignment>, step: Step) -> Clause {
        Clause {
            bindings,
            first: step.clone(),
            next: step,
        }
    }
}

fn call(function: impl Into<Value>, args: impl IntoIterator<Item = Value>) -> Value {
    let args: Vec<Value> = args.into_iter().collect();
    Value::cons(function.into(), Value::list(args))
}

/// Reads a `for` clause, after that word, and the clauses that `and` joins to it.
pub(crate) fn parse(parser: &mut Parser<'_>, plan: &mut Plan) -> Result<(), Box<Raise>> {
    let mut joined = one(parser, plan)?;
    while parser.accept(&["AND"]) {
        parser.accept(&["FOR", "AS"]);
        let clause = one(parser, plan)?;
        joined.bindings.extend(clause.bindings);
        joined.first.join(clause.first);
        joined.next.join(clause.next);
    }
    plan.bindings.push(joined.bindings);
    plan.first.push(joined.first);
    plan.next.push(joined.next);
    Ok(())
}

fn one(parser: &mut Parser<'_>, plan: &mut Plan) -> Result<Clause, Box<Raise>> {
    let (tree, of_type) = assign::variable(parser, plan, "FOR")?;
    if parser.accept(&["IN"]) {
        in_list(parser, tree)
    } else if parser.accept(&["ON"]) {
        on_list(parser, tree)
    } else if parser.accept(&["ACROSS"]) {
        across(parser, tree)
    } else if parser.accept(&["="]) {
        equals(parser, tree)
    } else if parser.accept(&["BEING"]) {
        being(parser, plan, tree)
    } else if parser.is_any(AFTER_VARIABLE) {
        let _ = of_type;
        counting(parser, tree)
    } else {
        let shown = parser.shown(&tree);
        Err(parser.unexpected(&format!("FOR {shown}"), AFTER_VARIABLE))
    }
}

/// The user's variables, bound to `NIL` until they get values.
fn unset(tree: &Value) -> Vec<Assignment> {
    assign::parts(tree, &Value::NIL)
        .into_iter()
        .map(|(variable, _)| (variable, Value::NIL))
        .collect()
}

/// The form that steps along a list, by the function after an optional `by`.
fn list_step(
    parser: &mut Parser<'_>,
    list: &Value,
    bindings: &mut Vec<Assignment>,
) -> Result<Value, Box<Raise>> {
    if !parser.accept(&["BY"]) {
        return Ok(call(known::CDR, [list.clone()]));
    }
    let function = parser.form("BY")?;
    // #'name is called by name, other functions are evaluated once.
    let name = function
        .as_cons()
        .filter(|c| matches!(c.car(), Value::Symbol(known::FUNCTION, ..)))
        .map(|c| c.cdr().car_or_nil());
    if let Some(name @ Value::Symbol(..)) = name {
        return Ok(call(name, [list.clone()]));
    }
    let variable = parser.fresh("BY");
    bindings.push((variable.clone(), function));
    Ok(call(known::FUNCALL, [variable, list.clone()]))
}

fn in_list(parser: &mut Parser<'_>, tree: Value) -> Result<Clause, Box<Raise>> {
    let form = parser.form("IN")?;
    let list = parser.fresh("LIST");
    let mut bindings = vec![(list.clone(), form)];
    let advance = list_step(parser, &list, &mut bindings)?;
    bindings.extend(unset(&tree));
    let endp = support::common(parser.image, "ENDP");
    let step = Step {
        tests: vec![call(endp, [list.clone()])],
        sets: vec![(tree, call(known::CAR, [list.clone()]))],
        advances: vec![(list, advance)],
        ..Step::default()
    };
    Ok(Clause::same(bindings, step))
}

fn on_list(parser: &mut Parser<'_>, tree: Value) -> Result<Clause, Box<Raise>> {
    let form = parser.form("ON")?;
    if matches!(&tree, Value::Symbol(sym, ..) if *sym != known::NIL) {
        // The variable itself steps along the list.
        let mut bindings = vec![(tree.clone(), form)];
        let advance = list_step(parser, &tree, &mut bindings)?;
        let test = call(known::ATOM, [tree.clone()]);
        return Ok(Clause {
            bindings,
            first: Step {
                tests: vec![test.clone()],
                ..Step::default()
            },
            next: Step {
                sets: vec![(tree, advance)],
                tests_after: vec![test],
                ..Step::default()
            },
        });
    }
    let list = parser.fresh("LIST");
    let mut bindings = vec![(list.clone(), form)];
    let advance = list_step(parser, &list, &mut bindings)?;
    bindings.extend(unset(&tree));
    let step = Step {
        tests: vec![call(known::ATOM, [list.clone()])],
        sets: vec![(tree, list.clone())],
        advances: vec![(list, advance)],
        ..Step::default()
    };
    Ok(Clause::same(bindings, step))
}

fn across(parser: &mut Parser<'_>, tree: Value) -> Result<Clause, Box<Raise>> {
    let form = parser.form("ACROSS")?;
    let vector = parser.fresh("VECTOR");
    let index = parser.fresh("INDEX");
    let mut bindings = vec![(vector.clone(), form), (index.clone(), Value::Int(0))];
    bindings.extend(unset(&tree));
    let length = call(
        support::system(parser.image, "VECTOR-LENGTH"),
        [vector.clone()],
    );
    let step = Step {
        tests: vec![call(known::GREATER_EQUAL, [index.clone(), length])],
        sets: vec![(tree, call(known::AREF, [vector, index.clone()]))],
        advances: vec![(index.clone(), call(known::ONE_PLUS, [index]))],
        ..Step::default()
    };
    Ok(Clause::same(bindings, step))
}

fn equals(parser: &mut Parser<'_>, tree: Value) -> Result<Clause, Box<Raise>> {
    let form = parser.form("=")?;
    let then = if parser.accept(&["THEN"]) {
        parser.form("THEN")?
    } else {
        form.clone()
    };
    let set = |form| Step {
        sets: vec![(tree.clone(), form)],
        ..Step::default()
    };
    Ok(Clause {
        bindings: unset(&tree),
        first: set(form),
        next: set(then),
    })
}

/// The direction in which a number steps.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Direction {
    Up,
    Down,
}

fn counting(parser: &mut Parser<'_>, variable: Value) -> Result<Clause, Box<Raise>> {
    if !matches!(variable, Value::Symbol(..)) {
        return Err(Raise::program(format!(
            "{} in LOOP cannot count; it must be one variable.",
            parser.shown(&variable)
        )));
    }
    let mut start = None;
    let mut limit: Option<(Value, bool)> = None;
    let mut by = None;
    let mut direction = None;
    let mut bindings = Vec::new();
    let variable = match variable {
        Value::Symbol(known::NIL, ..) => parser.fresh("COUNTER"),
        other => other,
    };
    while let Some(word) = parser.word().map(str::to_owned) {
        let way = match word.as_str() {
            "FROM" | "TO" | "BY" => None,
            "UPFROM" | "UPTO" | "BELOW" => Some(Direction::Up),
            "DOWNFROM" | "DOWNTO" | "ABOVE" => Some(Direction::Down),
            _ => break,
        };
        parser.accept(&[&word]);
        if let (Some(old), Some(new)) = (direction, way)
            && old != new
        {
            return Err(Raise::program(format!(
                "{word} in LOOP counts the other way than the words before it."
            )));
        }
        direction = direction.or(way);
        let form = parser.form(&word)?;
        let twice = match word.as_str() {
            "FROM" | "UPFROM" | "DOWNFROM" => start.replace(form.clone()).is_some(),
            "BY" => by.replace(form.clone()).is_some(),
            _ => {
                let exclusive = matches!(word.as_str(), "BELOW" | "ABOVE");
                limit.replace((form.clone(), exclusive)).is_some()
            }
        };
        if twice {
            return Err(Raise::program(format!(
                "{word} in LOOP says again where the number begins, ends or how it steps."
            )));
        }
        // Forms are evaluated in the order in which they are written.
        match word.as_str() {
            "FROM" | "UPFROM" | "DOWNFROM" => bindings.push((variable.clone(), form)),
            "BY" => by = Some(step_size(parser, form, &mut bindings)?),
            _ => {
                if let Some((limit, _)) = &mut limit {
                    *limit = once(parser, form, "LIMIT", &mut bindings);
                }
            }
        }
    }
    let direction = direction.unwrap_or(Direction::Up);
    if start.is_none() {
        if direction == Direction::Down {
            return Err(Raise::program(format!(
                "FOR {} in LOOP counts down from nowhere; say FROM or DOWNFROM and a number.",
                parser.shown(&variable)
            )));
        }
        bindings.insert(0, (variable.clone(), Value::Int(0)));
    }
    let by = by.unwrap_or(Value::Int(1));
    let (step, at, beyond) = match direction {
        Direction::Up => (known::PLUS, known::GREATER_EQUAL, known::GREATER),
        Direction::Down => (known::MINUS, known::LESS_EQUAL, known::LESS),
    };
    let tests: Vec<Value> = limit
        .map(|(limit, exclusive)| {
            let test = if exclusive { at } else { beyond };
            call(test, [variable.clone(), limit])
        })
        .into_iter()
        .collect();
    let next = call(step, [variable.clone(), by]);
    Ok(Clause {
        bindings,
        first: Step {
            tests: tests.clone(),
            ..Step::default()
        },
        next: Step {
            sets: vec![(variable, next)],
            tests_after: tests,
            ..Step::default()
        },
    })
}

/// A form that is evaluated once: the form itself if it is a number, else a variable.
fn once(parser: &mut Parser<'_>, form: Value, name: &str, bindings: &mut Vec<Assignment>) -> Value {
    if is_number(&form) {
        return form;
    }
    let variable = parser.fresh(name);
    bindings.push((variable.clone(), form));
    variable
}

fn is_number(form: &Value) -> bool {
    matches!(
        form,
        Value::Int(_) | Value::Big(_) | Value::Ratio(_) | Value::Single(_) | Value::Double(_)
    )
}

/// The size of a step, which must be positive.
fn step_size(
    parser: &mut Parser<'_>,
    form: Value,
    bindings: &mut Vec<Assignment>,
) -> Result<Value, Box<Raise>> {
    if is_number(&form) {
        support::check_positive(&form)?;
        return Ok(form);
    }
    let checked = call(support::system(parser.image, "POSITIVE-STEP"), [form]);
    Ok(once(parser, checked, "BY", bindings))
}

/// What a `being` clause can iterate over.
const PATHS: &[&str] = &[
    "HASH-KEY",
    "HASH-KEYS",
    "HASH-VALUE",
    "HASH-VALUES",
    "SYMBOL",
    "SYMBOLS",
    "PRESENT-SYMBOL",
    "PRESENT-SYMBOLS",
    "EXTERNAL-SYMBOL",
    "EXTERNAL-SYMBOLS",
    "ELEMENT",
    "ELEMENTS",
];

fn being(parser: &mut Parser<'_>, plan: &mut Plan, tree: Value) -> Result<Clause, Box<Raise>> {
    if !parser.accept(&["THE", "EACH"]) {
        return Err(parser.unexpected("BEING", &["THE", "EACH"]));
    }
    let Some(path) = parser
        .word()
        .filter(|word| PATHS.contains(word))
        .map(|word| word.trim_end_matches('S').to_owned())
    else {
        return Err(parser.unexpected("BEING THE", PATHS));
    };
    parser.accept(PATHS);
    let is_symbols = path.ends_with("SYMBOL");
    let source = if parser.accept(&["IN", "OF"]) {
        parser.form("OF")?
    } else if is_symbols {
        known::V_PACKAGE.into()
    } else {
        return Err(parser.unexpected(&path, &["OF", "IN"]));
    };
    let other = using(parser, plan, &path)?;
    let (items, pattern) = match path.as_str() {
        "HASH-KEY" | "HASH-VALUE" => {
            let keys = path == "HASH-KEY";
            match other {
                None => {
                    let name = if keys {
                        known::HASH_KEYS
                    } else {
                        known::HASH_VALUES
                    };
                    (call(name, [source]), tree)
                }
                Some(other) => {
                    let (key, value) = if keys { (tree, other) } else { (other, tree) };
                    (call(known::HASH_PAIRS, [source]), Value::cons(key, value))
                }
            }
        }
        "ELEMENT" => {
            let elements = support::system(parser.image, "ELEMENTS");
            (call(elements, [source]), tree)
        }
        _ => {
            let kind = match path.as_str() {
                "SYMBOL" => known::K_INHERITED,
                "PRESENT-SYMBOL" => known::K_INTERNAL,
                _ => known::K_EXTERNAL,
            };
            (call(known::PACKAGE_SYMBOLS, [source, kind.into()]), tree)
        }
    };
    let list = parser.fresh("ITEMS");
    let mut bindings = vec![(list.clone(), items)];
    bindings.extend(unset(&pattern));
    let step = Step {
        tests: vec![call(known::NULL, [list.clone()])],
        sets: vec![(pattern, call(known::CAR, [list.clone()]))],
        advances: vec![(list.clone(), call(known::CDR, [list]))],
        ..Step::default()
    };
    Ok(Clause::same(bindings, step))
}

/// Reads `using (hash-key variable)` or `using (hash-value variable)`.
fn using(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    path: &str,
) -> Result<Option<Value>, Box<Raise>> {
    if !parser.accept(&["USING"]) {
        return Ok(None);
    }
    let wanted = match path {
        "HASH-KEY" => "HASH-VALUE",
        "HASH-VALUE" => "HASH-KEY",
        _ => {
            return Err(Raise::program(format!(
                "USING in LOOP goes with HASH-KEYS and HASH-VALUES, not with {path}S."
            )));
        }
    };
    let form = parser.form("USING")?;
    let items = form.list_to_vec().unwrap_or_default();
    match items.as_slice() {
        [Value::Symbol(word, ..), variable]
            if parser.image.name(*word).trim_end_matches('S') == wanted =>
        {
            for (variable, _) in assign::parts(variable, &Value::NIL) {
                assign::only_once(parser, plan, &variable)?;
                plan.variables.push(variable);
            }
            Ok(Some(variable.clone()))
        }
        _ => Err(Raise::program(format!(
            "USING in LOOP is followed by ({wanted} VARIABLE), not {}.",
            parser.shown(&form)
        ))),
    }
}
