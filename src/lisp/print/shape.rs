//! How lists are laid out: data as filled lines, code with the indentation of its operator.

use crate::image::Image;
use crate::value::Value;
use crate::value::document::Newline;
use crate::value::function::Body;
use crate::value::known;
use crate::value::symbol::{FunctionCell, Sym};

/// A layout instruction before an element of a list.
#[derive(Clone, Copy)]
pub(super) enum Layout {
    Space,
    Break(Newline),
    Block(i64),
    Current,
    /// Start of an inner block without parentheses, up to the end of the list.
    Inner,
    /// Indentation of a tagbody: tags stand to the left of forms.
    TagIndent,
    /// A new line if the element begins a clause of `loop`.
    LoopBreak,
    /// A break before a lambda list keyword, a fill newline before another parameter.
    ParameterBreak,
}

/// One element of a list: what precedes it, and how it is printed if it is a list.
pub(super) struct Step {
    pub(super) before: &'static [Layout],
    pub(super) style: Style,
}

/// How a value is printed.
#[derive(Clone, Copy)]
pub(super) enum Style {
    /// As its operator requires.
    Auto,
    /// As a list of that shape; `NIL` as `()`.
    List(&'static Shape),
}

/// The layout of a list.
pub(super) struct Shape {
    /// How the first element is printed.
    pub(super) first: Style,
    /// The elements after the first one.
    pub(super) steps: &'static [Step],
    /// The elements after those, in turn.
    pub(super) rest: &'static [Step],
}

/// The layout that a list gets.
#[derive(Clone, Copy)]
pub(super) enum Form {
    Shape(&'static Shape),
    /// A macro whose body begins after this many arguments.
    Macro(usize),
    /// `'x`, `#'x`, `` `x ``, `,x`, `,@x`: the text before the only argument.
    Prefix(&'static str),
}

use Layout::{Block, Break, Current, Inner, LoopBreak, ParameterBreak, Space, TagIndent};
use Newline::{Fill, Linear, Mandatory, Miser};

const fn step(before: &'static [Layout]) -> Step {
    Step {
        before,
        style: Style::Auto,
    }
}

const fn list(before: &'static [Layout], shape: &'static Shape) -> Step {
    Step {
        before,
        style: Style::List(shape),
    }
}

const fn shape(steps: &'static [Step], rest: &'static [Step]) -> Shape {
    Shape {
        first: Style::Auto,
        steps,
        rest,
    }
}

const LINEAR_REST: &[Step] = &[step(&[Space, Break(Linear)])];
const BODY: &[Step] = &[step(&[Block(1), Space, Break(Linear)])];
const TAGS: &[Step] = &[step(&[Space, TagIndent, Break(Linear)])];

/// Data: as many elements on a line as fit.
pub(super) static FILL: Shape = shape(&[], &[step(&[Space, Break(Fill)])]);
/// All elements on one line, or each on its own.
static LINEAR: Shape = shape(&[], LINEAR_REST);
/// Calls of functions: arguments below each other.
static CALL: Shape = shape(
    &[step(&[Space, Break(Fill), Current])],
    &[step(&[Space, Break(Fill)])],
);
static SPREAD_CALL: Shape = shape(
    &[step(&[Space, Break(Fill), Current])],
    &[step(&[Space, Break(Mandatory)])],
);
static PARAMETERS: Shape = Shape {
    first: Style::List(&LINEAR),
    steps: &[],
    rest: &[list(&[Space, ParameterBreak], &LINEAR)],
};
static LAMBDA: Shape = shape(&[list(&[Block(3), Space, Break(Fill)], &PARAMETERS)], BODY);
static BLOCK: Shape = shape(&[step(&[Block(3), Space, Break(Fill)])], BODY);
static IF: Shape = shape(
    &[step(&[Space, Current])],
    &[step(&[Space, Break(Mandatory)])],
);
static BINDINGS: Shape = Shape {
    first: Style::List(&LINEAR),
    steps: &[],
    rest: &[list(&[Space, Break(Linear)], &LINEAR)],
};
static LET: Shape = shape(
    &[
        list(&[Space, Break(Miser)], &BINDINGS),
        step(&[Block(1), Space, Break(Mandatory)]),
    ],
    LINEAR_REST,
);
static LOCAL_FUNCTION: Shape = shape(
    &[
        list(&[Block(3), Space, Break(Fill)], &PARAMETERS),
        step(&[Block(1), Space, Break(Mandatory)]),
    ],
    LINEAR_REST,
);
static LOCAL_FUNCTIONS: Shape = Shape {
    first: Style::List(&LOCAL_FUNCTION),
    steps: &[],
    rest: &[list(&[Space, Break(Linear)], &LOCAL_FUNCTION)],
};
static FLET: Shape = shape(
    &[
        list(&[Space, Break(Miser)], &LOCAL_FUNCTIONS),
        step(&[Block(1), Space, Break(Mandatory)]),
    ],
    LINEAR_REST,
);
static PROGV: Shape = shape(
    &[
        step(&[Block(3), Space, Break(Linear)]),
        step(&[Space, Break(Linear)]),
    ],
    BODY,
);
static PROG2: Shape = shape(
    &[
        step(&[Block(3), Space, Break(Fill)]),
        step(&[Space, Break(Linear)]),
    ],
    BODY,
);
static SETQ: Shape = shape(
    &[
        step(&[Space, Break(Miser), Inner, Block(2)]),
        step(&[Space, Break(Fill), Block(0)]),
    ],
    &[
        step(&[Space, Break(Mandatory), Block(2)]),
        step(&[Space, Break(Fill), Block(0)]),
    ],
);
static TAGBODY: Shape = shape(&[], TAGS);
static CASE_CLAUSE: Shape = Shape {
    first: Style::List(&FILL),
    steps: &[],
    rest: LINEAR_REST,
};
static CASE: Shape = shape(
    &[step(&[Space, Block(3), Break(Fill)])],
    &[list(&[Block(1), Space, Break(Linear)], &CASE_CLAUSE)],
);
static TYPECASE: Shape = shape(
    &[step(&[Space, Block(3), Break(Fill)])],
    &[list(&[Block(1), Space, Break(Linear)], &LINEAR)],
);
static DEFUN: Shape = shape(
    &[
        step(&[Space, Break(Miser), Current]),
        list(&[Space, Break(Fill)], &PARAMETERS),
    ],
    BODY,
);
static QUALIFIED_DEFMETHOD: Shape = shape(
    &[
        step(&[Space, Break(Miser), Current]),
        step(&[Space]),
        list(&[Space, Break(Fill)], &PARAMETERS),
    ],
    BODY,
);
static DEFPACKAGE_CLAUSE: Shape = shape(&[step(&[Space, Current, Break(Miser)])], LINEAR_REST);
static DEFPACKAGE: Shape = shape(
    &[step(&[Space, Block(3), Break(Fill)])],
    &[list(
        &[Block(1), Space, Break(Mandatory)],
        &DEFPACKAGE_CLAUSE,
    )],
);
static DESTRUCTURING_BIND: Shape = shape(
    &[
        list(&[Block(3), Space, Break(Linear)], &PARAMETERS),
        step(&[Space, Break(Linear)]),
    ],
    BODY,
);
static DO_BINDING: Shape = shape(&[step(&[Space, Break(Miser), Current])], LINEAR_REST);
static DO_BINDINGS: Shape = Shape {
    first: Style::List(&DO_BINDING),
    steps: &[],
    rest: &[list(&[Space, Break(Mandatory)], &DO_BINDING)],
};
static DO: Shape = shape(
    &[
        list(&[Space, Current], &DO_BINDINGS),
        list(&[Space, Break(Linear)], &LINEAR),
    ],
    TAGS,
);
static DOLIST_BINDING: Shape = shape(&[step(&[Space, Break(Fill), Current])], LINEAR_REST);
static DOLIST: Shape = shape(
    &[list(&[Block(3), Space, Break(Fill)], &DOLIST_BINDING)],
    TAGS,
);
static PROG: Shape = shape(&[list(&[Space, Break(Miser)], &FILL)], TAGS);
static EXTENDED_LOOP: Shape = shape(&[step(&[Space, Current])], &[step(&[Space, LoopBreak])]);

/// Words that begin a clause of `loop`.
const LOOP_CLAUSES: &[&str] = &[
    "AND",
    "WITH",
    "FOR",
    "INITIALLY",
    "FINALLY",
    "DO",
    "DOING",
    "COLLECT",
    "COLLECTING",
    "APPEND",
    "APPENDING",
    "NCONC",
    "NCONCING",
    "COUNT",
    "COUNTING",
    "SUM",
    "SUMMING",
    "MAXIMIZE",
    "MAXIMIZING",
    "MINIMIZE",
    "MINIMIZING",
    "IF",
    "WHEN",
    "UNLESS",
    "END",
    "WHILE",
    "UNTIL",
    "REPEAT",
    "ALWAYS",
    "NEVER",
    "THEREIS",
];

/// Does the element of an extended `loop` begin a clause?
pub(super) fn begins_loop_clause(image: &Image, element: &Value) -> bool {
    element
        .as_symbol()
        .is_some_and(|sym| LOOP_CLAUSES.contains(&image.name(sym)))
}

/// Is the value a lambda list keyword, before which a line breaks?
pub(super) fn is_parameter_keyword(element: &Value) -> bool {
    matches!(
        element.as_symbol(),
        Some(known::L_OPTIONAL | known::L_AUX | known::L_REST | known::L_BODY | known::L_KEY)
    )
}

/// The only argument of a list such as `(quote x)`.
fn only_argument(list: &Value) -> bool {
    let rest = list.cdr_or_nil();
    rest.as_cons().is_some_and(|c| c.cdr().is_nil())
}

/// The prefix that a list of two elements prints with.
pub(super) fn prefix(list: &Value) -> Option<&'static str> {
    let prefix = match list.car_or_nil().as_symbol()? {
        known::QUOTE => "'",
        known::FUNCTION => "#'",
        known::QUASIQUOTE => "`",
        known::UNQUOTE => ",",
        known::UNQUOTE_SPLICING => ",@",
        _ => return None,
    };
    only_argument(list).then_some(prefix)
}

/// Does the list print with a prefix that the dotted tail of a list must show, too?
pub(super) fn is_backquote_part(list: &Value) -> bool {
    matches!(
        list.car_or_nil().as_symbol(),
        Some(known::QUASIQUOTE | known::UNQUOTE | known::UNQUOTE_SPLICING)
    ) && only_argument(list)
}

/// The layout of a list.
pub(super) fn form(image: &Image, list: &Value) -> Form {
    if let Some(prefix) = prefix(list) {
        return Form::Prefix(prefix);
    }
    let Value::Symbol(operator, ..) = list.car_or_nil() else {
        return Form::Shape(&FILL);
    };
    if let Some(shape) = shape_of(operator, list) {
        return Form::Shape(shape);
    }
    match &image.symbol(operator).function {
        FunctionCell::Unbound => Form::Shape(&FILL),
        FunctionCell::Function(_) => Form::Shape(&CALL),
        FunctionCell::Macro(_) | FunctionCell::Builtin => {
            match arguments_before_body(image, operator) {
                Some(count) => Form::Macro(count),
                None => Form::Shape(&CALL),
            }
        }
    }
}

/// How many arguments a macro takes before its `&body`, if it has one.
fn arguments_before_body(image: &Image, operator: Sym) -> Option<usize> {
    if let FunctionCell::Macro(function) = &image.symbol(operator).function {
        let Body::Closure { code, .. } = &function.body else {
            return body_position(image.entry(operator)?.lambda_list());
        };
        let mut count = 0;
        for parameter in image
            .content_to_look_at(code)?
            .lambda_list
            .shown()
            .iter_list()
        {
            match parameter.as_symbol() {
                Some(known::L_BODY) => return Some(count),
                Some(known::L_OPTIONAL) => {}
                _ => count += 1,
            }
        }
        return None;
    }
    body_position(image.entry(operator)?.lambda_list())
}

/// How many parameters precede `&body` in a lambda list, if it has that.
fn body_position(lambda_list: &str) -> Option<usize> {
    let mut depth = 0_usize;
    let mut count = 0;
    for word in lambda_list.split_whitespace() {
        if depth == 0 {
            match word {
                "&body" => return Some(count),
                "&optional" => {}
                _ => count += 1,
            }
        }
        depth += word.matches('(').count();
        depth = depth.saturating_sub(word.matches(')').count());
    }
    None
}

fn shape_of(operator: Sym, list: &Value) -> Option<&'static Shape> {
    Some(match operator {
        known::LAMBDA => &LAMBDA,
        known::DECLARE | known::DECLAIM => &SPREAD_CALL,
        known::BLOCK
        | known::CATCH
        | known::RETURN_FROM
        | known::THROW
        | known::EVAL_WHEN
        | known::MULTIPLE_VALUE_CALL
        | known::MULTIPLE_VALUE_PROG1
        | known::UNWIND_PROTECT
        | known::DEFCONSTANT
        | known::DEFPARAMETER
        | known::DEFSTRUCT
        | known::DEFVAR
        | known::MULTIPLE_VALUE_SETQ
        | known::PROG1
        | known::PRINT_UNREADABLE_OBJECT
        | known::UNLESS
        | known::WHEN
        | known::WITH_SIMPLE_RESTART
        | known::WITH_HASH_TABLE_ITERATOR
        | known::WITH_PACKAGE_ITERATOR
        | known::WITH_INPUT_FROM_STRING
        | known::WITH_OUTPUT_TO_STRING
        | known::WITH_OPEN_FILE
        | known::WITH_OPEN_STREAM => &BLOCK,
        known::FLET | known::LABELS | known::MACROLET => {
            let has_body = list.cdr_or_nil().cdr_or_nil().as_cons().is_some();
            if has_body { &FLET } else { &FILL }
        }
        known::QUOTE | known::FUNCTION | known::QUASIQUOTE => &FILL,
        known::IF => &IF,
        known::LET | known::LET_STAR | known::SYMBOL_MACROLET => &LET,
        known::LOCALLY
        | known::PROGN
        | known::STEP
        | known::TIME
        | known::WITH_STANDARD_IO_SYNTAX => &LINEAR,
        known::PROGV => &PROGV,
        known::SETQ | known::PSETQ | known::SETF | known::PSETF => &SETQ,
        known::TAGBODY => &TAGBODY,
        known::CASE | known::CCASE | known::ECASE => &CASE,
        known::CTYPECASE | known::ETYPECASE | known::TYPECASE => &TYPECASE,
        known::DEFINE_MODIFY_MACRO
        | known::DEFINE_SETF_EXPANDER
        | known::DEFMACRO
        | known::DEFSETF
        | known::DEFTYPE
        | known::DEFUN => &DEFUN,
        known::DEFMETHOD => {
            let third = list.cdr_or_nil().cdr_or_nil().car_or_nil();
            if third.as_cons().is_some() {
                &DEFUN
            } else {
                &QUALIFIED_DEFMETHOD
            }
        }
        known::DEFPACKAGE => &DEFPACKAGE,
        known::DESTRUCTURING_BIND => &DESTRUCTURING_BIND,
        known::DO | known::DO_STAR => &DO,
        known::DO_ALL_SYMBOLS
        | known::DO_EXTERNAL_SYMBOLS
        | known::DO_SYMBOLS
        | known::DOLIST
        | known::DOTIMES => &DOLIST,
        known::LOOP => {
            let clauses = list.cdr_or_nil();
            let is_simple = clauses
                .as_cons()
                .is_none_or(|c| c.car().as_cons().is_some());
            if is_simple {
                &SPREAD_CALL
            } else {
                &EXTENDED_LOOP
            }
        }
        known::MULTIPLE_VALUE_BIND | known::PROG2 => &PROG2,
        known::PROG | known::PROG_STAR => &PROG,
        _ => return None,
    })
}
