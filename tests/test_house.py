"""The library as a house: what loads when, where it can live, and that its documentation is complete."""

import ast
import importlib
import inspect
import json
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from numpydoc.docscrape import NumpyDocString

import rlnav as rl
from rlnav import _compile

needs_numba = pytest.mark.skipif(_compile.njit is None, reason="without numba there is no machine code to keep")

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "rlnav"
CITED = re.compile(r":eq:`([\w-]+)`")


def python(program, *options, cwd=ROOT, env=None):
    """Run a program in a fresh Python where warnings are errors; return what it prints."""
    command = [sys.executable, "-W", "error", *options, "-c", program]
    run = subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, timeout=300)
    assert run.returncode == 0, run.stderr
    return run.stdout


# ---------------------------------------------------------------- what loads when
@pytest.mark.parametrize(
    ("program", "loaded"),
    [
        ("import rlnav", set()),
        ("import rlnav as rl; rl.Robot(); rl.GridWorld.from_ascii('S.G')", {"numpy"}),
        ("import rlnav as rl; rl.Task(rl.GridWorld.from_ascii('S.G')).mdp()", {"numpy"}),
        ("import rlnav as rl; rl.solve", {"numpy", "numba", "scipy"}),  # SciPy because numba looks for it
    ],
)
def test_a_name_loads_only_what_it_needs(program, loaded):
    heavy = ["numpy", "numba", "matplotlib", "gymnasium", "ipywidgets", "anywidget", "IPython", "scipy"]
    asked = f"import sys, json; print(json.dumps([name for name in {heavy} if name in sys.modules]))"
    assert set(json.loads(python(f"{program}\n{asked}"))) <= loaded


def test_the_public_list_is_what_a_type_checker_sees():
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    assert ast.unparse(block.test) == "TYPE_CHECKING"
    seen = [alias.name for node in block.body for alias in node.names]
    assert sorted(seen) == sorted(rl.__all__)
    assert len(set(rl.__all__)) == len(rl.__all__)


def test_every_public_name_is_found_and_listed():
    for name in rl.__all__:
        assert getattr(rl, name) is not None
        assert name in dir(rl)
    with pytest.raises(AttributeError, match="no attribute 'value_itteration'"):
        _ = rl.value_itteration


def test_every_public_name_lives_where_a_type_checker_looks_for_it():
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    (block,) = [node for node in tree.body if isinstance(node, ast.If)]
    for node in block.body:
        for alias in node.names if node.module else ():
            home = importlib.import_module(f"rlnav.{node.module}")
            assert getattr(rl, alias.name) is getattr(home, alias.name)


# ---------------------------------------------------------------- where it can live
LEARN_A_LITTLE = """
import numpy as np, rlnav as rl
mdp = rl.Task(rl.GridWorld.from_ascii(">.G")).mdp()
print(rl.__file__)
print(rl.solve(mdp).V[0], float(rl.q_learning(mdp, episodes=20, rng=0).Q.sum()).hex())
"""


NO_CACHE = """
from numba.core.caching import NullCache
from rlnav import learning
assert isinstance(learning._q_learning._cache, NullCache), "numba found a folder for its machine code"
"""


@pytest.fixture
def read_only_copy(tmp_path):
    """A copy of the package that nobody can write to; root could, but a file is where the cache folder would be."""
    package = tmp_path / "rlnav"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "__pycache__").touch()
    parts = [package, *package.rglob("*")]
    for path in parts:
        path.chmod(0o555 if path.is_dir() else 0o444)
    yield package
    for path in parts:
        path.chmod(0o755)


@pytest.mark.parametrize("also", ["", pytest.param(NO_CACHE, marks=needs_numba)], ids=["answers", "no cache"])
def test_a_read_only_installation_without_any_cache_folder_works(read_only_copy, also):
    env = {name: value for name, value in os.environ.items() if not name.startswith(("NUMBA_", "PYTHON", "XDG_"))}
    env |= {"HOME": "/dev/null", "PYTHONPATH": str(read_only_copy.parent)}  # no folder can be made below /dev/null
    answer = python(LEARN_A_LITTLE + also, cwd=read_only_copy.parent, env=env)
    place, *numbers = answer.splitlines()
    assert Path(place).parent == read_only_copy
    assert numbers == python(LEARN_A_LITTLE).splitlines()[1:]


def test_the_library_runs_without_numba_and_without_figures():
    without = "import sys\nfor name in ('numba', 'matplotlib', 'gymnasium', 'ipywidgets'): sys.modules[name] = None\n"
    assert python(without + LEARN_A_LITTLE).splitlines()[1:] == python(LEARN_A_LITTLE).splitlines()[1:]


@pytest.mark.parametrize(("module", "package"), [("env", "gymnasium"), ("widgets", "anywidget")])
def test_what_is_missing_is_named_with_the_way_to_get_it(module, package):
    program = (
        f"import sys; sys.modules['{package}'] = None\nimport rlnav as rl\n"
        f"try: rl.{module}\nexcept ImportError as error: print(error)"
    )
    assert f"pip install 'rlnav[{module}]'" in python(program)


# ---------------------------------------------------------------- size
def modules():
    """Every module of the library below the widgets, with its name."""
    for found in pkgutil.walk_packages(rl.__path__, "rlnav."):
        if not found.name.startswith("rlnav.widgets"):
            yield found.name, importlib.import_module(found.name)


MODULES = dict(modules())


def code_lines(node, text):
    """The lines of a syntax tree that hold code: neither blank, nor comment, nor docstring."""
    strings = set()
    for part in ast.walk(node):
        match getattr(part, "body", None):
            case [ast.Expr(value=ast.Constant()) as text_of, *_]:
                strings |= set(range(text_of.lineno, text_of.end_lineno + 1))
    first, last = getattr(node, "lineno", 1), getattr(node, "end_lineno", len(text))
    kept = [line for i, line in enumerate(text[first - 1 : last], first) if i not in strings]
    return sum(bool(line.strip()) and not line.strip().startswith("#") for line in kept)


@pytest.mark.parametrize("name", MODULES)
def test_modules_and_functions_are_short(name):
    text = inspect.getsource(MODULES[name])
    tree, lines = ast.parse(text), text.splitlines()
    assert code_lines(tree, lines) <= 250
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            assert code_lines(node, lines) <= 40, node.name


# ---------------------------------------------------------------- documentation
def documented():
    """The public functions and classes, and the public methods of these classes, each under its full name."""
    modules = [getattr(rl, name) for name in ("maps", "designs", "plot", "env")]
    found = [(rl, name) for name in rl.__all__] + [(place, name) for place in modules for name in vars(place)]
    for place, thing in ((place, getattr(place, name)) for place, name in found if name[0] != "_"):
        own = inspect.isroutine(thing) or inspect.isclass(thing)
        if own and (place is rl or thing.__module__.startswith(place.__name__)):
            yield f"{thing.__module__}.{thing.__qualname__}", thing
            yield from methods(thing)


def methods(thing):
    """The public methods and properties that a class defines itself."""
    for name, method in vars(thing).items() if inspect.isclass(thing) else ():
        function = getattr(method, "__func__", getattr(method, "fget", method))
        if name[0] != "_" and inspect.isfunction(function):
            yield f"{function.__module__}.{function.__qualname__}", function


DOCUMENTED = dict(documented())
PUBLIC = {name: thing for name, thing in DOCUMENTED.items() if getattr(rl, thing.__name__, None) is thing}


def summary_and_text(thing):
    """The first line of a docstring, and all of it in one line."""
    text = inspect.getdoc(thing) or ""
    return text.split("\n\n")[0], " ".join(text.split())


def described(thing):
    """The names that the sections on parameters and attributes describe."""
    doc = NumpyDocString(inspect.getdoc(thing))
    return {name.strip() for entry in (*doc["Parameters"], *doc["Attributes"]) for name in entry.name.split(",")}


def test_the_documented_names_are_all_of_them():
    assert {"rlnav.mdp.MDP", "rlnav.task.Task.phi", "rlnav.designs.heading", "rlnav.maps.random"} <= DOCUMENTED.keys()
    assert {"rlnav.env.to_mdp", "rlnav.env.GridRobotEnv.step", "rlnav._training.Training"} <= DOCUMENTED.keys()
    assert rl.plot.values in DOCUMENTED.values()


@pytest.mark.parametrize("name", DOCUMENTED)
def test_every_public_name_begins_with_one_clear_line(name):
    summary, _ = summary_and_text(DOCUMENTED[name])
    assert summary
    assert "\n" not in summary
    assert re.search(r"[.?]$|:eq:", summary)


@pytest.mark.parametrize("name", PUBLIC)
def test_every_parameter_is_described(name):
    thing = PUBLIC[name]
    _, text = summary_and_text(thing)
    parameters = inspect.signature(thing).parameters
    like = re.search(r"Parameters, result and errors are those of `(\w+)`", text)
    if like:
        assert parameters.keys() == inspect.signature(getattr(rl, like[1])).parameters.keys()
    elif name.endswith("_rule"):  # a rule's arguments are described where rules are explained
        assert all(parameter in rl.learn.__doc__ for parameter in parameters)
    else:
        assert parameters.keys() <= described(thing)


@pytest.mark.parametrize("name", sorted(DOCUMENTED.keys() - PUBLIC.keys()))
def test_what_is_described_about_parameters_is_complete(name):
    thing = DOCUMENTED[name]
    sections = described(thing)
    if sections and inspect.isfunction(thing):
        assert inspect.signature(thing).parameters.keys() - {"self", "cls"} <= sections


def test_public_functions_show_an_example():
    for name, thing in PUBLIC.items():
        _, text = summary_and_text(thing)
        elsewhere = "are those of `" in text  # of a function that shows one
        planner = thing in (rl.policy_iteration, rl.solve)  # called like value_iteration, which shows one
        rule = thing in (rl.q_learning_rule, rl.sarsa_rule)  # `learn` shows how a rule is used
        result = thing.__name__ in (
            "Episode",
            "Evaluation",
            "Prediction",
            "Solution",
            "Training",
            "Transition",
        )  # made by functions
        assert ">>>" in text or elsewhere or planner or rule or result, name


def book_labels():
    """The labels of all equations of the book, in its notebooks and in its pages of text."""
    text = [page.read_text(encoding="utf-8") for page in (ROOT / "book").glob("*.md")]
    for notebook in (ROOT / "book").glob("*.ipynb"):
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        text += ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
    page = "\n".join(text)
    labels = re.findall(r"^:label:\s*([\w-]+)\s*$", page, re.MULTILINE)  # ```{math} directives
    labels += re.findall(r"\$\$\s*\(([\w-]+)\)", page)  # $$ ... $$ (label)
    labels += re.findall(r"\\label\{([\w-]+)\}", page)
    return labels


def test_every_equation_that_the_library_cites_stands_in_the_book():
    cited = {
        label: path.relative_to(ROOT)
        for path in PACKAGE.rglob("*.py")
        for label in CITED.findall(path.read_text(encoding="utf-8"))
    }
    labels = set(book_labels())
    assert len(cited) > 10
    assert {label: str(path) for label, path in cited.items() if label not in labels} == {}


def test_no_equation_has_two_places():
    labels = book_labels()
    assert sorted(labels) == sorted(set(labels))
