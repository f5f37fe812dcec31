// What was turned, with undo and redo. A state is a map from a path to its TOML.

const entry = /^(style|light)\[(\d+)\]\./;
const naming = /^(style\[\d+\]\.object|light\[\d+\]\.name)$/;

export class History {
  overrides = new Map();
  #past = [];
  #future = [];
  #turning = null;
  #made = new Set(); // the first keys of styles and lights that are in no file yet

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
    this.setAll(path, [[path, text]]);
  }

  /** The same for several [path, text] that one hand turns, which `turning` names. A new style or
   * light begins with its object or name. */
  setAll(turning, entries) {
    this.#begin(turning);
    for (const [path, text] of entries) this.overrides.set(path, text);
    this.changed();
  }

  /** Begins a style or light: `entries` of [path, text], of which the first names it. */
  add(turning, entries) {
    this.#made.add(entries[0][0]);
    this.setAll(turning, entries);
  }

  /** Back to what the file says. What the file has not goes as a whole, and what came after it. */
  reset(path) {
    this.#begin(null);
    this.overrides.delete(path);
    if (this.#made.has(path) && naming.test(path)) {
      const [, list, number] = entry.exec(path);
      for (const other of [...this.overrides.keys()]) {
        const [, otherList, otherNumber] = entry.exec(other) ?? [];
        if (otherList === list && Number(otherNumber) >= Number(number)) this.overrides.delete(other);
      }
    }
    this.changed();
  }

  /** `counts` says how many entries of each list the file has. When another program added or took
   * some, those that are in no file yet get other numbers. */
  renumber(counts) {
    for (const list of ['style', 'light']) {
      const numbers = [...this.#made].map((path) => entry.exec(path))
        .filter(([, of]) => of === list).map(([, , number]) => Number(number));
      const shift = counts[list] - Math.min(...numbers);
      if (numbers.length && shift) this.#shift(list, Math.min(...numbers), shift);
    }
  }

  #shift(list, first, shift) {
    const renamed = (path) => {
      const [, of, number] = entry.exec(path) ?? [];
      return of === list && Number(number) >= first
        ? path.replace(entry, `${list}[${Number(number) + shift}].`)
        : path;
    };
    const all = (state) => new Map([...state].map(([path, text]) => [renamed(path), text]));
    this.overrides = all(this.overrides);
    this.#past = this.#past.map(all);
    this.#future = this.#future.map(all);
    this.#made = new Set([...this.#made].map(renamed));
    this.changed();
  }

  undo() {
    this.#step(this.#past, this.#future);
  }

  redo() {
    this.#step(this.#future, this.#past);
  }

  /** `written` states are in the file now; `before` brings back what it had, so that undo goes on
   * working across a save. A new style or light cannot be taken out of the file again. */
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
