"""The smallest explorable, for tests of what all of them share: a button that counts."""

from matplotlib.figure import Figure

from rlnav._check import integer
from rlnav.widgets import Explorable

PROGRAM = """
import { h } from "../views/dom.js";

/** Count clicks. */
export function start(stage) {
  const label = () => `clicked ${stage.state.clicks} of ${stage.data("tables")?.most ?? "many"}`;
  const button = h("button", { class: "tiny-button" }, label());
  button.addEventListener("click", () => {
    stage.update({ clicks: stage.state.clicks + 1 });
    button.textContent = label();
  });
  stage.onState(() => (button.textContent = label()));
  if (stage.state.clicks < 0) throw new RangeError("`clicks` must be at least 0; got -1.");
  stage.root.append(button);
  return () => button.remove();
}
"""
STYLE = ".tiny-button { background: none; color: inherit; letter-spacing: 3px; }"


class Tiny(Explorable):
    """Count clicks."""

    entry = "explorables/tiny"
    defaults = {"clicks": 0, "names": {"button": "click"}}  # noqa: RUF012

    @property
    def alt(self):
        return f"A line that has risen {self.state['clicks']} times."

    def checked(self, state):
        state = super().checked(state)
        return state | {"clicks": integer("clicks", state["clicks"], -1)}

    def still(self):
        figure = Figure(figsize=(2, 1))
        figure.subplots().plot([0, self.state["clicks"]])
        return figure, f"{self.state['clicks']} clicks."
