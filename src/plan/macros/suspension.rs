//! Waiting for conditions again and again; suspending tasks.

use super::{Expansion, check_plan, first_rest, gensym, macro_, plan, progn, thunk_of};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::form::form;
use crate::lisp::value::known;

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[
    macro_(
        "WHENEVER",
        "(fluent) &body body",
        "Runs the body each time the fluent's value is not NIL, until (RETURN value).",
        &["(cpl:whenever ((cpl:make-fluent :value 1)) (return 42)) => 42"],
        whenever,
    ),
    macro_(
        "WITH-TASK-SUSPENDED",
        "(task &key reason) &body body",
        "Runs the body while a task holds still.",
        &[],
        with_task_suspended,
    ),
    macro_(
        "ON-SUSPENSION",
        "form &body body",
        "Runs the body; each time the task is suspended meanwhile, runs the form.",
        &["(cpl:top-level (cpl:on-suspension (print :held) :done)) => :DONE"],
        on_suspension,
    ),
    macro_(
        "WITHOUT-SCHEDULING",
        "&body body",
        "Runs the body; the task is not suspended or evaporated while it waits in there.",
        &["(cpl:top-level (cpl:without-scheduling 1)) => 1"],
        |image, form| Ok(scheduling(image, form, -1)),
    ),
    macro_(
        "WITH-SCHEDULING",
        "&body body",
        "Inside WITHOUT-SCHEDULING, allows again that the task is disturbed.",
        &["(cpl:top-level (cpl:without-scheduling (cpl:with-scheduling 1))) => 1"],
        |image, form| Ok(scheduling(image, form, 1)),
    ),
    macro_(
        "RETRY-AFTER-SUSPENSION",
        "&body body",
        "Runs the body. (Tasks hold no locks, so there is nothing to leave on suspension.)",
        &["(cpl:retry-after-suspension 1) => 1"],
        |_, form| Ok(progn(form.cdr_or_nil())),
    ),
];

fn whenever(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (spec, body) = first_rest(form);
    let (fluent, again) = (gensym(image, "FLUENT"), gensym(image, "AGAIN"));
    Ok(form![
        known::BLOCK,
        Value::NIL,
        form![
            known::LET,
            form![form![fluent.clone(), spec.car_or_nil()]],
            form![
                known::TAGBODY,
                again.clone(),
                form![names.wait_for, fluent],
                progn(body),
                form![known::GO, again],
            ],
        ],
    ])
}

fn with_task_suspended(image: &mut Image, form: &Value) -> Expansion {
    let plan = plan(image);
    let names = &plan.names;
    let (spec, body) = first_rest(form);
    let task = gensym(image, "TASK");
    let guarded = form![
        known::PROGN,
        form![names.suspend, task.clone()],
        form![names.sys_wait_until_suspended, task.clone()];
        body
    ];
    Ok(form![
        known::PROGN,
        check_plan(&plan, "WITH-TASK-SUSPENDED"),
        form![
            known::LET,
            form![form![task.clone(), spec.car_or_nil()]],
            form![known::UNWIND_PROTECT, guarded, form![names.wake_up, task],],
        ],
    ])
}

fn on_suspension(image: &mut Image, form: &Value) -> Expansion {
    let names = plan(image).names;
    let (hook, body) = first_rest(form);
    Ok(form![
        known::PROGN,
        form![names.sys_push_hook, thunk_of(hook)],
        form![
            known::UNWIND_PROTECT,
            progn(body),
            form![names.sys_pop_hook],
        ],
    ])
}

fn scheduling(image: &Image, form: &Value, change: i64) -> Value {
    let names = plan(image).names;
    form![
        known::PROGN,
        form![names.sys_scheduling, Value::Int(change)],
        form![
            known::UNWIND_PROTECT,
            progn(form.cdr_or_nil()),
            form![names.sys_scheduling, Value::Int(-change)],
        ],
    ]
}
