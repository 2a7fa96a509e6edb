//! What a kernel says about itself.

use serde_json::{Value, json};

use super::message::PROTOCOL;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The answer to a `kernel_info_request`.
pub(crate) fn kernel_info() -> Value {
    json!({
        "status": "ok",
        "protocol_version": PROTOCOL,
        "implementation": "planwright",
        "implementation_version": VERSION,
        "banner": format!(
            "planwright {VERSION}: a simulated robot in its kitchen, programmed in plans.\n\
             (help) lists what you can do."
        ),
        "language_info": {
            "name": "plan",
            "version": VERSION,
            "mimetype": "text/x-common-lisp",
            "file_extension": ".plan",
            "pygments_lexer": "common-lisp",
            // A name that every version of CodeMirror knows.
            "codemirror_mode": "text/x-common-lisp",
        },
        "help_links": [],
        "debugger": false,
        "supported_features": [],
    })
}
