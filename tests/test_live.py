"""Controls move, Python draws again, and nothing goes wrong in silence."""

import gc
import weakref

import ipywidgets
import matplotlib as mpl
import pytest
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from rlnav.widgets import Live

mpl.use("agg")


def line(gamma=0.9, slip=0.0):
    figure, ax = plt.subplots(figsize=(2, 1))
    ax.plot([0, gamma], [0, slip])
    return figure


def risky(slip=0.0):
    if slip > 0.5:
        plt.figure()
        raise ArithmeticError("too <slippery>")
    return f"slip {slip}"


@pytest.fixture(autouse=True)
def no_figure_stays_open():
    plt.close("all")  # what other tests left
    yield
    assert plt.get_fignums() == []


@pytest.fixture
def live():
    return Live(line, {"gamma": (0.5, 0.99, 0.01), "slip": [0.0, 0.1]}, alt="A line at gamma {gamma}, slip {slip}.")


def page(live):
    """What the reader of the notebook sees below the controls."""
    return live.children[-1].value


def test_a_figure_is_shown_with_its_alternative_text(live):
    assert page(live).startswith('<figure class="rl-live"')
    assert 'src="data:image/svg+xml,%3Csvg' in page(live)
    assert 'alt="A line at gamma 0.9, slip 0.0."' in page(live)


def test_moving_a_control_draws_again(live):
    before = page(live)
    live.controls["gamma"].value = 0.6
    assert page(live) != before
    assert 'alt="A line at gamma 0.6, slip 0.0."' in page(live)
    live.controls["gamma"].value = 0.9
    assert page(live) == before


def test_the_same_settings_give_the_same_bytes(live):
    twin = Live(line, {"gamma": (0.5, 0.99, 0.01), "slip": [0.0, 0.1]}, alt="A line at gamma {gamma}, slip {slip}.")
    assert page(twin) == page(live)
    assert repr(twin) == repr(live)


def test_the_text_of_a_notebook_holds_every_control_and_a_hash_of_the_figure(live):
    *settings, hash_of_figure = repr(live).splitlines()
    assert settings == [
        "Live(line)",
        "  gamma = 0.9, from 0.5 to 0.99 in steps of 0.01",
        "  slip = 0.0, one of 0.0, 0.1",
        "shows: A line at gamma 0.9, slip 0.0.",
    ]
    live.controls["slip"].value = 0.1
    assert repr(live).splitlines()[-1] != hash_of_figure


def test_a_notebook_gets_controls_and_a_page_without_python_gets_the_figure_alone(live):
    bundle = live._repr_mimebundle_()
    assert bundle["application/vnd.jupyter.widget-view+json"]["model_id"] == live.model_id
    assert bundle["text/plain"] == repr(live)
    assert "gamma 0.9, slip 0.0. Run this notebook to move the controls.</figcaption>" in bundle["text/html"]
    assert page(live).split("<img")[1].split(">")[0] in bundle["text/html"]


def test_the_short_forms_give_labeled_controls():
    def show(a=2, b=0.25, c="north", d=True, e=0.0):
        return f"{a} {b} {c} {d} {e}"

    own = ipywidgets.FloatLogSlider(1.0, description="e (log)")
    forms = {"a": (1, 5, 1), "b": (0, 1, 0.05), "c": ["north", "east"], "d": False, "e": own}
    live = Live(show, forms, alt="Five values")
    kinds = [type(control).__name__ for control in live.controls.values()]
    assert kinds == ["IntSlider", "FloatSlider", "Dropdown", "Checkbox", "FloatLogSlider"]
    assert [control.description for control in live.controls.values()] == ["a", "b", "c", "d", "e (log)"]
    assert live.controls["b"].readout_format == ".2f"
    assert "2 0.25 north True 1.0" in page(live)


def test_a_control_without_a_default_starts_at_its_first_value():
    live = Live(lambda gamma, map: f"{gamma} on {map}", {"gamma": (0.5, 0.9, 0.1), "map": ["free", "maze"]}, alt="Text")
    assert "0.5 on free" in page(live)


def test_a_value_loses_the_noise_of_a_slider_that_counts_in_steps(live):
    live.controls["gamma"].value = 0.5 + 7 * 0.01 + 1e-16
    assert live.values["gamma"] == 0.57


def test_text_is_shown_as_it_is_and_named_by_the_alternative_text():
    live = Live(lambda n: f"<b>{n}</b>", {"n": (1, 3, 1)}, alt="The number {n}")
    assert 'aria-label="The number 1"' in page(live)
    assert "&lt;b&gt;1&lt;/b&gt;" in page(live)
    assert repr(live).endswith("shows: The number 1\n<b>1</b>")


def test_a_sentence_can_stand_below_a_figure():
    live = Live(lambda gamma: (line(gamma), f"gamma < {gamma}"), {"gamma": (0.5, 0.9, 0.1)}, alt="A line")
    assert ">gamma &lt; 0.5</figcaption>" in page(live)
    assert "gamma < 0.5" in repr(live)


def test_an_axes_stands_for_its_figure():
    figure = Figure()
    live = Live(lambda n: figure.add_subplot(n), {"n": [111, 121]}, alt="Empty axes")
    assert "<img" in page(live)


def test_an_error_is_shown_beside_the_last_good_result_and_raised():
    live = Live(risky, {"slip": [0.0, 0.4, 0.8]}, alt="What happens")
    live.controls["slip"].value = 0.4
    with pytest.raises(ArithmeticError) as raised:
        live.controls["slip"].value = 0.8
    assert raised.value.__notes__ == ["The controls stood at slip 0.8."]
    assert raised.value is live.error
    assert "slip 0.4</pre>" in page(live)
    assert "<strong>ArithmeticError: too &lt;slippery&gt;</strong><br>at slip 0.8." in page(live)


def test_an_error_that_a_cell_swallows_is_still_in_its_text():
    live = Live(risky, {"slip": [0.0, 0.8]}, alt="What happens")
    with pytest.raises(ArithmeticError):
        live.controls["slip"].value = 0.8
    assert repr(live).endswith("then failed with ArithmeticError: too <slippery>")


def test_the_next_good_result_takes_an_error_away():
    live = Live(risky, {"slip": [0.0, 0.8]}, alt="What happens")
    with pytest.raises(ArithmeticError):
        live.controls["slip"].value = 0.8
    live.controls["slip"].value = 0.0
    assert live.error is None
    assert "ArithmeticError" not in page(live) + repr(live)


def test_an_error_in_the_first_call_is_an_error_of_the_cell():
    with pytest.raises(ArithmeticError):
        Live(risky, {"slip": ipywidgets.FloatSlider(0.8)}, alt="What happens")


def test_a_figure_that_was_open_before_stays_open(live):
    mine = plt.figure()
    live.controls["gamma"].value = 0.6
    assert plt.get_fignums() == [mine.number]
    plt.close(mine)


@pytest.mark.parametrize("collecting", [True, False])
def test_a_figure_is_swept_up_at_once_if_the_reader_lets_python_sweep(collecting):
    drawn = []

    def remembered(gamma=0.9):
        drawn.append(weakref.ref(line(gamma)))
        return drawn[-1]()

    live = Live(remembered, {"gamma": (0.5, 0.99, 0.01)}, alt="A line.")
    try:
        (gc.enable if collecting else gc.disable)()
        live.controls["gamma"].value = 0.6
        assert gc.isenabled() == collecting
        assert (drawn[-1]() is None) == collecting
    finally:
        gc.enable()


def test_no_figure_stays_open_when_many_are_drawn_and_the_controls_are_closed(live):
    for step in range(30):
        live.controls["gamma"].value = 0.5 + step / 100
    live.close()
    assert plt.get_fignums() == []


GAMMA = {"gamma": (0.5, 0.99, 0.01)}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3, GAMMA, "A"), "`fn` must be a function of the values of the controls; got 3."),
        ((line, {"gama": (0, 1, 1)}, "A"), "`controls` must be named as the arguments of line(gamma=0.9, slip=0.0)"),
        ((lambda gamma, slip: "", GAMMA, "A"), "(missing a required argument: 'slip')"),
        ((line, {}, "A"), "`controls` must be a dict with one entry for each argument of `fn`; got {}."),
        ((line, [1, 2], "A"), "`controls` must be a dict"),
        ((line, {"gamma": (0.9, 0.5, 0.1)}, "A"), "`controls['gamma']` must be (low, high, step)"),
        ((line, {"gamma": (0.5, 0.9)}, "A"), "got (0.5, 0.9)."),
        ((line, {"gamma": []}, "A"), "got []."),
        ((line, {"gamma": ipywidgets.Button()}, "A"), "or an ipywidgets control"),
        ((line, {"gamma": (0.5, 0.8, 0.1)}, "A"), "must be a range that holds the default of `gamma`, 0.9"),
        ((line, {"gamma": [0.5, 0.8]}, "A"), "must be options that hold the default of `gamma`, 0.9"),
        ((line, GAMMA, ""), "`alt` must be a sentence that says what the result shows"),
        ((line, GAMMA, None), "`alt` must be a sentence"),
        ((line, GAMMA, "At {gama}"), "`alt` must be a text with no names in braces but gamma; got 'At {gama}'"),
        ((line, GAMMA, "At {gamma"), "`alt` must be a text"),
        ((lambda gamma: None, GAMMA, "A"), "`fn` must be a function that returns a figure"),
    ],
)
def test_bad_input_gets_one_error_that_says_what_to_do(arguments, message):
    fn, controls, alt = arguments
    with pytest.raises((TypeError, ValueError)) as raised:
        Live(fn, controls, alt=alt)
    assert message in str(raised.value)


def test_alternative_text_cannot_be_left_out():
    with pytest.raises(ValueError, match="`alt` must be a sentence"):
        Live(line, GAMMA)
