"""The style of figures."""

import pytest

import grouser as gr

mpl = pytest.importorskip("matplotlib")
mpl.use("Agg")
plt = pytest.importorskip("matplotlib.pyplot")


def test_light_and_dark_have_the_same_settings_in_other_colours():
    light, dark = gr.style.rc_params(), gr.style.rc_params(dark=True)
    assert light.keys() == dark.keys()
    assert light["figure.facecolor"] != dark["figure.facecolor"]
    assert light["text.color"] != dark["text.color"]


def test_a_context_leaves_no_trace():
    before = dict(mpl.rcParams)
    with gr.style.context(dark=True):
        assert mpl.rcParams["figure.facecolor"] == gr.style.colours(dark=True)["paper"][0]
    assert dict(mpl.rcParams) == before


def test_every_setting_is_one_of_matplotlib():
    assert set(gr.style.rc_params()) <= set(mpl.rcParams)


@pytest.mark.parametrize("ends", [[1.0, 1.0, 1.0], [0.0, 0.01, 1.0], [5.0]])
def test_names_of_curves_never_overlap_and_keep_the_order(ends):
    with gr.style.context():
        figure, axes = plt.subplots()
        for place, end in enumerate(ends):
            axes.plot([0.0, 1.0], [0.0, end], label=f"curve {place}")
        gr.style.name_curves(axes)
        figure.canvas.draw()
    boxes = [text.get_window_extent() for text in axes.texts]
    by_end = sorted(range(len(ends)), key=lambda place: -ends[place])
    assert [text.get_text() for text in axes.texts] == [f"curve {place}" for place in by_end]
    for above, below in zip(boxes, boxes[1:], strict=False):
        assert below.y1 <= above.y0 + 1.0
    plt.close(figure)


def test_names_stand_beside_the_ends_of_their_curves():
    figure, axes = plt.subplots()
    ends = [1.0, 5.0, 9.0]
    for end in ends:
        axes.plot([0.0, 1.0], [0.0, end], label=str(end))
    gr.style.name_curves(axes)
    figure.canvas.draw()
    for text, end in zip(axes.texts, reversed(ends), strict=True):
        box = text.get_window_extent()
        height = axes.transData.transform((1.0, end))[1]
        assert box.y0 < height < box.y1, text
    plt.close(figure)


def test_plots_of_results_are_dark_where_the_style_in_use_is():
    with mpl.rc_context():
        gr.style.use(dark=True)
        axes = gr.heading(slope_deg=[5, 10]).plot()
        paper, ink = (gr.style.colours(dark=True)[name][0] for name in ("paper", "ink"))
        same = mpl.colors.same_color
        assert same(axes.get_facecolor(), paper) and same(axes.figure.get_facecolor(), paper)
        assert same(axes.xaxis.label.get_color(), ink)
        plt.close(axes.figure)


def test_curves_without_a_name_or_a_point_get_none():
    figure, axes = plt.subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0])
    axes.plot([], [], label="nothing")
    axes.plot([0.0, float("nan")], [0.0, 1.0], label="half")
    gr.style.name_curves(axes)
    assert [text.get_text() for text in axes.texts] == ["half"]
    plt.close(figure)
