// Strips that are dropped in as files.
import { offerStrip } from './link.js';

/** Keeps a strip under `name`: `offer(name, anyway)` gives it to the program, which may have a
 * question first. Gives what the look calls it, or null when the answer was no. */
export async function keep(offer, name) {
  for (let as = name, anyway = false; ; anyway = true) {
    const { strip, question, freeName } = await offer(as, anyway);
    if (strip) return strip;
    if (!confirm(question)) return null;
    as = freeName;
  }
}

/** Keeps a picture's file; see keep. */
export function keepFile(file) {
  return keep((name, anyway) => offerStrip(file, name, anyway), file.name);
}

/** A file that is dropped on `place` goes to `dropped(file, event)`. */
export function takeDrops(place, dropped) {
  const shows = (on) => place.classList.toggle('dropping', on);
  place.addEventListener('dragover', (event) => {
    if (!event.dataTransfer.types.includes('Files')) return;
    event.preventDefault();
    shows(true);
  });
  place.addEventListener('dragleave', () => shows(false));
  place.addEventListener('drop', (event) => {
    event.preventDefault();
    shows(false);
    const [file] = event.dataTransfer.files;
    if (file) dropped(file, event);
  });
}

// A file that misses would be opened in the page's place, and what was turned be lost.
for (const kind of ['dragover', 'drop']) addEventListener(kind, (event) => event.preventDefault());
