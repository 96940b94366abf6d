/**
 * All hands on a flight: sticks on the screen, keys, a gamepad, a push, the weather. What they ask for together is
 * written to the flight where it has changed, once per animation frame, right before it is flown.
 *
 * Hands off, sticks move the set points: how far they are out is how fast. Hands on, they are the motors' voltages: in
 * the middle those at which the rig hovers at its operating point, at the ends all that a motor gives.
 * @typedef {import('./keys.js').Demand} Demand
 * @typedef {import('./keys.js').Act} Act
 * @typedef {import('./ray.js').Shape} Shape
 * @typedef {'turn'|'sticks'|'push'} Word what hands write again and again
 */
import { CONTROLLER, INPUT } from '../kernel/index.js';
import { DEGREE, fixed, say, t } from '../text/index.js';
import { button, h, popupButton, setText } from '../ui/index.js';
import { CameraOfScene } from './camera.js';
import { nearestTurn, RATES, ratesOf, together, voltsOf } from './demands.js';
import { Gamepads } from './gamepad.js';
import { Keys } from './keys.js';
import { legend } from './legend.js';
import { forceText, Push } from './push.js';
import { Stick } from './sticks.js';
import { strengthOf } from './strength.js';
import { LEAP, SPEEDS } from './transport.js';
import { Weather } from './weather.js';

/** Between two looks at what else is shown, ms. */
const CALM = 200;
/** Of a rig that nobody has told the shape of: keys push it all the same. @type {Shape} */
const UNKNOWN = {
  ...{ pivot_height: 0, reach: 0.3, outer: 0.4, arms: { pitch: 0.2, yaw: -0.2 } },
  ...{ offsets: { pitch: 0, yaw: 0 }, guard: 0.1, wall: 0 },
  view: { position: [1, 0, 0], look_at: [0, 0, 0], fov: 0.6 },
};
/** @type {Record<Word, number>} where what acts has it */
const AT = { turn: INPUT.TURN, sticks: INPUT.STICK, push: INPUT.PUSH };
const NOBODY = { pitch: 0, yaw: 0 };

export class Hands {
  /** What each word was told by hands last. @type {Record<Word, [number, number]>} */
  #wanted = { turn: [0, 0], sticks: [0, 0], push: [0, 0] };
  /** What others ask for: a partner in another window. @type {Map<string, Demand>} */ #others = new Map();
  /** @type {import('./gamepad.js').PadReading|null} */ #pad = null;
  #looked = -Infinity;

  /**
   * @param {import('./flight.js').Flight} flight
   * @param {object} of
   * @param {import('../model/store.js').Store} of.store
   * @param {HTMLIFrameElement|null} of.frame the scene's; null where there is none
   * @param {() => Shape|null} of.shape what is known of the rig's; null before that
   * @param {() => boolean} of.seen whether the flight's view is seen: keys fly only there
   * @param {() => void} of.restart flies from the start again
   */
  constructor(flight, { store, frame, shape, seen, restart }) {
    this.flight = flight;
    this.store = store;
    this.shape = shape;
    this.seen = seen;
    this.restart = restart;
    this.pads = new Gamepads(navigator);
    this.camera = new CameraOfScene(frame);
    this.keys = new Keys({
      active: () => this.seen(),
      flies: () => this.#inHand,
      onAct: (act) => this.act(act),
    });
    if (frame) this.keys.within(frame);
    this.push = new Push({ camera: () => this.#seenFrom, holding: () => this.#holding });
    this.weather = new Weather(flight, () => this.#rig);
    const now = () => this.#sticks();
    this.pitch = new Stick('pitch', { label: t('Pitch stick'), testid: 'stick-pitch', onChange: now });
    this.yaw = new Stick('yaw', { label: t('Yaw stick'), testid: 'stick-yaw', onChange: now });
    this.onHands = button(
      {
        class: 'fly-hands',
        'data-testid': 'fly-hands',
        'aria-pressed': 'false',
        title: 'The sticks are the motors’ voltages and the controller is off (H)',
        onclick: () => this.act('hands'),
      },
      'Hands on',
    );
    this.onPush = button(
      {
        class: 'fly-push',
        'data-testid': 'fly-push',
        'aria-pressed': 'false',
        title: 'Drag the body in the scene to push it (P); without this with Shift, and by Shift and the arrow keys',
        onclick: () => this.act('push'),
      },
      'Push',
    );
    this.onLegend = popupButton({
      label: t('What keys and gamepad do (K)'),
      text: t('Keys'),
      testid: 'fly-keys',
      kind: 'quiet',
      content: () => [legend()],
    });
    this.lamp = h('p', { class: 'fly-pad', role: 'status', 'data-testid': 'fly-pad' });
    this.told = h('p', { class: 'fly-told', 'data-testid': 'fly-told' });
    this.node = h(
      'div',
      { class: 'hands', role: 'group', 'aria-label': 'Hands', 'data-flies': '', 'data-testid': 'hands' },
      this.pitch.node,
      h('div', { class: 'hands-how' }, h('div', {}, this.onHands, this.onPush, this.onLegend), this.told, this.lamp),
      this.yaw.node,
    );
    this.overlay = this.push.overlay;
    const hear = (/** @type {string} */ type, /** @type {(e: CustomEvent) => void} */ act) =>
      flight.addEventListener(type, /** @type {EventListener} */ (act));
    hear('start', () => this.#remember());
    hear('cut', () => this.#remember());
    hear('did', ({ detail }) => {
      if (detail.word === 'reference') this.#wanted.turn = [0, 0]; // set points that are put somewhere rest
      if (detail.word === 'hands') this.#sticks(); // before a tick is flown without their voltages
    });
    for (const type of ['start', 'cut', 'change', 'end']) hear(type, () => this.render());
    this.render();
  }

  /**
   * What somebody else asks for, who flies along.
   * @param {string} name @param {Demand|null} demand null: they have let go
   */
  demand(name, demand) {
    if (demand) this.#others.set(name, demand);
    else this.#others.delete(name);
  }

  /** Before a frame is flown. @param {number} now ms */
  before(now) {
    this.#pad = this.pads.read();
    if (this.seen()) for (const act of this.#pad?.acts ?? []) this.act(act);
    this.#sticks();
    this.#pushed();
    this.weather.blow();
    if (now - this.#looked < CALM) return;
    this.#looked = now;
    this.weather.render();
    this.render();
  }

  /** After a frame was flown. */
  after() {
    this.push.draw();
  }

  /** Does what a key or a button stands for. @param {Act} act @returns {boolean} whether it did something */
  act(act) {
    const { flight } = this;
    const { mode, replay, speed, past } = flight.state;
    const flies = this.#inHand;
    const shown = flies || mode === 'replaying' || (mode === 'frozen' && replay);
    /** @type {Record<Act, [boolean, () => void]>} */
    const all = {
      hands: [flies, () => this.#turnHands()],
      toggle: [shown, () => flight.toggle()],
      step: [shown, () => flight.step()],
      slow: [shown, () => flight.setSpeed(SPEEDS[(SPEEDS.indexOf(speed) + 1) % SPEEDS.length])],
      rewind: [past, () => flight.rewind(LEAP)],
      gust: [flies, () => this.weather.gust('small')],
      push: [mode !== 'idle', () => this.#turnPush()],
      restart: [!replay || mode === 'ended', () => this.restart()],
      end: [shown, () => flight.end(t('You have ended it.'))],
      legend: [true, () => this.onLegend.click()],
    };
    const [can, does] = all[act];
    if (can) does();
    return can;
  }

  /** Shows who flies. */
  render() {
    const { craft } = this.flight;
    const on = craft?.hands ?? false;
    this.onHands.disabled = !this.#inHand;
    this.onHands.setAttribute('aria-pressed', String(on));
    this.onPush.setAttribute('aria-pressed', String(this.push.tool));
    const { arrow } = this.push;
    const blind = this.push.tool && this.#seenFrom === null;
    setText(
      this.told,
      arrow
        ? say`You push with ${forceText(arrow.size)}.`
        : blind
          ? t('The scene cannot be pushed here: push with Shift and the arrow keys.')
          : on
            ? t('The sticks are the motors’ voltages; the controller is off.')
            : t('The sticks move the set points.'),
    );
    this.told.classList.toggle('acts', on);
    const pad = this.#pad;
    this.lamp.classList.toggle('acts', pad !== null);
    setText(
      this.lamp,
      pad === null
        ? t('Gamepad: press any button on it.')
        : pad.known
          ? say`Gamepad: ${pad.name}`
          : say`Gamepad of unknown layout: ${pad.name}`,
    );
    this.#show(together(this.#demands(on)), on);
  }

  /** Whether a flight is there to be flown. */
  get #inHand() {
    const { mode, replay } = this.flight.state;
    return (mode === 'flying' || mode === 'frozen') && !replay;
  }

  /** Where the rig is seen from; null where it is not, or where its shape is not known. */
  get #seenFrom() {
    return this.shape() && this.camera.now();
  }

  /** How hard this rig is held; null while it is not known. */
  get #rig() {
    const [{ design }, preset] = [this.store.state, this.store.preset];
    const { craft } = this.flight;
    if (!design || !preset || !craft) return null;
    const of = (/** @type {string} */ name) => design.parameters[name] ?? preset.parameters[name];
    const [V_p, V_y] = this.#ends;
    const arm = (this.shape() ?? UNKNOWN).arms.pitch;
    return { strength: strengthOf({ K_pp: of('K_pp'), K_yy: of('K_yy') }, { V_p, V_y }, arm), arm };
  }

  /** What a push needs to know; null where nothing flies. @returns {import('./push.js').Holding|null} */
  get #holding() {
    const [shape, rig, { craft }] = [this.shape() ?? UNKNOWN, this.#rig, this.flight];
    return rig && craft && this.#inHand
      ? { shape, strength: rig.strength, attitude: { theta: craft.theta, psi: craft.psi } }
      : null;
  }

  /** @param {boolean} volts whether sticks are voltages @returns {Demand[]} */
  #demands(volts) {
    const pad = this.#pad && (volts ? this.#pad.volts : this.#pad.sticks);
    const screen = { pitch: this.pitch.value, yaw: this.yaw.value };
    return [screen, this.keys.demands.sticks, pad ?? NOBODY, ...this.#others.values()];
  }

  /** Writes what the sticks ask for. */
  #sticks() {
    const { craft } = this.flight;
    if (!craft || this.flight.state.mode !== 'flying' || !this.#inHand) return;
    const demand = together(this.#demands(craft.hands));
    this.#show(demand, craft.hands);
    if (craft.hands) this.#write('sticks', this.#volts(demand));
    else this.#write('turn', ratesOf(demand, craft.reference[0], craft.travel));
  }

  /** Writes how hard the body is pushed. */
  #pushed() {
    const holding = this.#holding;
    if (this.flight.state.mode !== 'flying') return;
    if (!holding) return;
    const { theta, psi } = this.push.torques(this.keys.demands.push, holding);
    this.#write('push', [theta, psi]);
  }

  /** Voltages at which the rig hovers where it was linearized. */
  get #rest() {
    const { craft } = this.flight;
    return craft ? [...craft.aboard.controller.k.slice(CONTROLLER.TRIM, CONTROLLER.TRIM + 2)] : [0, 0];
  }

  /** What the sticks' ends give, V: the motors' limits, also of a design that knows none. */
  get #ends() {
    const { state, preset } = this.store;
    const { V_p = 0, V_y = 0 } = { ...preset?.limits, ...state.design?.limits };
    const own = this.flight.craft?.limits ?? [V_p, V_y];
    return [own[0] < Infinity ? own[0] : V_p, own[1] < Infinity ? own[1] : V_y];
  }

  /** @param {Demand} demand */
  #volts(demand) {
    return voltsOf(demand, this.#rest, this.#ends);
  }

  /** @param {Word} word @param {[number, number]} values */
  #write(word, values) {
    const before = this.#wanted[word];
    if (values[0] === before[0] && values[1] === before[1]) return;
    this.#wanted[word] = values;
    this.flight.do(word, ...values);
  }

  /** What acts is that of another time. */
  #remember() {
    const { craft } = this.flight;
    for (const word of /** @type {Word[]} */ (Object.keys(AT)))
      this.#wanted[word] = craft ? [craft.u[AT[word]], craft.u[AT[word] + 1]] : [0, 0];
  }

  #turnHands() {
    const { flight } = this;
    const { craft } = flight;
    if (!craft) return;
    if (!craft.hands) {
      this.#write('turn', [0, 0]);
      this.#write('sticks', this.#volts(NOBODY));
      flight.do('hands', 1);
      return;
    }
    const [theta, psi] = craft.reference;
    const near = nearestTurn(psi, craft.psi);
    if (near !== psi) flight.do('reference', theta, near);
    flight.do('hands', 0);
  }

  #turnPush() {
    this.push.tool = !this.push.tool;
    this.render();
  }

  /** @param {Demand} demand @param {boolean} volts */
  #show({ pitch, yaw }, volts) {
    const [V_p, V_y] = volts ? this.#volts({ pitch, yaw }) : [0, 0];
    const rate = (/** @type {number} */ v) => say`set point moves by ${fixed(v * DEGREE, 0)}° per second`;
    const words = (/** @type {number} */ out, /** @type {number} */ V, /** @type {number} */ most) =>
      volts ? say`${fixed(V, 1)} volts` : out === 0 ? t('the set point rests') : rate(out * most);
    this.pitch.show(pitch, words(pitch, V_p, RATES.theta));
    this.yaw.show(yaw, words(yaw, V_y, RATES.psi));
  }
}
