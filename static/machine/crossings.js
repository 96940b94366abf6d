/**
 * Where a path leaves the left half-plane. Pure.
 * @param {readonly import('../types.js').Complex[]} path
 * @returns {import('../types.js').Complex[]} on the imaginary axis
 */
export const crossings = (path) =>
  path.slice(1).flatMap((b, i) => {
    const a = path[i];
    if (!(a.re < 0 && b.re >= 0)) return [];
    const share = a.re / (a.re - b.re);
    return [{ re: 0, im: a.im + share * (b.im - a.im) }];
  });
