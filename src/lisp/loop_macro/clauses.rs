//! The clauses of a loop, one after the other.

use super::accumulation::{self, Adding};
use super::assign;
use super::iteration;
use super::parser::Parser;
use super::plan::{Plan, Step};
use super::support;
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;

/// Words that begin a clause, for messages.
const CLAUSES: &[&str] = &[
    "FOR",
    "AS",
    "WITH",
    "REPEAT",
    "WHILE",
    "UNTIL",
    "DO",
    "COLLECT",
    "APPEND",
    "NCONC",
    "SUM",
    "COUNT",
    "MAXIMIZE",
    "MINIMIZE",
    "WHEN",
    "IF",
    "UNLESS",
    "RETURN",
    "THEREIS",
    "ALWAYS",
    "NEVER",
    "INITIALLY",
    "FINALLY",
];

/// Words that begin what may follow a condition.
const CONDITIONAL: &[&str] = &[
    "DO", "COLLECT", "APPEND", "NCONC", "SUM", "COUNT", "MAXIMIZE", "MINIMIZE", "WHEN", "IF",
    "UNLESS", "RETURN",
];

/// The deepest nesting of conditions.
const MAX_NESTING: usize = 200;

fn call(function: impl Into<Value>, args: impl IntoIterator<Item = Value>) -> Value {
    let args: Vec<Value> = args.into_iter().collect();
    Value::cons(function.into(), Value::list(args))
}

/// Reads all clauses.
pub(crate) fn parse(parser: &mut Parser<'_>) -> Result<Plan, Box<Raise>> {
    let mut plan = Plan {
        name: Value::NIL,
        end_tag: parser.fresh("END"),
        ..Plan::default()
    };
    if parser.accept(&["NAMED"]) {
        plan.name = parser.form("NAMED")?;
        if plan.name.as_symbol().is_none() {
            return Err(Raise::program(format!(
                "NAMED in LOOP is followed by a name, not {}.",
                parser.shown(&plan.name)
            )));
        }
    }
    let mut previous = "LOOP".to_owned();
    while !parser.is_at_end() {
        let Some(word) = parser.word().map(str::to_owned) else {
            return Err(parser.unexpected(&previous, CLAUSES));
        };
        clause(parser, &mut plan, &word, &previous)?;
        previous = format!("the {word} clause");
    }
    if let Some(word) = plan.decides
        && plan.accumulators.iter().any(|a| a.into.is_none())
    {
        return Err(Raise::program(format!(
            "{word} in LOOP decides what is returned; give what is accumulated a variable with INTO."
        )));
    }
    Ok(plan)
}

fn clause(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    word: &str,
    previous: &str,
) -> Result<(), Box<Raise>> {
    match word {
        "NAMED" => Err(Raise::program(
            "NAMED in LOOP stands before all other clauses.",
        )),
        "FOR" | "AS" => {
            parser.accept(&[word]);
            iteration::parse(parser, plan)
        }
        "WITH" => {
            parser.accept(&[word]);
            with(parser, plan)
        }
        "REPEAT" => {
            parser.accept(&[word]);
            repeat(parser, plan)
        }
        "INITIALLY" => {
            parser.accept(&[word]);
            let forms = parser.compound_forms(word)?;
            plan.initially.extend(forms);
            Ok(())
        }
        "FINALLY" => {
            parser.accept(&[word]);
            if parser.accept(&["RETURN"]) {
                let value = parser.form("FINALLY RETURN")?;
                plan.finally.push(returning(plan, value));
                return Ok(());
            }
            parser.accept(&["DO", "DOING"]);
            let forms = parser.compound_forms(word)?;
            plan.finally.extend(forms);
            Ok(())
        }
        "WHILE" | "UNTIL" => {
            parser.accept(&[word]);
            let test = parser.form(word)?;
            let end = call(known::GO, [plan.end_tag.clone()]);
            let operator = if word == "WHILE" {
                known::UNLESS
            } else {
                known::WHEN
            };
            plan.body.push(call(operator, [test, end]));
            Ok(())
        }
        "ALWAYS" | "NEVER" => {
            parser.accept(&[word]);
            let test = parser.form(word)?;
            let operator = if word == "ALWAYS" {
                known::UNLESS
            } else {
                known::WHEN
            };
            let stop = returning(plan, Value::NIL);
            plan.body.push(call(operator, [test, stop]));
            plan.default_true = true;
            plan.decides = Some(if word == "ALWAYS" { "ALWAYS" } else { "NEVER" });
            Ok(())
        }
        "THEREIS" => {
            parser.accept(&[word]);
            let form = parser.form(word)?;
            plan.decides = Some("THEREIS");
            let found = parser.fresh("FOUND");
            plan.scratch.push(found.clone());
            let stop = returning(plan, found.clone());
            let test = call(known::SETQ, [found, form]);
            plan.body.push(call(known::WHEN, [test, stop]));
            Ok(())
        }
        _ => match selectable(parser, plan, word, None, 0)? {
            Some(form) => {
                plan.body.push(form);
                Ok(())
            }
            None => Err(parser.unexpected(previous, CLAUSES)),
        },
    }
}

fn returning(plan: &Plan, value: Value) -> Value {
    call(known::RETURN_FROM, [plan.name.clone(), value])
}

/// Reads the clauses that may follow a condition, and returns the form that carries them out. `it`
/// is the variable that holds the condition's value.
fn selectable(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    word: &str,
    it: Option<&It>,
    depth: usize,
) -> Result<Option<Value>, Box<Raise>> {
    if let Some(adding) = Adding::named(word) {
        parser.accept(&[word]);
        let form = form_or_it(parser, word, it)?;
        return accumulation::parse(parser, plan, word, adding, form).map(Some);
    }
    match word {
        "DO" | "DOING" => {
            parser.accept(&[word]);
            let forms = parser.compound_forms(word)?;
            Ok(Some(call(known::PROGN, forms)))
        }
        "RETURN" => {
            parser.accept(&[word]);
            let form = form_or_it(parser, word, it)?;
            Ok(Some(returning(plan, form)))
        }
        "WHEN" | "IF" | "UNLESS" => {
            parser.accept(&[word]);
            if depth > MAX_NESTING {
                return Err(Raise::program("Conditions in LOOP are nested too deep."));
            }
            conditional(parser, plan, word, depth).map(Some)
        }
        _ => Ok(None),
    }
}

/// The value of a condition, to be referred to as `it`.
struct It {
    variable: Value,
    used: std::cell::Cell<bool>,
}

/// Reads a form; the word `it` stands for the value of the condition around it.
fn form_or_it(parser: &mut Parser<'_>, word: &str, it: Option<&It>) -> Result<Value, Box<Raise>> {
    if let Some(it) = it
        && parser.accept(&["IT"])
    {
        it.used.set(true);
        return Ok(it.variable.clone());
    }
    parser.form(word)
}

fn conditional(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    word: &str,
    depth: usize,
) -> Result<Value, Box<Raise>> {
    let test = parser.form(word)?;
    let it = It {
        variable: parser.fresh("IT"),
        used: std::cell::Cell::new(false),
    };
    let yes = branch(parser, plan, word, &it, depth)?;
    let no = if parser.accept(&["ELSE"]) {
        branch(parser, plan, "ELSE", &it, depth)?
    } else {
        Value::NIL
    };
    parser.accept(&["END"]);
    let test = if it.used.get() {
        plan.scratch.push(it.variable.clone());
        call(known::SETQ, [it.variable, test])
    } else {
        test
    };
    let (yes, no) = if word == "UNLESS" {
        (no, yes)
    } else {
        (yes, no)
    };
    Ok(call(known::IF, [test, yes, no]))
}

/// One or more clauses joined by `and`.
fn branch(
    parser: &mut Parser<'_>,
    plan: &mut Plan,
    after: &str,
    it: &It,
    depth: usize,
) -> Result<Value, Box<Raise>> {
    let mut forms = Vec::new();
    loop {
        let word = parser.word().map(str::to_owned).unwrap_or_default();
        // In the clauses after the first one, IT is a variable like others.
        let it = forms.is_empty().then_some(it);
        match selectable(parser, plan, &word, it, depth + 1)? {
            Some(form) => forms.push(form),
            None => return Err(parser.unexpected(after, CONDITIONAL)),
        }
        if !parser.accept(&["AND"]) {
            break;
        }
    }
    Ok(call(known::PROGN, forms))
}

fn with(parser: &mut Parser<'_>, plan: &mut Plan) -> Result<(), Box<Raise>> {
    let mut group = Vec::new();
    let mut parts = Vec::new();
    loop {
        let (tree, of_type) = assign::variable(parser, plan, "WITH")?;
        if !parser.accept(&["="]) {
            group.extend(assign::defaults(&tree, of_type.as_ref()));
            if !parser.accept(&["AND"]) {
                break;
            }
            parser.accept(&["WITH"]);
            continue;
        }
        let value = parser.form("=")?;
        match &tree {
            Value::Symbol(sym, ..) if *sym != known::NIL => group.push((tree, value)),
            _ => {
                let whole = parser.fresh("WHOLE");
                parts.extend(assign::parts(&tree, &whole));
                group.push((whole, value));
            }
        }
        if !parser.accept(&["AND"]) {
            break;
        }
        parser.accept(&["WITH"]);
    }
    plan.bindings.push(group);
    if !parts.is_empty() {
        plan.bindings.push(parts);
    }
    Ok(())
}

fn repeat(parser: &mut Parser<'_>, plan: &mut Plan) -> Result<(), Box<Raise>> {
    let form = parser.form("REPEAT")?;
    let count = parser.fresh("COUNT");
    let rounds = match form {
        Value::Int(_) => form,
        form => call(support::common(parser.image, "CEILING"), [form]),
    };
    plan.bindings.push(vec![(count.clone(), rounds)]);
    let step = Step {
        tests: vec![call(known::LESS_EQUAL, [count.clone(), Value::Int(0)])],
        advances: vec![(count.clone(), call(known::ONE_MINUS, [count]))],
        ..Step::default()
    };
    plan.first.push(step.clone());
    plan.next.push(step);
    Ok(())
}
