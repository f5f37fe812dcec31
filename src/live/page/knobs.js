// Knobs for every parameter of one scope, made of the program's own tables.
import { stripChoice } from './strips.js';

/** TOML spells these as JSON does. */
const spell = (value) => JSON.stringify(value);

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

/** An input for a parameter: the elements, and functions that read and write its value. */
function control(parameter, turned) {
  const { type, range, choices } = parameter;
  if (type === 'true/false') {
    const box = element('input', { type: 'checkbox', className: 'wide' });
    box.oninput = () => turned(box.checked);
    return { parts: [box], write: (value) => (box.checked = value) };
  }
  if (type === 'choice') {
    const list = element('select', { className: 'wide' }, ...choices.map((c) => new Option(c)));
    list.oninput = () => turned(list.value);
    return { parts: [list], write: (value) => (list.value = value) };
  }
  if (type === 'number' || type === 'integer') return numberControl(parameter, turned);
  const field = element('input', { className: 'wide' });
  field.onchange = () => {
    if (type === 'text') return turned(field.value);
    try {
      turned(JSON.parse(`[${field.value}]`));
      field.setCustomValidity('');
    } catch {
      field.setCustomValidity(type === 'texts' ? 'names in quotes, with commas' : 'numbers, with commas');
      field.reportValidity();
    }
  };
  const one = (v) => (typeof v === 'number' ? Number(v.toPrecision(7)) : spell(v));
  const write = (value) => (field.value = type === 'text' ? value : value.map(one).join(', '));
  return { parts: [field], write };
}

/** Wide ranges slide finely near 0: the slider is the cube root of its way through the range. */
function numberControl({ type, range: [low, high] = [0, 1] }, turned) {
  const wide = high - low > 1000;
  const bend = wide ? 3 : 1;
  const slider = element('input', { type: 'range', min: 0, max: 1, step: 'any' });
  const field = element('input', { type: 'number', min: low, max: high, step: 'any' });
  const round = (v) => (type === 'integer' ? Math.round(v) : Number(v.toPrecision(4)));
  slider.oninput = () => {
    field.value = round(low + (high - low) * slider.value ** bend);
    turned(Number(field.value));
  };
  field.onchange = () => field.value !== '' && turned(Number(field.value));
  const write = (value) => {
    field.value = Number(value.toPrecision(7));
    slider.value = ((value - low) / (high - low)) ** (1 / bend);
  };
  return { parts: [slider, field], write };
}

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

  /** `turned(path, text)` is told what was turned, `reset(path)` what goes back to the file's. */
  constructor(root, tables, turned, reset) {
    Object.assign(this, { root, tables, turned, reset });
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
      if (value !== undefined && !isTurned) knob.write(value);
      knob.row.classList.toggle('changed', changed.has(knob.path));
      knob.row.classList.toggle('given', spell(value) !== knob.standard);
    }
  }

  search(text) {
    const wanted = text.trim().toLowerCase();
    for (const { row, words } of this.#knobs) row.hidden = !words.includes(wanted);
    for (const group of this.root.children)
      group.hidden = !group.querySelector('.knob:not([hidden])');
  }

  #knob(pass, parameter, path) {
    const { parts, write } = control(parameter, (value) => this.turned(path, spell(value)));
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
      row.append(...stripChoice((name) => this.turned(path, spell(name))));
      parts[0].classList.add('beside');
    }
    const words = `${pass}.${parameter.name} ${parameter.help}`.toLowerCase();
    this.#knobs.push({ row, path, pass, name: parameter.name, write, words, standard });
    return row;
  }
}
