//! What there is, and what the world looks like.

use super::answer::Answer;
use super::arguments::Arguments;
use super::run::{REAL, SIMULATED, run};
use super::world::World;
use session::Session;
use view::picture::View;
use view::watch::base64;

const FURNITURE: &str = "(format t \"Surfaces:~%~{~(~a~)~%~}~%Containers:~%~{~(~a~)~%~}\" (pw:list-surfaces) (pw:list-containers))";

/// What a function does with the world at hand, which is afterwards as it was before.
pub(super) fn aside<T>(
    world: &mut World,
    work: impl FnOnce(&mut Session) -> Result<T, String>,
) -> Result<T, String> {
    let session = world.at_hand();
    let before = session.snapshot();
    let done = work(session);
    session
        .restore(&before)
        .map_err(|error| error.to_string())?;
    done
}

/// What a form prints about the world at hand.
fn told(world: &mut World, form: &str) -> Result<Answer, String> {
    let ran = aside(world, |session| {
        run(session, "query", form, 1.0, REAL, None)
    })?;
    Ok(match ran.failure() {
        None => Answer::text(ran.printed),
        Some(why) => Answer::refused(why),
    })
}

/// The surfaces and containers of the kitchen.
pub(super) fn furniture(world: &mut World) -> Result<Answer, String> {
    told(world, FURNITURE)
}

/// The world at hand in words: the robot, the objects, what was performed, the last failure.
pub(super) fn session(world: &mut World) -> Result<String, String> {
    let ran = aside(world, |session| {
        run(
            session,
            "session",
            "(planwright:tell-session)",
            1.0,
            REAL,
            None,
        )
    })?;
    ran.failure().map_or(Ok(ran.printed), Err)
}

/// What is known about a name.
pub(super) fn describe(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let name = arguments.text("name").trim().trim_start_matches('\'');
    let is_name = |c: char| !c.is_whitespace() && !"()\"'`,;|\\#".contains(c);
    if name.is_empty() || !name.chars().all(is_name) {
        return Err(format!(
            "{name:?} is no name: one word was expected, such as transporting"
        ));
    }
    told(
        world,
        &format!("(in-package :pp-tut) (planwright:describe-topic '{name})"),
    )
}

/// The values of a form.
pub(super) fn query(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let form = arguments.text("form");
    let ran = aside(world, |session| {
        run(session, "form", form, SIMULATED, REAL, None)
    })?;
    Ok(match (&ran.values, ran.failure()) {
        (Ok(values), _) => Answer::text(format!("{}{values}", ran.printed)),
        (Err(_), why) => Answer::refused(why.unwrap_or_default()),
    })
}

/// A picture of the world at hand.
pub(super) fn look(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let picture = picture(world.at_hand(), arguments.text("view"))?;
    let text = match picture {
        None => Some("No picture was wanted.".to_owned()),
        Some(_) => None,
    };
    Ok(Answer {
        text,
        picture,
        data: None,
        is_error: false,
    })
}

/// A picture as PNG in base64; none if none is wanted.
pub(super) fn picture(session: &mut Session, view: &str) -> Result<Option<String>, String> {
    let view = match view {
        "none" => return Ok(None),
        "" => "kitchen",
        view => view,
    };
    let view = View::NAMED.into_iter().find(|known| known.name() == view);
    let view = view.ok_or("there is no such view")?;
    let image = session.picture(&view, [640, 480]);
    let image = image.map_err(|error| error.to_string())?;
    let png = image.to_png().map_err(|error| error.to_string())?;
    Ok(Some(base64(&png)))
}
