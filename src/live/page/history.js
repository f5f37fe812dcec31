// What was turned, with undo and redo. A state is a map from a path to its TOML.

const newStyle = /^style\[(\d+)\]\.object$/;

export class History {
  overrides = new Map();
  #past = [];
  #future = [];
  #turning = null;
  #made = new Set(); // numbers of the styles that are in no file yet

  /** `changed()` is told of every new state. */
  constructor(changed) {
    this.changed = changed;
  }

  /** The next change begins a new step, even of the same knob. */
  rest() {
    this.#turning = null;
  }

  /** One turn of a knob is one step of undo, however many values it runs through. */
  set(path, text) {
    this.#begin(path);
    this.overrides.set(path, text);
    this.changed();
  }

  /** Back to what the file says. A style that the file has not goes as a whole. */
  reset(path) {
    this.#begin(null);
    this.overrides.delete(path);
    const number = Number(newStyle.exec(path)?.[1] ?? -1);
    if (this.#made.has(number))
      for (const other of [...this.overrides.keys()])
        if (Number(/^style\[(\d+)\]/.exec(other)?.[1] ?? -1) >= number) this.overrides.delete(other);
    this.changed();
  }

  /** Begins a style: `entries` of [path, text], of which the first names its object. */
  add(entries) {
    this.#begin(null);
    for (const [path, text] of entries) this.overrides.set(path, text);
    this.#made.add(Number(newStyle.exec(entries[0][0])[1]));
    this.changed();
  }

  undo() {
    this.#step(this.#past, this.#future);
  }

  redo() {
    this.#step(this.#future, this.#past);
  }

  /** `written` states are in the file now; `before` brings back what it had, so that undo goes on
   * working across a save. A new style cannot be taken out of the file again. */
  saved(written, before) {
    if (this.#made.size) this.#past = [];
    this.#future = [];
    for (const state of this.#past)
      for (const [path, text] of before) if (!state.has(path)) state.set(path, text);
    for (const [path, text] of written)
      if (this.overrides.get(path) === text) this.overrides.delete(path);
    this.#made.clear();
    this.changed();
  }

  #begin(turning) {
    if (turning === null || this.#turning !== turning) this.#past.push(new Map(this.overrides));
    this.#turning = turning;
    this.#future.length = 0;
  }

  #step(from, to) {
    if (!from.length) return;
    to.push(this.overrides);
    this.overrides = from.pop();
    this.#turning = null;
    this.changed();
  }
}
