"""The run behind the simulator, without a page: slices equal the whole, every moment comes back, answers are exact."""

import itertools

import numpy as np
import pytest

import rlnav as rl
from rlnav.widgets import Simulator, _scenario

from . import scenarios
from .scenarios import any_scenario, same

ALGORITHMS = list(_scenario.ALGORITHMS)
METRICS = ["returns", "success", "steps", "tdErrors", "coverage"]

# everything that a page could show of a session, to the last bit
LOOK = """() => { window.look = session => {
  const { learner } = session, { last } = learner;
  while (session.solveSlice(100));
  const log = session.log;
  return plain([
    [session.updates, session.episode, session.done, session.robot, session.path(), session.pose, session.sentence()],
    [learner.Q, learner.visits, ...learner.tables, session.valuesPerPose(), session.turnsPerPose(),
      session.visitsPerPose(), session.errorPerPose()].map(bits),
    Object.values(log).map(values => typeof values === 'number' ? values : bits(Float64Array.from(values))),
    sc.METRICS.map(metric => session.series(metric)),
    session.formula(), session.greedyPath(), Object.values(last).map(String),
  ]);
}; }"""


@pytest.fixture(scope="module")
def sc(engine):
    """The engine's page with the modules of scenario/ as `sc`."""
    engine.page.evaluate(scenarios.LOAD, scenarios.MODULES)
    engine.page.evaluate(LOOK)
    return engine


def lesson(**changed):
    return _scenario.checked({"episodes": 120, "max_steps": 40, "slip": 0.1, **changed})


# ---------------------------------------------------------------- slices and time
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_slices_equal_the_whole(sc, algorithm):
    whole, *sliced = sc(
        """raw => {
          const made = [0, 1, 2, 3].map(() => new sc.Session(raw));
          const [whole, ones, odd, timed] = made;
          whole.run();
          while (ones.step());
          for (let n = 1; odd.run(n); n = (n * 7 + 3) % 101);
          while (timed.runFor(0), !timed.done);
          return made.map(session => JSON.stringify(look(session)));
        }""",
        lesson(algorithm=algorithm),
    )
    assert len(sliced) == 3
    assert set(sliced) == {whole}


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_every_moment_comes_back_with_all_that_is_shown_of_it(sc, algorithm):
    """Back, seek, back by an episode, reset, in random order: each moment looks as it did on the way there."""
    wrong = sc(
        """raw => {
          const session = new sc.Session(raw), seen = new Map([[0, JSON.stringify(look(session))]]), wrong = [];
          while (session.step()) if (session.updates % 7 === 0 || session.updates < 30 || session.learner.over) {
            seen.set(session.updates, JSON.stringify(look(session)));
          }
          const end = session.updates, chance = new rl.Generator(1);
          const any = n => Math.floor(chance.random() * n);
          for (let i = 0; i < 150; i++) {
            const way = any(6);
            if (way === 0) session.seek([...seen.keys()][any(seen.size)]);
            else if (way === 1) session.back(1 + any(5));
            else if (way === 2) session.backEpisode();
            else if (way === 3) session.episodeOn();
            else if (way === 4) session.run(any(40));
            else if (any(20) === 0) session.reset();
            const { updates } = session;
            if (seen.has(updates) && seen.get(updates) !== JSON.stringify(look(session))) wrong.push(updates);
            else seen.set(updates, JSON.stringify(look(session)));
          }
          session.seek(end);
          return [wrong, seen.get(end) === JSON.stringify(look(session)), seen.size, end];
        }""",
        lesson(algorithm=algorithm),
    )
    wrong, same_end, seen, end = wrong
    assert wrong == []
    assert same_end
    assert seen > 100 < end


def test_episodes_are_gone_through_forth_and_back(sc):
    ends, back, begin = sc(
        """raw => {
          const session = new sc.Session(raw), ends = [], back = [];
          for (let i = 0; i < 5; i++) { session.episodeOn(); ends.push(session.updates); }
          session.step();
          for (let i = 0; i < 6; i++) { session.backEpisode(); back.push(session.updates); }
          return [ends, back, session.episode];
        }""",
        lesson(),
    )
    assert ends == sorted(set(ends))
    assert back == [ends[4], ends[3], ends[2], ends[1], ends[0], 0]
    assert begin == 0


def test_more_episodes_go_on_with_the_run_that_python_would_make(sc, floats):
    for i in range(20):
        raw = any_scenario(i) | {"alpha_schedule": "constant", "epsilon_schedule": "constant", "episodes": 9}
        longer = raw | {"episodes": 31}
        went_on, Q, back, fresh = sc(
            """([raw, longer]) => {
              const session = new sc.Session(raw);
              session.run();
              const went = session.goOn(longer);
              session.run();
              const Q = bits(session.learner.Q);
              session.back(3);
              const fresh = new sc.Session(longer);
              fresh.run();
              fresh.back(3);
              const looks = [session, fresh].map(each => JSON.stringify(look(each)));
              return [went && session.scenario.episodes === 31, Q, ...looks];
            }""",
            [raw, longer],
        )
        assert went_on
        assert back == fresh
        run = _scenario.train(longer, _scenario.task_of(longer))
        assert (floats(Q) + 0.0).tobytes() == (run.Q.ravel() + 0.0).tobytes()


def test_a_schedule_that_depends_on_the_episodes_needs_a_new_run(sc):
    went_on = sc(
        """raws => raws.map(raw => new sc.Session(raw).goOn({ ...raw, episodes: 130 }))""",
        [lesson(), lesson(epsilon_schedule="linear"), lesson(alpha_schedule="harmonic")],
    )
    assert went_on == [True, False, False]


def test_any_other_change_is_a_new_run(sc):
    raw = lesson()
    changes = [
        {"alpha": 0.3},
        {"seed": 1},
        {"episodes": 119},
        {"episodes": 130, "slip": 0},
        {"epsilon_schedule": "linear", "episodes": 130},
    ]
    kept = sc(
        """([raw, changes]) => {
          const session = new sc.Session(raw);
          session.run(50);
          const before = JSON.stringify(look(session));
          return changes.map(change => session.goOn({ ...raw, ...change }) || before !== JSON.stringify(look(session)));
        }""",
        [raw, changes],
    )
    assert kept == [False] * len(changes)


# ---------------------------------------------------------------- exact answers
def test_scores_and_the_best_are_those_of_python(sc, floats):
    for i in range(40):
        raw = any_scenario(i)
        scores, best, Q = sc(
            """raw => {
              const session = new sc.Session(raw);
              session.run();
              let slices = 0;
              while (session.evaluateSlice(0)) slices += 1;
              return [session.evaluation, bits(session.best.Q), bits(session.learner.Q)];
            }""",
            raw,
        )
        task = _scenario.task_of(raw)
        mdp, Q = task.mdp(), floats(Q).reshape(-1, len(raw["steering"]))
        pi = rl.greedy(Q)[task.phi()]
        try:
            exact = rl.solve(mdp, tol=1e-12, max_sweeps=3000)
        except ValueError:
            exact = None
        if exact is not None and exact.converged:
            np.testing.assert_allclose(floats(best).reshape(exact.Q.shape), exact.Q, rtol=1e-9, atol=1e-8)
        try:
            ours = rl.evaluate(mdp, pi, max_steps=raw["max_steps"])
        except ValueError:
            assert raw["gamma"] == 1
            continue
        for name in ("success", "crash", "timeout", "steps", "value", "optimal", "gap"):
            assert scores[name] == pytest.approx(getattr(ours, name), abs=1e-7), (i, name)
        assert scores["why"] == ""


def test_a_policy_without_a_finite_value_says_why(sc):
    untrained, endless = sc(
        """() => [{ gamma: 1 }, { gamma: 1, reward: { step: 1 } }].map(raw => {
          const session = new sc.Session({ ...raw, map: ['....', '...G', '....', '....'], starts: null });
          while (session.evaluateSlice(1));
          return { ...session.evaluation, gap: String(session.evaluation.gap) };
        })"""
    )
    assert "drive on for ever" in untrained["why"]
    assert untrained["timeout"] > 0.1
    assert untrained["gap"] == endless["gap"] == "NaN"
    assert "without end" in endless["why"] or "for ever" in endless["why"]


def test_poses_that_are_never_reached_do_not_spoil_the_value_at_gamma_1(sc):
    """The greedy policy circles for ever in corners that were never visited, but not from the start."""
    scores, path = sc(
        """raw => {
          const session = new sc.Session(raw);
          session.run();
          while (session.evaluateSlice(5));
          return [session.evaluation, session.greedyPath()];
        }""",
        lesson(gamma=1, slip=0, starts=[[2, 2, 0]], episodes=1500),
    )
    assert scores["why"] == ""
    assert scores["success"] == 1
    assert path["goal"]
    assert scores["value"] == pytest.approx(path["total"], abs=1e-9)
    assert scores["gap"] == pytest.approx(scores["optimal"] - scores["value"], abs=1e-12)


def test_scores_are_stale_as_soon_as_the_table_has_moved_on(sc):
    seen = sc(
        """raw => {
          const session = new sc.Session(raw), seen = [session.stale, session.evaluation === null];
          while (session.evaluateSlice(0));
          seen.push(session.stale, session.evaluation.updates);
          session.run(200);
          seen.push(session.stale);
          session.evaluateSlice(0);
          session.run(200);
          while (session.evaluateSlice(0));
          seen.push(session.stale, session.evaluation.updates);
          while (session.evaluateSlice(0));
          seen.push(session.stale, session.evaluation.updates);
          return seen;
        }""",
        lesson(),
    )
    assert seen == [True, True, False, 0, True, True, 200, False, 400]


def test_no_slice_is_long(sc):
    """Counted in pieces of work, not in time: the largest world is scored in many small steps."""
    pieces = sc(
        """() => {
          const raw = { ...sc.randomMap({ width: 30, seed: 3 }), gamma: 0.9995, slip: 0.2 };
          const session = new sc.Session(raw);
          let pieces = 0;
          while (session.evaluateSlice(0)) pieces += 1;
          return pieces;
        }"""
    )
    assert pieces > 100


# ---------------------------------------------------------------- what the table says
def test_every_pose_shows_what_the_table_says_of_it(sc, floats):
    for i in range(30):
        raw = any_scenario(i)
        Q, visits, values, turns, counts, errors, exact = sc(
            """raw => {
              const session = new sc.Session(raw);
              session.run(150);
              session.valuesPerPose();
              session.errorPerPose();
              while (session.solveSlice(100));
              session.run(100);
              const { learner } = session;
              const table = [session.valuesPerPose(), session.turnsPerPose(), session.visitsPerPose()];
              const all = [learner.Q, learner.visits, ...table, session.errorPerPose(), session.best.Q];
              return all.map(array => bits(Float64Array.from(array)));
            }""",
            raw,
        )
        task, A = _scenario.task_of(raw), len(raw["steering"])
        phi = task.phi()
        Q, visits, exact = (floats(array).reshape(-1, A) for array in (Q, visits, exact))
        width, height = task.world.width, task.world.height
        expected = np.full((4, width * height * 8), np.nan)
        for s in range(task.mdp().S - 1):
            pose = task.pose(s)
            place, z = (pose.y * width + pose.x) * 8 + pose.theta // 45, phi[s]
            expected[:, place] = [
                Q[z].max(),
                task.robot.steering[rl.greedy(Q[z][None])[0]],
                visits[z].sum(),
                np.abs(Q[z] - exact[s]).max(),
            ]
        for theirs, ours in zip((values, turns, counts, errors), expected, strict=True):
            np.testing.assert_array_equal(floats(theirs), ours)


def test_one_pose_is_inspected(sc):
    found, wall, outside = sc(
        """raw => {
          const session = new sc.Session(raw);
          session.run(300);
          const { learner, best } = session, A = 5;
          const found = session.inspect({ x: 2, y: 2, theta: 90 });
          const row = array => Array.from(array.subarray(found.s * A, found.s * A + A));
          const whole = [row(learner.Q), row(best.Q), row(learner.visits), String(session.task.pose(found.s))];
          const none = [{ x: 3, y: 3, theta: 0 }, { x: -1, y: 0, theta: 0 }].map(pose => session.inspect(pose));
          return [[plain(found), whole], ...none];
        }""",
        lesson(map=[*["." * 10] * 6, "...#......", *["." * 10] * 2, "." * 9 + "G"], starts=[[2, 2, 90]]),
    )
    pose, (Q, exact, visits, name) = found
    assert (pose["Q"], pose["exact"], pose["visits"]) == (Q, exact, visits)
    assert name == "Pose(x=2, y=2, theta=90)"
    assert sum(visits) > 0
    assert pose["Q"][pose["best"]] == max(Q)
    assert wall is outside is None


def test_rows_that_mix_situations_are_counted(sc):
    """Against brute force over all pairs of poses that the robot can come to."""
    found = 0
    for i in range(40):
        raw = any_scenario(i)
        aliases = sc("raw => plain(new sc.Session(raw).aliasing())", raw)
        task = _scenario.task_of(raw)
        mdp, phi = task.mdp(), task.phi()
        best = rl.solve(mdp, tol=1e-13, max_sweeps=3000)
        if not best.converged:
            continue
        reached, wider = set(), set(mdp.start.tolist())
        while wider:
            reached |= wider
            states = list(wider)
            wider = set(mdp.next_state[states][mdp.prob[states] > 0].tolist()) - reached
        good = {s: set(np.flatnonzero(best.Q[s] >= best.V[s] - 1e-8)) for s in reached if not mdp.terminal[s]}
        mixed = {phi[s] for s, t in itertools.combinations(good, 2) if phi[s] == phi[t] and not good[s] & good[t]}
        assert aliases["count"] == len(mixed), i
        found += len(mixed)
        if not mixed:
            assert aliases["pair"] is None
            continue
        s, t = (task.index(rl.Pose(p["x"], p["y"], p["theta"])) for p in aliases["pair"])
        assert phi[s] == phi[t] in mixed
        assert not good[s] & good[t]
        for state, turn in zip((s, t), aliases["turns"], strict=True):
            assert task.robot.steering.index(turn) in good[state]
    assert found > 20


# ---------------------------------------------------------------- curves
def test_curves_are_means_over_the_episodes_since_the_last_point(sc):
    for episodes, taken in ((7, 7), (120, 60), (1000, 1000), (1000, 333), (5000, 5000)):
        log, series = sc(
            """([raw, taken]) => {
              const session = new sc.Session(raw);
              while (session.episode < taken && session.step());
              const log = Object.fromEntries(sc.METRICS.map(metric => [metric, Array.from(session.log[metric])]));
              return [log, Object.fromEntries(sc.METRICS.map(metric => [metric, session.series(metric)]))];
            }""",
            [lesson(episodes=episodes, max_steps=20), taken],
        )
        for metric in METRICS:
            x, y = series[metric]["x"], series[metric]["y"]
            assert len(x) == len(y) <= 241
            assert x[-1] == taken
            assert x == sorted(set(x))
            window = {"success": 50, "coverage": 1}.get(metric, 10)
            before = [0, *x[:-1]]
            means = [np.mean(log[metric][min(a, max(0, b - window)) : b]) for a, b in zip(before, x, strict=True)]
            np.testing.assert_allclose(y, means, rtol=1e-12, atol=1e-12)
        assert all(0 <= share <= 1 for share in log["coverage"])
        assert log["coverage"] == sorted(log["coverage"])


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_td_errors_and_coverage_are_those_of_the_single_steps(sc, algorithm):
    log, steps = sc(
        """raw => {
          const session = new sc.Session(raw), { learner, mdp } = session, steps = [];
          for (let begin = true; ; begin = learner.over) {
            const before = begin ? Array.from(learner.Q) : null;
            if (!session.step()) break;
            const { last, episode, over } = learner;
            const e = over ? episode - 1 : episode, entry = last.z * mdp.A + last.a, next = over ? last.next : null;
            steps.push({ e, entry, error: Math.abs(last.tdError), r: last.r, next, before });
          }
          return [plain([Array.from(session.log.tdErrors), Array.from(session.log.coverage)]), steps];
        }""",
        lesson(algorithm=algorithm, episodes=30, alpha=0.25),
    )
    seen, possible = set(), 8 * 99 * 5
    for e, episode in itertools.groupby(steps, key=lambda step: step["e"]):
        played = list(episode)
        seen |= {step["entry"] for step in played}
        errors = [step["error"] for step in played]
        if algorithm == "monte_carlo":  # it learns from the end of the episode, backwards
            Q, G, errors = played[0]["before"], played[-1]["next"], []
            for step in reversed(played):
                G = step["r"] + 0.95 * G
                errors.append(abs(G - Q[step["entry"]]))
                Q[step["entry"]] += 0.25 * (G - Q[step["entry"]])
        assert log[1][e] == len(seen) / possible
        assert log[0][e] == pytest.approx(np.mean(errors), rel=1e-12)
    assert all(error > 0 for error in log[0])


def test_a_band_holds_the_runs_of_the_next_seeds(sc):
    raw = lesson(episodes=40)
    band, early, singles, quantiles = sc(
        """raw => {
          const session = new sc.Session(raw);
          const early = session.bandOf('returns');
          while (session.bandSlice(0, 4));
          const singles = [1, 2, 3, 4].map(k => {
            const other = new sc.Session({ ...raw, seed: raw.seed + k });
            other.run();
            return other.series('returns').y;
          });
          const quantiles = [0, 0.1, 0.33, 0.5, 1].map(q => sc.quantile([3, 1, 2, 10], q));
          return [session.bandOf('returns'), early, singles, quantiles];
        }""",
        raw,
    )
    assert early is None
    assert band["runs"] == 4
    assert band["x"] == list(range(1, 41))
    for name, share in (("low", 0.1), ("median", 0.5), ("high", 0.9)):
        np.testing.assert_allclose(band[name], np.quantile(singles, share, axis=0), rtol=1e-12)
    np.testing.assert_allclose(quantiles, np.quantile([3, 1, 2, 10], [0, 0.1, 0.33, 0.5, 1]), rtol=1e-12)


def test_a_band_keeps_its_runs_when_more_or_fewer_are_wanted(sc):
    counts = sc(
        """raw => {
          const session = new sc.Session(raw), counts = [];
          const all = n => { while (session.bandSlice(50, n)); counts.push(session.bandOf('steps')?.runs ?? 0); };
          all(3); all(2); all(0); all(1); all(5);
          return counts;
        }""",
        lesson(episodes=10),
    )
    assert counts == [3, 2, 0, 0, 5]


# ---------------------------------------------------------------- formula and words
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_the_formula_holds_with_its_numbers(sc, algorithm):
    lines = sc(
        """raw => {
          const session = new sc.Session(raw), lines = [session.formula()];
          for (let i = 0; i < 300; i++) {
            session.step();
            const { learner, mdp } = session;
            const { table } = learner.last;
            lines.push({ ...session.formula(), over: learner.over, goal: mdp.terminal[learner.s], table });
          }
          return plain(lines);
        }""",
        lesson(algorithm=algorithm, alpha=0.25),
    )
    assert lines[0] is None
    notes = set()
    for line in lines[1:]:
        notes.add(line["note"])
        if line["waits"]:
            assert algorithm == "monte_carlo"
            assert not line["over"]
            continue
        of = {token["role"]: token["value"] for token in line["tokens"] if "role" in token}
        target = of["target"] if algorithm == "monte_carlo" else of["reward"] + of["gamma"] * of["next"]
        assert target == line["target"]
        assert line["tdError"] == target - of["before"]
        assert of["after"] == of["before"] + of["alpha"] * (target - of["before"])
        own, other = ("Q₁", "Q₂") if line["table"] == 0 else ("Q₂", "Q₁")
        symbols = {token["role"]: token["symbol"] for token in line["tokens"] if "role" in token}
        if algorithm == "double_q_learning":
            assert symbols["after"] == symbols["before"] == f"{own}(S, A)"
            assert symbols["next"].startswith(other)
        else:
            assert symbols["after"] == "Q(S, A)"
        if line["goal"] and algorithm != "monte_carlo":
            assert of["gamma"] == 0
    assert any("γ is 0" in note for note in notes)


def test_sentences_tell_how_an_episode_ended(sc):
    told = sc(
        """raw => {
          const session = new sc.Session(raw), told = [session.sentence()];
          session.step();
          told.push(session.sentence());
          while (session.step()) if (session.learner.over) {
            const { learner, mdp } = session, e = session.episode - 1;
            const end = mdp.goal[learner.s] ? 'goal' : mdp.terminal[learner.s] ? 'crash' : 'time';
            told.push([session.sentence(), e + 1, learner.steps[e], learner.returns[e], end]);
          }
          return told;
        }""",
        lesson(max_steps=20),
    )
    assert told[0] == "The robot knows nothing yet."
    assert told[1].startswith("Episode 1, step 1: reward ")
    words = {"goal": "reached the goal in", "crash": "crashed after", "time": "without the goal"}
    assert {end for *_, end in told[2:]} == set(words)
    for sentence, episode, steps, total, end in told[2:]:
        assert sentence.startswith(f"Episode {episode}: ")
        assert words[end] in sentence
        assert f" {steps} step" in sentence
        value = sentence.rsplit("return ", 1)[1].removesuffix(".").replace("−", "-")
        assert float(value) == pytest.approx(total, abs=0.00501)


# ---------------------------------------------------------------- driving
def test_driving_by_hand_pays_what_the_model_pays_and_teaches_nothing(sc):
    before, after, drives = sc(
        """raw => {
          const session = new sc.Session(raw), drives = [];
          session.run(100);
          const before = JSON.stringify(look(session)), chance = new rl.Generator(2);
          for (let i = 0; i < 30; i++) {
            session.beginDrive();
            let total = 0;
            while (!session.driving.over) {
              const { s } = session.driving, a = Math.floor(chance.random() * 5);
              session.drive(a);
              const { mdp } = session, places = [0, 1, 2].map(k => (s * 5 + a) * mdp.K + k);
              const paid = places.filter(j => mdp.nextState[j] === session.driving.s).map(j => mdp.reward[j]);
              if (!paid.includes(session.driving.reward)) drives.push('wrong reward');
              total += session.driving.reward;
            }
            const { path, steps, goal, crashed } = session.driving;
            const same = total === session.driving.total;
            drives.push({ steps, goal, crashed, length: path.length, end: path.at(-1), same, more: session.drive(0) });
          }
          return [before, JSON.stringify(look(session)), drives];
        }""",
        lesson(max_steps=12),
    )
    assert before == after
    assert {(drive["goal"], drive["crashed"]) for drive in drives} >= {(False, True), (False, False)}
    for drive in drives:
        assert drive["length"] == drive["steps"] + 1
        assert drive["same"]
        assert not drive["more"]
        assert drive["end"].get("crashed", False) == drive["crashed"]


def test_the_path_of_the_policy_is_a_rollout(sc, floats):
    for i in range(25):
        raw = any_scenario(i)
        path, Q = sc(
            """raw => {
              const session = new sc.Session(raw);
              session.run();
              return [session.greedyPath(), bits(session.learner.Q)];
            }""",
            raw,
        )
        task = _scenario.task_of(raw)
        mdp = task.mdp()
        pi = rl.greedy(floats(Q).reshape(-1, mdp.A))[task.phi()]
        ours = rl.rollout(mdp, pi, start=int(mdp.start[0]), max_steps=raw["max_steps"], rng=0)
        poses = [task.pose(int(s)) for s in ours.states]
        assert path["steps"] == ours.actions.size
        assert path["total"] == pytest.approx(ours.rewards.sum(), rel=1e-12, abs=1e-12)
        assert path["crashed"] == (poses[-1] is None)
        shown = [(p["x"], p["y"], p["theta"]) for p in path["poses"]]
        assert shown[: len(poses) - 1] == [(p.x, p.y, p.theta) for p in poses[:-1]]
        if path["crashed"]:
            x, y, _ = shown[-1]
            assert task.world.crash(poses[-2].x, poses[-2].y, x, y)


# ---------------------------------------------------------------- compare and carry over
def test_a_pinned_moment_stays_what_it_was(sc):
    pinned, later, frozen = sc(
        """raw => {
          const session = new sc.Session(raw);
          session.run(500);
          const pinned = session.pin(), before = JSON.stringify(pinned);
          session.run();
          return [JSON.parse(before), JSON.parse(JSON.stringify(pinned)), Object.isFrozen(pinned)];
        }""",
        lesson(),
    )
    assert pinned == later
    assert frozen
    assert pinned["updates"] == pinned["evaluation"]["updates"] == 500
    assert set(pinned["series"]) == set(METRICS)
    assert len(pinned["path"]) > 1


def test_a_table_is_carried_to_another_map(sc, floats):
    raw = lesson(features=[["goal_bearing", 8], "moves_ahead"], episodes=800, slip=0)
    for preset in ("obstacles", "rooms", "cliff"):
        scores, path, Q = sc(
            """([raw, preset]) => {
              const session = new sc.Session(raw);
              session.run();
              const carried = session.carryTo({ ...sc.PRESETS[preset] });
              while (carried.slice(0));
              return [carried.evaluation, carried.path, bits(session.learner.Q)];
            }""",
            [raw, preset],
        )
        world = rl.GridWorld.from_ascii(getattr(rl.maps, preset.upper()))
        there = _scenario.task_of(raw)
        task = rl.Task(world, there.robot, there.reward, there.features, there.gamma)
        mdp = task.mdp()
        pi = rl.greedy(floats(Q).reshape(-1, mdp.A))[task.phi()]
        ours = rl.evaluate(mdp, pi, max_steps=raw["max_steps"])
        for name in ("success", "crash", "timeout", "steps", "value", "optimal"):
            assert scores[name] == pytest.approx(getattr(ours, name), abs=1e-7)
        episode = rl.rollout(mdp, pi, start=int(mdp.start[0]), max_steps=raw["max_steps"], rng=0)
        assert path["steps"] == episode.actions.size


@pytest.mark.parametrize(
    ("features", "preset", "words"),
    [
        (None, "obstacles", "Choose features"),
        (["cell", "heading"], "rooms", "Choose features"),
        (["heading"], None, "Remove an obstacle"),
    ],
)
def test_a_table_that_does_not_fit_says_so(sc, features, preset, words):
    message = sc(
        """([raw, preset]) => {
          const walled = { map: ['...#G', '...##', '.....', '.....'], starts: null };
          try { new sc.Session(raw).carryTo(preset ? sc.PRESETS[preset] : walled); return ''; }
          catch (error) { return error.message; }
        }""",
        [lesson(features=features), preset],
    )
    assert words in message


# ---------------------------------------------------------------- what Python sends
def test_a_model_from_python_is_learned_like_any_other(sc, floats):
    """An own reward and own features: the table of the browser is that of Python, to the last bit."""
    task = rl.Task(
        rl.GridWorld.from_ascii(rl.maps.OBSTACLES),
        rl.Robot(slip=0.1),
        reward=lambda t: 5.0 if t.goal else -1.0 if t.crash else -0.05 * t.s_next.y,
        features=lambda pose: 3 * (pose.x // 3) + pose.theta // 135,
    )
    simulator = Simulator(task, episodes=200, algorithm="sarsa")
    Q, own, evaluated = sc(
        """([raw, tables]) => {
          const session = new sc.Session(raw, { tables });
          session.run();
          while (session.evaluateSlice(5));
          return [bits(session.learner.Q), session.own, session.evaluation.success];
        }""",
        [simulator.scenario, simulator.tables],
    )
    run = simulator.train()
    assert (floats(Q) + 0.0).tobytes() == (run.Q.ravel() + 0.0).tobytes()
    assert own == ["features", "reward"]
    assert evaluated == pytest.approx(rl.evaluate(task.mdp(), run.pi[task.phi()]).success, abs=1e-9)


def test_a_run_of_python_is_played_table_by_table(sc, floats):
    task = rl.Task(rl.GridWorld.from_ascii(rl.maps.FREE_SPACE))
    run = rl.q_learning(task.mdp(), episodes=90, rng=3, snapshots=6)
    simulator = Simulator(task, training=run)
    tables, states, series, words, again = sc(
        """([raw, training]) => {
          const session = new sc.Session(raw, { training }), tables = [], states = [];
          const note = () => {
            tables.push(bits(session.learner.Q));
            states.push([session.updates, session.episode, session.episodes, session.done]);
          };
          note();
          while (session.step()) note();
          const series = ['returns', 'tdErrors'].map(metric => session.series(metric));
          const words = [session.sentence(), session.formula(), session.isPlayback, session.note];
          session.visitsPerPose(); session.turnsPerPose(); session.errorPerPose(); session.greedyPath();
          while (session.evaluateSlice(5));
          session.pin();
          session.backEpisode();
          const back = session.episode;
          session.reset();
          const begin = session.updates;
          session.runFor(5);
          const again = [back, begin, session.episode, session.bandSlice(5, 3), session.robot.crashed];
          return [tables, states, series, words, again];
        }""",
        [simulator.scenario, simulator.training],
    )
    assert not floats(tables[0]).any()
    for table, snapshot in zip(tables[1:], run.snapshots, strict=True):
        np.testing.assert_array_equal(floats(table), snapshot.astype(np.float32).ravel())
    ends = [0, *run.snapshot_episodes.tolist()]
    assert states == [[int(run.steps[:e].sum()), e, 90, e == 90] for e in ends]
    assert series[0]["x"][-1] == 90
    assert series[1] is None
    assert words[0].startswith("Episode 90: ")
    assert words[1:] == [None, True, ""]
    assert again == [75, 0, 15, False, False]


def test_a_run_of_another_table_gives_way_to_a_new_one(sc):
    task = rl.Task(rl.GridWorld.from_ascii(rl.maps.FREE_SPACE))
    simulator = Simulator(task, training=rl.q_learning(task.mdp(), episodes=9, rng=3, snapshots=3))
    other = sc(
        """([raw, training]) => {
          const session = new sc.Session({ ...raw, ...sc.PRESETS.maze }, { training });
          session.step();
          return [session.isPlayback, session.note, session.updates];
        }""",
        [simulator.scenario, simulator.training],
    )
    assert other[0] is False
    assert "another table" in other[1]
    assert other[2] == 1


def test_a_new_session_leaves_no_trace_in_the_scenario(sc):
    raw = any_scenario(7)
    assert same(
        sc(
            """raw => {
              const session = new sc.Session(raw);
              session.run();
              session.pin();
              return session.scenario;
            }""",
            raw,
        ),
        raw,
    )
