//! Targets that are requests of other programs: of Emacs, of Jupyter, of assistants. What they ask for is
//! evaluated.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};

use super::corpus;
use super::language::{LEFT_OUT, WORDS, session};
use super::target::{Taken, Taker, Target};
use crate::jupyter::zmtp::{encoded, read_frame};
use crate::jupyter::{Connection, Interrupter, Kernel, Settings, Signer};
use crate::mcp;
use crate::swank;
use crate::tools::{Lines, Opened, World};
use lisp::guard::set_stack_budget;
use session::Session;
use session::dialogue::Evaluate;

/// What a server takes before another is made.
const MAX_INPUTS: usize = 2000;
/// How long an evaluation may take before it is interrupted, and how often it is.
const PATIENCE: Duration = Duration::from_millis(200);
const MAX_INTERRUPTS: usize = 100;
/// What would end the server, leave its folder, or take minutes.
const ENDING: &[&str] = &[
    "quit",
    "exit",
    "shutdown",
    "default-directory",
    "sweep",
    "compare",
    "sleep",
    "real_seconds",
];

pub(super) fn targets() -> Vec<Target> {
    let target = |name, least_read, corpus, open| Target {
        name,
        share: 5,
        least_read,
        words: WORDS,
        corpus,
        open,
    };
    vec![
        target("swank", 50, of_emacs, swank),
        target("jupyter", 40, of_jupyter, jupyter),
        target("mcp", 50, of_assistants, mcp),
        target("serve", 50, of_editors, serve),
    ]
}

/// Is something in a text that must not be evaluated here?
fn is_left_out(text: &str) -> bool {
    let folded = text.to_lowercase();
    let mut names = LEFT_OUT.iter().chain(ENDING);
    names.any(|name| folded.contains(name))
}

/// Some programs that may be evaluated.
fn programs() -> impl Iterator<Item = String> {
    let all = corpus::programs().into_iter().step_by(40);
    let all = all.map(|program| String::from_utf8_lossy(&program).into_owned());
    all.filter(|program| program.len() < 400 && !is_left_out(program))
}

/// Ends a server.
type End = Box<dyn FnOnce() + Send>;

/// A thread with a session that serves.
struct Serving {
    interrupt: Arc<AtomicBool>,
    end: End,
}

impl Serving {
    /// Begins; `serve` tells where clients can connect and how to end.
    fn begin<T: Send + 'static>(
        serve: impl FnOnce(&mut Session, &mpsc::Sender<(T, End)>) + Send + 'static,
    ) -> (Self, T) {
        let (tell, told) = mpsc::channel();
        let (tell_flag, flag) = mpsc::channel();
        let work = move || {
            set_stack_budget(48 << 20);
            let mut session = session("");
            session.close();
            tell_flag
                .send(session.interrupt_handle())
                .expect("somebody waits");
            serve(&mut session, &tell);
        };
        let thread = thread::Builder::new().stack_size(64 << 20).spawn(work);
        let thread = thread.expect("a thread can be made");
        let interrupt = flag.recv().expect("there is a session");
        let (reached, stop) = told.recv().expect("the server begins");
        let end = move || {
            stop();
            drop(thread.join());
        };
        let serving = Self {
            interrupt,
            end: Box::new(end),
        };
        (serving, reached)
    }
}

/// A client, and the server that it has for itself.
struct Client {
    /// Replaced when it ends.
    serving: Option<Serving>,
    stream: TcpStream,
    /// Number of the request behind an input, whose answer says that the input is done.
    number: u64,
}

impl Drop for Client {
    fn drop(&mut self) {
        if let Some(serving) = self.serving.take() {
            (serving.end)();
        }
    }
}

impl Client {
    fn new(serving: Serving, stream: TcpStream) -> Self {
        stream
            .set_read_timeout(Some(PATIENCE))
            .expect("sockets have timeouts");
        stream.set_nodelay(true).expect("sockets need not wait");
        Self {
            serving: Some(serving),
            stream,
            number: 1_000_000_000,
        }
    }

    /// Fills a buffer; whatever takes long is interrupted.
    fn fill(&mut self, buffer: &mut [u8]) -> Result<(), String> {
        let (mut filled, mut interrupts) = (0, 0);
        while filled < buffer.len() {
            match self.stream.read(&mut buffer[filled..]) {
                Ok(0) => return Err("the server has closed the connection".to_owned()),
                Ok(count) => filled += count,
                Err(error) if is_late(&error) && interrupts < MAX_INTERRUPTS => {
                    interrupts += 1;
                    if let Some(serving) = &self.serving {
                        serving.interrupt.store(true, Ordering::SeqCst);
                    }
                }
                Err(error) => return Err(format!("the server does not answer: {error}")),
            }
        }
        Ok(())
    }

    fn send(&mut self, bytes: &[u8]) -> Result<(), String> {
        let sent = self.stream.write_all(bytes);
        sent.map_err(|error| format!("the server is gone: {error}"))
    }
}

fn is_late(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut
    )
}

impl Read for Client {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let filled = self.fill(buffer).map_err(io::Error::other);
        filled.map(|()| buffer.len())
    }
}

/// A taker of texts for a client, which is made anew now and then, and after a failure.
fn by_client(open: fn() -> Client, take: fn(&mut Client, &str) -> Result<Taken, String>) -> Taker {
    let mut client = open();
    let mut taken = 0;
    Box::new(move |input| {
        let text = String::from_utf8_lossy(input);
        if is_left_out(&text) {
            return Ok(Taken::Refused);
        }
        taken += 1;
        if taken % MAX_INPUTS == 0 {
            client = open();
        }
        take(&mut client, &text)
    })
}

/// A text as a string of Lisp.
fn quoted(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{text}\"")
}

/// Requests of Emacs.
fn of_emacs() -> Vec<Vec<u8>> {
    let request = |form: String| format!("(:emacs-rex {form} \"CL-USER\" t 7)").into_bytes();
    let mut all: Vec<Vec<u8>> = [
        "(swank:connection-info)",
        "(swank:autodoc '(\"mapcar\" \"\" swank::%cursor-marker%) :print-right-margin 80)",
        "(swank:simple-completions \"mapc\" \"CL-USER\")",
        "(swank:fuzzy-completions \"mvb\" \"CL-USER\" :limit 300 :time-limit-in-msec 1500)",
        "(swank:completions-for-keyword \":te\" '(\"find\" \"x\" swank::%cursor-marker%))",
        "(swank:describe-symbol \"car\")",
        "(swank:documentation-symbol \"car\")",
        "(swank:apropos-list-for-emacs \"map\" t nil nil)",
        "(swank:find-definitions-for-emacs \"perform\")",
        "(swank:xref :calls \"car\")",
        "(swank:operator-arglist \"mapcar\" \"CL-USER\")",
        "(swank:set-package \"CL-USER\")",
        "(swank:swank-macroexpand-1 \"(when a b)\")",
        "(swank:compile-string-for-emacs \"(defun f (x) x)\" \"a.plan\" '((:position 1)) nil nil)",
        "(swank:init-inspector \"(list 1 2)\")",
        "(swank:inspect-nth-part 0)",
        "(swank:inspector-pop)",
        "(swank:backtrace 0 20)",
        "(swank:frame-locals-and-catch-tags 0)",
        "(swank:list-threads)",
        "(swank:value-for-editing \"(list 1)\")",
        "(swank:swank-toggle-trace \"car\")",
        "(swank:untrace-all)",
        "(swank:buffer-first-change \"a.plan\")",
        "(swank-repl:create-repl nil :coding-system \"utf-8-unix\")",
    ]
    .iter()
    .map(|form| request((*form).to_owned()))
    .collect();
    for (number, program) in programs().enumerate() {
        let evaluated = [
            "swank-repl:listener-eval",
            "swank:interactive-eval",
            "swank:eval-and-grab-output",
            "swank:pprint-eval",
        ];
        let evaluated = evaluated[number % evaluated.len()];
        all.push(request(format!("({evaluated} {})", quoted(&program))));
    }
    all
}

fn swank() -> Taker {
    let open = || {
        let (serving, address) = Serving::begin(|session, tell| {
            let options = swank::ServerOptions::default();
            let server = swank::Server::bind(options).expect("there is a port");
            let address = server.address();
            let begin = move |stopper: swank::Stopper| {
                let stop: End = Box::new(move || stopper.stop());
                tell.send((address, stop)).expect("somebody waits");
            };
            drop(server.serve(session, None, begin));
        });
        let stream = TcpStream::connect(address).expect("the server listens");
        let mut client = Client::new(serving, stream);
        let repl = "(:emacs-rex (swank-repl:create-repl nil) \"CL-USER\" t 1)";
        ask_swank(&mut client, repl).expect("the server answers");
        client
    };
    by_client(open, ask_swank)
}

/// Sends a message; then all levels are left, which is answered when the message has been.
fn ask_swank(client: &mut Client, text: &str) -> Result<Taken, String> {
    client.number += 1;
    let number = client.number;
    let leave = format!("(:emacs-rex (swank:throw-to-toplevel) nil t {number})");
    let framed = |text: &str| format!("{:06x}{text}", text.len());
    client.send((framed(text) + &framed(&leave)).as_bytes())?;
    let mut is_read = false;
    loop {
        let mut digits = [0; 6];
        client.fill(&mut digits)?;
        let length = String::from_utf8_lossy(&digits);
        let length = usize::from_str_radix(&length, 16).map_err(|error| error.to_string())?;
        let mut message = vec![0; length];
        client.fill(&mut message)?;
        let message = String::from_utf8(message).map_err(|error| error.to_string())?;
        if message.contains("planwright failed:") || message.contains("#<DEFECT") {
            return Err(message);
        }
        if message.starts_with("(:return") && message.ends_with(&format!(" {number})")) {
            return Ok(Taken::if_read(is_read));
        }
        is_read |= message.starts_with("(:return (:ok");
        if let Some(rest) = message.strip_prefix("(:read-string ") {
            let answer = format!(
                "(:emacs-return-string {} \"1\")",
                rest.trim_end_matches(')')
            );
            client.send(framed(&answer).as_bytes())?;
        }
    }
}

/// Requests of Jupyter: a line with the header, then the content.
fn of_jupyter() -> Vec<Vec<u8>> {
    let request = |kind: &str, content: Value| {
        let header = json!({"msg_id": "m", "session": "s", "msg_type": kind, "version": "5.3"});
        format!("{header}\n{content}").into_bytes()
    };
    let mut all = vec![
        request("kernel_info_request", json!({})),
        request(
            "complete_request",
            json!({"code": "(mapc", "cursor_pos": 5}),
        ),
        request(
            "inspect_request",
            json!({"code": "(mapcar", "cursor_pos": 4, "detail_level": 1}),
        ),
        request("is_complete_request", json!({"code": "(list 1"})),
        request("comm_info_request", json!({"target_name": "x"})),
        request(
            "history_request",
            json!({"hist_access_type": "tail", "n": 10, "output": true, "raw": true}),
        ),
        request(
            "history_request",
            json!({"hist_access_type": "range", "session": 0, "start": 1, "stop": 3}),
        ),
        request(
            "history_request",
            json!({"hist_access_type": "search", "pattern": "*a?", "unique": true}),
        ),
        request(
            "execute_request",
            json!({"code": "%view off\n(list 1)", "silent": false}),
        ),
    ];
    for program in programs() {
        let content = json!({"code": program, "silent": false, "store_history": true,
            "user_expressions": {}, "allow_stdin": false, "stop_on_error": true});
        all.push(request("execute_request", content));
    }
    corpus::small(all.into_iter())
}

const KEY: &str = "a key";

fn jupyter() -> Taker {
    let open = || {
        let (serving, address) = Serving::begin(|session, tell| {
            let connection = json!({"ip": "127.0.0.1", "key": KEY, "shell_port": 0, "iopub_port": 0,
                "stdin_port": 0, "control_port": 0, "hb_port": 0});
            let connection: Connection =
                serde_json::from_value(connection).expect("it is a connection");
            let interrupter = Interrupter::new(session.interrupt_handle());
            let settings = Settings {
                view: None,
                ..Settings::default()
            };
            let ending = interrupter.clone();
            let kernel = Kernel::listen(&connection, interrupter, settings).expect("a kernel");
            let stop: End = Box::new(move || ending.end());
            tell.send((kernel.addresses()[0], stop))
                .expect("somebody waits");
            kernel.serve(session);
        });
        let stream = TcpStream::connect(address).expect("the kernel listens");
        let mut client = Client::new(serving, stream);
        greet(&mut client).expect("the kernel greets");
        client
    };
    by_client(open, ask_jupyter)
}

/// Begins a connection as ZMTP has it.
fn greet(client: &mut Client) -> Result<(), String> {
    let mut bytes = vec![0; 64];
    (bytes[0], bytes[9], bytes[10]) = (0xff, 0x7f, 3);
    bytes[12..16].copy_from_slice(b"NULL");
    let ready = b"\x05READY\x0bSocket-Type\0\0\0\x06DEALER";
    bytes.extend([4, ready.len() as u8]);
    bytes.extend(ready);
    client.send(&bytes)?;
    client.fill(&mut [0; 64])?;
    read_frame(client, 1000).map_err(|error| error.to_string())?;
    Ok(())
}

/// A signed message.
fn signed(header: &[u8], content: &[u8]) -> Vec<u8> {
    let parts = [header, b"{}", b"{}", content];
    let signature = Signer::new(KEY).sign(&parts);
    let [header, parent, metadata, content] = parts;
    encoded(&[
        b"<IDS|MSG>",
        signature.as_bytes(),
        header,
        parent,
        metadata,
        content,
    ])
}

/// Sends a request, and then one that is answered when that has been. A name that counts makes the same input
/// another message each time.
fn ask_jupyter(client: &mut Client, text: &str) -> Result<Taken, String> {
    client.number += 1;
    let (header, content) = text.split_once('\n').unwrap_or((text, "{}"));
    let header = header.replacen("\"m\"", &format!("\"m{}\"", client.number), 1);
    let last = format!("\"last{}\"", client.number);
    let barrier = format!("{{\"msg_id\":{last},\"msg_type\":\"kernel_info_request\"}}");
    let mut bytes = signed(header.as_bytes(), content.as_bytes());
    bytes.extend(signed(barrier.as_bytes(), b"{}"));
    client.send(&bytes)?;
    let mut is_read = false;
    loop {
        let mut frames = Vec::new();
        loop {
            let frame = read_frame(client, 1 << 30).map_err(|error| error.to_string())?;
            frames.push(frame.body);
            if !frame.has_more {
                break;
            }
        }
        let [.., parent, _, content] = frames.as_slice() else {
            return Err("an answer lacks parts".to_owned());
        };
        let content = String::from_utf8_lossy(content);
        if content.contains("#<DEFECT") || content.contains("\"DEFECT\"") {
            return Err(content.into_owned());
        }
        if String::from_utf8_lossy(parent).contains(&last) {
            return Ok(Taken::if_read(is_read));
        }
        let content: Value = serde_json::from_str(&content).map_err(|error| error.to_string())?;
        is_read |= content["status"] != "error";
    }
}

/// A world for tools, without files.
fn world() -> World {
    let session = session("");
    let opened = Opened::of(&session, |options, models| {
        Session::with_models(options, Arc::clone(models)).map_err(|error| error.to_string())
    });
    World::new(&opened, None).expect("there is a world")
}

/// Calls of tools: names and arguments.
fn calls() -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("list_actions", json!({})),
        ("list_object_types", json!({})),
        ("list_furniture", json!({})),
        ("describe", json!({"name": "transporting"})),
        (
            "query_world",
            json!({"form": "(btr:object-pose 'bottle-1)"}),
        ),
        ("read_document", json!({"name": "lesson-1"})),
        ("read_document", json!({})),
    ];
    for program in programs().step_by(3) {
        all.push(("check_plan", json!({"plan": program})));
        all.push(("query_world", json!({"form": program})));
        all.push((
            "run_plan",
            json!({"plan": program, "in": "continue", "view": "none", "simulated_seconds": 5}),
        ));
    }
    all
}

fn of_assistants() -> Vec<Vec<u8>> {
    let request = |method: &str, params: Value| {
        json!({"jsonrpc": "2.0", "id": 1, "method": method, "params": params})
            .to_string()
            .into_bytes()
    };
    let mut all = vec![
        request("ping", json!({})),
        request("initialize", json!({"protocolVersion": "2025-06-18"})),
        request("tools/list", json!({})),
        request("resources/list", json!({})),
        request("resources/read", json!({"uri": "planwright://tutorial"})),
    ];
    let calls = calls().into_iter();
    all.extend(calls.map(|(name, arguments)| {
        request("tools/call", json!({"name": name, "arguments": arguments}))
    }));
    corpus::small(all.into_iter())
}

/// A taker of single lines, whose answers tell whether they were read; made anew now and then.
fn by_lines<T: 'static>(
    open: fn() -> T,
    answer: fn(&mut T, &[u8]) -> Result<String, String>,
) -> Taker {
    let mut server = open();
    let mut taken = 0;
    Box::new(move |input| {
        let text = String::from_utf8_lossy(input).replace('\n', " ");
        if is_left_out(&text) {
            return Ok(Taken::Refused);
        }
        taken += 1;
        if taken % MAX_INPUTS == 0 {
            server = open();
        }
        let answer = answer(&mut server, text.as_bytes())?;
        if answer.contains("#<DEFECT") || answer.contains("planwright failed") {
            return Err(answer);
        }
        let is_refused = answer.contains("\"error\":{") || answer.contains("\"tool\"");
        Ok(Taken::if_read(!answer.is_empty() && !is_refused))
    })
}

fn mcp() -> Taker {
    let open = || {
        let mut server = mcp::Server::new(world());
        let begin = &b"{\"jsonrpc\":\"2.0\",\"id\":0,\"method\":\"initialize\"}\n"[..];
        let begun = server.serve(begin, io::sink());
        begun.expect("what is written there is lost");
        server
    };
    by_lines(open, |server, line| {
        let mut output = Vec::new();
        let served = server.serve(line, &mut output);
        served.map_err(|error| error.to_string())?;
        Ok(String::from_utf8_lossy(&output).into_owned())
    })
}

fn of_editors() -> Vec<Vec<u8>> {
    let mut all = vec![json!({"id": 1, "tool": "tools"}).to_string().into_bytes()];
    let calls = calls().into_iter();
    all.extend(calls.map(|(name, arguments)| {
        json!({"id": 1, "tool": name, "arguments": arguments})
            .to_string()
            .into_bytes()
    }));
    corpus::small(all.into_iter())
}

fn serve() -> Taker {
    by_lines(
        || Lines::new(world()),
        |server, line| {
            let mut output = Vec::new();
            let served = server.serve(line, &mut output);
            served.map_err(|error| error.to_string())?;
            Ok(String::from_utf8_lossy(&output).into_owned())
        },
    )
}
