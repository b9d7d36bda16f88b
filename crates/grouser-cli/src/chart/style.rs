//! What all drawings have in common: colours, fonts, sizes, and how the plotting library's SVG is finished.

use std::fmt::Write as _;

use grouser::document::escape;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::theme::Theme;

/// Colours that stay apart for colour-blind eyes and in grey: Okabe and Ito (2008), darkest first.
pub(super) const COLOURS: [&str; 7] =
    ["#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];

/// Text and the first series.
pub(super) const INK: &str = "#000000";
/// Axes, leaders, the line at zero.
pub(super) const MUTED: &str = "#767676";
/// What is left over, and what has no value.
pub(super) const REST: &str = "#bbbbbb";
const GRID: &str = "#e4e4e4";
const PAPER: &str = "#ffffff";

/// What each colour becomes on a dark screen: text and lines light, blue and green lighter.
const DARK: [(&str, &str); 8] = [
    (INK, "#ececec"),
    (PAPER, "#14181d"),
    (MUTED, "#9a9a9a"),
    (REST, "#5a5a5a"),
    (GRID, "#333a42"),
    ("#0072B2", "#4aa3dc"),
    ("#D55E00", "#f0803c"),
    ("#009E73", "#2fc79b"),
];

/// Height of letters [px].
pub(super) const LETTERS: u32 = 12;

pub(super) const FONTS: &str = "Helvetica, Arial, sans-serif";

/// The layout of a drawing as wide as a page.
pub(super) fn layout_of(plots: &[Plot], [title, x_label, y_label]: [&str; 3]) -> Layout {
    Layout::auto_from_plots(plots)
        .with_theme(theme())
        .with_title(label(title))
        .with_x_label(label(x_label))
        .with_y_label(label(y_label))
        .with_width(760.0)
        .with_height(430.0)
        .with_title_size(15)
        .with_label_size(13)
        .with_tick_size(LETTERS)
        .with_body_size(LETTERS)
        .with_font_family(FONTS)
}

pub(super) fn theme() -> Theme {
    Theme {
        background: PAPER.into(),
        axis_color: MUTED.into(),
        grid_color: GRID.into(),
        tick_color: MUTED.into(),
        text_color: INK.into(),
        legend_bg: PAPER.into(),
        legend_border: PAPER.into(),
        colorbar_border: MUTED.into(),
        ..Theme::light()
    }
}

/// A text of a drawing on one line, its hidden characters written out. The library escapes what means
/// something in XML, and would take what stands between two dollar signs for mathematics.
pub(super) fn label(text: &str) -> String {
    escape::line(text).replace('$', "\\$")
}

/// A drawing that a page may make larger or smaller, with a title for those who hear it, and with its colours on a
/// dark screen: the library writes a size without a view box, and colours for one kind of screen.
pub(super) fn finished(svg: String, title: &str) -> String {
    let size = |name: &str| {
        let rest = svg.split_once(&format!(" {name}=\""))?.1;
        rest.split_once('"').map(|(number, _)| number.to_owned())
    };
    let (Some(width), Some(height)) = (size("width"), size("height")) else {
        return svg;
    };
    let title = grouser_page::markup(&escape::line(title));
    let svg = svg.replacen(
        "<svg ",
        &format!("<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\" "),
        1,
    );
    svg.replacen('>', &format!(">\n<title>{title}</title><style>{}</style>", dark()), 1)
}

/// Rules that give each colour its counterpart on a dark screen.
fn dark() -> String {
    let mut rules = String::from("@media screen and (prefers-color-scheme:dark){");
    for (light, dark) in DARK {
        for name in ["fill", "stroke"] {
            // Writing to a string does not fail.
            let _ = write!(rules, "svg [{name}=\"{light}\" i]{{{name}:{dark}}}");
        }
    }
    let _ = write!(rules, "svg[fill=\"{INK}\"]{{fill:{}}}}}", DARK[0].1);
    rules
}
