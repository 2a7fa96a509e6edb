//! The tools that clients can call.

use std::time::Duration;

use serde_json::{Value, json};

use super::World;
use super::arguments::{Arguments, Kind, Parameter};
use super::run::{MAX_REAL, REAL, Ran, SIMULATED, run};
use crate::manual;
use closest_name::closest_name;
use session::Session;
use session::dialogue::Evaluate;
use session::sweeping::{SweepFile, Worlds, mistake};
use sweep::summary::{Summary, Title};
use view::picture::View;
use view::watch::base64;

/// A tool.
pub(super) struct Tool {
    pub(super) name: &'static str,
    pub(super) doc: &'static str,
    pub(super) parameters: &'static [Parameter],
    pub(super) call: fn(&mut World, &Arguments) -> Answer,
}

/// What a tool answers.
pub(super) struct Answer {
    content: Vec<Value>,
    data: Option<Value>,
    is_error: bool,
}

impl Answer {
    fn text(text: impl Into<String>) -> Answer {
        Answer {
            content: vec![json!({"type": "text", "text": text.into()})],
            data: None,
            is_error: false,
        }
    }

    /// Why the tool was not used.
    pub(super) fn refused(why: impl Into<String>) -> Answer {
        Answer {
            is_error: true,
            ..Answer::text(why)
        }
    }

    fn of(result: Result<Answer, String>) -> Answer {
        result.unwrap_or_else(Answer::refused)
    }

    /// The answer as clients get it.
    pub(super) fn json(self) -> Value {
        let mut json = json!({"content": self.content, "isError": self.is_error});
        if let Some(data) = self.data {
            json["structuredContent"] = data;
        }
        json
    }
}

const PLAN: Parameter = Parameter {
    name: "plan",
    kind: Kind::Text,
    is_required: true,
    doc: "The text of the plan, forms of the plan language",
};
const SECONDS: Parameter = Parameter {
    name: "simulated_seconds",
    kind: Kind::Number(0.1, 1e5),
    is_required: false,
    doc: "Simulated time that it may take [default: 600]",
};
const REAL_SECONDS: Parameter = Parameter {
    name: "real_seconds",
    kind: Kind::Number(0.1, MAX_REAL),
    is_required: false,
    doc: "Real time that it may take [default: 60]",
};
const WHERE: Parameter = Parameter {
    name: "in",
    kind: Kind::Word(&["fresh", "copy", "continue"]),
    is_required: false,
    doc: "fresh: in a fresh kitchen without objects, which is then the world at hand [default]; copy: in the world at \
          hand, which is afterwards as it was before; continue: in the world at hand",
};
const VIEW: Parameter = Parameter {
    name: "view",
    kind: Kind::Word(&[
        "kitchen", "top", "map", "robot", "table", "island", "camera", "none",
    ]),
    is_required: false,
    doc: "From where the picture is taken [default: kitchen]; none for no picture",
};

/// All tools.
pub(super) static TOOLS: &[Tool] = &[
    Tool {
        name: "list_actions",
        doc: "The actions that a plan can perform, with their keys, what each takes, and an example.",
        parameters: &[],
        call: |world, _| Answer::text(manual::actions(world.at_hand().image())),
    },
    Tool {
        name: "list_motions",
        doc: "The motions that a plan can perform, with their keys and what each takes.",
        parameters: &[],
        call: |world, _| Answer::text(manual::motions(world.at_hand().image())),
    },
    Tool {
        name: "list_object_types",
        doc: "The types of objects that can be put into the world, with their mass and the grasps for them.",
        parameters: &[],
        call: |world, _| Answer::text(manual::object_types(world.at_hand())),
    },
    Tool {
        name: "list_furniture",
        doc: "The surfaces and containers of the kitchen: the names by which plans refer to them, and where they are.",
        parameters: &[],
        call: |world, _| {
            Answer::of(told(
                world,
                "(format t \"Surfaces:~%~{~(~a~)~%~}~%Containers:~%~{~(~a~)~%~}\" (pw:list-surfaces) (pw:list-containers))",
            ))
        },
    },
    Tool {
        name: "describe",
        doc: "What is known about a name: a function, a variable, an action, a motion, a failure, a type of objects, \
              an object in the world.",
        parameters: &[Parameter {
            name: "name",
            kind: Kind::Text,
            is_required: true,
            doc: "The name, such as transporting or pp-tut:spawn-object",
        }],
        call: describe,
    },
    Tool {
        name: "check_plan",
        doc: "Finds mistakes in a plan without running it, with their places and what may have been meant.",
        parameters: &[PLAN],
        call: |world, arguments| Answer::of(check(world, arguments)),
    },
    Tool {
        name: "run_plan",
        doc: "Runs a plan within limits: whether it ended without a failure, the failure with its place and an \
              explanation, what was performed, what was printed, and a picture of the world at the end.",
        parameters: &[
            PLAN,
            WHERE,
            VIEW,
            SECONDS,
            REAL_SECONDS,
            Parameter {
                name: "page",
                kind: Kind::Text,
                is_required: false,
                doc: "Name of a page with the whole run, to be written into the folder that the user allows",
            },
        ],
        call: |world, arguments| Answer::of(run_plan(world, arguments)),
    },
    Tool {
        name: "query_world",
        doc: "Asks something about the world at hand, which stays as it is: the values of a form, such as (btr:object-pose \
              'bottle-1) or (prolog '(btr:supported-by ?w ?above ?below)).",
        parameters: &[Parameter {
            name: "form",
            kind: Kind::Text,
            is_required: true,
            doc: "The form",
        }],
        call: |world, arguments| Answer::of(query(world, arguments)),
    },
    Tool {
        name: "picture",
        doc: "A picture of the world at hand.",
        parameters: &[VIEW],
        call: |world, arguments| {
            let view = arguments.text("view").to_owned();
            let picture = picture(world.at_hand(), &view);
            Answer::of(picture.map(|picture| Answer {
                content: picture.into_iter().collect(),
                data: None,
                is_error: false,
            }))
        },
    },
    Tool {
        name: "sweep_plan",
        doc: "Runs a plan in many worlds that differ as a DEFSWEEP in its text says: how often it works, why it fails.",
        parameters: &[
            Parameter {
                name: "plan",
                kind: Kind::Text,
                is_required: true,
                doc: "The text of the plan, with a (defsweep …)",
            },
            Parameter {
                name: "worlds",
                kind: Kind::Integer(1, 200),
                is_required: false,
                doc: "How many worlds [default: 20]",
            },
            Parameter {
                name: "seed",
                kind: Kind::Integer(0, i64::MAX),
                is_required: false,
                doc: "The seed of the worlds [default: 0]",
            },
            REAL_SECONDS,
        ],
        call: |world, arguments| Answer::of(sweep_plan(world, arguments)),
    },
];

/// The tool with a name; an error suggests one.
pub(super) fn tool_named(name: &str) -> Result<&'static Tool, String> {
    let found = TOOLS.iter().find(|tool| tool.name == name);
    found.ok_or_else(|| {
        let names = || TOOLS.iter().map(|tool| tool.name);
        match closest_name(name, names()) {
            Some(near) => format!("there is no tool {name}; did you mean {near}?"),
            None => {
                let names: Vec<&str> = names().collect();
                format!("there is no tool {name}; there are {}", names.join(", "))
            }
        }
    })
}

/// What a function does with the world at hand, which is afterwards as it was before.
fn aside<T>(
    world: &mut World,
    work: impl FnOnce(&mut Session) -> Result<T, String>,
) -> Result<T, String> {
    let session = world.at_hand();
    let before = session.snapshot();
    let done = work(session);
    session
        .restore(&before)
        .map_err(|error| error.to_string())?;
    done
}

/// What a form prints about the world at hand.
fn told(world: &mut World, form: &str) -> Result<Answer, String> {
    let ran = aside(world, |session| {
        run(session, "query", form, 1.0, REAL, None)
    })?;
    Ok(match ran.failure() {
        None => Answer::text(ran.printed),
        Some(why) => Answer::refused(why),
    })
}

fn describe(world: &mut World, arguments: &Arguments) -> Answer {
    let name = arguments.text("name").trim().trim_start_matches('\'');
    let is_name = |c: char| !c.is_whitespace() && !"()\"'`,;|\\#".contains(c);
    if name.is_empty() || !name.chars().all(is_name) {
        return Answer::refused(format!(
            "{name:?} is no name: one word was expected, such as transporting"
        ));
    }
    Answer::of(told(
        world,
        &format!("(in-package :pp-tut) (planwright:describe-topic '{name})"),
    ))
}

fn check(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let lines = findings(world, arguments.text("plan"))?;
    let text = match lines.as_slice() {
        [] => "No mistakes were found.".to_owned(),
        lines => lines.join("\n"),
    };
    Ok(Answer {
        data: Some(json!({"findings": lines})),
        ..Answer::text(text)
    })
}

/// What is found in a plan without running it.
fn findings(world: &World, text: &str) -> Result<Vec<String>, String> {
    let mut session = world.fresh()?;
    session.close();
    // Macros of the plan are expanded.
    session.image_mut().polls().begin(Some(100_000));
    session.image_mut().polls().set_again(Some(10_000));
    let found = session.check("plan", text);
    let lines = found.iter().map(|finding| match &finding.place {
        Some(place) => format!("{place}: {}\n{}", finding.message, place.underlined()),
        None => finding.message.clone(),
    });
    Ok(lines.collect())
}

fn limits(arguments: &Arguments) -> (f64, f64) {
    let simulated = arguments.number("simulated_seconds").unwrap_or(SIMULATED);
    (simulated, arguments.number("real_seconds").unwrap_or(REAL))
}

fn run_plan(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let page = match arguments.text("page") {
        "" => None,
        name => Some(world.page(name)?),
    };
    let (simulated, real) = limits(arguments);
    let attempt = |session: &mut Session| {
        let plan = arguments.text("plan");
        let ran = run(session, "plan", plan, simulated, real, page.as_deref())?;
        let explanation = match &ran.values {
            Err(session::Failure::Unhandled(_)) => explained(session),
            _ => String::new(),
        };
        let picture = picture(session, arguments.text("view"))?;
        Ok::<_, String>((ran, explanation, picture))
    };
    let (ran, explanation, picture) = match arguments.text("in") {
        "continue" => attempt(world.at_hand())?,
        "copy" => aside(world, attempt)?,
        _ => {
            let mut session = world.fresh()?;
            let attempted = attempt(&mut session)?;
            world.take(session);
            attempted
        }
    };
    let mut text = said(&ran);
    if !explanation.is_empty() {
        text.push_str(&format!("\n\nExplanation:\n{explanation}"));
    }
    let mut data = ran.json();
    data["explanation"] = Value::from(explanation);
    let mut answer = Answer::text(text);
    answer.content.extend(picture);
    answer.data = Some(data);
    answer.is_error = ran.values.is_err();
    Ok(answer)
}

/// What came of a run, in words.
fn said(ran: &Ran) -> String {
    let mut text = match ran.failure() {
        None => format!(
            "The plan ended without a failure after {:.1} s.",
            ran.simulated
        ),
        Some(why) => format!("The plan failed after {:.1} s.\n{why}", ran.simulated),
    };
    if let Ok(values) = &ran.values
        && !values.is_empty()
    {
        text.push_str(&format!("\n\nValues:\n{values}"));
    }
    if !ran.printed.is_empty() {
        text.push_str(&format!("\n\nPrinted:\n{}", ran.printed));
    }
    if !ran.trace.is_empty() {
        text.push_str(&format!("\n\nPerformed:\n{}", ran.trace.join("\n")));
    }
    text
}

/// What `explain` tells of the last failure.
fn explained(session: &mut Session) -> String {
    let ran = run(session, "explain", "(planwright:explain)", 1.0, REAL, None);
    ran.map(|ran| ran.printed).unwrap_or_default()
}

fn query(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let form = arguments.text("form");
    let ran = aside(world, |session| {
        run(session, "form", form, SIMULATED, REAL, None)
    })?;
    Ok(match (&ran.values, ran.failure()) {
        (Ok(values), _) => Answer::text(format!("{}{values}", ran.printed)),
        (Err(_), why) => Answer::refused(why.unwrap_or_default()),
    })
}

/// A picture as content; none if none is wanted.
fn picture(session: &mut Session, view: &str) -> Result<Option<Value>, String> {
    let view = match view {
        "none" => return Ok(None),
        "" => "kitchen",
        view => view,
    };
    let view = View::NAMED.into_iter().find(|known| known.name() == view);
    let view = view.ok_or("there is no such view")?;
    let image = session.picture(&view, [640, 480]);
    let image = image.map_err(|error| error.to_string())?;
    let png = image.to_png().map_err(|error| error.to_string())?;
    Ok(Some(
        json!({"type": "image", "data": base64(&png), "mimeType": "image/png"}),
    ))
}

fn sweep_plan(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let file = SweepFile {
        name: "plan".to_owned(),
        text: arguments.text("plan").to_owned(),
    };
    let (_, real) = limits(arguments);
    let mut session = world.fresh()?;
    session.set_time_limit(Some(Duration::from_secs_f64(real)));
    let known = file.find(&mut session, None)?;
    let seed = arguments.integer("seed").unwrap_or(0);
    let count = arguments.integer("worlds").unwrap_or(20);
    let make = world.maker();
    let begun = std::time::Instant::now();
    let limit = Duration::from_secs_f64(real);
    let loading = || {
        let mut session = make()?;
        match file.load(&mut session) {
            Some(abort) => Err(abort.report),
            None => Ok(session),
        }
    };
    let mut worlds = Worlds::new(&known.name, seed, Some(limit), loading);
    let mut records = Vec::new();
    for number in 0..count {
        // One world is run in any case.
        if number > 0 && begun.elapsed() > limit {
            break;
        }
        records.push(worlds.run(number, &[]).0);
    }
    if let Some(mistake) = mistake(&records) {
        return Err(mistake);
    }
    let title = Title {
        name: known.name,
        seed,
        goal: known.goal,
    };
    let mut text = Summary::new(&title, &records).to_string();
    if (records.len() as u64) < count {
        text.push_str(&format!(
            "\nOnly {} of {count} worlds were run within {real} s.\n",
            records.len()
        ));
    }
    Ok(Answer {
        data: Some(json!({"records": records})),
        ..Answer::text(text)
    })
}
