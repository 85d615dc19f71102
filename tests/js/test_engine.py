"""The engine of the browser for itself: steps in slices, back in time, bad input, and modules that can be joined."""

import re
from itertools import chain
from pathlib import Path

import pytest

import rlnav as rl
from explorables import minified
from rlnav.widgets._bundle import join

ENGINE = Path(__file__).parents[2] / "rlnav" / "js"
SOURCES = {path.name: path.read_text(encoding="utf-8") for path in sorted(ENGINE.glob("*.js"))}
ALGORITHMS = ["qLearning", "sarsa", "expectedSarsa", "doubleQLearning", "monteCarlo"]

LEARNERS = """
  const task = new rl.Task(rl.GridWorld.fromAscii(rl.OBSTACLES), {robot: new rl.Robot({slip: 0.1})});
  const mdp = task.mdp();
  const fresh = (name, more) => new rl.Learner(mdp, null, rl[name], {episodes: 1500, maxSteps: 60, rng: 5, ...more});
  // everything that a page could show, to the last bit
  const all = learner => JSON.stringify([
    [learner.Q, learner.visits, learner.rng.state, ...learner.tables].map(bits),
    [learner.returns, learner.steps, learner.stops, learner.tdErrors, learner.coverage]
      .map(array => bits(array.subarray(0, learner.episode))),
    bits(learner.way.subarray(0, learner.t + 1)),
    [learner.updates, learner.episode, learner.covered, learner.s, learner.a, learner.t, learner.over, learner.done],
    [learner.G, learner.discount, learner.surprise, learner.alphaNow, learner.epsilonNow]
      .map(x => bits(Float64Array.of(x))),
    Object.entries(learner.last).map(([name, x]) => [name, bits(Float64Array.of(x))]),
  ]);
"""


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_slices_of_any_length_give_the_same_bits(engine, algorithm):
    whole, *sliced = engine(
        f"""name => {{ {LEARNERS}
          const whole = fresh(name);
          whole.run();
          const ones = fresh(name);
          while (ones.step());
          const odd = fresh(name);
          for (let n = 1; odd.run(n); n = (n * 7 + 3) % 1009);
          const timed = fresh(name);
          while (timed.runFor(1));
          return [whole, ones, odd, timed].map(all);
        }}""",
        algorithm,
    )
    assert len(sliced) == 3
    assert set(sliced) == {whole}


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_every_moment_comes_back_bit_for_bit(engine, algorithm):
    """Around checkpoints, ends of episodes and the first step; one by one, in leaps, and from the very end."""
    wrong = engine(
        f"""name => {{ {LEARNERS}
          const learner = fresh(name), seen = new Map([[0, all(learner)]]), wrong = [];
          const interesting = n => n < 40 || [0, 1, 1023].includes(n % 1024) || n % 397 === 0;
          while (learner.step()) if (interesting(learner.updates)) seen.set(learner.updates, all(learner));
          const last = learner.updates, end = all(learner);
          const check = n => {{ if (all(learner) !== seen.get(n)) wrong.push(n); }};
          const times = [...seen.keys()];
          const leaps = times.map((_, i) => times[(i * 61) % times.length]);
          for (const n of [...leaps, ...times.reverse()]) {{ learner.seek(n); check(n); }}
          learner.seek(39);
          for (let n = 38; n >= 0; n--) {{ learner.back(); check(n); }}
          learner.back();
          check(0);
          for (let n = 1; n < 40; n++) {{ learner.step(); check(n); }}
          learner.run();
          if (all(learner) !== end || learner.updates !== last || last < 3000) wrong.push('end', last);
          learner.back(1000);
          learner.run(1000);
          if (all(learner) !== end) wrong.push('back and forth');
          return wrong;
        }}""",
        algorithm,
    )
    assert wrong == []


def test_few_checkpoints_are_kept_however_long_the_run(engine):
    """One step back replays a short piece; a leap back replays a longer one, and from there all is near again."""
    far = engine(
        f"""() => {{ {LEARNERS}
          const learner = fresh('qLearning', {{episodes: 20000}});
          learner.run();
          let steps = 0;
          const step = learner.step;
          learner.step = function () {{ steps += 1; return step.call(this); }};
          const cost = n => {{ steps = 0; learner.seek(n); return steps; }};
          const end = learner.updates;
          return [end, cost(end - 1), cost(Math.floor(end / 2)), cost(Math.floor(end / 2) - 1), cost(1)];
        }}"""
    )
    end, one, half, one_more, first = far
    assert end > 200_000
    assert one <= 1024
    assert half <= end / 4
    assert one_more <= 1024
    assert first == 1


@pytest.mark.parametrize("algorithm", ALGORITHMS[:4])
def test_the_last_update_is_the_formula_filled_with_its_numbers(engine, algorithm):
    steps = engine(
        f"""name => {{ {LEARNERS}
          const learner = fresh(name, {{alpha: 0.25}}), shown = [];
          for (let i = 0; i < 400; i++) {{
            const before = [learner.Q, ...learner.tables].map(table => table.slice());
            learner.step();
            const {{last}} = learner, at = last.z * mdp.A + last.a;
            const tables = learner.tables.length ? learner.tables : [learner.Q];
            const old = learner.tables.length ? before.slice(1) : before;
            shown.push({{...last, was: old[last.table][at], is: tables[last.table][at], s: learner.s}});
          }}
          return shown;
        }}""",
        algorithm,
    )
    assert any(step["tdError"] for step in steps)
    for step in steps:
        assert step["before"] == step["was"]
        assert step["after"] == step["is"] == step["before"] + 0.25 * step["tdError"]
        assert step["tdError"] == step["target"] - step["before"]
        assert step["sNext"] == step["s"]


def test_visits_and_coverage_count_what_was_tried(engine):
    total, updates, covered, positive = engine(
        f"""() => {{ {LEARNERS}
          const learner = fresh('sarsa');
          learner.run();
          const sum = learner.visits.reduce((n, x) => n + x, 0);
          return [sum, learner.updates, learner.covered, learner.visits.filter(x => x).length];
        }}"""
    )
    assert total == updates
    assert 0 < covered == positive


# ---------------------------------------------------------------- bad input
DRAWINGS = [
    "",
    " \n ",
    "..\n..",
    "S.G\n..",
    "G.G",
    "S.x\n..G",
    "S.\t\n..G",
    "it's\nG...",
    "S#G",
    "S.#\n.#G",
    "#G#",
    "G",
    ">.#.\n..#G",
    "G..\n#é.",
    "." * 301 + "\n" + "G" * 301,
    "." * 300 + "G",
]


@pytest.mark.parametrize("drawing", DRAWINGS, ids=range(len(DRAWINGS)))
def test_a_bad_drawing_gets_the_words_of_python(engine, drawing):
    with pytest.raises(ValueError, match="`") as error:
        rl.GridWorld.from_ascii(drawing)
    assert engine("d => error(() => rl.GridWorld.fromAscii(d))", drawing) == f"RangeError: {error.value}"


BAD = {
    "new rl.Robot({slip: 2})": "RangeError: `slip` must be a number in [0, 1]; got 2.",
    "new rl.Robot({slip: '0.1'})": "TypeError: `slip` must be a number in [0, 1]; got '0.1' (String).",
    "new rl.Robot({steering: []})": "RangeError: `steering` must be a set of different multiples of 45 degrees",
    "new rl.Robot({steering: [0, 45, 0]})": "such as (-45, 0, 45); got 0 twice.",
    "new rl.Robot({steering: [30]})": "got 30 at place 0.",
    "new rl.Robot().move(new rl.Pose(0, 0, 0), 180)": "`a` must be one of the steerings (-90, -45, 0, 45, 90); got 180",
    "new rl.Pose(0, 0, 10)": "RangeError: `theta` must be a multiple of 45 degrees; got 10.",
    "new rl.Pose(0.5, 0, 0)": "TypeError: `x` must be an integer from -1000000 to 1000000; got 0.5 (Number).",
    "rl.randomWorld(1)": "RangeError: `width` must be an integer from 2 to 300; got 1.",
    "rl.randomWorld(5, 5, {density: 1})": "RangeError: `density` must be a number in [0, 0.8]; got 1.",
    "rl.randomWorld(5, 5, {rng: -1})": "RangeError: `rng` must be an integer of at least 0; got -1.",
    "rl.randomWorld(5, 5, {rng: 2 ** 53})": "RangeError: `rng` must be an integer of at most 2**53 - 1 in size",
    "rl.randomWorld(5, 5, {rng: {}})": "TypeError: `rng` must be a Generator; got {} (Object).",
    "new rl.GridWorld(2, 2, {goal: [2, 0]})": "`goal` must be (x, y) inside the 2 x 2 grid; got (2, 0).",
    "new rl.GridWorld(2, 2, {goal: [0, 0], obstacles: [[0, 0]]})": "`goal` must be a free cell; got (0, 0), an obst",
    "new rl.GridWorld(2, 2, {goal: [0, 0], starts: [new rl.Pose(0, 0, 0)]})": "got (0, 0), the goal.",
    "new rl.GridWorld(2, 2, {goal: [0, 0], starts: [new rl.Pose(0, 5, 0)]})": "got (0, 5), outside the grid.",
    "new rl.Task('map')": "TypeError: `world` must be a GridWorld; got 'map' (String).",
    "new rl.Task(w, {gamma: NaN})": "RangeError: `gamma` must be a number in [0, 1]; got NaN.",
    "new rl.Task(w, {features: []})": "`features` must be at least one Feature",
    "new rl.Task(w, {features: 3})": "TypeError: `features` must be features(pose), a Feature or a list of Features",
    "new rl.Task(w, {features: p => -1}).phi()": "`features at Pose(x=0, y=0, theta=0)` must be an integer from 0",
    "new rl.Task(w, {reward: t => NaN}).mdp()": "`reward at Transition(s=Pose(x=0, y=0, theta=0), a=-90,",
    "new rl.Task(w, {reward: t => t.no.thing}).mdp()": "`reward` must be a function that takes these arguments; got",
    "new rl.Task(w).index(new rl.Pose(9, 9, 0))": "`pose` must be on a free cell; got Pose(x=9, y=9, theta=0).",
    "rl.goalBearing(1)": "RangeError: `sectors` must be an integer from 2 to 360; got 1.",
    "rl.goalDistance([2, 1])": "RangeError: `bins` must be ascending distances; got [2,1].",
    "train({episodes: 0})": "RangeError: `episodes` must be an integer from 1 to 10000000; got 0.",
    "train({alpha: 0})": "RangeError: `alpha` must be a number in (0, 1]; got 0.",
    "train({epsilon: [0.1, 2]})": "RangeError: `epsilon[1]` must be a number in [0, 1]; got 2.",
    "train({epsilon: [0.1]})": "RangeError: `epsilon` must be one number, or one for each episode, of shape (2)",
    "train({maxSteps: Infinity})": "TypeError: `maxSteps` must be an integer from 1 to 1000000; got Infinity (Number).",
    "train({Q0: [1, 2]})": "RangeError: `Q0` must be one number, or an initial table, of shape (125); got shape (2).",
    "rl.train(mdp, [0, -1], rl.sarsa, {episodes: 1})": "`phi` must be one row for each state, of shape (25)",
    "rl.train(mdp, null, 'sarsa', {episodes: 1})": "TypeError: `algorithm` must be a function algorithm(learner, last)",
    "rl.lift([0, 0], new Int32Array(25).fill(2))": "`phi` must be rows of a policy with 2 rows; got row 2 in state 0.",
    "rl.rollout(mdp, [0, 1])": "RangeError: `pi` must be one action for each of the 25 states; got 2 actions.",
    "rl.rollout(mdp, new Int32Array(25).fill(7))": "RangeError: `pi[0]` must be an integer from 0 to 4; got 7.",
    "rl.rollout(mdp, new Float64Array(125))": "`pi` must be a distribution over actions in every state; got [0, 0, 0",
    "rl.solve({})": "TypeError: `mdp` must be a MDP; got {} (Object).",
    "rl.solve(endless())": "`mdp` must be a problem whose optimal values are finite at gamma = 1",
    "rl.evaluatePolicy(endless(), [0, 0])": "`pi` must be a policy that ends when gamma = 1; got one that never",
    "model({prob: [0.5, 1]})": "RangeError: `prob` must be probabilities that sum to 1; got the sum 0.5 at s=0, a=0.",
    "model({nextState: [2, 1]})": "RangeError: `nextState[0]` must be an integer from 0 to 1; got 2.",
    "model({nextState: [1, 0]})": "`terminal` must be states that lead only to themselves; got a way out to",
    "model({reward: [1, 1]})": "`terminal` must be states without reward; got reward 1 at s=1, a=0, k=0.",
    "model({start: [1]})": "`start` must be states in which the episode is not over; got the terminal state 1.",
    "model({goal: [1, 1]})": "`goal` must be flags of terminal states only; got state 0, which is not terminal.",
    "model({reward: [1]})": "RangeError: `reward` must be rewards, of shape (2); got shape (1).",
}


@pytest.mark.parametrize("attempt", BAD)
def test_bad_input_gets_one_plain_message(engine, attempt):
    got = engine(
        f"""() => {{
          const w = rl.GridWorld.fromAscii('S.G'), mdp = new rl.Task(w).mdp();
          const train = options => rl.train(mdp, null, rl.sarsa, {{episodes: 2, ...options}});
          const model = change => new rl.MDP({{S: 2, A: 1, K: 1, nextState: [1, 1], prob: [1, 1], reward: [1, 0],
                                               gamma: 1, terminal: [0, 1], start: [0], ...change}});
          const endless = () => model({{nextState: [0, 1]}});
          return error(() => {attempt});
        }}"""
    )
    assert BAD[attempt] in got
    assert re.match(r"(Type|Range)Error: `.+` must be .+; got .+\.", got)


# ---------------------------------------------------------------- modules
def test_no_module_knows_a_page():
    assert len(SOURCES) > 10
    for name, text in SOURCES.items():
        assert not re.search(r"\b(document|window|globalThis|require|fetch|navigator|process\.\w+)\b", text), name


IMPORT = re.compile(r'^import \{ [\w, ]+ \} from "\./(\w+\.js)";\n', re.MULTILINE)


def test_every_module_imports_in_one_plain_form_only():
    for name, text in SOURCES.items():
        assert len(re.findall(r"^\s*import\b|\bimport\(", text, re.MULTILINE)) == len(IMPORT.findall(text)), name
        assert "export default" not in text
        assert "export {" not in text
        assert set(IMPORT.findall(text)) <= SOURCES.keys()


SAME_BITS = """async text => {
  const one = (await import(URL.createObjectURL(new Blob([text], {type: 'text/javascript'})))).default;
  const names = Object.keys(rl).sort().join();
  const run = (rl, name) => {
    const task = new rl.Task(rl.GridWorld.fromAscii(rl.OBSTACLES), {robot: new rl.Robot({slip: 0.1})});
    const {Q, returns} = rl.train(task.mdp(), null, rl[name], {episodes: 300, epsilon: 0.3, rng: 1});
    return [Q, returns, rl.solve(task.mdp()).V].map(bits).join();
  };
  const algorithms = ['qLearning', 'sarsa', 'expectedSarsa', 'doubleQLearning', 'monteCarlo'];
  return names === Object.keys(one).sort().join() && algorithms.every(name => run(one, name) === run(rl, name));
}"""


@pytest.mark.parametrize("squeezed", [str, minified], ids=["joined", "minified"])
def test_the_modules_give_the_same_bits_as_one(engine, squeezed):
    code, exports = join(*SOURCES)
    assert exports.keys() == SOURCES.keys()
    names = ", ".join(f"{name}: {place}" for places in exports.values() for name, place in places.items())
    assert engine(SAME_BITS, squeezed(f"{code}export default {{ {names} }};")) is True


def test_every_module_says_which_part_of_the_library_it_mirrors():
    library = {path.name for path in (ENGINE.parent).glob("*.py")}
    for name, text in SOURCES.items():
        head = text[: text.index("*/")]
        assert text.startswith("/**\n * "), name
        named = set(re.findall(r"rlnav/(\w+\.py)", head))
        assert named <= library
        assert named or "numpy.random.default_rng" in head, name


def test_every_equation_that_the_engine_cites_is_cited_by_the_library():
    library = "\n".join(path.read_text(encoding="utf-8") for path in ENGINE.parent.glob("*.py"))
    cited = set(chain.from_iterable(re.findall(r"\beq-[\w-]+", text) for text in SOURCES.values()))
    assert len(cited) > 5
    assert {label for label in cited if f":eq:`{label}`" not in library} == set()


def test_modules_stay_short():
    for name, text in SOURCES.items():
        code = re.sub(r"/\*\*.*?\*/|^\s*//.*?$", "", text, flags=re.DOTALL | re.MULTILINE)
        assert sum(bool(line.strip()) for line in code.splitlines()) <= 250, name
        assert max(map(len, text.splitlines())) <= 120, name
