//! Questions to the past: what plans have performed, when, and what came of it.

use super::said;
use serde_json::Value;
use session::{Session, SessionOptions};

fn session() -> Session {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    said(
        &mut session,
        "(in-package :pp-tut)
         (defun answers (variable goal)
           (mapcar (lambda (answer) (cut:var-value variable answer))
                   (cut:force-ll (prolog:prolog goal))))",
    );
    session
}

#[test]
fn tasks_of_par_pursue_and_retries_are_there_with_their_outcomes() {
    let mut session = session();
    said(
        &mut session,
        "(cpl:top-level
           (cpl:with-retry-counters ((tries 3))
             (cpl:with-failure-handling
                 ((cpl:simple-plan-failure (failure)
                    (declare (ignore failure))
                    (cpl:do-retry tries (cpl:retry))
                    (return nil)))
               (cpl:par-loop (number '(1 2 3 4))
                 (cpl:sleep number))
               (cpl:pursue (cpl:sleep 1) (cpl:sleep 5))
               (cpl:fail 'cpl:simple-plan-failure))))",
    );
    for (question, answer) in [
        // Each of four tries has four tasks of PAR, and PURSUE with a winner and a loser.
        (
            "(count :succeeded (answers '?o '(and (coe:task-of-top-level :top-level ?t) (coe:task-outcome ?t ?o))))",
            "20",
        ),
        (
            "(count :evaporated (answers '?o '(and (coe:task ?t) (coe:task-outcome ?t ?o))))",
            "4",
        ),
        (
            "(reduce #'max (answers '?d '(and (coe:subtask :top ?t) (coe:task-duration ?t ?d))) :initial-value 0)",
            ":TOP is no task: a task is the number that (coe:task ?t) tells.",
        ),
        (
            "(answers '?d '(and (coe:top-level ?top) (coe:task-outcome ?top :succeeded) (coe:task-duration ?top ?d)))",
            "(20.0d0)",
        ),
        (
            "(let ((all (answers '?t '(coe:task ?t))))
               (every (lambda (task)
                        (or (answers '?p `(coe:subtask ?p ,task)) (answers '?x `(coe:top-level ,task))))
                      all))",
            "T",
        ),
        (
            "(let ((first (first (answers '?t '(and (coe:top-level ?top) (coe:subtask ?top ?t))))))
               (answers '?n `(and (coe:task-next-sibling ,first ?next) (coe:task-previous-sibling ?next ?n))))",
            "(1)",
        ),
        ("(answers '?t '(coe:task 100000))", "NIL"),
        ("(answers '?t '(coe:task-error ?t ?e))", "NIL"),
    ] {
        assert_eq!(said(&mut session, question), answer, "{question}");
    }
}

#[test]
fn the_last_ten_plans_are_remembered() {
    let mut session = session();
    for _ in 0..14 {
        said(
            &mut session,
            "(cpl:top-level (cpl:par (cpl:sleep 1) (cpl:sleep 2)))",
        );
    }
    for (question, answer) in [
        ("(length (answers '?t '(coe:top-level ?t)))", "10"),
        ("(length (answers '?t '(coe:task ?t)))", "30"),
        (
            "(equal (answers '?t '(coe:top-level-task :top-level ?t)) (last (answers '?t '(coe:top-level ?t))))",
            "T",
        ),
        (
            "(progn (cet:disable-fluent-tracing) (cpl:top-level (cpl:sleep 1)) (cet:fluent-tracing-enabled))",
            "NIL",
        ),
        ("(length (answers '?t '(coe:top-level ?t)))", "10"),
    ] {
        assert_eq!(said(&mut session, question), answer, "{question}");
    }
}

#[test]
fn an_interrupted_or_failed_plan_is_told_as_such() {
    let mut session = session();
    said(
        &mut session,
        "(cpl:top-level (cpl:par (cpl:sleep 3) (cpl:fail 'cpl:simple-plan-failure)))",
    );
    for (question, answer) in [
        (
            "(answers '?o '(and (coe:top-level ?t) (coe:task-outcome ?t ?o)))",
            "(:FAILED)",
        ),
        (
            "(answers '?c '(and (coe:top-level ?t) (coe:task-error ?t ?e) (coe:error-type ?e ?c)))",
            "(CRAM-LANGUAGE-IMPLEMENTATION:SIMPLE-PLAN-FAILURE)",
        ),
        (
            "(remove-duplicates (answers '?s '(coe:task-status ?t ?s)))",
            "(:EVAPORATED :FAILED)",
        ),
    ] {
        assert_eq!(said(&mut session, question), answer, "{question}");
    }
}

/// The lines of a file of an episode.
fn lines(folder: &str, name: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(format!("{folder}/{name}.jsonl")).expect("it was written");
    let lines = text.lines().map(serde_json::from_str);
    lines.collect::<Result<_, _>>().expect("each line is JSON")
}

#[test]
fn an_episode_says_the_same_as_the_questions() {
    let folder = std::env::temp_dir().join(format!("planwright-episode-{}", std::process::id()));
    let folder = folder.to_str().expect("the name is text");
    let mut session = session();
    said(
        &mut session,
        "(cpl:top-level
           (cpl:with-failure-handling
               ((common-fail:perception-object-not-found (failure)
                  (declare (ignore failure))
                  (return nil)))
             (exe:perform (desig:an action (type detecting) (object (desig:an object (type spoon)))))))",
    );
    let count = said(&mut session, &format!("(pw:export-episode {folder:?})"));
    let tasks = lines(folder, "task");
    assert_eq!(tasks.len().to_string(), count);
    assert_eq!(
        said(&mut session, "(length (answers '?t '(coe:task ?t)))"),
        count
    );
    for (number, task) in tasks.iter().enumerate() {
        assert_eq!(task["task"], number);
        let parent = task["parent"].as_u64();
        assert_eq!(parent.is_none(), task["kind"] == "top-level", "{task}");
        assert!(task["ended"].as_f64() >= task["started"].as_f64(), "{task}");
    }
    let failed = said(
        &mut session,
        "(length (answers '?t '(coe:task-outcome ?t :failed)))",
    );
    let failures = lines(folder, "failure");
    assert_eq!(failures.len().to_string(), failed);
    assert!(!failures.is_empty());
    assert!(
        failures
            .iter()
            .all(|one| one["class"] == "perception-object-not-found")
    );
    let keys: Vec<Value> = lines(folder, "param");
    assert!(
        keys.iter()
            .any(|one| one["key"] == "type" && one["text"] == "DETECTING")
    );
    // The relations say the same of the last plans and of the files.
    for (goal, variable) in [
        ("(fact task :task ?t :type :detecting)", "?t"),
        ("(fact task :parent 0 :status ?s)", "?s"),
        ("(fact failure :class ?c)", "?c"),
        ("(fact param :key :type :text ?x)", "?x"),
    ] {
        let question = format!("(answers '{variable} '{goal})");
        said(&mut session, "(pw:read-facts)");
        let lived = said(&mut session, &question);
        assert_ne!(lived, "NIL", "{goal}");
        said(&mut session, &format!("(pw:read-facts {folder:?})"));
        assert_eq!(said(&mut session, &question), lived, "{goal}");
    }
    assert_eq!(
        said(
            &mut session,
            "(equal (answers '?t '(fact task :task ?t :kind :performed))
                    (answers '?t '(coe:goal-task ?t)))",
        ),
        "T"
    );
    let odd = said(
        &mut session,
        r#"(coe::json-string (format nil "a \"b\" \\ ~c ~c é" #\tab #\rubout))"#,
    );
    let odd: String = serde_json::from_str(&odd).expect("it prints as a string");
    let odd: String = serde_json::from_str(&odd).expect("it is a string of JSON");
    assert_eq!(odd, "a \"b\" \\ \t \u{7f} é");
    std::fs::remove_dir_all(folder).expect("the folder is there");
}
