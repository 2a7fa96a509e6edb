//! The execution trace, for the part of it that is written in Lisp.

use crate::state::Plan;
use crate::task::Status;
use crate::trace::{Row, RowKind};
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;

/// The numbers of all rows of the trace, in order of creation.
#[builtin("%TRACE-ROWS")]
fn trace_rows(image: &mut Image) -> Value {
    let plan = Plan::of(image);
    let trace = plan.journal.trace();
    let numbers = trace.rows().map(|(number, _)| integer(number));
    Value::list(numbers.collect::<Vec<_>>())
}

/// The numbers of the rows of which a row is the parent, in order of creation.
#[builtin("%TRACE-PARTS")]
fn trace_parts(image: &mut Image, number: usize) -> Value {
    let plan = Plan::of(image);
    let trace = plan.journal.trace();
    let parts = trace.rows().filter(|(_, row)| row.parent == Some(number));
    let numbers = parts.map(|(number, _)| integer(number));
    Value::list(numbers.collect::<Vec<_>>())
}

/// A row of the trace: number, kind, number of the parent, name, designator, times (s) at which it was
/// created, began and ended, status, and value or failure; NIL if there is none of that number.
#[builtin("%TRACE-ROW")]
fn trace_row(image: &mut Image, number: usize) -> Value {
    let plan = Plan::of(image);
    let trace = plan.journal.trace();
    trace
        .row(number)
        .map_or(Value::NIL, |row| listed(image, number, row))
}

/// FILE:LINE:COLUMN where a row of the trace was performed, or NIL.
#[builtin("%TRACE-PLACE")]
fn trace_place(image: &mut Image, number: usize) -> Value {
    let plan = Plan::of(image);
    let place = plan.journal.trace().row(number).map(|row| row.place);
    let location = place.and_then(|place| image.sources.locate(place));
    location.map_or(Value::NIL, |location| Value::string(location.to_string()))
}

/// Switches the execution trace on or off; was it on?
#[builtin("%SET-TRACES")]
fn set_traces(image: &mut Image, traces: bool) -> bool {
    let plan = Plan::of(image);
    let before = plan.journal.traces();
    plan.journal.set_traces(traces);
    before
}

/// Is the execution trace switched on?
#[builtin("%TRACES-P")]
fn traces_p(image: &mut Image) -> bool {
    Plan::of(image).journal.traces()
}

fn listed(image: &mut Image, number: usize, row: &Row) -> Value {
    let keyword = |image: &mut Image, name| Value::from(image.keyword(name));
    let kind = match row.kind {
        RowKind::TopLevel => "TOP-LEVEL",
        RowKind::Task => "TASK",
        RowKind::Performed => "PERFORMED",
    };
    let status = match row.status {
        Status::Created => "CREATED",
        Status::Running => "RUNNING",
        Status::Suspended => "SUSPENDED",
        Status::Succeeded => "SUCCEEDED",
        Status::Failed => "FAILED",
        Status::Evaporated => "EVAPORATED",
    };
    let time = |time: Option<f64>| time.map_or(Value::NIL, Value::Double);
    Value::list([
        integer(number),
        keyword(image, kind),
        row.parent.map_or(Value::NIL, integer),
        Value::string(row.name.as_str()),
        row.designator.clone(),
        Value::Double(row.created),
        time(row.started),
        time(row.ended),
        keyword(image, status),
        row.result.clone(),
    ])
}

fn integer(number: usize) -> Value {
    Value::Int(i64::try_from(number).unwrap_or(i64::MAX))
}

/// Builtins of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    trace_rows,
    trace_parts,
    trace_row,
    trace_place,
    set_traces,
    traces_p,
];
