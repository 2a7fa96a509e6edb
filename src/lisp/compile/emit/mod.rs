//! Second pass: nodes to code.
//!
//! The emitter knows at every point how many values the function has on the stack and how
//! many dynamic entries it has open, so jumps can drop what they leave behind.

mod branches;
mod calls;
mod exits;
mod jumps;
mod tail_calls;
mod variables;

pub use calls::is_inlined;

use std::collections::BTreeSet;
use std::rc::Rc;

use super::analyze::Compiled;
use super::node::{LambdaNode, Node};
use super::scope::{Block, Tagbody, Var};
use crate::source::Place;
use crate::value::Value;
use crate::value::code::{Capture, Code, Content, Local, Parameters, SharedList, Signature};
use crate::value::known;
use crate::value::operation::Op;
use crate::value::raise::Raise;
use crate::value::symbol::{Sym, SymbolTable};

/// Which values of a form its context uses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Want {
    /// Nothing.
    Effect,
    /// The first.
    One,
    /// All.
    All,
}

struct OpenBlock {
    block: Rc<Block>,
    height: u32,
    dynamic: u32,
    want: Want,
    exits: Vec<usize>,
}

struct OpenTagbody {
    tagbody: Rc<Tagbody>,
    height: u32,
    dynamic: u32,
    /// (operation to patch, tag)
    jumps: Vec<(usize, usize)>,
}

struct Emitter<'a> {
    symbols: &'a SymbolTable,
    id: usize,
    free: &'a [Rc<Var>],
    ops: Vec<Op>,
    constants: Vec<Value>,
    inner: Vec<(Rc<Code>, SharedList<Capture>)>,
    tags: Vec<Vec<u32>>,
    places: Vec<(u32, Place)>,
    locals: Vec<Local>,
    height: u32,
    /// The greatest height so far.
    most: u32,
    dynamic: u32,
    blocks: Vec<OpenBlock>,
    tagbodies: Vec<OpenTagbody>,
}

/// Places that an operation may need beyond the height before it.
const MORE_ROOM: usize = 2;

/// Emits the code of a function.
pub(super) fn emit_function(lambda: &LambdaNode, symbols: &SymbolTable) -> Compiled<Rc<Code>> {
    let mut emitter = Emitter {
        symbols,
        id: lambda.id,
        free: &lambda.free,
        ops: Vec::new(),
        constants: Vec::new(),
        inner: Vec::new(),
        tags: Vec::new(),
        places: Vec::new(),
        locals: Vec::new(),
        height: 0,
        most: 0,
        dynamic: 0,
        blocks: Vec::new(),
        tagbodies: Vec::new(),
    };
    emitter.emit_prologue(lambda)?;
    emitter.emit(&lambda.body, Want::All)?;
    emitter.op(Op::Return);
    jumps::shorten(&mut emitter.ops);
    // Special parameters are bound as long as the frame is there.
    if emitter.dynamic == 0 {
        let name = lambda.name.as_symbol();
        tail_calls::mark(&mut emitter.ops, name, &lambda.parameters);
    }
    emitter.hold_symbols(&lambda.parameters);
    let content = Content {
        ops: emitter.ops.into(),
        constants: emitter.constants,
        inner: emitter.inner,
        tags: emitter.tags.into(),
        places: emitter.places.into(),
        locals: emitter.locals.into(),
        free: lambda.free.iter().map(|var| var.name).collect(),
        lambda_list: Signature::of(&lambda.lambda_list),
        doc: lambda.doc.clone(),
    };
    let name = Signature::of(&lambda.name);
    Ok(Rc::new(Code {
        is_fixed: name.is_fixed() && content.is_fixed(),
        name,
        parameters: lambda.parameters.clone(),
        exact_count: lambda.parameters.exact_count(),
        room: emitter.most as usize + MORE_ROOM,
        content: content.into(),
        unread: None,
    }))
}

fn index(n: usize) -> Compiled<u32> {
    u32::try_from(n).map_err(|_| Raise::program("The form is too large to be compiled."))
}

/// A slot of a parameter.
fn short(slot: u32) -> Compiled<u16> {
    u16::try_from(slot).map_err(|_| Raise::program("A function has too many parameters."))
}

impl Emitter<'_> {
    /// Holds, among the constants, the passing symbols that the code refers to by their numbers.
    fn hold_symbols(&mut self, parameters: &Parameters) {
        let in_ops = self
            .ops
            .iter()
            .filter_map(|op| op.clone().symbol_mut().copied());
        let locals = self.locals.iter().map(|local| local.name);
        let free = self.free.iter().map(|var| var.name);
        let keys = parameters.keys.iter().copied();
        let names: BTreeSet<Sym> = in_ops.chain(locals).chain(free).chain(keys).collect();
        for name in names {
            match self.symbols.held_value(name) {
                Some(held) => self.constants.push(held),
                None => self.symbols.keep(name),
            }
        }
    }

    fn op(&mut self, op: Op) {
        self.most = self.most.max(self.height);
        self.ops.push(op);
    }

    fn here(&self) -> u32 {
        u32::try_from(self.ops.len()).unwrap_or(u32::MAX)
    }

    fn push(&mut self, op: Op) {
        self.op(op);
        self.height += 1;
    }

    fn constant(&mut self, value: &Value) -> Compiled<u32> {
        let i = index(self.constants.len())?;
        self.constants.push(value.clone());
        Ok(i)
    }

    fn at(&mut self, place: Place) {
        if self.places.last().is_none_or(|(_, last)| *last != place) {
            let here = self.here();
            self.places.push((here, place));
        }
    }

    fn patch(&mut self, at: usize) {
        let here = self.here();
        if let Some(target) = self.ops.get_mut(at).and_then(Op::target_mut) {
            *target = here;
        }
    }

    /// Emits a form. Afterwards the stack holds one more value, or no more for `Effect`.
    fn emit(&mut self, node: &Node, want: Want) -> Compiled<()> {
        match node {
            Node::Const(value) => self.emit_constant(value, want)?,
            Node::Local(var) => {
                if want != Want::Effect {
                    self.emit_variable(var);
                }
            }
            Node::SetLocal(var, value) => {
                if want == Want::Effect
                    && let Some(slot) = self.plain_slot(var)
                    && self.emit_advance(slot, value)
                {
                    return Ok(());
                }
                self.emit(value, Want::One)?;
                self.keep_copy(want);
                self.emit_assignment(var);
            }
            Node::Global(name, place) => {
                self.at(*place);
                self.push(Op::Global(*name));
                self.discard_unless(want);
            }
            Node::SetGlobal(name, value) => {
                self.emit(value, Want::One)?;
                self.keep_copy(want);
                self.op(Op::SetGlobal(*name));
                self.height -= 1;
            }
            Node::Function(name, place) => {
                self.at(*place);
                self.push(Op::Function(*name));
                self.discard_unless(want);
            }
            Node::SetfFunction(name, place) => {
                self.at(*place);
                self.push(Op::SetfFunction(*name));
                self.discard_unless(want);
            }
            Node::If(test, then, otherwise) => self.emit_if(test, then, otherwise, want)?,
            Node::Or(first, second) => self.emit_or(first, second, want)?,
            Node::Progn(nodes) => self.emit_progn(nodes, want)?,
            Node::Let {
                bindings,
                sequential,
                body,
            } => self.emit_let(bindings, *sequential, body, want)?,
            Node::MultipleValueBind {
                bindings,
                values,
                body,
            } => self.emit_multiple_value_bind(bindings, values, body, want)?,
            Node::Labels(functions, body) => self.emit_labels(functions, body, want)?,
            Node::Call(target, args, place) => {
                self.emit_call(node, (target, args, *place), want)?;
            }
            Node::Lambda(lambda) => {
                if want != Want::Effect {
                    self.emit_lambda(lambda)?;
                }
            }
            Node::Block(block, body) => self.emit_block(block, body, want)?,
            Node::LocalReturn(block, value) => self.emit_local_return(block, value, want)?,
            Node::DynamicReturn(block, value) => {
                self.emit(value, Want::All)?;
                self.emit_variable(&block.identity);
                self.op(Op::ReturnFrom);
                self.height -= 2;
                self.pretend_value(want);
            }
            Node::Tagbody(tagbody, statements, positions) => {
                self.emit_tagbody(tagbody, statements, positions, want)?;
            }
            Node::LocalGo(tagbody, tag) => self.emit_local_go(tagbody, *tag, want),
            Node::DynamicGo(tagbody, tag) => {
                self.emit_variable(&tagbody.identity);
                self.op(Op::Go(index(*tag)?));
                self.height -= 1;
                self.pretend_value(want);
            }
            Node::Catch(tag, body) => {
                self.emit(tag, Want::One)?;
                let enter = self.ops.len();
                self.op(Op::EnterCatch {
                    target: 0,
                    multi: want == Want::All,
                });
                self.height -= 1;
                self.inside_dynamic(body, want)?;
                self.patch(enter);
                self.discard_unless(want);
            }
            Node::UnwindProtect(body, cleanup) => {
                let enter = self.ops.len();
                self.op(Op::EnterUnwind(0));
                self.dynamic += 1;
                self.emit(body, at_least_one(want))?;
                self.dynamic -= 1;
                self.push(Op::LeaveUnwind);
                self.patch(enter);
                self.emit(cleanup, Want::Effect)?;
                self.op(Op::EndCleanup);
                self.height -= 1;
                self.discard_unless(want);
            }
            Node::Throw(tag, value, place) => {
                self.emit(tag, Want::One)?;
                self.emit(value, Want::All)?;
                self.at(*place);
                self.op(Op::Throw);
                // Where execution continues with a value in place of an exit that there is not.
                self.height -= 1;
                self.discard_unless(want);
            }
            Node::MultipleValueCall(function, args, place) => {
                self.emit(function, Want::One)?;
                for arg in args {
                    self.emit(arg, Want::All)?;
                }
                self.at(*place);
                let count = arg_count(args.len())?;
                self.op(Op::MultipleValueCall(count, want == Want::All));
                self.height -= u32::from(count);
                self.discard_unless(want);
            }
            Node::Prog1(first, others, multi) => {
                let inner = match (want, multi) {
                    (Want::All, true) => Want::All,
                    (Want::Effect, _) => Want::Effect,
                    _ => Want::One,
                };
                self.emit(first, inner)?;
                for other in others {
                    self.emit(other, Want::Effect)?;
                }
            }
            Node::Progv(symbols, values, body) => {
                self.emit(symbols, Want::One)?;
                self.emit(values, Want::One)?;
                self.op(Op::Progv);
                self.height -= 2;
                self.dynamic += 1;
                self.emit(body, want)?;
                self.dynamic -= 1;
                self.op(Op::EndProgv);
            }
            Node::Handlers(types, functions, body, place) => {
                for function in functions {
                    self.emit(function, Want::One)?;
                }
                self.at(*place);
                let types = self.constant(types)?;
                let count = arg_count(functions.len())?;
                self.op(Op::EnterHandlers(types, count));
                self.height -= u32::from(count);
                self.dynamic += 1;
                self.emit(body, want)?;
                self.dynamic -= 1;
                self.op(Op::PopDynamic(1));
            }
            Node::Restarts(list, body) => {
                self.emit(list, Want::One)?;
                self.op(Op::EnterRestarts);
                self.height -= 1;
                self.dynamic += 1;
                self.emit(body, want)?;
                self.dynamic -= 1;
                self.op(Op::PopDynamic(1));
            }
        }
        Ok(())
    }

    /// Emits the body of a catch inside one dynamic entry, which is dropped when the body ends
    /// normally.
    fn inside_dynamic(&mut self, body: &Node, want: Want) -> Compiled<()> {
        self.dynamic += 1;
        self.emit(body, at_least_one(want))?;
        self.dynamic -= 1;
        self.op(Op::PopDynamic(1));
        Ok(())
    }

    fn discard_unless(&mut self, want: Want) {
        if want == Want::Effect {
            self.op(Op::Pop);
            self.height -= 1;
        }
    }

    fn keep_copy(&mut self, want: Want) {
        if want != Want::Effect {
            self.push(Op::Dup);
        }
    }

    /// After a jump, counts the value that the unreachable code after it expects on the stack.
    fn pretend_value(&mut self, want: Want) {
        if want != Want::Effect {
            self.height += 1;
        }
    }

    fn emit_constant(&mut self, value: &Value, want: Want) -> Compiled<()> {
        if want == Want::Effect {
            return Ok(());
        }
        let op = match value {
            Value::Symbol(known::NIL, ..) => Op::Nil,
            Value::Int(n) if i32::try_from(*n).is_ok() => {
                Op::Int(i32::try_from(*n).unwrap_or_default())
            }
            other => Op::Const(self.constant(other)?),
        };
        self.push(op);
        Ok(())
    }

    fn emit_progn(&mut self, nodes: &[Node], want: Want) -> Compiled<()> {
        match nodes.split_last() {
            None => self.emit_constant(&Value::NIL, want),
            Some((last, others)) => {
                for node in others {
                    self.emit(node, Want::Effect)?;
                }
                self.emit(last, want)
            }
        }
    }

    /// Drops the values above `height` except the result, and the dynamic entries above `dynamic`.
    fn close(&mut self, height: u32, dynamic: u32, want: Want) {
        self.end_locals(height);
        if self.dynamic > dynamic {
            self.op(Op::PopDynamic(self.dynamic - dynamic));
            self.dynamic = dynamic;
        }
        self.slide_to(height, want);
    }

    fn slide_to(&mut self, height: u32, want: Want) {
        if want == Want::Effect {
            if self.height > height {
                self.op(Op::Drop(self.height - height));
            }
            self.height = height;
        } else {
            if self.height - 1 > height {
                self.op(Op::Slide(self.height - 1 - height));
            }
            self.height = height + 1;
        }
    }

    fn emit_lambda(&mut self, lambda: &LambdaNode) -> Compiled<()> {
        let code = emit_function(lambda, self.symbols)?;
        let captures = lambda
            .free
            .iter()
            .map(|var| {
                if var.owner == self.id {
                    Capture::Local(var.slot.get())
                } else {
                    Capture::Free(self.free_index(var).unwrap_or(u32::MAX))
                }
            })
            .collect();
        let i = index(self.inner.len())?;
        self.inner.push((code, captures));
        self.push(Op::Closure(i));
        Ok(())
    }
}

fn at_least_one(want: Want) -> Want {
    match want {
        Want::Effect => Want::One,
        other => other,
    }
}

fn arg_count(count: usize) -> Compiled<u16> {
    u16::try_from(count).map_err(|_| Raise::program("A call has too many arguments."))
}
