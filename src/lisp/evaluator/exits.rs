//! Operations that begin the extent of what code can leave to: blocks, tags, catches, and cleanup
//! code.

use super::dynamic::establish;
use crate::image::Image;
use crate::vm::fiber::Dynamic;
use crate::vm::frames::Frames;
use crate::vm::stack::Window;

/// The dynamic entries of a fiber, and its frames.
type Entries<'a> = (&'a mut Vec<Dynamic>, &'a Frames);

/// Establishes a block, whose identity is pushed. Exits continue at a target, with all values or one.
#[inline(always)]
pub(super) fn enter_block(
    image: &mut Image,
    entries: Entries<'_>,
    window: &mut Window<'_>,
    (target, multi): (u32, bool),
) {
    let id = image.fresh_identity();
    let height = window.height();
    establish(entries, |frame| Dynamic::Block {
        id,
        frame,
        height,
        target,
        multi,
    });
    window.push_int(id);
}

/// Establishes the tags of a table, whose identity is pushed.
#[inline(always)]
pub(super) fn enter_tagbody(
    image: &mut Image,
    entries: Entries<'_>,
    window: &mut Window<'_>,
    table: u32,
) {
    let id = image.fresh_identity();
    window.push_int(id);
    let height = window.height();
    establish(entries, |frame| Dynamic::Tagbody {
        id,
        frame,
        height,
        table,
    });
}

/// Establishes a catch, whose tag is the top.
#[inline(always)]
pub(super) fn enter_catch(
    entries: Entries<'_>,
    window: &mut Window<'_>,
    (target, multi): (u32, bool),
) {
    let tag = window.pop();
    let height = window.height();
    establish(entries, |frame| Dynamic::Catch {
        tag,
        frame,
        height,
        target,
        multi,
    });
}

/// Establishes cleanup code, which begins at a target.
#[inline(always)]
pub(super) fn enter_unwind(entries: Entries<'_>, window: &Window<'_>, target: u32) {
    let height = window.height();
    establish(entries, |frame| Dynamic::Unwind {
        frame,
        height,
        target,
    });
}
