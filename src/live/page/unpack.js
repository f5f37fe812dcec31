// Pixels as the program packs them: chunks of the QOI format (qoiformat.org), of which it uses four.

const opaque = 0xff000000; // of a pixel as a little-endian number: A, B, G, R

/** The ImageData of `width` times `height` pixels that `bytes` hold. */
export function unpacked(bytes, width, height) {
  const image = new ImageData(width, height);
  const out = new Uint32Array(image.data.buffer);
  let r = 0;
  let g = 0;
  let b = 0;
  for (let i = 0, at = 0; i < out.length && at < bytes.length;) {
    const tag = bytes[at++];
    let pixels = 1;
    if (tag === 0xfe) { // a colour
      r = bytes[at++];
      g = bytes[at++];
      b = bytes[at++];
    } else if (tag >= 0xc0) { // the last one again
      pixels = (tag & 63) + 1;
    } else if (tag >= 0x80) { // a step of green, and what red and blue differ from it
      const beside = bytes[at++];
      const step = (tag & 63) - 32;
      r = (r + step + (beside >> 4) - 8) & 255;
      g = (g + step) & 255;
      b = (b + step + (beside & 15) - 8) & 255;
    } else { // a small step of each
      r = (r + ((tag >> 4) & 3) - 2) & 255;
      g = (g + ((tag >> 2) & 3) - 2) & 255;
      b = (b + (tag & 3) - 2) & 255;
    }
    const pixel = opaque | (b << 16) | (g << 8) | r;
    for (; pixels > 0; --pixels) out[i++] = pixel;
  }
  return image;
}
