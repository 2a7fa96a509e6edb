//! Second pass: nodes to code.
//!
//! The emitter knows at every point how many values the function has on the stack and how
//! many dynamic entries it has open, so jumps can drop what they leave behind.

use std::rc::Rc;

use super::analyze::Compiled;
use super::node::{Binding, LambdaNode, Node, Prologue, Target};
use super::scope::{Block, Tagbody, Var};
use crate::lisp::source::Place;
use crate::lisp::value::Value;
use crate::lisp::value::code::{Capture, Code, Local, Op, Signature};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;

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
    id: usize,
    free: &'a [Rc<Var>],
    ops: Vec<Op>,
    constants: Vec<Value>,
    inner: Vec<(Rc<Code>, Rc<[Capture]>)>,
    tags: Vec<Vec<u32>>,
    places: Vec<(u32, Place)>,
    locals: Vec<Local>,
    height: u32,
    dynamic: u32,
    blocks: Vec<OpenBlock>,
    tagbodies: Vec<OpenTagbody>,
}

/// Emits the code of a function.
pub(super) fn emit_function(lambda: &LambdaNode) -> Compiled<Rc<Code>> {
    let mut emitter = Emitter {
        id: lambda.id,
        free: &lambda.free,
        ops: Vec::new(),
        constants: Vec::new(),
        inner: Vec::new(),
        tags: Vec::new(),
        places: Vec::new(),
        locals: Vec::new(),
        height: 0,
        dynamic: 0,
        blocks: Vec::new(),
        tagbodies: Vec::new(),
    };
    emitter.emit_prologue(lambda)?;
    emitter.emit(&lambda.body, Want::All)?;
    emitter.op(Op::Return);
    let code = Code {
        name: Signature::of(&lambda.name),
        parameters: lambda.parameters.clone(),
        ops: emitter.ops.into(),
        constants: emitter.constants,
        inner: emitter.inner,
        tags: emitter.tags.into(),
        places: emitter.places.into(),
        locals: emitter.locals.into(),
        free: lambda.free.iter().map(|var| var.name).collect(),
        lambda_list: Signature::of(&lambda.lambda_list),
        doc: lambda.doc.clone(),
        is_fixed: false,
    };
    Ok(code.finished())
}

/// The operation that replaces a call of the function with `count` arguments, if there is one.
fn inline_operation(name: Sym, count: usize) -> Option<Op> {
    Some(match (name, count) {
        (known::CAR | known::FIRST, 1) => Op::Car,
        (known::CDR | known::REST, 1) => Op::Cdr,
        (known::CONS, 2) => Op::Cons,
        (known::EQ, 2) => Op::Eq,
        (known::NOT | known::NULL, 1) => Op::Not,
        (known::CONSP, 1) => Op::Consp,
        (known::PLUS, 2) => Op::Add,
        (known::MINUS, 2) => Op::Sub,
        (known::TIMES, 2) => Op::Mul,
        (known::LESS, 2) => Op::Less,
        (known::GREATER, 2) => Op::Greater,
        (known::LESS_EQUAL, 2) => Op::LessEqual,
        (known::GREATER_EQUAL, 2) => Op::GreaterEqual,
        (known::NUM_EQUAL, 2) => Op::NumEqual,
        (known::ONE_PLUS, 1) => Op::AddInt(1),
        (known::ONE_MINUS, 1) => Op::AddInt(-1),
        _ => return None,
    })
}

/// Whether calls of the function may be operations instead, so that code does not name it.
pub(crate) fn is_inlined(name: Sym) -> bool {
    (1..=2).any(|count| inline_operation(name, count).is_some())
}

/// A literal integer that fits an operation, positive or negated.
fn small_int(node: &Node) -> Option<i32> {
    match node {
        Node::Const(Value::Int(n)) => i32::try_from(*n).ok(),
        _ => None,
    }
}

fn index(n: usize) -> Compiled<u32> {
    u32::try_from(n).map_err(|_| Raise::program("The form is too large to be compiled."))
}

impl Emitter<'_> {
    fn op(&mut self, op: Op) {
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
        let target = self.here();
        if let Some(
            Op::Jump(t)
            | Op::JumpIfNil(t)
            | Op::JumpIfTrue(t)
            | Op::JumpIfTrueOrPop(t)
            | Op::JumpIfSupplied(_, t)
            | Op::EnterUnwind(t)
            | Op::EnterBlock { target: t, .. }
            | Op::EnterCatch { target: t, .. },
        ) = self.ops.get_mut(at)
        {
            *t = target;
        }
    }

    fn emit_prologue(&mut self, lambda: &LambdaNode) -> Compiled<()> {
        for var in &lambda.slots {
            var.slot.set(self.height);
            self.note_local(self.height, var.name);
            self.height += 1;
        }
        // Parameters with defaults are boxed once their value is known.
        let defaulted: Vec<&Rc<Var>> = lambda
            .prologue
            .iter()
            .filter_map(|p| match p {
                Prologue::Default(d) => Some(&d.var),
                _ => None,
            })
            .collect();
        for var in &lambda.slots {
            if var.is_boxed() && !defaulted.iter().any(|d| Rc::ptr_eq(d, var)) {
                self.op(Op::MakeBox(var.slot.get()));
            }
        }
        for step in &lambda.prologue {
            match step {
                Prologue::Default(default) => {
                    let slot = default.var.slot.get();
                    if let Some(binding) = &default.supplied {
                        self.push(Op::Supplied(slot));
                        self.bind_top(binding);
                    }
                    let jump = self.ops.len();
                    self.op(Op::JumpIfSupplied(slot, 0));
                    self.emit(&default.init, Want::One)?;
                    self.op(Op::SetLocal(slot));
                    self.height -= 1;
                    self.patch(jump);
                    if default.var.is_boxed() {
                        self.op(Op::MakeBox(slot));
                    }
                }
                Prologue::BindSpecial(name, var) => {
                    self.op(Op::Local(var.slot.get()));
                    self.op(Op::BindSpecial(*name));
                    self.dynamic += 1;
                }
                Prologue::Aux(binding, init) => {
                    self.emit(init, Want::One)?;
                    self.bind_top(binding);
                }
            }
        }
        Ok(())
    }

    /// Binds the variable of a binding to the value on top, which stays on the stack.
    fn bind_top(&mut self, binding: &Binding) {
        let slot = self.height - 1;
        match binding {
            Binding::Lexical(var) => {
                var.slot.set(slot);
                self.note_local(slot, var.name);
                if var.is_boxed() {
                    self.op(Op::MakeBox(slot));
                }
            }
            Binding::Special(name) => {
                self.op(Op::Local(slot));
                self.op(Op::BindSpecial(*name));
                self.dynamic += 1;
            }
        }
    }

    /// Records for the debugger that a variable's scope begins here.
    fn note_local(&mut self, slot: u32, name: Sym) {
        self.locals.push(Local {
            slot,
            name,
            from: self.here(),
            to: u32::MAX,
        });
    }

    /// Ends the scopes of the variables above `height` here.
    fn end_locals(&mut self, height: u32) {
        let here = self.here();
        let above = self.locals.iter_mut().rev();
        for local in above.take_while(|l| l.slot >= height) {
            local.to = local.to.min(here);
        }
    }

    fn free_index(&self, var: &Rc<Var>) -> Option<u32> {
        let i = self.free.iter().position(|v| Rc::ptr_eq(v, var))?;
        u32::try_from(i).ok()
    }

    fn emit_variable(&mut self, var: &Rc<Var>) {
        let boxed = var.is_boxed();
        let op = if var.owner == self.id {
            let slot = var.slot.get();
            if boxed {
                Op::LocalBox(slot)
            } else {
                Op::Local(slot)
            }
        } else {
            // The analysis lists every variable of an outer function that the code refers to.
            let i = self.free_index(var).unwrap_or(u32::MAX);
            if boxed { Op::FreeBox(i) } else { Op::Free(i) }
        };
        self.push(op);
    }

    fn emit_assignment(&mut self, var: &Rc<Var>) {
        let boxed = var.is_boxed();
        let op = if var.owner == self.id {
            let slot = var.slot.get();
            if boxed {
                Op::SetLocalBox(slot)
            } else {
                Op::SetLocal(slot)
            }
        } else {
            Op::SetFreeBox(self.free_index(var).unwrap_or(u32::MAX))
        };
        self.op(op);
        self.height -= 1;
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
            Node::Call(target, args, place) => self.emit_call(target, args, *place, want)?,
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
            Node::Handlers(types, functions, body) => {
                for function in functions {
                    self.emit(function, Want::One)?;
                }
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

    fn emit_if(&mut self, test: &Node, then: &Node, otherwise: &Node, want: Want) -> Compiled<()> {
        let negated = match test {
            Node::Call(Target::Global(known::NOT | known::NULL), args, _) => {
                match args.as_slice() {
                    [inner] => Some(inner),
                    _ => None,
                }
            }
            _ => None,
        };
        self.emit(negated.unwrap_or(test), Want::One)?;
        let to_else = self.ops.len();
        self.op(if negated.is_some() {
            Op::JumpIfTrue(0)
        } else {
            Op::JumpIfNil(0)
        });
        self.height -= 1;
        let height = self.height;
        self.emit(then, want)?;
        let is_empty = want == Want::Effect && matches!(otherwise, Node::Const(_));
        if is_empty {
            self.patch(to_else);
            return Ok(());
        }
        let to_end = self.ops.len();
        self.op(Op::Jump(0));
        self.patch(to_else);
        self.height = height;
        self.emit(otherwise, want)?;
        self.patch(to_end);
        Ok(())
    }

    fn emit_or(&mut self, first: &Node, second: &Node, want: Want) -> Compiled<()> {
        self.emit(first, Want::One)?;
        let jump = self.ops.len();
        if want == Want::Effect {
            self.op(Op::JumpIfTrue(0));
        } else {
            self.op(Op::JumpIfTrueOrPop(0));
        }
        self.height -= 1;
        self.emit(second, want)?;
        self.patch(jump);
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

    fn emit_let(
        &mut self,
        bindings: &[(Binding, Node)],
        sequential: bool,
        body: &Node,
        want: Want,
    ) -> Compiled<()> {
        let height = self.height;
        let dynamic = self.dynamic;
        for (binding, init) in bindings {
            self.emit(init, Want::One)?;
            if sequential {
                self.bind_top(binding);
            } else if let Binding::Lexical(var) = binding {
                var.slot.set(self.height - 1);
                self.note_local(self.height - 1, var.name);
            }
        }
        if !sequential {
            for (slot, (binding, _)) in (height..).zip(bindings) {
                match binding {
                    Binding::Lexical(var) if var.is_boxed() => self.op(Op::MakeBox(slot)),
                    Binding::Lexical(_) => {}
                    Binding::Special(name) => {
                        self.op(Op::Local(slot));
                        self.op(Op::BindSpecial(*name));
                        self.dynamic += 1;
                    }
                }
            }
        }
        self.emit(body, want)?;
        self.close(height, dynamic, want);
        Ok(())
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

    fn emit_multiple_value_bind(
        &mut self,
        bindings: &[Binding],
        values: &Node,
        body: &Node,
        want: Want,
    ) -> Compiled<()> {
        let height = self.height;
        let dynamic = self.dynamic;
        self.emit(values, Want::All)?;
        let count = index(bindings.len())?;
        self.op(Op::Spread(count));
        self.height = height + count;
        for (slot, binding) in (height..).zip(bindings) {
            match binding {
                Binding::Lexical(var) => {
                    var.slot.set(slot);
                    self.note_local(slot, var.name);
                    if var.is_boxed() {
                        self.op(Op::MakeBox(slot));
                    }
                }
                Binding::Special(name) => {
                    self.op(Op::Local(slot));
                    self.op(Op::BindSpecial(*name));
                    self.dynamic += 1;
                }
            }
        }
        self.emit(body, want)?;
        self.close(height, dynamic, want);
        Ok(())
    }

    fn emit_labels(
        &mut self,
        functions: &[(Rc<Var>, Node)],
        body: &Node,
        want: Want,
    ) -> Compiled<()> {
        let height = self.height;
        for (var, _) in functions {
            var.slot.set(self.height);
            self.push(Op::Nil);
            if var.is_boxed() {
                self.op(Op::MakeBox(var.slot.get()));
            }
        }
        for (var, lambda) in functions {
            self.emit(lambda, Want::One)?;
            self.emit_assignment(var);
        }
        self.emit(body, want)?;
        self.slide_to(height, want);
        Ok(())
    }

    fn emit_lambda(&mut self, lambda: &LambdaNode) -> Compiled<()> {
        let code = emit_function(lambda)?;
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

    fn emit_call(
        &mut self,
        target: &Target,
        args: &[Node],
        place: Place,
        want: Want,
    ) -> Compiled<()> {
        match target {
            Target::Global(name) => {
                if let Some(op) = self.emit_inline(*name, args)? {
                    self.at(place);
                    self.op(op);
                    self.discard_unless(want);
                    return Ok(());
                }
                let count = self.emit_args(args)?;
                self.at(place);
                self.op(match want {
                    Want::All => Op::CallMulti(*name, count),
                    _ => Op::Call(*name, count),
                });
                self.height -= u32::from(count);
                self.height += 1;
            }
            Target::Computed(function) => {
                self.emit(function, Want::One)?;
                let count = self.emit_args(args)?;
                self.at(place);
                self.op(match want {
                    Want::All => Op::CallValueMulti(count),
                    _ => Op::CallValue(count),
                });
                self.height -= u32::from(count);
            }
        }
        self.discard_unless(want);
        Ok(())
    }

    fn emit_args(&mut self, args: &[Node]) -> Compiled<u16> {
        for arg in args {
            self.emit(arg, Want::One)?;
        }
        arg_count(args.len())
    }

    /// Emits the arguments of a call that is compiled to one operation, and returns that operation;
    /// the height already counts its result.
    fn emit_inline(&mut self, name: Sym, args: &[Node]) -> Compiled<Option<Op>> {
        let Some(op) = inline_operation(name, args.len()) else {
            return Ok(None);
        };
        match (op, args) {
            (Op::Add, [a, b]) if small_int(b).is_some() => {
                self.emit(a, Want::One)?;
                return Ok(small_int(b).map(Op::AddInt));
            }
            (Op::Sub, [a, b]) if small_int(b).and_then(i32::checked_neg).is_some() => {
                self.emit(a, Want::One)?;
                return Ok(small_int(b).and_then(i32::checked_neg).map(Op::AddInt));
            }
            _ => {}
        }
        let height = self.height;
        for arg in args {
            self.emit(arg, Want::One)?;
        }
        self.height = height + 1;
        Ok(Some(op))
    }

    fn emit_block(&mut self, block: &Rc<Block>, body: &Node, want: Want) -> Compiled<()> {
        let height = self.height;
        let enter = self.ops.len();
        let dynamic = self.dynamic;
        if block.dynamic.get() {
            block.identity.slot.set(self.height);
            self.push(Op::EnterBlock {
                target: 0,
                multi: want == Want::All,
            });
            self.dynamic += 1;
        }
        // A dynamic block always leaves a value, so that both exits agree.
        let inner = if block.dynamic.get() {
            at_least_one(want)
        } else {
            want
        };
        self.blocks.push(OpenBlock {
            block: block.clone(),
            height,
            dynamic,
            want: inner,
            exits: Vec::new(),
        });
        self.emit(body, inner)?;
        self.close(height, dynamic, inner);
        if let Some(open) = self.blocks.pop() {
            for exit in open.exits {
                self.patch(exit);
            }
        }
        if block.dynamic.get() {
            self.patch(enter);
            self.discard_unless(want);
        }
        Ok(())
    }

    fn emit_local_return(&mut self, block: &Rc<Block>, value: &Node, want: Want) -> Compiled<()> {
        let found = self
            .blocks
            .iter()
            .rposition(|open| Rc::ptr_eq(&open.block, block));
        // The analysis makes local returns only inside the block.
        let Some(i) = found else {
            return Err(Raise::program("return for unknown block"));
        };
        let before = self.height;
        let OpenBlock {
            height,
            dynamic,
            want: block_want,
            ..
        } = self.blocks[i];
        self.emit(value, block_want)?;
        if self.dynamic > dynamic {
            self.op(Op::PopDynamic(self.dynamic - dynamic));
        }
        self.slide_to(height, block_want);
        let exit = self.ops.len();
        self.op(Op::Jump(0));
        self.blocks[i].exits.push(exit);
        self.height = before;
        self.pretend_value(want);
        Ok(())
    }

    fn emit_tagbody(
        &mut self,
        tagbody: &Rc<Tagbody>,
        statements: &[Node],
        positions: &[usize],
        want: Want,
    ) -> Compiled<()> {
        let height = self.height;
        let outer_dynamic = self.dynamic;
        let table = index(self.tags.len())?;
        if tagbody.dynamic.get() {
            self.tags.push(Vec::new());
            tagbody.identity.slot.set(self.height);
            self.push(Op::EnterTagbody(table));
            self.dynamic += 1;
        }
        self.tagbodies.push(OpenTagbody {
            tagbody: tagbody.clone(),
            height: self.height,
            dynamic: self.dynamic,
            jumps: Vec::new(),
        });
        let mut targets = vec![0; positions.len()];
        for i in 0..=statements.len() {
            for (tag, position) in positions.iter().enumerate() {
                if *position == i {
                    targets[tag] = self.here();
                }
            }
            if let Some(statement) = statements.get(i) {
                self.emit(statement, Want::Effect)?;
            }
        }
        if let Some(open) = self.tagbodies.pop() {
            for (at, tag) in open.jumps {
                self.ops[at] = Op::Jump(targets[tag]);
            }
        }
        self.close(height, outer_dynamic, Want::Effect);
        if tagbody.dynamic.get() {
            self.tags[table as usize] = targets;
        }
        self.emit_constant(&Value::NIL, want)
    }

    fn emit_local_go(&mut self, tagbody: &Rc<Tagbody>, tag: usize, want: Want) {
        let found = self
            .tagbodies
            .iter()
            .rposition(|open| Rc::ptr_eq(&open.tagbody, tagbody));
        // The analysis makes local jumps only inside the tagbody.
        let Some(i) = found else { return };
        let (height, dynamic) = (self.tagbodies[i].height, self.tagbodies[i].dynamic);
        if self.dynamic > dynamic {
            self.op(Op::PopDynamic(self.dynamic - dynamic));
        }
        if self.height > height {
            self.op(Op::Drop(self.height - height));
        }
        let at = self.ops.len();
        self.op(Op::Jump(0));
        self.tagbodies[i].jumps.push((at, tag));
        self.pretend_value(want);
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
