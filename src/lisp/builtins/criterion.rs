//! What an element must satisfy to be found, counted, removed or replaced: `:test`,
//! `:test-not`, `:key`, or a predicate.

use crate::image::Image;
use crate::value::Value;
use crate::value::equality;
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::callable::{builtin_name, callable};
use crate::vm::calls::Calls;

/// A function that is applied to elements before they are tested; none is the identity.
#[derive(Clone)]
pub struct Key(Option<Value>);

impl Key {
    /// From the value of a `:key` argument.
    pub fn new(image: &Image, key: Option<Value>) -> Result<Key, Box<Raise>> {
        let Some(key) = key.filter(Value::is_true) else {
            return Ok(Key(None));
        };
        let function = callable(image, &key)?;
        let identity = builtin_name(&function).is_some_and(|name| name == known::IDENTITY);
        Ok(Key((!identity).then_some(function)))
    }

    /// The value that is tested for an element.
    pub async fn of(&self, calls: &Calls, element: Value) -> Value {
        match &self.0 {
            None => element,
            Some(key) => calls.call1(key, element).await,
        }
    }
}

/// A comparison of two values that calls no function of a program.
pub type Compare = fn(&Value, &Value) -> bool;

/// How two values are compared.
#[derive(Clone)]
pub enum Test {
    /// By identity.
    Eq,
    /// By `eql`.
    Eql,
    /// By `equal`.
    Equal,
    /// By `equalp`.
    Equalp,
    /// By a function.
    Function(Value),
    /// They match when the function returns `NIL`.
    NotFunction(Value),
}

impl Test {
    /// From the values of `:test` and `:test-not` arguments.
    pub fn new(
        image: &Image,
        test: Option<Value>,
        test_not: Option<Value>,
    ) -> Result<Test, Box<Raise>> {
        match (test.filter(Value::is_true), test_not.filter(Value::is_true)) {
            (None, None) => Ok(Test::Eql),
            (Some(_), Some(_)) => Err(Raise::simple(":TEST and :TEST-NOT were both supplied.")),
            (None, Some(test_not)) => Ok(Test::NotFunction(callable(image, &test_not)?)),
            (Some(test), None) => {
                let function = callable(image, &test)?;
                Ok(match builtin_name(&function) {
                    Some(known::EQ) => Test::Eq,
                    Some(known::EQL) => Test::Eql,
                    Some(known::EQUAL) => Test::Equal,
                    Some(known::EQUALP) => Test::Equalp,
                    _ => Test::Function(function),
                })
            }
        }
    }

    /// What compares two values, if that is no function of a program.
    fn simple(&self) -> Option<Compare> {
        Some(match self {
            Test::Eq => Value::is_eq,
            Test::Eql => Value::is_eql,
            Test::Equal => equality::equal,
            Test::Equalp => equality::equalp,
            Test::Function(_) | Test::NotFunction(_) => return None,
        })
    }

    /// Do two values match? The function receives them in this order.
    pub async fn matches(&self, calls: &Calls, a: &Value, b: &Value) -> bool {
        match self {
            Test::Eq => a.is_eq(b),
            Test::Eql => a.is_eql(b),
            Test::Equal => equality::equal(a, b),
            Test::Equalp => equality::equalp(a, b),
            Test::Function(test) => calls.call2(test, a.clone(), b.clone()).await.is_true(),
            Test::NotFunction(test) => calls.call2(test, a.clone(), b.clone()).await.is_nil(),
        }
    }
}

/// A condition on elements.
pub struct Criterion {
    kind: Kind,
    key: Key,
}

enum Kind {
    Item { item: Value, test: Test },
    Predicate { function: Value, expected: bool },
}

impl Criterion {
    /// Elements that match an item.
    pub fn item(item: Value, test: Test, key: Key) -> Criterion {
        Criterion {
            kind: Kind::Item { item, test },
            key,
        }
    }

    /// Elements for which a predicate returns true, or false if `expected` is false.
    pub fn predicate(
        image: &Image,
        predicate: &Value,
        expected: bool,
        key: Key,
    ) -> Result<Criterion, Box<Raise>> {
        Ok(Criterion {
            kind: Kind::Predicate {
                function: callable(image, predicate)?,
                expected,
            },
            key,
        })
    }

    /// The item and the test, if elements are compared as they are and without calls of functions.
    pub fn simple(&self) -> Option<(&Value, Compare)> {
        match &self.kind {
            Kind::Item { item, test } if self.key.0.is_none() => Some((item, test.simple()?)),
            _ => None,
        }
    }

    /// Does an element satisfy the condition?
    pub(crate) async fn accepts(&self, calls: &Calls, element: &Value) -> bool {
        let looked_at = self.key.of(calls, element.clone()).await;
        match &self.kind {
            Kind::Item { item, test } => test.matches(calls, item, &looked_at).await,
            Kind::Predicate { function, expected } => {
                calls.call1(function, looked_at).await.is_true() == *expected
            }
        }
    }
}
