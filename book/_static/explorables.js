// Starts the explorables of a page: each is an element `.rlnav-explorable` with a still picture in it, the name of its
// program, and the state to begin with. Classic scripts, so that a page opened from a folder works as well.
// What goes wrong is said in plain words, and the still picture stays.
(() => {
  "use strict";

  const { src, dataset } = document.currentScript;
  const PROGRAMS = new URL("rlnav/", src);
  const VERSION = dataset.version ? `?v=${dataset.version}` : ""; // so that a browser keeps none that is out of date
  const NEAR = "600px"; // begin to load this long before the reader has scrolled there
  const STYLE = `
    .rlnav-trouble { border-left: 4px solid #d55e00; line-height: 1.5; margin: 0.5em 0; padding: 0.25em 0.75em; }
    @media not print { .rlnav-explorable.is-live:not(:has(.rl-failed)) > .rl-live { display: none; } }
    @media print { .rlnav-explorable > :is(.rlnav-live, .rlnav-trouble) { display: none; } }`;
  const programs = (window.rlnavExplorables ??= {}); // each script leaves its program here
  const waiting = new Map(); // by address: a promise of the script or style that is on its way

  // What a program needs of an anywidget's model. There is no `send`: no kernel listens here, and saving does nothing.
  function makeModel(data) {
    const listeners = new Map();
    const of = (name) => listeners.get(name) ?? listeners.set(name, new Set()).get(name);
    const emit = (name, value) => [...of(name)].forEach((listener) => listener(value));
    return {
      get: (name) => data[name] ?? null,
      set(name, value) {
        const values = typeof name === "object" ? name : { [name]: value };
        const changed = Object.entries(values).filter(([key, now]) => data[key] !== now);
        Object.assign(data, values);
        for (const [key, now] of changed) emit(`change:${key}`, now);
        if (changed.length) emit("change");
      },
      save_changes() {},
      on: (names, listener) => names.split(/\s+/).forEach((name) => of(name).add(listener)),
      off(names, listener) {
        if (!names) listeners.clear();
        for (const name of names?.split(/\s+/) ?? []) listener ? of(name).delete(listener) : listeners.delete(name);
      },
    };
  }

  function load(tag, attributes) {
    const address = attributes.src ?? attributes.href;
    if (!waiting.has(address)) {
      waiting.set(address, new Promise((resolve, reject) => {
        const element = Object.assign(document.createElement(tag), attributes);
        element.onload = resolve;
        element.onerror = () => {
          waiting.delete(address); // the next attempt may work
          reject(new Error(`The file ${address.split("/").pop().split("?")[0]} could not be loaded.`));
        };
        document.head.append(element);
      }));
    }
    return waiting.get(address);
  }

  async function program(entry) {
    const style = load("link", { rel: "stylesheet", href: new URL(`${entry}.css${VERSION}`, PROGRAMS).href });
    await loadScript(`${entry}.js`);
    await style;
    return programs[entry];
  }

  function loadScript(name) {
    return load("script", { src: new URL(`${name}${VERSION}`, PROGRAMS).href });
  }

  // A part of a program that is loaded when it is wanted: what `import()` is in a module.
  programs.part = async (name) => {
    await loadScript(name);
    return programs[name];
  };

  function read({ state, tables, training }) {
    try {
      return Object.fromEntries(
        Object.entries({ state, tables, training }).map(([name, text]) => [name, text ? JSON.parse(text) : null]),
      );
    } catch {
      throw new Error("The settings stored in this page are damaged.");
    }
  }

  async function start(element) {
    const place = document.createElement("div");
    place.className = "rlnav-live";
    try {
      const model = makeModel(read(element.dataset));
      element.model = model; // for whoever wants to look at it from outside
      const { render } = await program(element.dataset.entry);
      element.prepend(place);
      await render({ model, el: place });
      element.classList.add("is-live");
    } catch (error) {
      place.remove();
      const trouble = document.createElement("p");
      trouble.className = "rlnav-trouble";
      trouble.setAttribute("role", "alert");
      trouble.textContent = `This figure could not start, so its still picture is shown. ${error.message}`;
      element.prepend(trouble);
    }
  }

  function startAll() {
    const all = [...document.querySelectorAll(".rlnav-explorable")];
    document.head.append(Object.assign(document.createElement("style"), { textContent: STYLE }));
    if (location.hash.includes("=")) return all.forEach(start); // a link with settings: they are wanted now
    const near = new IntersectionObserver((entries) => {
      for (const { isIntersecting, target } of entries) {
        if (!isIntersecting) continue;
        near.unobserve(target);
        start(target);
      }
    }, { rootMargin: NEAR });
    all.forEach((element) => near.observe(element));
  }

  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", startAll);
  else startAll();
})();
