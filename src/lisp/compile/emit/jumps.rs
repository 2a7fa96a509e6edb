//! Jumps to jumps, and to returns.

use crate::value::operation::Op;

/// Lets whatever jumps forwards to a jump go where that leads to, and makes a return of a jump to one.
/// Jumps backwards stay: the machine looks for interrupts in them.
pub(super) fn shorten(ops: &mut [Op]) {
    // From the end, so that the targets are as short as they get.
    for at in (0..ops.len()).rev() {
        let mut op = ops[at];
        let Some(target) = op.target_mut() else {
            continue;
        };
        let there = *target as usize;
        if there <= at {
            continue;
        }
        if let Some(Op::Jump(end)) = ops.get(there)
            && *end as usize > there
        {
            *target = *end;
        }
        let is_return = |target: u32| ops.get(target as usize) == Some(&Op::Return);
        ops[at] = match op {
            Op::Jump(target) if is_return(target) => Op::Return,
            _ => op,
        };
    }
}
