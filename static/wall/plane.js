/**
 * Everyone's poles in one s-plane: each student's newest four, pitch's round and warm, yaw's square and blue. A hand on
 * a pole or on a row brings out all four of that student.
 * @typedef {import('./shapes.js').Student} Student
 * @typedef {import('../types.js').Complex} Complex
 */
import { count, say } from '../text/index.js';
import { niceStep, ticks } from '../model/index.js';
import { h, setAttr, setText, svg } from '../ui/index.js';

const WIDTH = 400;
const HEIGHT = 260;
const FOOT = 18; // for the numbers of the real axis
const SIZE = 4; // half a mark
/** Of all poles, the share that must be in sight: one that is far out must not make the rest tiny. */
const SEEN = 0.95;
const LEAST = 4; // rad/s, of what is seen

/**
 * What is seen: to the left so far that most poles are in sight, a little of the right half plane, one scale.
 * @param {readonly Complex[]} poles
 * @returns {{left: number, right: number, top: number, scale: number}} rad/s; pixels per rad/s
 */
export function window(poles) {
  const most = (/** @type {number[]} */ sizes) =>
    sizes.toSorted((a, b) => a - b)[Math.ceil(SEEN * sizes.length) - 1] ?? 0;
  const out = Math.max(LEAST, most(poles.map((p) => -p.re)));
  const over = Math.min(out, Math.max(0, ...poles.map((p) => p.re)));
  const up = most(poles.map((p) => Math.abs(p.im)));
  const [left, right] = [-1.12 * out, Math.max(0.12 * out, 1.15 * over)];
  const scale = Math.min(WIDTH / (right - left), (HEIGHT - FOOT) / 2 / Math.max(1.15 * up, 0.3 * out));
  const spare = WIDTH / scale - (right - left); // where the height decides
  return { left: left - 0.8 * spare, right: right + 0.2 * spare, top: (HEIGHT - FOOT) / 2 / scale, scale };
}

export class PolesPlane {
  /** @type {Map<number, SVGGElement>} */ #groups = new Map();
  /** @type {number|null} */ #pointed = null;
  #shown = '';

  /** @param {{onPoint: (id: number|null) => void, onOpen: (id: number) => void}} hands */
  constructor(hands) {
    this.hands = hands;
    this.back = svg('g', { 'aria-hidden': 'true' });
    this.front = svg('g', { class: 'everyone' });
    this.drawing = svg(
      'svg',
      { class: 'class-plane', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'data-testid': 'class-plane' },
      this.back,
      this.front,
    );
    this.words = h('p', { class: 'caption plane-words', 'data-testid': 'plane-words' });
    this.node = h(
      'section',
      { class: 'panel everyone-panel', 'aria-labelledby': 'plane-title' },
      h('h2', { id: 'plane-title' }, 'Everyone’s poles'),
      this.drawing,
      this.words,
    );
  }

  /** @param {Student[]} students @param {(student: Student) => string} nameOf */
  show(students, nameOf) {
    const placed = students.filter(({ poles }) => poles?.length);
    const key = JSON.stringify(placed.map((s) => [s.id, nameOf(s), s.poles]));
    if (key === this.#shown) return;
    this.#shown = key;
    const all = placed.flatMap(({ poles = [] }) => poles);
    const view = window(all);
    this.#draw(view);
    this.#groups = new Map(placed.map((student) => [student.id, this.#group(student, nameOf(student), view)]));
    this.front.replaceChildren(...this.#groups.values());
    const far = all.filter((p) => !this.#isIn(p, view)).length;
    setAttr(this.drawing, 'aria-label', count(placed.length, 'Poles of {0} student', 'Poles of {0} students'));
    this.usual = placed.length
      ? [
          say`Pitch round, yaw square; rad/s.`,
          far ? count(far, '{0} pole is farther out, at the edge.', '{0} poles are farther out, at the edge.') : '',
        ].join(' ')
      : say`Poles appear here as soon as somebody has begun.`;
    this.named = new Map(placed.map((student) => [student.id, nameOf(student)]));
    this.point(this.#pointed);
  }

  /** Brings out one student's poles. @param {number|null} id */
  point(id) {
    if (this.#pointed) this.#groups.get(this.#pointed)?.classList.remove('pointed');
    this.#pointed = id;
    const group = id ? this.#groups.get(id) : undefined;
    this.front.classList.toggle('one', group !== undefined);
    const name = id && this.named?.get(id);
    group?.classList.add('pointed');
    if (name) this.words.textContent = name;
    else setText(this.words, this.usual ?? '');
  }

  /** @param {Complex} p @param {ReturnType<typeof window>} view */
  #isIn(p, { left, right, top }) {
    return p.re >= left && p.re <= right && Math.abs(p.im) <= top;
  }

  /** @param {Student} student @param {string} name @param {ReturnType<typeof window>} view */
  #group({ id, poles = [] }, name, view) {
    const marks = poles.map((p, k) => {
      const x = Math.max(SIZE, Math.min(WIDTH - SIZE, (p.re - view.left) * view.scale));
      const y = Math.max(SIZE, Math.min(HEIGHT - FOOT - SIZE, (view.top - p.im) * view.scale));
      const kind = k < 2 ? 'pitch' : 'yaw';
      const shape =
        k < 2
          ? svg('circle', { cx: x, cy: y, r: SIZE })
          : svg('rect', { x: x - SIZE, y: y - SIZE, width: 2 * SIZE, height: 2 * SIZE });
      shape.setAttribute('class', `${kind}${this.#isIn(p, view) ? '' : ' far'}`);
      return shape;
    });
    const title = svg('title');
    title.textContent = name;
    const group = svg('g', { 'data-id': id }, title, marks);
    group.addEventListener('pointerenter', () => this.hands.onPoint(id));
    group.addEventListener('pointerleave', () => this.hands.onPoint(null));
    group.addEventListener('click', () => this.hands.onOpen(id));
    return group;
  }

  /** @param {ReturnType<typeof window>} view */
  #draw({ left, right, top, scale }) {
    const x = (/** @type {number} */ re) => (re - left) * scale;
    const y = (/** @type {number} */ im) => (top - im) * scale;
    const floor = HEIGHT - FOOT;
    const lines = [
      svg('rect', { class: 'unstable-half', x: x(0), y: 0, width: WIDTH - x(0), height: floor }),
      ...ticks(left, right, niceStep(right - left, 5)).flatMap((re) => [
        svg('line', { class: 'grid', x1: x(re), x2: x(re), y1: 0, y2: floor }),
        x(re) < 12 || x(re) > WIDTH - 12
          ? null
          : svg('text', { x: x(re), y: HEIGHT - 4, 'text-anchor': 'middle' }, tickText(re)),
      ]),
      ...ticks(-top, top, niceStep(2 * top, 4)).flatMap((im) => [
        svg('line', { class: 'grid', x1: 0, x2: WIDTH, y1: y(im), y2: y(im) }),
        im === 0 || y(im) < 16 ? null : svg('text', { x: 3, y: y(im) - 3 }, `${tickText(im)}j`),
      ]),
      svg('line', { class: 'axis', x1: 0, x2: WIDTH, y1: y(0), y2: y(0) }),
      svg('line', { class: 'axis imaginary', x1: x(0), x2: x(0), y1: 0, y2: floor }),
    ];
    this.back.replaceChildren(...lines.filter((line) => line !== null));
  }
}

/** @param {number} v */
const tickText = (v) => String(Number(v.toPrecision(6))).replace('-', '−');
