//! The requests that need no evaluation: what is known about names answers them, on whatever
//! thread has time.

use super::autodoc;
use super::completion;
use super::definitions;
use super::documentation;
use super::hub::Request;
use super::sexp::Sexp;
use super::version::Version;
use session::dialogue::Names;

/// Whether a request is one of these.
pub(super) fn is_quick(operation: &str) -> bool {
    matches!(
        operation,
        "autodoc"
            | "operator-arglist"
            | "completions"
            | "simple-completions"
            | "fuzzy-completions"
            | "fuzzy-completion-selected"
            | "completions-for-keyword"
            | "completions-for-character"
            | "describe-symbol"
            | "describe-function"
            | "documentation-symbol"
            | "apropos-list-for-emacs"
            | "list-all-package-names"
            | "find-definitions-for-emacs"
            | "buffer-first-change"
            | "swank-require"
            | "init-presentations"
            | "list-threads"
            | "quit-thread-browser"
            | "connection-info"
    )
}

/// The value of such a request; `None` where the answer is that nothing is known.
pub(super) fn answer(names: &Names, version: &Version, request: &Request) -> Option<Sexp> {
    match request.operation.as_str() {
        "autodoc" => Some(autodoc::autodoc(names, request)),
        "operator-arglist" => autodoc::operator_arglist(names, request),
        "completions" | "simple-completions" => completion::completions(names, version, request),
        "fuzzy-completions" => completion::fuzzy_completions(names, version, request),
        "completions-for-keyword" => completion::keyword_completions(names, version, request),
        "describe-symbol" | "describe-function" => documentation::describe(names, request),
        "documentation-symbol" => documentation::documentation(names, request),
        "apropos-list-for-emacs" => documentation::apropos(names, request),
        "list-all-package-names" => Some(package_names(names, request)),
        "find-definitions-for-emacs" => definitions::find(names, request),
        "swank-require" => Some(required(request)),
        "list-threads" => Some(threads()),
        "connection-info" => Some(connection_info(version)),
        _ => None,
    }
}

/// The names of all packages, in order; with nicknames if wanted.
fn package_names(names: &Names, request: &Request) -> Sexp {
    let with_nicknames = request.argument(0).is_some_and(|wanted| !wanted.is_nil());
    let known = names.package_names.iter();
    let known = known.filter(|(name, at)| {
        let package = names.packages.get(**at);
        with_nicknames || package.is_some_and(|package| package.name == **name)
    });
    Sexp::list(known.map(|(name, _)| name.as_str().into()))
}

/// The names of the modules that the client wants, which it is told are there.
fn required(request: &Request) -> Sexp {
    let names = match request.argument(0) {
        Some(name @ Sexp::Symbol(_)) => std::slice::from_ref(name),
        Some(list) => list.items(),
        None => &[],
    };
    let names = names.iter().filter_map(Sexp::as_name);
    Sexp::list(names.map(|name| {
        let name = name.rsplit(':').next().unwrap_or(name);
        name.to_uppercase().into()
    }))
}

/// The session's thread, the only one that evaluates.
fn threads() -> Sexp {
    let columns = ["id", "name", "status"].map(|name| Sexp::Symbol(format!(":{name}")));
    let session = [Sexp::Int(1), "session".into(), "Running".into()];
    Sexp::list([Sexp::list(columns), Sexp::list(session)])
}

/// The package in which a client begins, and how prompts show it.
const PACKAGE: &str = "COMMON-LISP-USER";
const PROMPT: &str = "CL-USER";

/// What the client asks first.
fn connection_info(version: &Version) -> Sexp {
    let texts = |texts: &[&str]| Sexp::list(texts.iter().map(|text| Sexp::from(*text)));
    let coding = Sexp::properties([("coding-systems", texts(&["utf-8-unix"]))]);
    let implementation = Sexp::properties([
        ("type", "planwright".into()),
        ("name", "planwright".into()),
        ("version", env!("CARGO_PKG_VERSION").into()),
        ("program", Sexp::NIL),
    ]);
    let machine = Sexp::properties([
        ("instance", "localhost".into()),
        ("type", "".into()),
        ("version", "".into()),
    ]);
    Sexp::properties([
        ("pid", Sexp::Int(i64::from(std::process::id()))),
        ("style", Sexp::symbol(":spawn")),
        ("encoding", coding),
        ("lisp-implementation", implementation),
        ("machine", machine),
        ("features", Sexp::list([Sexp::symbol(":planwright")])),
        ("modules", Sexp::NIL),
        (
            "package",
            Sexp::properties([("name", PACKAGE.into()), ("prompt", PROMPT.into())]),
        ),
        ("version", version.to_string().into()),
    ])
}
