//! What is kept of the last plans.

use std::time::Instant;

use crate::journal::{Change, TaskChange};
use crate::task::{Status, TaskId};
use crate::trace::Trace;

fn change(id: u64, status: Status) -> Change {
    Change::Task(TaskChange {
        id: TaskId(id),
        starter: (id > 0).then_some(crate::journal::Starter::Task(TaskId(0))),
        name: format!("TASK-{id}"),
        status,
        failure: None,
        time: id as f64,
    })
}

/// Seconds that it takes to note so many tasks, which end at once or live on.
fn time_of(tasks: u64, do_live: bool) -> f64 {
    let mut trace = Trace::default();
    trace.note(&change(0, Status::Running));
    let begin = Instant::now();
    for id in 1..=tasks {
        trace.note(&change(id, Status::Running));
        if !do_live {
            trace.note(&change(id, Status::Succeeded));
        }
    }
    begin.elapsed().as_secs_f64()
}

/// Each new row once looked at all tasks that were alive, to forget one.
#[test]
fn to_forget_a_row_takes_no_longer_where_many_tasks_are_alive() {
    let (ended, alive) = (time_of(40_000, false), time_of(40_000, true));
    assert!(
        alive < 20.0 * ended,
        "{alive} s, where {ended} s were taken"
    );
}

#[test]
fn a_task_that_outlives_its_row_is_noted_anew() {
    let mut trace = Trace::default();
    for id in 0..30_000 {
        trace.note(&change(id, Status::Running));
    }
    assert!(trace.rows().all(|(_, row)| row.name != "TASK-1"));
    trace.note(&change(1, Status::Succeeded));
    let last = trace
        .rows()
        .last()
        .map(|(_, row)| (row.name.clone(), row.status));
    assert_eq!(last, Some(("TASK-1".to_owned(), Status::Succeeded)));
    // One that has not lost its row is told there.
    trace.note(&change(29_000, Status::Failed));
    let known = trace.rows().filter(|(_, row)| row.name == "TASK-29000");
    assert_eq!(
        known.map(|(_, row)| row.status).collect::<Vec<_>>(),
        [Status::Failed]
    );
}
