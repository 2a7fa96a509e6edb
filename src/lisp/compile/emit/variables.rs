//! Code for variables: parameters, bindings, references, assignments.

use std::rc::Rc;

use super::{Emitter, Want, index, short};
use crate::compile::analyze::Compiled;
use crate::compile::node::{Binding, LambdaNode, Node, Prologue};
use crate::compile::scope::Var;
use crate::value::code::Local;
use crate::value::operation::Op;
use crate::value::symbol::Sym;

impl Emitter<'_> {
    pub(super) fn emit_prologue(&mut self, lambda: &LambdaNode) -> Compiled<()> {
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
                    self.op(Op::JumpIfSupplied(short(slot)?, 0));
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
    pub(super) fn bind_top(&mut self, binding: &Binding) {
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
    pub(super) fn note_local(&mut self, slot: u32, name: Sym) {
        self.locals.push(Local {
            slot,
            name,
            from: self.here(),
            to: u32::MAX,
        });
    }

    /// Ends the scopes of the variables above `height` here.
    pub(super) fn end_locals(&mut self, height: u32) {
        let here = self.here();
        let above = self.locals.iter_mut().rev();
        for local in above.take_while(|l| l.slot >= height) {
            local.to = local.to.min(here);
        }
    }

    pub(super) fn free_index(&self, var: &Rc<Var>) -> Option<u32> {
        let i = self.free.iter().position(|v| Rc::ptr_eq(v, var))?;
        u32::try_from(i).ok()
    }

    /// The slot of a variable whose value stands in it without a box.
    pub(super) fn plain_slot(&self, var: &Var) -> Option<u32> {
        (var.owner == self.id && !var.is_boxed()).then(|| var.slot.get())
    }

    /// The slot of the local that a form refers to, if its value stands in it without a box.
    pub(super) fn plain_local(&self, node: &Node) -> Option<u32> {
        match node {
            Node::Local(var) => self.plain_slot(var),
            _ => None,
        }
    }

    /// The same, if its number is small enough.
    pub(super) fn short_local<T: TryFrom<u32>>(&self, node: &Node) -> Option<T> {
        T::try_from(self.plain_local(node)?).ok()
    }

    pub(super) fn emit_variable(&mut self, var: &Rc<Var>) {
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

    pub(super) fn emit_assignment(&mut self, var: &Rc<Var>) {
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

    pub(super) fn emit_let(
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

    pub(super) fn emit_multiple_value_bind(
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

    pub(super) fn emit_labels(
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
}
