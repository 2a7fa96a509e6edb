//! Tests of a goal from its sender's side, without a network.

use super::*;

const PATIENCE: Patience = Patience {
    server: Duration::from_secs(10),
    queue: Duration::from_secs(90),
    result: Duration::from_secs(60),
};

fn ms(number: u64) -> Duration {
    Duration::from_millis(number)
}

fn nothing() -> Value {
    Value::record([])
}

/// A goal that was sent at 0 and accepted at 10 ms.
fn accepted() -> ClientGoal {
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    goal.server(true, ms(0));
    assert_eq!(goal.next(ms(0)), [Ask::Goal]);
    goal.answered(true, ms(10));
    assert_eq!(goal.next(ms(11)), [Ask::Result]);
    goal
}

#[test]
fn a_goal_is_sent_once_there_is_a_server_and_ends_with_its_result() {
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    assert_eq!(goal.next(ms(9_000)), []);
    goal.server(true, ms(9_500));
    assert_eq!(goal.next(ms(9_500)), [Ask::Goal]);
    assert_eq!(goal.next(ms(9_600)), []);
    goal.answered(true, ms(9_700));
    assert_eq!(goal.next(ms(9_700)), [Ask::Result]);
    assert_eq!(goal.next(ms(40_000)), []);
    goal.result(4, nothing(), ms(40_000));
    assert_eq!(goal.end(), Some(&ClientEnd::Succeeded(nothing())));
    assert_eq!(goal.oddities(), 0);
}

#[test]
fn without_a_server_nothing_is_sent() {
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    assert_eq!(goal.next(ms(10_000)), []);
    let waited = ms(10_000);
    assert_eq!(goal.end(), Some(&ClientEnd::Unserved { waited }));
    // One that comes then gets nothing.
    goal.server(true, ms(10_001));
    assert_eq!(goal.next(ms(10_001)), []);
}

#[test]
fn what_is_not_accepted_in_time_is_cancelled_also_when_it_is_accepted_later() {
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    goal.server(true, ms(0));
    goal.next(ms(0));
    assert_eq!(goal.next(ms(5_000)), [Ask::Cancel]);
    assert!(matches!(goal.end(), Some(ClientEnd::NoAnswer { .. })));
    assert_eq!(goal.next(ms(6_000)), []);
    goal.answered(true, ms(20_000));
    assert_eq!(goal.next(ms(20_001)), [Ask::Cancel]);
    assert_eq!(goal.next(ms(20_600)), [Ask::Cancel]);
    assert_eq!(goal.next(ms(23_000)), []);
    assert!(matches!(goal.end(), Some(ClientEnd::NoAnswer { .. })));
}

#[test]
fn answers_before_they_were_asked_for_and_doubled_ones_count_for_nothing() {
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    goal.result(4, nothing(), ms(0));
    goal.answered(true, ms(0));
    // What is told of how far it is may come before its acceptance: another topic carries it.
    goal.feedback(ms(0));
    goal.server(true, ms(0));
    goal.next(ms(0));
    // It is not accepted yet.
    goal.result(4, nothing(), ms(1));
    assert_eq!((goal.end(), goal.oddities()), (None, 3));
    goal.answered(true, ms(2));
    goal.answered(false, ms(3));
    goal.answered(true, ms(3));
    assert_eq!((goal.end(), goal.oddities()), (None, 5));
    // A result that is none.
    goal.result(2, nothing(), ms(4));
    goal.result(99, nothing(), ms(4));
    assert_eq!(goal.end(), None);
    goal.result(6, nothing(), ms(5));
    goal.result(4, nothing(), ms(6));
    assert_eq!(goal.end(), Some(&ClientEnd::Aborted(nothing())));
    assert_eq!(goal.oddities(), 7);
}

#[test]
fn without_a_result_in_time_a_goal_is_cancelled_and_ends_within_two_seconds() {
    for ends in [true, false] {
        let mut goal = accepted();
        assert_eq!(goal.next(ms(60_009)), []);
        assert!(goal.next(ms(60_010)).contains(&Ask::Cancel));
        if ends {
            goal.result(5, nothing(), ms(60_900));
        }
        let _asked = goal.next(ms(62_010));
        let has_ended = ends;
        let waited = PATIENCE.result;
        assert_eq!(goal.end(), Some(&ClientEnd::TimedOut { waited, has_ended }));
    }
    // One that is reached while it is cancelled is reached.
    let mut goal = accepted();
    goal.next(ms(60_010));
    goal.result(4, nothing(), ms(60_020));
    assert_eq!(goal.end(), Some(&ClientEnd::Succeeded(nothing())));
}

#[test]
fn the_time_for_a_goal_begins_with_its_turn() {
    let mut goal = accepted();
    goal.status(1, ms(20));
    assert_eq!(goal.next(ms(80_000)), []);
    goal.status(2, ms(80_000));
    // What is told once more changes nothing.
    goal.status(2, ms(100_000));
    assert_eq!(goal.next(ms(139_999)), []);
    assert!(goal.next(ms(140_000)).contains(&Ask::Cancel));
    // One whose turn never comes is given up, too.
    let mut goal = accepted();
    goal.status(1, ms(20));
    assert!(goal.next(ms(90_020)).contains(&Ask::Cancel));
    goal.result(5, nothing(), ms(90_030));
    let (waited, has_ended) = (ms(90_000), true);
    assert_eq!(goal.end(), Some(&ClientEnd::NotBegun { waited, has_ended }));
}

#[test]
fn who_cancels_is_told_apart() {
    let mut goal = accepted();
    goal.result(5, nothing(), ms(100));
    assert_eq!(goal.end(), Some(&ClientEnd::Canceled { by_us: false }));
    let mut goal = accepted();
    goal.cancel(ms(100));
    assert!(goal.next(ms(100)).contains(&Ask::Cancel));
    goal.result(5, nothing(), ms(200));
    assert_eq!(goal.end(), Some(&ClientEnd::Canceled { by_us: true }));
    // One that is not sent yet is never sent.
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    goal.cancel(ms(1));
    goal.server(true, ms(2));
    assert_eq!(goal.next(ms(2)), []);
    assert_eq!(goal.end(), Some(&ClientEnd::Canceled { by_us: true }));
}

#[test]
fn a_goal_that_does_not_end_is_asked_to_again_and_then_told_of() {
    let mut goal = accepted();
    goal.cancel(ms(100));
    let asked = (1..40).map(|i| goal.next(ms(100 + 60 * i)));
    let asked: Vec<Ask> = asked.flatten().collect();
    assert_eq!(goal.end(), Some(&ClientEnd::NotEnding));
    let cancels = asked.iter().filter(|ask| **ask == Ask::Cancel).count();
    assert!((4..=6).contains(&cancels), "{asked:?}");
}

#[test]
fn a_goal_that_is_cancelled_before_its_acceptance_is_cancelled_after_it() {
    let mut goal = ClientGoal::new(PATIENCE, ms(0));
    goal.server(true, ms(0));
    goal.next(ms(0));
    goal.cancel(ms(1));
    assert_eq!(goal.next(ms(1)), [Ask::Cancel]);
    goal.answered(true, ms(3));
    assert_eq!(goal.next(ms(4)), [Ask::Result, Ask::Cancel]);
}

#[test]
fn a_server_that_was_out_of_sight_is_told_to_let_the_goal_end() {
    let mut goal = accepted();
    goal.server(false, ms(1000));
    assert_eq!(goal.next(ms(1000)), []);
    goal.server(true, ms(3000));
    assert_eq!(goal.next(ms(3000)), [Ask::Cancel]);
    goal.server(true, ms(3400));
    assert_eq!(goal.next(ms(3400)), []);
    assert_eq!(goal.next(ms(3500)), [Ask::Cancel]);
    assert_eq!(goal.next(ms(9000)), []);
    assert_eq!(goal.end(), Some(&ClientEnd::Gone));
}

#[test]
fn a_server_is_gone_if_it_is_not_there_or_falls_silent() {
    let mut goal = accepted();
    goal.server(false, ms(100));
    assert_eq!(goal.end(), Some(&ClientEnd::Gone));
    // When it returns, the goal is not sent again, but is to end.
    goal.server(true, ms(200));
    assert_eq!(goal.next(ms(200)), [Ask::Cancel]);

    let mut goal = accepted();
    for i in 1..=10 {
        goal.feedback(ms(100 * i));
    }
    assert_eq!(goal.next(ms(2_900)), []);
    assert_eq!(goal.next(ms(3_000)), [Ask::Cancel]);
    assert_eq!(goal.end(), Some(&ClientEnd::Gone));
    // Who has told nothing so far may go on so.
    let mut goal = accepted();
    goal.feedback(ms(100));
    assert_eq!(goal.next(ms(30_000)), []);
    assert_eq!(goal.end(), None);
}

#[test]
fn a_server_that_does_not_know_the_goal_has_forgotten_it() {
    let mut goal = accepted();
    goal.result(0, nothing(), ms(100));
    assert_eq!(goal.end(), Some(&ClientEnd::Forgotten));
}

#[test]
fn a_result_that_is_lost_is_asked_for_again_once_the_server_says_that_the_goal_has_ended() {
    let mut goal = accepted();
    goal.status(GoalState::Executing as i64, ms(20));
    assert_eq!(goal.next(ms(3_000)), []);
    goal.status(GoalState::Succeeded as i64, ms(3_100));
    assert_eq!(goal.next(ms(3_100)), [Ask::Result]);
    assert_eq!(goal.next(ms(3_200)), []);
    assert_eq!(goal.next(ms(3_700)), [Ask::Result]);
    goal.result(GoalState::Succeeded as i64, nothing(), ms(3_800));
    assert_eq!(goal.end(), Some(&ClientEnd::Succeeded(nothing())));
}

#[test]
fn a_goal_that_reports_how_far_it_is_waits_for_its_turn_no_longer() {
    let mut goal = accepted();
    goal.status(GoalState::Accepted as i64, ms(20));
    goal.feedback(ms(30_000));
    // A minute from then on.
    assert_eq!(goal.next(ms(89_000)), []);
    assert_eq!(goal.next(ms(90_100)), [Ask::Result, Ask::Cancel]);
}
