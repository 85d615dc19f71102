"""The simulator shows what the library's own learner finds, and nothing else."""

import matplotlib as mpl
import pytest

import rlnav as rl

mpl.use("agg")


@pytest.fixture(scope="module")
def task():
    return rl.Task(rl.GridWorld.from_ascii(">...\n..#.\n...G"), rl.Robot(slip=0.1))


def score(task, run):
    return str(rl.evaluate(task.mdp(), run.pi[task.phi()]))


def test_a_slider_starts_a_new_run_of_q_learning_with_its_settings(task):
    simulator = rl.widgets.Simulator(task)
    for name, value in {"episodes": 400, "alpha": 0.5, "epsilon": 0.3, "seed": 7}.items():
        simulator.controls[name].value = value
    run = rl.q_learning(task.mdp(), task.phi(), episodes=400, alpha=0.5, epsilon=0.3, rng=7)
    assert f"Greedy policy: {score(task, run)}, gap " in repr(simulator)


def test_the_same_settings_show_the_same_run(task):
    one, other = rl.widgets.Simulator(task), rl.widgets.Simulator(task)
    other.controls["seed"].value = 3
    assert repr(one) != repr(other)
    other.controls["seed"].value = 0
    assert repr(one) == repr(other)


def test_a_training_is_replayed_table_by_table(task):
    run = rl.q_learning(task.mdp(), task.phi(), episodes=900, rng=0, snapshots=3)
    simulator = rl.widgets.Simulator(task, run)
    assert list(simulator.controls) == ["episodes"]
    assert simulator.controls["episodes"].options == (300, 600, 900)
    simulator.controls["episodes"].value = 900
    assert f"Greedy policy: {score(task, run)}, gap " in repr(simulator)


def test_designed_states_are_lifted_back_to_poses():
    world = rl.GridWorld.from_ascii(">..\n..G")
    task = rl.Task(world, features=lambda pose: pose.theta // 45)
    simulator = rl.widgets.Simulator(task)
    run = rl.q_learning(task.mdp(), task.phi(), episodes=3000, alpha=0.2, epsilon=0.2, rng=0)
    assert score(task, run) in repr(simulator)


def test_bad_input_gets_one_error_that_says_what_to_do(task):
    run = rl.q_learning(task.mdp(), episodes=10, rng=0)
    other = rl.Task(rl.GridWorld.from_ascii("S.G"))
    snapped = rl.q_learning(other.mdp(), episodes=10, rng=0, snapshots=2)
    for arguments, message in [
        (("map",), "`task` must be a Task; got 'map'"),
        ((task, "run"), "`training` must be a Training; got 'run'"),
        ((task, run), "`training` must be a run with snapshots"),
        ((task, snapped), "`training` must be a run of this task, whose table is"),
    ]:
        with pytest.raises((TypeError, ValueError)) as raised:
            rl.widgets.Simulator(*arguments)
        assert message in str(raised.value)
