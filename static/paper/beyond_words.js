/** What the section says where the paper's model ends: of the rotors, of six states, of the observer. */
import { figure } from './math.js';

/** Time constant of a real rig's rotors, s. */
export const USUAL_LAG = 0.16;

/** The first design's largest real part, rad/s, by the lag of both rotors, s. @type {[number, number][]} */
export const EDGE = [
  [0, -4.1],
  [0.05, -4.11],
  [0.1, -1.42],
  [0.156, -0.12],
  [0.1648, 0],
  [0.2, 0.36],
];

export const BEYOND = [
  {
    name: 'limit',
    title: 'Where the model ends',
    text:
      'So far the thrust follows the voltage at once. A real rotor has to come up to speed first: in recordings a ' +
      'first-generation Aero’s rotors reach 63 % of their final speed after 0.156 s, and fits on Aero 2 rigs give ' +
      '0.162 to 0.169 s. None was found for the older 2-DOF Helicopter, so its sets of values keep the paper’s model ' +
      'unless one says otherwise. The placed poles are those of that model. The table has the page’s first design ' +
      '(poles −12, −10, −9.25, −8.76, PI loops 30(1 + 1/(0.1 s))) with both rotors slower and slower: at the lag of ' +
      'a real rig it stands at the edge of instability.',
    look:
      'The lag margin is the least lag of both rotors alike at which the whole loop is no longer stable. It tells ' +
      'what a delay margin tells, in the machine’s own terms. “Stable” without it is said of the paper’s model alone.',
  },
  {
    name: 'six',
    title: 'The rotors',
    text:
      'The remedy is to put into the model what was left out. Each rotor’s speed becomes a state, v_p and v_y, ' +
      'and the same construction that placed four poles places six: the chain of integrators behind each input is ' +
      'one longer, so the controllability indices are (3, 3), each diagonal block carries a cubic, and $K$ has two ' +
      'more columns, which feed back the rotors’ speeds. An Aero measures them by tachometers; elsewhere an ' +
      'observer tells them from the voltages.',
    look:
      'The groups $h$: each compares what is asked for, $d$, with what the rig has of itself, $a$, $ν$ and 1/$τ$. ' +
      'Where they are 0, nothing is fed back.',
  },
  {
    name: 'observer',
    title: 'The observer',
    text:
      'The feedback wants rates, but only angles are measured. An observer runs the model along with the rig, on the ' +
      'same voltages, and corrects it by the error of its angles. How fast its error dies out is a placement once ' +
      'more: the pair $(A$ᵀ, $C$ᵀ) through the same construction gives $L$ᵀ.',
    look:
      'The 0 in the loop’s matrix: the error does not feel the state. So the poles are those of $A − BK$ and of ' +
      '$A − LC$ together, each placed as if the other were not there.',
  },
];

/** Kinds of letters by what their names begin with. @type {[string, string][]} */
export const DEFINED = [
  ['The rig’s own:', ''],
  ['Asked for, the coefficients of both cubics:', 'd'],
  ['Groups of terms:', 'h'],
];

export const STEPS = {
  lag: [
    'Each rotor’s speed is a state',
    'A speed is told by the voltage that would hold it, so that at rest $v$ = $V$. With $τ$ = 0 the rotor follows ' +
      'at once, and this is the paper’s model.',
  ],
  thrust: [
    'Thrust follows the speed',
    'In the equations of motion $K φ(v)$ takes the place of $KV$. The curve $φ$ is linear, $φ(v)$ = $v$, or ' +
      'quadratic with a dead zone. Near rest only its slope at the trim counts: it multiplies the columns of $B$. ' +
      'A gain that was designed for the linear curve acts that much harder.',
  ],
  model: ['Six states', 'The speeds come in between: the voltages drive $v$, and what was $B$ stands within $A$.'],
  basis: [
    'The basis',
    'As before, with chains of three: indices (3, 3). The letters are the entries of $A$: $b$ are the thrusts, $ν$ ' +
      'the damping, $Δ$ the determinant of the $b$.',
  ],
  gain: [
    'The gain of six states',
    'Derived as Eqs. 21, 22 were, with a cubic in each block. Terms that belong together have a name.',
  ],
  limit: [
    'Back to the paper',
    'Rotors that are alike, with a $τ$ that goes to 0 and the third pole of each axis at −1/$τ$: the first four ' +
      'columns go to the paper’s $K$, the last two to 0.',
  ],
  observer: ['A model that runs along', 'Its rate: the model’s own, and a correction by what it got wrong.'],
  dual: [
    'Its gain, by duality',
    'Observability indices (2, 2). Neither $A$ nor $C$ couples the axes, so every named structure has the same $L$, ' +
      'which observes each axis by itself; with rotors in the model it is the same, since their speeds are told ' +
      'from the voltages and not corrected.',
  ],
  separation: [
    'Separation, and what it does not promise',
    'With $u = −Kx̂ + v$ and the error $e = x − x̂$ the loop of $x$ and $e$ has this matrix. It promises where the ' +
      'poles are, if the model is true. It promises no margins: those of $−Kx$ are lost, and can be as small as one ' +
      'likes (Doyle, IEEE TAC 23 (1978) 756–757). And noise in the angles reaches the motors through ' +
      '$K(sI − A + BK + LC)⁻¹L$: the faster the observer, the more of it.',
  ],
};

/** @typedef {{stable: boolean, lag_margin?: number, gains: {K: number[][]}}} Judged */

/** What a design's lag margin says of it. @param {Judged} reply */
export function lagWords({ stable, lag_margin: margin, gains }) {
  if (!stable) return 'The present design’s loop is not stable as it is.';
  if (margin === undefined) return 'The present design’s loop stays stable, however slow the rotors are.';
  const until = `The present design’s loop is stable up to a lag of ${figure(margin, 3)} s.`;
  if (gains.K[0].length > 4) return `${until} Its model has the rotors in it.`;
  if (margin < USUAL_LAG) return `${until} A real rig’s ${USUAL_LAG} s are more: it lives by rotors that do not lag.`;
  return margin < 1.25 * USUAL_LAG
    ? `${until} A real rig’s ${USUAL_LAG} s leave it at the edge.`
    : `${until} A real rig’s are ${USUAL_LAG} s.`;
}

/** Which rotors' lag is not the design's own. @param {string[]} assumed axes */
export const assumedWords = (assumed) =>
  assumed.length
    ? `With ${USUAL_LAG} s for ${assumed.map((axis) => `${axis}’s`).join(' and ')} rotor, without lag in the design.`
    : '';
