// The picture with zoom and pan, to single pixels, and a wipe over another one.

const grip = 6; // how near to the wipe's line the pointer takes it, in CSS pixels
const still = 4; // how far a click may move

export class Viewer {
  #context;
  #picture = document.createElement('canvas');
  #other = null; // what the wipe shows on its left
  #wipe = 0.5; // where its line is, as a share of the picture
  #scale = 0; // 0: fits
  #x = 0;
  #y = 0;
  #full = [1, 1];

  /** `pointed(x, y)` and `clicked(x, y)` get the pixel of the picture under the pointer; without one
   * the pointer has left. `taken()`
   * gives what a drag does instead of moving the picture, or null: a function of the way right and
   * down, as shares of the canvas. */
  constructor(canvas, pointed, clicked, taken) {
    Object.assign(this, { canvas, clicked, taken });
    this.#context = canvas.getContext('2d');
    new ResizeObserver(() => this.#resize()).observe(canvas);
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener('pointerdown', (event) => this.#drag(event));
    canvas.addEventListener('pointermove', (event) => pointed(...this.pixelAt(event)));
    canvas.addEventListener('pointerleave', () => pointed());
  }

  /** `full` is the size of the unsampled picture, by which a proxy is laid over the same place. */
  show(pixels, full) {
    paint(this.#picture, pixels);
    this.#full = full;
    this.draw();
  }

  /** What the wipe shows, or null for none. */
  against(pixels) {
    if (pixels) this.#other = paint(this.#other ?? document.createElement('canvas'), pixels);
    else this.#other = null;
    this.draw();
  }

  fit() {
    this.#scale = 0;
    this.draw();
  }

  oneToOne() {
    this.#zoom(1, this.canvas.width / 2, this.canvas.height / 2);
  }

  /** The pixel of the shown picture under an event. */
  pixelAt(event) {
    const { scale, left, top } = this.#place();
    const perPixel = this.#picture.width / this.#full[0];
    return [
      Math.floor(((event.offsetX * devicePixelRatio - left) / scale) * perPixel),
      Math.floor(((event.offsetY * devicePixelRatio - top) / scale) * perPixel),
    ];
  }

  /** To ask for the size at every picture would lay out the whole page each time. */
  #resize() {
    const { canvas } = this;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
    this.draw();
  }

  draw() {
    this.#context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.#drawOne(this.#picture);
    if (this.#other) this.#drawWipe();
  }

  #drawOne(picture) {
    const { scale, left, top } = this.#place();
    const [width, height] = this.#full;
    this.#context.imageSmoothingEnabled = scale * (width / picture.width) < 1;
    this.#context.drawImage(picture, left, top, width * scale, height * scale);
  }

  #drawWipe() {
    const context = this.#context;
    const line = this.#line();
    context.save();
    context.beginPath();
    context.rect(0, 0, line, this.canvas.height);
    context.clip();
    this.#drawOne(this.#other);
    context.restore();
    context.fillStyle = '#ffb84d';
    context.fillRect(Math.round(line) - 1, 0, 2, this.canvas.height);
  }

  /** Where the wipe's line is on the canvas. */
  #line() {
    const { scale, left } = this.#place();
    return left + this.#wipe * this.#full[0] * scale;
  }

  #place() {
    const [width, height] = this.#full;
    const { canvas } = this;
    if (this.#scale > 0) return { scale: this.#scale, left: this.#x, top: this.#y };
    const scale = Math.min(canvas.width / width, canvas.height / height);
    return {
      scale,
      left: (canvas.width - width * scale) / 2,
      top: (canvas.height - height * scale) / 2,
    };
  }

  #zoom(scale, x, y) {
    const old = this.#place();
    this.#scale = Math.min(64, Math.max(0.02, scale));
    const factor = this.#scale / old.scale;
    this.#x = x - (x - old.left) * factor;
    this.#y = y - (y - old.top) * factor;
    this.draw();
  }

  #wheel(event) {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.002));
    this.#zoom(
      this.#place().scale * factor,
      event.offsetX * devicePixelRatio,
      event.offsetY * devicePixelRatio,
    );
  }

  #drag(start) {
    const wipes =
      this.#other && Math.abs(start.offsetX - this.#line() / devicePixelRatio) <= grip;
    const follow = wipes ? this.#wiping() : this.#moving(start, this.taken());
    let moved = wipes;
    const move = (event) => {
      moved ||= Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) > still;
      if (moved) follow(event);
    };
    const end = new AbortController();
    const { signal } = end;
    this.canvas.setPointerCapture(start.pointerId);
    this.canvas.addEventListener('pointermove', move, { signal });
    this.canvas.addEventListener('pointercancel', () => end.abort(), { signal });
    this.canvas.addEventListener('pointerup', (event) => {
      end.abort();
      if (!moved && event.button === 0) this.clicked(...this.pixelAt(event));
    }, { signal });
  }

  #wiping() {
    return (event) => {
      const { scale, left } = this.#place();
      const share = (event.offsetX * devicePixelRatio - left) / (this.#full[0] * scale);
      this.#wipe = Math.min(1, Math.max(0, share));
      this.draw();
    };
  }

  #moving(start, taken) {
    if (!taken) return this.#panning(start);
    const { clientWidth } = this.canvas;
    return (event) => taken(
      (event.clientX - start.clientX) / clientWidth,
      (event.clientY - start.clientY) / clientWidth,
    );
  }

  #panning(start) {
    const from = this.#place();
    return (event) => {
      this.#scale = from.scale;
      this.#x = from.left + (event.clientX - start.clientX) * devicePixelRatio;
      this.#y = from.top + (event.clientY - start.clientY) * devicePixelRatio;
      this.draw();
    };
  }
}

function paint(canvas, pixels) {
  const { width, height } = pixels;
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  canvas.getContext('2d').putImageData(pixels, 0, 0);
  return canvas;
}
