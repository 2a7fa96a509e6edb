//! Hash tables that remember the order of insertion, so that iteration is the same on
//! every run.

use std::cell::{Cell, Ref, RefCell};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

use super::Value;
use super::cycles::Mark;
use super::equality;
use super::key_hasher::KeyHasher;
use super::release::release_values;

/// The equality by which a table finds its keys.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum HashTest {
    /// Identity.
    Eq,
    /// `eql`.
    Eql,
    /// `equal`.
    Equal,
    /// `equalp`.
    Equalp,
}

/// A key under the equality of its table.
#[derive(Clone)]
pub(crate) struct HashKey {
    /// The key.
    pub value: Value,
    /// The table's test.
    pub test: HashTest,
}

impl PartialEq for HashKey {
    fn eq(&self, other: &HashKey) -> bool {
        match self.test {
            HashTest::Eq => self.value.is_eq(&other.value),
            HashTest::Eql => self.value.is_eql(&other.value),
            HashTest::Equal => equality::equal(&self.value, &other.value),
            HashTest::Equalp => equality::equalp(&self.value, &other.value),
        }
    }
}

impl Eq for HashKey {}

impl Hash for HashKey {
    fn hash<H: Hasher>(&self, state: &mut H) {
        equality::hash(&self.value, self.test, state);
    }
}

/// Keys with their values in order of insertion; removed ones leave a gap.
pub(super) type Entries = Vec<Option<(Value, Value)>>;

pub struct HashTable {
    /// How keys are compared.
    pub test: HashTest,
    /// The position of each key's entry.
    index: RefCell<HashMap<HashKey, usize, BuildHasherDefault<KeyHasher>>>,
    entries: RefCell<Entries>,
    /// The size that the table was made for.
    pub size: Cell<usize>,
    pub(super) mark: Mark,
}

impl HashTable {
    /// An empty table.
    pub fn new(test: HashTest) -> HashTable {
        HashTable {
            test,
            index: RefCell::default(),
            entries: RefCell::default(),
            size: Cell::new(14),
            mark: Mark::default(),
        }
    }

    fn key(&self, value: &Value) -> HashKey {
        HashKey {
            value: value.clone(),
            test: self.test,
        }
    }

    // A table that is a key of itself may be inspected while it changes; it then appears empty.

    /// Number of entries.
    pub fn len(&self) -> usize {
        self.index.try_borrow().map_or(0, |index| index.len())
    }

    /// Is there no entry?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The value of a key.
    pub fn get(&self, key: &Value) -> Option<Value> {
        let place = *self.index.try_borrow().ok()?.get(&self.key(key))?;
        let entries = self.entries.try_borrow().ok()?;
        entries.get(place)?.as_ref().map(|(_, value)| value.clone())
    }

    /// Bytes that another key takes beside those that the table has already: none, unless it is full.
    pub(crate) fn bytes_to_grow(&self) -> usize {
        let (Ok(index), Ok(entries)) = (self.index.try_borrow(), self.entries.try_borrow()) else {
            return 0;
        };
        let mut bytes = 0;
        if index.len() == index.capacity() {
            // The old places are there until all keys have new ones, twice as many.
            bytes += 2 * index.capacity() * size_of::<(HashKey, usize)>();
        }
        if entries.len() == entries.capacity() {
            bytes += entries.capacity() * size_of::<Option<(Value, Value)>>();
        }
        bytes
    }

    /// Sets the value of a key.
    pub fn insert(&self, key: Value, value: Value) {
        let mut index = self.index.borrow_mut();
        let mut entries = self.entries.borrow_mut();
        let place = *index.entry(self.key(&key)).or_insert(entries.len());
        match entries.get_mut(place) {
            Some(Some((_, old))) => *old = value,
            Some(gap) => *gap = Some((key, value)),
            None => entries.push(Some((key, value))),
        }
    }

    /// Removes a key, keeping the order of the others; returns whether it was there.
    pub fn remove(&self, key: &Value) -> bool {
        let mut index = self.index.borrow_mut();
        let Some(place) = index.remove(&self.key(key)) else {
            return false;
        };
        let mut entries = self.entries.borrow_mut();
        if let Some(entry) = entries.get_mut(place) {
            *entry = None;
        }
        // Close the gaps when there are more of them than entries.
        if entries.len() > 16 && entries.len() > 2 * index.len() {
            entries.retain(Option::is_some);
            for (place, entry) in entries.iter().enumerate() {
                if let Some((key, _)) = entry
                    && let Some(stored) = index.get_mut(&self.key(key))
                {
                    *stored = place;
                }
            }
        }
        true
    }

    /// Calls a function for every reference to a key or a value: the table holds keys twice.
    pub(super) fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        // Both are changed together.
        let (Ok(_), Ok(entries)) = (self.index.try_borrow(), self.entries.try_borrow()) else {
            return;
        };
        for (key, value) in entries.iter().flatten() {
            visit(key);
            visit(key);
            visit(value);
        }
    }

    /// The entries in order of insertion, with the gaps that removed ones have left.
    pub(super) fn entries(&self) -> Ref<'_, Entries> {
        self.entries.borrow()
    }

    /// Fills an empty table; false if two keys are equal.
    pub(super) fn set_entries(&self, entries: Entries) -> bool {
        let mut index = self.index.borrow_mut();
        let mut is_new = true;
        for (place, entry) in entries.iter().enumerate() {
            if let Some((key, _)) = entry {
                is_new &= index.insert(self.key(key), place).is_none();
            }
        }
        self.entries.replace(entries);
        is_new
    }

    /// Removes all entries.
    pub fn clear(&self) {
        self.index.take();
        self.entries.take();
    }

    /// The entries in order of insertion.
    pub fn pairs(&self) -> Vec<(Value, Value)> {
        self.entries.try_borrow().map_or_else(
            |_| Vec::new(),
            |entries| entries.iter().flatten().cloned().collect(),
        )
    }
}

impl Drop for HashTable {
    fn drop(&mut self) {
        let entries = self.entries.take().into_iter().flatten();
        let values: Vec<Value> = entries.flat_map(|(key, value)| [key, value]).collect();
        self.index.take();
        release_values(values);
    }
}

#[cfg(test)]
mod tests {
    use crate::value::hash_table::*;

    fn keys(table: &HashTable) -> Vec<i64> {
        let number = |v: Value| match v {
            Value::Int(n) => n,
            _ => -1,
        };
        table.pairs().into_iter().map(|(k, _)| number(k)).collect()
    }

    #[test]
    fn entries_keep_the_order_of_insertion() {
        let table = HashTable::new(HashTest::Eql);
        for i in 0..100 {
            table.insert(Value::Int(i), Value::NIL);
        }
        for i in 0..95 {
            assert!(table.remove(&Value::Int(i)));
        }
        assert!(!table.remove(&Value::Int(0)));
        table.insert(Value::Int(3), Value::T);
        table.insert(Value::Int(96), Value::T);
        assert_eq!(keys(&table), [95, 96, 97, 98, 99, 3]);
        assert_eq!(table.len(), 6);
        assert!(table.get(&Value::Int(96)).is_some_and(|v| v.is_true()));
        assert!(table.get(&Value::Int(4)).is_none());
    }

    #[test]
    fn equal_tables_find_strings() {
        let table = HashTable::new(HashTest::Equal);
        table.insert(Value::string("a"), Value::Int(1));
        assert!(table.get(&Value::string("a")).is_some());
        assert!(table.get(&Value::string("A")).is_none());
        table.clear();
        assert!(table.is_empty());
    }
}
