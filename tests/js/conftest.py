"""The browser's engine, loaded into a real Chromium, beside the library that it has to equal bit for bit."""

import base64
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import browsing

ENGINE = Path(__file__).parents[2] / "rlnav" / "js"
MODULES = sorted(path.name for path in ENGINE.glob("*.js"))
LOAD = """async modules => {
  window.rl = Object.assign({}, ...await Promise.all(modules.map(name => import(`/${name}`))));
  // the memory of a typed array, so that not one bit is lost on the way
  window.bits = array => {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(''));
  };
  window.error = attempt => {
    try { return `no error, but ${attempt()}`; } catch (error) { return `${error.name}: ${error.message}`; }
  };
  window.policyOf = pi => pi.probabilities ? Float64Array.from(pi.probabilities) : pi;
  window.worldOf = ({drawing}) => rl.GridWorld.fromAscii(drawing);
  window.rewardOf = ({payment, progress, shaping, gamma}, world) => {
    const rewards = [rl.payment(payment)];
    if (progress) rewards.push(rl.progress(world.goal, progress));
    const reward = rewards.length > 1 ? rl.total(...rewards) : rewards[0];
    return shaping ? rl.shaped(reward, rl.nearness(world.goal), gamma) : reward;
  };
  window.taskOf = spec => {
    const world = worldOf(spec);
    const features = spec.features && spec.features.map(([name, ...given]) => rl[name](...given));
    const robot = new rl.Robot({steering: spec.steering, slip: spec.slip});
    return new rl.Task(world, {robot, reward: rewardOf(spec, world), features, gamma: spec.gamma});
  };
}"""


class Engine:
    """A page in which the engine's modules are loaded as `rl`."""

    def __init__(self, page):
        self.page = page
        page.evaluate(LOAD, MODULES)

    def __call__(self, function, argument=None):
        """Run a JavaScript function in the page."""
        return self.page.evaluate(function, argument)


@contextmanager
def opened(browser, folder=ENGINE):
    """Load the engine in a folder; any complaint of the browser is an error."""
    with browsing.served(folder) as address, browsing.visit(browser, address) as visit:
        yield Engine(visit.page)
        assert visit.complaints == []


@pytest.fixture(scope="module")
def browser():
    with browsing.launched() as browser:
        yield browser


@pytest.fixture(scope="module")
def engine(browser):
    with opened(browser) as engine:
        yield engine


@pytest.fixture
def engine_in(browser):
    """Load the engine that lies in another folder."""
    return lambda folder: opened(browser, folder)


@pytest.fixture(scope="session")
def floats():
    """Read numbers that the page has given as bits."""
    return lambda text: np.frombuffer(base64.b64decode(text), np.float64)
