"""The engine of the browser and the library give the same bits: random worlds, designs, seeds and algorithms."""

import base64
import itertools
import math
import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import rlnav as rl
from rlnav.world import LARGEST

ENGINE = Path(__file__).parents[2] / "rlnav" / "js"
STEERINGS = [(-90, -45, 0, 45, 90), (-45, 0, 45), (0, 90), (-180, -90, 0, 90, 180), (45,), (-135, 0, 180)]
PAYMENTS = [{}, {"step": -1.0, "turn": -0.3}, {"goal": 1.0, "crash": -0.7, "step": 0.0}]
PROGRESS = [None, None, {"weight": 0.3}, {"weight": 1.7, "only_closer": True}]
FEATURES = [
    None,
    [["cell"]],
    [["heading"], ["goal_direction"]],
    [["goal_bearing", 8], ["moves_ahead"]],
    [["goal_bearing", 7], ["goal_distance", [0.5, 1.5, 4.0]]],
    [["goal_bearing", 4], ["goal_distance", [1.0]], ["moves_ahead"], ["heading"]],
]
ALGORITHMS = ["q_learning", "sarsa", "expected_sarsa", "double_q_learning", "monte_carlo"]


def camel(name):
    """The name in JavaScript: next_state -> nextState."""
    return re.sub(r"_(\w)", lambda match: match[1].upper(), name)


def camels(keywords):
    return {camel(name): value for name, value in keywords.items()} if keywords else keywords


def design(i):
    """Random world, robot, reward and features number i, as plain values, and the task that they describe."""
    random = np.random.default_rng(1000 + i)
    pick = lambda options: options[random.integers(len(options))]  # noqa: E731
    width, height = (int(n) for n in random.integers(2, 9, 2))
    world = rl.maps.random(width, height, density=pick([0.0, 0.15, 0.3, 0.5]), rng=i)
    spec = {
        "drawing": str(world),
        "steering": pick(STEERINGS),
        "slip": pick([0.0, 0.1, 0.3, 1.0]),
        "payment": pick(PAYMENTS),
        "progress": pick(PROGRESS),
        "shaping": bool(random.random() < 0.3),
        "features": pick(FEATURES),
        "gamma": pick([0.0, 0.5, 0.95, 0.99, 1.0]),
    }
    return spec, task_of(spec)


def task_of(spec):
    world = rl.GridWorld.from_ascii(spec["drawing"])
    rewards = [rl.designs.Payment(**spec["payment"])]
    if spec["progress"]:
        rewards.append(rl.designs.Progress(world.goal, **spec["progress"]))
    reward = rl.designs.Total(*rewards) if len(rewards) > 1 else rewards[0]
    if spec["shaping"]:
        reward = rl.designs.Shaped(reward, lambda pose: -rl.designs.distance(pose, world.goal), spec["gamma"])
    named = spec["features"] and [getattr(rl.designs, name)(*given) for name, *given in spec["features"]]
    return rl.Task(world, rl.Robot(spec["steering"], spec["slip"]), reward, named, spec["gamma"])


def in_js(spec):
    features = spec["features"] and [[camel(name), *given] for name, *given in spec["features"]]
    return {**spec, "progress": camels(spec["progress"]), "features": features}


@pytest.fixture(scope="module")
def designs():
    return [design(i) for i in range(120)]


def any_mdp(i):
    """Random MDP number i, with impossible successors and probabilities that do not sum to one exactly."""
    random = np.random.default_rng(2000 + i)
    ends = int(random.integers(1, 3))
    S, A, K = ends + int(random.integers(1, 8)), int(random.integers(1, 5)), int(random.integers(1, 5))
    next_state, prob = random.integers(0, S, (S, A, K)), random.random((S, A, K)) ** 3
    prob *= random.random((S, A, K)) > 0.2
    prob[:, :, 0] += 0.1
    next_state[:, :, 0] = S - 1
    reward = random.standard_normal((S, A, K))
    terminal = np.arange(S) >= S - ends
    next_state[terminal], reward[terminal] = np.arange(S)[terminal, None, None], 0.0
    start = random.integers(0, S - ends, int(random.integers(1, 4)))
    gamma = float(random.choice([0.0, 0.3, 0.9, 0.999, 1.0]))
    return rl.MDP(next_state, prob / prob.sum(axis=2, keepdims=True), reward, gamma, terminal, start)


def given(mdp):
    """The arrays of an MDP as the engine's constructor takes them; JSON keeps every bit of a float."""
    arrays = {name: getattr(mdp, name).ravel().tolist() for name in ("prob", "reward", "terminal", "start", "goal")}
    sizes = {"S": mdp.S, "A": mdp.A, "K": mdp.K, "gamma": mdp.gamma}
    return {**sizes, **arrays, "nextState": mdp.next_state.ravel().tolist()}


def plain(pi):
    """A policy as JSON: actions, or {probabilities}."""
    return pi.tolist() if pi.ndim == 1 else {"probabilities": pi.ravel().tolist()}


def same_bits(theirs, ours):
    """Whether numbers from the page are those of Python, to the last bit; only the sign of a zero may differ."""
    return (theirs + 0.0).tobytes() == (np.asarray(ours, np.float64).ravel() + 0.0).tobytes()


# ---------------------------------------------------------------- chance
def test_the_same_seed_gives_the_same_numbers(engine, floats):
    seeds = [0, 1, 2, 2**31, 2**32 - 1, 2**32, 2**32 + 1, 2**52 + 12345, 2**53 - 1]
    seeds += [int(2**x) for x in np.random.default_rng(0).uniform(0, 53, 200)]
    streams = engine(
        """seeds => seeds.map(seed => {
             const rng = new rl.Generator(seed);
             return bits(Float64Array.from({length: 200}, () => rng.random()));
           })""",
        seeds,
    )
    for seed, stream in zip(seeds, streams, strict=True):
        assert floats(stream).tobytes() == np.random.default_rng(seed).random(200).tobytes(), seed


def test_a_long_stream_stays_the_same(engine, floats):
    stream = engine(
        """() => {
             const rng = new rl.Generator(7);
             return bits(Float64Array.from({length: 300000}, () => rng.random()));
           }"""
    )
    assert floats(stream).tobytes() == np.random.default_rng(7).random(300_000).tobytes()


# ---------------------------------------------------------------- worlds, robots, designs
def test_the_maps_of_the_book_are_the_same(engine):
    for name in rl.maps.NAMES:
        assert engine("name => rl[name]", name) == getattr(rl.maps, name)
        assert engine("name => String(rl.GridWorld.fromAscii(rl[name]))", name) == str(
            rl.GridWorld.from_ascii(getattr(rl.maps, name))
        )


def test_random_maps_are_the_same(engine):
    random = np.random.default_rng(1)
    cases = [[*random.integers(2, 13, 2).tolist(), float(random.choice([0, 0.2, 0.4, 0.8])), i] for i in range(200)]
    cases += [[30, 30, 0.3, 5], [300, 4, 0.4, 6]]
    drawn = engine("cases => cases.map(([w, h, density, rng]) => String(rl.randomWorld(w, h, {density, rng})))", cases)
    for (width, height, density, seed), drawing in zip(cases, drawn, strict=True):
        assert drawing == str(rl.maps.random(width, height, density=density, rng=seed))


def test_starts_of_a_drawing_are_the_same(engine):
    for drawing in ("S.G\n.v.", ">.<\n^Gv\nS#.", "..\nG."):
        starts = engine("drawing => rl.GridWorld.fromAscii(drawing).starts.map(String)", drawing)
        assert starts == [str(pose) for pose in rl.GridWorld.from_ascii(drawing).starts]
        assert engine("drawing => String(rl.GridWorld.fromAscii(drawing))", drawing) == str(
            rl.GridWorld.from_ascii(drawing)
        )


def test_every_move_is_the_same(engine):
    robot = rl.Robot(range(-180, 181, 45))
    poses = [rl.Pose(x, y, theta) for x, y in [(0, 0), (-7, 5), (1_000, -999_998)] for theta in range(0, 360, 45)]
    moves = engine(
        """poses => {
             const robot = new rl.Robot({steering: [-180, -135, -90, -45, 0, 45, 90, 135, 180]});
             return poses.flatMap(pose => robot.steering.map(a => String(robot.move(new rl.Pose(...pose), a))));
           }""",
        [[p.x, p.y, p.theta] for p in poses],
    )
    assert moves == [str(robot.move(pose, a)) for pose in poses for a in robot.steering]


def test_goal_bearings_are_the_same_for_every_number_of_sectors(engine):
    offsets = [(dx, dy) for dx in range(-5, 6) for dy in range(-5, 6) if dx or dy]
    random = np.random.default_rng(2)
    offsets += [(int(dx), int(dy)) for dx, dy in random.integers(1 - LARGEST, LARGEST, (60, 2)) if dx or dy]
    offsets += [(LARGEST - 1, LARGEST - 1), (1 - LARGEST, LARGEST - 1), (-1, 1 - LARGEST), (LARGEST - 1, 0)]
    theirs = engine(
        """([offsets, headings]) => {
             const levels = [];
             for (let n = 2; n <= 360; n++) {
               const {of} = rl.goalBearing(n);
               for (const [dx, dy] of offsets) {
                 const world = {goal: [dx, dy]};
                 for (const theta of headings) levels.push(of({x: 0, y: 0, theta}, world));
               }
             }
             return bits(Int32Array.from(levels));
           }""",
        [offsets, list(range(0, 360, 45))],
    )
    features = [rl.designs.goal_bearing(n) for n in range(2, 361)]
    worlds = [SimpleNamespace(goal=offset) for offset in offsets]
    poses = [rl.Pose(0, 0, theta) for theta in range(0, 360, 45)]
    ours = [feature.of(pose, world, None) for feature, world, pose in itertools.product(features, worlds, poses)]
    assert np.frombuffer(base64.b64decode(theirs), np.int32).tolist() == ours


def test_sums_of_rewards_are_rounded_once(engine, floats):
    random = np.random.default_rng(3)
    lists = [[0.1] * 10, [1e16, 1.0, 1e-16], [1e16, 1.0, -1e-16], [1.0, 1e100, 1.0, -1e100], [-0.1, 0.1], []]
    lists += [(random.standard_normal(n) * 10.0 ** random.integers(-20, 20, n)).tolist() for n in range(1, 200)]
    sums = engine("lists => bits(Float64Array.from(lists, rl.exactSum))", lists)
    assert same_bits(floats(sums), [math.fsum(terms) for terms in lists])


MODEL = """specs => specs.map(spec => {
  const task = taskOf(spec), mdp = task.mdp();
  const arrays = ['nextState', 'prob', 'reward', 'terminal', 'start', 'goal'].map(name => mdp[name]);
  return [[mdp.S, mdp.A, mdp.K], ...arrays, task.phi()].map(array => bits(Float64Array.from(array)));
})"""


def model_of(task):
    """All numbers of a task's model, and of its state design."""
    mdp = task.mdp()
    arrays = [mdp.next_state, mdp.prob, mdp.reward, mdp.terminal, mdp.start, mdp.goal, task.phi()]
    return [[mdp.S, mdp.A, mdp.K], *arrays]


def wrong(engine, floats, function, cases):
    """The cases, pairs of what the page is given and what Python has found, in which any bit differs."""
    found = engine(function, [js for js, _ in cases])
    return [
        js
        for (js, ours), theirs in zip(cases, found, strict=True)
        if not all(same_bits(floats(x), y) for x, y in zip(theirs, ours, strict=True))
    ]


@pytest.fixture(scope="module")
def model_cases(designs):
    return [(in_js(spec), model_of(task)) for spec, task in designs]


def test_models_and_state_designs_are_the_same(engine, floats, model_cases):
    assert wrong(engine, floats, MODEL, model_cases) == []


def test_a_state_design_of_ones_own_is_the_same(engine, designs):
    for spec, task in designs[:10]:
        own = rl.Task(task.world, features=lambda pose: (3 * pose.x + pose.y + pose.theta // 90) % 11)
        of = "pose => (3 * pose.x + pose.y + Math.floor(pose.theta / 90)) % 11"
        theirs = engine(f"spec => Array.from(new rl.Task(worldOf(spec), {{features: {of}}}).phi())", spec)
        assert theirs == own.phi().tolist()


# ---------------------------------------------------------------- learning
TRAINING = """cases => cases.map(({spec, mdp, algorithm, options}) => {
  const task = spec && taskOf(spec);
  const run = rl.train(task ? task.mdp() : new rl.MDP(mdp), task ? task.phi() : null, rl[algorithm], options);
  return ['Q', 'pi', 'returns', 'steps', 'terminated', 'success'].map(name => bits(Float64Array.from(run[name])));
})"""


def learning_case(i, designs):
    """Random run number i, as the page is told of it, and what it gives in Python."""
    random = np.random.default_rng(3000 + i)
    episodes = int(random.integers(1, 40))
    schedule = lambda low: (low + (1 - low) * random.random(episodes)).tolist()  # noqa: E731
    options = {
        "episodes": episodes,
        "alpha": schedule(0.01) if random.random() < 0.3 else float(random.choice([0.1, 0.5, 1.0])),
        "epsilon": schedule(0.0) if random.random() < 0.3 else float(random.choice([0.0, 0.1, 0.5, 1.0])),
        "max_steps": int(random.choice([1, 5, 60])),
        "rng": int(random.integers(2**53)),
    }
    spec, task = designs[i % len(designs)]
    mdp, phi = (task.mdp(), task.phi()) if i % 3 else (any_mdp(i), None)
    rows = mdp.S if phi is None else int(phi.max()) + 1
    table = random.integers(-2, 3, (rows, mdp.A)) / 2 if random.random() < 0.3 else random.choice([0.0, 3.0])
    algorithm = ALGORITHMS[i % len(ALGORITHMS)]
    model = {"spec": in_js(spec)} if i % 3 else {"mdp": given(mdp)}
    js = {**model, "algorithm": camel(algorithm), "options": {**camels(options), "Q0": np.ravel(table).tolist()}}
    if np.ndim(table) == 0:
        js["options"]["Q0"] = float(table)
    run = getattr(rl, algorithm)(mdp, phi, Q0=table, **options)
    return js, [run.Q, run.pi, run.returns, run.steps, run.terminated, run.success]


@pytest.fixture(scope="module")
def runs(designs, compiled):
    return [learning_case(i, designs) for i in range(360)]


def test_learning_gives_the_same_tables_returns_and_steps(engine, floats, runs):
    assert wrong(engine, floats, TRAINING, runs) == []


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_a_long_training_stays_the_same(engine, floats, algorithm):
    spec = {"drawing": rl.maps.OBSTACLES.strip(), "steering": STEERINGS[0], "slip": 0.1, "payment": {}}
    spec |= {"progress": None, "shaping": False, "features": FEATURES[3], "gamma": 0.95}
    task = task_of(spec)
    run = getattr(rl, algorithm)(task.mdp(), task.phi(), episodes=2000, rng=12)
    case = {"spec": spec | {"features": in_js(spec)["features"]}, "algorithm": camel(algorithm)}
    case["options"] = {"episodes": 2000, "rng": 12}
    ((table, _, returns, steps, *_),) = engine(TRAINING, [case])
    assert run.steps.sum() > 10_000
    assert same_bits(floats(table), run.Q)
    assert same_bits(floats(returns), run.returns)
    assert same_bits(floats(steps), run.steps)


# ---------------------------------------------------------------- planning and evaluation
PLANS = """cases => cases.map(({spec, mdp}) => {
  const model = spec ? taskOf(spec).mdp() : new rl.MDP(mdp);
  return ['valueIteration', 'solve'].map(name => {
    const {V, Q, pi, residuals} = rl[name](model);
    return [V, Q, pi, residuals].map(array => bits(Float64Array.from(array)));
  });
})"""


def models(designs):
    """Models with finite values: those of the designs that discount, and arbitrary ones that end."""
    tasks = [({"spec": in_js(spec)}, task.mdp()) for spec, task in designs[:60] if spec["gamma"] < 1]
    others = [({"mdp": given(mdp)}, mdp) for mdp in map(any_mdp, range(60))]
    return tasks + others


def close(theirs, ours):
    return np.allclose(theirs, np.ravel(ours), rtol=1e-12, atol=1e-12)


def test_plans_are_the_same_within_rounding(engine, floats, designs):
    cases = models(designs)
    for (_, mdp), plans in zip(cases, engine(PLANS, [js for js, _ in cases]), strict=True):
        for planner, (V, Q, pi, residuals) in zip((rl.value_iteration, rl.solve), plans, strict=True):
            best = planner(mdp)
            assert close(floats(V), best.V)
            assert close(floats(Q), best.Q)
            assert close(floats(residuals), best.residuals)
            assert floats(pi).tolist() == best.pi.tolist()


VALUES = """cases => cases.map(({spec, mdp, pi}) => {
  const model = spec ? taskOf(spec).mdp() : new rl.MDP(mdp);
  const {success, crash, timeout, steps, value, optimal} = rl.evaluate(model, policyOf(pi), {maxSteps: 30});
  return [bits(rl.evaluatePolicy(model, policyOf(pi))), [success, crash, timeout, steps, value, optimal]];
})"""


def test_policies_are_scored_the_same_within_rounding(engine, floats, designs):
    random, cases = np.random.default_rng(4), []
    for js, mdp in models(designs):
        pi = random.integers(0, mdp.A, mdp.S) if random.random() < 0.5 else random.dirichlet(np.ones(mdp.A), mdp.S)
        cases.append(({**js, "pi": plain(pi)}, mdp, pi))
    for (_, mdp, pi), (V, score) in zip(cases, engine(VALUES, [js for js, *_ in cases]), strict=True):
        ours = rl.evaluate(mdp, pi, max_steps=30)
        assert close(floats(V), rl.evaluate_policy(mdp, pi))
        expected = [ours.success, ours.crash, ours.timeout, ours.steps, ours.value, ours.optimal]
        assert np.allclose(score, expected, rtol=1e-12, atol=1e-12)


def test_the_undiscounted_task_of_a_slipping_robot_is_valued_the_same(engine, floats):
    spec = {"drawing": rl.maps.OBSTACLES.strip(), "steering": STEERINGS[0], "slip": 0.3, "payment": {}}
    spec |= {"progress": None, "shaping": False, "features": None, "gamma": 1.0}
    mdp = task_of(spec).mdp()
    pi = np.full((mdp.S, mdp.A), 1 / mdp.A)
    V = engine("([spec, pi]) => bits(rl.evaluatePolicy(taskOf(spec).mdp(), policyOf(pi)))", [spec, plain(pi)])
    assert close(floats(V), rl.evaluate_policy(mdp, pi))


ROLLOUTS = """cases => cases.map(({spec, pi, start, rng}) => {
  const mdp = taskOf(spec).mdp();
  const {states, actions, rewards, terminated} = rl.rollout(mdp, policyOf(pi), {start, maxSteps: 25, rng});
  return [Array.from(states), Array.from(actions), bits(rewards), bits(rl.returns(rewards, mdp.gamma)), terminated];
})"""


def test_episodes_of_a_policy_are_the_same(engine, floats, designs):
    random, cases = np.random.default_rng(5), []
    for i, (spec, task) in enumerate(designs[:100]):
        mdp = task.mdp()
        pi = random.integers(0, mdp.A, mdp.S) if i % 2 else random.dirichlet(np.ones(mdp.A), mdp.S)
        start = int(random.choice(mdp.start)) if i % 3 == 0 else None
        js = {"spec": in_js(spec), "pi": plain(pi), "start": start, "rng": i}
        cases.append((js, mdp, rl.rollout(mdp, pi, start=start, max_steps=25, rng=i)))
    for (_, mdp, ours), episode in zip(cases, engine(ROLLOUTS, [js for js, *_ in cases]), strict=True):
        states, actions, rewards, G, terminated = episode
        assert (states, actions, terminated) == (ours.states.tolist(), ours.actions.tolist(), ours.terminated)
        assert same_bits(floats(rewards), ours.rewards)
        assert same_bits(floats(G), rl.returns(ours.rewards, mdp.gamma))


# ---------------------------------------------------------------- would these tests notice?
@pytest.mark.parametrize(
    ("function", "module", "before", "after"),
    [
        (TRAINING, "rng.js", "(s[3] << 8)", "(s[3] << 7)"),
        (TRAINING, "rng.js", "a2 * M3", "a2 * M2"),
        (TRAINING, "algorithms.js", "last.next = largest", "last.next = -largest"),
        (TRAINING, "algorithms.js", "last.coin < 0.5", "last.coin < 0.4"),
        (TRAINING, "algorithms.js", "let i = t - 1; i >= 0", "let i = t - 1; i > 0"),
        (TRAINING, "sampling.js", "(1 - epsilon) * largest(Q, z, A) + ", "(1 - epsilon) * largest(Q, z, A) - "),
        (TRAINING, "sampling.js", "if (left < 0)", "if (left > 0)"),
        (TRAINING, "sampling.js", "skip-- > 0", "skip-- > 1"),
        (TRAINING, "learning.js", "this.discount *= mdp.gamma", "this.discount *= 1"),
        (MODEL, "world.js", "diagonal && (", "!diagonal && ("),
        (MODEL, "designs.js", "(turn * Math.abs(t.a)) / 90", "turn * (Math.abs(t.a) / 91)"),
        (MODEL, "task.js", "z * f.size(world, robot) +", "z + f.size(world, robot) *"),
    ],
    ids=range(12),
)
def test_a_planted_fault_is_noticed(engine_in, floats, model_cases, runs, tmp_path, function, module, before, after):
    folder = shutil.copytree(ENGINE, tmp_path / "js")
    text = (folder / module).read_text(encoding="utf-8")
    assert before in text
    (folder / module).write_text(text.replace(before, after), encoding="utf-8")
    with engine_in(folder) as engine:
        assert wrong(engine, floats, function, {MODEL: model_cases[:40], TRAINING: runs[:60]}[function])
