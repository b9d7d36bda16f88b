//! What all drawings have in common: colours, fonts, sizes, and how the plotting library's SVG is finished.

use grouser::document::escape;
use grouser_page::Colour;
use grouser_pictures::style::{Ground, ON_BOTH_GROUNDS, Role, rules_for_dark, series};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use kuva::render::theme::Theme;

/// The colours of series, in their order.
pub(super) fn colours() -> [String; 7] {
    series(Ground::Light).map(Colour::code)
}

/// Text.
pub(super) fn ink() -> String {
    Role::Ink.on(Ground::Light).code()
}

/// Axes, leaders, the line at zero.
pub(super) fn faint() -> String {
    Role::Faint.on(Ground::Light).code()
}

/// What is left over, and what has no value.
pub(super) fn rest() -> String {
    Role::Grid.on(Ground::Light).code()
}

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
    let paper = Role::Paper.on(Ground::Light).code();
    Theme {
        background: paper.clone(),
        axis_color: faint(),
        grid_color: rest(),
        tick_color: faint(),
        text_color: ink(),
        legend_bg: paper.clone(),
        legend_border: paper,
        colorbar_border: faint(),
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
        &format!("<svg class=\"{ON_BOTH_GROUNDS}\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\" "),
        1,
    );
    svg.replacen('>', &format!(">\n<title>{title}</title><style>{}</style>", rules_for_dark()), 1)
}
