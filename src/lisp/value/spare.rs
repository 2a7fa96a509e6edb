//! Pairs that are out of use: the next ones that are made. That is several times faster than to have
//! the allocator free each and make it again. The end of an image gives them back ([`empty`]), so a
//! thread that has ended keeps none.

use std::cell::RefCell;
use std::mem::ManuallyDrop;
use std::rc::Rc;

use super::Value;
use super::cons::Cons;

/// Pairs that are kept at most: about half a megabyte.
const MOST: usize = 8192;

thread_local! {
    /// Pairs that nobody refers to, with "no value" in both halves.
    static SPARE: RefCell<ManuallyDrop<Vec<Rc<Cons>>>> =
        const { RefCell::new(ManuallyDrop::new(Vec::new())) };
}

/// A pair with "no value" in both halves and without a place in a source.
#[inline(always)]
pub(super) fn take() -> Rc<Cons> {
    let spare = SPARE.with_borrow_mut(|spare| spare.pop());
    spare.unwrap_or_else(|| Rc::new(Cons::new(Value::Unbound, Value::Unbound)))
}

/// Keeps a pair that has "no value" in both halves, unless somebody refers to it or there are enough.
#[inline(always)]
pub(super) fn keep(mut cons: Rc<Cons>) {
    // A pair that has been noted as a suspect has a weak reference, so it is not kept.
    let Some(pair) = Rc::get_mut(&mut cons) else {
        return;
    };
    pair.renew();
    SPARE.with_borrow_mut(|spare| {
        if spare.len() < MOST {
            spare.push(cons);
        }
    });
}

/// Gives the pairs that are kept back to the allocator.
pub(super) fn empty() {
    let spare = SPARE.with_borrow_mut(|spare| std::mem::take(&mut **spare));
    drop(spare);
}
