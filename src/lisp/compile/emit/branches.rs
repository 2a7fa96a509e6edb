//! Code for conditionals. A test that only decides where to go on computes no truth value: it becomes
//! operations that compare and jump.

use super::calls::small_int;
use super::{Emitter, Want};
use crate::compile::analyze::Compiled;
use crate::compile::node::{Node, Target};
use crate::source::Place;
use crate::value::known;
use crate::value::operation::{Comparison, Op, Test};
use crate::value::symbol::Sym;

/// The comparison that a function of two numbers makes, if it is one.
pub(super) fn comparison_of(name: Sym) -> Option<Comparison> {
    Some(match name {
        known::LESS => Comparison::Less,
        known::GREATER => Comparison::Greater,
        known::LESS_EQUAL => Comparison::LessEqual,
        known::GREATER_EQUAL => Comparison::GreaterEqual,
        known::NUM_EQUAL => Comparison::Equal,
        _ => return None,
    })
}

/// Pops a value and jumps if it is true (when that is wanted) or `NIL` (when it is not).
fn jump_on_top(when: bool) -> Op {
    match when {
        true => Op::JumpIfTrue(0),
        false => Op::JumpIfNil(0),
    }
}

fn is_nil(node: &Node) -> bool {
    matches!(node, Node::Const(value) if value.is_nil())
}

/// Jumps out of a test, which are to be patched.
type Jumps = Vec<usize>;

impl Emitter<'_> {
    pub(super) fn emit_if(
        &mut self,
        test: &Node,
        then: &Node,
        otherwise: &Node,
        want: Want,
    ) -> Compiled<()> {
        let mut to_else = Jumps::new();
        self.emit_test(test, false, &mut to_else)?;
        let height = self.height;
        self.emit(then, want)?;
        let is_empty = want == Want::Effect && matches!(otherwise, Node::Const(_));
        if is_empty {
            self.patch_all(to_else);
            return Ok(());
        }
        let to_end = self.ops.len();
        self.op(Op::Jump(0));
        self.patch_all(to_else);
        self.height = height;
        self.emit(otherwise, want)?;
        self.patch(to_end);
        Ok(())
    }

    pub(super) fn emit_or(&mut self, first: &Node, second: &Node, want: Want) -> Compiled<()> {
        if want == Want::Effect {
            let mut to_end = Jumps::new();
            self.emit_test(first, true, &mut to_end)?;
            self.emit(second, want)?;
            self.patch_all(to_end);
            return Ok(());
        }
        self.emit(first, Want::One)?;
        let jump = self.ops.len();
        self.op(Op::JumpIfTrueOrPop(0));
        self.height -= 1;
        self.emit(second, want)?;
        self.patch(jump);
        Ok(())
    }

    fn patch_all(&mut self, jumps: Jumps) {
        for jump in jumps {
            self.patch(jump);
        }
    }

    /// Emits a test that jumps if it is true (when that is wanted) or `NIL` (when it is not), and
    /// falls through otherwise, both with nothing more on the stack.
    fn emit_test(&mut self, test: &Node, when: bool, jumps: &mut Jumps) -> Compiled<()> {
        let op = match test {
            Node::Const(value) => {
                if value.is_true() == when {
                    jumps.push(self.ops.len());
                    self.op(Op::Jump(0));
                }
                return Ok(());
            }
            Node::If(first, second, otherwise) if is_nil(otherwise) => {
                return self.emit_junction(first, second, true, when, jumps);
            }
            Node::Or(first, second) => {
                return self.emit_junction(first, second, false, when, jumps);
            }
            Node::Call(Target::Global(known::NOT | known::NULL), args, _) if args.len() == 1 => {
                return self.emit_test(&args[0], !when, jumps);
            }
            Node::Call(Target::Global(known::ATOM), args, _) if args.len() == 1 => {
                self.emit_consp(&args[0], !when)?
            }
            Node::Call(Target::Global(known::CONSP), args, _) if args.len() == 1 => {
                self.emit_consp(&args[0], when)?
            }
            Node::Call(Target::Global(known::EQ), args, _) if args.len() == 2 => {
                self.emit_eq(&args[0], &args[1], when)?
            }
            Node::Call(Target::Global(name), args, place) if args.len() == 2 => {
                match comparison_of(*name) {
                    Some(comparison) => {
                        self.emit_comparison(comparison, &args[0], &args[1], when, *place)?
                    }
                    None => self.emit_truth(test, when)?,
                }
            }
            _ => self.emit_truth(test, when)?,
        };
        jumps.push(self.ops.len());
        self.op(op);
        if op.may_fail_instead_of_jump() {
            // Where execution continues with a value in place of the comparison that failed.
            jumps.push(self.ops.len());
            self.op(jump_on_top(when));
        }
        Ok(())
    }

    /// Emits the test whether both of two tests are true, or one of them.
    fn emit_junction(
        &mut self,
        first: &Node,
        second: &Node,
        both: bool,
        when: bool,
        jumps: &mut Jumps,
    ) -> Compiled<()> {
        if both != when {
            self.emit_test(first, when, jumps)?;
            return self.emit_test(second, when, jumps);
        }
        let mut over = Jumps::new();
        self.emit_test(first, !when, &mut over)?;
        self.emit_test(second, when, jumps)?;
        self.patch_all(over);
        Ok(())
    }

    /// Emits a value, and returns the operation that jumps according to its truth.
    fn emit_truth(&mut self, test: &Node, when: bool) -> Compiled<Op> {
        if let Some(slot) = self.short_local(test) {
            return Ok(Op::JumpIfLocal {
                slot,
                when,
                target: 0,
            });
        }
        self.emit(test, Want::One)?;
        self.height -= 1;
        Ok(jump_on_top(when))
    }

    fn emit_consp(&mut self, value: &Node, when: bool) -> Compiled<Op> {
        let target = 0;
        if let Some(slot) = self.short_local(value) {
            return Ok(Op::JumpIfLocalConsp { slot, when, target });
        }
        self.emit(value, Want::One)?;
        self.height -= 1;
        Ok(Op::JumpIfConsp { when, target })
    }

    fn emit_eq(&mut self, a: &Node, b: &Node, when: bool) -> Compiled<Op> {
        let target = 0;
        self.emit(a, Want::One)?;
        if let Node::Const(value) = b
            && let Ok(constant) = u16::try_from(self.constants.len())
        {
            self.constant(value)?;
            self.height -= 1;
            return Ok(Op::JumpIfEqConst {
                constant,
                when,
                target,
            });
        }
        self.emit(b, Want::One)?;
        self.height -= 2;
        Ok(Op::JumpIfEq { when, target })
    }

    fn emit_comparison(
        &mut self,
        comparison: Comparison,
        a: &Node,
        b: &Node,
        when: bool,
        place: Place,
    ) -> Compiled<Op> {
        let target = 0;
        let test = Test::new(comparison, when);
        let locals: (Option<u8>, Option<u8>) = (self.short_local(a), self.short_local(b));
        if let (Some(a), Some(b)) = locals {
            self.at(place);
            return Ok(Op::JumpIfCompareLocals { test, a, b, target });
        }
        if let Some(slot) = locals.0
            && let Some(n) = small_int(b)
        {
            self.at(place);
            return Ok(Op::JumpIfCompareLocalInt {
                test,
                slot,
                n,
                target,
            });
        }
        // A local that is never assigned may as well be looked at last.
        if let Some(slot) = locals.0
            && let Node::Local(var) = a
            && !var.assigned.get()
        {
            self.emit(b, Want::One)?;
            self.at(place);
            self.height -= 1;
            return Ok(Op::JumpIfCompareLocal { test, slot, target });
        }
        self.emit(a, Want::One)?;
        if let Some(n) = small_int(b) {
            self.at(place);
            self.height -= 1;
            return Ok(Op::JumpIfCompareInt { test, n, target });
        }
        self.emit(b, Want::One)?;
        self.at(place);
        self.height -= 2;
        Ok(Op::JumpIfCompare { test, target })
    }
}
