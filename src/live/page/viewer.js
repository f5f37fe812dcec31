// The picture with zoom and pan, to single pixels.

export class Viewer {
  #context;
  #picture = document.createElement('canvas');
  #scale = 0; // 0: fits
  #x = 0;
  #y = 0;
  #full = [1, 1];

  /** `pointed(x, y)` gets the pixel of the picture under the pointer, or nothing outside. */
  constructor(canvas, pointed) {
    this.canvas = canvas;
    this.#context = canvas.getContext('2d');
    new ResizeObserver(() => this.draw()).observe(canvas);
    canvas.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener('pointerdown', (event) => this.#drag(event));
    canvas.addEventListener('pointermove', (event) => pointed(...this.pixelAt(event)));
  }

  /** `full` is the size of the unsampled picture, by which a proxy is laid over the same place. */
  show(pixels, full) {
    this.#picture.width = pixels.width;
    this.#picture.height = pixels.height;
    this.#picture.getContext('2d').putImageData(pixels, 0, 0);
    this.#full = full;
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
    const ratio = devicePixelRatio;
    const perPixel = this.#picture.width / this.#full[0];
    return [
      Math.floor(((event.offsetX * ratio - left) / scale) * perPixel),
      Math.floor(((event.offsetY * ratio - top) / scale) * perPixel),
    ];
  }

  draw() {
    const { canvas } = this;
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * devicePixelRatio));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * devicePixelRatio));
    const { scale, left, top } = this.#place();
    this.#context.imageSmoothingEnabled = scale * (this.#full[0] / this.#picture.width) < 1;
    this.#context.drawImage(this.#picture, left, top, this.#full[0] * scale, this.#full[1] * scale);
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
    const from = this.#place();
    const move = (event) => {
      this.#scale = from.scale;
      this.#x = from.left + (event.clientX - start.clientX) * devicePixelRatio;
      this.#y = from.top + (event.clientY - start.clientY) * devicePixelRatio;
      this.draw();
    };
    const end = () => {
      this.canvas.removeEventListener('pointermove', move);
      this.canvas.removeEventListener('pointerup', end);
      this.canvas.removeEventListener('pointercancel', end);
    };
    this.canvas.setPointerCapture(start.pointerId);
    this.canvas.addEventListener('pointermove', move);
    this.canvas.addEventListener('pointerup', end);
    this.canvas.addEventListener('pointercancel', end);
  }
}
