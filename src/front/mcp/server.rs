//! Requests and their answers.

use std::io::{self, BufRead, Write};

use serde_json::{Value, json};

use crate::tools::{MAX_REQUEST, TOOLS, TooLong, World, called, described, documents, next_line};

/// The versions of the protocol that are spoken, the newest first.
pub(super) const VERSIONS: &[&str] = &["2025-06-18", "2025-03-26", "2024-11-05"];

const PARSE_ERROR: i64 = -32700;
const INVALID_REQUEST: i64 = -32600;
const METHOD_NOT_FOUND: i64 = -32601;
const INVALID_PARAMS: i64 = -32602;
const RESOURCE_NOT_FOUND: i64 = -32002;

/// What a client should know at first.
const INSTRUCTIONS: &str = "planwright simulates a PR2 robot in a kitchen. Plans are written in a \
Common-Lisp-like language, CRAM's. Look up what there is (list_actions, list_object_types, list_furniture, \
describe), write a plan, check it (check_plan), run it (run_plan), read why it failed, mend it. Inside \
(with-simulated-robot …) a plan performs actions: (perform (an action (type transporting) (object (an object \
(type bottle))) (target (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen))))))). \
Begin plans with (in-package :pp-tut), and put things into the world with (spawn-object '((x y z) (0 0 0 1)) \
:bottle 'bottle-1). The resource planwright://tutorial teaches the language, planwright://manual is the \
reference.";

/// Answers requests until there are none any more.
pub(crate) struct Server {
    world: World,
    is_initialized: bool,
}

/// Why a request has no result.
pub(super) struct Refusal {
    code: i64,
    message: String,
}

impl Refusal {
    fn new(code: i64, message: impl Into<String>) -> Refusal {
        let message = message.into();
        Refusal { code, message }
    }
}

impl Server {
    /// A server for a world.
    pub(crate) fn new(world: World) -> Server {
        Server {
            world,
            is_initialized: false,
        }
    }

    /// Answers what comes, line by line.
    pub(crate) fn serve(&mut self, input: impl BufRead, mut output: impl Write) -> io::Result<()> {
        let mut input = input;
        while let Some(line) = next_line(&mut input)? {
            let answer = match line {
                Ok(line) if line.iter().all(u8::is_ascii_whitespace) => None,
                Ok(line) => self.answer(&line),
                Err(TooLong) => Some(error(
                    &Value::Null,
                    &Refusal::new(
                        INVALID_REQUEST,
                        format!("a request has {MAX_REQUEST} bytes at most"),
                    ),
                )),
            };
            if let Some(answer) = answer {
                writeln!(output, "{answer}")?;
                output.flush()?;
            }
        }
        Ok(())
    }

    /// The answer to a request; `None` to a notification.
    pub(super) fn answer(&mut self, line: &[u8]) -> Option<Value> {
        let request: Value = match serde_json::from_slice(line) {
            Ok(request) => request,
            Err(why) => return Some(no_json(&why)),
        };
        let wrong = |why: &str| Some(error(&Value::Null, &Refusal::new(INVALID_REQUEST, why)));
        let Value::Object(fields) = &request else {
            return wrong("a request is one object: batches are not taken");
        };
        let id = fields.get("id").cloned();
        if fields.get("jsonrpc") != Some(&Value::from("2.0")) {
            return wrong("\"jsonrpc\": \"2.0\" is missing");
        }
        if let Some(id) = &id
            && !(id.is_string() || id.is_i64() || id.is_u64())
        {
            return wrong("an id is a string or an integer");
        }
        let Some(method) = fields.get("method").and_then(Value::as_str) else {
            // An answer: nothing has been asked of the client.
            return match fields.contains_key("result") || fields.contains_key("error") {
                true => None,
                false => wrong("\"method\" is missing"),
            };
        };
        let nothing = json!({});
        let parameters = fields.get("params").unwrap_or(&nothing);
        let result = self.result(method, parameters);
        let id = id?;
        Some(match result {
            Ok(result) => json!({"jsonrpc": "2.0", "id": id, "result": result}),
            Err(refusal) => error(&id, &refusal),
        })
    }

    fn result(&mut self, method: &str, parameters: &Value) -> Result<Value, Refusal> {
        match method {
            "ping" => return Ok(json!({})),
            "initialize" => {
                self.is_initialized = true;
                return Ok(initialized(parameters));
            }
            _ if method.starts_with("notifications/") => return Ok(json!({})),
            _ if !self.is_initialized => {
                let why = "the session has not begun: \"initialize\" comes first";
                return Err(Refusal::new(INVALID_REQUEST, why));
            }
            _ => {}
        }
        let text = |name: &str| {
            let found = parameters.get(name).and_then(Value::as_str);
            found.ok_or_else(|| {
                Refusal::new(
                    INVALID_PARAMS,
                    format!("params.{name} is missing: a string was expected"),
                )
            })
        };
        match method {
            "tools/list" => {
                let tools: Vec<Value> = TOOLS.iter().map(described).collect();
                Ok(json!({"tools": tools}))
            }
            "tools/call" => {
                let name = text("name")?;
                let given = parameters.get("arguments").unwrap_or(&Value::Null);
                let answer = called(&mut self.world, name, given);
                let answer = answer.map_err(|why| Refusal::new(INVALID_PARAMS, why))?;
                Ok(answer.content())
            }
            "resources/list" => Ok(json!({"resources": documents::list()})),
            "resources/templates/list" => Ok(json!({"resourceTemplates": []})),
            "resources/read" => {
                let uri = text("uri")?;
                let read = documents::read(&mut self.world, uri);
                read.map_err(|why| Refusal::new(RESOURCE_NOT_FOUND, why))
            }
            _ => Err(Refusal::new(
                METHOD_NOT_FOUND,
                format!("there is no method {method}"),
            )),
        }
    }
}

/// What the client learns at first. It gets the version that it asks for, or else the newest.
fn initialized(parameters: &Value) -> Value {
    let wanted = parameters.get("protocolVersion").and_then(Value::as_str);
    let spoken = VERSIONS.iter().find(|version| Some(**version) == wanted);
    json!({
        "protocolVersion": spoken.or(VERSIONS.first()),
        "capabilities": {"tools": {}, "resources": {}},
        "serverInfo": {"name": "planwright", "version": env!("CARGO_PKG_VERSION")},
        "instructions": INSTRUCTIONS,
    })
}

fn error(id: &Value, refusal: &Refusal) -> Value {
    let Refusal { code, message } = refusal;
    json!({"jsonrpc": "2.0", "id": id, "error": {"code": code, "message": message}})
}

fn no_json(why: &serde_json::Error) -> Value {
    let why = format!("this is no JSON: {why}");
    error(&Value::Null, &Refusal::new(PARSE_ERROR, why))
}

/// The error about a message that cannot be read, if it cannot.
pub(super) fn unread(message: &[u8]) -> Option<Value> {
    let read: Result<Value, _> = serde_json::from_slice(message);
    read.err().map(|why| no_json(&why))
}

/// Does a message ask for a session to begin?
pub(super) fn is_initialize(message: &[u8]) -> bool {
    let read: Option<Value> = serde_json::from_slice(message).ok();
    read.is_some_and(|read| read["method"] == "initialize" && read.get("id").is_some())
}
