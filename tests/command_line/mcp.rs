//! The door for assistants: a client that writes requests and reads answers, one on a line.

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

/// The answers to lines, each by its own number; lines that are not UTF-8 may be among them.
fn answers(arguments: &[&str], lines: &[Vec<u8>]) -> Vec<Value> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .arg("mcp")
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs");
    let mut input = child.stdin.take().expect("it has one");
    let lines = lines.to_vec();
    let writer = std::thread::spawn(move || {
        for line in lines {
            input.write_all(&line).expect("it reads");
            input.write_all(b"\n").expect("it reads");
        }
    });
    let output = child.wait_with_output().expect("it ends");
    writer.join().expect("it has written");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    let text = String::from_utf8(output.stdout).expect("it is text");
    let answers = text
        .lines()
        .map(|line| serde_json::from_str(line).expect(line));
    answers.collect()
}

fn request(id: u64, method: &str, parameters: Value) -> Vec<u8> {
    json!({"jsonrpc": "2.0", "id": id, "method": method, "params": parameters})
        .to_string()
        .into_bytes()
}

fn initialize() -> Vec<u8> {
    let parameters = json!({
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "test", "version": "1"},
    });
    request(0, "initialize", parameters)
}

/// The results of calls of tools, in order.
fn called(arguments: &[&str], calls: &[(&str, Value)]) -> Vec<Value> {
    let mut lines = vec![
        initialize(),
        b"{\"jsonrpc\":\"2.0\",\"method\":\"notifications/initialized\"}".to_vec(),
    ];
    for (at, (name, given)) in calls.iter().enumerate() {
        let parameters = json!({"name": name, "arguments": given});
        lines.push(request(at as u64 + 1, "tools/call", parameters));
    }
    let answers = answers(arguments, &lines);
    assert_eq!(answers.len(), calls.len() + 1);
    answers[1..]
        .iter()
        .map(|answer| answer["result"].clone())
        .collect()
}

fn text(result: &Value) -> &str {
    result["content"][0]["text"]
        .as_str()
        .expect("there is text")
}

#[test]
fn each_tool_does_what_it_says() {
    let spawn = "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))";
    let lift = "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.3))))";
    let stuck = "(with-simulated-robot
                   (let ((?p (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))
                     (perform (a motion (type going) (target (a location (pose ?p)))))))";
    let sweep = "(defsweep s () (vary (x (uniform 0 1))) (run (when (< x 0.3) (error 'end-of-file))) (expect (a t)))";
    let results = called(
        &[],
        &[
            ("list_actions", json!({})),
            ("list_motions", json!({})),
            ("list_object_types", json!({})),
            ("list_furniture", json!({})),
            ("describe", json!({"name": "transporting"})),
            (
                "check_plan",
                json!({"plan": "(perform (an action (type transportin)))"}),
            ),
            ("check_plan", json!({"plan": lift})),
            ("run_plan", json!({"plan": spawn, "view": "table"})),
            (
                "run_plan",
                json!({"plan": lift, "in": "copy", "view": "none"}),
            ),
            ("query_world", json!({"form": "(no-such-function)"})),
            (
                "query_world",
                json!({"form": "(btr-utils:object-exists 'bottle-1)"}),
            ),
            (
                "query_world",
                json!({"form": "(btr-utils:kill-all-objects)"}),
            ),
            (
                "run_plan",
                json!({"plan": stuck, "in": "continue", "view": "none"}),
            ),
            (
                "query_world",
                json!({"form": "(btr-utils:object-exists 'bottle-1)"}),
            ),
            ("picture", json!({"view": "map"})),
            ("sweep_plan", json!({"plan": sweep, "worlds": 10})),
        ],
    );
    let is_error: Vec<usize> = (0..results.len())
        .filter(|at| results[*at]["isError"] == true)
        .collect();
    assert_eq!(is_error, [9, 12]);
    assert!(text(&results[0]).contains("`transporting`"));
    assert!(text(&results[1]).contains("`moving-torso`"));
    assert!(
        text(&results[2]).contains("| `:bottle` |"),
        "{}",
        results[2]
    );
    assert!(
        text(&results[3]).contains("kitchen-island-surface"),
        "{}",
        results[3]
    );
    assert!(
        text(&results[4]).contains("(an action (type transporting)"),
        "{}",
        results[4]
    );
    let misspelt = "plan:1:27: There is no action of type TRANSPORTIN; did you mean TRANSPORTING?";
    assert!(text(&results[5]).starts_with(misspelt), "{}", results[5]);
    assert_eq!(text(&results[6]), "No mistakes were found.");
    assert_eq!(results[7]["content"][1]["mimeType"], "image/png");
    assert_eq!(results[8]["structuredContent"]["outcome"], "success");
    assert!(
        text(&results[8]).contains("motion moving-torso succeeded"),
        "{}",
        results[8]
    );
    assert_eq!(text(&results[10]), "T");
    let failed = &results[12]["structuredContent"];
    assert_eq!(failed["class"], "NAVIGATION-POSE-UNREACHABLE");
    assert!(
        failed["explanation"]
            .as_str()
            .is_some_and(|text| !text.is_empty()),
        "{failed}"
    );
    // What a question does to the world is undone.
    assert_eq!(text(&results[13]), "T");
    assert_eq!(results[14]["content"][0]["type"], "image");
    assert!(
        text(&results[15]).contains("s   seed 0   10 worlds"),
        "{}",
        results[15]
    );
}

#[test]
fn plans_that_do_not_end_or_reach_out_are_ended_and_refused() {
    let folder = std::env::temp_dir().join(format!("planwright-mcp-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder can be made");
    let made = folder.join("made.txt");
    let write = format!("(open {:?} :direction :output)", made.display().to_string());
    let run = |plan: &str| {
        (
            "run_plan",
            json!({"plan": plan, "view": "none", "simulated_seconds": 50}),
        )
    };
    let page = |name: &str| {
        (
            "run_plan",
            json!({"plan": "1", "view": "none", "page": name}),
        )
    };
    let pages = folder.join("pages");
    let results = called(
        &["--folder", pages.to_str().expect("a name")],
        &[
            run("(unwind-protect (loop) (loop))"),
            run("(with-simulated-robot (loop (cpl:sleep 1)))"),
            run("(loop (format t \"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa~%\"))"),
            run(&write),
            run("(quit 3)"),
            run("(print 1"),
            ("check_plan", json!({"plan": "(defmacro m () (loop)) (m)"})),
            page("run-1"),
            page("../run-2"),
            page("/tmp/run-3"),
            ("describe", json!({"name": "car) (quit"})),
            run("(format t \"{\\\"jsonrpc\\\": \\\"2.0\\\"}~%\") (+ 1 2)"),
        ],
    );
    let expected = [
        "the limit of looks",
        "the limit of simulated time",
        "It prints more than",
        "this session has no files",
        "has asked to exit",
        "end of file",
    ];
    for (result, expected) in results.iter().zip(expected) {
        assert_eq!(result["isError"], true);
        assert!(text(result).contains(expected), "{expected}: {result}");
    }
    assert_eq!(results[7]["isError"], false, "{}", results[7]);
    for refused in &results[8..11] {
        assert_eq!(refused["isError"], true, "{refused}");
        assert!(text(refused).contains("is no name"), "{refused}");
    }
    assert_eq!(results[11]["structuredContent"]["values"], "3");
    let files = |folder: &PathBuf| -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder").flatten();
        entries
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .collect()
    };
    assert_eq!(files(&folder), ["pages"]);
    assert_eq!(files(&pages), ["run-1.html"]);
    fs::remove_dir_all(&folder).expect("it is there");
}

#[test]
fn requests_that_are_wrong_get_an_error_and_the_next_ones_an_answer() {
    let call = |id: u64, parameters: Value| request(id, "tools/call", parameters);
    let lines = vec![
        request(1, "tools/list", json!({})),
        request(2, "ping", json!({})),
        initialize(),
        b"{\"jsonrpc\": ".to_vec(),
        b"\xff\xfe".to_vec(),
        b"[]".to_vec(),
        b"7".to_vec(),
        b"{\"id\": 3, \"method\": \"ping\"}".to_vec(),
        b"{\"jsonrpc\": \"2.0\", \"id\": {}, \"method\": \"ping\"}".to_vec(),
        b"{\"jsonrpc\": \"2.0\", \"id\": 4}".to_vec(),
        vec![b'x'; 9 << 20],
        "[".repeat(100_000).into_bytes(),
        request(5, "no/such", json!({})),
        call(6, json!({"name": "run_pla"})),
        call(7, json!({})),
        call(8, json!({"name": "run_plan", "arguments": {"plan": 5}})),
        call(9, json!({"name": "run_plan", "arguments": {"pln": "1"}})),
        call(10, json!({"name": "run_plan", "arguments": {}})),
        call(
            11,
            json!({"name": "run_plan", "arguments": {"plan": "1", "in": "elsewhere"}}),
        ),
        call(
            12,
            json!({"name": "sweep_plan", "arguments": {"plan": "1", "worlds": 0}}),
        ),
        call(13, json!({"name": "list_actions", "arguments": [1]})),
        request(14, "resources/read", json!({"uri": "file:///etc/passwd"})),
        b"{\"jsonrpc\": \"2.0\", \"method\": \"no/such/notification\"}".to_vec(),
        b"".to_vec(),
        request(15, "resources/list", json!({})),
        request(
            16,
            "resources/read",
            json!({"uri": "planwright://plans/lessons/see-more.lesson"}),
        ),
        request(17, "resources/read", json!({"uri": "planwright://manual"})),
        request(18, "tools/list", json!({})),
    ];
    let answers = answers(&[], &lines);
    let codes: Vec<(Value, Value)> = answers
        .iter()
        .map(|answer| (answer["id"].clone(), answer["error"]["code"].clone()))
        .collect();
    let null = Value::Null;
    let refused = |id: u64, code: i64| (json!(id), json!(code));
    let unread = |code: i64| (Value::Null, json!(code));
    assert_eq!(
        codes[..14],
        [
            refused(1, -32600),
            (json!(2), null.clone()),
            (json!(0), null.clone()),
            unread(-32700),
            unread(-32700),
            unread(-32600),
            unread(-32600),
            unread(-32600),
            unread(-32600),
            unread(-32600),
            unread(-32600),
            unread(-32700),
            refused(5, -32601),
            refused(6, -32602),
        ]
    );
    assert!(
        answers[13]["error"]["message"]
            .as_str()
            .is_some_and(|text| text.contains("did you mean run_plan?"))
    );
    assert_eq!(codes[14], refused(7, -32602));
    let said = [
        "plan is 5: a string was expected",
        "run_plan takes no argument pln; did you mean plan?",
        "plan is missing: a string was expected",
        "in is \"elsewhere\": one of fresh, copy, continue was expected",
        "worlds is 0: an integer from 1 to 200 was expected",
        "arguments are an object with a field for each of them",
    ];
    for (answer, said) in answers[15..].iter().zip(said) {
        assert_eq!(answer["result"]["isError"], true);
        assert_eq!(text(&answer["result"]), said);
    }
    assert_eq!(codes[21], refused(14, -32002));
    let lesson = &answers[23]["result"]["contents"][0]["text"];
    assert!(
        lesson
            .as_str()
            .is_some_and(|text| text.contains("(deflesson see-more")),
        "{lesson}"
    );
    let tools = answers[25]["result"]["tools"]
        .as_array()
        .expect("there are some");
    for tool in tools {
        assert_eq!(tool["inputSchema"]["type"], "object", "{tool}");
        assert!(
            tool["description"]
                .as_str()
                .is_some_and(|doc| doc.ends_with('.')),
            "{tool}"
        );
    }
    assert_eq!(answers.len(), 26);
}

#[test]
fn the_session_can_be_read_as_a_resource() {
    let plan = "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
                (with-simulated-robot
                  (perform (a motion (type moving-torso) (joint-angle 0.2)))
                  (let ((?place (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))
                    (perform (an action (type going) (target (a location (pose ?place)))))))";
    let read = |id: u64| request(id, "resources/read", json!({"uri": "planwright://session"}));
    let run = request(
        2,
        "tools/call",
        json!({"name": "run_plan", "arguments": {"plan": plan, "view": "none"}}),
    );
    let answers = answers(&[], &[initialize(), read(1), run, read(3), read(4)]);
    let told = |at: usize| {
        let text = answers[at]["result"]["contents"][0]["text"].as_str();
        text.expect("a text").to_owned()
    };
    assert!(told(1).contains("There are no objects."), "{}", told(1));
    for said in [
        "The robot stands at (0.00 0.00)",
        "BOTTLE-1, a bottle, at (-1.60 -0.90 0.82), on table_area_main",
        "going failed",
        "NAVIGATION-POSE-UNREACHABLE",
        "would overlap kitchen_island",
    ] {
        assert!(told(3).contains(said), "{said}:\n{}", told(3));
    }
    // Reading changes nothing.
    assert_eq!(told(3), told(4));
}
