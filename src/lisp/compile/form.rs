//! Building forms in macros.

/// A list of the items; after a semicolon, a tail that the list ends in.
macro_rules! form {
    ($($item:expr),* $(,)?) => {
        $crate::lisp::value::Value::list([$($crate::lisp::value::Value::from($item)),*])
    };
    ($($item:expr),* ; $tail:expr) => {
        $crate::lisp::value::Value::list_with_tail(
            [$($crate::lisp::value::Value::from($item)),*],
            $tail,
        )
    };
}
pub(crate) use form;
