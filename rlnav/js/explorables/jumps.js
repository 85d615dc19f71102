/**
 * Jumps along a run: back and on to the next update of a kind, which may have to be searched for.
 */
import { button, choice, toolbar } from "../views/controls.js";
import { Player } from "../views/player.js";

const AT_ONCE = 20; // milliseconds that a search may take before the page is drawn
const KINDS = [["episode", "end of an episode"], ["goal", "arrival at the goal"], ["surprise", "error above 1"]];

export class Jumps {
  /** `figure` has a `timeline`, `go(n)`, `arrive()` and a `player`. */
  constructor(figure) {
    this.figure = figure;
    this.search = null; // what is searched for: { kind, from }
    this.searcher = figure.part(
      new Player({ tick: (ms) => this.look(ms), draw: () => figure.draw(), speed: Infinity }),
    );
    this.kind = choice({ label: "Jump to", options: KINDS, value: "episode" });
    const onClick = () => figure.go(figure.timeline.before(this.kind.value) ?? 0);
    this.previous = button({ label: "Previous", icon: "back", onClick });
    this.following = button({ label: "Next", icon: "step", onClick: () => this.jump() });
    this.tools = toolbar({ label: "Jumps", children: [this.previous, this.following] });
  }

  pause() {
    this.searcher.pause();
  }

  jump() {
    const { player, stage, timeline } = this.figure;
    player.pause();
    stage.message("");
    this.search = { kind: this.kind.value, from: timeline.now };
    if (this.look(AT_ONCE)) this.searcher.play();
  }

  /** Search for a while; return whether to go on. */
  look(milliseconds) {
    const { stage, timeline } = this.figure;
    const found = timeline.advance(this.search.kind, milliseconds);
    if (found === "more") return true;
    if (found === "end") {
      timeline.seek(this.search.from);
      stage.message(`The rest of this run, ${timeline.reached} updates in all, has no such update.`, "note");
    }
    this.figure.arrive();
    return false;
  }

  /** Block what cannot be done, for a reason. */
  draw({ begin, end }) {
    this.previous.disabled(begin);
    this.following.disabled(end);
  }
}
