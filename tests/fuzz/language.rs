//! Targets that are programs: the reader, the printer, FORMAT, and the evaluator with all that
//! reads a program at the prompt.

use super::corpus;
use super::target::{Taken, Taker, Target};
use lisp::Image;
use lisp::guard::heap::HeapLimit;
use lisp::reader::{Completeness, Lexer, Reader, Token, TokenKind, is_complete};
use session::dialogue::{Converse, Evaluate, Event, Outcome, Repeat};
use session::{LogLevel, Session, SessionOptions};

/// What an image or a session takes before another is made: texts leave names and objects.
const MAX_INPUTS: usize = 2000;

pub(super) const WORDS: &[&str] = &[
    "(",
    ")",
    "()",
    "'",
    "`",
    ",",
    ",@",
    "#'",
    "#(",
    "#2A(",
    "#+",
    "#-",
    "#.",
    "#x",
    "#36r",
    "#*",
    "#:",
    "#\\",
    "#\\Space",
    "#|",
    "|#",
    "|",
    "\\",
    "\"",
    ";",
    "\n",
    " ",
    " . ",
    "a",
    ":",
    "::",
    "cl:car",
    "1.5d0",
    "#1=",
    "#1#",
    "#S(",
    "#c(",
    "#p",
    "#<",
    "&rest ",
    "&key ",
    "&optional ",
    "&body ",
    "nil",
    "t ",
    "\u{feff}",
    "\u{1f916}",
    "lambda ",
    "(quote ",
    "(funcall ",
    "(apply ",
    "(loop ",
    "(let (",
    "(setf ",
    "(defun ",
    "(defmacro ",
    "(values ",
    "(a motion (type ",
    "(perform ",
    "(cpl:par ",
    "(cpl:pursue ",
    "(cpl:with-failure-handling (",
    "(handler-case ",
    "(restart-case ",
    "(unwind-protect ",
    "(block ",
    "(return-from ",
    "(tagbody ",
    "(go ",
    "(catch ",
    "(throw ",
    "(sort ",
    "(make-array ",
    "(coerce ",
    "(expt ",
    "(subseq ",
    "(a location (",
    "(an object (type ",
    "(format nil ",
    "(prin1-to-string ",
];

/// Directives of FORMAT.
const DIRECTIVES: &[&str] = &[
    "~a",
    "~s",
    "~d",
    "~:d",
    "~@d",
    "~10,'0d",
    "~b",
    "~o",
    "~x",
    "~36r",
    "~r",
    "~:r",
    "~@r",
    "~:@r",
    "~f",
    "~8,3f",
    "~,,2f",
    "~e",
    "~12,4,2,1,'*,'x,'ee",
    "~g",
    "~$",
    "~2,3,8,'*$",
    "~c",
    "~:c",
    "~@c",
    "~%",
    "~&",
    "~|",
    "~~",
    "~\n  ",
    "~t",
    "~10,4t",
    "~10,2@t",
    "~*",
    "~:*",
    "~2@*",
    "~?",
    "~@?",
    "~(",
    "~:@(",
    "~)",
    "~[",
    "~:[",
    "~@[",
    "~#[",
    "~;",
    "~:;",
    "~]",
    "~{",
    "~:{",
    "~@{",
    "~:@{",
    "~^",
    "~1,2,3^",
    "~}",
    "~:}",
    "~<",
    "~:<",
    "~10<",
    "~>",
    "~:>",
    "~@>",
    "~_",
    "~:@_",
    "~i",
    "~w",
    "~p",
    "~:@p",
    "~v",
    "~#",
    "~'",
    "~,",
    "~/",
    "~/car/",
    "~-1",
    "~9999",
    "~va",
    "~v,v,v,v<",
    "~3000a",
    "~:",
];

/// Arguments for FORMAT.
const ARGUMENTS: &[&str] = &[
    "1 2 3",
    "nil",
    "",
    "\"text\" 'sym",
    "'(1 2 3)",
    "'((1 2) (3 4))",
    "1.5 -2d10 1/3",
    "100000000000000000000000 -7",
    "#\\a #\\Space",
    "'(a . b)",
    "#(1 2)",
    "1d300 1d-300",
    "3999 4000 0",
    ":key \"a~ab\" '(1)",
    "'#1=(a . #1#)",
];

/// Evaluations end at this poll at the latest.
const MAX_POLLS: u64 = 60;

/// Names of what would touch files, open windows or wait: texts with them are left out.
pub(super) const LEFT_OUT: &[&str] = &[
    "open",
    "file",
    "director",
    "record",
    "picture",
    "save",
    "load",
    "view",
    "gif",
    "film",
    "transcript",
    "animation",
    "ed ",
];

pub(super) fn targets() -> Vec<Target> {
    let target = |name, share, least_read, open| Target {
        name,
        share,
        least_read,
        words: WORDS,
        corpus: corpus::programs,
        open,
    };
    vec![
        target("reader", 240, 70, reader),
        target("printer", 60, 60, printer),
        Target {
            words: DIRECTIVES,
            corpus: control_strings,
            ..target("format", 70, 25, format)
        },
        target("evaluator", 40, 30, evaluator),
        target("debugger", 10, 50, debugger),
        target("prompt", 10, 20, prompt),
    ]
}

fn control_strings() -> Vec<Vec<u8>> {
    let programs = corpus::programs();
    let strings = programs
        .iter()
        .flat_map(|form| form.split(|byte| *byte == b'"').skip(1).step_by(2));
    let directives = DIRECTIVES
        .iter()
        .map(|directive| directive.as_bytes().to_vec());
    strings
        .filter(|string| string.contains(&b'~'))
        .map(<[u8]>::to_vec)
        .chain(directives)
        .collect()
}

/// Reads all forms; whether the text is complete has to agree.
fn reader() -> Taker {
    let mut image = Image::new();
    let mut taken = 0;
    Box::new(move |input| {
        taken += 1;
        if taken % MAX_INPUTS == 0 {
            image = Image::new();
        }
        let text = String::from_utf8_lossy(input);
        let completeness = is_complete(&text);
        let mut reader = Reader::of_text(&*text);
        let mut ends_inside = false;
        let mut is_wrong = false;
        // Each step moves on, so there are no more steps than bytes.
        for step in 0.. {
            if step > text.len() + 1 {
                return Err("the reader does not reach the end".to_owned());
            }
            match reader.next_form(&mut image) {
                Ok(Some(_)) => {}
                Ok(None) => break,
                Err(error) => {
                    ends_inside = error.is_end_of_file();
                    is_wrong = !ends_inside;
                    break;
                }
            }
        }
        let is_incomplete = matches!(completeness, Completeness::Incomplete { .. });
        // Whether a form follows a feature expression depends on the features.
        let is_feature = |token: Token| {
            matches!(
                token.kind,
                TokenKind::Dispatch {
                    letter: '+' | '-',
                    ..
                }
            )
        };
        let has_features = Lexer::new(&text).any(is_feature);
        if !is_wrong && !has_features && ends_inside != is_incomplete {
            return Err(format!(
                "the reader ends inside: {ends_inside}; {completeness:?}"
            ));
        }
        Ok(Taken::if_read(!is_wrong && !ends_inside))
    })
}

/// Resident memory (bytes) of this process, where the system tells it.
fn resident() -> usize {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split(' ').nth(1)?.parse::<usize>().ok());
    pages.unwrap_or(0) * 4096
}

/// A session that has evaluated a text.
pub(super) fn session(definitions: &str) -> Session {
    let options = SessionOptions {
        log_level: LogLevel::Error,
        heap: Some(HeapLimit {
            // What has been freed may still be resident.
            bytes: resident() + (800 << 20),
            in_use: resident,
        }),
        ..SessionOptions::default()
    };
    let mut session = Session::new(&options).unwrap();
    let outcome = session.evaluate("fuzz", definitions, &mut |_| {});
    assert_eq!(outcome, Outcome::Finished);
    session
}

/// Evaluates a text; the report of a defect, or of the condition that begins with `watched`, is
/// an error. What is evaluated to its end is read.
fn evaluate(session: &mut Session, text: &str, watched: &str) -> Result<Taken, String> {
    let mut problem = None;
    session.interrupt_next_at(MAX_POLLS);
    let outcome = session.evaluate("fuzz", text, &mut |event| {
        let abort = match &event {
            Event::Aborted(abort) => &**abort,
            Event::Stopped(stop) => &stop.abort,
            _ => return,
        };
        if abort.condition == "#<DEFECT>" || abort.report.starts_with(watched) {
            problem = Some(abort.report.clone());
        }
    });
    session
        .interrupt_handle()
        .store(false, std::sync::atomic::Ordering::Relaxed);
    match problem {
        Some(problem) => Err(problem),
        None => Ok(Taken::if_read(outcome == Outcome::Finished)),
    }
}

/// A taker of texts for a session, which is made anew now and then.
fn in_session(
    definitions: &'static str,
    mut take: impl FnMut(&mut Session, &str) -> Result<Taken, String> + 'static,
) -> Taker {
    let mut current = session(definitions);
    let mut taken = 0;
    Box::new(move |input| {
        taken += 1;
        if taken % MAX_INPUTS == 0 {
            current = session(definitions);
        }
        let text = String::from_utf8_lossy(input);
        let folded = text.to_lowercase();
        if LEFT_OUT.iter().any(|name| folded.contains(name)) {
            return Ok(Taken::Refused);
        }
        take(&mut current, &text)
    })
}

/// What is printed is read back as something that prints the same.
const AGAIN: &str = "
    (defun fuzz-again (values)
      (let* ((*print-circle* t)
             (first (prin1-to-string values)))
        (unless (search \"#<\" first)
          (let ((second (handler-case (prin1-to-string (read-from-string first))
                          (reader-error (e) (error \"Unreadable: ~a: ~a\" first e))
                          (end-of-file () (error \"Unreadable: ~a\" first)))))
            (unless (equal first second)
              (error \"Unreadable: ~a and ~a\" first second))))))";

fn printer() -> Taker {
    in_session(AGAIN, |session, text| {
        evaluate(
            session,
            &format!("(fuzz-again '({text}\n))"),
            "Unreadable: ",
        )
    })
}

fn format() -> Taker {
    in_session("", |session, text| {
        let control = text.replace('\\', "\\\\").replace('"', "\\\"");
        let arguments = ARGUMENTS[text.len() % ARGUMENTS.len()];
        evaluate(
            session,
            &format!("(format nil \"{control}\" {arguments})"),
            "\0",
        )
    })
}

fn evaluator() -> Taker {
    in_session("", |session, text| evaluate(session, text, "\0"))
}

/// A condition opens the debugger, which takes what is typed.
fn debugger() -> Taker {
    const TYPED: &[&str] = &[
        ":bt",
        ":locals",
        ":up",
        "(list 1 2)",
        "0",
        "(error \"x\")",
        ":tasks",
        "a",
        "q",
    ];
    in_session("", |session, text| {
        session.set_interactive(true);
        let mut done = evaluate(session, text, "\0");
        for at in 0..12 {
            if done.is_err() || session.level() == 0 {
                break;
            }
            let typed = TYPED[(text.len() + at * 5) % TYPED.len()];
            // What opens the debugger is read there, too.
            done = evaluate(session, typed, "\0").map(|_| Taken::Read);
        }
        while done.is_ok() && session.level() > 0 {
            done = evaluate(session, "q", "\0").map(|_| Taken::Read);
        }
        session.set_interactive(false);
        done
    })
}

/// What the prompt does with a text that is being typed, and `planwright check` with a file.
fn prompt() -> Taker {
    in_session("", |session, text| {
        for at in (0..=text.len()).step_by(text.len() / 4 + 1) {
            let at = (at..=text.len()).find(|at| text.is_char_boundary(*at));
            let at = at.unwrap_or(text.len());
            let _ = (session.completions(text, at), session.hint(text, at));
        }
        let found = session.check("fuzz", text);
        Ok(Taken::if_read(found.is_empty()))
    })
}
