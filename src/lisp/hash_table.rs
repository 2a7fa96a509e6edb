//! Hash tables that remember the order of insertion, so that iteration is the same on
//! every run.

use std::cell::RefCell;
use std::hash::{Hash, Hasher};

use indexmap::IndexMap;

use super::equality;
use super::value::Value;

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
pub struct HashKey {
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

/// A hash table.
pub struct HashTable {
    /// How keys are compared.
    pub test: HashTest,
    /// Entries in order of insertion.
    pub entries: RefCell<IndexMap<HashKey, Value>>,
}

impl HashTable {
    /// An empty table.
    pub fn new(test: HashTest) -> HashTable {
        HashTable {
            test,
            entries: RefCell::default(),
        }
    }

    /// The value of a key.
    pub fn get(&self, key: &Value) -> Option<Value> {
        let key = HashKey {
            value: key.clone(),
            test: self.test,
        };
        self.entries.borrow().get(&key).cloned()
    }

    /// Sets the value of a key.
    pub fn insert(&self, key: Value, value: Value) {
        let key = HashKey {
            value: key,
            test: self.test,
        };
        self.entries.borrow_mut().insert(key, value);
    }

    /// Removes a key, keeping the order of the others; was it there?
    pub fn remove(&self, key: &Value) -> bool {
        let key = HashKey {
            value: key.clone(),
            test: self.test,
        };
        self.entries.borrow_mut().shift_remove(&key).is_some()
    }
}
