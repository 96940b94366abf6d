/**
 * The shapes that travel through the page: the server's, as the contract has them, and the page's own, built from them.
 */
import type * as contract from './contract.js';
import type { Angles, BothModels, Complex, Evaluation, ScenarioChanges } from './contract.js';
import type { FlightAsked, Goal } from './labs/shapes.js';

export type {
  AxisMetrics,
  Complex,
  Gains,
  Margins,
  Method,
  Metrics,
  OverlayReply,
  ParameterInfo as Range,
  Preview,
  Sensitivity,
} from './contract.js';

/** 1 and 2 are pitch's pair, 3 and 4 yaw's; rad/s. */
export type Poles = [Complex, Complex, Complex, Complex];
export type Axis = keyof Angles;
export type Motor = keyof contract.Voltages;
export type Motion = Axis | 'both';
export type View = 'explore' | 'design' | 'fly' | 'find' | 'compare' | 'rig' | 'plant' | 'derivation';
export type Connection = 'connecting' | 'open' | 'lost';
/** Numbers over time: of the live socket, a view on its frame. */
export type Series = ArrayLike<number>;
export type Encoders = Required<contract.EncoderCounts>;

/** Without keys that it has. */
type Except<T, K extends keyof T> = Omit<T, K>;
/** Of a request, what is said at all: what the page leaves to the server it leaves out, and never says null. */
type Said<T> = { [K in keyof T]: Said<Exclude<T[K], null>> };
/** A request, with presets and methods by names that the page has from the server. */
export type Asked<T> = Omit<T, 'preset' | 'method'> & { preset?: string; method?: string };

/** The keys of a shape whose values are such. */
export type KeysOf<T, V> = { [K in keyof T]-?: NonNullable<T[K]> extends V ? K : never }[keyof T];

/** Step sizes, rad. */
export type Reference = Required<Said<contract.Reference>>;
export type Loops = Record<keyof contract.LoopsChanges, Required<Said<contract.LoopChanges>>>;
/** What a design may say and a preset says: the fields of both. */
type Shared = Pick<contract.Preset, keyof contract.Preset & keyof contract.DesignRequest>;
/** Of these, those that are one value: the loop's structure. */
export type Choices = Pick<contract.Preset, KeysOf<Shared, string | number | boolean>>;
export type Coupling = Choices['coupling'];
export type Disturbance = Required<contract.InputDisturbance>;
export type Digital = Said<Except<contract.DigitalController, 'encoders'>> & { encoders?: Encoders };
/** Overrides of the preset's; null: free travel. */
export type Limits = Said<Pick<contract.LimitChanges, Motor>> & Pick<contract.LimitChanges, 'theta'>;

/** An experiment; what is absent is standard (see experiment.js). */
export interface Scenario extends Said<
  Except<ScenarioChanges, 'model' | 'samples' | 'reference' | 'duration' | 'initial' | 'digital' | 'disturbance'>
> {
  reference: Reference;
  /** s */
  duration: number;
  /** rad, absolute; absent: at rest */
  initial?: Pick<Said<contract.Initial>, Axis>;
  /** absent: continuous */
  digital?: Digital;
  disturbance?: Disturbance;
}

/** What the user chose, and all of it: everything else on the page follows from this. */
export interface Design extends Choices {
  preset: string;
  /** the name of the rig of one's own that it stands for */
  rig?: string;
  /** overrides of the preset's values */
  parameters: Record<string, number>;
  limits: Limits;
  /** the pitch angle at which the rig rests and is linearized, rad */
  theta0: number;
  poles: Poles;
  /** a name of GET methods */
  method: string;
  loops: Loops;
  scenario: Scenario;
  /** overrides of the preset's */
  rotors: contract.RotorsChanges;
  friction: contract.AxisFrictionChanges;
  /** of pitch's and of yaw's rotor where they are placed, rad/s */
  rotor_poles: [number, number];
  /** absent: the server's own */
  observer?: Observer;
  /** of the quadratic methods; absent: Bryson's rule for the preset's limits */
  weights?: Weights;
}

/** A rig of one's own: all its values, in SI units, and the preset from which it stems. */
export interface OwnRig {
  name: string;
  preset: string;
  parameters: Record<string, number>;
  limits: Limits;
  rotors: contract.RotorsChanges;
  friction: contract.AxisFrictionChanges;
  operating_point: { theta: number };
}

/** How the states are estimated. */
export type Observer = Said<Except<contract.ObserverChanges, 'poles'>> & { poles: Poles };

/** Of Q, R and Q_z, what differs from the preset's. */
export type Weights = Said<contract.WeightChanges>;

export type Preset = Except<contract.Preset, 'encoders'> & { encoders: Encoders };

export type Finding = contract.Finding;

type Courses = 't' | Axis | Motor;
/** A response has both references, whatever was asked for. */
export type Step = Except<contract.Step, Courses | 'reference' | 'rotors'> &
  Record<Courses, Series> & { reference: Reference; rotors?: Record<keyof contract.Rotors, Series> };
export type StepPair = Record<keyof BothModels, Step>;
/** All that is shown of a design. */
export type Reply = Except<Evaluation, 'step' | 'axis_steps' | 'findings'> & {
  step: StepPair;
  axis_steps: Partial<Record<keyof contract.AxisSteps, StepPair>>;
  findings: Finding[];
};

/** An answer of the live socket, with the number of what was asked. */
export type LiveReply = Reply & Required<Pick<Evaluation, 'seq'>>;

/** Why something was refused, by the server or on the way there. */
export type Problem = Partial<contract.Problem>;

/** What the placed poles are held to; null: not asked. It is the yardstick, not the design, so undo leaves it alone. */
export interface Requirements {
  /** s */
  settling: number | null;
  /** % */
  overshoot: number | null;
  /** of both rotors that the loop shall bear, s */
  lag: number | null;
}

/** A design that is shown without being the present one: no edit, in no link, and gone with the next edit. */
export interface Previewed {
  design: Design;
  /** null until its numbers are there */
  reply: Reply | null;
  /** the design that the reply's words are about */
  heard: Design | null;
}

/** A design that is kept for comparison; its reply is missing until the server has given one. */
export interface Pin {
  id: number;
  /** its letter, colour and mark */
  index: number;
  name: string;
  design: Design;
  reply: Reply | null;
  refused?: string;
}

/** A plant that is kept with its design. */
export interface PlantPin {
  id: number;
  /** its letter and colour */
  index: number;
  /** as a link has it */
  plant: string;
  /** null until it is computed */
  design: contract.SystemDesign | null;
  refused?: string;
}

type Units = 'time_unit' | 'unit' | 'units' | 'voltage_unit';
/** What the controls hold of a recording's columns. */
export interface RecordingColumns
  extends Required<Said<Pick<contract.Mapping, Units | 'decimate'>>>, Required<Pick<contract.Mapping, 'sample_time'>> {
  /** column by role */
  names: Record<string, string>;
  signs: Required<contract.Signs>;
  offsets: Required<contract.Offsets>;
}
export type Driver = Required<contract.OverlayRequest>['driver'];

/** How far an identification is. */
export type Progress = Pick<contract.IdentificationReply, 'evaluations' | 'rms'> & { done: false };

/** A recording of a real rig, and what is known of it. */
export interface Recorded {
  preview: contract.Preview | null;
  columns: RecordingColumns | null;
  driver: Driver;
  busy: string;
  problem: Problem | null;
  overlay: contract.OverlayReply | null;
  overlaid: Design | null;
  progress: Progress | null;
  found: contract.IdentificationReply | null;
  foundFor: Design | null;
}

/** A stretch of a recording beside the design, in its time; rad and V. */
export interface Beside extends Record<'t' | Axis | Motor, Float64Array> {
  /** of the recording, s */
  from: number;
  /** rad */
  shift: Record<Axis, number>;
  plotted: boolean;
  ghost: boolean;
}

/** Uncertain rigs under one controller. */
export interface Cloud {
  /** rigs whose poles are known */
  done: number;
  /** the first of them, whose responses are known, too */
  judged: number;
  /** real and imaginary parts by turns, as many poles for each rig */
  poles: Float64Array;
  /** s; empty where no response stayed finite */
  t: ArrayLike<number>;
  /** rad, the 5th, 50th and 95th percentile of the responses */
  envelopes: Record<'theta' | 'psi', readonly ArrayLike<number>[]>;
  /** of those done, 0 to 1 */
  share_stable: number;
  /** of those judged */
  share_within_limits: number;
}

/** A part of the design that can be locked. */
export interface Lock {
  name: string;
  /** paths in a design */
  keys: string[];
  /** where the page changes them, as a selector; empty: nowhere */
  controls: string;
}

export interface State {
  /** from which side the design is seen */
  view: View;
  requirements: Requirements;
  /** relative uncertainty of the rigs in the cloud; 0: no cloud */
  spread: number;
  cloud: Cloud | null;
  /** which map is shown, as a link has it (maps/choices.js) */
  map: string | null;
  /** which number is swept, as a link has it (tracks/numbers.js) */
  track: string | null;
  presets: Preset[];
  methods: contract.Method[];
  design: Design | null;
  reply: Reply | null;
  /** the design that the numbers of `reply` belong to: the server's, or the page's own while a hand moves */
  answered: Design | null;
  /** the design that the server has answered last: the words of `reply` are about that one */
  heard: Design | null;
  /** how often the server's numbers differed from the page's own */
  differences: number;
  problem: Problem | null;
  /** a design that is shown in place of the present one while the pointer is on it */
  preview: Previewed | null;
  /** what the finder is asked for, as a link has it (finder/link_text.js); null: what it proposes */
  find: string | null;
  connection: Connection;
  motion: Motion;
  showLinear: boolean;
  /** rise, peak and settling on the curves */
  showMarks: boolean;
  /** where the rotors' lag takes the loop's poles; null: where they lag, or would matter */
  showLag: boolean | null;
  dragging: boolean;
  canUndo: boolean;
  canRedo: boolean;
  pins: Pin[];
  /** names in locks.js */
  locks: string[];
  /** what the step of a lab leaves free of these, what it keeps back, and its goals; its locks are not a link's */
  task: { free: Lock[]; hidden: string[]; goals?: Goal[]; flight?: FlightAsked | null } | null;
  /** any system, as a link has it (plant/link_text.js) */
  plant: string | null;
  plantPins: PlantPin[];
  recorded: Recorded;
  /** null: no recording is shown beside the design */
  beside: Beside | null;
  /** what is to be said of the link that was opened, or of this design's numbers */
  notice: string | null;
  /** that a part of the page could not be drawn */
  fault: string | null;
}
