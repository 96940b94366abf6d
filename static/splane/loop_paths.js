/**
 * Where the PI loops take the placed poles: as their gains grow from nothing to what is set, integral times as they
 * are, the four poles and the two integrators at 0 move to the six poles of the whole loop. With E(s) = s² I − A₂₂ s −
 * A₂₁ of the inner loop the characteristic polynomial is s² det(E + ε B₂ W diag(kp (1 + 1/(T_i s)))), a square
 * polynomial in ε: known at 0 and at 1, and its last term is det(B₂ W) times both controllers. Pure.
 * @typedef {import('../types.js').Complex} Complex
 * @typedef {Complex[][]} Paths  of the placed poles, in their order, each from itself to a pole of the whole loop
 */
const STEPS = 48;
const SWEEPS = 60;
const APART = 1e-5; // coincident roots are parted, and real ones leave the axis, which they otherwise cannot
const ENOUGH = 1e-12;
const AGREES = 1e-3; // relative distance of the ends to the server's poles; else the search has not converged

/** @param {Complex} a @param {Complex} b */
const times = (a, b) => ({ re: a.re * b.re - a.im * b.im, im: a.re * b.im + a.im * b.re });

/**
 * Coefficients of a monic polynomial, highest power first, from roots that are conjugate to each other.
 * @param {readonly Complex[]} roots
 */
export function polynomial(roots) {
  let p = [{ re: 1, im: 0 }];
  for (const r of roots)
    p = [...p, { re: 0, im: 0 }].map((c, i) =>
      i ? { re: c.re - times(p[i - 1], r).re, im: c.im - times(p[i - 1], r).im } : c,
    );
  return p.map((c) => c.re);
}

/**
 * One sweep of Aberth's method over all roots at once.
 * @param {number[]} p monic
 * @param {Complex[]} z changed
 * @returns {number} the largest relative step
 */
function sweep(p, z) {
  let most = 0;
  for (let i = 0; i < z.length; i++) {
    let [value, slope] = [
      { re: 0, im: 0 },
      { re: 0, im: 0 },
    ];
    for (const c of p) {
      slope = times(slope, z[i]);
      slope = { re: slope.re + value.re, im: slope.im + value.im };
      value = times(value, z[i]);
      value = { re: value.re + c, im: value.im };
    }
    const others = z.reduce(
      (sum, w, j) => {
        const [x, y] = [z[i].re - w.re, z[i].im - w.im];
        const size = x * x + y * y;
        return j === i || size === 0 ? sum : { re: sum.re + x / size, im: sum.im - y / size };
      },
      { re: 0, im: 0 },
    );
    const below = times(value, others);
    const d = { re: slope.re - below.re, im: slope.im - below.im };
    const size = d.re * d.re + d.im * d.im;
    if (size === 0) continue;
    const step = times(value, { re: d.re / size, im: -d.im / size });
    z[i] = { re: z[i].re - step.re, im: z[i].im - step.im };
    most = Math.max(most, Math.hypot(step.re, step.im) / Math.max(1, Math.hypot(z[i].re, z[i].im)));
  }
  return most;
}

/**
 * det(B₂ W): B₂ as the angles feel the motors, W which motor answers for which error, and with which sign.
 * @param {number[][]} K
 * @param {number[][]} A
 * @param {number[][]} B
 * @param {{pairing: string, decoupler: boolean}} how
 */
function crossDeterminant(K, A, B, { pairing, decoupler }) {
  const [[b11, b12], [b21, b22]] = [B[2], B[3]];
  const det = b11 * b22 - b12 * b21;
  const statics = [0, 1].map((i) =>
    [0, 1].map((j) => (i ? -b21 * A[2][j] + b11 * A[3][j] : b22 * A[2][j] - b12 * A[3][j]) / det),
  );
  const [[a, b], [c, d]] = [0, 1].map((i) => [0, 1].map((j) => K[i][j] - statics[i][j])); // Ĝ(0)⁻¹
  const inverse = a * d - b * c;
  const [pitch, yaw] = pairing === 'cross' ? [-b, -c] : [d, a];
  if (decoupler) return (det * inverse * Math.abs(pitch * yaw)) / (inverse * inverse || 1);
  const sign = (/** @type {number} */ v) => ((inverse < 0 ? -v : v) < 0 ? -1 : 1);
  return pairing === 'cross' ? -det * sign(pitch) * sign(yaw) : det;
}

/**
 * @param {import('../types.js').Reply|null} reply @param {import('../types.js').Design|null} design that it answers
 * @returns {Paths|null} null where there are no PI loops, or the paths are not found
 */
export function loopPaths(reply, design) {
  const { K, A, B, closed_loop_poles: placed } = reply?.gains ?? {};
  if (!reply || !K || !A || !B || !placed || design?.outer !== 'pi' || reply.loop_poles.length !== 6) return null;
  const { pitch, yaw } = design.loops;
  const start = polynomial([...placed, { re: 0, im: 0 }, { re: 0, im: 0 }]);
  const end = polynomial(reply.loop_poles);
  const both = crossDeterminant(K, A, B, design) * pitch.kp * yaw.kp;
  const square = [0, 0, 0, 0, both, both * (1 / pitch.ti + 1 / yaw.ti), both / (pitch.ti * yaw.ti)];
  const linear = end.map((v, i) => v - start[i] - square[i]);
  const size = Math.max(1, ...placed.map((p) => Math.hypot(p.re, p.im)));
  let z = [...placed, { re: 0, im: 0 }, { re: 0, im: 0 }];
  const paths = placed.map((p) => [p]);
  for (let k = 1; k <= STEPS; k++) {
    const share = (k / STEPS) ** 2; // the integrators leave 0 as a root of the gain
    const p = start.map((v, i) => v + share * (linear[i] + share * square[i]));
    z = z.map((r, i) => ({
      re: r.re + APART * size * Math.cos(2 * i + 1),
      im: r.im + APART * size * Math.sin(2 * i + 1),
    }));
    for (let n = 0; n < SWEEPS && sweep(p, z) > ENOUGH; n++);
    paths.forEach((path, i) => path.push({ ...z[i] }));
  }
  /** @type {Set<number>} */ const taken = new Set();
  for (const path of paths) {
    const last = path[path.length - 1];
    const away = reply.loop_poles.map((p, i) => (taken.has(i) ? Infinity : Math.hypot(p.re - last.re, p.im - last.im)));
    const to = away.indexOf(Math.min(...away));
    if (!(away[to] <= AGREES * Math.max(size, Math.hypot(last.re, last.im)))) return null;
    taken.add(to);
    path[path.length - 1] = reply.loop_poles[to];
  }
  return paths;
}
