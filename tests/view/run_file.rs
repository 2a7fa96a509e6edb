//! Runs as HTML files: all that happened is in the file, nothing in it can act, and the same run
//! writes the same bytes.

use std::path::PathBuf;

use serde_json::Value;

use session::dialogue::{Evaluate, Outcome};
use session::{Session, SessionOptions};

/// Moves, fails and retries, and prints what would end a script.
const EXERCISE: &str = "(in-package :pp-tut)
    (init-projection)
    (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
    (defvar *grasps* '(:back :left-side))
    (format t \"</script><script>alert(1)</script>~%\")
    (with-simulated-robot
      (let ((?far (make-pose \"base_footprint\" '((9 0 1) (0 0 0 1)))))
        (cpl:with-failure-handling ((common-fail:manipulation-low-level-failure (f)
                                      (declare (ignore f))
                                      (return)))
          (perform (an action (type reaching) (left-poses nil) (right-poses (?far)))))
        (perform (an action (type looking)
                     (target (a location (pose ?far)))))))";

fn file(name: &str) -> PathBuf {
    let path = crate::tests::scratch_folder().join(format!("{name}.html"));
    let _ = std::fs::remove_file(&path);
    path
}

fn evaluate(session: &mut Session, text: &str) {
    let mut told = String::new();
    let outcome = session.evaluate("test", text, &mut |event| {
        told.push_str(&format!("{event:?}"));
    });
    assert_eq!(outcome, Outcome::Finished, "{told}");
}

/// The text of a file with the exercise, and the hash of the world after it.
fn saved(name: &str) -> (String, u64) {
    let path = file(name);
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.keep_run(&path).unwrap();
    evaluate(&mut session, EXERCISE);
    session.write_kept_run().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    (text, session.simulation().world().hash())
}

fn bytes_of(base64: &Value) -> Vec<u8> {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let text = base64.as_str().unwrap().trim_end_matches('=');
    let digits = text
        .bytes()
        .map(|c| DIGITS.iter().position(|d| *d == c).unwrap());
    let mut bits = 0usize;
    let mut packed = Vec::new();
    for (i, digit) in digits.enumerate() {
        bits = (bits << 6 | digit) & 0xff_ffff;
        if i % 4 > 0 {
            packed.push((bits >> (6 - 2 * (i % 4))) as u8);
        }
    }
    miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap()
}

/// What a file contains.
struct Run {
    head: Value,
    meshes: Vec<u8>,
    frames: Vec<Value>,
}

fn run_in(text: &str) -> Run {
    let (_, rest) = text.split_once("id=\"run\">").unwrap();
    let (data, _) = rest.split_once("</script>").unwrap();
    let run: Value = serde_json::from_str(data).unwrap();
    let parsed = |packed: &Value| serde_json::from_slice::<Value>(&bytes_of(packed)).unwrap();
    let pieces = run["pieces"].as_array().unwrap().iter();
    Run {
        head: parsed(&run["head"]),
        meshes: bytes_of(&run["meshes"]),
        frames: pieces
            .flat_map(|piece| {
                let frames = parsed(&piece[1]).as_array().unwrap().clone();
                // Every piece can be shown without the one before.
                assert_eq!(frames[0]["whole"], true);
                assert!(
                    (frames[0]["t"].as_f64().unwrap() - piece[0].as_f64().unwrap()).abs() < 1e-3
                );
                frames
            })
            .collect(),
    }
}

#[test]
fn a_file_holds_the_whole_run_and_keeps_the_world_as_it_is() {
    let (text, hash) = saved("whole");
    let mut unseen = Session::new(&SessionOptions::default()).unwrap();
    evaluate(&mut unseen, EXERCISE);
    assert_eq!(unseen.simulation().world().hash(), hash);

    let run = run_in(&text);
    let nodes = run.head["nodes"].as_array().unwrap();
    let named = |name: &str| nodes.iter().find(|node| node["name"] == name).unwrap();
    assert_eq!(named("BOTTLE-1")["type"], "bottle");
    let palm = named("r_gripper_palm_link");
    let carrier = &nodes[usize::try_from(palm["parent"].as_u64().unwrap()).unwrap()];
    assert_eq!(carrier["name"], "r_wrist_roll_link");
    assert!(run.meshes.len() > 100_000);
    let times: Vec<f64> = run
        .frames
        .iter()
        .map(|f| f["t"].as_f64().unwrap())
        .collect();
    assert!(times.is_sorted() && times.len() >= 10, "{times:?}");
    let now = unseen.simulation().now();
    assert!((times[times.len() - 1] - now).abs() < 1e-3);
    let span = &run.head["span"];
    assert!((span[1].as_f64().unwrap() - now).abs() < 1e-9);
    // The head has moved to look.
    assert!(
        run.frames
            .iter()
            .skip(1)
            .any(|f| f["j"] != serde_json::json!([]))
    );
    assert_eq!(
        run.head["views"]["joints"].as_array().unwrap().len() * 2,
        run.frames[0]["j"].as_array().unwrap().len()
    );
}

#[test]
fn actions_are_told_with_parameters_place_result_and_failure() {
    let (text, _) = saved("actions");
    let run = run_in(&text);
    let news = run.head["news"].as_array().unwrap();
    let of = |name: &str, kind: char| {
        let named = news.iter().filter(|n| n["name"] == name);
        named
            .filter(|n| n["task"].as_str().is_some_and(|id| id.starts_with(kind)))
            .cloned()
            .collect::<Vec<_>>()
    };
    let reaching = of("reaching", 'a');
    let [begun, failed] = reaching.as_slice() else {
        panic!("{reaching:#?}")
    };
    assert_eq!(
        (&begun["state"], &failed["state"]),
        (&"running".into(), &"failed".into())
    );
    let keys = &begun["about"]["keys"];
    assert_eq!(keys[0], serde_json::json!(["left-poses", "NIL"]));
    assert_eq!(keys[1][0], "right-poses");
    assert_eq!(begun["about"]["place"], "test:11:11");
    assert!(
        begun["about"]["line"]
            .as_str()
            .unwrap()
            .trim()
            .starts_with("(perform (an action (type reaching)")
    );
    let why = failed["failure"].as_str().unwrap();
    assert!(why.contains("unreachable"), "{why}");

    let looking = of("looking", 'a');
    assert_eq!(looking[1]["state"], "succeeded");
    assert!(looking[1]["result"].is_string());
    // The motion belongs to the task of the action's plan, and that to the action.
    let motion = &of("looking", 'm')[0];
    let task = news.iter().find(|n| n["task"] == motion["parent"]).unwrap();
    assert_eq!(task["parent"], looking[0]["task"]);
    assert!(
        motion["about"]["place"]
            .as_str()
            .unwrap()
            .starts_with("plans/lib/")
    );
}

#[test]
fn nothing_that_was_printed_can_act_in_the_page() {
    let (text, _) = saved("harmless");
    assert_eq!(text.matches("<script").count(), 2);
    assert!(!text.contains("alert(1)"));
    let policy = "default-src 'none'; script-src 'nonce-";
    assert!(text.contains(policy) && !text.contains("connect-src"));
    assert!(!text.contains("https://") && !text.contains("http://"));
    let run = run_in(&text);
    let told = run.head["news"].as_array().unwrap().iter();
    assert!(
        told.filter_map(|n| n["text"].as_str())
            .any(|t| t.contains("alert(1)"))
    );
}

#[test]
fn the_same_run_writes_the_same_bytes() {
    assert!(saved("one").0 == saved("two").0);
}

#[test]
fn what_has_been_seen_is_saved_at_the_prompt() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let path = file("present");
    let form = format!("(save-view {:?})", path.to_str().unwrap());
    evaluate(&mut session, "(in-package :pp-tut) (init-projection)");
    evaluate(&mut session, &form);
    let run = run_in(&std::fs::read_to_string(&path).unwrap());
    assert_eq!(run.frames.len(), 1);

    session.open_view().unwrap();
    evaluate(
        &mut session,
        "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.05))))",
    );
    evaluate(&mut session, &form);
    let run = run_in(&std::fs::read_to_string(&path).unwrap());
    assert!(run.frames.len() > 5);
    let news = run.head["news"].as_array().unwrap();
    assert!(news.iter().any(|n| n["name"] == "moving-torso"));
}

#[test]
fn an_older_file_stays_until_the_new_one_is_written() {
    let path = file("older");
    let longer = "x".repeat(5_000_000);
    std::fs::write(&path, &longer).unwrap();
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.keep_run(&path).unwrap();
    assert!(std::fs::read_to_string(&path).unwrap() == longer);
    session.write_kept_run().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.ends_with("</html>\n") && text.len() < longer.len());
    assert_eq!(run_in(&text).frames.len(), 1);
}

#[test]
fn a_file_that_cannot_be_written_is_told() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let path = crate::tests::scratch_folder().join("none/run.html");
    let told = session.keep_run(&path).unwrap_err().to_string();
    assert!(
        told.starts_with("cannot write ") && told.contains("run.html"),
        "{told}"
    );
    let full = std::path::Path::new("/dev/full");
    if full.exists() {
        session.keep_run(full).unwrap();
        let told = session.write_kept_run().unwrap_err().to_string();
        assert_eq!(told, "cannot write /dev/full: the disk is full");
    }
}

#[test]
fn actions_that_fail_at_the_same_time_have_their_own_failures() {
    let path = file("both");
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.keep_run(&path).unwrap();
    evaluate(
        &mut session,
        "(in-package :pp-tut)
         (init-projection)
         (def-action going-first () \"Fails after a while.\"
           (cpl:sleep 0.3)
           (cpl:fail 'cpl:simple-plan-failure :format-control \"the first\"))
         (def-action going-second () \"Fails at the same time.\"
           (cpl:sleep 0.3)
           (cpl:fail 'cpl:simple-plan-failure :format-control \"the second\"))
         (defmacro without-failing (&body body)
           `(cpl:with-failure-handling ((cpl:simple-plan-failure (f)
                                          (declare (ignore f))
                                          (return)))
              ,@body))
         (with-simulated-robot
           (cpl:par
             (without-failing (perform (an action (type going-first))))
             (without-failing (perform (an action (type going-second))))))",
    );
    session.write_kept_run().unwrap();
    let run = run_in(&std::fs::read_to_string(&path).unwrap());
    let news = run.head["news"].as_array().unwrap();
    for (name, why) in [("going-first", "the first"), ("going-second", "the second")] {
        let end = news.iter().rfind(|n| n["name"] == name).unwrap();
        assert_eq!(end["state"], "failed", "{name}");
        assert!(end["failure"].as_str().unwrap().contains(why), "{end}");
    }
}

#[test]
fn what_carries_an_object_presses_on_it_with_its_weight() {
    let (text, _) = saved("pressing");
    let run = run_in(&text);
    let pressed = run
        .frames
        .iter()
        .filter_map(|frame| frame["touch"].as_array());
    let pressed: Vec<_> = pressed.filter(|touch| !touch.is_empty()).collect();
    // It stands still, so the forces are told once.
    let [touch] = pressed.as_slice() else {
        panic!("{pressed:?}")
    };
    let number = |press: &Value, i: usize| press[i].as_f64().unwrap();
    let nodes = run.head["nodes"].as_array().unwrap();
    let name = |press: &Value, i: usize| nodes[number(press, i) as usize]["name"].clone();
    let mut weight = 0.0;
    for press in *touch {
        assert_eq!(name(press, 0), "table_area_main");
        assert_eq!(name(press, 1), "BOTTLE-1");
        // Its bottom is on the table; lengths are in tenths of a millimetre, forces in tenths of
        // a newton.
        assert!((number(press, 4) * 1e-4 - 0.72).abs() < 0.03, "{press}");
        weight += number(press, 7) * 0.1;
    }
    assert!((weight - 0.2 * 9.81).abs() < 0.15, "{weight} N");
}
