//! The tools that clients can call.

use serde_json::Value;

use super::answer::Answer;
use super::arguments::{Arguments, Kind, Parameter, read};
use super::check::check_plan;
use super::documents::read_document;
use super::look;
use super::run::MAX_REAL;
use super::run_plan::run_plan;
use super::sweep::{compare_plans, sweep_plan};
use super::world::World;
use crate::manual;
use closest_name::closest_name;

/// A tool.
pub(crate) struct Tool {
    pub(super) name: &'static str,
    pub(super) doc: &'static str,
    pub(super) parameters: &'static [Parameter],
    pub(super) call: fn(&mut World, &Arguments) -> Answer,
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

const WORLDS: Parameter = Parameter {
    name: "worlds",
    kind: Kind::Integer(1, 200),
    is_required: false,
    doc: "How many worlds [default: 20]",
};
const SEED: Parameter = Parameter {
    name: "seed",
    kind: Kind::Integer(0, i64::MAX),
    is_required: false,
    doc: "The seed of the worlds [default: 0]",
};

/// All tools.
pub(crate) static TOOLS: &[Tool] = &[
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
        call: |world, _| Answer::of(look::furniture(world)),
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
        call: |world, arguments| Answer::of(look::describe(world, arguments)),
    },
    Tool {
        name: "check_plan",
        doc: "Finds mistakes in a plan without running it, with their places and what may have been meant: also as data, \
              with suggestions of what to write instead.",
        parameters: &[
            PLAN,
            Parameter {
                name: "in",
                kind: Kind::Word(&["fresh", "continue"]),
                is_required: false,
                doc: "fresh: as in a fresh session [default]; continue: with what plans have defined in the world at hand, where what \
                      this one defines is known afterwards",
            },
        ],
        call: |world, arguments| Answer::of(check_plan(world, arguments)),
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
        call: |world, arguments| Answer::of(look::query(world, arguments)),
    },
    Tool {
        name: "picture",
        doc: "A picture of the world at hand.",
        parameters: &[VIEW],
        call: |world, arguments| Answer::of(look::look(world, arguments)),
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
            WORLDS,
            SEED,
            REAL_SECONDS,
        ],
        call: |world, arguments| Answer::of(sweep_plan(world, arguments)),
    },
    Tool {
        name: "compare_plans",
        doc: "Runs two plans in the same worlds, which a DEFSWEEP in each text says: how often each works, whether one \
              works more often, and in which worlds they end differently, and how.",
        parameters: &[
            Parameter {
                name: "first",
                kind: Kind::Text,
                is_required: true,
                doc: "The text of one plan, with a (defsweep …)",
            },
            Parameter {
                name: "second",
                kind: Kind::Text,
                is_required: true,
                doc: "The text of the other one, with a (defsweep …) that varies the same",
            },
            WORLDS,
            SEED,
            REAL_SECONDS,
        ],
        call: |world, arguments| Answer::of(compare_plans(world, arguments)),
    },
    Tool {
        name: "read_document",
        doc: "The text of a document: the manual, the tutorial, a lesson, a built-in plan. Without a name, which there \
              are.",
        parameters: &[Parameter {
            name: "name",
            kind: Kind::Text,
            is_required: false,
            doc: "The name, such as tutorial or plans/lessons/see-more.lesson",
        }],
        call: |world, arguments| Answer::of(read_document(world, arguments)),
    },
];

/// The tool with a name; an error suggests one.
fn tool_named(name: &str) -> Result<&'static Tool, String> {
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

/// What a tool answers to arguments.
///
/// # Errors
///
/// There is no such tool, and which one may have been meant.
pub(crate) fn called(world: &mut World, name: &str, given: &Value) -> Result<Answer, String> {
    let tool = tool_named(name)?;
    Ok(match read(tool, given) {
        Ok(given) => (tool.call)(world, &given),
        Err(why) => Answer::refused(why),
    })
}
