/**
 * Tracks: one number of the design swept. Its curves lie in the s-plane; along them goes a slider, with it the whole
 * page in preview, and a pointer beside them; a click takes the value.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../contract.js').TrackReply} TrackReply
 * @typedef {import('./numbers.js').Swept} Swept
 * @typedef {import('./feed.js').Wanted} Wanted
 */
import { say, significant, t } from '../text/index.js';
import { hides } from '../model/index.js';
import { h, saveFile, setAttr, setText } from '../ui/index.js';
import { toPixel } from '../splane/index.js';
import { Bar, STEPS } from './bar.js';
import { along, indexOf, nearest, summary } from './courses.js';
import { trackFile, TrackFeed } from './feed.js';
import { FIGURES, told, toldBy, valueText } from './figures.js';
import { Layer } from './layer.js';
import { Moving } from './moving.js';
import {
  designAt,
  FIRST_SWEPT,
  isOfDesign,
  isOfRig,
  offered,
  rounded,
  scaleOf,
  shownUnit,
  sweptOf,
  textOfSwept,
} from './numbers.js';
import { Player } from './player.js';

/** How near a pointer has to be to a curve, px. */
const REACH = 9;
/** Within which a press is a click, px. */
const STILL = 4;

export class Tracks {
  /** @type {TrackReply|null} */ #track = null;
  /** @type {Wanted|null} what it is of */ #of = null;
  /** @type {number|null} */ #index = null;
  /** Whether a pointer has put it there, which takes it away again. */ #pointed = false;
  /** @type {{x: number, y: number}|null} */ #pressed = null;
  #log = false;
  /** @type {Design|null} the last one that was taken */ #taken = null;
  /** @type {Design|null} the last one that was followed */ #followed = null;

  /**
   * @param {import('../splane/splane.js').SPlane} plane
   * @param {import('../model/store.js').Store} store
   * @param {import('../finder/preview.js').Preview} preview
   * @param {() => import('../kernel/index.js').Designs|null} designs  the page's workers, once they are there
   */
  constructor(plane, store, preview, designs) {
    this.plane = plane;
    this.store = store;
    this.preview = preview;
    this.layer = new Layer(plane);
    this.moving = new Moving(designs);
    this.feed = new TrackFeed(({ track, problem, wanted }) => this.#heard(track, problem, wanted));
    this.player = new Player(
      (share) => this.#seek(share),
      (on) => this.bar.playing(on),
    );
    this.bar = new Bar(
      {
        choose: (swept) => store.set({ track: swept && textOfSwept(swept) }),
        seek: (share) => this.#seek(share, true),
        play: () => this.#play(),
        take: () => this.#take(),
        save: (kind) => void this.#save(kind),
      },
      FIRST_SWEPT,
    );
    this.bar.figure.append(...FIGURES.map(({ label }, i) => h('option', { value: i }, label)));
    this.bar.figure.addEventListener('change', () => this.#drawFigure());
    /** @type {HTMLElement} */ (plane.svg.parentElement).after(this.bar.node);
    plane.key.before(this.bar.toggle);
    this.bar.node.addEventListener('focusout', ({ relatedTarget }) => {
      if (!(relatedTarget instanceof Node) || !this.bar.node.contains(relatedTarget)) this.preview.end();
    });
    this.bar.node.addEventListener('keydown', (e) => e.key === 'Escape' && this.#leave());
    const { over } = plane;
    plane.over = (fresh) => {
      over?.(fresh);
      if (fresh) this.#redraw();
    };
    this.#listen(plane.svg);
  }

  /** @param {State} state */
  render(state) {
    const { design, heard, problem, dragging, connection, view, preview } = state;
    const swept = this.#swept(state);
    this.bar.render(swept, swept ? offered(state) : []);
    if (!swept || !design) {
      this.feed.want(null);
      this.player.stop();
      this.#show(null, null);
      return;
    }
    if (preview) return; // it is the present design's
    this.#nameTake();
    this.bar.kept.node.hidden = !isOfRig(swept.path);
    this.bar.take.hidden = !isOfDesign(swept.path);
    if (this.#of && this.#of.design !== design) this.#follow(design, swept);
    if (dragging || problem || design !== heard || connection === 'lost' || view !== 'design') return;
    this.feed.want({ design, swept, measures: told(state).map(({ measure }) => measure) });
  }

  /** What is swept, where it may be seen. @param {State} state @returns {Swept|null} */
  #swept(state) {
    return state.view === 'design' && !hides(state, 'poles') ? sweptOf(state.track) : null;
  }

  /** The curves of a design that the server has not told yet. @param {Design} design @param {Swept} swept */
  #follow(design, swept) {
    if (design === this.#followed || !this.#track) return;
    this.#followed = design;
    this.player.stop();
    this.#at(null);
    const range = this.#range(this.#track);
    const computed = this.moving.ask(design, this.store.preset, swept, range, (curves) => {
      if (this.#of?.design === design || this.#followed === null) return;
      this.layer.show(curves);
      this.layer.fade(false);
    });
    if (!computed) this.layer.fade(true);
  }

  /** @param {TrackReply|null} track @param {string} problem @param {Wanted} wanted */
  #heard(track, problem, wanted) {
    const share = this.#of?.swept.path === wanted.swept.path ? this.#share() : null;
    this.#show(track?.values.length ? track : null, wanted);
    this.layer.fade(this.store.state.design !== wanted.design);
    if (!this.#track) return setText(this.bar.words, problem || t('There is no such loop at any of these values.'));
    const kept = share !== null && !this.#pointed && this.#index !== null;
    if (!kept) this.#index = null;
    this.#tell();
  }

  /** @param {TrackReply|null} track @param {Wanted|null} wanted */
  #show(track, wanted) {
    if (track === null && this.#track === null && wanted === null) return;
    this.#followed = null;
    this.moving.forget();
    this.#track = track;
    this.#of = wanted;
    this.#log = wanted?.swept.log ?? false;
    if (this.#index !== null && !(track && this.#index < track.values.length)) this.#index = null;
    this.layer.show(track);
    if (track) {
      this.bar.showRange(this.#range(track), scaleOf(track.unit), shownUnit(track.unit));
      for (const [i, option] of [...this.bar.figure.options].entries())
        option.hidden = !track.figures.some((figure) => toldBy(figure) === FIGURES[i]);
      this.bar.figure.hidden = !track.figures.length;
    }
    this.#drawFigure();
    this.#tell();
  }

  /** @param {TrackReply} track @returns {[number, number]} */
  #range = ({ values }) => [values[0], values[values.length - 1]];

  #along = (/** @type {TrackReply} */ track) => along(this.#range(track), this.#log);

  /** How far along the track the value in question is; without one the design's own. */
  #share() {
    const track = this.#track;
    if (!track) return 0;
    const value = this.#index === null ? (track.now ?? track.values[0]) : track.values[this.#index];
    return Math.min(1, Math.max(0, this.#along(track).share(value)));
  }

  /** @param {number} share @param {boolean} [byHand] */
  #seek(share, byHand = false) {
    const track = this.#track;
    if (!track) return;
    if (byHand) this.player.stop();
    this.#pointed = false;
    this.#at(indexOf(track.values, this.#along(track).value(share)));
    if (!byHand) return;
    const design = this.#design();
    if (design) this.preview.show(design);
  }

  /** @param {number|null} index */
  #at(index) {
    if (index === this.#index) return;
    this.#index = index;
    this.#tell();
  }

  /** The design at the value in question. @returns {Design|null} */
  #design() {
    const { design } = this.store.state;
    if (!this.#track || !this.#of || this.#index === null || !design || this.#of.design !== design) return null;
    const value = this.#track.values[this.#index];
    return value === this.#track.now ? design : designAt(design, this.#of.swept.path, rounded(value));
  }

  #take() {
    const design = this.#design();
    if (design) {
      this.#taken = design;
      this.preview.take(design);
    }
    this.#leave();
    this.#nameTake();
  }

  /** Its word says whether the present design has been taken here. */
  #nameTake() {
    const own = this.#index === null && this.#taken !== null && this.store.state.design === this.#taken;
    setText(this.bar.take, own ? t('✓ Taken') : t('Take'));
  }

  #leave() {
    this.player.stop();
    this.preview.end();
    this.#pointed = false;
    this.#at(null);
  }

  #play() {
    const track = this.#track;
    if (!track) return;
    const { share } = this.#along(track);
    const gain = this.#of && !isOfDesign(this.#of.swept.path);
    const to =
      gain && track.now !== undefined && track.now < track.values[track.values.length - 1] ? share(track.now) : 1;
    this.preview.end();
    this.player.toggle(this.#index === null ? 0 : this.#share(), to);
  }

  /** @param {'csv'|'svg'} kind */
  async #save(kind) {
    if (!this.#of) return;
    try {
      saveFile(`heli2dof_track.${kind}`, await trackFile(this.#of, kind));
    } catch (error) {
      setText(this.bar.words, error instanceof Error ? error.message : String(error));
    }
  }

  #redraw() {
    this.layer.draw();
    this.layer.point(this.#index);
  }

  #drawFigure() {
    const track = this.#track;
    if (!track) return;
    const own = FIGURES[Number(this.bar.figure.value)];
    const figure = track.figures.find((each) => toldBy(each) === own) ?? track.figures[0] ?? null;
    if (figure) this.bar.figure.value = String(FIGURES.findIndex((each) => each === toldBy(figure)));
    this.bar.strip.draw(track, figure, this.#along(track).share);
  }

  /** Where the slider stands, and what holds there. */
  #tell() {
    const track = this.#track;
    this.layer.point(this.#index);
    if (!track) return;
    const share = this.#share();
    this.bar.strip.point(share);
    this.bar.slider.value = String(Math.round(STEPS * share));
    const scale = scaleOf(track.unit);
    const unit = shownUnit(track.unit);
    const text = (/** @type {number} */ v) =>
      `${v === 0 ? '0' : significant(v * scale, 3)}${unit && unit !== '°' ? ` ${unit}` : unit}`;
    const value = this.#index === null ? track.now : track.values[this.#index];
    setText(this.bar.value, value === undefined ? '' : `${this.bar.name} = ${text(value)}`);
    setAttr(this.bar.slider, 'aria-valuetext', value === undefined ? '' : text(value));
    const words = this.#index === null ? summary(track, text) : here(track, this.#index);
    setText(this.bar.words, words);
    this.bar.words.title = words; // all of it, where there is no room
    this.bar.take.disabled = this.#index === null;
    this.#nameTake();
  }

  /** @param {SVGSVGElement} svg */
  #listen(svg) {
    const at = (/** @type {PointerEvent|MouseEvent} */ e) => {
      const box = svg.getBoundingClientRect();
      const { unit } = this.plane;
      return { x: (e.clientX - box.left) / unit, y: (e.clientY - box.top) / unit };
    };
    const under = (/** @type {PointerEvent|MouseEvent} */ e) => {
      if (!this.#track || svg.classList.contains('grabbable') || this.store.state.dragging) return null;
      const { x, y } = at(e);
      const { view } = this.plane;
      const { index, away } = nearest(this.layer.courses, (p) => {
        const [px, py] = toPixel(view, p);
        return Math.hypot(px - x, py - y);
      });
      return away <= REACH ? index : null;
    };
    svg.addEventListener('pointermove', (e) => {
      if (e.buttons || e.pointerType === 'touch' || this.player.isPlaying) return;
      const index = under(e);
      svg.classList.toggle('on-track', index !== null);
      if (index === null && !this.#pointed) return;
      this.#pointed = index !== null;
      this.#at(index);
    });
    svg.addEventListener('pointerleave', () => this.#pointed && !this.preview.design && this.#leave());
    svg.addEventListener('pointerdown', (e) => {
      this.#pressed = under(e) === null ? null : at(e);
    });
    svg.addEventListener('click', (e) => {
      const { x, y } = at(e);
      const still = this.#pressed && Math.hypot(this.#pressed.x - x, this.#pressed.y - y) <= STILL;
      this.#pressed = null;
      const index = still ? under(e) : null;
      if (index === null) return;
      this.#at(index);
      this.#take();
    });
  }
}

/** What holds at one of the values. @param {TrackReply} track @param {number} index */
function here(track, index) {
  /** @type {Map<string, string[]>} */ const figures = new Map();
  for (const figure of track.figures) {
    const head = toldBy(figure)?.head ?? figure.measure;
    figures.set(head, [...(figures.get(head) ?? []), valueText(figure, index)]);
  }
  const texts = [...figures].map(([head, values]) => say`${t(head)} ${values.join(', ')}`);
  const border = track.plane === 's' ? t('poles on the imaginary axis') : t('poles on the unit circle');
  const state = track.stable[index] ? t('stable') : track.on_border[index] ? border : t('unstable');
  return [state, ...texts].join(' · ');
}
