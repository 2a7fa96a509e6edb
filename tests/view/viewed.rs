//! A session with its live view open, and what its page and strangers can send to it.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use serde_json::Value;

use session::dialogue::{Evaluate, Event, Outcome};
use session::{Session, SessionOptions};

/// A session with its live view open, and where that is.
pub(super) struct Viewed {
    pub(super) session: Session,
    /// `127.0.0.1:PORT`
    pub(super) host: String,
    /// `/TOKEN/`
    pub(super) path: String,
}

pub(super) fn viewed() -> Viewed {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let address = session.open_view().unwrap();
    let rest = address.strip_prefix("http://").unwrap();
    let (host, path) = rest.split_at(rest.find('/').unwrap());
    Viewed {
        session,
        host: host.to_owned(),
        path: path.to_owned(),
    }
}

impl Viewed {
    /// A connection on which nothing is waited for endlessly.
    pub(super) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(60)))
            .unwrap();
        stream
    }

    /// Sends bytes and reads until the server ends the connection.
    pub(super) fn send(&self, bytes: &[u8]) -> Vec<u8> {
        let mut stream = self.connect();
        // A server that has closed early takes no more.
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        answer
    }

    /// Status of the answer to a request with these header lines.
    pub(super) fn status(&self, method: &str, path: &str, headers: &str, body: &str) -> String {
        let text = format!(
            "{method} {path} HTTP/1.1\r\n{headers}Content-Length: {}\r\n\r\n{body}",
            body.len()
        );
        let answer = self.send(text.as_bytes());
        let answer = String::from_utf8_lossy(&answer).into_owned();
        answer.split(' ').nth(1).unwrap_or("none").to_owned()
    }

    pub(super) fn get(&self, name: &str) -> Vec<u8> {
        let (path, host) = (&self.path, &self.host);
        let text = format!("GET {path}{name} HTTP/1.1\r\nHost: {host}\r\n\r\n");
        let answer = self.send(text.as_bytes());
        let end = answer.windows(4).position(|w| w == b"\r\n\r\n").unwrap();
        assert!(answer.starts_with(b"HTTP/1.1 200 OK\r\n"), "{name}");
        answer[end + 4..].to_vec()
    }

    /// Asks for another pace, as the page does.
    pub(super) fn ask(&self, what: &str) -> String {
        let host = &self.host;
        let headers = format!("Host: {host}\r\nOrigin: http://{host}\r\n");
        self.status("POST", &format!("{}pace", self.path), &headers, what)
    }

    pub(super) fn evaluate(&mut self, text: &str) {
        let mut told = String::new();
        let outcome = self.session.evaluate("test", text, &mut |event| {
            if let Event::Aborted(abort) = event {
                told = abort.report;
            }
        });
        assert_eq!(outcome, Outcome::Finished, "{told}");
    }

    pub(super) fn hash(&self) -> u64 {
        self.session.simulation().world().hash()
    }

    /// Opens the stream of events.
    pub(super) fn events(&self) -> Events {
        let mut stream = self.connect();
        let (path, host) = (&self.path, &self.host);
        let request = format!("GET {path}events HTTP/1.1\r\nHost: {host}\r\n\r\n");
        stream.write_all(request.as_bytes()).unwrap();
        Events {
            stream,
            bytes: Vec::new(),
        }
    }
}

/// A stream of events.
#[derive(Debug)]
pub(super) struct Events {
    stream: TcpStream,
    bytes: Vec<u8>,
}

impl Events {
    /// Reads until the server ends the connection.
    pub(super) fn until_its_end(mut self) {
        let timeout = Some(Duration::from_secs(60));
        self.stream.set_read_timeout(timeout).unwrap();
        self.stream.read_to_end(&mut self.bytes).unwrap();
    }

    /// Everything up to the first event of which the predicate is true: names and data.
    pub(super) fn until(&mut self, is_last: impl Fn(&str, &Value) -> bool) -> Vec<(String, Value)> {
        let begin = Instant::now();
        let timeout = Some(Duration::from_millis(100));
        self.stream.set_read_timeout(timeout).unwrap();
        let mut all = Vec::new();
        loop {
            while let Some(end) = self.bytes.windows(2).position(|two| two == b"\n\n") {
                let message: Vec<u8> = self.bytes.drain(..end + 2).collect();
                let message = String::from_utf8(message).unwrap();
                let Some(rest) = message.split_once("event: ").map(|(_, rest)| rest) else {
                    continue;
                };
                let (name, data) = rest.trim_end().split_once("\ndata: ").unwrap();
                let data: Value = serde_json::from_str(data).unwrap();
                let is_enough = is_last(name, &data);
                all.push((name.to_owned(), data));
                if is_enough {
                    return all;
                }
            }
            assert!(begin.elapsed() < Duration::from_secs(60), "{all:#?}");
            let mut some = [0; 4096];
            if let Ok(count) = self.stream.read(&mut some) {
                assert!(count > 0, "the stream has ended: {all:#?}");
                self.bytes.extend_from_slice(&some[..count]);
            }
        }
    }
}
