//! The requests that the session's thread answers, by name.

use super::answer::Answer;
use super::engine::Engine;
use super::hub::{Ended, Request};
use super::package_text::package_name;
use super::sexp::Sexp;
use super::version::Version;

/// A form that prints what a function makes of a symbol and a package, given as texts.
fn in_package(function: &str, texts: &[&str]) -> Option<String> {
    let [symbol, package, ..] = texts else {
        return None;
    };
    let package = Sexp::from(package_name(package));
    Some(format!("(cl:prin1 ({function} '{symbol}\n {package}))"))
}

impl Engine<'_> {
    /// Answers a request, or leaves it pending if what it evaluates stops.
    pub(super) fn dispatch(&mut self, request: &Request) {
        match request.operation.as_str() {
            "create-repl" => self.create_repl(request),
            "listener-eval" => self.listener_eval(request),
            "set-package" => self.set_package(request),
            "interactive-eval" | "interactive-eval-region" | "re-evaluate-defvar" => {
                self.evaluate_text(request, Answer::Values);
            }
            "eval-and-grab-output" => self.evaluate_text(request, Answer::OutputAndValues),
            "pprint-eval" => self.evaluate_text(request, Answer::Lines),
            "compile-file-for-emacs" => self.compile_file(request),
            "compile-string-for-emacs" => self.compile_string(request),
            "load-file" => self.load_file(request),
            "swank-macroexpand-1" | "swank-expand-1" | "swank-compiler-macroexpand-1" => {
                self.expand(request, "cl:macroexpand-1");
            }
            "swank-macroexpand" | "swank-expand" | "swank-compiler-macroexpand" => {
                self.expand(request, "cl:macroexpand");
            }
            "swank-macroexpand-all" => self.expand(request, "system::%macroexpand-all"),
            "swank-toggle-trace" | "dialog-toggle-trace" => self.toggle_trace(request),
            "undefine-function" => {
                self.with_texts(request, |texts| match texts {
                    [name, ..] => Some(format!("(cl:prin1 (cl:fmakunbound '{name}\n))")),
                    _ => None,
                });
            }
            "export-symbol-for-emacs" => self.with_texts(request, |t| in_package("cl:export", t)),
            "unexport-symbol-for-emacs" => {
                self.with_texts(request, |t| in_package("cl:unexport", t));
            }
            "unintern-symbol" => self.with_texts(request, |t| in_package("cl:unintern", t)),
            "value-for-editing" => {
                self.with_texts(request, |texts| match texts {
                    [form, ..] => Some(format!(
                        "(cl:let ((cl:*print-pretty* t) (cl:*print-length* nil) (cl:*print-level* nil))\n\
                         (cl:prin1 {form}\n))"
                    )),
                    _ => None,
                });
            }
            "commit-edited-value" => {
                self.with_texts(request, |texts| match texts {
                    [form, value, ..] => Some(format!("(cl:prin1 (cl:setf {form}\n `{value}\n))")),
                    _ => None,
                });
            }
            "untrace-all" | "dialog-untrace-all" => {
                let source = self.next_input();
                self.evaluate(request, &source, "(cl:untrace)", Answer::Nothing);
            }
            "xref" => self.xref(request),
            "xrefs" => self.xrefs(request),
            "set-default-directory" => self.set_directory(request),
            "default-directory" => self.tell_directory(request),
            "clear-repl-results" | "clear-repl-variables" | "menu-choices-for-presentation-id" => {
                request.ok(Sexp::NIL);
            }
            "packagep" | "nth-value" => request.ok(Sexp::t()),
            "invoke-nth-restart-for-emacs" => self.choose(request),
            "throw-to-toplevel" => self.leave_all(request),
            "sldb-abort" => self.abort_level(request),
            "sldb-continue" => self.go_on(request),
            "restart-frame" => self.leave_frame(request, ":restart"),
            "sldb-return-from-frame" => match request.text(1) {
                Some(form) => self.leave_frame(request, &format!(":return {form}")),
                None => request.abort("a form is needed"),
            },
            "backtrace" => self.backtrace(request),
            "frame-locals-and-catch-tags" => self.variables(request),
            "frame-source-location" => self.place_of_frame(request),
            "frame-package-name" => self.package_of_frame(request),
            "eval-string-in-frame" => self.evaluate_in_frame(request, Answer::Values),
            "pprint-eval-string-in-frame" => self.evaluate_in_frame(request, Answer::Lines),
            "inspect-in-frame" => self.evaluate_in_frame(request, Answer::Inspector),
            "inspect-frame-var" | "inspect-current-condition" => self.inspect_stop(request),
            "init-inspector" => self.init_inspector(request),
            "inspect-presentation" => self.inspect_presentation(request),
            "inspect-nth-part" => self.inspect_part(request),
            "inspector-pop" => self.inspect_again(request, -1),
            "inspector-next" => self.inspect_again(request, 1),
            "inspector-reinspect" | "inspector-toggle-verbose" => self.inspect_again(request, 0),
            "inspector-range" => self.inspect_range(request),
            "inspector-eval" => self.evaluate_on_inspected(request),
            "describe-inspectee" => self.describe_inspected(request),
            "quit-inspector" => self.quit_inspector(request),
            "start-server" => self.set_version(request),
            "quit-lisp" => {
                request.ok(Sexp::NIL);
                self.hub.end(Ended::Quit(0));
            }
            other => request.abort(&format!("planwright has no {other}")),
        }
    }

    fn evaluate_text(&mut self, request: &Request, answer: Answer) {
        match request.text(0).map(str::to_owned) {
            Some(text) => {
                let source = self.next_input();
                self.evaluate(request, &source, &text, answer);
            }
            None => request.abort("a text is needed"),
        }
    }

    /// Evaluates a form that is made of the texts that a request has; the answer is what it prints.
    fn with_texts(&mut self, request: &Request, form: impl Fn(&[&str]) -> Option<String>) {
        let texts: Vec<&str> = (0..2).map_while(|index| request.text(index)).collect();
        match form(&texts) {
            Some(form) => {
                let source = self.next_input();
                self.evaluate(request, &source, &form, Answer::Printed);
            }
            None => request.abort("texts are needed"),
        }
    }

    /// Prints the expansion of a form.
    fn expand(&mut self, request: &Request, function: &str) {
        let Some(text) = request.text(0) else {
            return request.abort("a text is needed");
        };
        // The form may end in a comment.
        let form = format!(
            "(cl:progn (cl:let ((cl:*print-pretty* t) (cl:*print-case* :downcase))\n\
             (cl:prin1 ({function} '{text}\n)))\n(cl:values))"
        );
        let source = self.next_input();
        self.evaluate(request, &source, &form, Answer::Printed);
    }

    /// `swank-toggle-trace`, and that of the trace dialog, where the name is in a form.
    fn toggle_trace(&mut self, request: &Request) {
        let in_form = || request.argument(0)?.items().get(1)?.as_str();
        let Some(name) = request.text(0).or_else(in_form) else {
            return request.abort("a name is needed");
        };
        let form = format!("(cl:princ (system::%toggle-trace '{name}\n))");
        let source = self.next_input();
        self.evaluate(request, &source, &form, Answer::Printed);
    }

    /// Sets the folder of relative names of files.
    fn set_directory(&mut self, request: &Request) {
        let folder = request.text(0).unwrap_or_default();
        match std::env::set_current_dir(folder) {
            Ok(()) => self.tell_directory(request),
            Err(error) => request.abort(&format!("{folder}: {error}")),
        }
    }

    fn tell_directory(&mut self, request: &Request) {
        match std::env::current_dir() {
            Ok(folder) => request.ok(format!("{}/", folder.display()).into()),
            Err(error) => request.abort(&error.to_string()),
        }
    }

    fn set_version(&mut self, request: &Request) {
        let mut rest = request.arguments.iter();
        let key = rest.find(|item| item.as_name() == Some(":slime-version"));
        if let Some(version) = key.and_then(|_| rest.next()?.as_str()) {
            self.hub.set_version(Version::named(version));
        }
        request.ok(Sexp::NIL);
    }
}
