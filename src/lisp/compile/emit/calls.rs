//! Code for calls: of functions, and of those that are operations of the machine.

use super::branches::comparison_of;
use super::{Emitter, Want, arg_count};
use crate::compile::analyze::Compiled;
use crate::compile::node::{Node, Target};
use crate::source::Place;
use crate::value::Value;
use crate::value::known;
use crate::value::operation::Op;
use crate::value::symbol::Sym;

/// The operations that replace a call of the function with `count` arguments, if there are any.
fn inline_operations(name: Sym, count: usize) -> Option<&'static [Op]> {
    Some(match (name, count) {
        (known::CAR | known::FIRST, 1) => &[Op::Car],
        (known::CDR | known::REST, 1) => &[Op::Cdr],
        (known::CAAR, 1) => &[Op::Path(0b100)],
        (known::CADR | known::SECOND, 1) => &[Op::Path(0b101)],
        (known::CDAR, 1) => &[Op::Path(0b110)],
        (known::CDDR, 1) => &[Op::Path(0b111)],
        (known::CADDR | known::THIRD, 1) => &[Op::Path(0b1011)],
        (known::CDDDR, 1) => &[Op::Path(0b1111)],
        (known::CONS, 2) => &[Op::Cons],
        (known::RPLACA, 2) => &[Op::SetCar],
        (known::RPLACD, 2) => &[Op::SetCdr],
        (known::EQ, 2) => &[Op::Eq],
        (known::NOT | known::NULL, 1) => &[Op::Not],
        (known::CONSP, 1) => &[Op::Consp],
        (known::ATOM, 1) => &[Op::Consp, Op::Not],
        (known::PLUS, 2) => &[Op::Add],
        (known::MINUS, 2) => &[Op::Sub],
        (known::TIMES, 2) => &[Op::Mul],
        (known::ONE_PLUS, 1) => &[Op::AddInt(1)],
        (known::ONE_MINUS, 1) => &[Op::AddInt(-1)],
        (known::AREF, 2) => &[Op::Element(known::AREF)],
        (known::SVREF, 2) => &[Op::Element(known::SVREF)],
        _ => return None,
    })
}

/// Whether calls of the function may be operations instead, so that code does not name it.
pub fn is_inlined(name: Sym) -> bool {
    let is_operation = comparison_of(name).is_some()
        || (1..=2).any(|count| inline_operations(name, count).is_some());
    is_operation || name == known::FUNCALL
}

/// A literal integer, if it fits an operation.
pub(super) fn small_int<T: TryFrom<i64>>(node: &Node) -> Option<T> {
    match node {
        Node::Const(Value::Int(n)) => T::try_from(*n).ok(),
        _ => None,
    }
}

/// A form whose value is another form's plus a small integer.
fn sum_with_int(node: &Node) -> Option<(&Node, i32, Place)> {
    let Node::Call(Target::Global(name), args, place) = node else {
        return None;
    };
    let (a, n) = match (*name, args.as_slice()) {
        (known::ONE_PLUS, [a]) => (a, 1),
        (known::ONE_MINUS, [a]) => (a, -1),
        (known::PLUS, [a, b]) => (a, small_int(b)?),
        (known::MINUS, [a, b]) => (a, i32::checked_neg(small_int(b)?)?),
        _ => return None,
    };
    Some((a, n, *place))
}

impl Emitter<'_> {
    pub(super) fn emit_call(
        &mut self,
        node: &Node,
        (target, args, place): (&Target, &[Node], Place),
        want: Want,
    ) -> Compiled<()> {
        match (target, args) {
            (Target::Global(name), args) => {
                if self.emit_inline(node, *name, args, place)? {
                    if want == Want::Effect
                        && let Some(last) = self.ops.last_mut()
                    {
                        match last {
                            Op::SetCar => *last = Op::SetCarOnly,
                            Op::SetCdr => *last = Op::SetCdrOnly,
                            _ => {}
                        }
                    }
                    self.discard_unless(want);
                    return Ok(());
                }
                if let (known::FUNCALL, [function, args @ ..]) = (*name, args) {
                    return self.emit_computed_call(function, args, place, want);
                }
                let count = self.emit_args(args)?;
                self.at(place);
                self.op(match want {
                    Want::All => Op::CallMulti(*name, count),
                    _ => Op::Call(*name, count),
                });
                self.height -= u32::from(count);
                self.height += 1;
                self.discard_unless(want);
                Ok(())
            }
            (Target::Computed(function), args) => {
                self.emit_computed_call(function, args, place, want)
            }
        }
    }

    fn emit_computed_call(
        &mut self,
        function: &Node,
        args: &[Node],
        place: Place,
        want: Want,
    ) -> Compiled<()> {
        if let (Node::SetfFunction(name @ (known::AREF | known::SVREF), _), 3) =
            (function, args.len())
        {
            if let [value, vector, index] = args
                && want == Want::Effect
                && let Some(vector) = self.short_local(vector)
                && let Some(index) = self.short_local(index)
            {
                self.emit(value, Want::One)?;
                self.at(place);
                self.op(Op::SetLocalElement { vector, index });
                // Otherwise, as always.
                self.push(Op::Local(u32::from(vector)));
                self.push(Op::Local(u32::from(index)));
            } else {
                self.emit_args(args)?;
                self.at(place);
            }
            self.op(Op::SetElement(*name));
            self.height -= 2;
            self.discard_unless(want);
            return Ok(());
        }
        self.emit(function, Want::One)?;
        let count = self.emit_args(args)?;
        self.at(place);
        self.op(match want {
            Want::All => Op::CallValueMulti(count),
            _ => Op::CallValue(count),
        });
        self.height -= u32::from(count);
        self.discard_unless(want);
        Ok(())
    }

    fn emit_args(&mut self, args: &[Node]) -> Compiled<u16> {
        let mut rest = args;
        while let [arg, others @ ..] = rest {
            rest = others;
            if let [other, others @ ..] = others
                && let Some(a) = self.short_local(arg)
                && let Some(b) = self.short_local(other)
            {
                self.push(Op::TwoLocals(a, b));
                self.height += 1;
                rest = others;
            } else {
                self.emit(arg, Want::One)?;
            }
        }
        arg_count(args.len())
    }

    /// Emits a call as operations, if it can be, and returns whether it can; their value is then on
    /// the stack.
    fn emit_inline(
        &mut self,
        node: &Node,
        name: Sym,
        args: &[Node],
        place: Place,
    ) -> Compiled<bool> {
        if let Some((a, n, _)) = sum_with_int(node) {
            if let Some(slot) = self.short_local(a) {
                self.at(place);
                self.push(Op::LocalAddInt(slot, n));
            } else {
                self.emit(a, Want::One)?;
                self.at(place);
                self.op(Op::AddInt(n));
            }
            return Ok(true);
        }
        let comparison = comparison_of(name).filter(|_| args.len() == 2);
        if let Some(comparison) = comparison {
            self.emit_args(args)?;
            self.at(place);
            self.op(Op::Compare(comparison));
            self.height -= 1;
            return Ok(true);
        }
        let Some(mut ops) = inline_operations(name, args.len()) else {
            return Ok(false);
        };
        let height = self.height;
        let slot = match args {
            [arg] => self.plain_local(arg),
            _ => None,
        };
        let of_local = match (slot, ops) {
            (Some(slot), [Op::Car, ..]) => Some(Op::LocalCar(slot)),
            (Some(slot), [Op::Cdr, ..]) => Some(Op::LocalCdr(slot)),
            (Some(slot), [Op::Path(path), ..]) => Some(Op::LocalPath(slot, *path)),
            _ => None,
        };
        if let Some(of_local) = of_local {
            self.at(place);
            self.op(of_local);
            ops = &ops[1..];
        } else if let (known::PLUS | known::MINUS, [a, b]) = (name, args)
            && let Some(slot) = self.plain_local(b)
        {
            self.emit(a, Want::One)?;
            self.at(place);
            self.op(match name {
                known::PLUS => Op::AddLocal(slot),
                _ => Op::SubLocal(slot),
            });
            ops = &[];
        } else if let (known::AREF | known::SVREF, [vector, index]) = (name, args)
            && let Some(vector) = self.short_local(vector)
            && let Some(index) = self.short_local(index)
        {
            self.at(place);
            self.op(Op::LocalElement {
                is_simple: name == known::SVREF,
                vector,
                index,
            });
            ops = &[];
        } else {
            self.emit_args(args)?;
            self.at(place);
        }
        self.ops.extend_from_slice(ops);
        self.height = height + 1;
        Ok(true)
    }

    /// Emits the assignment to a local of its own value plus a small integer, or of its own cdr, if it
    /// is that, and returns whether it is.
    pub(super) fn emit_advance(&mut self, slot: u32, value: &Node) -> bool {
        let (operand, op, place) = if let Some((operand, n, place)) = sum_with_int(value) {
            let Ok(slot) = u16::try_from(slot) else {
                return false;
            };
            (operand, Op::AddToLocal(slot, n), place)
        } else if let Node::Call(Target::Global(known::CDR | known::REST), args, place) = value
            && let [operand] = args.as_slice()
        {
            (operand, Op::LocalToCdr(slot), *place)
        } else {
            return false;
        };
        if self.plain_local(operand) != Some(slot) {
            return false;
        }
        self.at(place);
        self.op(op);
        // Where execution continues with a value in place of a call that failed.
        self.op(Op::SetLocal(slot));
        true
    }
}
