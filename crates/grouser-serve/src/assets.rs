//! The files of the page, as they are in `page/`.

/// A file of the page.
pub(crate) struct Asset {
    /// Its path on the server.
    pub(crate) path: &'static str,
    /// Its type.
    pub(crate) kind: &'static str,
    pub(crate) content: &'static [u8],
}

macro_rules! asset {
    ($path:literal, $kind:expr) => {
        Asset {
            path: concat!("/", $path),
            kind: $kind,
            content: include_bytes!(concat!("../page/", $path)),
        }
    };
}

/// The page itself.
pub(crate) const PAGE: Asset =
    Asset { path: "/", ..asset!("index.html", "text/html; charset=utf-8") };

/// Everything that it loads.
pub(crate) static ASSETS: [Asset; 29] = [
    asset!("page.css", "text/css; charset=utf-8"),
    asset!("main.js", SCRIPT),
    asset!("api.js", SCRIPT),
    asset!("engine.js", SCRIPT),
    asset!("session.js", SCRIPT),
    asset!("dom.js", SCRIPT),
    asset!("slider.js", SCRIPT),
    asset!("chart.js", SCRIPT),
    asset!("heading.js", SCRIPT),
    asset!("wheel.js", SCRIPT),
    asset!("dial.js", SCRIPT),
    asset!("drive.js", SCRIPT),
    asset!("hand.js", SCRIPT),
    asset!("scene.js", SCRIPT),
    asset!("three/build/three.core.js", SCRIPT),
    asset!("three/build/three.module.js", SCRIPT),
    asset!("three/examples/jsm/loaders/GLTFLoader.js", SCRIPT),
    asset!("three/examples/jsm/utils/BufferGeometryUtils.js", SCRIPT),
    asset!("three/examples/jsm/utils/SkeletonUtils.js", SCRIPT),
    asset!("three/LICENSE", "text/plain; charset=utf-8"),
    asset!("map.js", SCRIPT),
    asset!("study.js", SCRIPT),
    asset!("design.js", SCRIPT),
    asset!("campaigns.js", SCRIPT),
    asset!("fit.js", SCRIPT),
    asset!("fits.js", SCRIPT),
    asset!("trials.js", SCRIPT),
    asset!("log.js", SCRIPT),
    asset!("legs.js", SCRIPT),
];

/// The page for a browser without the token.
pub(crate) const LOCKED: &str = include_str!("../page/locked.html");

const SCRIPT: &str = "text/javascript; charset=utf-8";
