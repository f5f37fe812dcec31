// The page: what is turned goes to the program, what comes back is shown.
import { Changes, Pictures, probe, tables } from './link.js';
import { Knobs } from './knobs.js';
import { Viewer } from './viewer.js';

const at = (id) => document.getElementById(id);
let overrides = new Map(); // path -> TOML
const past = [];
const future = [];
let stage = 'result';
let state = null;
let exposure = 0;

const complain = (text) => {
  at('error').textContent = text;
  at('error').hidden = !text;
};
const changes = new Changes(complain);
const send = () =>
  changes.send({
    overrides: [...overrides].map(([path, value]) => `${path}=${value}`),
    input: Number(at('input').value || 0),
  });

// One turn of a knob is one step of undo, however many values it runs through.
let turning = null;
function change(path, edit) {
  if (turning !== path) past.push(new Map(overrides));
  turning = path;
  future.length = 0;
  edit();
  send();
}
addEventListener('change', () => (turning = null));

function step(from, to) {
  if (!from.length) return;
  to.push(overrides);
  overrides = from.pop();
  turning = null;
  send();
}

const viewer = new Viewer(at('canvas'), pointed);
let probing = false;
async function pointed(x, y) {
  if (probing || !state) return;
  probing = true;
  try {
    const found = await probe(x, y);
    at('probe').textContent = found.object === null ? '' : describe(found);
  } catch {
    at('probe').textContent = '';
  }
  probing = false;
}

function describe({ x, y, object, material, style, strip, row, lights }) {
  const named = [`${x}, ${y}   ${object}${material ? `   ${material}` : ''}`,
    `${style === undefined ? 'no style' : `style ${style + 1}`}   ${strip}   row ${row.toFixed(3)}`];
  for (const light of lights)
    named.push(`${light.name}   visibility ${light.visibility.toFixed(3)}   tone ${light.tone.toFixed(3)}`);
  return named.join('\n');
}

const knobs = new Knobs(at('knobs'), await tables(),
  (path, text) => change(path, () => overrides.set(path, text)),
  (path) => change(null, () => overrides.delete(path)));

let scopes = '';
function scopeNow() {
  const [scope, index] = (at('scope').value || 'look').split(' ');
  return { scope, index: Number(index) };
}

function buildKnobs() {
  const { scope, index } = scopeNow();
  knobs.build(scope, index);
  knobs.search(at('search').value);
}

function showScopes({ light, style }) {
  const names = [['look', 'whole look'],
    ...light.map((l, i) => [`light ${i}`, `light ${l.light.name}`]),
    ...style.map((s, i) => [`style ${i}`,
      `style ${i + 1} ${[...s.style.object, ...s.style.material].join(', ')}`])];
  if (JSON.stringify(names) === scopes) return;
  scopes = JSON.stringify(names);
  const chosen = at('scope').value;
  at('scope').replaceChildren(...names.map(([value, text]) => new Option(text, value)));
  at('scope').value = names.some(([value]) => value === chosen) ? chosen : 'look';
  buildKnobs();
}

function showStages(names) {
  at('stages').replaceChildren(...names.map((name) => {
    const tab = Object.assign(document.createElement('button'), { textContent: name, role: 'tab' });
    tab.setAttribute('aria-selected', name === stage);
    tab.onclick = () => {
      stage = name;
      pictures.again();
    };
    return tab;
  }));
}

function showInputs({ inputs, input }) {
  const list = at('input');
  if (list.options.length !== inputs.length)
    list.replaceChildren(...inputs.map((name, i) => new Option(name, i)));
  if (document.activeElement !== list) list.value = input ?? 0;
}

const pictures = new Pictures(() => ({ stage, exposure }), (now, pixels) => {
  state = now;
  complain(now.error);
  if (!now.values) return;
  showInputs(now);
  if (pixels) viewer.show(pixels, now.size.map((side) => side * now.step));
  showStages(now.stages);
  showScopes(now.values);
  const { scope, index } = scopeNow();
  knobs.show(scope === 'look' ? now.values.look : now.values[scope][index], overrides);
  at('status').textContent =
    `${now.painted.join(' × ')}${now.step > 1 ? ` (every ${now.step} pixels)` : ''}` +
    (now.warnings.length ? `   ${now.warnings.length} warnings` : '');
  at('status').title = now.warnings.join('\n');
}, complain);

at('scope').onchange = () => {
  buildKnobs();
  pictures.again();
};
at('search').oninput = () => knobs.search(at('search').value);
at('input').onchange = send;
at('fit').onclick = () => viewer.fit();
at('one').onclick = () => viewer.oneToOne();
at('undo').onclick = () => step(past, future);
at('redo').onclick = () => step(future, past);
at('exposure').oninput = () => {
  exposure = Number(at('exposure').value);
  at('exposure-value').textContent = exposure.toFixed(1);
  pictures.again();
};
addEventListener('keydown', (event) => {
  const typing = event.target.matches('input:not([type=range]):not([type=checkbox]), select');
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'z' && !typing) {
    event.preventDefault();
    if (event.shiftKey) step(future, past);
    else step(past, future);
  } else if (!typing && event.key === 'f') viewer.fit();
  else if (!typing && event.key === '1') viewer.oneToOne();
});

pictures.run();
