"""The figures show what they are given, where it belongs, and touch nothing else."""

import os
import subprocess
import sys

import matplotlib as mpl
import nbclient
import nbformat
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_hex, to_rgba
from matplotlib.patches import Circle, Rectangle

import rlnav as rl
from rlnav.plot._backup import KINDS
from rlnav.plot._ground import ROBOT
from rlnav.plot._look import COLORS, limits, minus
from rlnav.plot._policy import needle

TASK = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
MDP = TASK.mdp()
BEST = rl.value_iteration(MDP)
EPISODE = rl.rollout(MDP, BEST.pi, rng=0)
EASY = rl.Task(rl.GridWorld.from_ascii("......\n.S..G.\n......")).mdp()
RUNS = [rl.q_learning(EASY, episodes=300, rng=seed) for seed in range(6)]
SHOWN = [s for s, pose in enumerate(TASK.poses) if (pose.x, pose.y) != TASK.world.goal]

FIGURES = {
    "world": lambda ax=None: rl.plot.world(TASK, ax),
    "values": lambda ax=None: rl.plot.values(TASK, BEST.V, ax),
    "values of one heading": lambda ax=None: rl.plot.values(TASK, BEST.V, ax, heading=90),
    "policy": lambda ax=None: rl.plot.policy(TASK, BEST.pi, ax),
    "policy of one heading": lambda ax=None: rl.plot.policy(TASK, BEST.pi, ax, heading=90, Q=BEST.Q),
    "path": lambda ax=None: rl.plot.path(TASK, EPISODE, ax, label="optimal"),
    "learning curve": lambda ax=None: rl.plot.learning_curve({"Q-learning": RUNS, "one run": RUNS[0]}, ax),
    "residuals": lambda ax=None: rl.plot.residuals(BEST, ax, bound=MDP.gamma),
    "table": lambda ax=None: rl.plot.table(TASK, BEST.Q, ax),
    **{f"backup of {kind}": lambda ax=None, kind=kind: rl.plot.backup_diagram(kind, ax) for kind in KINDS},
}
LARGEST = {"values": 90_000, "table": 70_000, "values of one heading": 70_000}  # bytes of an SVG
every_figure = pytest.mark.parametrize("draw", FIGURES.values(), ids=FIGURES)


@pytest.fixture(autouse=True)
def _no_open_figures():
    plt.close("all")
    yield
    plt.close("all")


def texts(ax):
    return [text.get_text() for text in ax.texts if text.get_text()]


def direction(vector):
    """Return the direction of a vector in degrees, 0 to 360."""
    return round(np.degrees(np.arctan2(vector[1], vector[0])), 6) % 360


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


# ---------------------------------------------------------------- every figure


@every_figure
def test_a_figure_is_drawn_on_the_axes_it_is_given_and_changes_nothing_else(draw):
    figure, (left, right) = plt.subplots(1, 2)
    settings, right_before = dict(mpl.rcParams), len(right.get_children())
    assert draw(left) is left
    assert plt.get_fignums() == [figure.number]
    assert figure.axes == [left, right]
    assert len(right.get_children()) == right_before
    assert dict(mpl.rcParams) == settings


@every_figure
def test_without_axes_a_figure_is_made_with_a_transparent_ground(draw):
    settings = dict(mpl.rcParams)
    ax = draw()
    assert plt.get_fignums() == [ax.figure.number]
    assert to_rgba(ax.figure.get_facecolor())[3] == 0
    assert dict(mpl.rcParams) == settings


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_gives_the_same_small_svg_every_time(name):
    svg = rl.plot.to_svg(FIGURES[name]().figure)
    assert svg.startswith("<svg")
    assert svg == rl.plot.to_svg(FIGURES[name]().figure)
    assert len(svg) < LARGEST.get(name, 60_000)


def test_another_process_draws_the_same_bytes():
    here = rl.plot.to_svg(FIGURES["values"]().figure)
    program = f"""if True:
        import sys, rlnav as rl
        task = rl.Task(rl.GridWorld.from_ascii({rl.maps.OBSTACLES!r}))
        ax = rl.plot.values(task, rl.value_iteration(task.mdp()).V)
        sys.stdout.write(rl.plot.to_svg(ax.figure))
    """
    environment = os.environ | {"MPLBACKEND": "Agg", "PYTHONHASHSEED": "7"}
    there = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True)
    assert there.stdout == here


def test_importing_the_plots_changes_no_setting_of_matplotlib():
    program = """if True:
        import matplotlib, rlnav
        import matplotlib.pyplot
        before = dict(matplotlib.rcParams)
        rlnav.plot.values
        assert dict(matplotlib.rcParams) == before
    """
    subprocess.run([sys.executable, "-c", program], env=os.environ | {"MPLBACKEND": "Agg"}, check=True)


def test_in_a_notebook_every_figure_is_the_svg_that_to_svg_draws():
    cells = [
        "import rlnav as rl\nrl.plot.style()",
        f"task = rl.Task(rl.GridWorld.from_ascii({rl.maps.OBSTACLES!r}))\nrl.plot.world(task);",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    inline = os.environ | {"MPLBACKEND": "module://matplotlib_inline.backend_inline"}
    nbclient.NotebookClient(notebook, kernel_name="python3", timeout=60).execute(env=inline)
    (shown,) = notebook.cells[1].outputs
    assert set(shown.data) == {"image/svg+xml", "text/plain"}
    with mpl.rc_context():
        rl.plot.style()
        assert shown.data["image/svg+xml"] == rl.plot.to_svg(rl.plot.world(TASK).figure, bbox_inches="tight")


def test_the_style_makes_own_figures_transparent_and_their_svg_repeatable():
    with mpl.rc_context():
        rl.plot.style()
        figure, _ = plt.subplots()
        assert to_rgba(figure.get_facecolor())[3] == 0
        assert mpl.rcParams["svg.hashsalt"]
        assert mpl.rcParams["axes.prop_cycle"].by_key()["color"] == list(COLORS)


# ---------------------------------------------------------------- the map


def test_the_map_has_x_to_the_right_and_y_upwards():
    ax = rl.plot.world(TASK)
    assert ax.get_xlim() == (-0.5, 9.5)
    assert ax.get_ylim() == (-0.5, 9.5)
    assert ax.get_xlabel().startswith("x")
    assert ax.get_ylabel().startswith("y")


def test_a_robot_that_starts_with_one_heading_is_an_arrowhead_there():
    ax = rl.plot.world(rl.GridWorld(4, 3, goal=(3, 2), starts=[rl.Pose(1, 2, 90)]))
    tips = [patch.get_path().vertices[0] for patch in ax.patches if len(patch.get_path()) == len(ROBOT)]
    assert any(np.allclose(tip, (1, 2.36)) for tip in tips)


def test_a_second_drawing_on_the_same_axes_draws_no_second_map():
    ax = rl.plot.values(TASK, BEST.V)
    before = len(ax.patches)
    rl.plot.policy(TASK, BEST.pi, ax, heading=0)
    floors = [patch for patch in ax.patches if isinstance(patch, Rectangle)]
    assert len(floors) == 2  # the floor and the wall around it
    assert len(ax.patches) == before + 3


# ---------------------------------------------------------------- values


def test_every_wedge_has_the_color_of_its_pose_in_the_direction_of_its_heading():
    (cells,) = rl.plot.values(TASK, BEST.V).collections
    paths, offsets = cells.get_paths(), cells.get_offsets()
    cells.update_scalarmappable()
    colors = cells.get_facecolors()
    assert len(offsets) == len(SHOWN)
    for i, s in enumerate(SHOWN):
        pose = TASK.poses[s]
        middle = paths[i % len(paths)].vertices[:-1].mean(axis=0)
        assert tuple(offsets[i]) == (pose.x, pose.y)
        assert direction(middle) == pose.theta
        assert colors[i] == pytest.approx(cells.cmap(cells.norm(BEST.V[s])))


def test_one_heading_gives_one_square_a_cell_with_its_number():
    ax = rl.plot.values(TASK, BEST.V, heading=-270)
    (cells,) = ax.collections
    of_heading = [s for s in SHOWN if TASK.poses[s].theta == 90]
    assert cells.get_array().tolist() == BEST.V[of_heading].tolist()
    assert len(texts(ax)) == len(of_heading)
    assert float(texts(ax)[0].replace("−", "-")) == pytest.approx(BEST.V[of_heading[0]], abs=0.05)


def test_a_higher_value_is_a_brighter_color():
    grey = rl.plot.SEQUENTIAL(np.linspace(0, 1, 64))[:, :3] @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(grey) > 0).all()


def test_values_far_below_the_others_are_off_the_scale_and_the_color_bar_says_so():
    ax = rl.plot.values(TASK, BEST.V)
    (cells,) = ax.collections
    doomed = BEST.V[SHOWN] < cells.norm.vmin
    assert doomed.any()
    assert (BEST.V[SHOWN][doomed] == -10).all()
    cells.update_scalarmappable()
    assert {to_hex(color) for color in cells.get_facecolors()[doomed]} == {to_hex(rl.plot.SEQUENTIAL.get_under())}
    assert cells.colorbar.extend == "min"


def test_a_scale_that_is_given_is_kept():
    (cells,) = rl.plot.values(TASK, BEST.V, vmin=-1, vmax=20).collections
    assert (cells.norm.vmin, cells.norm.vmax) == (-1, 20)


@pytest.mark.parametrize("V", [[-1.0, 3.0], [0.0, 0.0], [-5.0, -4.0]])
def test_the_middle_of_a_signed_scale_is_zero(V):
    low, high = limits(np.array(V), None, None, signed=True)
    assert low == -high < 0
    assert high >= np.abs(V).max()


def test_equal_values_have_a_scale_too():
    assert limits(np.full(4, 3.0), None, None, signed=False) == (2.5, 3.5)


# ---------------------------------------------------------------- policies


def needles(ax):
    """Return the needles of each opacity as arrays [needles, 4 points, 2]."""
    curves = [p for p in ax.patches if p.get_path().codes is not None and (p.get_path().codes[1::4] == 4).all()]
    return {patch.get_alpha(): patch.get_path().vertices.reshape(-1, 4, 2) for patch in curves}


@pytest.mark.parametrize("heading", [None, 135])
def test_needles_point_where_the_robot_drives(heading):
    ax = rl.plot.policy(TASK, BEST.pi, heading=heading)
    (drawn,) = needles(ax).values()
    shown = [s for s in SHOWN if heading in (None, TASK.poses[s].theta)]
    assert len(drawn) == len(shown)
    for s, points in zip(shown, drawn, strict=True):
        pose, a = TASK.poses[s], TASK.robot.steering[BEST.pi[s]]
        ahead = points[-1] - points[0]
        assert direction(ahead) == (pose.theta + a / 2) % 360
        assert np.abs(points - (pose.x, pose.y)).max() < 0.5
        to = TASK.robot.move(pose, a)
        way = np.array([to.x - pose.x, to.y - pose.y])
        assert ahead @ way / np.linalg.norm(ahead) / np.linalg.norm(way) > np.cos(np.radians(22.6))


@pytest.mark.parametrize("a", [-180, -90, 0, 45, 135])
def test_a_needle_begins_along_the_heading_and_ends_along_the_new_one(a):
    points = needle(90, a, 1.0).vertices
    assert direction(points[1] - points[0]) == 90
    assert direction(points[3] - points[2]) == (90 + a) % 360


def test_needles_of_a_stochastic_policy_are_as_opaque_as_their_actions_are_likely():
    drawn = needles(rl.plot.policy(TASK, rl.epsilon_greedy(BEST.Q, 0.5)))
    assert {alpha: len(group) for alpha, group in drawn.items()} == {
        0.2: 4 * len(SHOWN),  # probability 0.1 each
        0.6: len(SHOWN),  # probability 0.6
    }


def test_with_action_values_needles_are_darkest_where_steering_matters_most():
    drawn = needles(rl.plot.policy(TASK, BEST.pi, Q=BEST.Q))
    gain = (BEST.Q.max(axis=1) - BEST.Q.mean(axis=1))[SHOWN]
    assert len(drawn[1.0]) == np.sum(gain > 0.8 * gain.max())
    assert len(drawn) > 2


# ---------------------------------------------------------------- paths


def test_a_path_goes_through_the_cells_of_the_episode():
    (line,) = rl.plot.path(TASK, EPISODE).lines
    assert line.get_xydata().tolist() == [[TASK.pose(s).x, TASK.pose(s).y] for s in EPISODE.states]


def test_a_crash_is_marked_at_the_edge_of_the_last_cell():
    task = rl.Task(rl.GridWorld.from_ascii("..G\n>#."))
    episode = rl.rollout(task.mdp(), np.full(task.crashed + 1, 2), rng=0)
    ax = rl.plot.path(task, episode)
    assert ax.lines[0].get_xydata().tolist() == [[0, 0], [0.5, 0]]
    assert any(np.allclose(patch.get_path().vertices.mean(axis=0), (0.5, 0)) for patch in ax.patches)


def test_only_a_path_that_ran_out_of_time_ends_with_a_square():
    def squares(episode):
        paths = [patch.get_path().vertices for patch in rl.plot.path(TASK, episode).patches]
        return [path[:4].mean(axis=0).tolist() for path in paths if len(path) == 5 and len(set(path[:, 0])) == 2][2:]

    cut = rl.rollout(MDP, BEST.pi, max_steps=3, rng=0)
    last = TASK.pose(cut.states[-1])
    assert cut.truncated
    assert squares(cut) == [[last.x, last.y]]
    assert squares(EPISODE) == []


def test_several_paths_differ_in_color_and_dashes_and_are_named():
    ax = rl.plot.path(TASK, {"optimal": EPISODE, "again": EPISODE})
    rl.plot.path(TASK, EPISODE, ax, label="third")
    assert len({line.get_color() for line in ax.lines}) == 3
    assert len({line.get_linestyle() for line in ax.lines}) >= 2
    assert len({tuple(line.get_xydata()[0]) for line in ax.lines}) == 3  # side by side, not on top of each other
    assert legend(ax) == ["optimal", "again", "third"]


# ---------------------------------------------------------------- learning curves


def test_the_curve_is_the_mean_over_runs_of_each_moving_mean():
    ax = rl.plot.learning_curve(RUNS, window=10)
    smooth = [[run.returns[max(0, e - 10) : e].mean() for e in range(1, 301)] for run in RUNS]
    (line,) = ax.lines
    episodes = line.get_xdata()
    assert line.get_ydata() == pytest.approx(np.mean(smooth, axis=0)[episodes - 1])
    band = ax.collections[0].get_paths()[0].vertices
    low, high = np.percentile(smooth, [5, 95], axis=0)
    at_end = band[band[:, 0] == 300, 1]
    assert at_end.min() == pytest.approx(low[-1])
    assert at_end.max() == pytest.approx(high[-1])


def test_a_moving_mean_does_not_read_the_future():
    (line,) = rl.plot.learning_curve([0.0] * 50 + [1.0] * 50, window=10).lines
    assert not line.get_ydata()[line.get_xdata() <= 50].any()
    assert line.get_ydata()[line.get_xdata() == 51] == pytest.approx(0.1)


def test_a_long_curve_is_thinned_but_keeps_its_last_episode():
    (line,) = rl.plot.learning_curve(np.arange(5000.0)).lines
    assert len(line.get_xdata()) <= 300
    assert line.get_xdata()[-1] == 5000
    assert line.get_ydata()[-1] == pytest.approx(np.arange(4900, 5000).mean())


def test_the_legend_says_what_the_band_is_and_of_how_many_runs():
    ax = rl.plot.learning_curve({"Q-learning": RUNS, "Sarsa": RUNS[:4]}, band=0.5)
    assert legend(ax) == ["Q-learning (6 runs)", "Sarsa (4 runs)", "percentiles 25 to 75 of the runs"]


def test_a_single_run_has_no_band():
    ax = rl.plot.learning_curve(RUNS[0])
    assert not ax.collections
    assert ax.get_legend() is None


def test_steps_and_successes_are_taken_from_the_same_runs():
    steps = rl.plot.learning_curve(RUNS[0], what="steps", window=1).lines[0]
    success = rl.plot.learning_curve(RUNS[0], what="success", window=1).lines[0]
    assert steps.get_ydata() == pytest.approx(RUNS[0].steps[steps.get_xdata() - 1])
    assert success.get_ydata().tolist() == RUNS[0].success[success.get_xdata() - 1].tolist()
    assert 0 < success.get_ydata().mean() < 1


# ---------------------------------------------------------------- residuals


def test_residuals_are_drawn_on_a_logarithmic_axis_and_zero_is_marked_at_its_foot():
    ax = rl.plot.residuals([4.0, 1.0, 0.0])
    assert ax.get_yscale() == "log"
    assert ax.lines[0].get_xydata().tolist() == [[1, 4], [2, 1]]
    assert ax.collections[0].get_offsets().tolist() == [[3, 0]]
    assert "no change at all" in legend(ax)


def test_changes_that_are_all_zero_can_be_drawn():
    ax = rl.plot.residuals([0.0, 0.0], bound=0.9)
    ax.figure.draw_without_rendering()
    assert len(ax.collections[0].get_offsets()) == 2


def test_the_bound_shrinks_by_gamma_in_every_sweep():
    slipping = rl.value_iteration(rl.Task(TASK.world, rl.Robot(slip=0.2)).mdp())
    curve, promise = rl.plot.residuals({"slip 0.2": slipping}, bound=0.95).lines
    assert promise.get_ydata()[1:] == pytest.approx(0.95 * promise.get_ydata()[:-1])
    assert (curve.get_ydata() <= promise.get_ydata()[: len(curve.get_ydata())] + 1e-12).all()


# ---------------------------------------------------------------- tables and backup diagrams


def test_every_best_action_of_a_row_is_framed_and_bold():
    Q = np.zeros((MDP.S, MDP.A))
    Q[5] = [1, 3, 2, 3 - 1e-12, 0]
    ax = rl.plot.table(TASK, Q, rows=[5])
    framed = [round(patch.get_x() + patch.get_width() / 2) for patch in ax.patches if not patch.get_fill()]
    assert framed == [1, 3]
    assert [text.get_text() for text in ax.texts if text.get_weight() == "bold"] == ["3.00", "3.00"]


def test_rows_are_named_by_pose_or_by_what_is_perceived():
    by_pose = rl.plot.table(TASK, BEST.Q, rows=[TASK.index(rl.Pose(3, 2, 90)), TASK.crashed])
    assert [label.get_text() for label in by_pose.get_yticklabels()] == ["(3, 2)  90° ↑", "crashed"]
    assert [label.get_text() for label in by_pose.get_xticklabels()] == ["−90°", "−45°", "0°", "+45°", "+90°"]
    features = rl.Task(TASK.world, features=[rl.designs.goal_direction(), rl.designs.heading()])
    pose = rl.Pose(3, 2, 90)  # south-west of the goal, so the signs of dx and dy are both positive
    z = features.phi()[features.index(pose)]
    by_feature = rl.plot.table(features, np.zeros((features.phi().max() + 1, 5)), rows=[z, 72])
    assert [label.get_text() for label in by_feature.get_yticklabels()] == ["goal direction 8, heading 2", "ended"]


def test_a_table_shows_the_start_poses_unless_told_otherwise():
    ax = rl.plot.table(TASK, BEST.Q)
    assert [label.get_text()[:6] for label in ax.get_yticklabels()] == ["(1, 1)"] * 8


@pytest.mark.parametrize(
    ("kind", "states", "actions", "arcs"),
    [("v_pi", 7, 3, 0), ("q_pi", 3, 7, 0), ("v_star", 7, 3, 1), ("q_star", 3, 7, 3), ("sarsa", 1, 2, 0)],
)
def test_a_backup_diagram_has_open_states_filled_actions_and_an_arc_for_each_max(kind, states, actions, arcs):
    ax = rl.plot.backup_diagram(kind)
    circles = [patch for patch in ax.patches if isinstance(patch, Circle)]
    assert sum(to_hex(circle.get_facecolor()) == "#ffffff" for circle in circles) == states
    assert sum(to_hex(circle.get_facecolor()) != "#ffffff" for circle in circles) == actions
    assert sum(len(line.get_xdata()) > 2 for line in ax.lines) == arcs


def test_half_of_an_equation_is_a_diagram_of_one_level():
    half = rl.plot.backup_diagram("v_pi", numbers=(None, [(None, None), (None, None)]))
    assert "$a$" in texts(half)
    assert r"$s^\prime$" not in texts(half)
    assert r"$p,\ r$" not in texts(half)
    assert np.diff(half.get_ylim()) < np.diff(rl.plot.backup_diagram("v_pi").get_ylim())


def test_numbers_are_written_into_a_backup_diagram_and_the_best_branches_stand_out():
    tree = (3, [("left", 1, []), ("ahead", 3, [(0.5, 2), (0.5, 4)]), ("right", 3.0, [])])
    ax = rl.plot.backup_diagram("v_star", numbers=tree)
    assert {"left", "ahead", "right", "0.5", "1", "2", "4", "$v_*(s)$ = 3"} <= set(texts(ax))
    thick = [line for line in ax.lines if line.get_color() == COLORS[0]]
    assert len(thick) == 2


def test_a_number_has_a_true_minus_sign_and_zero_has_none():
    assert [minus(text) for text in ("-1.5", "-0.0", "-90°", "0.20")] == ["−1.5", "0.0", "−90°", "0.20"]


# ---------------------------------------------------------------- errors

OTHER = rl.Task(rl.GridWorld.from_ascii(">.G"))
MISTAKES = {
    "a world that is a drawing": (lambda: rl.plot.world(rl.maps.MAZE), TypeError, "`task` must be a Task or a GridWor"),
    "axes that are a figure": (lambda: rl.plot.world(TASK, plt.figure()), TypeError, "`ax` must be a Axes"),
    "values of another task": (lambda: rl.plot.values(OTHER, BEST.V), ValueError, "one value for each state"),
    "values that are no task's": (lambda: rl.plot.values(TASK.world, BEST.V), TypeError, "`task` must be a Task"),
    "values with a hole": (lambda: rl.plot.values(OTHER, [np.nan] * 25), ValueError, "`V` must be finite everywhere"),
    "a heading of 30 degrees": (lambda: rl.plot.values(TASK, BEST.V, heading=30), ValueError, "a multiple of 45"),
    "a scale upside down": (lambda: rl.plot.values(TASK, BEST.V, vmin=5, vmax=2), ValueError, "at most `vmax`"),
    "a policy of designed states": (lambda: rl.plot.policy(TASK, [0, 1]), ValueError, "lifted by `pi[phi]`"),
    "an action too many": (lambda: rl.plot.policy(TASK, np.full(MDP.S, 5)), ValueError, "5 in state 0"),
    "no distribution": (lambda: rl.plot.policy(TASK, np.ones((MDP.S, 5))), ValueError, "[1, 1, 1, 1, 1] in state 0"),
    "a ragged policy": (lambda: rl.plot.policy(TASK, [[1.0], [0.5, 0.5]]), ValueError, "rows of different lengths"),
    "action values of a table": (lambda: rl.plot.policy(TASK, BEST.pi, Q=[[1.0]]), ValueError, "action values"),
    "states for an episode": (lambda: rl.plot.path(TASK, EPISODE.states), TypeError, "`episodes` must be a Episode"),
    "another task's episode": (lambda: rl.plot.path(OTHER, EPISODE), ValueError, "Was it another task's?"),
    "no episode": (lambda: rl.plot.path(TASK, []), ValueError, "at least one Episode"),
    "one label for two": (lambda: rl.plot.path(TASK, [EPISODE] * 2, label="a"), ValueError, "its keys are the labels"),
    "no run": (lambda: rl.plot.learning_curve({}), ValueError, "at least one run"),
    "an empty run": (lambda: rl.plot.learning_curve([]), ValueError, "at least one run of one episode"),
    "what nobody recorded": (lambda: rl.plot.learning_curve(RUNS, what="loss"), ValueError, "'returns', 'steps'"),
    "a band above one": (
        lambda: rl.plot.learning_curve(RUNS, band=90),
        ValueError,
        "`band` must be a number in [0, 1]",
    ),
    "a window of nothing": (lambda: rl.plot.learning_curve(RUNS, window=0), ValueError, "`window` must be"),
    "runs and something else": (lambda: rl.plot.learning_curve([RUNS[0], 3]), TypeError, "`runs` must be a Training"),
    "negative changes": (lambda: rl.plot.residuals([1.0, -2.0]), ValueError, "-2 in sweep 2"),
    "no sweep": (lambda: rl.plot.residuals([]), ValueError, "at least one sweep"),
    "no solution": (lambda: rl.plot.residuals({}), ValueError, "at least one Solution"),
    "a bound above one": (lambda: rl.plot.residuals(BEST, bound=2), ValueError, "`bound` must be"),
    "a table of another size": (lambda: rl.plot.table(TASK, np.ones((7, 5))), ValueError, "697 rows"),
    "a row outside": (lambda: rl.plot.table(TASK, BEST.Q, rows=[MDP.S]), ValueError, "`rows` must be"),
    "no rows": (lambda: rl.plot.table(TASK, BEST.Q, rows=[]), ValueError, "at least one row"),
    "an unknown diagram": (lambda: rl.plot.backup_diagram("dqn"), ValueError, "'v_pi', 'q_pi'"),
    "numbers without a tree": (lambda: rl.plot.backup_diagram("v_pi", numbers=[1, 2, 3]), ValueError, "`numbers` must"),
    "a tree too deep": (
        lambda: rl.plot.backup_diagram("v_pi", numbers=(1, [("", 1, [("", 1, [("", 1)])])])),
        ValueError,
        "two levels deep",
    ),
    "text for a figure": (lambda: rl.plot.to_svg("figure"), TypeError, "`figure` must be a Figure"),
}


@pytest.mark.parametrize(("mistake", "kind", "words"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_explained_and_leaves_no_empty_figure(mistake, kind, words):
    with pytest.raises(kind) as error:
        mistake()
    assert words in str(error.value)
    assert len(plt.get_fignums()) <= (words == "`ax` must be a Axes")


def test_a_drive_that_slipped_is_drawn_on_the_map_of_a_robot_that_does_not():
    task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
    slippery = rl.Task(task.world, rl.Robot(slip=0.5)).mdp()
    pi = rl.solve(slippery).pi
    drives = [rl.rollout(slippery, pi, rng=seed) for seed in range(40)]
    assert any(drive.states[-1] == task.crashed for drive in drives)
    for drive in drives:
        ax = rl.plot.path(task, drive)
        plt.close(ax.figure)


def test_a_crash_that_the_task_does_not_have_is_an_error():
    task = rl.Task(rl.GridWorld.from_ascii("....\n....\n>...\n....\n...G"))
    in_the_open = task.index(rl.Pose(1, 2, 0))
    elsewhere = rl.Episode(np.array([in_the_open, task.crashed]), np.array([2]), np.array([-10.0]), True)
    with pytest.raises(ValueError, match="`episodes` must be drives in the world of the task"):
        rl.plot.path(task, elsewhere)
