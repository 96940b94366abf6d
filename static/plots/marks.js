/**
 * Points on the curves that say what they are under the pointer or by Tab, and take the time there when pressed: round
 * on the pitch step's, square on the yaw step's.
 */
import { button, drawingUnit, h, setAttr, setText } from '../ui/index.js';

/** @typedef {import('./characteristics.js').Mark} Mark */
const MOST = 4; // of a plot: rise, peak, settling, the other axis

export class PlotMarks {
  /** @type {Mark[]} */ #marks = [];
  /** @type {number|null} which one speaks */ #told = null;

  /** @param {import('../ui/picture_scale.js').Chart} chart @param {(t: number) => void} onSeek */
  constructor(chart, onSeek) {
    this.chart = chart;
    this.points = Array.from({ length: MOST }, (_, i) =>
      button({
        class: 'mark-point',
        hidden: true,
        onclick: (/** @type {Event} */ e) => {
          e.stopPropagation();
          onSeek(this.#marks[i].t);
        },
        onmousedown: (/** @type {Event} */ e) => e.stopPropagation(), // or the plot begins to zoom
        onpointerenter: () => this.#tell(i),
        onpointerleave: () => this.#tell(null),
        onfocus: () => this.#tell(i),
        onblur: () => this.#tell(null),
        onkeydown: (/** @type {KeyboardEvent} */ e) => this.#key(e),
      }),
    );
    this.tip = h('div', { class: 'mark-tip', hidden: true, 'aria-hidden': 'true' });
    chart.over.append(...this.points, this.tip);
  }

  /** @param {Mark[]} marks */
  show(marks) {
    this.#marks = marks.slice(0, MOST);
    this.points.forEach((point, i) => {
      const mark = this.#marks[i];
      if (!mark) return;
      setAttr(point, 'class', `mark-point ${mark.axis === 'theta' ? 'pitch' : 'yaw'}`);
      setAttr(point, 'data-testid', `mark-${mark.kind}`);
      point.setAttribute('aria-label', mark.text); // its words are the page's language already
    });
    this.place();
  }

  /** To be called when the scales have changed. */
  place() {
    const { chart } = this;
    const { x, y } = /** @type {import('../ui/picture_scale.js').Ranges} */ (chart.scales);
    this.points.forEach((point, i) => {
      const mark = this.#marks[i];
      point.hidden = !mark || !(mark.t >= x.min && mark.t <= x.max && mark.value >= y.min && mark.value <= y.max);
      if (!point.hidden)
        point.style.transform =
          `translate(${chart.valToPos(mark.t, 'x').toFixed(1)}px, ` +
          `${chart.valToPos(mark.value, 'y').toFixed(1)}px)`;
    });
    if (this.#told !== null) this.#tell(this.points[this.#told].hidden ? null : this.#told);
  }

  /** @param {number|null} i */
  #tell(i) {
    this.#told = i;
    const mark = i === null ? undefined : this.#marks[i];
    this.tip.hidden = !mark;
    if (!mark) return;
    setText(this.tip, mark.text);
    const { bbox } = this.chart;
    const [width, height] = [bbox.width, bbox.height].map((v) => v / devicePixelRatio);
    const [x, y] = [this.chart.valToPos(mark.t, 'x'), this.chart.valToPos(mark.value, 'y')];
    const gap = 9 * drawingUnit();
    const box = this.tip.getBoundingClientRect();
    const left = x + gap + box.width <= width ? x + gap : Math.max(0, x - gap - box.width);
    const top = Math.max(0, Math.min(height - box.height, y < height / 2 ? y + gap : y - gap - box.height));
    this.tip.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
  }

  /** @param {KeyboardEvent} e */
  #key(e) {
    if (e.key === 'Escape' && !this.tip.hidden) this.#tell(null);
    else if (e.key !== 'Enter' && e.key !== ' ') return; // moving the time and zooming stay the plot's
    e.stopPropagation();
  }
}
