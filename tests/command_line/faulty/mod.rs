//! Plans with one mistake each, given to the tools for assistants: each answer names place and remedy, and a client
//! that only follows suggestions mends most of them.

use serde_json::{Value, json};

use crate::json_lines::Client;

/// How often a client follows suggestions before it gives up.
const MAX_MENDS: usize = 6;

/// A plan with a mistake.
struct Faulty {
    kind: &'static str,
    /// Does following suggestions mend it?
    is_mended: bool,
    /// What an answer says.
    words: &'static str,
    text: String,
}

fn faulty_plans() -> Vec<Faulty> {
    let mut all: Vec<Faulty> = Vec::new();
    let mut is_plan = false;
    for line in include_str!("plans.txt").lines() {
        if let Some(comment) = line.strip_prefix(";; ") {
            let parts: Vec<&str> = comment.splitn(3, " | ").collect();
            is_plan = parts.len() == 3;
            if let [kind, how, words] = parts[..] {
                assert!(["mended", "told"].contains(&how), "{line}");
                let is_mended = how == "mended";
                all.push(Faulty {
                    kind,
                    is_mended,
                    words,
                    text: String::new(),
                });
            }
        } else if let Some(plan) = all.last_mut().filter(|_| is_plan) {
            plan.text.push_str(line);
            plan.text.push('\n');
        }
    }
    for plan in &mut all {
        plan.text = plan.text.trim_end().to_owned() + "\n";
    }
    all
}

/// What a client knows of a plan: the findings, and what came of a run in a copy.
struct Known {
    checked: Value,
    ran: Value,
}

impl Known {
    fn of(client: &mut Client, plan: &str) -> Known {
        let checked = client.ask("check_plan", json!({"plan": plan}));
        let ran = client.ask(
            "run_plan",
            json!({"plan": plan, "in": "copy", "view": "none", "simulated_seconds": 60, "real_seconds": 30}),
        );
        Known { checked, ran }
    }

    fn findings(&self) -> &[Value] {
        let findings = self.checked["data"]["findings"].as_array();
        findings.expect("there is a list")
    }

    fn has_run(&self) -> bool {
        self.ran["is_error"] == false
    }

    fn is_good(&self) -> bool {
        self.findings().is_empty() && self.has_run()
    }

    /// The first suggestion: of what is found without running, or else of the run.
    fn suggestion(&self) -> Option<&Value> {
        let found = self.findings().iter().map(|finding| &finding["suggestion"]);
        let mut all = found.chain([&self.ran["data"]["suggestion"]]);
        all.find(|suggestion| suggestion.is_object())
    }

    /// What is wrong with the answers, if anything is.
    fn defect(&self, plan: &Faulty) -> Option<String> {
        if self.is_good() {
            return Some("silent".to_owned());
        }
        let has_place = |data: &Value| data["line"].is_u64() && data["column"].is_u64();
        if !self.findings().iter().all(has_place) {
            return Some("a finding without a place".to_owned());
        }
        if !self.has_run() && !has_place(&self.ran["data"]) {
            return Some("a failure without a place".to_owned());
        }
        let text = format!("{}\n{}", self.checked["text"], self.ran["text"]);
        let text = text.replace("\\\"", "\"");
        (!text.contains(plan.words)).then(|| format!("nothing about {}", plan.words))
    }
}

/// A plan in which a suggestion has been followed.
fn followed(plan: &str, suggestion: &Value) -> String {
    let field = |name: &str| suggestion[name].as_str().expect("a string").to_owned();
    let number = |name: &str| suggestion[name].as_u64().expect("a number") as usize;
    let (wrong, replacement) = (field("wrong"), field("replacement"));
    let line_start: usize = plan
        .split_inclusive('\n')
        .take(number("line") - 1)
        .map(str::len)
        .sum();
    let chars = plan[line_start..].chars().take(number("column") - 1);
    let start = line_start + chars.map(char::len_utf8).sum::<usize>();
    let rest = plan[start..].strip_prefix(&wrong);
    let rest = rest.unwrap_or_else(|| panic!("{suggestion} does not fit\n{plan}"));
    format!("{}{replacement}{rest}", &plan[..start])
}

#[test]
fn a_hundred_faulty_plans_are_answered_and_most_are_mended_by_following_suggestions() {
    let mut client = Client::new(&["--heap", "256M"]);
    let spawned = client.ask(
        "run_plan",
        json!({"plan": "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'bottle-1)", "view": "none"}),
    );
    assert_eq!(spawned["is_error"], false, "{spawned}");
    let plans = faulty_plans();
    assert!(plans.len() >= 100, "{}", plans.len());
    let (mut wrong, mut mended) = (Vec::new(), 0);
    for plan in &plans {
        let mut known = Known::of(&mut client, &plan.text);
        let mut say = |what: String, known: &Known, text: &str| {
            wrong.push(format!(
                "{}: {what}\n{text}checked: {}\nran: {}\n",
                plan.kind, known.checked, known.ran
            ));
        };
        if let Some(defect) = known.defect(plan) {
            say(defect, &known, &plan.text);
        }
        let mut text = plan.text.clone();
        for _ in 0..MAX_MENDS {
            let Some(suggestion) = known.suggestion() else {
                break;
            };
            text = followed(&text, suggestion);
            known = Known::of(&mut client, &text);
            if known.is_good() {
                break;
            }
        }
        mended += usize::from(known.is_good());
        if known.is_good() != plan.is_mended {
            say(format!("mended: {}", known.is_good()), &known, &text);
        }
    }
    assert!(wrong.is_empty(), "{}\n{}", wrong.len(), wrong.join("\n"));
    assert!(mended >= 60, "{mended}");
    assert_eq!(client.end(), Some(0));
}
