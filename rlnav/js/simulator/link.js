/**
 * The state in the page's address, so that a link opens what its sender saw. Only the first simulator of a page has it;
 * in a notebook none has: there the kernel keeps the state.
 */
import { fromAddress, toAddress } from "../scenario/address.js";

const SETTLED = 250; // milliseconds without a change before the address follows
let owner = null; // the simulator that the page's address belongs to

export class Link {
  constructor(app) {
    this.app = app;
    this.timer = 0;
    this.written = null; // the hash that we wrote ourselves
    if (app.stage.live || owner) return;
    owner = this;
    this.onHash = () => this.followed();
    addEventListener("hashchange", this.onHash);
  }

  destroy() {
    clearTimeout(this.timer);
    if (owner !== this) return;
    owner = null;
    removeEventListener("hashchange", this.onHash);
  }

  /** The address of what is set now. */
  get address() {
    const { scenario, view } = this.app;
    return `${location.href.split("#")[0]}${toAddress({ scenario, view })}`;
  }

  /** What to open with: what the address says, or else what the page says. */
  opening() {
    const { state } = this.app.stage;
    return (owner === this && this.read()) || { state, messages: [] };
  }

  /** Read the address; a hash without "=" is a place in the page, which means nothing here. */
  read() {
    return location.hash.includes("=") ? fromAddress(location.hash) : null;
  }

  write() {
    if (owner !== this) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.written = new URL(this.address).hash;
      history.replaceState(history.state, "", this.address);
    }, SETTLED);
  }

  /** The reader has changed the address by hand, or followed a link within the page. */
  followed() {
    const found = location.hash !== this.written && this.read();
    if (!found) return;
    this.app.replace(found.state);
    if (found.messages.length) this.app.stage.message(found.messages.join(" "));
  }
}
