//! The macros of the package `ALEXANDRIA`.

use super::forms::{binding, cl, let_form, progn, quoted, split_declarations};
use crate::lisp::builtin::Operator;
use crate::lisp::compile::setf;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

fn call(function: impl Into<Value>, args: impl IntoIterator<Item = Value>) -> Value {
    let args: Vec<Value> = args.into_iter().collect();
    Value::cons(function.into(), Value::list(args))
}

/// The forms after the operator; at least `least`.
fn arguments(form: &Value, least: usize, shape: &str) -> Result<Vec<Value>, Box<Raise>> {
    match form.cdr_or_nil().list_to_vec() {
        Some(forms) if forms.len() >= least => Ok(forms),
        _ => Err(Raise::program(format!("The form is written {shape}."))),
    }
}

/// One binding, or a list of bindings.
fn binding_list(value: &Value, shape: &str) -> Result<Vec<Value>, Box<Raise>> {
    let items = value
        .list_to_vec()
        .ok_or_else(|| Raise::program(format!("The form is written {shape}.")))?;
    match items.first() {
        Some(Value::Symbol(_)) => Ok(vec![value.clone()]),
        _ => Ok(items),
    }
}

fn variables(bindings: &[Value]) -> Vec<Value> {
    bindings.iter().map(Value::car_or_nil).collect()
}

fn if_let(_: &mut Image, form: &Value) -> Outcome {
    let shape = "(IF-LET (BINDING...) THEN [ELSE])";
    let forms = arguments(form, 2, shape)?;
    let bindings = binding_list(&forms[0], shape)?;
    let test = call(known::AND, variables(&bindings));
    let choice = call(known::IF, std::iter::once(test).chain(forms[1..].to_vec()));
    Ok(let_form(bindings, Vec::new(), [choice]))
}

fn when_let(_: &mut Image, form: &Value) -> Outcome {
    let shape = "(WHEN-LET (BINDING...) BODY...)";
    let forms = arguments(form, 1, shape)?;
    let bindings = binding_list(&forms[0], shape)?;
    let test = call(known::AND, variables(&bindings));
    let (declarations, body) = split_declarations(forms[1..].to_vec());
    let choice = call(known::WHEN, std::iter::once(test).chain(body));
    Ok(let_form(bindings, declarations, [choice]))
}

fn when_let_star(_: &mut Image, form: &Value) -> Outcome {
    let shape = "(WHEN-LET* (BINDING...) BODY...)";
    let forms = arguments(form, 1, shape)?;
    let bindings = binding_list(&forms[0], shape)?;
    let mut result = progn(forms[1..].to_vec());
    for one in bindings.into_iter().rev() {
        let test = call(known::WHEN, [one.car_or_nil(), result]);
        result = let_form(vec![one], Vec::new(), [test]);
    }
    Ok(result)
}

fn with_gensyms(image: &mut Image, form: &Value) -> Outcome {
    let shape = "(WITH-GENSYMS (NAME...) BODY...)";
    let forms = arguments(form, 1, shape)?;
    let names = forms[0]
        .list_to_vec()
        .ok_or_else(|| Raise::program(format!("The form is written {shape}.")))?;
    let gensym = cl(image, "GENSYM");
    let mut bindings = Vec::new();
    for name in names {
        let (variable, prefix) = match &name {
            Value::Symbol(sym) => (name.clone(), Value::string(image.name(*sym))),
            pair => (pair.car_or_nil(), pair.cdr_or_nil().car_or_nil()),
        };
        let text = call(cl(image, "STRING"), [prefix]);
        bindings.push(binding(&variable, call(gensym.clone(), [text])));
    }
    let (declarations, body) = split_declarations(forms[1..].to_vec());
    Ok(let_form(bindings, declarations, body))
}

/// Evaluates the body, which makes a form, with each variable standing for a fresh one that
/// the made form binds to what the variable held.
fn once_only(image: &mut Image, form: &Value) -> Outcome {
    let shape = "(ONCE-ONLY (VARIABLE...) BODY...)";
    let forms = arguments(form, 1, shape)?;
    let names = forms[0]
        .list_to_vec()
        .ok_or_else(|| Raise::program(format!("The form is written {shape}.")))?;
    let gensym = cl(image, "GENSYM");
    let mut fresh = Vec::new();
    let mut made = Vec::new();
    let mut inner = Vec::new();
    for name in names {
        let (variable, init) = match &name {
            Value::Symbol(_) => (name.clone(), name.clone()),
            pair => (pair.car_or_nil(), pair.cdr_or_nil().car_or_nil()),
        };
        let holder: Value = image.gensym("ONCE").into();
        fresh.push(binding(&holder, call(gensym.clone(), [])));
        made.push(call(known::LIST, [holder.clone(), init]));
        inner.push(binding(&variable, holder));
    }
    let body = let_form(inner, Vec::new(), forms[1..].to_vec());
    let result = call(
        known::LIST,
        [quoted(known::LET.into()), call(known::LIST, made), body],
    );
    Ok(let_form(fresh, Vec::new(), [result]))
}

/// `(switch (object &key test key) (value form…)… (t form…))`.
fn switch_form(image: &mut Image, form: &Value, otherwise: Option<&str>) -> Outcome {
    let shape = "(SWITCH (OBJECT &KEY TEST KEY) (VALUE FORM...)...)";
    let forms = arguments(form, 1, shape)?;
    let head = forms[0].list_to_vec().unwrap_or_default();
    let Some((object, options)) = head.split_first() else {
        return Err(Raise::program(format!("The form is written {shape}.")));
    };
    let option = |name: &str| {
        options.chunks(2).find_map(|pair| match pair {
            [Value::Symbol(key), value] if image.name(*key) == name => Some(value.clone()),
            _ => None,
        })
    };
    let test = option("TEST").unwrap_or_else(|| call(known::FUNCTION, [known::EQL.into()]));
    let key = option("KEY");
    let value: Value = image.gensym("OBJECT").into();
    let looked_at = match key {
        Some(key) => call(known::FUNCALL, [key, object.clone()]),
        None => object.clone(),
    };
    let mut clauses = Vec::new();
    let mut has_default = false;
    for clause in &forms[1..] {
        let (wanted, body) = (clause.car_or_nil(), clause.cdr_or_nil());
        let condition = match wanted {
            Value::Symbol(known::T | known::OTHERWISE) => {
                has_default = true;
                Value::T
            }
            wanted => call(known::FUNCALL, [test.clone(), value.clone(), wanted]),
        };
        let body = body.list_to_vec().unwrap_or_default();
        clauses.push(Value::list([condition, progn(body)]));
    }
    if let Some(text) = otherwise
        && !has_default
    {
        let error = call(known::ERROR, [Value::string(text), value.clone()]);
        clauses.push(Value::list([Value::T, error]));
    }
    let choice = call(known::COND, clauses);
    Ok(let_form(
        vec![binding(&value, looked_at)],
        Vec::new(),
        [choice],
    ))
}

fn switch(image: &mut Image, form: &Value) -> Outcome {
    switch_form(image, form, None)
}

fn eswitch(image: &mut Image, form: &Value) -> Outcome {
    switch_form(image, form, Some("No clause of ESWITCH matches ~s."))
}

fn doplist(_: &mut Image, form: &Value) -> Outcome {
    let shape = "(DOPLIST (KEY VALUE PLIST [RESULT]) BODY...)";
    let forms = arguments(form, 1, shape)?;
    let head = forms[0].list_to_vec().unwrap_or_default();
    let [key, value, plist, result @ ..] = head.as_slice() else {
        return Err(Raise::program(format!("The form is written {shape}.")));
    };
    let word = |sym| Value::Symbol(sym);
    let by = call(known::FUNCTION, [known::CDDR.into()]);
    let body = call(known::TAGBODY, forms[1..].to_vec());
    let pair = Value::list([key.clone(), value.clone()]);
    let mut clauses = vec![
        word(known::K_FOR),
        pair,
        word(known::K_ON),
        plist.clone(),
        word(known::K_BY),
        by,
        word(known::K_DO),
        body,
    ];
    if let Some(result) = result.first() {
        let done = call(known::RETURN, [result.clone()]);
        clauses.extend([word(known::K_FINALLY), done]);
    }
    Ok(call(known::LOOP, clauses))
}

fn ensure_gethash(image: &mut Image, form: &Value) -> Outcome {
    let forms = arguments(form, 2, "(ENSURE-GETHASH KEY TABLE [DEFAULT])")?;
    let [key, table, value, found] =
        ["KEY", "TABLE", "VALUE", "FOUND"].map(|name| Value::from(image.gensym(name)));
    let place = call(known::GETHASH, [key.clone(), table.clone()]);
    let default = forms.get(2).cloned().unwrap_or(Value::NIL);
    let store = call(known::SETF, [place.clone(), default]);
    let kept = call(known::VALUES, [value.clone(), Value::T]);
    let made = call(known::VALUES, [store, Value::NIL]);
    let choice = call(known::IF, [found.clone(), kept, made]);
    let body = call(
        known::MULTIPLE_VALUE_BIND,
        [Value::list([value, found]), place, choice],
    );
    Ok(let_form(
        vec![
            binding(&key, forms[0].clone()),
            binding(&table, forms[1].clone()),
        ],
        Vec::new(),
        [body],
    ))
}

/// Sets a place to a function of it and of the other forms.
fn modified(
    image: &mut Image,
    form: &Value,
    make: impl FnOnce(&mut Image, Value, Vec<Value>) -> Value,
) -> Outcome {
    let forms = arguments(form, 1, "(OPERATOR PLACE FORM...)")?;
    let rest = forms[1..].to_vec();
    setf::modify(image, &forms[0], Vec::new(), |image, place| {
        make(image, place, rest)
    })
}

/// `(function place form…)`.
fn with_place_first(image: &mut Image, form: &Value, function: &str) -> Outcome {
    modified(image, form, |image, place, rest| {
        call(cl(image, function), std::iter::once(place).chain(rest))
    })
}

fn appendf(image: &mut Image, form: &Value) -> Outcome {
    with_place_first(image, form, "APPEND")
}

fn nconcf(image: &mut Image, form: &Value) -> Outcome {
    with_place_first(image, form, "NCONC")
}

fn unionf(image: &mut Image, form: &Value) -> Outcome {
    with_place_first(image, form, "UNION")
}

fn reversef(image: &mut Image, form: &Value) -> Outcome {
    with_place_first(image, form, "REVERSE")
}

fn maxf(image: &mut Image, form: &Value) -> Outcome {
    with_place_first(image, form, "MAX")
}

fn minf(image: &mut Image, form: &Value) -> Outcome {
    with_place_first(image, form, "MIN")
}

/// `(function item place option…)`.
fn with_item_first(image: &mut Image, form: &Value, function: &str) -> Outcome {
    modified(image, form, |image, place, rest| {
        let mut args = rest;
        let at = args.len().min(1);
        args.insert(at, place);
        call(cl(image, function), args)
    })
}

fn removef(image: &mut Image, form: &Value) -> Outcome {
    with_item_first(image, form, "REMOVE")
}

fn deletef(image: &mut Image, form: &Value) -> Outcome {
    with_item_first(image, form, "DELETE")
}

const fn operator(
    name: &'static str,
    lambda_list: &'static str,
    doc: &'static str,
    examples: &'static [&'static str],
    expand: crate::lisp::builtin::Expander,
) -> Operator {
    Operator {
        name,
        lambda_list,
        doc,
        examples,
        expand: Some(expand),
    }
}

/// Macros.
pub(crate) static OPERATORS: &[Operator] = &[
    operator(
        "IF-LET",
        "bindings then &optional else",
        "Binds variables; evaluates `then` if all are true, else `else`.",
        &["(alexandria:if-let (x 1) (list x) 'none) => (1)"],
        if_let,
    ),
    operator(
        "WHEN-LET",
        "bindings &body body",
        "Binds variables; evaluates the body if all are true.",
        &["(alexandria:when-let ((x 1) (y 2)) (list x y)) => (1 2)"],
        when_let,
    ),
    operator(
        "WHEN-LET*",
        "bindings &body body",
        "Binds variables one after the other; evaluates the body if all are true.",
        &["(alexandria:when-let* ((x 1) (y (list x))) y) => (1)"],
        when_let_star,
    ),
    operator(
        "WITH-GENSYMS",
        "names &body body",
        "Binds each name to a fresh symbol.",
        &["(alexandria:with-gensyms (a b) (eq a b)) => NIL"],
        with_gensyms,
    ),
    operator(
        "WITH-UNIQUE-NAMES",
        "names &body body",
        "Binds each name to a fresh symbol.",
        &["(alexandria:with-unique-names (a b) (eq a b)) => NIL"],
        with_gensyms,
    ),
    operator(
        "ONCE-ONLY",
        "variables &body body",
        "In a macro: lets the expansion evaluate the forms in some variables once.",
        &[
            "(macrolet ((twice (x) (alexandria:once-only (x) `(list ,x ,x)))) (let ((n 0)) (twice (incf n)))) => (1 1)",
        ],
        once_only,
    ),
    operator(
        "SWITCH",
        "(object &key test key) &body clauses",
        "Like `case`, with values that are evaluated and a test of choice.",
        &["(alexandria:switch (\"b\" :test #'equal) (\"a\" 1) (\"b\" 2)) => 2"],
        switch,
    ),
    operator(
        "ESWITCH",
        "(object &key test key) &body clauses",
        "Like `switch`; an error if no clause matches.",
        &["(alexandria:eswitch (1) (1 'one)) => ONE"],
        eswitch,
    ),
    operator(
        "DOPLIST",
        "(key value plist &optional result) &body body",
        "Evaluates the body for each entry of a property list.",
        &[
            "(let (r) (alexandria:doplist (k v '(:a 1 :b 2) r) (push (list k v) r))) => ((:B 2) (:A 1))",
        ],
        doplist,
    ),
    operator(
        "ENSURE-GETHASH",
        "key table &optional default",
        "The value of a key; a key that is missing gets the default.",
        &["(alexandria:ensure-gethash 'a (make-hash-table) 1) => 1 ; NIL"],
        ensure_gethash,
    ),
    operator(
        "APPENDF",
        "place &rest lists",
        "Appends lists to a place.",
        &["(let ((l (list 1))) (alexandria:appendf l '(2)) l) => (1 2)"],
        appendf,
    ),
    operator(
        "NCONCF",
        "place &rest lists",
        "Joins lists to a place.",
        &["(let ((l (list 1))) (alexandria:nconcf l (list 2)) l) => (1 2)"],
        nconcf,
    ),
    operator(
        "UNIONF",
        "place list &rest options",
        "Sets a place to the union with a list.",
        &["(let ((l (list 1))) (alexandria:unionf l '(1)) l) => (1)"],
        unionf,
    ),
    operator(
        "REVERSEF",
        "place",
        "Reverses the sequence in a place.",
        &["(let ((l (list 1 2))) (alexandria:reversef l) l) => (2 1)"],
        reversef,
    ),
    operator(
        "MAXF",
        "place &rest numbers",
        "Sets a place to the largest of it and numbers.",
        &["(let ((n 1)) (alexandria:maxf n 3 2) n) => 3"],
        maxf,
    ),
    operator(
        "MINF",
        "place &rest numbers",
        "Sets a place to the smallest of it and numbers.",
        &["(let ((n 5)) (alexandria:minf n 3 4) n) => 3"],
        minf,
    ),
    operator(
        "REMOVEF",
        "place item &rest options",
        "Removes an item from the sequence in a place.",
        &["(let ((l (list 1 2))) (alexandria:removef l 1) l) => (2)"],
        removef,
    ),
    operator(
        "DELETEF",
        "place item &rest options",
        "Deletes an item from the sequence in a place.",
        &["(let ((l (list 1 2))) (alexandria:deletef l 1) l) => (2)"],
        deletef,
    ),
];
