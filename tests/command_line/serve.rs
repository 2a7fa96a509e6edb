//! The tools for assistants as plain lines of JSON.

use serde_json::{Value, json};

use crate::json_lines::Client;

#[test]
fn the_tools_are_told_and_each_schema_says_what_it_takes() {
    let mut client = Client::new(&[]);
    let answer = client.ask("tools", json!({}));
    let tools = answer["data"]["tools"].as_array().expect("a list");
    let names: Vec<&str> = tools
        .iter()
        .filter_map(|tool| tool["name"].as_str())
        .collect();
    assert!(
        names.contains(&"compare_plans") && names.contains(&"check_plan"),
        "{names:?}"
    );
    for tool in tools {
        assert_eq!(tool["inputSchema"]["additionalProperties"], false, "{tool}");
        let required = tool["inputSchema"]["required"].as_array().expect("a list");
        // What is required is asked for.
        if !required.is_empty() {
            let name = tool["name"].as_str().expect("a name");
            let answer = client.ask(name, json!({}));
            assert_eq!(answer["is_error"], true, "{answer}");
            let text = answer["text"].as_str().expect("a text");
            assert!(text.contains("is missing"), "{answer}");
        }
    }
    assert_eq!(client.end(), Some(0));
}

#[test]
fn findings_have_suggestions_as_data() {
    let mut client = Client::new(&[]);
    let plan = "; a\n(with-simulated-robot (perform (an action (type 'waitng) (duraton 1)))\n";
    let answer = client.ask("check_plan", json!({"plan": plan}));
    assert_eq!(
        answer["data"]["findings"][0]["suggestion"],
        json!({"line": 2, "column": 71, "wrong": "", "replacement": ")"}),
        "{answer}"
    );
    let plan = plan.trim_end().to_owned() + ")";
    let answer = client.ask("check_plan", json!({"plan": plan}));
    assert_eq!(
        answer["data"]["findings"][0]["suggestion"],
        json!({"line": 2, "column": 49, "wrong": "'waitng", "replacement": "waitng"}),
        "{answer}"
    );
    let plan = plan.replace("'waitng", "waitng");
    let answer = client.ask("check_plan", json!({"plan": plan}));
    assert_eq!(
        answer["data"]["findings"][0]["suggestion"],
        json!({"line": 2, "column": 49, "wrong": "waitng", "replacement": "waiting"}),
        "{answer}"
    );
    // What a plan has defined in the world at hand is known if that is asked for.
    client.ask(
        "run_plan",
        json!({"plan": "(defun helper () 1)", "view": "none"}),
    );
    let calling = json!({"plan": "(print (helper))"});
    let answer = client.ask("check_plan", calling);
    assert_eq!(
        answer["data"]["findings"].as_array().map(Vec::len),
        Some(1),
        "{answer}"
    );
    let calling = json!({"plan": "(print (helper))", "in": "continue"});
    let answer = client.ask("check_plan", calling);
    assert_eq!(answer["text"], "No mistakes were found.", "{answer}");
    assert_eq!(client.end(), Some(0));
}

/// An explanation is that of a failure in the run, not of one before it.
#[test]
fn a_failure_of_an_earlier_run_is_not_explained_again() {
    let mut client = Client::new(&[]);
    let stuck = "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 5))))";
    let mut run = |plan: &str| {
        client.ask(
            "run_plan",
            json!({"plan": plan, "in": "continue", "view": "none"}),
        )
    };
    let failed = run(stuck);
    let explanation = failed["data"]["explanation"].as_str().expect("a text");
    assert!(explanation.contains("TORSO-GOAL-NOT-REACHED"), "{failed}");
    assert_eq!(run("(car 5)")["data"]["explanation"], "");
    assert_eq!(client.end(), Some(0));
}

#[test]
fn two_plans_are_compared_in_the_same_worlds() {
    let sweep = |bound: f64, more: &str| {
        format!(
            "(defsweep s () (vary (x (uniform 0 1)) {more}) (run (when (< x {bound}) (error 'end-of-file))) (expect (a t)))"
        )
    };
    let mut client = Client::new(&[]);
    let arguments = json!({"first": sweep(0.5, ""), "second": sweep(0.2, ""), "worlds": 30});
    let answer = client.ask("compare_plans", arguments.clone());
    assert_eq!(answer["is_error"], false, "{answer}");
    let data = &answer["data"];
    let unlike = data["unlike"].as_array().expect("a list");
    let rate = |name: &str| data["rates"][name].as_f64().expect("a number");
    assert!(rate("second") > rate("first"), "{answer}");
    let gained = ((rate("second") - rate("first")) * 30.0).round() as usize;
    assert_eq!(unlike.len(), gained);
    for world in unlike {
        assert_eq!(world["first"]["class"], "END-OF-FILE", "{world}");
        assert_eq!(world["second"]["outcome"], "success", "{world}");
    }
    assert_eq!(data["have_same_draws"], true);
    let text = answer["text"].as_str().expect("a text");
    assert!(
        text.contains("30 worlds in both") && text.contains("first failure END-OF-FILE"),
        "{text}"
    );
    // The same question has the same answer.
    let again = client.ask("compare_plans", arguments);
    assert_eq!(again["data"], answer["data"]);
    let other = sweep(0.2, "").replace("(x (uniform 0 1))", "(x (uniform 0 2))");
    let answer = client.ask(
        "compare_plans",
        json!({"first": sweep(0.5, ""), "second": other, "worlds": 3}),
    );
    assert!(
        answer["text"]
            .as_str()
            .expect("a text")
            .contains("The worlds are not the same"),
        "{answer}"
    );
    for (second, why) in [
        ("(+ 1 2)", "the plan second: second defines no sweep"),
        ("(defsweep s () (run (car 5)", "the plan second: second:1:"),
        ("(loop)", "the plan second: "),
    ] {
        let answer = client.ask(
            "compare_plans",
            json!({"first": sweep(0.5, ""), "second": second, "worlds": 3, "real_seconds": 3}),
        );
        assert_eq!(answer["is_error"], true, "{answer}");
        assert!(
            answer["text"].as_str().expect("a text").starts_with(why),
            "{answer}"
        );
    }
    assert_eq!(client.end(), Some(0));
}

#[test]
fn documents_are_read_by_name() {
    let mut client = Client::new(&[]);
    let all = client.ask("read_document", json!({}));
    assert!(
        all["text"]
            .as_str()
            .expect("a text")
            .contains("plans/lessons/see-more.lesson"),
        "{all}"
    );
    let lesson = client.ask(
        "read_document",
        json!({"name": "plans/lessons/see-more.lesson"}),
    );
    assert!(
        lesson["text"]
            .as_str()
            .expect("a text")
            .contains("(deflesson see-more"),
        "{lesson}"
    );
    for (name, said) in [
        ("tutoral", "did you mean tutorial?"),
        ("/etc/passwd", "there is no document /etc/passwd"),
        ("../Cargo.toml", "there is no document"),
    ] {
        let answer = client.ask("read_document", json!({"name": name}));
        assert_eq!(answer["is_error"], true, "{answer}");
        assert!(
            answer["text"].as_str().expect("a text").contains(said),
            "{answer}"
        );
    }
    assert_eq!(client.end(), Some(0));
}

#[test]
fn lines_that_are_no_requests_are_answered_by_errors() {
    let mut client = Client::new(&[]);
    let long = [b"\"".to_vec(), vec![b'x'; 9 << 20], b"\"".to_vec()].concat();
    let deep = "[".repeat(100_000).into_bytes();
    for (line, id, said) in [
        (b"{\"id\": 1".to_vec(), Value::Null, "this is no JSON"),
        (b"\xff\xfe".to_vec(), Value::Null, "this is no JSON"),
        (b"[]".to_vec(), Value::Null, "a request is an object"),
        (b"{}".to_vec(), Value::Null, "tool is missing"),
        (
            b"{\"id\": \"a\", \"tool\": 5}".to_vec(),
            json!("a"),
            "tool is missing",
        ),
        (
            b"{\"id\": {}, \"tool\": \"tools\"}".to_vec(),
            Value::Null,
            "an id is",
        ),
        (
            b"{\"id\": 2, \"tol\": \"tools\"}".to_vec(),
            json!(2),
            "did you mean tool?",
        ),
        (
            b"{\"id\": 2, \"tool\": \"check_pln\"}".to_vec(),
            json!(2),
            "did you mean check_plan?",
        ),
        (
            b"{\"id\": 2, \"tool\": \"look\"}".to_vec(),
            json!(2),
            "there is no tool look",
        ),
        (long, Value::Null, "bytes at most"),
        (deep, Value::Null, "this is no JSON"),
        (
            b"{\"id\": 3, \"tool\": \"describe\", \"arguments\": []}".to_vec(),
            json!(3),
            "arguments are an object",
        ),
    ] {
        let answer = client.send(&line);
        assert_eq!(answer["is_error"], true, "{answer}");
        assert_eq!(answer["id"], id, "{answer}");
        assert!(
            answer["text"].as_str().expect("a text").contains(said),
            "{said}: {answer}"
        );
    }
    // An id that repeats is the client's affair.
    for _ in 0..2 {
        let answer =
            client.send(b"{\"id\": 2, \"tool\": \"describe\", \"arguments\": {\"name\": \"car\"}}");
        assert_eq!(
            (&answer["id"], &answer["is_error"]),
            (&json!(2), &json!(false))
        );
    }
    assert_eq!(client.end(), Some(0));
}

#[cfg(unix)]
#[test]
fn a_client_that_goes_in_the_middle_ends_the_program_quietly() {
    use std::io::Write;
    use std::process::{Command, Stdio};

    let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["serve", "--stdio"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    drop(child.stdout.take());
    let mut input = child.stdin.take().expect("it has one");
    input
        .write_all(b"{\"id\": 1, \"tool\": \"tools\"}\n{\"id\": 2, \"tool\":")
        .expect("it reads");
    drop(input);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
