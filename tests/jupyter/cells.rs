//! What cells do.

use serde_json::json;

use super::client::{Client, start, start_at};

#[test]
fn a_cell_has_output_and_a_value() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let answer = client.run("(format t \"one~%\") (+ 1 2)");
    let kinds: Vec<&str> = answer.messages.iter().map(|m| m.kind.as_str()).collect();
    assert_eq!(
        kinds,
        [
            "status",
            "execute_input",
            "stream",
            "execute_result",
            "status"
        ]
    );
    assert_eq!(
        (answer.text().as_str(), answer.value()),
        ("one\n", Some("3"))
    );
    assert_eq!(answer.reply["status"], json!("ok"));
    assert_eq!(answer.reply["execution_count"], json!(1));
}

#[test]
fn what_is_written_about_errors_is_a_stream_of_its_own() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let answer = client.run(
        "(format t \"one~%\") (format *error-output* \"two~%\") (warn \"three\") (format t \"four~%\")",
    );
    let streams: Vec<(&str, &str)> = answer
        .of("stream")
        .into_iter()
        .filter_map(|content| Some((content["name"].as_str()?, content["text"].as_str()?)))
        .collect();
    assert_eq!(
        streams,
        [
            ("stdout", "one\n"),
            ("stderr", "two\nWARNING: three\n"),
            ("stdout", "four\n")
        ]
    );
}

#[test]
fn a_condition_that_nobody_answers_ends_the_cell_as_in_a_transcript() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let answer = client.run("(list\n (car 1))");
    let error = answer.of("error")[0];
    assert_eq!(error["ename"], json!("TYPE-ERROR"));
    let lines = error["traceback"].as_array().expect("lines");
    let [.., place, last] = lines.as_slice() else {
        panic!("lines are missing: {lines:?}");
    };
    assert_eq!(*place, json!("; at line 2, column 2"));
    let last = last.as_str().expect("a text");
    assert!(last.starts_with("; Evaluation aborted on #<TYPE-ERROR"));
    assert_eq!(answer.reply["status"], json!("error"));
}

#[test]
fn a_restart_with_a_value_asks_whoever_has_chosen_it() {
    let kernel = start();
    let mut other = Client::new(&kernel, "b");
    let mut client = Client::new(&kernel, "a");
    let name = client.send(
        "(list (restart-case (error \"no\") (use-value (v) v)))",
        true,
    );
    let stopped = client.wait(&name);
    assert_eq!(stopped.reply["status"], json!("error"));
    let name = client.send("0", true);
    assert_eq!(client.answer("(* 6 7)"), "value: ");
    assert_eq!(client.wait(&name).value(), Some("(42)"));
    assert_eq!(other.run("1").value(), Some("1"));
}

#[test]
fn the_form_to_edit_is_offered_as_the_next_cell() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let name = client.send("(car 1)", true);
    client.wait(&name);
    let name = client.send(":edit", true);
    let answer = client.wait(&name);
    let wanted = json!([{"source": "set_next_input", "text": "(car 1)", "replace": false}]);
    assert_eq!(answer.reply["payload"], wanted);
    let name = client.send("(car '(1))", true);
    assert_eq!(client.wait(&name).value(), Some("1"));
}

#[test]
fn an_interrupt_ends_a_cell_and_leaves_out_those_that_wait() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let first = client.send("(loop)", false);
    let second = client.send("(+ 1 2)", false);
    client.wait_for(&first, "execute_input");
    // Only what waits is left out.
    client.wait_until_read();
    assert_eq!(client.control("interrupt_request"), json!({"status": "ok"}));
    let answer = client.wait(&first);
    assert_eq!(answer.of("error")[0]["ename"], json!("INTERRUPT"));
    assert_eq!(client.wait(&second).reply["status"], json!("aborted"));
    assert_eq!(client.run("(+ 3 4)").value(), Some("7"));
    // One that comes when nothing runs has no effect.
    client.control("interrupt_request");
    assert_eq!(client.run("(loop repeat 100000)").value(), Some("NIL"));
}

#[test]
fn a_kernel_ends_when_it_is_told_and_another_begins_at_its_ports() {
    let mut kernel = start();
    let mut client = Client::new(&kernel, "a");
    client.send("(unwind-protect (loop) (print :cleaned))", false);
    let answer = client.control("shutdown_request");
    assert_eq!(answer, json!({"status": "ok", "restart": true}));
    assert_eq!(kernel.end(), 0);
    let ports: Vec<u16> = kernel.addresses.iter().map(|a| a.port()).collect();
    let again = start_at(ports.try_into().expect("five ports"));
    assert_eq!(Client::new(&again, "a").run("(+ 1 2)").value(), Some("3"));
}

#[test]
fn a_sweep_shows_a_table_and_where_it_works() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let sweep = "(pw:defsweep tried (:worlds 12)
                   (vary (x (uniform 0.0 1.0)) (y (uniform 0.0 1.0)))
                   (run (when (> x 0.5) (error \"<too far>\"))))
                 (pw:sweep 'tried)";
    let answer = client.run(sweep);
    let shown = answer.of("display_data");
    let html = shown[0]["data"]["text/html"].as_str().expect("a table");
    assert!(html.contains("<td>SIMPLE-ERROR</td>"), "{html}");
    assert!(shown[1]["data"]["image/png"].is_string());
    assert!(answer.text().contains("success"), "{}", answer.text());
}

#[test]
fn a_lesson_goes_on_from_cell_to_cell() {
    let kernel = start();
    let mut client = Client::new(&kernel, "a");
    let begun = client.run("(lesson 'bring-the-bottle)");
    assert!(
        begun.text().contains("Step 1 of 4: Pick the bottle up."),
        "{}",
        begun.text()
    );
    assert!(client.run("(hint)").text().starts_with("Hint 1 of 3: "));
    // What is typed does not count.
    assert_eq!(
        client
            .run("(princ \"; Done: Pick the bottle up.\")")
            .text()
            .matches("Step")
            .count(),
        0
    );
    let answer = client.run(
        "(with-simulated-robot
           (get-ready-at *place-at-table*)
           (pick-up-object (find-object :bottle) :right))",
    );
    let text = answer.text();
    assert!(
        text.contains("; Done: Pick the bottle up.\nStep 2 of 4: "),
        "{text}"
    );
}

#[test]
fn a_program_may_exit() {
    let mut kernel = start();
    let mut client = Client::new(&kernel, "a");
    let answer = client.run("(quit 3)");
    assert_eq!(answer.reply["payload"][0]["source"], json!("ask_exit"));
    assert_eq!(kernel.end(), 3);
}
