// The strips that a style can have: their pictures, those of files, and painted ones.
import { easel } from './easel.js';
import { element } from './control.js';
import { strip, strips } from './link.js';
import { keepFile } from './strip_drop.js';

const suffixes = '.png,.exr,.tif,.tiff,.jpg,.jpeg,.webp,.psd,.tga';

/** A button and a place for the thumbnails; `chosen(name)` is told which was clicked, kept or
 * painted, `failed(text)` what went wrong. */
export function stripChoice(chosen, failed) {
  const button = element('button', { className: 'open', textContent: '▦', title: 'choose from pictures' });
  const pictures = element('div', { className: 'strips' });
  const file = element('input', { type: 'file', accept: suffixes, hidden: true });
  const add = element('button', { textContent: 'add a file…',
    title: 'A picture can also be dropped here, or on a thing in the picture' });
  const paint = element('button', { textContent: 'paint one…' });
  const board = element('div', { hidden: true });
  const place = element('div', { className: 'choice', hidden: true },
    element('div', { className: 'bar' }, add, file, paint), board, pictures);

  const fill = async () => {
    pictures.replaceChildren(...(await strips()).map((name) => thumbnail(name, chosen)));
    // One after the other: a strip is loaded whole for its picture.
    for (const made of [...pictures.children]) await made.load();
  };
  const kept = (name) => {
    chosen(name);
    fill();
  };
  button.onclick = () => {
    place.hidden = !place.hidden;
    if (!place.hidden && !pictures.children.length) fill();
  };
  add.onclick = () => file.click();
  file.onchange = async () => {
    try {
      const name = file.files.length ? await keepFile(file.files[0]) : null;
      if (name) kept(name);
    } catch (problem) {
      failed(problem.message);
    }
    file.value = '';
  };
  paint.onclick = async () => {
    board.hidden = !board.hidden;
    if (!board.hidden && !board.children.length) board.append(await easel(kept));
  };
  return [button, place];
}

function thumbnail(name, chosen) {
  const canvas = element('canvas');
  const made = element('button', { title: name }, canvas, name.replace(/^.*[/:]/, ''));
  made.onclick = () => chosen(name);
  made.load = async () => {
    const pixels = await strip(name).catch(() => null);
    if (!pixels) return made.remove(); // a picture that is no strip
    canvas.width = pixels.width;
    canvas.height = pixels.height;
    canvas.getContext('2d').putImageData(pixels, 0, 0);
  };
  return made;
}
