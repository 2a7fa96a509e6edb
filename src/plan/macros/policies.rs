//! Policies: `define-policy` and `with-policy`.

use super::{Expansion, first_rest, gensym, macro_, plan, progn, quoted, thunk, thunk_of};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::{doc_form, form, split_body};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "MAKE-POLICY",
        "name parameters &body parts",
        "A policy of parts (:INIT form…), (:CHECK form…), (:RECOVER form…) and (:CLEAN-UP form…).",
        &["(cpl-impl:name (cpl:make-policy calm () (:check nil))) => CALM"],
        make_policy,
    ),
    macro_(
        "DEFINE-POLICY",
        "name parameters &body parts",
        "Defines a policy and a variable that holds it.",
        &["(cpl-impl:name (cpl:define-policy quiet () (:check nil))) => QUIET"],
        define_policy,
    ),
    macro_(
        "WITH-POLICY",
        "policy (&rest parameters) &body body",
        "Runs the body while the policy's check, made every 10 ms, is NIL; else recovers and fails with POLICY-CHECK-CONDITION-MET.",
        &["(cpl:top-level (cpl:with-policy cpl:timeout-policy (10) :in-time)) => :IN-TIME"],
        with_policy,
    ),
    macro_(
        "WITH-NAMED-POLICY",
        "name (&rest parameters) &body body",
        "WITH-POLICY by the name of the policy.",
        &["(cpl:top-level (cpl:with-named-policy 'cpl:timeout-policy (10) :in-time)) => :IN-TIME"],
        |image, form| {
            let names = plan(image).names;
            let (name, rest) = first_rest(form);
            Ok(form![names.with_policy, form![names.named_policy, name]; rest])
        },
    ),
    macro_(
        "WITH-POLICIES",
        "((policy (&rest parameters))…) &body body",
        "Several policies around a body.",
        &["(cpl:top-level (cpl:with-policies ((cpl:timeout-policy (10))) :in-time)) => :IN-TIME"],
        |image, form| Ok(with_policies(image, form, |_, policy| policy)),
    ),
    macro_(
        "WITH-NAMED-POLICIES",
        "((name (&rest parameters))…) &body body",
        "WITH-POLICIES by the names of the policies.",
        &[
            "(cpl:top-level (cpl:with-named-policies (('cpl:timeout-policy (10))) :in-time)) => :IN-TIME",
        ],
        |image, form| {
            Ok(with_policies(image, form, |image, name| {
                form![plan(image).names.named_policy, name]
            }))
        },
    ),
];

/// How often a check is made, in simulated seconds.
const CHECK_INTERVAL: f64 = 0.01;

fn make_policy(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (name, rest) = first_rest(form);
    let (parameters, parts) = (rest.car_or_nil(), split_body(&rest.cdr_or_nil()));
    let mut functions = Vec::new();
    for kind in [names.init, names.check, names.recover, names.clean_up] {
        let part = parts
            .forms
            .iter_list()
            .find(|part| part.car_or_nil().as_symbol() == Some(kind));
        functions.push(match part {
            Some(part) => part_function(image, &parameters, part.cdr_or_nil()),
            None => Value::NIL,
        });
    }
    if let Some(unknown) = parts.forms.iter_list().find(|part| {
        let kind = part.car_or_nil().as_symbol();
        ![names.init, names.check, names.recover, names.clean_up]
            .iter()
            .any(|k| kind == Some(*k))
    }) {
        let shown = crate::lisp::print::to_string(image, &unknown, true);
        return Err(Raise::program(format!(
            "{shown} is not a part of a policy: :INIT, :CHECK, :RECOVER or :CLEAN-UP was expected."
        )));
    }
    Ok(form![
        names.sys_make_policy,
        quoted(name),
        quoted(parameters),
        doc_form(parts.doc.as_ref());
        Value::list(functions)
    ])
}

/// A function of a storage and the parameters, with `policy-setf` and `policy-get`.
fn part_function(image: &mut Image, parameters: &Value, body: Value) -> Value {
    let names = plan(image).names;
    let storage = gensym(image, "STORAGE");
    let (symbol, value) = (gensym(image, "SYMBOL"), gensym(image, "VALUE"));
    let setter = form![
        names.policy_setf,
        form![symbol.clone(), value.clone()],
        form![names.sys_storage, storage.clone(), symbol.clone(), value],
    ];
    let getter = form![
        names.policy_get,
        form![symbol.clone()],
        form![names.sys_storage, storage.clone(), symbol],
    ];
    form![
        known::LAMBDA,
        form![storage; parameters.clone()],
        form![known::FLET, form![setter, getter]; body],
    ]
}

fn define_policy(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (name, _) = first_rest(form);
    let policy = make_policy(image, form)?;
    Ok(form![
        known::PROGN,
        form![
            known::DEFPARAMETER,
            name.clone(),
            form![names.sys_register_policy, policy],
        ],
        name,
    ])
}

fn with_policy(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (policy_form, rest) = first_rest(form);
    let (parameters, body) = (rest.car_or_nil(), rest.cdr_or_nil());
    let mut symbol = |prefix: &str| gensym(image, prefix);
    let (policy, args, storage) = (symbol("POLICY"), symbol("ARGUMENTS"), symbol("STORAGE"));
    let (is_met, part, again) = (symbol("MET"), symbol("PART"), symbol("AGAIN"));
    let function = |i: i64| form![names.sys_policy_part, policy.clone(), Value::Int(i)];
    let call = form![known::APPLY, part.clone(), storage.clone(), args.clone()];
    // Calls a part, if the policy has it.
    let run = |i: i64, condition: Value, then: Value| {
        form![
            known::LET,
            form![form![part.clone(), function(i)]],
            form![
                known::WHEN,
                form![known::AND, part.clone(), condition],
                then
            ],
        ]
    };
    let failure = |class: Sym| {
        form![
            names.fail,
            quoted(class),
            names.name,
            form![names.sys_policy_name, policy.clone()],
            names.parameters,
            args.clone(),
        ]
    };
    let init = run(
        0,
        Value::T,
        form![
            known::UNLESS,
            call.clone(),
            failure(names.policy_init_failed)
        ],
    );
    let watch = form![
        known::TAGBODY,
        again.clone(),
        form![
            known::UNLESS,
            call.clone(),
            form![names.sleep_star, Value::Double(CHECK_INTERVAL)],
            form![known::GO, again],
        ],
        form![known::SETQ, is_met.clone(), Value::T],
    ];
    let body = thunk(body);
    let guarded = form![
        known::LET,
        form![form![part.clone(), function(1)]],
        form![
            known::IF,
            part.clone(),
            form![names.sys_pursue, thunk_of(watch), body.clone()],
            form![known::FUNCALL, body],
        ],
    ];
    let bindings = form![
        form![policy.clone(), policy_form],
        form![args.clone(), form![known::LIST; parameters]],
        form![storage.clone(), form![names.sys_storage]],
        form![is_met.clone(), Value::NIL],
    ];
    Ok(form![
        known::LET_STAR,
        bindings,
        init,
        form![
            known::UNWIND_PROTECT,
            guarded,
            run(2, is_met.clone(), call.clone()),
            run(3, Value::T, call.clone()),
            form![known::WHEN, is_met, failure(names.policy_met)],
        ],
    ])
}

fn with_policies(image: &mut Image, form: &Value, wrap: impl Fn(&Image, Value) -> Value) -> Value {
    let names = plan(image).names;
    let (policies, body) = first_rest(form);
    let mut result = progn(body);
    let policies: Vec<Value> = policies.iter_list().collect();
    for spec in policies.into_iter().rev() {
        let (parameters, _) = first_rest(&spec);
        let policy = wrap(image, spec.car_or_nil());
        result = form![names.with_policy, policy, parameters, result];
    }
    result
}
