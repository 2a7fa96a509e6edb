//! The package `ALEXANDRIA`: the parts of that library that plans use. Functions.

use super::criterion::{Key, Test};
use super::hash_tables::table;
use super::keywords;
use super::list_trees::PairCount;
use super::strings::{designated, string};
use crate::lisp::builtin::{Builtin, control, pure};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::function::Function;
use crate::lisp::value::hash_table::HashTable;
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::package::PackageTable;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::sequence::{
    ListBuilder, ListWalk, Sequence, index, list_items, list_length,
};
use crate::lisp::vm::callable::callable;
use crate::lisp::vm::calls::{Args, Calls, run};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// Makes the package and installs its functions and macros.
pub(crate) fn install(image: &mut Image) {
    let package = match image.packages.find("ALEXANDRIA") {
        Some(package) => package,
        None => match image.packages.make("ALEXANDRIA", &["ALEXANDRIA.1.0.0"]) {
            Some(package) => package,
            None => return,
        },
    };
    image.packages.use_package(package, PackageTable::CL);
    image.install(package, TABLE);
    image.install(package, super::hash_tables::ALEXANDRIA_TABLE);
    image.install_operators(package, super::alexandria_macros::OPERATORS);
}

/// The name under which function objects made here appear.
fn made(
    image: &mut Image,
    name: &str,
    body: impl Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>> + 'static,
) -> Value {
    let sym = image.intern(PackageTable::SYSTEM, name);
    Value::Function(Function::made_control(sym, (0, None), body))
}

fn functions(image: &Image, args: &[Value]) -> Result<Vec<Value>, Box<Raise>> {
    args.iter().map(|f| callable(image, f)).collect()
}

fn compose(image: &mut Image, args: &[Value]) -> Outcome {
    let functions = functions(image, args)?;
    Ok(made(image, "COMPOSED", move |machine, args| {
        let functions = functions.clone();
        run(machine, "COMPOSE", |calls| async move {
            let mut args = Args::Many(args);
            for function in functions.iter().rev() {
                args = Args::One([calls.call(function, args).await]);
            }
            match args {
                Args::One([value]) => Ok(value),
                _ => Ok(Value::NIL),
            }
        })
    }))
}

/// Puts given arguments before (or behind) those of a call.
fn partial(image: &mut Image, args: &[Value], behind: bool) -> Outcome {
    let function = callable(image, &args[0])?;
    let given = args[1..].to_vec();
    Ok(made(image, "CURRIED", move |_, mut args| {
        let mut all = given.clone();
        if behind {
            std::mem::swap(&mut all, &mut args);
        }
        all.extend(args);
        Ok(Step::TailCall {
            function: function.clone(),
            args: all,
        })
    }))
}

fn curry(image: &mut Image, args: &[Value]) -> Outcome {
    partial(image, args, false)
}

fn rcurry(image: &mut Image, args: &[Value]) -> Outcome {
    partial(image, args, true)
}

/// A predicate that asks several, until one answers other than `wanted`.
fn joined(image: &mut Image, args: &[Value], all: bool) -> Outcome {
    let functions = functions(image, args)?;
    Ok(made(image, "JOINED", move |machine, args| {
        let functions = functions.clone();
        run(machine, "CONJOIN", |calls| async move {
            let mut value = Value::bool(all);
            for function in &functions {
                value = calls.call(function, Args::Many(args.clone())).await;
                if value.is_true() != all {
                    break;
                }
            }
            Ok(value)
        })
    }))
}

fn conjoin(image: &mut Image, args: &[Value]) -> Outcome {
    joined(image, args, true)
}

fn disjoin(image: &mut Image, args: &[Value]) -> Outcome {
    joined(image, args, false)
}

fn ensure_function(image: &mut Image, args: &[Value]) -> Outcome {
    callable(image, &args[0])
}

fn flatten(_: &mut Image, args: &[Value]) -> Outcome {
    let mut builder = ListBuilder::new();
    let mut pending = vec![args[0].clone()];
    let mut pairs = PairCount::default();
    while let Some(value) = pending.pop() {
        match &value {
            Value::Cons(cons) => {
                pairs.add_one()?;
                pending.push(cons.cdr());
                pending.push(cons.car());
            }
            Value::Symbol(known::NIL) => {}
            _ => builder.push(value),
        }
    }
    Ok(builder.finish())
}

fn drawn(image: &mut Image, count: usize) -> Result<usize, Box<Raise>> {
    let drawn = number::random(&mut image.random, &count.into())?;
    index(&drawn)
}

fn shuffle(image: &mut Image, args: &[Value]) -> Outcome {
    let sequence = Sequence::of(&args[0])?;
    let mut items = sequence.all()?;
    for i in (1..items.len()).rev() {
        let j = drawn(image, i + 1)?;
        items.swap(i, j);
    }
    sequence.set_all(&items)?;
    Ok(args[0].clone())
}

fn empty_sequence(value: &Value) -> Box<Raise> {
    Raise::new(
        known::SIMPLE_TYPE_ERROR,
        "The sequence is empty, so it has no such element.",
    )
    .with(known::K_DATUM, value.clone())
    .with(known::K_EXPECTED_TYPE, known::SEQUENCE.into())
}

fn random_elt(image: &mut Image, args: &[Value]) -> Outcome {
    let sequence = Sequence::of(&args[0])?;
    let count = sequence.len()?;
    if count == 0 {
        return Err(empty_sequence(&args[0]));
    }
    let at = drawn(image, count)?;
    sequence.get(at)
}

fn first_elt(_: &mut Image, args: &[Value]) -> Outcome {
    let sequence = Sequence::of(&args[0])?;
    match sequence.len()? {
        0 => Err(empty_sequence(&args[0])),
        _ => sequence.get(0),
    }
}

fn last_elt(_: &mut Image, args: &[Value]) -> Outcome {
    let sequence = Sequence::of(&args[0])?;
    match sequence.len()?.checked_sub(1) {
        None => Err(empty_sequence(&args[0])),
        Some(last) => sequence.get(last),
    }
}

fn lastcar(_: &mut Image, args: &[Value]) -> Outcome {
    let last = crate::lisp::value::sequence::last_pair(&args[0])?;
    Ok(last.map_or(Value::NIL, |cons| cons.car()))
}

fn emptyp(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(Sequence::of(&args[0])?.len()? == 0))
}

fn length_equal(_: &mut Image, args: &[Value]) -> Outcome {
    let mut lengths = Vec::new();
    for arg in args {
        lengths.push(match arg {
            Value::Int(_) => index(arg)?,
            other => Sequence::of(other)?.len()?,
        });
    }
    Ok(Value::bool(lengths.is_sorted_by(|a, b| a == b)))
}

fn iota(image: &mut Image, args: &[Value]) -> Outcome {
    let [start, step] = keywords::parse(image, &args[1..], [known::K_START, known::K_STEP])?;
    let count = super::lists::size(&args[0])?;
    let step = step.unwrap_or(Value::Int(1));
    let mut value = start.unwrap_or(Value::Int(0));
    // The numbers have one type even if only the step is a float.
    if let Value::Single(_) | Value::Double(_) = step {
        let zero = number::sub(&step, &step)?;
        value = number::add(&value, &zero)?;
    }
    let mut builder = ListBuilder::new();
    for _ in 0..count {
        let next = number::add(&value, &step)?;
        builder.push(std::mem::replace(&mut value, next));
    }
    Ok(builder.finish())
}

fn ensure_list(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(if args[0].is_list() {
        args[0].clone()
    } else {
        Value::list([args[0].clone()])
    })
}

fn ensure_cons(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(match &args[0] {
        Value::Cons(_) => args[0].clone(),
        other => Value::cons(other.clone(), Value::NIL),
    })
}

fn ensure_car(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(match &args[0] {
        Value::Cons(cons) => cons.car(),
        other => other.clone(),
    })
}

fn proper_list_p(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(
        args[0].is_list() && list_length(&args[0]).is_ok(),
    ))
}

fn mappend(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let function = callable(machine.image, &args[0])?;
    let lists: Result<Vec<Vec<Value>>, _> = args[1..].iter().map(list_items).collect();
    let lists = lists?;
    run(machine, "MAPPEND", |calls| async move {
        let count = lists.iter().map(Vec::len).min().unwrap_or(0);
        let mut builder = ListBuilder::new();
        for i in 0..count {
            let args = lists.iter().filter_map(|list| list.get(i).cloned());
            let part = calls.call(&function, Args::Many(args.collect())).await;
            let mut walk = ListWalk::new(part);
            while let Some(item) = walk.next()? {
                builder.push(item);
            }
        }
        Ok(builder.finish())
    })
}

/// The values of a property list and of an association list, as pairs.
fn plist_pairs(plist: &Value) -> Result<Vec<(Value, Value)>, Box<Raise>> {
    let items = list_items(plist)?;
    Ok(items
        .chunks(2)
        .map(|pair| match pair {
            [key, value] => (key.clone(), value.clone()),
            [key] => (key.clone(), Value::NIL),
            _ => (Value::NIL, Value::NIL),
        })
        .collect())
}

fn alist_pairs(alist: &Value) -> Result<Vec<(Value, Value)>, Box<Raise>> {
    let entries = list_items(alist)?;
    Ok(entries
        .iter()
        .filter(|entry| entry.is_true())
        .map(|entry| (entry.car_or_nil(), entry.cdr_or_nil()))
        .collect())
}

fn to_alist(pairs: Vec<(Value, Value)>) -> Value {
    Value::list(
        pairs
            .into_iter()
            .map(|(k, v)| Value::cons(k, v))
            .collect::<Vec<_>>(),
    )
}

fn to_plist(pairs: Vec<(Value, Value)>) -> Value {
    Value::list(
        pairs
            .into_iter()
            .flat_map(|(k, v)| [k, v])
            .collect::<Vec<_>>(),
    )
}

fn plist_alist(_: &mut Image, args: &[Value]) -> Outcome {
    plist_pairs(&args[0]).map(to_alist)
}

fn alist_plist(_: &mut Image, args: &[Value]) -> Outcome {
    alist_pairs(&args[0]).map(to_plist)
}

fn hash_table_plist(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(to_plist(table(&args[0])?.pairs()))
}

/// A table of pairs; the first of several with one key counts.
fn filled(image: &mut Image, pairs: Vec<(Value, Value)>, options: &[Value]) -> Outcome {
    let made = super::hash_tables::make(image, options)?;
    if let Value::Hash(table) = &made {
        for (key, value) in pairs {
            if table.get(&key).is_none() {
                table.insert(key, value);
            }
        }
    }
    Ok(made)
}

fn alist_hash_table(image: &mut Image, args: &[Value]) -> Outcome {
    let pairs = alist_pairs(&args[0])?;
    filled(image, pairs, &args[1..])
}

fn plist_hash_table(image: &mut Image, args: &[Value]) -> Outcome {
    let pairs = plist_pairs(&args[0])?;
    filled(image, pairs, &args[1..])
}

fn copy_hash_table(_: &mut Image, args: &[Value]) -> Outcome {
    let old = table(&args[0])?;
    let copy = HashTable::new(old.test);
    for (key, value) in old.pairs() {
        copy.insert(key, value);
    }
    Ok(Value::Hash(std::rc::Rc::new(copy)))
}

fn remove_from_plist(_: &mut Image, args: &[Value]) -> Outcome {
    let mut pairs = plist_pairs(&args[0])?;
    pairs.retain(|(key, _)| !args[1..].iter().any(|k| k.is_eq(key)));
    Ok(to_plist(pairs))
}

fn make_keyword(image: &mut Image, args: &[Value]) -> Outcome {
    let name = designated(image, &args[0])?;
    Ok(image.keyword(&name).into())
}

fn symbolicate(image: &mut Image, args: &[Value]) -> Outcome {
    let mut name = String::new();
    for part in args {
        name.push_str(&designated(image, part)?);
    }
    let package = image.current_package();
    Ok(image.intern(package, &name).into())
}

fn starts_with_subseq(_: &mut Image, args: &[Value]) -> Outcome {
    let (prefix, whole) = (string(&args[0])?.text(), string(&args[1])?.text());
    Ok(Value::bool(whole.starts_with(&prefix)))
}

fn ends_with_subseq(_: &mut Image, args: &[Value]) -> Outcome {
    let (suffix, whole) = (string(&args[0])?.text(), string(&args[1])?.text());
    Ok(Value::bool(whole.ends_with(&suffix)))
}

async fn end_matches(
    calls: Calls,
    object: Value,
    end: Option<Value>,
    test: Test,
    key: Key,
) -> Outcome {
    let Some(end) = end else {
        return Ok(Value::NIL);
    };
    let end = key.of(&calls, end).await;
    Ok(Value::bool(test.matches(&calls, &end, &object).await))
}

fn end_test(machine: &mut Machine<'_>, args: &[Value], last: bool) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let [test, key] = keywords::parse(image, &args[2..], [known::K_TEST, known::K_KEY])?;
    let (test, key) = (Test::new(image, test, None)?, Key::new(image, key)?);
    let items = Sequence::of(&args[1])?.all()?;
    let end = if last { items.last() } else { items.first() }.cloned();
    let object = args[0].clone();
    run(machine, "STARTS-WITH", |calls| {
        end_matches(calls, object, end, test, key)
    })
}

fn starts_with(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    end_test(machine, &args, false)
}

fn ends_with(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    end_test(machine, &args, true)
}

fn extremum(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let [key] = keywords::parse(image, &args[2..], [known::K_KEY])?;
    let key = Key::new(image, key)?;
    let items = Sequence::of(&args[0])?.all()?;
    let before = callable(image, &args[1])?;
    run(machine, "EXTREMUM", |calls| async move {
        let mut best: Option<(Value, Value)> = None;
        for item in items {
            let candidate = key.of(&calls, item.clone()).await;
            best = match best {
                Some((kept, looked_at)) => {
                    let better = calls.call2(&before, candidate.clone(), looked_at.clone());
                    if better.await.is_true() {
                        Some((item, candidate))
                    } else {
                        Some((kept, looked_at))
                    }
                }
                None => Some((item, candidate)),
            };
        }
        Ok(best.map_or(Value::NIL, |(item, _)| item))
    })
}

fn clamp(_: &mut Image, args: &[Value]) -> Outcome {
    use std::cmp::Ordering;
    let (value, least, most) = (&args[0], &args[1], &args[2]);
    Ok(if number::compare(value, least)? == Some(Ordering::Less) {
        least.clone()
    } else if number::compare(value, most)? == Some(Ordering::Greater) {
        most.clone()
    } else {
        value.clone()
    })
}

fn lerp(_: &mut Image, args: &[Value]) -> Outcome {
    let (way, from, to) = (&args[0], &args[1], &args[2]);
    number::add(from, &number::mul(way, &number::sub(to, from)?)?)
}

fn mean(_: &mut Image, args: &[Value]) -> Outcome {
    let items = Sequence::of(&args[0])?.all()?;
    let mut sum = Value::Int(0);
    for item in &items {
        sum = number::add(&sum, item)?;
    }
    number::div(&sum, &items.len().into())
}

/// Functions.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "COMPOSE",
        "function &rest more",
        "A function that calls the last function, then the one before with the result, and so on.",
        &["(funcall (alexandria:compose #'list #'length) '(a b)) => (2)"],
        compose,
    ),
    pure(
        "CURRY",
        "function &rest arguments",
        "A function that calls another with arguments in front of its own.",
        &["(funcall (alexandria:curry #'list 1 2) 3) => (1 2 3)"],
        curry,
    ),
    pure(
        "RCURRY",
        "function &rest arguments",
        "A function that calls another with arguments behind its own.",
        &["(funcall (alexandria:rcurry #'list 1 2) 3) => (3 1 2)"],
        rcurry,
    ),
    pure(
        "CONJOIN",
        "predicate &rest more",
        "A predicate that is true where all are.",
        &["(funcall (alexandria:conjoin #'symbolp #'null) nil) => T"],
        conjoin,
    ),
    pure(
        "DISJOIN",
        "predicate &rest more",
        "A predicate that is true where one is.",
        &["(funcall (alexandria:disjoin #'consp #'null) nil) => T"],
        disjoin,
    ),
    pure(
        "ENSURE-FUNCTION",
        "designator",
        "The function that a symbol or function means.",
        &["(funcall (alexandria:ensure-function 'car) '(1)) => 1"],
        ensure_function,
    ),
    pure(
        "FLATTEN",
        "tree",
        "The leaves of a tree, without `NIL`.",
        &["(alexandria:flatten '(1 (2 (3 nil)) 4)) => (1 2 3 4)"],
        flatten,
    ),
    pure(
        "SHUFFLE",
        "sequence",
        "Puts the elements of a sequence in random order.",
        &["(length (alexandria:shuffle (list 1 2 3))) => 3"],
        shuffle,
    ),
    pure(
        "RANDOM-ELT",
        "sequence",
        "A random element.",
        &["(alexandria:random-elt '(a)) => A"],
        random_elt,
    ),
    pure(
        "FIRST-ELT",
        "sequence",
        "The first element.",
        &["(alexandria:first-elt \"abc\") => #\\a"],
        first_elt,
    ),
    pure(
        "LAST-ELT",
        "sequence",
        "The last element.",
        &["(alexandria:last-elt '(1 2 3)) => 3"],
        last_elt,
    ),
    pure(
        "LASTCAR",
        "list",
        "The last element of a list, or `NIL`.",
        &["(alexandria:lastcar '(1 2 3)) => 3"],
        lastcar,
    ),
    pure(
        "EMPTYP",
        "sequence",
        "Has the sequence no elements?",
        &["(alexandria:emptyp \"\") => T"],
        emptyp,
    ),
    pure(
        "LENGTH=",
        "sequence &rest more",
        "Are all lengths (or given numbers) the same?",
        &["(alexandria:length= '(a b) 2) => T"],
        length_equal,
    ),
    pure(
        "IOTA",
        "n &key start step",
        "A list of `n` numbers from `start` (0) in steps (1).",
        &[
            "(alexandria:iota 3) => (0 1 2)",
            "(alexandria:iota 3 :start 1 :step 2) => (1 3 5)",
        ],
        iota,
    ),
    pure(
        "ENSURE-LIST",
        "object",
        "The object if it is a list, else a list of it.",
        &["(alexandria:ensure-list 1) => (1)"],
        ensure_list,
    ),
    pure(
        "ENSURE-CONS",
        "object",
        "The object if it is a pair, else a pair of it and `NIL`.",
        &["(alexandria:ensure-cons 1) => (1)"],
        ensure_cons,
    ),
    pure(
        "ENSURE-CAR",
        "object",
        "The car of a pair, else the object.",
        &["(alexandria:ensure-car '(1 2)) => 1"],
        ensure_car,
    ),
    pure(
        "PROPER-LIST-P",
        "object",
        "Is the object a list that ends?",
        &["(alexandria:proper-list-p '(1 . 2)) => NIL"],
        proper_list_p,
    ),
    control(
        "MAPPEND",
        "function list &rest lists",
        "The results of a function for the elements of lists, appended.",
        &["(alexandria:mappend #'list '(1 2) '(a b)) => (1 A 2 B)"],
        mappend,
    ),
    pure(
        "PLIST-ALIST",
        "plist",
        "A property list as association list.",
        &["(alexandria:plist-alist '(:a 1)) => ((:A . 1))"],
        plist_alist,
    ),
    pure(
        "ALIST-PLIST",
        "alist",
        "An association list as property list.",
        &["(alexandria:alist-plist '((:a . 1))) => (:A 1)"],
        alist_plist,
    ),
    pure(
        "HASH-TABLE-PLIST",
        "table",
        "The entries of a table as property list.",
        &["(alexandria:hash-table-plist (make-hash-table)) => NIL"],
        hash_table_plist,
    ),
    pure(
        "ALIST-HASH-TABLE",
        "alist &key test",
        "A hash table of the entries of an association list.",
        &["(gethash 'a (alexandria:alist-hash-table '((a . 1)))) => 1 ; T"],
        alist_hash_table,
    ),
    pure(
        "PLIST-HASH-TABLE",
        "plist &key test",
        "A hash table of the entries of a property list.",
        &["(gethash 'a (alexandria:plist-hash-table '(a 1))) => 1 ; T"],
        plist_hash_table,
    ),
    pure(
        "COPY-HASH-TABLE",
        "table",
        "A copy of a hash table.",
        &["(hash-table-count (alexandria:copy-hash-table (make-hash-table))) => 0"],
        copy_hash_table,
    ),
    pure(
        "REMOVE-FROM-PLIST",
        "plist &rest keys",
        "A property list without some keys.",
        &["(alexandria:remove-from-plist '(:a 1 :b 2) :a) => (:B 2)"],
        remove_from_plist,
    ),
    pure(
        "MAKE-KEYWORD",
        "name",
        "The keyword of a name.",
        &["(alexandria:make-keyword 'foo) => :FOO"],
        make_keyword,
    ),
    pure(
        "SYMBOLICATE",
        "&rest names",
        "The symbol whose name is made of all names.",
        &["(alexandria:symbolicate 'foo '- 'bar) => FOO-BAR"],
        symbolicate,
    ),
    pure(
        "STARTS-WITH-SUBSEQ",
        "prefix string",
        "Does a string start with another?",
        &["(alexandria:starts-with-subseq \"he\" \"hello\") => T"],
        starts_with_subseq,
    ),
    pure(
        "ENDS-WITH-SUBSEQ",
        "suffix string",
        "Does a string end with another?",
        &["(alexandria:ends-with-subseq \"lo\" \"hello\") => T"],
        ends_with_subseq,
    ),
    control(
        "STARTS-WITH",
        "object sequence &key test key",
        "Is the object the first element?",
        &["(alexandria:starts-with 1 '(1 2)) => T"],
        starts_with,
    ),
    control(
        "ENDS-WITH",
        "object sequence &key test key",
        "Is the object the last element?",
        &["(alexandria:ends-with 2 '(1 2)) => T"],
        ends_with,
    ),
    control(
        "EXTREMUM",
        "sequence predicate &key key",
        "The element that would be first after sorting.",
        &["(alexandria:extremum '(3 1 2) #'<) => 1"],
        extremum,
    ),
    pure(
        "CLAMP",
        "number min max",
        "The number, or the bound that it is beyond.",
        &["(alexandria:clamp 11 0 10) => 10"],
        clamp,
    ),
    pure(
        "LERP",
        "way from to",
        "The number at a part of the way between two others.",
        &["(alexandria:lerp 1/2 0 10) => 5"],
        lerp,
    ),
    pure(
        "MEAN",
        "numbers",
        "The mean of a sequence of numbers.",
        &["(alexandria:mean '(1 2 3)) => 2"],
        mean,
    ),
];
