//! The program between the reader and the code: names resolved, macros expanded.

use std::rc::Rc;

use super::scope::{Block, Tagbody, Var};
use crate::source::Place;
use crate::value::Value;
use crate::value::code::Parameters;
use crate::value::symbol::Sym;

/// What a call calls.
pub(crate) enum Target {
    /// A global function.
    Global(Sym),
    /// A function that an expression computes.
    Computed(Box<Node>),
}

/// One variable that a form binds.
pub(crate) enum Binding {
    /// A lexical variable.
    Lexical(Rc<Var>),
    /// A dynamic binding.
    Special(Sym),
}

/// An optional or key parameter.
pub(crate) struct Default {
    /// The parameter's own variable: the slot that the machine fills.
    pub var: Rc<Var>,
    /// The value if it is not supplied.
    pub init: Node,
    /// The variable that tells whether it was supplied.
    pub supplied: Option<Binding>,
}

/// What happens at the start of a function, in order.
pub(crate) enum Prologue {
    /// An optional or key parameter gets its default.
    Default(Default),
    /// A parameter that is declared special is bound to its slot's value.
    BindSpecial(Sym, Rc<Var>),
    /// An `&aux` variable.
    Aux(Binding, Node),
}

/// A function expression.
pub(crate) struct LambdaNode {
    /// Name for backtraces and printing.
    pub name: Value,
    /// The parameters as the machine fills them.
    pub parameters: Parameters,
    /// Variables of the parameter slots.
    pub slots: Vec<Rc<Var>>,
    /// Defaults and auxiliary variables.
    pub(crate) prologue: Vec<Prologue>,
    pub body: Node,
    /// Free variables, in the order of the closure's captures.
    pub free: Vec<Rc<Var>>,
    /// The number of the function.
    pub id: usize,
    /// The lambda list as written.
    pub lambda_list: Value,
    /// The documentation string.
    pub doc: Option<Rc<str>>,
}

/// A piece of program.
pub(crate) enum Node {
    /// A constant.
    Const(Value),
    /// The value of a lexical variable.
    Local(Rc<Var>),
    /// Assignment to a lexical variable; the value is the new value.
    SetLocal(Rc<Var>, Box<Node>),
    /// The value of a global or dynamic variable.
    Global(Sym, Place),
    /// Assignment to a global or dynamic variable.
    SetGlobal(Sym, Box<Node>),
    /// A global function as a value.
    Function(Sym, Place),
    /// The function `(setf name)` as a value.
    SetfFunction(Sym, Place),
    If(Box<Node>, Box<Node>, Box<Node>),
    /// `or` of two.
    Or(Box<Node>, Box<Node>),
    Progn(Vec<Node>),
    /// Bindings, made in order once all initial values are known or, if sequential, each after its
    /// own.
    Let {
        /// Variables with initial values.
        bindings: Vec<(Binding, Node)>,
        /// Is each binding visible to the following initial values?
        sequential: bool,
        body: Box<Node>,
    },
    /// Variables bound to the values of a form.
    MultipleValueBind {
        /// The variables.
        bindings: Vec<Binding>,
        /// The form.
        values: Box<Node>,
        body: Box<Node>,
    },
    /// Local functions, which may call each other.
    Labels(Vec<(Rc<Var>, Node)>, Box<Node>),
    Call(Target, Vec<Node>, Place),
    /// A function expression.
    Lambda(Rc<LambdaNode>),
    Block(Rc<Block>, Box<Node>),
    /// An exit from a block in the same function.
    LocalReturn(Rc<Block>, Box<Node>),
    /// An exit from a block by unwinding.
    DynamicReturn(Rc<Block>, Box<Node>),
    /// A tagbody: statements, with the positions of the tags among them.
    Tagbody(Rc<Tagbody>, Vec<Node>, Vec<usize>),
    /// A jump to a tag in the same function.
    LocalGo(Rc<Tagbody>, usize),
    /// A jump by unwinding.
    DynamicGo(Rc<Tagbody>, usize),
    Catch(Box<Node>, Box<Node>),
    /// An exit to a catch, with values.
    Throw(Box<Node>, Box<Node>, Place),
    UnwindProtect(Box<Node>, Box<Node>),
    MultipleValueCall(Box<Node>, Vec<Node>, Place),
    /// `multiple-value-prog1`; the flag distinguishes it from `prog1`, which returns one value.
    Prog1(Box<Node>, Vec<Node>, bool),
    Progv(Box<Node>, Box<Node>, Box<Node>),
    /// Handlers: a list of type specifiers and the functions, around a body.
    Handlers(Value, Vec<Node>, Box<Node>, Place),
    /// Restarts: an expression for the list of them, around a body.
    Restarts(Box<Node>, Box<Node>),
}

impl Node {
    /// The constant `NIL`.
    pub(crate) const NIL: Node = Node::Const(Value::NIL);
}
