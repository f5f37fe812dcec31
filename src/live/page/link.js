// What the page and the program say to each other. Addresses are relative, so each carries the
// token of the page's own.

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
  return (await received(await fetch(`strip?${new URLSearchParams({ name })}`))).pixels;
}

async function post(where, what) {
  const response = await fetch(where, { method: 'POST', body: JSON.stringify(what) });
  if (!response.ok) throw new Error(await response.text());
  return response.json();
}

/** Writes overrides ("path=TOML") into the look's file; gives those that bring back what it had. */
export async function save(overrides) {
  return (await post('save', { overrides })).before;
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
    ? new ImageData(new Uint8ClampedArray(buffer, 4 + length), ...state.size)
    : null;
  return { state, pixels };
}

/** Those of a view above `seen`, looked at as `wanted` says. */
async function picture(seen, wanted, signal) {
  const query = new URLSearchParams({ seen, ...wanted });
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
