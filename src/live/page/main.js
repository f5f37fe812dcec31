// The page: what is turned goes to the program, what comes back is shown.
import { History } from './history.js';
import { Knobs } from './knobs.js';
import { Changes, Pictures, pictureNow, probe, save, tables } from './link.js';
import { ownLight, ownStyle } from './own_entry.js';
import { draggedLight } from './light_drag.js';
import { keepFile, takeDrops } from './strip_drop.js';
import { Viewer } from './viewer.js';

const at = (id) => document.getElementById(id);
let stage = 'result';
let state = null;
let exposure = 0;
let perShown = 1; // pixels of the stages for one that is shown

const complain = (text) => {
  if (at('error').textContent !== text) at('error').textContent = text;
  at('error').hidden = !text;
};

// What is turned.

const changes = new Changes(complain);
const history = new History(send);
const spelled = () => [...history.overrides].map(([path, text]) => `${path}=${text}`);
function send() {
  at('save').disabled = !history.overrides.size;
  changes.send({ overrides: spelled(), input: Number(at('input').value || 0) });
}
let notice = ''; // shown until something is turned
for (const kind of ['change', 'pointerup'])
  addEventListener(kind, () => {
    history.rest();
    notice = '';
  });
addEventListener('beforeunload', (event) => history.overrides.size && event.preventDefault());

let saving = false; // the file may have the new entries before its answer is here
async function saveAll() {
  const written = [...history.overrides];
  if (!written.length || saving) return;
  saving = true;
  try {
    const before = await save(spelled(), state.onDisk);
    history.saved(written, before.map((text) => {
      const equals = text.indexOf('=');
      return [text.slice(0, equals), text.slice(equals + 1)];
    }));
  } catch (problem) {
    complain(problem.message);
  }
  saving = false;
}

// What is pointed at.

const viewer = new Viewer(at('canvas'), pointed, clicked, takeLight);
let probing = false;
let pointedAt = []; // nothing while the pointer is elsewhere
async function pointed(...where) {
  pointedAt = where;
  if (probing || !state?.values) return;
  probing = true;
  let found = { object: null };
  try {
    if (where.length) found = await probeShown(...where);
  } catch {} // no picture yet
  at('probe').textContent = found.object === null || !pointedAt.length ? '' : describe(found);
  probing = false;
}

/** What lies at a pixel of what is shown. */
function probeShown(x, y) {
  return probe(...[x, y].map((at) => Math.floor((at + 0.5) * perShown)));
}

function describe({ x, y, object, material, style, strip, row, lights }) {
  const named = [`${x}, ${y}   ${object}${material ? `   ${material}` : ''}`,
    `${style === undefined ? 'no style' : `style ${style + 1}`}   ${strip}   row ${row.toFixed(3)}`];
  for (const light of lights)
    named.push(`${light.name}   visibility ${light.visibility.toFixed(3)}   tone ${light.tone.toFixed(3)}`);
  return named.join('\n');
}

async function clicked(x, y) {
  if (!state?.values) return;
  const found = await probeShown(x, y);
  at('picked').hidden = found.object === null;
  if (found.object === null) return;
  at('picked-name').textContent = found.object;
  at('own').onclick = () => {
    wantedScope = `style ${state.values.style.length}`;
    history.add(null, ownStyle(found, state.values, list));
    at('picked').hidden = true;
  };
  if (found.style === undefined) return;
  const { object } = state.values.style[found.style].style;
  at('picked').hidden = object.length === 1 && object[0] === found.object;
  choose(`style ${found.style}`);
}

/** What the hand does with the chosen light from now on; nothing when none is chosen. */
function takeLight() {
  const light = state?.lights?.find(({ name }) => name === at('light').value);
  if (!light) return null;
  const { axes } = state;
  const known = state.values.light.findIndex((own) => own.light.name === light.name);
  const number = known < 0 ? state.values.light.length : known;
  const prefix = `light[${number}].`;
  const own = ownLight(light.name, state.values, list);
  return (across, down) => {
    const keys = draggedLight(light, axes, across, down).map(([key, text]) => [prefix + key, text]);
    if (known >= 0) history.setAll(prefix, keys);
    else history.add(prefix, [...own, ...keys]);
  };
}

// The knobs.

const list = await tables();
const knobs = new Knobs(at('knobs'), list, (path, text) => history.set(path, text),
  (path) => history.reset(path), complain);

let scopes = '';
let wantedScope = null; // to be chosen when it is there
function scopeNow() {
  const [scope, index] = (at('scope').value || 'look').split(' ');
  return { scope, index: Number(index) };
}

function choose(scope) {
  at('scope').value = scope;
  buildKnobs();
  showValues();
}

function buildKnobs() {
  const { scope, index } = scopeNow();
  knobs.build(scope, index);
  knobs.search(at('search').value);
}

function showValues() {
  const { scope, index } = scopeNow();
  const { values } = state;
  knobs.show(scope === 'look' ? values.look : values[scope][index], history.overrides);
}

/** A strip that was dropped goes to a style, or to a new one for what has none. */
async function dropStrip(file, style, found) {
  try {
    const name = await keepFile(file);
    if (!name) return;
    const number = style ?? state.values.style.length;
    const strip = [`style[${number}].strip`, JSON.stringify(name)];
    if (style === undefined) {
      wantedScope = `style ${number}`;
      history.add(null, [...ownStyle(found, state.values, list), strip]);
    } else {
      history.setAll(null, [strip]);
      choose(`style ${style}`);
    }
  } catch (problem) {
    complain(problem.message);
  }
}

takeDrops(at('canvas'), async (file, event) => {
  const found = await probeShown(...viewer.pixelAt(event));
  if (found.object === null) return complain('nothing lies there that could be painted');
  dropStrip(file, found.style, found);
});
takeDrops(at('panel'), (file) => {
  const { scope, index } = scopeNow();
  if (scope === 'style') dropStrip(file, index);
  else complain('drop the picture on a thing, or choose a style first');
});

function showScopes({ light, style }) {
  const names = [['look', 'whole look'],
    ...light.map((l, i) => [`light ${i}`, `light ${l.light.name}`]),
    ...style.map((s, i) => [`style ${i}`,
      `style ${i + 1} ${[...s.style.object, ...s.style.material].join(', ')}`])];
  const text = JSON.stringify(names);
  if (text === scopes) return;
  scopes = text;
  const has = (scope) => names.some(([value]) => value === scope);
  const chosen = [wantedScope, at('scope').value].find(has) ?? 'look';
  if (has(wantedScope)) wantedScope = null;
  at('scope').replaceChildren(...names.map(([value, name]) => new Option(name, value)));
  at('scope').value = chosen;
  buildKnobs();
}

// The picture.

const viewing = () => {
  const [display, view] = JSON.parse(at('display').value || '["",""]');
  return { exposure, display, view };
};

let stagesShown = '';
function showStages(names) {
  const text = JSON.stringify([names, stage]);
  if (text === stagesShown) return;
  stagesShown = text;
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

/** Fills a list once with [value, text]; what is chosen stays. */
function fill(select, options) {
  const text = JSON.stringify(options);
  if (select.dataset.options === text) return;
  select.dataset.options = text;
  const chosen = select.value;
  select.replaceChildren(...options.map(([value, name]) => new Option(name, value)));
  if (options.some(([value]) => value === chosen)) select.value = chosen;
}

function showLists({ inputs, input, displays, stages, lights = [] }) {
  fill(at('light'), [['', 'the picture'], ...lights.map(({ name }) => [name, name])]);
  at('light').parentElement.hidden = !lights.length;
  fill(at('input'), inputs.map((name, i) => [String(i), name]));
  const active = document.activeElement;
  if (active !== at('input') && active !== at('frames')) at('input').value = input ?? 0;
  at('frames').hidden = inputs.length < 2;
  at('frames').max = inputs.length - 1;
  if (active !== at('frames')) at('frames').value = at('input').value;
  const views = Object.entries(displays).flatMap(([display, names]) =>
    names.map((view) => [JSON.stringify([display, view]), `${display}, ${view}`]));
  fill(at('display'), [['["",""]', "the look's"], ...views]);
  fill(at('against'), [['', 'off'], ...(stored ? [['A', 'stored A']] : []),
    ...stages.map((name) => [`stage ${name}`, name])]);
}

let shownPixels = null;
let stored = null;
async function showAgainst() {
  const against = at('against').value;
  if (!against.startsWith('stage ')) return viewer.against(against ? stored : null);
  const { pixels } = await pictureNow({ ...viewing(), stage: against.slice(6) });
  viewer.against(pixels);
}

const pictures = new Pictures(() => ({ stage, ...viewing() }), (now, pixels) => {
  state = now;
  if (pixels) { // first, for the eye waits for it
    shownPixels = pixels;
    const scale = now.values.look.output.scale; // of the stages, which are not yet scaled down
    perShown = now.painted[0] / now.size[0];
    viewer.show(pixels, now.painted.map((side) => (side * now.step) / scale));
    at('canvas').dispatchEvent(new CustomEvent('drawn', { detail: { change: now.change, step: now.step } }));
  }
  if (!now.values) return complain(now.error);
  const gone = now.error || saving ? [] : history.renumber(now.onDisk);
  if (gone.length) notice = `no longer in the look's file, nor what was turned of it: ${gone.join('; ')}`;
  complain(now.error || notice);
  showLists(now);
  if (pixels && at('against').value) showAgainst();
  if (pixels && pointedAt.length) pointed(...pointedAt);
  showStages(now.stages);
  showScopes(now.values);
  showValues();
  at('status').textContent =
    `${now.painted.join(' × ')}${now.step > 1 ? ` (every ${now.step} pixels)` : ''}` +
    (now.warnings.length ? `   ${now.warnings.length} warnings` : '');
  at('status').title = now.warnings.join('\n');
}, complain);

// What is pressed.

at('scope').onchange = () => choose(at('scope').value);
at('search').oninput = () => knobs.search(at('search').value);
at('input').onchange = send;
at('frames').oninput = () => {
  at('input').value = at('frames').value;
  send();
};
at('fit').onclick = () => viewer.fit();
at('one').onclick = () => viewer.oneToOne();
at('undo').onclick = () => history.undo();
at('redo').onclick = () => history.redo();
at('save').onclick = saveAll;
at('display').onchange = () => pictures.again();
at('against').onchange = showAgainst;
at('store').onclick = () => {
  stored = shownPixels;
  showLists(state);
  at('against').value = 'A';
  showAgainst();
};
at('exposure').oninput = () => {
  exposure = Number(at('exposure').value);
  at('exposure-value').textContent = exposure.toFixed(1);
  pictures.again();
};
addEventListener('keydown', (event) => {
  const typing = event.target.matches('input:not([type=range]):not([type=checkbox]), select');
  const key = event.key.toLowerCase();
  if ((event.ctrlKey || event.metaKey) && key === 's') {
    event.preventDefault();
    saveAll();
  } else if (typing) {
    return;
  } else if ((event.ctrlKey || event.metaKey) && key === 'z') {
    event.preventDefault();
    if (event.shiftKey) history.redo();
    else history.undo();
  } else if (key === 'f') viewer.fit();
  else if (key === '1') viewer.oneToOne();
});

pictures.run();
