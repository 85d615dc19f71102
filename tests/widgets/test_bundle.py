"""Small modules become one text that does the same; what cannot be joined is refused in plain words."""

import re
import subprocess
import sys
import zipfile
from importlib.resources import files
from pathlib import Path

import pytest

from explorables import minified
from rlnav.widgets import _modules
from rlnav.widgets._bundle import join, module, programs, script, stylesheet
from rlnav.widgets._modules import parse, squeezed

ROOT = Path(__file__).parents[2]
JS = ROOT / "rlnav" / "js"
PATHS = sorted(str(path.relative_to(JS)) for path in JS.rglob("*.js"))
ENTRIES = [path.removesuffix(".js") for path in PATHS if "\nexport function start(" in (JS / path).read_text()]

# what a reckless squeezer would break: comments in texts, texts in templates in templates, lines that matter
TRICKY = r"""
/** A comment with `quotes", and 'more'. */
export const texts = ["// no comment", '/* none */', "it's", 'say "x"', "\\", 'a\'b']; // one
export const pattern = /[/"'`]\/\/ \/\* {/g;
export const divided = (8 / 2) / 2; // not a /pattern/
export const template = `  two lines:
    // kept ${[1, 2].map((n) => `<${n > 1 ? "it's {" : /}/.source}>`).join("`")} ${{ a: 1 }.a}
  /* kept */`;
export function empty() {
  return /* nothing follows
  */ 5;
}
export function three() {
  let x = 1
  ;[2].forEach((n) => { x += n })
  return x
}
export class Both { static two = 2; #own = 1; get one() { return this.#own / 1; } }
export async function later() { return `${await 1}`; }
export function* counting() { yield* [1, 2]; }
const hidden = 1;
export const price$ = hidden;
"""
SAME = """async ([tricky, joined]) => {
  const load = text => import(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
  const seen = async m => JSON.stringify([m.texts, m.pattern.source, m.divided, m.template, m.empty() ?? 'nothing',
    m.three(), m.Both.two, new m.Both().one, await m.later(), [...m.counting()], m.price$, Object.keys(m).sort()]);
  return [await seen(await load(tricky)), await seen((await load(joined)).default)];
}"""


def as_module(*paths):
    """The joined modules as one, whose default export holds all of theirs by name."""
    code, exports = join(*paths)
    names = ", ".join(f"{name}: {place}" for places in exports.values() for name, place in places.items())
    return f"{code}export default {{ {names} }};\n"


@pytest.fixture
def page(browser):
    context = browser.new_context()
    yield context.new_page()
    context.close()


def test_tricky_code_means_the_same_when_it_is_joined(program, page):
    program("tricky.js", TRICKY)
    before, after = page.evaluate(SAME, [TRICKY, as_module("tricky.js")])
    assert after == before
    assert "kept" in before


def test_comments_and_indentation_are_left_out(program):
    program("tricky.js", TRICKY)
    code = parse("tricky.js").code
    assert "A comment" not in code
    assert "// one" not in code
    assert len(code.splitlines()) < len(TRICKY.splitlines())
    assert squeezed(code) == code


def test_modules_come_after_those_that_they_import_and_only_once(program):
    program(
        "a.js", 'import { b } from "./deep/b.js";\nimport { c as other } from "./c.js";\nexport const a = b + other;\n'
    )
    program("deep/b.js", 'import {\n  c,\n} from "../c.js";\nexport const b = c;\n')
    program("c.js", "export const c = 1;\n")
    code, exports = join("a.js", "deep/b.js")
    assert list(exports) == ["c.js", "deep/b.js", "a.js"]
    assert code.count("const c = 1;") == 1


def test_names_of_one_module_are_not_seen_by_another(program, page):
    program("a.js", 'import { b } from "./b.js";\nconst own = 1;\nexport const a = [own, b];\n')
    program("b.js", "const own = 2;\nexport const b = own;\n")
    code, exports = join("a.js")
    assert page.evaluate(f"() => {{ {code} return {exports['a.js']['a']}; }}") == [1, 2]


FORMS = "`a.js` must be a module with no other forms than"
REFUSED = {
    'import { x } from "./gone.js";\n': "`import in a.js` must be of a file in rlnav/js; got 'gone.js'.",
    'import { x } from "../../secret.js";\n': "`import in a.js` must be of a file in rlnav/js",
    'import { x } from "./b.js";\n': "`import in a.js` must be of a name that b.js exports; got 'x'.",
    'import { c } from "./c.js";\n': "modules that do not need each other; got a.js -> c.js -> a.js.",
    'import * as b from "./b.js";\n': f"{FORMS}.*got 'import \\* as b",
    'import b from "./b.js";\n': f"{FORMS}.*got 'import b",
    'import "./b.js";\n': f"{FORMS}.*got 'import",
    'import { b } from "three";\n': f"{FORMS}.*got 'import",
    "const b = await import(`./b.js`);\n": f"{FORMS}.*got 'import\\('",
    "const b = await import(name);\n": f"{FORMS}.*got 'import\\('",
    "const here = import.meta.url;\n": f"{FORMS}.*got 'import\\.'",
    "export default 1;\n": f"{FORMS}.*got 'export default",
    "export let b = 1;\n": f"{FORMS}.*got 'export let",
    "const b = 1;\nexport { b };\n": f"{FORMS}.*got 'export {{ b }}",
    'export * from "./b.js";\n': f"{FORMS}.*got 'export \\*",
    "export const { b } = {};\n": f"{FORMS}.*got 'export const",
    "const b = `never ends;\n": "`module` must be a text whose quotes",
    'const b = "never ends;\n': "`module` must be a text whose quotes",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_cannot_be_joined_is_refused_with_the_place(program, text):
    program("b.js", "export const b = 1;\n")
    program("c.js", 'import { a } from "./a.js";\nexport const c = 1;\n')
    program("a.js", f"/** A module. */\n{text}export const a = 1;\n")
    with pytest.raises(ValueError, match=REFUSED[text]):
        join("a.js")


def test_words_in_texts_are_no_imports(program):
    program("a.js", 'export const a = `\nimport x from "y";\nexport default` + "import(" + \'export let\';\n')
    assert "export default`" in parse("a.js").code


def test_an_entry_must_have_a_start(program):
    program("explorables/none.js", "export const begin = 1;\n")
    with pytest.raises(ValueError, match=r"`explorables/none.js` must be a module that exports `start`; got begin\."):
        module("explorables/none")


def test_the_style_is_that_of_the_views_of_the_folder_and_of_the_modules(program):
    program("part/entry.js", 'import { part } from "./beside.js";\nexport function start() { part(); }\n')
    program("part/beside.js", "export function part() {}\n")
    program("views/views.css", '/* all */\n.a::after {\n  content: "/* kept */";\n}\n')
    program("part/part.css", ".b {}\n")
    program("part/beside.css", ".c {}\n")
    program("part/entry.css", ".d {}\n")
    program("part/other.css", ".e {}\n")
    assert stylesheet("part/entry") == '.a::after {\ncontent: "/* kept */";\n}\n.b {}\n.c {}\n.d {}\n'


WITH_A_PART = {
    "views/stage.js": "export function open(model, el, start) { return start(model); }\n",
    "both.js": "export const count = [0];\nexport const unused = 1;\n",
    "deep/entry.js": 'import { count } from "../both.js";\n'
    "export async function start(model) {\n"
    "  count[0] += 1;\n"
    '  const { more } = await import("./part.js");\n'
    "  return more(model);\n"
    "}\n",
    "deep/part.js": 'import { count } from "../both.js";\nimport { own } from "./own.js";\n'
    "export const more = (model) => [model, count[0], own];\n",
    "deep/own.js": "export const own = 'own';\n",
}


def test_a_part_is_in_the_module_but_a_script_of_its_own_and_shares_what_both_import(program, page):
    for path, text in WITH_A_PART.items():
        program(path, text)
    load = "text => import(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })))"
    rendered = "({ render }) => render({ model: 'm', el: null })"
    assert page.evaluate(f"async text => ({rendered})((await ({load})(text)).default)", module("deep/entry")) == [
        "m",
        1,
        "own",
    ]
    scripts = programs("deep/entry")
    assert list(scripts) == ["deep/entry.js", "deep/part.js", "deep/entry.css"]
    assert "'own'" not in scripts["deep/entry.js"]
    assert "count = [0]" not in scripts["deep/part.js"]
    page.add_script_tag(content="window.rlnavExplorables = {}; window.asked = [];")
    for name in ("deep/entry.js", "deep/part.js"):
        page.add_script_tag(content=minified(scripts[name]))
    page.evaluate("() => { rlnavExplorables.part = async n => { asked.push(n); return rlnavExplorables[n]; }; }")
    assert page.evaluate(f"() => ({rendered})(rlnavExplorables['deep/entry'])") == ["m", 1, "own"]
    assert page.evaluate("asked") == ["deep/part.js"]


# ---------------------------------------------------------------- the modules of the package
@pytest.mark.parametrize("path", PATHS)
def test_every_module_can_be_joined(path):
    code, exports = join(path)
    assert list(exports)[-1] == path
    assert code.count("(() => {\n") >= len(exports)


@pytest.mark.parametrize("entry", ENTRIES)
def test_every_entry_starts_in_both_forms(page, entry):
    load = "text => import(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })))"
    assert page.evaluate(f"async text => Object.keys((await ({load})(text)).default)", module(entry)) == ["render"]
    page.add_script_tag(content=script(entry))
    assert page.evaluate("entry => typeof rlnavExplorables[entry].render", entry) == "function"
    assert not re.search(r"^\s*//", script(entry), re.MULTILINE)


def test_all_the_browser_needs_is_in_the_wheel(tmp_path):
    """Built offline, as `pip install` builds it."""
    build = "from hatchling.build import build_wheel; import sys; print(build_wheel(sys.argv[1]))"
    run = subprocess.run([sys.executable, "-c", build, tmp_path], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    (wheel,) = tmp_path.glob("*.whl")
    packed = set(zipfile.ZipFile(wheel).namelist())
    wanted = {f"rlnav/js/{path.relative_to(JS)}" for path in JS.rglob("*") if path.suffix in (".js", ".css")}
    assert len(wanted) > 20
    assert wanted <= packed
    assert files("rlnav").joinpath("js", "task.js").is_file()
    assert _modules.HOME.is_dir()
