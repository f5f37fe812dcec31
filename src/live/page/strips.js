// Thumbnails of the strips that a style can have.
import { strip, strips } from './link.js';

/** A button and a place for the thumbnails; `chosen(name)` is told which was clicked. */
export function stripChoice(chosen) {
  const button = Object.assign(document.createElement('button'),
    { className: 'open', textContent: '▦', title: 'choose from pictures' });
  const place = Object.assign(document.createElement('div'), { className: 'strips', hidden: true });
  button.onclick = async () => {
    place.hidden = !place.hidden;
    if (place.hidden || place.children.length) return;
    for (const name of await strips()) place.append(thumbnail(name, chosen));
    // One after the other: a strip is loaded whole for its picture.
    for (const made of [...place.children]) await made.load();
  };
  return [button, place];
}

function thumbnail(name, chosen) {
  const made = Object.assign(document.createElement('button'), { title: name });
  const canvas = document.createElement('canvas');
  made.append(canvas, name.replace(/^.*[/:]/, ''));
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
