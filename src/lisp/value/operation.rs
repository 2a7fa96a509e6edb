//! The operations of compiled code.

use serde::{Deserialize, Serialize};

use super::symbol::Sym;

/// A comparison of two numbers. The bits of its number say for which orders of two integers it holds:
/// the lowest one for ascending, the next one for equal, the highest one for descending numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Comparison {
    /// `<`
    Less = 0b001,
    /// `=`
    Equal = 0b010,
    /// `<=`
    LessEqual = 0b011,
    /// `>`
    Greater = 0b100,
    /// `>=`
    GreaterEqual = 0b110,
}

impl Comparison {
    /// Does it hold for two integers?
    #[inline(always)]
    pub fn holds(self, a: i64, b: i64) -> bool {
        let order = (a > b) as u8 * 2 + (a == b) as u8;
        (self as u8 >> order) & 1 != 0
    }
}

/// A comparison, and whether to jump when it holds or when it does not. Its lowest three bits say for
/// which orders of two integers it jumps, as those of a comparison say for which this holds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Test(u8);

impl Test {
    const WHEN: u8 = 0b1000;
    const ORDERS: u8 = 0b0111;

    /// Jumps when the comparison holds (if that is wanted) or when it does not.
    pub fn new(comparison: Comparison, when: bool) -> Test {
        match when {
            true => Test(comparison as u8 | Test::WHEN),
            false => Test(comparison as u8 ^ Test::ORDERS),
        }
    }

    /// Does it jump for two integers?
    #[inline(always)]
    pub(crate) fn jumps(self, a: i64, b: i64) -> bool {
        let order = (a >= b) as u8 + (a > b) as u8;
        (self.0 >> order) & 1 != 0
    }

    /// The comparison.
    pub fn comparison(self) -> Comparison {
        let orders = match self.when() {
            true => self.0 & Test::ORDERS,
            false => self.0 ^ Test::ORDERS,
        };
        match orders {
            0b001 => Comparison::Less,
            0b010 => Comparison::Equal,
            0b011 => Comparison::LessEqual,
            0b100 => Comparison::Greater,
            _ => Comparison::GreaterEqual,
        }
    }

    /// Does it jump when the comparison holds?
    pub fn when(self) -> bool {
        self.0 & Test::WHEN != 0
    }
}

/// One operation, in eight bytes; slots and numbers that do not fit are left to longer sequences.
/// "Push" and "pop" refer to the value stack.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Op {
    /// Push a constant.
    Const(u32),
    /// Push `NIL`.
    Nil,
    /// Push a small integer.
    Int(i32),
    /// Push a local.
    Local(u32),
    /// Push two locals.
    TwoLocals(u16, u16),
    /// Push what a local's box holds.
    LocalBox(u32),
    /// Pop into a local.
    SetLocal(u32),
    /// Pop into a local's box.
    SetLocalBox(u32),
    /// Put a local into a fresh box.
    MakeBox(u32),
    /// Push a free variable.
    Free(u32),
    /// Push what a free variable's box holds.
    FreeBox(u32),
    /// Pop into a free variable's box.
    SetFreeBox(u32),
    /// Push the value of a global or special variable.
    Global(Sym),
    /// Pop into a global or special variable.
    SetGlobal(Sym),
    /// Push a symbol's global function.
    Function(Sym),
    /// Push the function of `(setf symbol)`.
    SetfFunction(Sym),
    /// Push a closure of the inner code.
    Closure(u32),
    /// Drop the top.
    Pop,
    /// Drop this many values from the top.
    Drop(u32),
    /// Drop this many values below the top.
    Slide(u32),
    /// Push the top again.
    Dup,
    /// Continue at the operation with this index.
    Jump(u32),
    /// Pop; jump if it was `NIL`.
    JumpIfNil(u32),
    /// Pop; jump unless it was `NIL`.
    JumpIfTrue(u32),
    /// Jump if the top is true, else pop it.
    JumpIfTrueOrPop(u32),
    /// Jump if a parameter was supplied.
    JumpIfSupplied(u16, u32),
    /// Jump if a local is true (when that is wanted) or `NIL` (when it is not). So do the following
    /// operations, according to the result of a test.
    JumpIfLocal {
        slot: u16,
        when: bool,
        target: u32,
    },
    /// Pop; is it a pair?
    JumpIfConsp {
        when: bool,
        target: u32,
    },
    /// Is a local a pair?
    JumpIfLocalConsp {
        slot: u16,
        when: bool,
        target: u32,
    },
    /// Pop two; are they `eq`?
    JumpIfEq {
        when: bool,
        target: u32,
    },
    /// Pop; is it `eq` to a constant?
    JumpIfEqConst {
        constant: u16,
        when: bool,
        target: u32,
    },
    /// Pop two numbers; do they compare like that? This and the following operations skip the next
    /// one if they do not jump.
    JumpIfCompare {
        test: Test,
        target: u32,
    },
    /// Pop a number; does it compare like that with an integer?
    JumpIfCompareInt {
        test: Test,
        n: i16,
        target: u32,
    },
    /// Do two locals compare like that?
    JumpIfCompareLocals {
        test: Test,
        a: u8,
        b: u8,
        target: u32,
    },
    /// Pop a number; does a local compare like that with it?
    JumpIfCompareLocal {
        test: Test,
        slot: u8,
        target: u32,
    },
    /// Does a local compare like that with an integer?
    JumpIfCompareLocalInt {
        test: Test,
        slot: u8,
        n: i8,
        target: u32,
    },
    /// Push whether a parameter was supplied.
    Supplied(u32),
    /// Call a symbol's function with this many arguments for one value.
    Call(Sym, u16),
    /// Call a symbol's function with this many arguments for all values.
    CallMulti(Sym, u16),
    /// Call a symbol's function with this many arguments for all values, and return them. If it is
    /// the running function itself, its frame is used again.
    CallSelf(Sym, u16),
    /// Call the function below this many arguments for one value.
    CallValue(u16),
    /// Call the function below this many arguments for all values.
    CallValueMulti(u16),
    /// Call the function below this many results with all their values.
    MultipleValueCall(u16, bool),
    /// Return the top.
    Return,
    /// Pop the values of a call and push exactly this many of them.
    Spread(u32),
    /// Car of the top.
    Car,
    /// Cdr of the top.
    Cdr,
    /// What a path of car and cdr leads to from the top, written as the builtins `cadr` and so on
    /// write it: after the leading one, a bit for each, one for cdr, the last of which comes first.
    Path(u8),
    /// Push what a path leads to from a local.
    LocalPath(u32, u8),
    /// Push the car of a local.
    LocalCar(u32),
    /// Push the cdr of a local.
    LocalCdr(u32),
    /// Replace a local by its cdr and skip the next operation.
    LocalToCdr(u32),
    /// A pair of the two topmost.
    Cons,
    /// Are the two topmost `eq`?
    Eq,
    /// Is the top `NIL`?
    Not,
    /// Sum of the two topmost.
    Add,
    /// Difference of the two topmost.
    Sub,
    /// Product of the two topmost.
    Mul,
    /// Sum of the top and a local.
    AddLocal(u32),
    /// Difference of the top and a local.
    SubLocal(u32),
    /// Top plus a small integer.
    AddInt(i32),
    /// Push a local plus a small integer.
    LocalAddInt(u16, i32),
    /// Add a small integer to a local and skip the next operation.
    AddToLocal(u16, i32),
    /// Do the two topmost numbers compare like that?
    Compare(Comparison),
    /// Is the top a pair?
    Consp,
    /// Element of a vector: `aref` or `svref`, whichever the symbol is, of the two topmost.
    Element(Sym),
    /// Pop an index, a vector and a value, and make this the element: `(setf aref)` or `(setf
    /// svref)`.
    SetElement(Sym),
    /// Push the element of a vector that is a local, at an index that is one: `svref` or `aref`.
    LocalElement {
        is_simple: bool,
        vector: u16,
        index: u16,
    },
    /// Pop a value and make it the element of a vector that is a local, at an index that is one, if
    /// that can be done without a builtin, and skip the next four operations, which do it otherwise.
    SetLocalElement {
        vector: u16,
        index: u16,
    },
    /// `rplaca` of the two topmost.
    SetCar,
    /// `rplacd` of the two topmost.
    SetCdr,
    /// The same, dropping the pair: both skip the next operation, which does.
    SetCarOnly,
    SetCdrOnly,
    /// Pop a value and bind a special variable to it.
    BindSpecial(Sym),
    /// Pop a list of values and a list of symbols, and bind the symbols; pushes nothing.
    Progv,
    /// Undo this many dynamic entries.
    PopDynamic(u32),
    /// Undo the dynamic entries beyond the innermost `progv` mark, and the mark.
    EndProgv,
    /// Enter a block that closures may leave: push its identity as a local.
    EnterBlock {
        /// Where execution continues after a return.
        target: u32,
        /// Does the block want all values?
        multi: bool,
    },
    /// Pop a value and an identity, and leave that block with the value.
    ReturnFrom,
    /// Enter a tagbody that closures may jump into: push its identity as a local. The
    /// operand is the number of its table of tags.
    EnterTagbody(u32),
    /// Pop an identity and go to a tag of that tagbody.
    Go(u32),
    /// Pop a tag and establish a catch.
    EnterCatch {
        /// Where execution continues after a throw.
        target: u32,
        /// Does the catch want all values?
        multi: bool,
    },
    /// Pop values and a tag, and leave the innermost catch of the tag with the values.
    Throw,
    /// Protect what follows: on any exit, run the code at the target.
    EnterUnwind(u32),
    /// Leave the protected form normally: its value is on top.
    LeaveUnwind,
    /// End of cleanup code: continue the exit that ran it, or continue with the value.
    EndCleanup,
    /// Pop this many handler functions and establish them with the types in a constant.
    EnterHandlers(u32, u16),
    /// Pop a list of restarts and establish them.
    EnterRestarts,
}

const _: () = assert!(size_of::<Op>() == 8);

impl Op {
    /// Is it a jump that compares numbers, and so may find that they are none?
    pub(crate) fn may_fail_instead_of_jump(self) -> bool {
        matches!(
            self,
            Op::JumpIfCompare { .. }
                | Op::JumpIfCompareInt { .. }
                | Op::JumpIfCompareLocals { .. }
                | Op::JumpIfCompareLocal { .. }
                | Op::JumpIfCompareLocalInt { .. }
        )
    }

    /// The symbol that the operation refers to, if there is one.
    pub fn symbol_mut(&mut self) -> Option<&mut Sym> {
        match self {
            Op::Global(sym)
            | Op::SetGlobal(sym)
            | Op::Function(sym)
            | Op::SetfFunction(sym)
            | Op::Call(sym, _)
            | Op::CallMulti(sym, _)
            | Op::CallSelf(sym, _)
            | Op::Element(sym)
            | Op::SetElement(sym)
            | Op::BindSpecial(sym) => Some(sym),
            _ => None,
        }
    }

    /// Where execution may continue instead of at the next operation, if the operation says that.
    pub(crate) fn target_mut(&mut self) -> Option<&mut u32> {
        match self {
            Op::Jump(target)
            | Op::JumpIfNil(target)
            | Op::JumpIfTrue(target)
            | Op::JumpIfTrueOrPop(target)
            | Op::JumpIfSupplied(_, target)
            | Op::JumpIfLocal { target, .. }
            | Op::JumpIfConsp { target, .. }
            | Op::JumpIfLocalConsp { target, .. }
            | Op::JumpIfEq { target, .. }
            | Op::JumpIfEqConst { target, .. }
            | Op::JumpIfCompare { target, .. }
            | Op::JumpIfCompareInt { target, .. }
            | Op::JumpIfCompareLocals { target, .. }
            | Op::JumpIfCompareLocal { target, .. }
            | Op::JumpIfCompareLocalInt { target, .. }
            | Op::EnterUnwind(target)
            | Op::EnterBlock { target, .. }
            | Op::EnterCatch { target, .. } => Some(target),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_jumps_when_its_comparison_says_so() {
        for comparison in [
            Comparison::Less,
            Comparison::Equal,
            Comparison::LessEqual,
            Comparison::Greater,
            Comparison::GreaterEqual,
        ] {
            for when in [true, false] {
                let test = Test::new(comparison, when);
                assert_eq!((test.comparison(), test.when()), (comparison, when));
                for (a, b) in [(1, 2), (2, 2), (3, 2), (i64::MIN, i64::MAX)] {
                    assert_eq!(test.jumps(a, b), comparison.holds(a, b) == when);
                }
            }
        }
    }
}
