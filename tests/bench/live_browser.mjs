// From the hand to the picture in a browser, beside one comp of the same frame, in one run.
//
//   node tests/bench/live_browser.mjs KAGEFUDE LOOK FRAME.exr [ROUNDS]
//
// Debian's Chromium is told what to do through a pipe and nothing else of it is listened to: what
// Playwright and the developer tools do with every answer doubles the time of large ones. A knob is
// turned as a hand turns it; its time ends when the canvas is drawn, by every n-th pixel where the
// program shows no more while the hand moves; "sharp" ends when all pixels are drawn, the hand at
// rest, whose 200 ms are in it. A strip "new" was never shown before. A light is dragged where the
// frame has its casters. Exit 1 when a demand is missed.
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { loadavg, tmpdir } from 'node:os';
import { join } from 'node:path';

const [kagefude, look, frame, rounds = '15'] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'kagefude_browser_'));
// Name, the knob, the values between which it goes (sliders: of their way), and the most ms.
const turns = [
  ['strip', 'style[0].strip', ['builtin:soft', 'builtin:fine'], 60],
  ['contrast', 'brush.contrast', [0.4, 0.5], 60],
  ['brush', 'brush.pole_fade', [0.4, 0.6], 60],
  ['tone', 'tone.gamma', [0.4, 0.45], 90],
  ['shade', 'shade.wrap', [0.1, 0.2], 90],
  ['shadow', 'shadow.strength', [0.8, 0.9], 200],
  ['search', 'light_shape.light_size', [0.5, 0.55], 200],
  ['smoothing', 'smooth.h', [0.4, 0.5], 200],
];

/** A browser that is talked to through the pipes 3 and 4: commands and answers end in a zero byte. */
class Browser {
  #asked = new Map();
  #text = '';
  #number = 0;

  constructor() {
    this.process = spawn('/usr/bin/chromium', ['--headless', '--no-sandbox', '--disable-gpu',
      '--window-size=1280,720', '--remote-debugging-pipe', `--user-data-dir=${join(folder, 'profile')}`],
    { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.process.stdio[4].on('data', (bytes) => this.#take(bytes));
  }

  #take(bytes) {
    const parts = (this.#text + bytes).split('\0');
    this.#text = parts.pop();
    for (const { id, result, error } of parts.map(JSON.parse)) {
      this.#asked.get(id)?.({ result, error });
      this.#asked.delete(id);
    }
  }

  async tell(method, params = {}) {
    const id = ++this.#number;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: this.session })}\0`);
    const { result, error } = await new Promise((done) => this.#asked.set(id, done));
    if (error) throw new Error(`${method}: ${error.message}`);
    return result;
  }

  async open() {
    const { targetId } = await this.tell('Target.createTarget', { url: 'about:blank' });
    this.session = (await this.tell('Target.attachToTarget', { targetId, flatten: true })).sessionId;
  }

  /** What a function of the page gives for `values`. */
  async run(code, ...values) {
    const expression = `(${code})(...${JSON.stringify(values)})`;
    const { result, exceptionDetails: wrong } = await this.tell('Runtime.evaluate',
      { expression, awaitPromise: true, returnByValue: true });
    if (wrong) throw new Error(wrong.exception?.description ?? wrong.text);
    return result.value;
  }

  async until(code, ...values) {
    while (!await this.run(code, ...values)) await new Promise((done) => setTimeout(done, 20));
  }
}

// These run in the page.

const turnKnob = async (path, value) => {
  const knob = document.getElementById(`knob-${path}`);
  const drawn = () => new Promise((done) => document.getElementById('canvas')
    .addEventListener('drawn', ({ detail }) => done(detail.step), { once: true }));
  const start = performance.now();
  knob.value = value;
  knob.dispatchEvent(new Event(knob.type === 'range' ? 'input' : 'change', { bubbles: true }));
  const step = await drawn();
  const took = performance.now() - start;
  for (let shown = step; shown > 1;) shown = await drawn();
  return { took, step, sharp: performance.now() - start };
};

const dragLight = async (name) => {
  const choice = document.getElementById('light');
  choice.value = name;
  const canvas = document.getElementById('canvas');
  canvas.setPointerCapture = () => {}; // no real pointer is down
  const point = (kind, x) => canvas.dispatchEvent(new PointerEvent(kind,
    { pointerId: 1, clientX: x, clientY: 300, bubbles: true }));
  const times = [];
  point('pointerdown', 300);
  for (let x = 310; x < 420; x += 10) {
    const drawn = new Promise((done) => canvas.addEventListener('drawn', done, { once: true }));
    const start = performance.now();
    point('pointermove', x);
    const { step } = (await drawn).detail;
    const took = performance.now() - start;
    times.push({ took, step }); // not sharp before the hand rests
    await new Promise((done) => setTimeout(done, 50));
  }
  point('pointerup', 420);
  choice.value = '';
  return times;
};

const choose = async (scope) => {
  const list = document.getElementById('scope');
  list.value = scope;
  list.dispatchEvent(new Event('change', { bubbles: true }));
};

const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];
const pause = () => new Promise((done) => setTimeout(done, 150));
const comp = () => {
  const start = performance.now();
  execFileSync(kagefude, ['comp', look, frame, '-o', join(folder, 'out.exr'), '--progress', 'none']);
  return performance.now() - start;
};

let missed = false;
function tell(name, turns, most, whole) {
  const of = (what) => turns.map((turn) => turn[what]);
  const took = median(of('took'));
  const kept = took <= most;
  missed ||= !kept;
  console.log(`| ${name} | ${took.toFixed(0)} | ${Math.min(...of('took')).toFixed(0)} | ${most} ` +
    `${kept ? 'kept' : 'MISSED'} | ${(took / whole).toFixed(2)} | ${median(of('step'))} | ` +
    `${median(of('sharp'))?.toFixed(0) ?? ''} |`);
}

const browser = new Browser();
await browser.open();
let program;
try {
  const load = loadavg()[0].toFixed(1);
  const start = performance.now();
  program = spawn(kagefude, ['live', look, frame, '--no-open'], { stdio: ['ignore', 'pipe', 'inherit'] });
  const url = await new Promise((done) => program.stdout.once('data', (text) => done(String(text).trim())));
  await browser.tell('Page.navigate', { url });
  await browser.until(() => document.getElementById('status')?.textContent.includes('×'));
  const first = performance.now() - start;
  await browser.until(() => document.querySelectorAll('#knobs .knob').length > 20);

  const comps = [];
  const taken = new Map(turns.map(([name]) => [name, []]));
  for (let round = 0; round < Number(rounds); ++round) {
    comps.push(comp());
    for (const [name, path, values] of turns) {
      await browser.run(choose, path.startsWith('style') ? 'style 0' : 'look');
      await pause();
      const took = await browser.run(turnKnob, path, values[round % 2]);
      if (round > 1) taken.get(name).push(took); // the first two have never been seen
    }
  }
  const whole = median(comps);
  console.log(`load ${load} before, ${loadavg()[0].toFixed(1)} after; first picture ${first.toFixed(0)} ms ` +
    `(with Chromium's own start of a page), comp ${whole.toFixed(0)} ms`);
  console.log('| what | ms, median | least | demanded | of a comp | every n-th pixel | sharp |\n|---|---|---|---|---|---|---|');
  for (const [name, , , most] of turns) tell(name, taken.get(name), most, whole);

  await browser.run(choose, 'style 0');
  const strips = (await browser.run(async () => (await fetch('strips')).json()))
    .filter((name) => !name.startsWith('builtin:')).slice(0, 15);
  const fresh = [];
  for (const strip of strips) {
    await pause();
    fresh.push(await browser.run(turnKnob, 'style[0].strip', strip));
  }
  if (fresh.length) tell('strip, new', fresh, 60, whole);

  const light = await browser.run(() => document.getElementById('light').options[1]?.value);
  if (light) tell('dragged light', await browser.run(dragLight, light), 300, whole);
  else console.log('no light of this frame can be dragged: it has no casters');
} finally {
  program?.kill('SIGINT');
  browser.process.kill();
  await new Promise((done) => browser.process.once('exit', done));
  rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
}
process.exit(missed ? 1 : 0);
