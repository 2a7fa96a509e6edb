//! Calls of a function by itself whose values it returns.

use crate::value::code::Parameters;
use crate::value::operation::Op;
use crate::value::symbol::Sym;

/// Marks the calls of the named function whose values are returned at once. Whether they call the
/// function that runs, and not a later one of that name, is found out when they are made.
pub(super) fn mark(ops: &mut [Op], name: Option<Sym>, parameters: &Parameters) {
    let (Some(name), Some(count)) = (name, parameters.exact_count()) else {
        return;
    };
    for at in 0..ops.len() {
        if ops[at] == Op::CallMulti(name, count) && is_returned(ops, at + 1) {
            ops[at] = Op::CallSelf(name, count);
        }
    }
}

/// Is the top returned, with nothing done in between but dropping what lies below it?
fn is_returned(ops: &[Op], mut at: usize) -> bool {
    loop {
        match ops.get(at) {
            Some(Op::Return) => return true,
            Some(Op::Slide(_)) => at += 1,
            // Jumps backwards do not follow a value that is to be returned.
            Some(Op::Jump(target)) if *target as usize > at => at = *target as usize,
            _ => return false,
        }
    }
}
