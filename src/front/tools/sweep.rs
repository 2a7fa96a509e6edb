//! Plans in many worlds: how often one works, and which of two works more often.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::answer::Answer;
use super::arguments::Arguments;
use super::run_plan::limits;
use super::world::World;
use session::Session;
use session::sweeping::{Known, SweepFile, Worlds, mistake};
use sweep::Record;
use sweep::paired::Comparison;
use sweep::summary::{Summary, Title};

/// Maximum number of worlds of which is told what each plan did.
const MAX_TOLD: usize = 20;

/// A plan with its sweep.
struct Plan {
    file: SweepFile,
    known: Known,
}

/// What is to be run.
struct Wanted {
    seed: u64,
    count: u64,
    real: f64,
}

impl Wanted {
    fn of(arguments: &Arguments) -> Wanted {
        let (_, real) = limits(arguments);
        Wanted {
            seed: arguments.integer("seed").unwrap_or(0),
            count: arguments.integer("worlds").unwrap_or(20),
            real,
        }
    }

    /// What to say of worlds that there was no time for.
    fn lacking(&self, done: usize) -> String {
        match (done as u64) < self.count {
            true => format!(
                "\nOnly {done} of {} worlds were run within {} s: more real_seconds, or fewer worlds.\n",
                self.count, self.real
            ),
            false => String::new(),
        }
    }
}

/// The plan with a sweep that an argument is.
fn plan(world: &World, name: &str, text: &str, wanted: &Wanted) -> Result<Plan, String> {
    let file = SweepFile {
        name: name.to_owned(),
        text: text.to_owned(),
    };
    let mut session = world.fresh()?;
    session.set_time_limit(Some(Duration::from_secs_f64(wanted.real)));
    let known = file.find(&mut session, None)?;
    Ok(Plan { file, known })
}

/// Makes sessions in which a plan has been loaded.
fn loading(world: &World, file: &SweepFile) -> impl Fn() -> Result<Session, String> + use<> {
    let (make, file) = (world.maker(), file.clone());
    move || {
        let mut session = make()?;
        match file.load(&mut session) {
            Some(abort) => Err(abort.report),
            None => Ok(session),
        }
    }
}

/// The records of plans in the same worlds, one after the other, as many as there is time for.
fn records<const N: usize>(
    world: &World,
    plans: [&Plan; N],
    wanted: &Wanted,
) -> Result<[Vec<Record>; N], String> {
    let limit = Duration::from_secs_f64(wanted.real);
    let begun = Instant::now();
    let mut runners = plans.map(|plan| {
        let make = loading(world, &plan.file);
        Worlds::new(&plan.known.name, wanted.seed, Some(limit), make)
    });
    let mut records = plans.map(|_| Vec::new());
    for number in 0..wanted.count {
        // One world is run in any case.
        if number > 0 && begun.elapsed() > limit {
            break;
        }
        for (runner, records) in runners.iter_mut().zip(&mut records) {
            records.push(runner.run(number, &[]).0);
        }
    }
    match records.iter().find_map(|records| mistake(records)) {
        Some(mistake) => Err(mistake),
        None => Ok(records),
    }
}

fn title(plan: Plan, seed: u64) -> Title {
    Title {
        name: plan.known.name,
        seed,
        goal: plan.known.goal,
    }
}

/// Runs a plan in many worlds.
pub(super) fn sweep_plan(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let wanted = Wanted::of(arguments);
    let plan = plan(world, "plan", arguments.text("plan"), &wanted)?;
    let [records] = records(world, [&plan], &wanted)?;
    let mut text = Summary::new(&title(plan, wanted.seed), &records).to_string();
    text.push_str(&wanted.lacking(records.len()));
    Ok(Answer {
        data: Some(json!({"records": records})),
        ..Answer::text(text)
    })
}

/// Runs two plans in the same worlds.
pub(super) fn compare_plans(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let wanted = Wanted::of(arguments);
    let of = |name: &str| {
        let found = plan(world, name, arguments.text(name), &wanted);
        found.map_err(|why| format!("the plan {name}: {why}"))
    };
    let plans = [of("first")?, of("second")?];
    let [a, b] = records(world, [&plans[0], &plans[1]], &wanted)?;
    let names = ["first".to_owned(), "second".to_owned()];
    let comparison = Comparison::new(names, &a, &b);
    let mut text = comparison.to_string();
    let pairs = || a.iter().zip(&b);
    let differing: Vec<&Record> = pairs()
        .filter(|(a, b)| a.draws != b.draws)
        .map(|(a, _)| a)
        .collect();
    if let Some(record) = differing.first() {
        text.push_str(&format!(
            "The worlds are not the same: the draws differ in {}, first in world {}. Give both plans the same (vary …).\n",
            differing.len(),
            record.world
        ));
    }
    let unlike: Vec<(&Record, &Record)> = pairs()
        .filter(|(a, b)| (a.outcome, &a.class) != (b.outcome, &b.class))
        .collect();
    for (a, b) in unlike.iter().take(MAX_TOLD) {
        text.push_str(&format!(
            "world {}: first {}; second {}\n",
            a.world,
            ended(a),
            ended(b)
        ));
    }
    text.push_str(&wanted.lacking(a.len()));
    let rates = [&a, &b].map(|records| rate(records));
    let unlike: Vec<Value> = unlike
        .iter()
        .map(|(a, b)| {
            json!({
                "world": a.world,
                "first": {"outcome": a.outcome, "class": a.class, "cause": a.cause},
                "second": {"outcome": b.outcome, "class": b.class, "cause": b.cause},
            })
        })
        .collect();
    Ok(Answer {
        data: Some(json!({
            "worlds": a.len(),
            "rates": {"first": rates[0], "second": rates[1]},
            "difference": {"low": comparison.difference()[0], "high": comparison.difference()[1]},
            "p": comparison.p_value(),
            "unlike": unlike,
            "have_same_draws": differing.is_empty(),
            "records": {"first": a, "second": b},
        })),
        ..Answer::text(text)
    })
}

/// How a world ended, in words.
fn ended(record: &Record) -> String {
    let class = record.class.iter().map(|class| format!(" {class}"));
    let cause = record.cause.iter().map(|cause| format!(": {cause}"));
    let more: String = class.chain(cause).collect();
    format!("{}{more}", record.outcome)
}

/// The share of successes among the worlds that say something about a plan; none without any.
fn rate(records: &[Record]) -> Option<f64> {
    let count = records.iter().filter(|r| r.outcome.counts()).count();
    let hits = records.iter().filter(|r| r.is_success()).count();
    (count > 0).then(|| hits as f64 / count as f64)
}
