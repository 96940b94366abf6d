/** How quick the page is, measured where it matters: from the pointer's event to the redrawn plots. No DOM. */

const KEPT = 240;

/** @param {number[]} values @param {number} q */
export function quantile(values, q) {
  if (!values.length) return undefined;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(q * sorted.length))];
}

export class Stats {
  /** @type {number[]} */ #latencies = [];
  /** @type {number[]} */ #times = [];
  /** @type {number[]} */ #renders = [];
  updates = 0;

  /**
   * @param {number} now
   * @param {number|undefined} stamp time of the input event that asked for this
   * @param {number} render ms spent drawing
   */
  drawn(now, stamp, render) {
    this.updates += 1;
    this.#keep(this.#times, now);
    this.#keep(this.#renders, render);
    if (stamp !== undefined) this.#keep(this.#latencies, now - stamp);
  }

  reset() {
    this.updates = 0;
    for (const list of [this.#latencies, this.#times, this.#renders]) list.length = 0;
  }

  /** @param {number[]} list @param {number} value */
  #keep(list, value) {
    list.push(value);
    if (list.length > KEPT) list.shift();
  }

  /** Milliseconds, and updates per second over those kept. */
  summary() {
    const span = this.#times.length > 1 ? this.#times[this.#times.length - 1] - this.#times[0] : 0;
    const round = (/** @type {number|undefined} */ v) => (v === undefined ? null : Math.round(v * 100) / 100);
    return {
      updates: this.updates,
      perSecond: span > 0 ? round((1000 * (this.#times.length - 1)) / span) : null,
      last: round(this.#latencies[this.#latencies.length - 1]),
      median: round(quantile(this.#latencies, 0.5)),
      p95: round(quantile(this.#latencies, 0.95)),
      render: round(quantile(this.#renders, 0.5)),
      latencies: this.#latencies.map((v) => round(v)),
    };
  }
}
