//! A client and a server of an action, as two nodes of this machine.

use std::time::{Duration, Instant};

use crate::action::{ClientEnd, GoalEnd, GoalId, Patience};
use crate::wire::{ActionClient, ActionServer, Answer, Node, Wish};
use crate::{Distribution, Layouts, Reach, Value, service_type};

const GRIPPER: &str = "control_msgs/action/GripperCommand";
const PATIENCE: Patience = Patience {
    server: Duration::from_secs(10),
    queue: Duration::from_secs(5),
    result: Duration::from_secs(5),
};

fn node(name: &str, domain: u16) -> Node {
    let reach = Reach {
        domain,
        only_this_machine: true,
    };
    let layouts = Layouts::of(Distribution::DEFAULT).expect("the table is right");
    Node::open(name, reach, layouts).expect("there is a loopback")
}

/// A server that does what a function says, with its client.
struct Pair {
    client: ActionClient,
    server: Option<ActionServer>,
    robot: Node,
    _plan: Node,
    begin: Instant,
}

impl Pair {
    fn new(domain: u16) -> Self {
        let (mut robot, mut plan) = (node("robot", domain), node("plan", domain));
        let server = ActionServer::open(&mut robot, "/hand", GRIPPER).expect("it is new");
        Self {
            client: ActionClient::open(&mut plan, "/hand", GRIPPER).expect("it is new"),
            server: Some(server),
            robot,
            _plan: plan,
            begin: Instant::now(),
        }
    }

    fn send(&mut self, gap: f64) -> GoalId {
        let goal = Value::record([("command", Value::record([("position", gap.into())]))]);
        self.client.send(goal, PATIENCE, self.begin.elapsed())
    }

    /// Lets both work until the goal has ended; the server does what `deed` says of each wish.
    fn run(&mut self, id: &GoalId, mut deed: impl FnMut(&mut ActionServer, Wish)) -> ClientEnd {
        let end = Instant::now() + Duration::from_secs(20);
        while Instant::now() < end {
            if let Some(server) = &mut self.server {
                for wish in server.poll(|goal| {
                    let gap = goal.at(&["command", "position"]).and_then(Value::as_float);
                    gap.is_some_and(|gap| gap >= 0.0)
                }) {
                    deed(server, wish);
                }
            }
            self.client.poll(self.begin.elapsed());
            if let Some(end) = self.client.end(id) {
                return end.clone();
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        panic!("the goal does not end");
    }
}

fn gap(gap: f64) -> Value {
    Value::record([("position", gap.into()), ("reached_goal", true.into())])
}

fn finish(server: &mut ActionServer, wish: Wish, end: GoalEnd) {
    if let Wish::Begin(id, goal) = wish {
        server.begin(&id);
        let wanted = goal.at(&["command", "position"]).and_then(Value::as_float);
        server.end(&id, end, gap(wanted.unwrap_or_default()));
    }
}

#[test]
fn goals_are_reached_rejected_aborted_and_cancelled_over_the_network() {
    let mut pair = Pair::new(191);
    for number in 0..20 {
        let wanted = 0.001 * f64::from(number);
        let id = pair.send(wanted);
        let end = pair.run(&id, |server, wish| finish(server, wish, GoalEnd::Succeeded));
        let ClientEnd::Succeeded(result) = end else {
            panic!("{end:?}");
        };
        let there = result.get("position").and_then(Value::as_float);
        assert_eq!(there, Some(wanted));
    }
    let id = pair.send(-1.0);
    assert_eq!(pair.run(&id, |_, _| {}), ClientEnd::Rejected);
    let id = pair.send(0.01);
    let end = pair.run(&id, |server, wish| finish(server, wish, GoalEnd::Aborted));
    assert!(matches!(end, ClientEnd::Aborted(_)), "{end:?}");
    // Cancelled by this client, as soon as it is carried out.
    let id = pair.send(0.02);
    let (mut begun, mut asked) = (None, 0);
    let began = pair.begin;
    let end = {
        let Pair { client, server, .. } = &mut pair;
        let server = server.as_mut().expect("it is there");
        loop {
            for wish in server.poll(|_| true) {
                match wish {
                    Wish::Begin(id, _) => {
                        server.begin(&id);
                        begun = Some(id);
                        client.cancel(&id, began.elapsed());
                    }
                    Wish::Cancel(id) => {
                        asked += 1;
                        server.end(&id, GoalEnd::Canceled, gap(0.0));
                    }
                }
            }
            client.poll(began.elapsed());
            if let Some(end) = client.end(&id) {
                break end.clone();
            }
            assert!(began.elapsed() < Duration::from_secs(60), "it does not end");
            std::thread::sleep(Duration::from_millis(2));
        }
    };
    assert_eq!((begun, asked), (Some(id), 1));
    assert_eq!(end, ClientEnd::Canceled { by_us: true });
    assert_eq!(pair.client.oddities(), 0);
}

#[test]
fn a_server_that_dies_is_gone_and_gets_new_goals_when_it_returns() {
    let mut pair = Pair::new(192);
    let id = pair.send(0.01);
    let mut begun = false;
    let end = {
        // It dies with a goal.
        let until = Instant::now() + Duration::from_secs(20);
        loop {
            if let Some(server) = &mut pair.server {
                for wish in server.poll(|_| true) {
                    if let Wish::Begin(id, _) = wish {
                        server.begin(&id);
                        begun = true;
                    }
                }
            }
            if begun {
                pair.server = None;
            }
            pair.client.poll(pair.begin.elapsed());
            if let Some(end) = pair.client.end(&id) {
                break end.clone();
            }
            assert!(Instant::now() < until, "the goal does not end");
            std::thread::sleep(Duration::from_millis(2));
        }
    };
    assert_eq!(end, ClientEnd::Gone);
    // It returns as another process would: with nothing of what the old one has heard.
    pair.robot = node("robot", 192);
    let server = ActionServer::open(&mut pair.robot, "/hand", GRIPPER);
    pair.server = Some(server.expect("the other one is gone"));
    let again = pair.send(0.02);
    let mut begun = Vec::new();
    let end = pair.run(&again, |server, wish| {
        if let Wish::Begin(id, _) = &wish {
            begun.push(*id);
        }
        finish(server, wish, GoalEnd::Succeeded);
    });
    assert!(matches!(end, ClientEnd::Succeeded(_)), "{end:?}");
    // The old goal is not sent again.
    assert_eq!(begun, [again]);
}

#[test]
fn questions_are_answered_and_answers_for_others_are_passed_over() {
    let (mut robot, mut plan) = (node("robot", 193), node("plan", 193));
    let kind = "planwright_msgs/srv/DetectObjects";
    let [request, response] = service_type(kind);
    let (asked, answered) = (request.clone(), response.clone());
    let service = robot.service("/see", asked, answered).expect("it is new");
    let first = plan.client("/see", request.clone(), response.clone());
    let first = first.expect("it is new");
    let second = plan.client("/see", request, response).expect("it is new");
    let until = Instant::now() + Duration::from_secs(20);
    while !(first.is_served() && second.is_served()) {
        assert!(Instant::now() < until, "they do not find each other");
        std::thread::sleep(Duration::from_millis(5));
    }
    let question = |kind: &str| Value::record([("type", kind.into())]);
    let sent = [first.ask(&question("cup")), second.ask(&question("bowl"))];
    let mut heard = 0;
    while heard < 2 {
        assert!(Instant::now() < until, "the questions are not heard");
        while let Some((id, value)) = service.take() {
            let kind = value
                .get("type")
                .and_then(Value::as_text)
                .unwrap_or_default();
            let answer = Value::record([("error", kind.into())]);
            // The second answer answers nothing.
            assert!(service.reply(id, &answer) && service.reply(id, &answer));
            heard += 1;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    for (client, sent, kind) in [(first, sent[0], "cup"), (second, sent[1], "bowl")] {
        let mut answers = Vec::new();
        while answers.len() < 2 {
            assert!(Instant::now() < until, "no answer");
            answers.extend(client.take());
            std::thread::sleep(Duration::from_millis(2));
        }
        let Answer::To(sequence, value) = &answers[0] else {
            panic!("{answers:?}");
        };
        assert_eq!(Some(*sequence), sent);
        assert_eq!(value.get("error").and_then(Value::as_text), Some(kind));
        assert_eq!(answers[1], Answer::ToNobody);
    }
}
