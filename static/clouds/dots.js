/**
 * Poles of many rigs as dots behind the s-plane's own: thousands of them in a frame, so they are written as pixels, and
 * where several lie the dot is the denser.
 */

const DOT = 2;
/** @type {unknown} */ let drawn = null;
/** @type {{image: ImageData, pixels: Uint32Array}|null} kept from one picture to the next */ let kept = null;

/**
 * @param {HTMLCanvasElement} canvas
 * @param {import('../splane/math.js').View} view
 * @param {number} unit CSS pixels to one of the view's
 * @param {import('../types.js').Cloud|null} cloud
 */
export function drawCloud(canvas, view, unit, cloud) {
  const key = cloud ? JSON.stringify(view) : '';
  if (canvas.dataset.view === key && drawn === cloud) return;
  canvas.dataset.view = key;
  drawn = cloud;
  canvas.hidden = !cloud;
  const ratio = devicePixelRatio * unit;
  const [width, height] = [Math.round(view.width * ratio), Math.round(view.height * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const ctx = canvas.getContext('2d', { willReadFrequently: true }); // its pixels come from here, and stay here
  if (!ctx || !width || !height) return;
  if (!cloud) {
    ctx.clearRect(0, 0, width, height);
    return;
  }
  const style = getComputedStyle(canvas);
  const colors = ['--muted', '--danger'].map((name) => colorOf(ctx, style.getPropertyValue(name)));
  if (kept?.image.width !== width || kept.image.height !== height) {
    const image = ctx.createImageData(width, height);
    kept = { image, pixels: new Uint32Array(image.data.buffer) };
  }
  kept.pixels.fill(0);
  const at = { cx: view.cx, cy: view.cy, scale: view.scale * ratio, width, height };
  fillDots(kept.pixels, at, Math.max(1, Math.round(DOT * ratio)), cloud, colors);
  ctx.putImageData(kept.image, 0, 0);
}

/** @type {Map<string, number>} */ const known = new Map();

/**
 * Red, green and blue of a CSS color, as a pixel has them.
 * @param {CanvasRenderingContext2D} ctx whose first pixel is painted @param {string} color
 */
function colorOf(ctx, color) {
  const own = known.get(color);
  if (own !== undefined) return own;
  ctx.fillStyle = color;
  ctx.fillRect(0, 0, 1, 1);
  const [value] = new Uint32Array(ctx.getImageData(0, 0, 1, 1).data.buffer);
  known.set(color, value & RGB);
  return value & RGB;
}

/** Of a pixel's four bytes, little-endian: alpha stands last. */
const RGB = 0xffffff;

/**
 * Unstable poles over the others.
 * @param {Uint32Array} pixels a picture's, row by row, empty
 * @param {import('../splane/math.js').View} view in these pixels
 * @param {number} size of a dot
 * @param {Pick<import('../types.js').Cloud, 'poles'|'done'>} cloud
 * @param {readonly number[]} colors of stable and of unstable poles
 */
export function fillDots(pixels, view, size, { poles, done }, colors) {
  const opacity = done > 500 ? 0.25 : 0.5;
  const denser = Uint32Array.from({ length: 256 }, (_, a) => Math.round(a + (255 - a) * opacity));
  const { cx, cy, scale, width, height } = view;
  const [left, top] = [width / 2 - size / 2, height / 2 - size / 2];
  colors.forEach((color, unstable) => {
    for (let i = 0; i < poles.length; i += 2) {
      const re = poles[i];
      if (re >= 0 !== Boolean(unstable)) continue;
      const x = Math.round(left + (re - cx) * scale);
      const y = Math.round(top - (poles[i + 1] - cy) * scale);
      if (!(x >= 0 && y >= 0 && x + size <= width && y + size <= height)) continue; // nor where there is none
      for (let row = y; row < y + size; row++) {
        for (let p = row * width + x; p < row * width + x + size; p++)
          pixels[p] = ((denser[pixels[p] >>> 24] << 24) | color) >>> 0;
      }
    }
  });
}
