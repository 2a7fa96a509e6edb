//! Variables that are bound around the cursor, in a form that is still being typed.

use lisp::reader::{Lexer, TokenKind};

/// A list that is open at the cursor.
#[derive(Default)]
struct Scope<'t> {
    operator: Option<&'t str>,
    elements: usize,
    role: Role,
    /// The word before the one at the cursor, which `loop` goes by.
    last: &'t str,
    /// The variables that it binds.
    names: Vec<&'t str>,
}

/// What a list says about variables.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum Role {
    #[default]
    None,
    /// Its elements are variables, or lists that begin with one.
    Bindings,
    /// Its first element is a variable.
    Binding,
}

/// The names, innermost last; each may have been rebound.
pub(super) fn locals(before: &str) -> Vec<&str> {
    let mut scopes: Vec<Scope<'_>> = Vec::new();
    for token in Lexer::new(before) {
        let part = before.get(token.start..token.end).unwrap_or_default();
        match token.kind {
            TokenKind::Open => {
                let role = scopes.last().map_or(Role::None, Scope::role_of_list);
                scopes.push(Scope {
                    role,
                    ..Scope::default()
                });
            }
            TokenKind::Close => {
                scopes.pop();
                if let Some(scope) = scopes.last_mut() {
                    scope.elements += 1;
                }
            }
            // The word at the cursor is still being typed.
            TokenKind::Atom if token.end < before.len() => atom(&mut scopes, part),
            TokenKind::LineComment | TokenKind::BlockComment => {}
            _ => {
                if let Some(scope) = scopes.last_mut() {
                    scope.elements += 1;
                }
            }
        }
    }
    scopes
        .iter()
        .flat_map(|scope| scope.names.iter().copied())
        .collect()
}

impl Scope<'_> {
    /// The role of a list that begins as the next element.
    fn role_of_list(&self) -> Role {
        let operator = self.operator.unwrap_or_default();
        let bare = operator.rsplit(':').next().unwrap_or_default();
        match (self.role, bare.to_lowercase().as_str(), self.elements) {
            (Role::Bindings, ..) => Role::Binding,
            (_, "let" | "let*" | "lambda" | "do" | "do*" | "prog" | "prog*", 1)
            | (_, "destructuring-bind" | "multiple-value-bind" | "with-slots", 1)
            | (_, "defun" | "defmacro" | "defmethod" | "def-cram-function" | "def-action", 2) => {
                Role::Bindings
            }
            (_, "dolist" | "dotimes" | "do-symbols" | "with-open-file", 1) => Role::Binding,
            _ => Role::None,
        }
    }
}

fn atom<'t>(scopes: &mut [Scope<'t>], part: &'t str) {
    let Some(own) = scopes.last_mut() else {
        return;
    };
    let role = own.role;
    let is_bound = match role {
        Role::Bindings => true,
        Role::Binding => own.elements == 0,
        Role::None => {
            let is_loop = own
                .operator
                .is_some_and(|name| name.eq_ignore_ascii_case("loop"));
            let begins = ["for", "as", "with"];
            is_loop
                && begins
                    .iter()
                    .any(|word| own.last.eq_ignore_ascii_case(word))
        }
    };
    if own.elements == 0 {
        own.operator = Some(part);
    }
    own.elements += 1;
    own.last = part;
    let is_name = !part.starts_with('&') && !part.starts_with(|c: char| c.is_ascii_digit());
    if !is_bound || !is_name {
        return;
    }
    // The list that binds is around the lists of its bindings.
    let is_inside = |scope: &&mut Scope<'t>| scope.role == Role::None;
    if let Some(scope) = scopes.iter_mut().rev().find(is_inside) {
        scope.names.push(part);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_bound_around_the_cursor_are_found() {
        for (text, expected) in [
            (
                "(let ((?goal 1) (b (f x)) c) (list ",
                vec!["?goal", "b", "c"],
            ),
            ("(let ((a 1)) a) (list ", vec![]),
            (
                "(defun f (x &optional (y 2)) (let* ((z ",
                vec!["x", "y", "z"],
            ),
            ("(dolist (item items) (", vec!["item"]),
            ("(loop for i from 1 with k = 2 do (", vec!["i", "k"]),
            ("(lambda (a) (let ((b 1)) b) ", vec!["a"]),
            ("(cpl:let (", vec![]),
            ("(let ((navig 1)) (list nav", vec!["navig"]),
        ] {
            assert_eq!(locals(text), expected, "{text}");
        }
    }
}
