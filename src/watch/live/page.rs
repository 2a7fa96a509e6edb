//! The page, put together from its parts.

/// Parts of the page's program, in the order in which they are defined.
const SCRIPTS: [&str; 15] = [
    include_str!("page/algebra.js"),
    include_str!("page/program.js"),
    include_str!("page/orbit.js"),
    include_str!("page/scene.js"),
    include_str!("page/stage.js"),
    include_str!("page/tasks.js"),
    include_str!("page/log.js"),
    include_str!("page/past.js"),
    include_str!("page/state.js"),
    include_str!("page/session.js"),
    include_str!("page/views.js"),
    include_str!("page/pointer.js"),
    include_str!("page/card.js"),
    include_str!("page/time.js"),
    include_str!("page/draw.js"),
];

const STYLE: &str = include_str!("page/style.css");
const FRAME: &str = include_str!("page/page.html");

/// The page; `word` shows the browser that style and program are its own.
pub(crate) fn page(word: &str) -> String {
    // The word goes in first, so that nothing in the parts is taken for its place.
    FRAME
        .replace("{word}", word)
        .replace("{style}", STYLE)
        .replace("{script}", &SCRIPTS.concat())
}
