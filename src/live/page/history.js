// What was turned, with undo and redo. A state is a map from a path to its TOML.

const entry = /^(style|light)\[(\d+)\]\./;
const naming = /^(style\[\d+\]\.object|light\[\d+\]\.name)$/;

/** For each entry of `before` where it is in `now`, or null; equal ones in their order. One that is
 * for something else now, among as many as before, is still the one. */
function newNumbers(before, now) {
  const free = now.map((name, number) => [name, number]);
  const numbers = before.map((name) => {
    const at = free.findIndex(([other]) => other === name);
    return at < 0 ? null : free.splice(at, 1)[0][1];
  });
  const stays = (i) => before.length === now.length && free.some(([, number]) => number === i);
  return numbers.map((number, i) => number ?? (stays(i) ? i : null));
}

export class History {
  overrides = new Map();
  #past = [];
  #future = [];
  #turning = null;
  #made = new Set(); // the first keys of styles and lights that are in no file yet
  #known = {}; // what the entries of the file's lists were for, when it was last seen

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

  /** `onDisk` says what each entry of the file's lists is for. When another program added or took
   * some, what was turned of the others gets their new numbers, and what is in no file yet comes
   * after them. Gives what became of nothing: the entries that were turned and are gone. */
  renumber(onDisk) {
    const gone = [];
    for (const list of ['style', 'light']) {
      const before = this.#known[list] ?? onDisk[list];
      this.#known[list] = onDisk[list];
      const numbers = newNumbers(before, onDisk[list]);
      const made = this.#madeOf(list);
      const shift = made.length ? onDisk[list].length - Math.min(...made) : 0;
      const to = (number) => {
        if (made.includes(number)) return number + shift;
        return number < before.length ? numbers[number] : number;
      };
      if (!shift && numbers.every((number, i) => number === i)) continue;
      gone.push(...before.filter((_, i) => numbers[i] === null && this.#turns(list, i)));
      this.#rename(list, to);
    }
    return gone;
  }

  #madeOf(list) {
    return [...this.#made].map((path) => entry.exec(path))
      .filter(([, of]) => of === list).map(([, , number]) => Number(number));
  }

  #turns(list, number) {
    return [...this.overrides.keys()].some((path) => path.startsWith(`${list}[${number}].`));
  }

  /** `to(number)` is an entry's new number, or null when it is gone. */
  #rename(list, to) {
    const renamed = (path) => {
      const [, of, number] = entry.exec(path) ?? [];
      if (of !== list) return path;
      const now = to(Number(number));
      return now === null ? null : path.replace(entry, `${list}[${now}].`);
    };
    const all = (state) => new Map([...state].map(([path, text]) => [renamed(path), text])
      .filter(([path]) => path !== null));
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
