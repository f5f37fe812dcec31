// What the page and the program say to each other. Addresses are relative, so each carries the
// token of the page's own.
import { unpacked } from './unpack.js';

export async function tables() {
  return (await fetch('tables')).json();
}

export async function probe(x, y) {
  return (await fetch(`probe?x=${x}&y=${y}`)).json();
}

export async function strips() {
  return (await fetch('strips')).json();
}

/** A small picture of a strip. */
export async function strip(name) {
  return (await received(await fetch(`strip?${new URLSearchParams({ name, packed: 1 })}`))).pixels;
}

async function sent(where, body) {
  const response = await fetch(where, { method: 'POST', body });
  if (!response.ok) throw new Error(await response.text());
  return response;
}

async function post(where, what) {
  return (await sent(where, JSON.stringify(what))).json();
}

/** Offers a picture's file as a strip: {strip}, or {question, freeName}. */
export async function offerStrip(file, name, anyway) {
  const query = new URLSearchParams(anyway ? { name, anyway: 1 } : { name });
  return (await sent(`strip?${query}`, file)).json();
}

/** The table and the presets of painted strips. */
export async function paintKnobs() {
  return (await fetch('paint')).json();
}

/** The strip of a recipe {preset, settings}. */
export async function painted(recipe) {
  return (await received(await sent('paint?packed=1', JSON.stringify(recipe)))).pixels;
}

/** Paints it into a file; answers as offerStrip. */
export function keepPainted(name, recipe) {
  return post(`paint?${new URLSearchParams({ name })}`, recipe);
}

/** Writes overrides ("path=TOML") into the look's file; gives those that bring back what it had.
 * Refused when the file has other entries than `onDisk` says. */
export async function save(overrides, onDisk) {
  return (await post('save', { overrides, onDisk })).before;
}

/** Sends the newest change; while one is on its way the others wait in one place, so that none
 * queue up. `lost(text)` is told when the program refuses or is gone. */
export class Changes {
  #busy = false;
  #waiting = null;

  constructor(lost) {
    this.lost = lost;
  }

  async send(change) {
    this.#waiting = change;
    if (this.#busy) return;
    this.#busy = true;
    while (this.#waiting) {
      const change = this.#waiting;
      this.#waiting = null;
      try {
        await post('change', change);
      } catch (problem) {
        this.lost(problem instanceof TypeError ? 'the program does not answer' : problem.message);
      }
    }
    this.#busy = false;
  }
}

/** The state and the pixels (or null) of an answer. */
async function received(response) {
  if (!response.ok) throw new Error(await response.text());
  const buffer = await response.arrayBuffer();
  const length = new DataView(buffer).getUint32(0, true);
  const state = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const pixels = state.size
    ? unpacked(new Uint8Array(buffer, 4 + length), ...state.size)
    : null;
  return { state, pixels };
}

/** Those of a view above `seen`, looked at as `wanted` says. */
async function picture(seen, wanted, signal) {
  const query = new URLSearchParams({ seen, packed: 1, ...wanted });
  return received(await fetch(`picture?${query}`, { signal }));
}

/** What there is now. */
export function pictureNow(wanted) {
  return picture(0, wanted);
}

/** Asks for pictures one after the other; the program answers when there is a new one. */
export class Pictures {
  #seen = 0;
  #abort = new AbortController();

  /** `wanted()` gives {stage, exposure, display, view}; `shown(state, pixels)` gets what came. */
  constructor(wanted, shown, lost) {
    this.wanted = wanted;
    this.shown = shown;
    this.lost = lost;
  }

  /** Another stage or exposure of the same view. */
  again() {
    this.#seen = 0;
    this.#abort.abort();
  }

  async run() {
    for (;;) {
      this.#abort = new AbortController();
      try {
        const { state, pixels } = await picture(this.#seen, this.wanted(), this.#abort.signal);
        this.#seen = state.version;
        this.shown(state, pixels);
      } catch (problem) {
        if (problem.name === 'AbortError') continue;
        this.lost(problem.message);
        await new Promise((resolve) => setTimeout(resolve, 1000));
      }
    }
  }
}
