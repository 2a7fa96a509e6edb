//! Hash tables.

use std::rc::Rc;

use super::lists::Size;
use super::shown::shown;
use crate::builtin::Builtin;
use crate::guard::reserve;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::cycles;
use crate::value::hash_table::{HashTable, HashTest};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::callable::{builtin_name, callable};
use crate::vm::calls::run;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// A value as a hash table.
pub(crate) fn table(value: &Value) -> Result<&Rc<HashTable>, Box<Raise>> {
    match value {
        Value::Hash(table) => Ok(table),
        _ => Err(Raise::type_error(value, known::HASH_TABLE)),
    }
}

/// A test and the symbol that names it.
const TESTS: &[(HashTest, Sym)] = &[
    (HashTest::Eq, known::EQ),
    (HashTest::Eql, known::EQL),
    (HashTest::Equal, known::EQUAL),
    (HashTest::Equalp, known::EQUALP),
];

/// An empty hash table; the test is `eq`, `eql` (the default), `equal` or `equalp`.
///
/// `(hash-table-count (make-hash-table :test 'equal))` => `0`
#[builtin("MAKE-HASH-TABLE", "&key test size rehash-size rehash-threshold")]
fn make(
    image: &mut Image,
    #[key] test: Option<Value>,
    #[key] size: Option<Size>,
    #[key] _rehash_size: Option<&Value>,
    #[key] _rehash_threshold: Option<&Value>,
    #[key] _weakness: Option<&Value>,
    #[key] _synchronized: Option<&Value>,
) -> Outcome {
    let test = test.unwrap_or(Value::symbol(known::EQL));
    let name = test.as_symbol().or_else(|| builtin_name(&test));
    let Some((test, _)) = TESTS.iter().find(|(_, sym)| Some(*sym) == name) else {
        return Err(Raise::simple(format!(
            "{} is no :TEST of hash tables; EQ, EQL, EQUAL and EQUALP are.",
            shown(image, &test)
        )));
    };
    let table = HashTable::new(*test);
    if let Some(Size(size)) = size {
        table.size.set(size);
    }
    Ok(Value::Hash(Rc::new(table)))
}

/// Is the object a hash table?
///
/// `(hash-table-p 5)` => `NIL`
#[builtin]
fn hash_table_p(object: &Value) -> bool {
    matches!(object, Value::Hash(_))
}

/// The value of a key, and whether the key is there.
///
/// `(gethash 'a (make-hash-table) 7)` => `7 ; NIL`
#[builtin]
fn gethash(
    image: &mut Image,
    key: &Value,
    table: &Rc<HashTable>,
    default: Option<&Value>,
) -> Outcome {
    let (value, found) = match table.get(key) {
        Some(value) => (value, true),
        None => (default.cloned().unwrap_or(Value::NIL), false),
    };
    Ok(image.with_second(value, || found.into()))
}

/// Sets the value of a key.
#[builtin("GETHASH")]
fn set_gethash(
    value: &Value,
    key: &Value,
    table: &Rc<HashTable>,
    _default: Option<&Value>,
) -> Outcome {
    cycles::note(table, value);
    cycles::note(table, key);
    let more = table.bytes_to_grow();
    if more > 0 {
        reserve(more);
    }
    table.insert(key.clone(), value.clone());
    Ok(value.clone())
}

/// Removes a key; was it there?
///
/// `(remhash 'a (make-hash-table))` => `NIL`
#[builtin]
fn remhash(key: &Value, table: &Rc<HashTable>) -> Outcome {
    Ok(table.remove(key).into())
}

/// Removes all entries; returns the table.
///
/// `(hash-table-count (clrhash (make-hash-table)))` => `0`
#[builtin(_, "table")]
fn clrhash(table_value: &Value) -> Outcome {
    table(table_value)?.clear();
    Ok(table_value.clone())
}

/// The number of entries.
///
/// `(hash-table-count (make-hash-table))` => `0`
#[builtin]
fn hash_table_count(table: &Rc<HashTable>) -> Outcome {
    Ok(table.len().into())
}

/// The number of entries that there is room for.
///
/// `(hash-table-size (make-hash-table :size 100))` => `100`
#[builtin]
fn hash_table_size(table: &Rc<HashTable>) -> Outcome {
    Ok(table.size.get().max(table.len()).into())
}

/// The name of the table's test.
///
/// `(hash-table-test (make-hash-table))` => `EQL`
#[builtin]
fn hash_table_test(table: &Rc<HashTable>) -> Outcome {
    let test = table.test;
    let name = TESTS.iter().find(|(t, _)| *t == test);
    Ok(name.map_or(Value::NIL, |(_, sym)| Value::symbol(*sym)))
}

/// How a table grows.
///
/// `(hash-table-rehash-size (make-hash-table))` => `1.5`
#[builtin("HASH-TABLE-REHASH-SIZE", "table")]
fn rehash_size(table_value: &Value) -> Outcome {
    table(table_value).map(|_| Value::Single(1.5))
}

/// How full a table may be.
///
/// `(hash-table-rehash-threshold (make-hash-table))` => `1.0`
#[builtin("HASH-TABLE-REHASH-THRESHOLD", "table")]
fn rehash_threshold(table_value: &Value) -> Outcome {
    table(table_value).map(|_| Value::Single(1.0))
}

/// Calls a function with the key and value of each entry, in order of insertion.
///
/// `(let ((h (make-hash-table)) r) (setf (gethash 1 h) 'a) (maphash (lambda (k v) (push (list k v) r)) h) r)` => `((1 A))`
#[builtin]
fn maphash(
    machine: &mut Machine<'_>,
    function: Value,
    table: &Rc<HashTable>,
) -> Result<Step, Box<Raise>> {
    let function = callable(machine.image, &function)?;
    let table = table.clone();
    run(machine, "MAPHASH", |calls| async move {
        for (key, _) in table.pairs() {
            // An entry may have been removed or changed since.
            if let Some(value) = table.get(&key) {
                calls.call2(&function, key, value).await;
            }
        }
        Ok(Value::NIL)
    })
}

/// A number that is the same for `equal` objects.
///
/// `(= (sxhash "abc") (sxhash (copy-seq "abc")))` => `T`
// A number that is the same for values that are `equal`, on every run.
#[builtin]
fn sxhash(image: &mut Image, object: Value) -> Outcome {
    let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
    let mut mix = |bytes: &[u8]| {
        for byte in bytes {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
        }
    };
    let mut pending = vec![object];
    // Deep structures are distinguished by their first few leaves only.
    for _ in 0..64 {
        let Some(value) = pending.pop() else { break };
        match &value {
            Value::Symbol(s, ..) => mix(image.name(*s).as_bytes()),
            Value::Int(n) => mix(&n.to_le_bytes()),
            Value::Big(n) => mix(&n.to_signed_bytes_le()),
            Value::Ratio(r) => {
                mix(&r.numerator.to_signed_bytes_le());
                mix(&r.denominator.to_signed_bytes_le());
            }
            Value::Single(x) => mix(&x.to_bits().to_le_bytes()),
            Value::Double(x) => mix(&x.to_bits().to_le_bytes()),
            Value::Char(c) => mix(&u32::from(*c).to_le_bytes()),
            Value::Str(s) => mix(s.borrow().as_bytes()),
            Value::Cons(c) => {
                mix(&[1]);
                pending.push(c.cdr());
                pending.push(c.car());
            }
            _ => mix(&[2]),
        }
    }
    Ok(Value::Int(i64::try_from(hash >> 2).unwrap_or(0)))
}

/// An iterator over the entries of a table.
///
/// `(system::%hash-iterator (make-hash-table))` => `(NIL)`
// The entries that `with-hash-table-iterator` steps through, in a fresh pair.
#[builtin("%HASH-ITERATOR")]
fn hash_iterator(table: &Rc<HashTable>) -> Outcome {
    let entries = table.pairs();
    let entries = entries.into_iter().map(|(k, v)| Value::list([k, v]));
    Ok(Value::cons(
        Value::list(entries.collect::<Vec<_>>()),
        Value::NIL,
    ))
}

/// Takes the next entry: `T` and its parts, or `NIL`.
///
/// `(system::%iterator-next (list '((a 1))))` => `T ; A ; 1`
// Advances an iterator: returns `T` and the parts of the next entry, or `NIL`.
#[builtin("%ITERATOR-NEXT")]
fn iterator_next(iterator: &Value) -> Outcome {
    let Value::Cons(state) = iterator else {
        return Err(Raise::type_error(iterator, known::CONS));
    };
    match state.car() {
        Value::Cons(entries) => {
            state.set_car(entries.cdr());
            let mut values = vec![Value::T];
            values.extend(entries.car().iter_list());
            Ok(Value::values(values))
        }
        _ => Ok(Value::NIL),
    }
}

/// The keys of a table, in order of insertion.
///
/// `(system::%hash-keys (make-hash-table))` => `NIL`
#[builtin("%HASH-KEYS")]
fn hash_keys(table: &Rc<HashTable>) -> Outcome {
    let pairs = table.pairs();
    Ok(Value::list(
        pairs.into_iter().map(|(k, _)| k).collect::<Vec<_>>(),
    ))
}

/// The values of a table, in order of insertion.
///
/// `(system::%hash-values (make-hash-table))` => `NIL`
#[builtin("%HASH-VALUES")]
fn hash_values(table: &Rc<HashTable>) -> Outcome {
    let pairs = table.pairs();
    Ok(Value::list(
        pairs.into_iter().map(|(_, v)| v).collect::<Vec<_>>(),
    ))
}

/// The entries of a table as pairs, in order of insertion.
///
/// `(system::%hash-pairs (make-hash-table))` => `NIL`
#[builtin("%HASH-PAIRS")]
fn hash_alist(table: &Rc<HashTable>) -> Outcome {
    let pairs = table.pairs();
    Ok(Value::list(
        pairs
            .into_iter()
            .map(|(k, v)| Value::cons(k, v))
            .collect::<Vec<_>>(),
    ))
}

/// Hash tables.
pub(crate) static TABLE: &[Builtin] = builtins![
    make,
    hash_table_p,
    gethash,
    remhash,
    clrhash,
    hash_table_count,
    hash_table_size,
    hash_table_test,
    rehash_size,
    rehash_threshold,
    maphash,
    sxhash,
];

/// What the expansions of macros call; in `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    hash_iterator,
    iterator_next,
    hash_keys,
    hash_values,
    hash_alist,
];

/// Places for `setf`; the new value is the first argument.
pub(crate) static SETTERS: &[Builtin] = builtins![set_gethash,];
