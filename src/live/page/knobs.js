// Knobs for every parameter of one scope, made of the program's own tables.
import { control, element, spell } from './control.js';
import { stripChoice } from './strips.js';

const last = ['colour', 'output', 'frame']; // what is set once

/** The sections of a scope: its own first, what is seldom turned last. */
function sectionsOf(tables, scope) {
  const rank = ({ pass }) => (pass === scope ? -1 : last.indexOf(pass) + 1);
  return tables
    .filter((table) => (table.list ? table.pass === scope : table.scopes.includes(scope)))
    .sort((a, b) => rank(a) - rank(b));
}

export class Knobs {
  #knobs = [];

  /** `turned(path, text)` is told what was turned, `reset(path)` what goes back to the file's,
   * `failed(text)` what went wrong with a strip. */
  constructor(root, tables, turned, reset, failed) {
    Object.assign(this, { root, tables, turned, reset, failed });
  }

  /** Makes the knobs of 'look', 'light' or 'style' (with its number). */
  build(scope, index) {
    this.root.replaceChildren();
    this.#knobs = [];
    const prefix = scope === 'look' ? '' : `${scope}[${index}].`;
    for (const table of sectionsOf(this.tables, scope)) {
      const own = table.list;
      const group = element('section', {}, element('h2', { title: table.source }, `${table.pass} `,
        element('small', {}, table.summary)));
      for (const parameter of table.parameters) {
        if (scope !== 'look' && parameter.name === table.wholeLookKey) continue;
        const path = prefix + (own ? '' : `${table.pass}.`) + parameter.name;
        group.append(this.#knob(table.pass, parameter, path));
      }
      this.root.append(group);
    }
  }

  /** Shows the values, but for one that is being turned, and marks what `changed` has. */
  show(values, changed) {
    for (const knob of this.#knobs) {
      const value = values[knob.pass]?.[knob.name];
      const active = document.activeElement;
      const isTurned = knob.row.contains(active) && !active.matches('button') && changed.has(knob.path);
      const text = spell(value);
      if (value !== undefined && !isTurned && knob.shown !== text) {
        knob.write(value);
        knob.shown = text;
      }
      knob.row.classList.toggle('changed', changed.has(knob.path));
      knob.row.classList.toggle('given', text !== knob.standard);
    }
  }

  search(text) {
    const wanted = text.trim().toLowerCase();
    for (const { row, words } of this.#knobs) row.hidden = !words.includes(wanted);
    for (const group of this.root.children)
      group.hidden = !group.querySelector('.knob:not([hidden])');
  }

  #knob(pass, parameter, path) {
    const knob = { path, pass, name: parameter.name, shown: null }; // shown: what it was written last
    const { parts, write } = control(parameter, (value) => {
      knob.shown = null;
      this.turned(path, spell(value));
    });
    const limits = parameter.range ? ` (${parameter.range.join(' to ')} ${parameter.unit ?? ''})` : '';
    const title = `${parameter.help}${limits}\ndefault ${spell(parameter.default)}`;
    const label = element('label', { title, textContent: parameter.name });
    parts[0].id = label.htmlFor = `knob-${path}`;
    const back = element('button', { textContent: '↺', title: 'back to the file' });
    back.onclick = () => this.reset(path);
    back.className = 'back';
    const standard = spell(parameter.default);
    const plain = element('button', { textContent: '⌂', title: `default ${standard}` });
    plain.onclick = () => this.turned(path, standard);
    const row = element('div', { className: 'knob' }, label, ...parts, plain, back);
    if (pass === 'style' && parameter.name === 'strip') {
      row.append(...stripChoice((name) => this.turned(path, spell(name)), this.failed));
      parts[0].classList.add('beside');
    }
    const words = `${pass}.${parameter.name} ${parameter.help}`.toLowerCase();
    this.#knobs.push(Object.assign(knob, { row, write, words, standard }));
    return row;
  }
}
