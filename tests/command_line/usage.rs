//! The command line from outside: what goes to which stream, and the exit statuses.

use std::io::{Read, Write};
use std::process::{Command, Output, Stdio};

fn planwright(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_planwright"));
    command
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn output(arguments: &[&str]) -> (Option<i32>, String, String) {
    told(planwright(arguments).output().unwrap())
}

fn told(output: Output) -> (Option<i32>, String, String) {
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

#[test]
fn version_is_that_of_the_package() {
    let version = concat!("planwright ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!(
        output(&["--version"]),
        (Some(0), version.to_owned(), String::new())
    );
}

#[test]
fn wrong_usage_exits_with_2() {
    for arguments in [
        &["run"][..],
        &["replay"],
        &["check"],
        &["juggle"],
        &["--realtime=0"],
        &["view"],
        &["replay", "--view", "x"],
        &["completions", "abacus"],
        &["robot"],
    ] {
        let (status, out, err) = output(arguments);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(err.starts_with("error: "), "{err}");
    }
}

#[test]
#[cfg(not(feature = "ros2"))]
fn a_program_without_ros_2_says_how_to_build_one_that_has_it() {
    let wanted = "error: this planwright was built without ROS 2: build it by cargo build --release \
                  --features ros2\n";
    for arguments in [
        &["run", "--ros2", "--eval", "1"][..],
        &["run", "--real-robot", "--eval", "1"],
        &["robot", "--ros2=humble"],
    ] {
        let told = output(arguments);
        assert_eq!(
            told,
            (Some(2), String::new(), wanted.to_owned()),
            "{arguments:?}"
        );
    }
}

#[test]
#[cfg(feature = "ros2")]
fn what_ros_2_cannot_be_is_refused() {
    let (status, _, err) = output(&["robot", "--ros2=humbel"]);
    assert_eq!(status, Some(2));
    assert!(err.contains("(did you mean humble?)"), "{err}");
}

#[test]
fn a_robot_is_driven_only_where_that_has_a_meaning() {
    let plan = "plans/tutorial/move-bottle.plan";
    for (arguments, why) in [
        (
            vec!["--ros2", "run", plan, "--real-robot"],
            "what it believes itself",
        ),
        (
            vec!["--real-robot", "run", plan, "--ros2"],
            "what it believes itself",
        ),
        (vec!["--real-robot", "--resume=a", "run", plan], "--resume"),
        (vec!["--real-robot", "check", plan], "nothing else drives"),
        (vec!["--real-robot", "replay", plan], "nothing else drives"),
    ] {
        let (status, printed, error) = output(&arguments);
        assert_eq!((status, printed.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(error.contains(why), "{arguments:?}: {error}");
    }
}

#[test]
fn recordings_that_cannot_be_read_or_written_are_told() {
    let (status, _, err) = output(&["view", "Cargo.toml"]);
    assert_eq!(status, Some(2));
    assert!(
        err.starts_with("error: cannot show Cargo.toml: it is not an MCAP file"),
        "{err}"
    );
    let (status, _, err) = output(&["view", "no/such.mcap"]);
    assert_eq!(status, Some(2));
    assert!(
        err.starts_with("error: cannot show no/such.mcap: "),
        "{err}"
    );
    let (status, out, err) = output(&["run", "--eval", "1", "--record", "no/such.mcap"]);
    assert_eq!((status, out.as_str()), (Some(2), ""));
    assert!(
        err.starts_with("error: cannot record into no/such.mcap: "),
        "{err}"
    );
}

#[test]
fn a_recording_on_a_full_disk_says_so() {
    if !std::path::Path::new("/dev/full").exists() {
        return;
    }
    let (status, _, err) = output(&["run", "--eval", "1", "--record", "/dev/full"]);
    assert_eq!(status, Some(2));
    assert!(err.contains("/dev/full: the disk is full"), "{err}");
}

#[cfg(unix)]
/// Evaluates standard input with state in that directory.
fn piped(
    state: &std::path::Path,
    arguments: &[&str],
    input: &str,
) -> (Option<i32>, String, String) {
    let mut child = planwright(arguments)
        .stdin(Stdio::piped())
        .env("XDG_STATE_HOME", state)
        .spawn()
        .unwrap();
    // A program that has refused its arguments does not read.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    told(child.wait_with_output().unwrap())
}

#[cfg(unix)]
#[test]
fn a_recording_that_cannot_go_on_says_so() {
    let state = super::pseudo_terminal::State::new("record-limit");
    let file = state.path().join("a.mcap");
    // Files may have 300 blocks of 512 bytes.
    let limited = "trap '' XFSZ; ulimit -f 300; exec \"$0\"";
    let mut child = Command::new("sh")
        .args(["-c", limited, env!("CARGO_BIN_EXE_planwright")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let raise = "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.3))))";
    let lower = "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.1))))";
    let input = format!(
        "(in-package :pp-tut)\n(record {:?})\n{}(list :still :here)\n",
        file.to_str().unwrap(),
        format!("{raise}\n{lower}\n").repeat(6)
    );
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    let (_, out, err) = told(child.wait_with_output().unwrap());
    assert!(out.ends_with("(:STILL :HERE)\n"), "{out}");
    // It is told after an input, or at the latest at the end.
    assert!(
        format!("{out}{err}").contains("a.mcap: File too large"),
        "{out}{err}"
    );
}

#[cfg(unix)]
#[test]
fn what_is_piped_is_kept_and_resumed_if_that_is_asked_for() {
    let state = super::pseudo_terminal::State::new("piped");
    let file = state.path().join("a.journal");
    let name = file.to_str().unwrap();
    let (status, out, err) = piped(
        state.path(),
        &["--journal", name],
        "(defvar *a* 1)\n(car 5)\n(incf *a*)\n",
    );
    assert_eq!((status, err.as_str()), (Some(1), ""), "{out}");
    let (_, out, err) = piped(state.path(), &[&format!("--resume={name}")], "(list *a*)\n");
    assert_eq!(out, "(2)\n");
    assert!(err.starts_with("; Resumed 3 inputs; "), "{err}");
    let resume = format!("--resume={name}");
    let (_, _, err) = piped(state.path(), &[&resume, "--seed", "5"], "1");
    assert!(err.starts_with("; --seed is not used: "), "{err}");
    let (status, _, err) = piped(state.path(), &["--journal", name], "1");
    assert_eq!(status, Some(2));
    assert!(
        err.contains("is the journal of an earlier session"),
        "{err}"
    );
    let (status, _, err) = piped(state.path(), &["--journal", "Cargo.toml"], "1");
    assert_eq!(status, Some(2));
    assert!(err.contains("Cargo.toml is not a journal"), "{err}");
    let (_, out, err) = piped(state.path(), &["--journal", "/dev/full"], "(list 1)");
    assert_eq!(out, "(1)\n");
    assert!(err.starts_with("; Nothing typed here is kept"), "{err}");
}

#[cfg(unix)]
#[test]
fn a_session_that_would_not_be_the_same_is_resumed_only_if_that_is_asked_for() {
    let state = super::pseudo_terminal::State::new("changed");
    let name = |file: &str| state.path().join(file).to_str().unwrap().to_owned();
    let (journal, loaded, read) = (name("a.journal"), name("loaded.plan"), name("read.lisp"));
    std::fs::write(&loaded, "(defvar *a* 1)").unwrap();
    std::fs::write(&read, "1").unwrap();
    let inputs = format!(
        "(load {loaded:?})\n(with-open-file (in {read:?}) (car (list (/ 1 (read in)))))\n(print 3)\n"
    );
    piped(state.path(), &["--journal", &journal], &inputs);
    let resume = format!("--resume={journal}");
    std::fs::write(&loaded, "(defvar *a* 2)").unwrap();
    let (status, out, err) = piped(state.path(), &[&resume], "(list *a*)\n");
    assert_eq!((status, out.as_str()), (Some(2), ""), "{err}");
    let told = format!("; {loaded} has changed since input 1 loaded it.\nerror: ");
    assert!(
        err.starts_with(&told) && err.contains("--despite-changes"),
        "{err}"
    );
    let despite = "--despite-changes";
    let (status, out, err) = piped(state.path(), &[&resume, despite], "(list *a*)\n");
    assert_eq!((status, out.as_str()), (Some(0), "(2)\n"), "{err}");
    // A file that it merely reads is not kept; but an input ends otherwise.
    std::fs::write(&read, "0").unwrap();
    let (status, out, err) = piped(state.path(), &[&resume], "(list *a*)\n");
    assert_eq!((status, out.as_str()), (Some(2), ""), "{err}");
    let told = "; Input 2 has ended otherwise than in the earlier session: it aborted \
                DIVISION-BY-ZERO, not finished.";
    assert!(err.starts_with(told), "{err}");
    // It has not become the session's own end: it is told again.
    let (_, _, again) = piped(state.path(), &[&resume], "(list *a*)\n");
    assert_eq!(again, err);
}

#[cfg(unix)]
#[test]
fn an_old_journal_is_resumed_without_the_input_that_may_have_ended_the_program() {
    let state = super::pseudo_terminal::State::new("old-journal");
    let file = state.path().join("old.journal");
    let text = "planwright journal 1\nseed 0\ninput (defvar *a* 42)\ninput (error \"poison\")\n";
    std::fs::write(&file, text).unwrap();
    let resume = format!("--resume={}", file.to_str().unwrap());
    let (status, out, err) = piped(state.path(), &[&resume], "(list *a*)\n");
    assert_eq!((status, out.as_str()), (Some(0), "(42)\n"), "{err}");
    assert!(err.contains("is of an older planwright."), "{err}");
    assert!(
        err.contains("; Input 2 began, but nothing says that it ended. It is left out:\n;   (error \"poison\")\n"),
        "{err}"
    );
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
    // The copy does not ask again.
    let (_, out, err) = piped(state.path(), &["--resume"], "(list *a*)\n");
    assert_eq!(out, "(42)\n");
    assert!(!err.contains("Input 2"), "{err}");
}

#[test]
fn a_run_with_the_view_ends_when_nobody_looks() {
    let (status, out, err) = output(&["run", "--eval", "(+ 1 2)", "--view"]);
    assert_eq!((status, out.as_str()), (Some(0), "3\n"));
    assert!(
        err.starts_with("The live view is at http://127.0.0.1:"),
        "{err}"
    );
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused() {
    let state = super::pseudo_terminal::State::new("irregular");
    let name = |file: &str| state.path().join(file).to_str().unwrap().to_owned();
    let pipe = name("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    let wrong = name("wrong.plan");
    std::fs::write(&wrong, b"(list\n 1 \xff)").unwrap();
    let large = name("large.plan");
    let file = std::fs::File::create(&large).unwrap();
    file.set_len(1 << 40).unwrap();
    for (file, why) in [
        (
            pipe.as_str(),
            "it is a pipe or a device, and no regular file",
        ),
        ("/dev/zero", "it is a pipe or a device, and no regular file"),
        ("docs", "it is a folder, and no regular file"),
        (
            &large,
            "it is larger than a file of forms can be, which is 64 MB",
        ),
        (&wrong, "it is not UTF-8 at line 2, column 4: byte 0xff"),
    ] {
        for command in [
            &["run"][..],
            &["check"],
            &["replay"],
            &["sweep"],
            &["run", "--eval", "1", "--world"],
        ] {
            let (status, _, err) = output(&[command, &[file]].concat());
            assert_eq!(status, Some(2), "{command:?} {file}: {err}");
            assert!(err.contains(why), "{command:?} {file}: {err}");
        }
        let (status, _, err) = output(&["run", "--eval", &format!("(load {file:?})")]);
        assert_eq!(status, Some(1), "{file}: {err}");
        assert!(err.contains(&format!("cannot be read: {why}.")), "{err}");
    }
}

#[test]
fn a_file_that_loads_itself_is_told_at_once() {
    let state = super::pseudo_terminal::State::new("loads-itself");
    let name = |file: &str| state.path().join(file).to_str().unwrap().to_owned();
    let (one, two) = (name("one.plan"), name("two.plan"));
    std::fs::write(&one, "(print :one) (load \"two.plan\")").unwrap();
    std::fs::write(&two, "(print :two) (load \"./one.plan\")").unwrap();
    let (status, out, err) = output(&["run", "--eval", &format!("(load {one:?})")]);
    assert_eq!(status, Some(1), "{err}");
    assert_eq!(out.matches(":ONE").count(), 1, "{out}");
    let told = format!("A file loads itself: {one}, which loads {two}, which loads {one}.");
    assert!(err.contains(&told), "{err}");
    // Two that load a third are no circle.
    std::fs::write(&two, "(print :two)").unwrap();
    std::fs::write(&one, "(load \"two.plan\") (load \"two.plan\")").unwrap();
    let (status, _, err) = output(&["run", &one, &two, &one]);
    assert_eq!(status, Some(0), "{err}");
}

#[test]
fn what_a_file_says_does_not_drive_the_terminal() {
    let state = super::pseudo_terminal::State::new("driving");
    let file = state.path().join("a\x1b[2J.plan");
    let text = "(defun f () (no-\x1b]0such\x07 \u{9b}1m))\n(error \"\x1b[31m\x7f\")\n";
    std::fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let transcript = state.path().join("b.transcript");
    std::fs::write(&transcript, "CL-USER> (list \"\x1b[1m\")\n(\x1b[2m)\n").unwrap();
    let transcript = transcript.to_str().unwrap();
    let mut seen = String::new();
    for arguments in [
        &["check", file][..],
        &["run", file],
        &["run", &format!("{file}\x1b[")],
        &["replay", transcript],
        &["sweep", file],
    ] {
        let (_, out, err) = output(arguments);
        let shown = format!("{out}{err}");
        let drives = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
        assert!(!shown.contains(drives), "{arguments:?}: {shown:?}");
        assert!(shown.contains("^["), "{arguments:?}: {shown:?}");
        seen.push_str(&shown);
    }
    assert!(seen.contains("a^[[2J.plan:2:1: ^[[31m^?"), "{seen}");
    // What a plan prints itself reaches a pipe as it is.
    let (_, out, _) = output(&["run", "--eval", "(write-char (code-char 27))"]);
    assert!(out.contains('\x1b'), "{out:?}");
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    for command in ["run", "replay", "check"] {
        let (status, out, err) = output(&[command, "no/such.file"]);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{command}");
        assert!(
            err.starts_with("error: cannot read no/such.file: "),
            "{err}"
        );
    }
}

#[test]
fn completions_are_made_for_known_shells() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let (status, out, err) = output(&["completions", shell]);
        assert_eq!((status, err.as_str()), (Some(0), ""), "{shell}");
        assert!(out.contains("replay"), "{shell}");
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let mut child = planwright(&[]).stdin(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut out = child.stdout.take().unwrap();
    input.write_all(b"1\n").unwrap();
    let mut first = [0; 2];
    out.read_exact(&mut first).unwrap();
    drop(out);
    // The program may be gone before it has read everything.
    let _ = input.write_all("2\n".repeat(100).as_bytes());
    drop(input);
    let (status, _, err) = told(child.wait_with_output().unwrap());
    assert_eq!((&first, status, err.as_str()), (b"1\n", Some(0), ""));
}

#[test]
fn a_whole_run_becomes_frames_and_a_moving_picture() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("film");
    std::fs::remove_dir_all(&folder).ok();
    std::fs::create_dir_all(&folder).unwrap();
    let at = |name: &str| folder.join(name).display().to_string();
    let torso = "(pp-tut::with-simulated-robot \
                 (cram-executive:perform \
                 (desig:a motion (type moving-torso) (joint-angle 0.3))))";
    let (frames, gif, png) = (at("frames"), at("run.gif"), at("end.png"));
    let (status, _, err) = output(&[
        "picture", "--eval", torso, "--view", "follow", "--width", "64", "--height", "48",
        "--every", "0.5", "--frames", &frames, "--gif", &gif, "-o", &png,
    ]);
    assert_eq!((status, err.as_str()), (Some(0), ""));
    let read = |path: &str| std::fs::read(path).unwrap();
    let count = std::fs::read_dir(&frames).unwrap().count();
    assert!(count >= 3, "{count}");
    let frame = |number: usize| read(&format!("{frames}/frame-{number:04}.png"));
    assert!(frame(1) != frame(count));
    // The last frame is the world as it is in the end.
    assert!(frame(count) == read(&png));
    assert!(read(&gif).starts_with(b"GIF89a"));
}

#[test]
fn a_picture_that_cannot_be_is_told() {
    for (arguments, what) in [
        (&["picture"][..], "error: "),
        (&["picture", "-o", "x.png", "--width", "0"], "error: "),
        (&["picture", "-o", "x.png", "--view", "moon"], "error: "),
        (&["picture", "-o", "x.png", "--every", "0"], "error: "),
        (
            &[
                "picture",
                "-o",
                "no/such/x.png",
                "--width",
                "32",
                "--height",
                "32",
            ],
            "error: cannot write no/such/x.png: ",
        ),
        (
            &["picture", "-o", "x.png", "--from", "1,2,3", "--at", "1,2,3"],
            "error: the view is from and at the same place",
        ),
    ] {
        let (status, _, err) = output(arguments);
        assert_eq!(status, Some(2), "{arguments:?}: {err}");
        assert!(err.starts_with(what), "{err}");
    }
}

/// What the program prints for an input, with little memory.
fn with_little_memory(input: &str) -> (Option<i32>, String) {
    let mut child = planwright(&["--heap", "100M"])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(input.as_bytes()).unwrap();
    drop(stdin);
    let (status, out, err) = told(child.wait_with_output().unwrap());
    (status, out + &err)
}

#[test]
fn a_full_heap_is_a_condition_and_the_session_goes_on() {
    for endless in [
        "(let ((l nil)) (loop (push 1 l)))",
        "(let ((l nil)) (loop (push (make-array 100000) l)))",
        "(let ((s \"abcdefgh\")) (loop (setf s (concatenate 'string s s))))",
        "(let ((s (list 1 2))) (loop (setf s (append s s))))",
        "(let ((v (make-array 0 :adjustable t :fill-pointer 0))) (loop (vector-push-extend 1 v)))",
        "(let ((h (make-hash-table)) (i 0)) (loop (setf (gethash (incf i) h) i)))",
        "(with-output-to-string (s) (loop (write-string \"abcdefghijklmnopqrstuvwxyz\" s)))",
        "(let ((s \"\")) (loop (setf s (format nil \"~a~ax\" s s))))",
        "(let ((l nil)) (loop (let ((x 1)) (push (lambda () x) l))))",
        "(cpl:top-level (cpl:par-loop (x (loop for i below 1000000 collect i)) (cpl:sleep 1) x))",
        "(labels ((bomb () (cpl:par (bomb) (bomb)))) (cpl:top-level (bomb)))",
        "(make-array (expt 10 12))",
        "(make-list 33000000)",
        "(make-string 33000000)",
        "(length (reverse (make-list 3000000)))",
    ] {
        let (status, out) = with_little_memory(&format!("{endless}\n(list :alive)\n"));
        assert_eq!(status, Some(1), "{endless}: {out}");
        assert!(out.contains("HEAP-EXHAUSTED-ERROR"), "{endless}: {out}");
        assert!(out.ends_with("(:ALIVE)\n"), "{endless}: {out}");
    }
    let handled = "(handler-case (let ((l nil)) (loop (push 1 l))) (storage-condition () :full))";
    let (status, out) = with_little_memory(handled);
    assert_eq!((status, out.as_str()), (Some(0), ":FULL\n"));
}

#[test]
fn a_run_without_end_ends_when_nobody_reads_its_output() {
    let mut child = planwright(&[]).stdin(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(b"(loop (print 1))\n").unwrap();
    let mut begin = [0; 4];
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut begin).unwrap();
    assert_eq!(&begin, b"\n1 \n");
    drop(stdout);
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn a_run_without_end_is_interrupted_after_its_time() {
    let (status, out, err) = output(&[
        "run",
        "--time-limit",
        "0.5",
        "--eval",
        "(print :begun)",
        "--eval",
        "(unwind-protect (loop) (print :cleaned))",
    ]);
    assert_eq!(status, Some(1), "{err}");
    assert!(
        out.ends_with(":CLEANED \n") || out.ends_with(":CLEANED\n"),
        "{out:?}"
    );
    assert!(
        err.contains("Interrupted: the limit of real time has been reached."),
        "{err}"
    );
}
