/**
 * Playing by itself: a button that plays and pauses, and the buttons of a sequence, one back and one on.
 */
import { button, toolbar } from "../views/controls.js";
import { Player } from "../views/player.js";

/** A player with the button that works it. */
export class PlayButton extends Player {
  /**
   * `before()` is called when playing begins, `onStop()` when it has come to its end, and `onChange()` then and
   * whenever the button was pressed.
   */
  constructor(stage, { label = "Play", primary, tick, draw = () => {}, speed, before, onStop, onChange }) {
    const stopped = (error) => {
      if (error) stage.message(error.message);
      onStop?.();
      onChange();
    };
    super({ tick, draw, speed, onStop: stopped });
    const onClick = () => {
      if (this.playing) this.pause();
      else {
        before?.();
        this.play();
      }
      onChange();
    };
    this.button = button({ label, icon: "play", primary, onClick });
    this.element = this.button.element;
    stage.onCleanup(() => this.destroy());
  }

  /** Show whether it plays; `label` is what the button says if it does not, `why` why it is blocked. */
  refresh(label = "Play", why = "") {
    this.button.label = this.playing ? "Pause" : label;
    this.button.icon = this.playing ? "pause" : "play";
    this.button.disabled(why);
  }
}

/** The way through a sequence: back, play and next. */
export class Walk {
  /**
   * `figure` has `k`, the place where it is, `over`, whether it is the last one, `go(k)`, which shows a place and
   * returns whether another follows, and `drawButtons()`. `back` and `next` are settings of the two buttons, `play` of
   * the player.
   */
  constructor(figure, { back, next, ...play }) {
    const step = (direction) => {
      this.player.pause();
      figure.go(figure.k + direction);
    };
    this.back = button({ label: "Back", icon: "back", onClick: () => step(-1), ...back });
    this.next = button({ icon: "step", primary: true, onClick: () => step(1), ...next });
    figure.frame.focusFirst(this.next.element);
    this.player = new PlayButton(figure.stage, {
      tick: () => figure.go(figure.k + 1),
      before: () => figure.over && figure.go(0),
      onChange: () => figure.drawButtons(),
      ...play,
    });
  }

  /** The three buttons in one row. */
  row(label) {
    return toolbar({ label, children: [this.back, this.player, this.next] }).element;
  }

  /** Block what cannot be done, for a reason. */
  draw({ begin, end, why }) {
    this.back.disabled(begin);
    this.next.disabled(end);
    this.player.refresh("Play", why);
  }
}
