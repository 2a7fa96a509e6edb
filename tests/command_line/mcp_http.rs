//! The door for assistants over HTTP on this machine.

use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// A server, which ends with the test.
struct Server {
    child: Child,
    address: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What came back: status, head and body.
struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_str(&self.body).expect(&self.body)
    }

    fn header(&self, name: &str) -> Option<&str> {
        let lines = self.head.lines().filter_map(|line| line.split_once(": "));
        let mut values = lines.filter(|(known, _)| known.eq_ignore_ascii_case(name));
        values.next().map(|(_, value)| value)
    }
}

impl Server {
    fn new() -> Server {
        let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .args(["mcp", "--http", "--word", "a-word-of-tests"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let mut line = String::new();
        let output = child.stdout.take().expect("it has one");
        BufReader::new(output)
            .read_line(&mut line)
            .expect("it says where it is");
        let rest = line.split_once("http://").expect("an address").1;
        let address = rest.split('/').next().expect("an address").to_owned();
        assert!(rest.trim_end().ends_with("/a-word-of-tests/mcp"), "{line}");
        Server { child, address }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.address).expect("it listens");
        let limit = Some(Duration::from_secs(60));
        stream.set_read_timeout(limit).expect("a limit can be set");
        stream
    }

    /// Sends bytes and reads the answer.
    fn send(&self, bytes: &[u8]) -> Answer {
        let mut stream = self.connect();
        stream.write_all(bytes).expect("it reads");
        read(stream)
    }

    /// A request with a method, further header lines and a body.
    fn ask(&self, method: &str, headers: &str, body: &str) -> Answer {
        self.send(self.request(method, headers, body).as_bytes())
    }

    fn request(&self, method: &str, headers: &str, body: &str) -> String {
        format!(
            "{method} /a-word-of-tests/mcp HTTP/1.1\r\nHost: {}\r\nContent-Length: {}\r\n{headers}\r\n{body}",
            self.address,
            body.len()
        )
    }

    /// A message of the protocol, in a session.
    fn post(&self, session: &str, message: &Value) -> Answer {
        let headers = format!("Content-Type: application/json\r\nMcp-Session-Id: {session}\r\n");
        self.ask("POST", &headers, &message.to_string())
    }

    /// Begins a session.
    fn begin(&self) -> String {
        let message = request(0, "initialize", json!({"protocolVersion": "2025-06-18"}));
        let answer = self.ask(
            "POST",
            "Content-Type: application/json\r\n",
            &message.to_string(),
        );
        assert_eq!(answer.status, 200, "{}", answer.body);
        assert_eq!(answer.json()["result"]["serverInfo"]["name"], "planwright");
        answer
            .header("Mcp-Session-Id")
            .expect("a session")
            .to_owned()
    }
}

fn read(mut stream: TcpStream) -> Answer {
    let mut bytes = Vec::new();
    if let Err(error) = stream.read_to_end(&mut bytes) {
        // The server may have closed before it has read all, but it closes.
        let kept = [ErrorKind::WouldBlock, ErrorKind::TimedOut].contains(&error.kind());
        assert!(!kept, "the connection has not been closed after the answer");
    }
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (head, body) = text.split_once("\r\n\r\n").unwrap_or_default();
    let status = head
        .split(' ')
        .nth(1)
        .and_then(|status| status.parse().ok());
    Answer {
        status: status.unwrap_or(0),
        head: head.to_owned(),
        body: body.to_owned(),
    }
}

fn request(id: u64, method: &str, parameters: Value) -> Value {
    json!({"jsonrpc": "2.0", "id": id, "method": method, "params": parameters})
}

fn run(id: u64, plan: &str) -> Value {
    let arguments = json!({"plan": plan, "view": "none"});
    request(
        id,
        "tools/call",
        json!({"name": "run_plan", "arguments": arguments}),
    )
}

#[test]
fn clients_have_worlds_of_their_own() {
    let server = Server::new();
    let (a, b) = (server.begin(), server.begin());
    assert_ne!(a, b);
    let began = json!({"jsonrpc": "2.0", "method": "notifications/initialized"});
    let answer = server.post(&a, &began);
    assert_eq!((answer.status, answer.body.as_str()), (202, ""));
    let spawn = "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'mine)";
    assert_eq!(
        server.post(&a, &run(1, spawn)).json()["result"]["isError"],
        false
    );
    let question = |session: &str| {
        let arguments = json!({"form": "(btr-utils:object-exists 'mine)"});
        let asked = request(
            2,
            "tools/call",
            json!({"name": "query_world", "arguments": arguments}),
        );
        let answer = server.post(session, &asked).json();
        answer["result"]["content"][0]["text"]
            .as_str()
            .expect("a text")
            .to_owned()
    };
    assert_eq!(
        (question(&a), question(&b)),
        ("T".to_owned(), "NIL".to_owned())
    );
    // Two at a time, with the same id: each gets its own answer.
    thread::scope(|scope| {
        let asked = |plan: &'static str| {
            scope.spawn({
                let (server, a) = (&server, &a);
                move || server.post(a, &run(7, plan)).json()
            })
        };
        let (one, two) = (asked("(+ 1 1)"), asked("(+ 2 2)"));
        let values = |answer: Value| answer["result"]["structuredContent"]["values"].clone();
        assert_eq!(values(one.join().expect("it ends")), "2");
        assert_eq!(values(two.join().expect("it ends")), "4");
    });
    // Who ends a session has none.
    let ending = format!("Mcp-Session-Id: {b}\r\n");
    assert_eq!(server.ask("DELETE", &ending, "").status, 200);
    assert_eq!(server.ask("DELETE", &ending, "").status, 404);
    assert_eq!(server.post(&b, &request(3, "ping", json!({}))).status, 404);
    // One client too many takes the place of the one that has been silent longest.
    let later: Vec<String> = (0..3).map(|_| server.begin()).collect();
    assert_eq!(server.post(&a, &request(4, "ping", json!({}))).status, 200);
    let last = server.begin();
    assert_eq!(
        server
            .post(&later[0], &request(5, "ping", json!({})))
            .status,
        404
    );
    for session in [&a, &later[1], &later[2], &last] {
        assert_eq!(
            server.post(session, &request(6, "ping", json!({}))).status,
            200
        );
    }
}

#[test]
fn a_client_does_not_wait_for_the_plan_of_another_one() {
    let server = Server::new();
    let (a, b) = (server.begin(), server.begin());
    let has_ended = AtomicBool::new(false);
    thread::scope(|scope| {
        let endless = scope.spawn(|| {
            let answer = server.post(&a, &run(1, "(loop)"));
            has_ended.store(true, Ordering::SeqCst);
            answer.json()
        });
        // The other one's comes first only if it runs beside it.
        let answer = server.post(&b, &run(2, "(+ 1 1)")).json();
        assert_eq!(answer["result"]["structuredContent"]["values"], "2");
        assert!(!has_ended.load(Ordering::SeqCst));
        let ended = endless.join().expect("it ends");
        assert_eq!(ended["result"]["isError"], true, "{ended}");
    });
}

#[test]
fn requests_that_are_wrong_or_not_from_this_machine_are_refused() {
    let server = Server::new();
    let session = server.begin();
    let kind = "Content-Type: application/json\r\n";
    let ping = request(1, "ping", json!({})).to_string();
    let with = |more: &str| format!("{kind}Mcp-Session-Id: {session}\r\n{more}");
    let own = format!("Origin: http://{}\r\n", server.address);
    let large = format!("{kind}Mcp-Session-Id: {session}\r\n");
    for (method, headers, body, status) in [
        ("POST", with(""), ping.as_str(), 200),
        ("POST", with(&own), &ping, 200),
        (
            "POST",
            with("Accept: application/json, text/event-stream\r\n"),
            &ping,
            200,
        ),
        (
            "POST",
            with("MCP-Protocol-Version: 2025-06-18\r\n"),
            &ping,
            200,
        ),
        (
            "POST",
            with("MCP-Protocol-Version: 1999-01-01\r\n"),
            &ping,
            400,
        ),
        ("POST", with("Origin: http://evil.example\r\n"), &ping, 403),
        ("POST", with("Origin: null\r\n"), &ping, 403),
        ("POST", with("Origin: http://localhost:1\r\n"), &ping, 403),
        ("POST", with("Sec-Fetch-Site: cross-site\r\n"), &ping, 403),
        ("POST", with("Accept: text/html\r\n"), &ping, 406),
        ("POST", format!("Mcp-Session-Id: {session}\r\n"), &ping, 415),
        (
            "POST",
            format!("Content-Type: text/plain\r\nMcp-Session-Id: {session}\r\n"),
            &ping,
            415,
        ),
        ("POST", kind.to_owned(), &ping, 400),
        ("POST", kind.to_owned(), "{", 400),
        (
            "POST",
            format!("{kind}Mcp-Session-Id: nobody\r\n"),
            &ping,
            404,
        ),
        ("POST", with(""), "{\"id\": ", 200),
        ("POST", with(""), "", 200),
        ("GET", with(""), "", 405),
        ("PUT", with(""), &ping, 405),
        ("OPTIONS", with(""), "", 405),
        // No answer at all: no program reads this as one request.
        ("POST", with("Content-Length: 3\r\n"), &ping, 0),
        ("POST", with("Transfer-Encoding: chunked\r\n"), &ping, 0),
    ] {
        let answer = server.ask(method, &headers, body);
        assert_eq!(
            answer.status, status,
            "{method} {headers}{body}\n{}",
            answer.body
        );
    }
    let damaged = server.ask("POST", &with(""), "{\"id\": ");
    assert_eq!(damaged.json()["error"]["code"], -32700);
    // Another name may lead here (DNS rebinding), and another word does not.
    let asked = server.request("POST", &with(""), &ping);
    let named = |name: &str| {
        server
            .send(asked.replace(&server.address, name).as_bytes())
            .status
    };
    assert_eq!(named("evil.example"), 403);
    assert_eq!(named("localhost:8000"), 200);
    let other = server.send(asked.replace("a-word", "b-word").as_bytes());
    assert_eq!(other.status, 404);
    // A body of many megabytes is not read.
    let head = format!(
        "POST /a-word-of-tests/mcp HTTP/1.1\r\nHost: {}\r\nContent-Length: 99000000\r\n{large}\r\n",
        server.address
    );
    assert_eq!(server.send(head.as_bytes()).status, 413);
    assert_eq!(
        server.post(&session, &request(2, "ping", json!({}))).status,
        200
    );
}

#[test]
fn half_sent_requests_and_clients_that_go_keep_nobody_out() {
    let server = Server::new();
    let session = server.begin();
    let begun = Instant::now();
    // Strangers who send nothing, or half a head, and clients who know the word and send half a body.
    let mut open = Vec::new();
    for number in 0..150 {
        let mut stream = server.connect();
        let text = match number % 2 {
            0 => "",
            _ => "POST /a-word-of-te",
        };
        stream.write_all(text.as_bytes()).expect("it reads");
        open.push(stream);
    }
    let headers = format!("Content-Type: application/json\r\nMcp-Session-Id: {session}\r\n");
    for _ in 0..8 {
        let mut stream = server.connect();
        let asked = server
            .request("POST", &headers, "{}")
            .replace("Length: 2", "Length: 200");
        stream.write_all(asked.as_bytes()).expect("it reads");
        open.push(stream);
    }
    assert_eq!(
        server.post(&session, &request(1, "ping", json!({}))).status,
        200
    );
    assert!(
        begun.elapsed() < Duration::from_secs(8),
        "{:?}",
        begun.elapsed()
    );
    drop(open);
    // Clients that close while they wait behind others' plans, which take seconds together: theirs are not run.
    let slow = run(2, "(loop)");
    let marked = run(
        3,
        "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'never)",
    );
    let mut gone = Vec::new();
    for message in [&slow, &slow, &slow, &slow, &slow, &marked, &marked] {
        let mut stream = server.connect();
        let asked = server.request("POST", &headers, &message.to_string());
        stream.write_all(asked.as_bytes()).expect("it reads");
        gone.push(stream);
        thread::sleep(Duration::from_millis(20));
    }
    for stream in gone.iter().skip(5) {
        stream.shutdown(Shutdown::Both).expect("it can be closed");
    }
    let question = json!({"form": "(btr-utils:object-exists 'never)"});
    let asked = request(
        4,
        "tools/call",
        json!({"name": "query_world", "arguments": question}),
    );
    let answer = server.post(&session, &asked);
    assert_eq!(answer.json()["result"]["content"][0]["text"], "NIL");
    let ended = read(gone.remove(0));
    assert!(
        ended.body.contains("It calculates without end"),
        "{}",
        ended.body
    );
}

#[test]
fn other_machines_are_not_served() {
    for (address, why) in [
        ("0.0.0.0:0", "can be reached by other machines"),
        ("example.org:80", "an address was expected"),
        ("", "an address was expected"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .args(["mcp", &format!("--http={address}")])
            .stdin(Stdio::null())
            .output()
            .expect("the program runs");
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(why), "{address}: {said}");
    }
}
