/**
 * What the panels' controls have in common: they follow the scenario, they change it, and they carry the key by which a
 * teacher can hide them.
 */

export class Fields {
  #follow = [];

  constructor(app) {
    this.app = app;
  }

  /** Take a control in; `read(scenario)` is what it shows, by default the setting that is called like its key. */
  add(key, control, read = (scenario) => scenario[key]) {
    control.element.dataset.key = key;
    this.#follow.push(() => {
      const value = read(this.app.scenario);
      if (control.value !== value) control.value = value; // else what is being typed, or a fault beside it, would go
    });
    return control;
  }

  /** Change settings; what is refused is taken back in the controls as well. */
  change(patch) {
    this.edit((scenario) => ({ ...scenario, ...patch }));
  }

  /** Change settings by a function of the scenario. */
  edit(fn) {
    if (!this.app.edit(fn)) this.refresh();
  }

  /** Show what is set now. */
  refresh() {
    for (const update of this.#follow) update();
  }
}

/** Return a function that says whether what it is given differs from the last time: same things, nothing to do. */
export function changes() {
  let before = [];
  return (...now) => {
    const same = now.length === before.length && now.every((thing, i) => Object.is(thing, before[i]));
    before = now;
    return !same;
  };
}

/** Set a text, unless it is there already: what has not changed need not be drawn or read out again. */
export function put(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
