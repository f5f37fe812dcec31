// What the page and the program say to each other. Addresses are relative, so each carries the
// token of the page's own.

export async function tables() {
  return (await fetch('tables')).json();
}

export async function probe(x, y) {
  return (await fetch(`probe?x=${x}&y=${y}`)).json();
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
      const body = JSON.stringify(this.#waiting);
      this.#waiting = null;
      try {
        const response = await fetch('change', { method: 'POST', body });
        if (!response.ok) this.lost(await response.text());
      } catch {
        this.lost('the program does not answer');
      }
    }
    this.#busy = false;
  }
}

/** Asks for pictures one after the other; the program answers when there is a new one. */
export class Pictures {
  #seen = 0;
  #abort = new AbortController();

  /** `wanted()` gives {stage, exposure}; `shown(state, pixels)` gets what came, pixels or null. */
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
      const { stage, exposure } = this.wanted();
      const query = new URLSearchParams({ seen: this.#seen, stage, exposure });
      try {
        const response = await fetch(`picture?${query}`, { signal: this.#abort.signal });
        if (!response.ok) throw new Error(await response.text());
        this.#take(await response.arrayBuffer());
      } catch (problem) {
        if (problem.name === 'AbortError') continue;
        this.lost(problem.message);
        await new Promise((resolve) => setTimeout(resolve, 1000));
      }
    }
  }

  #take(buffer) {
    const length = new DataView(buffer).getUint32(0, true);
    const state = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    this.#seen = state.version;
    const pixels = state.size
      ? new ImageData(new Uint8ClampedArray(buffer, 4 + length), ...state.size)
      : null;
    this.shown(state, pixels);
  }
}
