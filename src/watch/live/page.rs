//! The page, assembled from its parts.

/// Parts of the page's script, in the order of definition.
const SCRIPTS: [&str; 16] = [
    include_str!("page/algebra.js"),
    include_str!("page/program.js"),
    include_str!("page/orbit.js"),
    include_str!("page/scene.js"),
    include_str!("page/stage.js"),
    include_str!("page/tasks.js"),
    include_str!("page/log.js"),
    include_str!("page/past.js"),
    include_str!("page/state.js"),
    include_str!("page/halt.js"),
    include_str!("page/session.js"),
    include_str!("page/views.js"),
    include_str!("page/pointer.js"),
    include_str!("page/card.js"),
    include_str!("page/time.js"),
    include_str!("page/draw.js"),
];

const STYLE: &str = include_str!("page/style.css");
const FRAME: &str = include_str!("page/page.html");

/// The page; `word` is the nonce that tells the browser that style and script are the page's
/// own.
pub(crate) fn page(word: &str) -> String {
    // The nonce is inserted first, so that nothing in the parts is mistaken for its
    // placeholder.
    FRAME
        .replace("{word}", word)
        .replace("{style}", STYLE)
        .replace("{script}", &SCRIPTS.concat())
}
