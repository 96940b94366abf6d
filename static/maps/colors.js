/**
 * The colours of maps: from what is good, light, to what is bad, dark, over yellow, green and blue. Equal steps look
 * alike (they are equally far apart in Oklab), lightness falls all the way, so that prints in grey keep the order, and
 * no step is told by red against green. Pure.
 * @typedef {[L: number, a: number, b: number]} Oklab
 */

/** Lightness, chroma and hue (degrees) along the way. @type {Record<'light'|'dark', [number, number, number][]>} */
const WAYS = {
  light: [
    [0.975, 0.045, 108],
    [0.9, 0.095, 128],
    [0.8, 0.115, 160],
    [0.68, 0.105, 200],
    [0.56, 0.115, 240],
    [0.47, 0.12, 268],
    [0.39, 0.105, 285],
  ],
  // less light, as a page in the dark must not glare; and dark up to what is no panel any more
  dark: [
    [0.74, 0.11, 112],
    [0.68, 0.115, 145],
    [0.57, 0.095, 180],
    [0.46, 0.085, 220],
    [0.37, 0.09, 255],
    [0.3, 0.085, 275],
    [0.25, 0.06, 290],
  ],
};
/** What is as good as none lies between two colours. */
const STEPS = 400;

/** @param {[number, number, number]} lch @returns {Oklab} */
const oklab = ([L, c, h]) => [L, c * Math.cos((h * Math.PI) / 180), c * Math.sin((h * Math.PI) / 180)];

/** @param {Oklab} p @param {Oklab} q */
const distance = (p, q) => Math.hypot(...p.map((v, i) => v - q[i]));

/** @param {[number, number, number][]} way @param {number} s 0 to 1 @returns {Oklab} */
function along(way, s) {
  const at = s * (way.length - 1);
  const i = Math.min(way.length - 2, Math.floor(at));
  const mix = (/** @type {number} */ k) => way[i][k] + (at - i) * (way[i + 1][k] - way[i][k]);
  return oklab([mix(0), mix(1), mix(2)]);
}

/** As sRGB, 0 to 255 (B. Ottosson's matrices). @param {Oklab} color @returns {[number, number, number]} */
export function rgb([L, a, b]) {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  const [red, green, blue] = linear.map((v) => {
    const own = Math.max(0, Math.min(1, v));
    return Math.round(255 * (own <= 0.0031308 ? 12.92 * own : 1.055 * own ** (1 / 2.4) - 0.055));
  });
  return [red, green, blue];
}

/**
 * So many colours, from good to bad, equally far apart.
 * @param {number} count
 * @param {boolean} dark  on a dark page
 * @returns {Oklab[]}
 */
export function ramp(count, dark) {
  const way = WAYS[dark ? 'dark' : 'light'];
  const points = Array.from({ length: STEPS + 1 }, (_, k) => along(way, k / STEPS));
  const lengths = [0];
  for (let k = 1; k <= STEPS; k++) lengths.push(lengths[k - 1] + distance(points[k - 1], points[k]));
  return Array.from({ length: count }, (_, n) => {
    const wanted = (lengths[STEPS] * n) / Math.max(1, count - 1);
    return points[
      Math.max(
        0,
        lengths.findIndex((l) => l >= wanted - 1e-9),
      )
    ];
  });
}

/** @param {Oklab} color */
export const css = (color) =>
  `#${rgb(color)
    .map((v) => v.toString(16).padStart(2, '0'))
    .join('')}`;
