//! Values by number, most of which are never set.

/// How many values stand on a page.
const PAGE: usize = 1024;

/// Values by number. Only the pages on which something has been set take memory.
pub(super) struct Pages<T> {
    pages: Vec<Option<Box<[T]>>>,
    unset: T,
}

impl<T: Copy> Pages<T> {
    /// So many values that are not set.
    pub(super) fn new(count: usize, unset: T) -> Self {
        let pages = (0..count.div_ceil(PAGE)).map(|_| None);
        Self {
            pages: pages.collect(),
            unset,
        }
    }

    /// The value of a number.
    #[inline]
    pub(super) fn get(&self, at: usize) -> T {
        match self.pages.get(at / PAGE) {
            Some(Some(page)) => page[at % PAGE],
            _ => self.unset,
        }
    }

    /// Sets the value of a number, which must be less than the count.
    #[inline]
    pub(super) fn set(&mut self, at: usize, value: T) {
        let unset = self.unset;
        let page = &mut self.pages[at / PAGE];
        let page = page.get_or_insert_with(|| vec![unset; PAGE].into());
        page[at % PAGE] = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_set_is_found_and_nothing_else(
            set in prop::collection::btree_map(0..5000_usize, any::<u32>(), 0..20),
        ) {
            let mut pages = Pages::new(5000, 7);
            for (at, value) in &set {
                pages.set(*at, *value);
            }
            for at in 0..5000 {
                prop_assert_eq!(pages.get(at), set.get(&at).copied().unwrap_or(7));
            }
        }
    }
}
