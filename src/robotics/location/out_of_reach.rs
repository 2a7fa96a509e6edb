//! What has been found to be out of reach from everywhere.

use std::cell::RefCell;

use super::base_query::BaseQuery;
use super::tally::Tally;

/// The last search for base poses that has found none although it has not rejected any for want of
/// sight. The same search finds none without that demand either, so it need not be made.
#[derive(Debug, Default)]
pub struct OutOfReach(RefCell<Option<Vain>>);

/// A search in vain.
#[derive(Debug)]
struct Vain {
    /// The state of the world.
    state: u64,
    /// What was wanted, but for sight.
    query: BaseQuery,
    /// Why nothing was found.
    tally: Tally,
}

impl OutOfReach {
    /// Notes that the query has no answer in a state of the world.
    pub(super) fn note(&self, state: u64, query: &BaseQuery, tally: &Tally) {
        let query = BaseQuery {
            sees: false,
            ..query.clone()
        };
        *self.0.borrow_mut() = Some(Vain {
            state,
            query,
            tally: tally.clone(),
        });
    }

    /// Why the query has no answer in a state of the world, if that is known.
    pub(super) fn known(&self, state: u64, query: &BaseQuery) -> Option<Tally> {
        let noted = self.0.borrow();
        let vain = noted.as_ref()?;
        (vain.state == state && vain.query == *query).then(|| vain.tally.clone())
    }
}
