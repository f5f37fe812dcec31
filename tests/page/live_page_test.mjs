// The page of `kagefude live` in a real browser:
//   KAGEFUDE=program DATA=tests/data/still CASTERS=tests/data/casters MODULES=folder/node_modules
//   PICTURES=folder node --test FILE
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, beforeEach, test } from 'node:test';

const { KAGEFUDE, DATA, CASTERS, MODULES, PICTURES } = process.env;
const { chromium } = createRequire(join(MODULES, 'x.js'))('playwright-core');
const folder = mkdtempSync(join(tmpdir(), 'kagefude_page_'));
const look = join(folder, 'look.toml');
const frame = join(DATA, 'shot.0001.exr');
const start = `# The vase is painted softly.
kagefude = 1

[tone]
gamma = 1.0   # as it comes

[[style]]  # the vase
object = "Vase"
strip = "builtin:soft"
`;

let program;
let address;
let browser;
let page;
const strange = []; // what should not happen, whatever is done

/** Serves a frame; gives the process and the page's address. */
async function serve(path) {
  const served = spawn(KAGEFUDE, ['live', look, path, '--no-open']);
  return [served, await new Promise((resolve, reject) => {
    served.stdout.once('data', (text) => resolve(String(text).trim()));
    served.once('exit', (code) => reject(new Error(`kagefude live ended with ${code}`)));
  })];
}

before(async () => {
  writeFileSync(look, start);
  [program, address] = await serve(frame);
  browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu'] });
});

after(async () => {
  await browser?.close();
  program.kill('SIGINT');
  const code = await new Promise((resolve) => program.once('exit', resolve));
  rmSync(folder, { recursive: true });
  assert.equal(code, 130);
});

beforeEach(async () => {
  writeFileSync(look, start);
  await page?.close();
  page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
  page.on('console', (message) => message.type() === 'error' && strange.push(message.text()));
  page.on('pageerror', (error) => strange.push(error.message));
  page.on('request', (request) => {
    if (!request.url().startsWith('http://127.0.0.1:') && !request.url().startsWith('data:'))
      strange.push(request.url());
  });
  await page.addInitScript(watchChanges);
  await page.goto(address);
  // An earlier test's values are let go, and the file as it is now has been read.
  await page.evaluate(async () =>
    (await fetch('change', { method: 'POST', body: '{"overrides":[]}' })).json());
  await page.waitForFunction(async () => {
    const bytes = await (await fetch('picture?seen=0')).arrayBuffer();
    const length = new DataView(bytes).getUint32(0, true);
    const state = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
    return !state.error && state.values?.look.tone.gamma === 1 && state.values.style.length === 1;
  });
  await page.waitForFunction(() => document.querySelectorAll('#knobs .knob').length > 20);
});

/** What the canvas shows once all is laid out, in few words. */
const shown = () => page.evaluate(async () => {
  for (let i = 0; i < 2; ++i) await new Promise(requestAnimationFrame);
  const canvas = document.getElementById('canvas');
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let hash = 0;
  for (const byte of data) hash = (Math.imul(hash, 31) + byte) | 0;
  return hash;
});

/** Runs in the page: counts the changes that are on their way, and keeps what was drawn last. */
function watchChanges() {
  Object.assign(window, { asking: 0, lastChange: 0, drawn: {} });
  addEventListener('drawn', ({ detail }) => (window.drawn = detail), { capture: true });
  const plain = window.fetch;
  window.fetch = async (where, ...rest) => {
    if (where !== 'change') return plain(where, ...rest);
    ++window.asking;
    const response = await plain(where, ...rest);
    const { change } = await response.clone().json().catch(() => ({}));
    setTimeout(() => { // what waits in the page is on its way then
      window.lastChange = change ?? window.lastChange;
      --window.asking;
    }, 50);
    return response;
  };
}

/** Whether the last change is shown with all its pixels, as it is when the hand rests. */
const isSettled = () => page.evaluate(() =>
  window.asking === 0 && window.drawn.step === 1 && window.drawn.change >= window.lastChange);

/** Waits until what the canvas shows `fits`, has settled, and is so twice in a row. */
async function shownWhere(fits, what) {
  let last = null;
  for (let i = 0; i < 200; ++i) {
    const now = await shown();
    if (now === last && fits(now) && await isSettled()) return now;
    last = now;
    await page.waitForTimeout(50);
  }
  return assert.fail(`never seen: ${what}`);
}

/** Where an object is on the canvas: in the middle of a run of its pixels. */
async function placeOf(object) {
  await shownWhere(() => true, 'a picture');
  const [width, height] = (await page.textContent('#status')).match(/\d+/g).map(Number);
  const found = await page.evaluate(async ([name, width, height]) => {
    const objectAt = async (x, y) => (await (await fetch(`probe?x=${x}&y=${y}`)).json()).object;
    for (let y = 4; y < height; y += 8) {
      const row = await Promise.all(Array.from({ length: Math.floor(width / 8) },
        (_, i) => objectAt(8 * i, y)));
      const at = row.findIndex((object, i) => object === name && row[i + 1] === name);
      if (at >= 0) return [8 * at + 4, y];
    }
    return null;
  }, [object, width, height]);
  assert.ok(found, `${object} is not in the picture`);
  const box = await page.locator('#canvas').boundingBox();
  const scale = Math.min(box.width / width, box.height / height);
  return [box.x + (box.width - width * scale) / 2 + (found[0] + 0.5) * scale,
    box.y + (box.height - height * scale) / 2 + (found[1] + 0.5) * scale];
}

const knob = (path) => page.locator(`[id="knob-${path}"]`);
const field = (path) => page.locator(`[id="knob-${path}"] + input[type=number]`);
const picture = (name) => PICTURES && page.screenshot({ path: join(PICTURES, name) });

async function type(path, value) {
  await field(path).fill(String(value));
  await field(path).press('Tab');
}

test('the picture is the one that comp writes', async () => {
  execFileSync(KAGEFUDE, ['comp', look, frame, '-o', join(folder, 'out.exr'), '--preview', folder,
    '--progress', 'none']);
  const png = readFileSync(join(folder, 'out.png')).toString('base64');
  await page.click('#one');
  const differs = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const made = new OffscreenCanvas(image.width, image.height).getContext('2d');
    made.drawImage(image, 0, 0);
    const wanted = made.getImageData(0, 0, image.width, image.height).data;
    const bytes = await (await fetch('picture?seen=0&stage=result')).arrayBuffer();
    const got = new Uint8Array(bytes, 4 + new DataView(bytes).getUint32(0, true));
    if (got.length !== wanted.length) return `${got.length} bytes, not ${wanted.length}`;
    return wanted.reduce((most, byte, i) => Math.max(most, Math.abs(byte - got[i])), 0);
  }, png);
  assert.ok(differs <= 1, `differs by ${differs}`);
  await picture('one_to_one.png');
});

test('the probe tells what is under the pointer', async () => {
  await page.mouse.move(...await placeOf('Vase'));
  await page.waitForFunction(() => document.getElementById('probe').textContent.includes('Vase'));
  const text = await page.textContent('#probe');
  assert.match(text, /style 1 +builtin:soft +row 0\.\d+/);
  assert.match(text, /Key +visibility [01]\.\d+ +tone [01]\.\d+/);
  await picture('probe.png');
});

test('a turn of a knob shows at once, and is one step of undo', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await knob('brush.contrast').evaluate((slider) => {
    for (const value of [0.3, 0.2, 0.1]) {
      slider.value = value;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    }
    slider.dispatchEvent(new Event('change', { bubbles: true }));
  });
  const turned = await shownWhere((now) => now !== first, 'another picture');
  assert.equal(await page.locator('.knob.changed').count(), 1);
  await type('tone.gamma', 2);
  const twice = await shownWhere((now) => now !== turned, 'a third picture');
  await page.click('#undo');
  await shownWhere((now) => now === turned, 'the second again');
  await page.click('#undo');
  await shownWhere((now) => now === first, 'the first again');
  await page.click('#redo');
  await page.click('#redo');
  await shownWhere((now) => now === twice, 'the third again');
  await picture('knobs.png');
  await page.locator('.knob.changed .back').first().click();
  await shownWhere((now) => now !== twice, 'one of two taken back');
  assert.equal(readFileSync(look, 'utf8'), start);
});

test('a default is one click away', async () => {
  writeFileSync(look, start.replace('gamma = 1.0', 'gamma = 2.0'));
  await page.waitForFunction(() =>
    document.querySelector('[id="knob-tone.gamma"] + input').value === '2');
  const first = await shownWhere(() => true, 'a picture');
  await page.locator('.knob:has([id="knob-tone.gamma"]) button[title^="default"]').click();
  await shownWhere((now) => now !== first, 'the picture of the default');
  assert.equal(await field('tone.gamma').inputValue(), '1');
});

test('the search leaves what it finds', async () => {
  await page.fill('#search', 'gamma');
  const names = await page.locator('.knob:visible label').allTextContents();
  assert.ok(names.includes('gamma') && names.length < 8, names.join(' '));
});

test('a click on a thing opens its style, or begins one for it', async () => {
  await page.mouse.click(...await placeOf('Vase'));
  await page.waitForFunction(() => document.getElementById('scope').value === 'style 0');
  assert.ok(await page.isHidden('#picked'));
  const first = await shownWhere(() => true, 'a picture');
  await page.selectOption('#scope', 'look');
  await page.mouse.click(...await placeOf('Table'));
  await page.click('#own');
  await page.waitForFunction(() => document.getElementById('scope').value === 'style 1');
  await knob('style[1].strip').fill('builtin:fine');
  await knob('style[1].strip').press('Tab');
  await shownWhere((now) => now !== first, 'another strip');
  await picture('own_style.png');
  await page.click('#save');
  await page.waitForFunction(() => document.getElementById('save').disabled);
  assert.equal(readFileSync(look, 'utf8'),
    `${start}\n[[style]]\nobject = ["Table"]\nstrip = "builtin:fine"\n`);
});

test('strips are chosen from their pictures', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await page.mouse.click(...await placeOf('Vase'));
  await page.click('.knob .open');
  // A canvas that nothing was drawn to is 300 wide.
  await page.waitForFunction(() =>
    ![null, undefined, 300].includes(
      document.querySelector('.strips button[title="builtin:cel"] canvas')?.width));
  await page.click('.strips button[title="builtin:cel"]');
  await shownWhere((now) => now !== first, 'the vase in another strip');
  assert.equal(await knob('style[0].strip').inputValue(), 'builtin:cel');
  await picture('strips.png');
});

/** Drops a file on an element as a hand does, at a place of it. */
async function drop(selector, [x, y], name, bytes) {
  await page.evaluate(([selector, x, y, name, bytes]) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
    const place = document.querySelector(selector);
    for (const kind of ['dragover', 'drop'])
      place.dispatchEvent(new DragEvent(kind,
        { dataTransfer, clientX: x, clientY: y, bubbles: true, cancelable: true }));
  }, [selector, x, y, name, [...bytes]]);
}

function paintedFile(name, ...settings) {
  const file = join(folder, name);
  execFileSync(KAGEFUDE, ['strip', 'make', file, '--preset', 'soft',
    ...['width=64', 'height=64', ...settings].flatMap((set) => ['--set', set])]);
  const bytes = readFileSync(file);
  rmSync(file);
  return bytes;
}

test('a strip is dropped on a thing, and never over another one', async () => {
  const first = await shownWhere(() => true, 'a picture');
  const red = paintedFile('red.png', 'stops=[0,0.2,0,0, 1,1,0.3,0.2]');
  const blue = paintedFile('blue.png', 'stops=[0,0,0,0.2, 1,0.3,0.4,1]');
  await drop('#canvas', await placeOf('Vase'), 'vase.png', red);
  await page.waitForFunction(() => document.getElementById('scope').value === 'style 0');
  const inRed = await shownWhere((now) => now !== first, 'the vase in red');
  assert.equal(await knob('style[0].strip').inputValue(), 'strips/vase.png');
  assert.deepEqual(readFileSync(join(folder, 'strips/vase.png')), red);
  await picture('dropped.png');

  const questions = [];
  page.once('dialog', (dialog) => {
    questions.push(dialog.message());
    dialog.accept();
  });
  await drop('#panel', [1000, 400], 'vase.png', blue);
  await shownWhere((now) => now !== inRed && now !== first, 'the vase in blue');
  assert.match(questions[0], /vase\.png is there already/);
  assert.equal(await knob('style[0].strip').inputValue(), 'strips/vase-2.png');
  assert.deepEqual(readFileSync(join(folder, 'strips/vase.png')), red);

  await drop('#canvas', await placeOf('Table'), 'table.png', red);
  await page.waitForFunction(() => document.getElementById('scope').value === 'style 1');
  assert.equal(await knob('style[1].strip').inputValue(), 'strips/table.png');
  await drop('#canvas', await placeOf('Vase'), 'notes.txt', Buffer.from('hello'));
  await page.waitForFunction(() =>
    document.getElementById('error').textContent.includes('not named as a picture'));
  // That the browser notes the refusal is as it should be.
  strange.splice(0, strange.length, ...strange.filter((what) => !what.includes('status of 400')));
  rmSync(join(folder, 'strips'), { recursive: true });
});

test('a strip is painted in the page', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await page.mouse.click(...await placeOf('Vase'));
  await page.click('.knob .open');
  await page.click('text=paint one…');
  const ink = () => page.locator('.easel canvas').evaluate((canvas) =>
    canvas.width > 1 && canvas.getContext('2d').getImageData(0, 0, 64, 64).data.join());
  const wait = async (fits) => {
    for (let i = 0; i < 100; ++i) {
      const now = await ink();
      if (now && fits(now)) return now;
      await page.waitForTimeout(50);
    }
    return assert.fail('the strip is not painted');
  };
  const soft = await wait(() => true);
  await page.fill('#paint-bands + input', '3');
  await page.press('#paint-bands + input', 'Tab');
  await wait((now) => now !== soft);
  await page.fill('#paint-stops', '0, 0.1, 0, 0.3, 1, 1, 0, 0.2');
  await page.press('#paint-stops', 'Tab');
  const dark = page.getByLabel('colour 1', { exact: true });
  assert.equal(await dark.inputValue(), '#1a004d');
  await page.getByLabel('colour 2', { exact: true }).fill('#ffe633');
  const numbers = () => page.inputValue('#paint-stops');
  assert.equal(await numbers(), '0, 0.1, 0, 0.3, 1, 1, 0.902, 0.2');
  const track = await page.locator('.easel .track').boundingBox();
  await page.mouse.click(track.x + track.width / 2, track.y + 5);
  assert.match(await numbers(), /^0, 0\.1, 0, 0\.3, 0\.(49|5)\d*, 0\.5\d*, 0\.4\d+, 0\.2\d+, 1, 1, 0\.902, 0\.2$/);
  await page.getByLabel('place of colour 2').fill('0.75');
  assert.match(await numbers(), /^0, 0\.1, 0, 0\.3, 0\.75, /);
  await picture('stops.png');
  await page.getByLabel('remove colour 2').click();
  assert.equal(await numbers(), '0, 0.1, 0, 0.3, 1, 1, 0.902, 0.2');
  await page.fill('.easel .name', 'mine.png');
  await page.click('text=keep and use');
  await shownWhere((now) => now !== first, 'the vase in the painted strip');
  assert.equal(await knob('style[0].strip').inputValue(), 'strips/mine.png');
  await picture('painted_strip.png');
  const made = paintedFile('same.png', 'width=512', 'height=512', 'bands=3',
    'stops=[0,0.1,0,0.3, 1,1,0.902,0.2]');
  assert.deepEqual(readFileSync(join(folder, 'strips/mine.png')), made);
  rmSync(join(folder, 'strips'), { recursive: true });
});

test('what was turned of a style stays its own when the file gets another one before it', async () => {
  await page.mouse.click(...await placeOf('Vase'));
  await page.waitForFunction(() => document.getElementById('scope').value === 'style 0');
  await type('style[0].brush.contrast', 0.2);
  await page.waitForFunction(() => !document.getElementById('save').disabled);
  const entry = '[[style]]\nobject = "Pear"\nstrip = "builtin:cel"\n\n';
  writeFileSync(look, start.replace('[[style]]', `${entry}[[style]]`));
  await page.waitForSelector('#scope [value="style 1"]', { state: 'attached' });
  await page.waitForTimeout(300);
  await page.click('#save');
  await page.waitForFunction(() => document.getElementById('save').disabled);
  const saved = readFileSync(look, 'utf8');
  assert.match(saved.slice(saved.indexOf('"Vase"')), /contrast = 0\.2/);
  assert.doesNotMatch(saved.slice(0, saved.indexOf('"Vase"')), /contrast/);
});

test('what is packed for the way is what was made', async () => {
  const differs = await page.evaluate(async () => {
    const { unpacked } = await import(new URL('unpack.js', location));
    const get = async (query) => {
      const bytes = await (await fetch(`picture?seen=0&stage=result${query}`)).arrayBuffer();
      const length = new DataView(bytes).getUint32(0, true);
      return [JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))),
        new Uint8Array(bytes, 4 + length)];
    };
    const [{ size }, plain] = await get('');
    const [{ packed }, bytes] = await get('&packed=1');
    const { data } = unpacked(bytes, ...size);
    return packed && bytes.length < plain.length / 2 ? plain.findIndex((byte, i) => byte !== data[i]) : 'not packed';
  });
  assert.equal(differs, -1);
});

test('a style that is in no file yet stays what it is when the file gets another one', async () => {
  await page.mouse.click(...await placeOf('Table'));
  await page.click('#own');
  await page.waitForSelector('#scope [value="style 1"]', { state: 'attached' });
  const other = '\n[[style]]\nobject = "Pear"\nstrip = "builtin:cel"\n';
  writeFileSync(look, start + other);
  await page.waitForSelector('#scope [value="style 2"]', { state: 'attached' });
  const names = await page.locator('#scope option').allTextContents();
  assert.deepEqual(names, ['whole look', 'style 1 Vase', 'style 2 Pear', 'style 3 Table']);
  await page.click('#save');
  await page.waitForFunction(() => document.getElementById('save').disabled);
  assert.equal(readFileSync(look, 'utf8'), `${start}${other}\n[[style]]\nobject = ["Table"]\n`);
});

test('a light is dragged where the frame has the shapes that cast its shadow', async () => {
  assert.ok(await page.isHidden('#light'));
  const [served, place] = await serve(join(CASTERS, 'shot.0001.exr'));
  try {
    await page.goto(place);
    await page.waitForSelector('#light:visible');
    await page.selectOption('#light', 'Key');
    const first = await shownWhere(() => true, 'a picture');
    const box = await page.locator('#canvas').boundingBox();
    await page.mouse.move(box.x + 300, box.y + 300);
    await page.mouse.down();
    await page.mouse.move(box.x + 420, box.y + 330, { steps: 5 });
    await page.mouse.up();
    const moved = await shownWhere((now) => now !== first, 'the light from elsewhere');
    await page.waitForFunction(() => document.querySelector('#scope [value="light 0"]'));
    await page.selectOption('#scope', 'light 0');
    assert.match(await knob('light[0].position').inputValue(), /^-?[\d.]+(, -?[\d.]+){2}$/);
    await picture('dragged_light.png');
    await page.click('#undo');
    await shownWhere((now) => now === first, 'the light where it was');
    await page.click('#redo');
    await shownWhere((now) => now === moved, 'the moved light again');
  } finally {
    await page.close(); // which else would complain that nobody answers
    served.kill('SIGINT');
  }
});

test('a wipe shows the beauty beside the result', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await page.selectOption('#against', 'stage beauty');
  const half = await shownWhere((now) => now !== first, 'half of each');
  await picture('wipe.png');
  const box = await page.locator('#canvas').boundingBox();
  const middle = box.x + box.width / 2;
  await page.mouse.move(middle, box.y + 300);
  await page.mouse.down();
  await page.mouse.move(middle - 200, box.y + 300, { steps: 4 });
  await page.mouse.up();
  await shownWhere((now) => now !== half && now !== first, 'another share of each');
  await page.selectOption('#against', '');
  await shownWhere((now) => now === first, 'the result alone');
  await page.click('#store');
  await type('tone.gamma', 3);
  const compared = await shownWhere((now) => now !== first, 'the stored one beside the new one');
  await page.selectOption('#against', '');
  await shownWhere((now) => now !== compared && now !== first, 'the new one alone');
});

test('stages, exposure and views are looked at', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await page.click('#stages button:has-text("visibility.Key")');
  const mask = await shownWhere((now) => now !== first, 'the visibility');
  await page.click('#stages button:has-text("result")');
  await shownWhere((now) => now === first, 'the result');
  await page.selectOption('#display', '["sRGB","Raw"]');
  const raw = await shownWhere((now) => now !== first && now !== mask, 'the raw view');
  await page.fill('#exposure', '2');
  await shownWhere((now) => now !== raw, 'the raw view two stops up');
});

test('save writes what was turned and leaves the rest of the file', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await type('tone.gamma', 2);
  const turned = await shownWhere((now) => now !== first, 'another picture');
  await page.keyboard.press('Control+s');
  await page.waitForFunction(() => document.getElementById('save').disabled);
  assert.equal(readFileSync(look, 'utf8'), start.replace('gamma = 1.0   #', 'gamma = 2   #'));
  await shownWhere((now) => now === turned, 'the same as before');
  assert.equal(await page.locator('.knob.changed').count(), 0);
  await page.click('#undo');
  await shownWhere((now) => now === first, 'what was before the save');
  await page.click('#save');
  await page.waitForFunction(() => document.getElementById('save').disabled);
  assert.equal(readFileSync(look, 'utf8'), start.replace('gamma = 1.0   #', 'gamma = 1   #'));
});

test('an edit on disk shows by itself; a broken one tells its line over the last picture', async () => {
  const first = await shownWhere(() => true, 'a picture');
  writeFileSync(look, start.replace('gamma = 1.0', 'gama = 1.0'));
  await page.waitForSelector('#error:visible');
  assert.match(await page.textContent('#error'), /look\.toml:5: \[tone\] has no key gama/);
  assert.equal(await shown(), first);
  await picture('broken.png');
  await type('tone.black', 0.3);
  await page.waitForTimeout(300);
  assert.ok(await page.isVisible('#error'));
  await page.click('#undo');
  writeFileSync(look, start.replace('gamma = 1.0', 'gamma = 2.5'));
  await page.waitForSelector('#error', { state: 'hidden' });
  await shownWhere((now) => now !== first, 'the edited look');
  assert.equal(await field('tone.gamma').inputValue(), '2.5');
});

test('zoom goes to single pixels, and a small window holds everything', async () => {
  const first = await shownWhere(() => true, 'a picture');
  await page.mouse.move(...await placeOf('Vase'));
  for (let i = 0; i < 14; ++i) await page.mouse.wheel(0, -200);
  await shownWhere((now) => now !== first, 'a larger picture');
  await picture('zoom.png');
  await page.setViewportSize({ width: 420, height: 760 });
  await page.click('#fit');
  await page.waitForTimeout(300);
  await picture('small.png');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert.ok(wide <= 0, `the page is ${wide} pixels too wide`);
  for (const id of ['canvas', 'knobs', 'stages']) {
    const box = await page.locator(`#${id}`).boundingBox();
    assert.ok(box.width > 100 && box.height > 20 && box.y + box.height <= 761, id);
  }
});

test('nothing strange happened', () => assert.deepEqual(strange, []));
