//! What a tool answers.

use serde_json::{Value, json};

/// What a tool answers: a text, perhaps a picture, and the same as data.
pub(crate) struct Answer {
    pub(super) text: Option<String>,
    /// A picture as PNG in base64.
    pub(super) picture: Option<String>,
    pub(super) data: Option<Value>,
    pub(super) is_error: bool,
}

impl Answer {
    pub(super) fn text(text: impl Into<String>) -> Answer {
        Answer {
            text: Some(text.into()),
            picture: None,
            data: None,
            is_error: false,
        }
    }

    /// Why the tool was not used.
    pub(crate) fn refused(why: impl Into<String>) -> Answer {
        Answer {
            is_error: true,
            ..Answer::text(why)
        }
    }

    pub(super) fn of(result: Result<Answer, String>) -> Answer {
        result.unwrap_or_else(Answer::refused)
    }

    /// The answer as clients of the Model Context Protocol get it.
    pub(crate) fn content(self) -> Value {
        let text = self.text.map(|text| json!({"type": "text", "text": text}));
        let picture = self
            .picture
            .map(|data| json!({"type": "image", "data": data, "mimeType": "image/png"}));
        let content: Vec<Value> = text.into_iter().chain(picture).collect();
        let mut json = json!({"content": content, "isError": self.is_error});
        if let Some(data) = self.data {
            json["structuredContent"] = data;
        }
        json
    }

    /// The answer as a plain object, with the fields that it has.
    pub(super) fn plain(self) -> Value {
        let mut json = json!({"is_error": self.is_error});
        let parts = [
            ("text", self.text.map(Value::from)),
            ("data", self.data),
            ("picture", self.picture.map(Value::from)),
        ];
        for (name, part) in parts {
            if let Some(part) = part {
                json[name] = part;
            }
        }
        json
    }
}
