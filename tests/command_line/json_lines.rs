//! A client of `planwright serve --stdio`: one request on a line, one answer on a line.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

pub(crate) struct Client {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    count: u64,
}

impl Client {
    pub(crate) fn new(arguments: &[&str]) -> Client {
        let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .args(["serve", "--stdio"])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let input = child.stdin.take().expect("it has one");
        let output = BufReader::new(child.stdout.take().expect("it has one"));
        Client {
            child,
            input,
            output,
            count: 0,
        }
    }

    /// Sends a line and returns the answer.
    pub(crate) fn send(&mut self, line: &[u8]) -> Value {
        self.input.write_all(line).expect("it reads");
        self.input.write_all(b"\n").expect("it reads");
        let mut answer = String::new();
        self.output.read_line(&mut answer).expect("it answers");
        serde_json::from_str(&answer).expect(&answer)
    }

    /// The answer of a tool, which bears the number of the request.
    pub(crate) fn ask(&mut self, tool: &str, arguments: Value) -> Value {
        self.count += 1;
        let request = json!({"id": self.count, "tool": tool, "arguments": arguments});
        let answer = self.send(request.to_string().as_bytes());
        assert_eq!(answer["id"], self.count, "{answer}");
        answer
    }

    /// Ends the input; the status of the program.
    pub(crate) fn end(self) -> Option<i32> {
        let Client {
            mut child, input, ..
        } = self;
        drop(input);
        child.wait().expect("it ends").code()
    }
}
