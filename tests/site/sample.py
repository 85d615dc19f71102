"""A chapter made for the tests: one of everything that a chapter may contain, with outputs as a kernel stores them."""

import io
from textwrap import dedent
from urllib.parse import quote

import matplotlib.figure
import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

import rlnav

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
WIDGET_STATE = "application/vnd.jupyter.widget-state+json"

OPENING = r"""
    # A chapter with everything

    :::{admonition} After this chapter you can
    :class: outcomes

    - say what a sweep is and what it costs,
    - tell **terminated** from *truncated*,
    - read $V_{k+1}(s) = \max_a q_k(s, a)$ aloud.

    25 minutes · before this: {ref}`sample-other`
    :::

    :::{admonition} The question
    :class: question

    How long does the robot need to see a reward that is $k$ steps away?
    :::

    ## Mathematics

    The value of a state is $v_*(s) = \max_a q_*(s, a)$ {cite}`sutton2018reinforcement`, by equation {eq}`eq-sample`:

    ```{math}
    :label: eq-sample
    v_*(s) = \max_a \Big[ r(s,a) + \gamma \sum_{s'} p(s' \mid s, a)\, v_*(s') \Big]
    ```

    A formula wider than a telephone scrolls inside itself:

    $$
    G_t = R_{t+1} + \gamma R_{t+2} + \gamma^2 R_{t+3} + \gamma^3 R_{t+4} + \gamma^4 R_{t+5} + \gamma^5 R_{t+6} +
          \gamma^6 R_{t+7} + \gamma^7 R_{t+8} + \dots = \sum_{k=0}^{\infty} \gamma^k R_{t+k+1}
    $$ (eq-wide)

    :::{prf:theorem} Contraction
    :label: sample-contraction

    $\lVert T v - T w \rVert_\infty \le \gamma \lVert v - w \rVert_\infty$ {cite:p}`puterman1994markov`.
    :::

    :::{prf:proof}
    A maximum of affine functions with slopes below $\gamma$.
    :::

    | symbol | Python | unit | meaning, with enough words to make this table wider than a telephone is |
    |---|---|---|---|
    | $\gamma$ | `gamma` | none | the discount, which makes a reward later worth less than the same reward now |
    | $\theta$ | `theta` | degrees | the heading, counter-clockwise from east, always one of the eight multiples of 45 |

    ## Results
"""

CLOSING = r"""
    ## Try it

    Theorem {prf:ref}`sample-contraction` needed {glue:text}`sample-sweeps` sweeps; see {numref}`fig-sample`.

    :::{quickcheck} Does the best policy change when every reward $r$ doubles?

    - [ ] Yes, $v_*$ is larger. :: It is, by the *same factor* $2$ everywhere:
      what was best stays best.
    - [x] No. :: Every return doubles, so $\operatorname{argmax}$ stays.
    - [ ] Only if $\gamma < 1$. :: The discount has nothing to do with it.

    :::

    :::{admonition} Break it
    :class: break-it

    Bootstrap from a terminal state, and the mean value rises from 0.88 to 1.51.
    :::

    :::{exercise} Count the sweeps
    :label: sample-exercise

    How many sweeps are needed for $\gamma = 0.9$?

    ```{dropdown} Hint 1
    Which states change in the first sweep?
    ```

    ```{dropdown} Hint 2
    The news travels one cell a sweep.
    ```
    :::

    :::{solution} sample-exercise
    :class: dropdown

    As many as the longest shortest path: $k = 14$.
    :::
"""

OTHER = """
    (sample-other)=
    # The other page

    It is here to be linked to: {prf:ref}`sample-contraction`, {eq}`eq-sample`, {eq}`eq-wide`,
    {ref}`the exercise <sample-exercise>`.
"""


def figure() -> str:
    """Draw a figure as SVG on a transparent ground, as the chapters do."""
    drawing = matplotlib.figure.Figure(figsize=(6, 3.2), layout="constrained")
    axes = drawing.subplots()
    axes.plot(range(10), [0.9**k for k in range(10)], marker="o", label="bound")
    axes.set(xlabel="sweep", ylabel="largest change")
    axes.legend()
    text = io.StringIO()
    drawing.savefig(text, format="svg", transparent=True)
    return text.getvalue()


def cell(source: str, outputs: list, **metadata: object) -> nbformat.NotebookNode:
    """Return a code cell that has been run."""
    return new_code_cell(source, execution_count=1, metadata=metadata, outputs=outputs)


def result(**data: object) -> nbformat.NotebookNode:
    """Return what a cell shows, in several forms; `__` and `___` in a name stand for `/` and `+`."""
    forms = {name.replace("___", "+").replace("__", "/"): content for name, content in data.items()}
    return new_output("display_data", data=forms)


def glued(name: str, text: str) -> nbformat.NotebookNode:
    """Return a value that the prose quotes."""
    prefix = "application/papermill.record/"
    return new_output(
        "display_data",
        data={f"{prefix}text/plain": text},
        metadata={"scrapbook": {"mime_prefix": prefix, "name": name}},
    )


def explorable() -> str:
    """Return an explorable as a chapter stores it."""
    task = rlnav.Task(rlnav.GridWorld.from_ascii(">..G"))
    return rlnav.widgets.LoopDebugger(task).html()


def notebook() -> nbformat.NotebookNode:
    """Return the chapter, with the state of a slider in its metadata as nbclient stores it."""
    svg = figure()
    controls = {"model_id": "m1", "version_major": 2, "version_minor": 0}
    live_svg = new_output(
        "display_data", data={WIDGET_VIEW: controls, "image/svg+xml": svg, "text/plain": "Live(gamma=0.9)"}
    )
    live_html = new_output(
        "display_data",
        data={
            WIDGET_VIEW: controls,
            "text/html": f'<figure class="rl-live"><img src="data:image/svg+xml,{quote(svg)}" alt="The bound falls.">'
            "<figcaption>gamma 0.9. Run this notebook to move the controls.</figcaption></figure>",
            "text/plain": "Live(gamma=0.9)",
        },
    )
    table = "<table border='1'><tr>" + "<th>sweep</th>" * 20 + "</tr><tr>" + "<td>0.123456</td>" * 20 + "</tr></table>"
    described = {"image": {"alt": "The largest change falls by the factor 0.9 each sweep."}}
    cells = [
        new_markdown_cell(dedent(OPENING)),
        cell(
            "rl.plot.residuals(best)",
            [result(image__svg___xml=svg, text__plain="<Axes>")],
            mystnb={**described, "figure": {"caption": "The largest change, by sweep.", "name": "fig-sample"}},
        ),
        cell("Live(draw, controls)", [live_svg], mystnb=described),
        cell("Live(draw_in_html, controls)", [live_html]),
        cell("rl.widgets.LoopDebugger(task)", [result(text__html=explorable(), text__plain="LoopDebugger")]),
        cell("print(best)", [new_output("stream", text="sweep " + "0123456789 " * 20 + "\n")]),
        cell("table", [result(text__html=table, text__plain="table")]),
        cell('glue("sample-sweeps", 14)', [glued("sample-sweeps", "14")]),
        new_markdown_cell(dedent(CLOSING)),
    ]
    state = {"m1": {"model_name": "VBoxModel", "model_module": "@jupyter-widgets/controls", "state": {}}}
    widgets = {WIDGET_STATE: {"state": state, "version_major": 2, "version_minor": 0}}
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return new_notebook(cells=cells, metadata={"widgets": widgets, "kernelspec": kernel})
