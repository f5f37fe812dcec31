// A strip painted in the page, with the knobs of `strip make`.
import { control, element } from './control.js';
import { keepPainted, paintKnobs, painted } from './link.js';
import { stopsControl } from './stops.js';
import { keep } from './strip_drop.js';

/** Shows the strip of the newest settings; what was turned meanwhile is painted next, not all of it. */
class Preview {
  #busy = false;
  #waiting = null;

  constructor(canvas, told) {
    Object.assign(this, { canvas, told });
  }

  async show(recipe) {
    this.#waiting = recipe;
    if (this.#busy) return;
    this.#busy = true;
    while (this.#waiting) {
      const now = this.#waiting;
      this.#waiting = null;
      try {
        const pixels = await painted(now);
        Object.assign(this.canvas, { width: pixels.width, height: pixels.height });
        this.canvas.getContext('2d').putImageData(pixels, 0, 0);
        this.told('');
      } catch (problem) {
        this.told(problem.message);
      }
    }
    this.#busy = false;
  }
}

/** The element; `kept(name)` is told of a strip that lies in the look's folder now. */
export async function easel(kept) {
  const { table, presets } = await paintKnobs();
  const settings = new Map();
  const canvas = element('canvas', { width: 1, height: 1 });
  canvas.setAttribute('aria-label', 'the strip');
  const said = element('p', {});
  said.setAttribute('role', 'status');
  const preview = new Preview(canvas, (text) => (said.textContent = text));
  const preset = element('select', {}, ...Object.keys(presets).map((name) => new Option(name)));
  const recipe = () => ({ preset: preset.value,
    settings: [...settings].map(([name, value]) => `${name}=${JSON.stringify(value)}`) });

  const knobs = table.parameters.map((parameter) => {
    const made = parameter.name === 'stops' ? stopsControl : control;
    const { parts, write } = made(parameter, (value) => {
      settings.set(parameter.name, value);
      preview.show(recipe());
    });
    const label = element('label', { textContent: parameter.name, title: parameter.help });
    parts[0].id = label.htmlFor = `paint-${parameter.name}`;
    return { name: parameter.name, write, row: element('div', { className: 'knob' }, label, ...parts) };
  });
  const begin = () => {
    settings.clear();
    for (const { name, write } of knobs) write(presets[preset.value][name]);
    preview.show(recipe());
  };
  preset.onchange = begin;
  preset.value = 'soft';
  begin();

  const name = element('input', { value: 'painted.png', className: 'name' });
  name.setAttribute('aria-label', 'name of its file');
  const button = element('button', { textContent: 'keep and use',
    title: 'Write it beside the look\'s other strips' });
  button.onclick = async () => {
    try {
      const strip = await keep((as) => keepPainted(as, recipe()), name.value);
      if (strip) kept(strip);
    } catch (problem) {
      said.textContent = problem.message;
    }
  };
  return element('div', { className: 'easel' }, canvas,
    element('div', { className: 'bar' }, preset, name, button), said, ...knobs.map(({ row }) => row));
}
