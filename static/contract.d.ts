/**
 * What the server is asked and what it replies. Made of the contract (app/contract) by `python -m tests.page_types`;
 * not to be changed by hand.
 */

/** How near a rig comes to what was measured. */
export interface AgreementReply {
  /** 100 (1 − ‖y − ŷ‖/‖y − ȳ‖), % */
  fit: PerAxis;
  /** accounted for, 100 (1 − var(y − ŷ)/var y), % */
  variance: PerAxis;
  /** of the residuals, rad */
  rms: PerAxis;
}

/** White noise on the measured angles, rad, one value per sample. */
export interface AngleNoise {
  /** of the noise on measured pitch, rad */
  theta?: number;
  /** of the noise on measured yaw, rad */
  psi?: number;
}

/** Units of single angles, where they are not the file's usual one; a reference takes its axis' unit. */
export interface AngleUnits {
  /** of pitch */
  theta?: 'rad' | 'deg' | null;
  /** of yaw */
  psi?: 'rad' | 'deg' | null;
  /** of pitch's reference */
  theta_ref?: 'rad' | 'deg' | null;
  /** of yaw's reference */
  psi_ref?: 'rad' | 'deg' | null;
}

/** Angles, rad; left out where there is none. */
export interface Angles {
  /** pitch, rad */
  theta?: number;
  /** yaw, rad */
  psi?: number;
}

/** What the controller or a hand asked of the motors, before their limits. */
export interface AskedCourse {
  /** V */
  V_p: number[];
  /** V */
  V_y: number[];
}

/** What is kept of a student who came by a learning platform (LTI). */
export interface AtPlatform {
  /** the platform, as it is registered here */
  name: string;
  /** the student, as the platform calls them */
  subject: string;
  /** that go there; left out before the first attempt */
  points?: number;
  /** whether they are there */
  sent?: boolean;
}

/** An attempt, marked and kept. */
export interface AttemptReply {
  goals: GoalTold[];
  questions: GoalTold[];
  /** points given */
  points: number;
  /** points there are */
  of: number;
  stable?: boolean;
  findings?: Finding[];
  /** where one was handed in and counts */
  flight?: FlightTold;
  id: string;
  step: string;
  /** the server's time */
  at: string;
  /** the page's */
  handed_at?: string;
  best: Best;
}

/** An attempt at a step. */
export interface AttemptRequest {
  student: string;
  /** a random UUID that the page makes: what comes twice counts once */
  id: string;
  /** the step's name */
  step: string;
  /** as for evaluate */
  design: StepRequest;
  /** by the question's name: a number, a choice or several (1-based), or text */
  answers?: Record<string, string | number | number[] | null>;
  flight?: Record<string, unknown> | null;
  /** by the page's clock, of an attempt made offline */
  at?: string | null;
}

/** A course for each axis. */
export interface AxesCourse {
  /** of pitch; rad, or N·m of torques */
  theta: number[];
  /** of yaw; rad, or N·m of torques */
  psi: number[];
}

/** A figure of each axis, in the registry's unit. */
export interface AxisFigures {
  /** of pitch */
  theta: number;
  /** of yaw */
  psi: number;
}

/** Friction of both axes. */
export interface AxisFrictionChanges {
  pitch?: FrictionChanges;
  yaw?: FrictionChanges;
}

/** Step metrics of one axis; s, %, rad, rad·s, rad·s². They belong to the response, not to its samples. */
export interface AxisMetrics {
  /** time from 10 % to 90 % of the step, s; left out where 90 % are not reached */
  rise_time?: number;
  /** time after which the angle stays within 2 % of the step around its reference, s; left out where not `settled` */
  settling_time?: number;
  /** largest excess beyond the reference, in percent of the step */
  overshoot: number;
  /** largest excursion from the start away from the reference, in percent of the step */
  undershoot: number;
  /** angle of the largest deviation from the start, rad */
  peak: number;
  /** when the peak is reached, s; left out where nothing overshoots, or the window ends on the peak */
  peak_time?: number;
  /** reference minus the last angle shown, rad */
  steady_state_error: number;
  /** ∫ |e| dt, integral of the absolute error over the time shown, rad·s */
  iae: number;
  /** ∫ t |e| dt, the absolute error weighted with time, over the time shown, rad·s² */
  itae: number;
  /** whether it is within 2 % of the step when the window ends, for good */
  settled: boolean;
}

/** Metrics of each axis stepped alone. */
export interface AxisMetricsAlone {
  theta?: Metrics;
  psi?: Metrics;
}

/** Each axis of the reference stepped alone. */
export interface AxisSteps {
  theta?: BothModels;
  psi?: BothModels;
}

/** The best attempt at a step. */
export interface Best {
  goals: GoalTold[];
  questions: GoalTold[];
  /** points given */
  points: number;
  /** points there are */
  of: number;
  stable?: boolean;
  findings?: Finding[];
  /** where one was handed in and counts */
  flight?: FlightTold;
  /** to which the verdict was given */
  answers?: Record<string, unknown>;
}

/** The same experiment by both models. */
export interface BothModels {
  linear: Step;
  nonlinear: Step;
}

/** What anyone is told who has the code. Times are ISO 8601, UTC. */
export interface ClassAbout {
  code: string;
  title: string;
  lab: LabOfClass;
  /** that the lab takes, min */
  minutes?: number;
  student_link: string;
  /** whether attempts are taken */
  open: boolean;
  /** when it closes by itself */
  closes?: string;
  /** since when it is closed */
  closed_at?: string;
  /** when it is deleted */
  ends: string;
  /** the server's time */
  at: string;
}

/** What an instructor changes; what is left out stays. */
export interface ClassChanges {
  title?: string | null;
  open?: boolean | null;
  /** null: it does not close by itself */
  closes?: string | null;
}

/** All of a class, to be taken out. */
export interface ClassExport {
  code: string;
  title: string;
  lab: LabOfClass;
  /** that the lab takes, min */
  minutes?: number;
  student_link: string;
  /** whether attempts are taken */
  open: boolean;
  /** when it closes by itself */
  closes?: string;
  /** since when it is closed */
  closed_at?: string;
  /** when it is deleted */
  ends: string;
  /** the server's time */
  at: string;
  /** points there are */
  points: number;
  created: string;
  /** raised by every change */
  version: number;
  lab_text: string;
  students: Record<string, unknown>[];
}

/** The class itself. */
export interface ClassHead {
  code: string;
  title: string;
  lab: LabOfClass;
  /** that the lab takes, min */
  minutes?: number;
  student_link: string;
  /** whether attempts are taken */
  open: boolean;
  /** when it closes by itself */
  closes?: string;
  /** since when it is closed */
  closed_at?: string;
  /** when it is deleted */
  ends: string;
  /** the server's time */
  at: string;
  /** points there are */
  points: number;
  created: string;
  /** raised by every change */
  version: number;
}

/** The whole class. */
export interface ClassReply {
  code: string;
  title: string;
  lab: LabOfClass;
  /** that the lab takes, min */
  minutes?: number;
  student_link: string;
  /** whether attempts are taken */
  open: boolean;
  /** when it closes by itself */
  closes?: string;
  /** since when it is closed */
  closed_at?: string;
  /** when it is deleted */
  ends: string;
  /** the server's time */
  at: string;
  /** points there are */
  points: number;
  created: string;
  /** raised by every change */
  version: number;
  steps: StepHead[];
  students: StudentRow[];
  /** the goals that hold most students up, the worst first */
  held_up: HeldUp[];
}

/** A new class. */
export interface ClassRequest {
  /** the lab's name */
  lab: string;
  /** as students see it */
  title: string;
  /** when it closes by itself */
  closes?: string | null;
}

/** A design, an experiment, and the methods to compare. */
export interface CompareRequest extends StepRequest {
  /** all by default */
  methods?:
    | ('full-rank' | 'tits-yang' | 'knv0' | 'varga' | 'ackermann' | 'bass-gura' | 'lqr' | 'lqr-integral')[]
    | null;
  /**
   * of the outer loops: kept, the request's own for all; placed, none; tuned, each method's own by one rule, that of
   * POST /api/v1/suggest
   */
  tuning?: 'kept' | 'placed' | 'tuned';
}

/** All methods side by side, and what becomes of the paper's claim of lower gains. */
export interface Comparison {
  rows: ComparisonRow[];
  claim: string;
  tuning: 'kept' | 'placed' | 'tuned';
  /** under which outer loops the methods are compared, in words */
  rule: string;
}

/** One method's result, or why there is none; structures are full-rank's alone. */
export interface ComparisonRow {
  /** Frobenius norm of K: the size of all its gains */
  norm?: number;
  /** spectral norm of K: the most it can amplify a state */
  spectral_norm?: number;
  /** farthest distance of a computed pole from the placed one, rad/s; left out where the method chose its own poles */
  pole_error?: number;
  /**
   * how far rounding may have moved the poles told, and so their error, rad/s; left out where the method chose its own
   * poles
   */
  pole_error_bound?: number;
  /**
   * condition number of the eigenvectors of A − BK: how sensitive the poles are, at best 1; left out where there are
   * too few eigenvectors
   */
  eigenvector_condition?: number;
  /**
   * least time constant of both rotors alike at which the loop is no longer stable; where the rotors are placed, above
   * their own, s; left out where unlimited, and where the loop is not stable
   */
  lag_margin?: number;
  method: string;
  /** V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇, then V/V, columns v_p, v_y; rows V_p, V_y */
  K?: number[][];
  /** the method's own integral action, V/(rad·s) */
  integral?: number[][];
  poles?: Complex[];
  /** asked for where the rotors are placed, rad/s */
  rotor_poles?: Complex[];
  closed_loop_poles?: Complex[];
  /** of a quadratic method: its own, those of its integrators among them, rad/s */
  optimal_poles?: Complex[];
  /** where the request has one, or measures by it */
  observer?: ObserverGains;
  findings?: Finding[];
  /** RGA at s = 0; rows θ, ψ, columns V_p, V_y */
  rga?: number[][];
  pairing?: string[][];
  reason?: string;
  /** index of the diagonal pairing */
  niederlinski?: number;
  /** index of the cross pairing */
  niederlinski_cross?: number;
  title: string;
  coupling?: string;
  lead?: string;
  unavailable?: Unavailable;
  metrics?: Metrics;
  axis_metrics?: AxisMetricsAlone;
  margins?: LoopMargins;
  sensitivity?: Sensitivity;
  loop_poles?: Complex[];
  stable?: boolean;
  /** pi, or none */
  outer?: 'pi' | 'none';
  /** the PI values around this method, where there are any */
  loops?: Loops;
}

/** A complex number. */
export interface Complex {
  /** real part */
  re: number;
  /** imaginary part */
  im: number;
}

/** What a component's value means, and the paper's symbol for it. */
export interface ComponentInfo {
  meaning: string;
  unit: string;
  printed: string;
}

/** How a controller took over in the air. */
export interface ControllerChange {
  /** when it did: at the first sample behind the event */
  tick: number;
  /** s */
  time: number;
  jump: Voltages;
  /** what it would have been with the integrals as they were */
  jump_without: Voltages;
  /** whether the integrals drive both motors, so that neither need jump */
  bumpless: boolean;
}

/** A design's numbers, of which the kernel `flight_controller` makes the controller that flies. */
export interface ControllerReply {
  /** little-endian 64-bit floats, NaN and infinities among them, in base64 */
  numbers: string;
  /** whether the linear loop is */
  stable: boolean;
}

/** Angles, rad; null where nothing was simulated. */
export interface Courses {
  /** rad */
  theta: (number | null)[];
  /** rad */
  psi: (number | null)[];
}

/** Where a pole, and its conjugate with it, passes the border of stability. */
export interface Crossed {
  /** of the number, in its unit, found to 1e-9 of it */
  value: number;
  /** with Im ≥ 0, rad/s or in the z-plane */
  pole: Complex;
  /** whether it leaves the stable side as the number grows */
  outwards: boolean;
}

/** One response, rad. */
export interface Curve {
  name: string;
  title: string;
  /** rad */
  angle: number[];
}

/** A design: what differs from the preset. */
export interface DesignRequest {
  /** structure of the closed loop */
  coupling?: 'triangular' | 'input-diagonal' | 'axis-decoupled' | null;
  /** axis that leads where the coupling is triangular */
  lead?: 'pitch' | 'yaw' | null;
  /** shift c of Luenberger's basis, q₁ → q₁ + c q₂ (yaw leading: q₂ → q₂ + c q₁); the structure's own where left out */
  shift?: number | null;
  /** pi: two PI loops (Fig. 3); none: inner loop alone (Fig. 2) */
  outer?: 'pi' | 'none' | null;
  /** which error drives which motor */
  pairing?: 'diagonal' | 'cross' | null;
  /** static decoupler Ĝ(0)⁻¹ diag(|ĝ|) between the PI controllers and the motors */
  decoupler?: boolean | null;
  /** the rotors' speeds are states of the model that is placed: full rank on six states, K is 2×6 */
  place_rotors?: boolean | null;
  /** name of a preset, see GET /api/v1/presets */
  preset?:
    | 'quanser-2dof-manual'
    | 'quanser-2dof-design-file'
    | 'paper-table-1'
    | 'paper-as-computed'
    | 'quanser-aero-2'
    | 'quanser-aero';
  parameters?: ParameterChanges;
  limits?: LimitChanges;
  operating_point?: OperatingPoint | null;
  /** p₁, p₂ (pitch's pair), p₃, p₄ (yaw's), rad/s */
  poles?: (number | { re: number; im: number })[] | null;
  /** see GET /api/v1/methods */
  method?: 'full-rank' | 'tits-yang' | 'knv0' | 'varga' | 'ackermann' | 'bass-gura' | 'lqr' | 'lqr-integral';
  /** which poles, by position from 0, form pitch's pair and which yaw's */
  split?: [number[], number[]] | null;
  weights?: WeightChanges;
  loops?: LoopsChanges;
  rotors?: RotorsChanges;
  friction?: AxisFrictionChanges;
  /** of pitch's and of yaw's rotor where they are placed, real, rad/s */
  rotor_poles?: (number | { re: number; im: number })[] | null;
  /** estimates the states where `scenario.measured` says so */
  observer?: ObserverChanges | null;
}

/** How text was split into cells. */
export interface Dialect {
  separator: string;
  decimal: string;
}

/** The rig's own controller: sampled, quantized, filtered, late, noisy. */
export interface DigitalController {
  /** time between two samples; voltages are held between them, s */
  sample_time?: number;
  /** voltages reach the motors one sample after the one that they were computed from */
  delay?: boolean;
  /** filtered: from the angles, second order, 2π·20 rad/s, damping 0.85; true: exact */
  rates?: 'filtered' | 'true';
  /** standard deviation of white noise on the measured angles, rad */
  noise?: number;
  /** of the noise */
  seed?: number;
  /** the preset's where left out */
  encoders?: EncoderCounts | null;
}

/** Off-diagonal over diagonal size of Ĝ(jω), by rows and by columns; below 1: dominant. */
export interface Dominance {
  /** per frequency, row θ and row ψ */
  rows: number[][];
  /** per frequency, column V_p and column V_y */
  columns: number[][];
}

/** Where a student is. */
export interface DraftRequest {
  student: string;
  /** the step's name */
  step: string;
  /** as for evaluate */
  design: StepRequest;
  /** by the question's name: a number, a choice or several (1-based), or text */
  answers?: Record<string, string | number | number[] | null>;
  /** of the page: an older draft than the one kept is dropped */
  seq: number;
}

/** V; null where nothing was simulated. */
export interface Driving {
  /** V */
  V_p: (number | null)[];
  /** V */
  V_y: (number | null)[];
}

/** Counts per revolution; 0 measures exactly. */
export interface EncoderCounts {
  /** of pitch's encoder; 0 measures exactly, counts per revolution */
  theta?: number;
  /** of yaw's encoder; 0 measures exactly, counts per revolution */
  psi?: number;
}

/** One output's percentiles over t, rad: a row per percentile. */
export interface Envelope {
  /** pitch, rad; a row per percentile */
  theta: number[][];
  /** yaw, rad; a row per percentile */
  psi: number[][];
}

/**
 * A step of the derivation: one plain sentence, as printed, as derived, and what became of it.
 *
 * `formulas` names what of GET symbolic stands here for another structure than the paper's.
 */
export interface Equation {
  number: string;
  title: string;
  chapter: string;
  plain: string;
  status: string;
  note: string;
  errata: string[];
  formulas: string[];
  printed?: Typeset;
  derived?: Typeset;
}

/** One mistake with its proof: an erratum where the paper's own numbers confirm it, else unclear in our copy. */
export interface Erratum {
  name: string;
  where: string;
  printed: Typeset;
  correct: Typeset;
  why: string;
  effect: string;
  /** confirmed by the paper's own printed numbers, or unclear in our copy of it */
  standing: 'confirmed' | 'unclear';
  /** the printed numbers that confirm it */
  evidence?: string;
  proof: Proof;
}

/** A parameter in SI units with its 95 % interval, which allows for what the model leaves out. */
export interface EstimateReply {
  /** of the rig's parameter, or its place in a request: rotors.pitch.tau */
  name: string;
  unit: string;
  before: number;
  value: number;
  low: number;
  high: number;
  /** half width of the interval of a model that leaves nothing out */
  noise: number;
  /** likewise, if residuals were white */
  plain: number;
  adopted: number;
}

/** As a step request; both models are computed. */
export interface EvaluateRequest extends StepRequest {
  /** also step each axis of the reference alone */
  each_axis?: boolean;
}

/** Gains, RGA, responses and margins at once. */
export interface Evaluation {
  /**
   * least time constant of both rotors alike at which the loop is no longer stable; where the rotors are placed, above
   * their own, s; left out where unlimited, and where the loop is not stable
   */
  lag_margin?: number;
  /** the live request's number */
  seq?: number;
  gains: Gains;
  open_loop_poles: Complex[];
  rga: Rga;
  step: BothModels;
  axis_steps: AxisSteps;
  margins: LoopMargins;
  sensitivity?: Sensitivity;
  loop_poles: Complex[];
  observer?: ObserverGains;
  stable: boolean;
  trim: Voltages;
  limits: Limits;
  findings: Finding[];
}

/** A residual or a figure; as a formula where it is one. */
export interface Evidence {
  text: string;
  latex?: string;
  mathml?: string;
}

/** A design, an experiment, and what stands beside them in a report. */
export interface ExportRequest extends StepRequest {
  /** listed in the report with their figures; other formats leave them out */
  pins?: PinnedDesign[];
  /** judged in the report */
  required?: Required;
  /** whether the report tells the findings */
  remarks?: boolean;
}

/** A redrawn figure; t in s. */
export interface Figure {
  /** of the paper */
  number: number;
  output: string;
  /** s */
  t: number[];
  curves: Curve[];
}

/** The value by which a requirement is judged. */
export interface FigureOfMove {
  /** in the figure's unit; left out where there is none or no limit */
  value?: number;
  /** as it is shown */
  text: string;
  met: boolean;
}

/** A figure at each value; where there is none it is 0, and `valid` says so. */
export interface FigureTrack {
  measure: string;
  axis?: string;
  motor?: string;
  model?: string;
  steps?: string;
  /** what is measured */
  words: string;
  unit: string;
  /** one per value of the number, in `unit` */
  values: number[];
  /** whether there is one: not where unstable, not settled or unlimited */
  valid: boolean[];
  /** whether it has no limit; left out where that is nowhere */
  unlimited?: boolean[];
}

/** How far what is free may go, [least, largest]; what is left out follows from the design. */
export interface FindBounds {
  /** size of a pole, rad/s */
  poles?: [number, number] | null;
  /** least damping ratio of a complex pair */
  damping?: number;
  /** size of a rotor's pole, rad/s */
  rotor_poles?: [number, number] | null;
  /** proportional gains, V/rad */
  kp?: [number, number] | null;
  /** integral times, s */
  ti?: [number, number] | null;
  /** shift c of Luenberger's basis */
  shift?: [number, number];
  /** size of an observer's pole, rad/s */
  observer?: [number, number] | null;
  /** factors on the present weights */
  weights?: [number, number];
}

/** What is free, what is required, and what is made as good as can be. */
export interface FindOptions {
  /** what may change */
  free?:
    | ('poles' | 'rotor_poles' | 'loops' | 'structure' | 'shift' | 'pairing' | 'decoupler' | 'observer' | 'weights')[];
  /** by figure its limits, several in a list */
  require?: Record<string, RequiredFigure | RequiredFigure[]>;
  /** figures that are made as small as they can be, or as large where more is better; each once */
  minimize?:
    | ('rise_time' | 'settling_time' | 'overshoot' | 'undershoot' | 'peak' | 'peak_time' | 'steady_state_error' | 'iae' | 'itae' | 'coupling_peak' | 'V_peak' | 'saturated' | 'effort' | 'gain_margin' | 'gain_reduction_margin' | 'phase_margin' | 'delay_margin' | 'sensitivity_peak' | 'sensitivity_peak_frequency' | 'disk_margin' | 'disk_frequency' | 'disk_gain_low' | 'disk_gain_high' | 'disk_phase' | 'lag_margin' | 'norm' | 'spectral_norm' | 'pole_error' | 'pole_error_bound' | 'eigenvector_condition' | 'lambda_11' | 'share_stable' | 'share_within_limits' | MinimizedFigure)[];
  /** needed for shares of uncertain rigs */
  uncertainty?: UncertainRigs | null;
  bounds?: FindBounds;
  /** how many are tried, at most; one on uncertain rigs counts as many as there are rigs */
  designs?: number;
  /** after which the search ends in any case; a server gives it at most three quarters of the time of a slow job */
  seconds?: number;
  /** the same seed gives the same designs */
  seed?: number;
}

/** How far a search is. */
export interface FindProgress {
  /** false: more comes */
  done: boolean;
  /** of the designs */
  tried: number;
  /** the budget */
  designs: number;
  seconds: number;
  /** how many of those tried meet everything */
  met: number;
  /**
   * the front so far: the minimized figures of its designs, a row each, at most 100 that are spread along it; those
   * alone that have a value of each
   */
  points: number[][];
}

/** The designs found. */
export interface FindReply {
  done: boolean;
  /** whether they meet everything; else these are the nearest misses */
  met: boolean;
  figures: ToldFigure[];
  requirements: ToldRequirement[];
  designs: FoundDesign[];
  /** left out where it does not exist */
  present?: PresentDesign;
  /** designs, those on uncertain rigs counted by rig */
  tried: number;
  /** that it took */
  seconds: number;
  /** whether the time had run out before all designs were tried */
  stopped: boolean;
  /** of the request */
  seed: number;
  why?: FoundWhy;
}

/** A design, an experiment, and what is sought around them. */
export interface FindRequest extends StepRequest {
  find: FindOptions;
}

/** A remark on a design or response that is legal but deserves a word. */
export interface Finding {
  code: string;
  severity: 'info' | 'warning' | 'error';
  message: string;
}

/** Angles, and what is left of them, at no more than 1500 of the recording's times; null between segments. */
export interface FittedCourses {
  /** s */
  t: number[];
  measured: Courses;
  /** of the rig as it was */
  before: Courses;
  /** of the rig as it was found */
  after: Courses;
  /** measured minus found */
  residuals: Courses;
}

/** A flight as it was flown: from this alone it is made again. docs/flights.md has its words. */
export interface FlightBody {
  /** version of the format */
  flight: 1;
  /** rig, design, and where the experiment begins */
  design: StepRequest;
  /** how many were flown */
  ticks: number;
  /** [tick, word, values …] in order; the value of `design` is a design; rad, rad/s, V, N·m */
  events?: unknown[][];
  /** of the noise on measured angles */
  seed?: number;
  /** [tick, θ, ψ, θ̇, ψ̇]: states on the way, rad and rad/s */
  checks?: [number, number, number, number, number][];
  /** that was flown; empty without one */
  task?: string;
  /** CRC-32 of all else, see docs/flights.md */
  checksum: string;
}

/** A flight to be played by the rig. */
export interface FlightFilmRequest {
  flight: FlightBody;
  /** of the film, s into the flight */
  begin?: number;
  /** of the film, s; null: the flight's */
  end?: number | null;
}

/** A flight whose numbers are wanted as a file. */
export interface FlightNumbersRequest {
  flight: FlightBody;
  /** tick that is told; at most 400,000 rows are */
  every?: number;
}

/** A flight that is to be a recording. */
export interface FlightRecordingRequest {
  flight: FlightBody;
  /** whether samples stay in which something pushed the body or an encoder stuck */
  whole?: boolean;
}

/** A flight as the server makes it again. */
export interface FlightReply {
  /** that were flown */
  ticks: number;
  /** s */
  duration: number;
  /** tick of which the course tells */
  every: number;
  /** s; the last is that of the last state */
  t: number[];
  /** pitch, rad */
  theta: number[];
  /** yaw, rad */
  psi: number[];
  /** rad/s */
  theta_dot: number[];
  /** rad/s */
  psi_dot: number[];
  /** of the pitch motor, V */
  V_p: number[];
  /** of the yaw motor, V */
  V_y: number[];
  measured: MeasuredCourse;
  asked: AskedCourse;
  speeds: SpeedsCourse;
  references: AxesCourse;
  /** from outside: hands and gusts */
  torques: AxesCourse;
  /** stop that pitch rests on: 1 the upper, −1 the lower, 0 none */
  stops: number[];
  /** of the controller, in order */
  changes: ControllerChange[];
  /** why the flight ended by itself; empty if it did not */
  ended: string;
  /** how far the log's own states are from these at most, rad and rad/s; 0 without any */
  apart: number;
  /** left out of a flight of more than 400,000 ticks */
  score?: FlightScore;
  /** SHA-256 of all rows that were flown, as little-endian 64-bit floats */
  hash: string;
}

/** A flight, and how much of its course is replied. */
export interface FlightRequest {
  flight: FlightBody;
  /** of the course, at most: every n-th tick, and the last state */
  samples?: number;
}

/** What a flight is worth; without a task its own set points are what was asked. */
export interface FlightScore {
  /** by figure, in the registry's units (SI); what there is not is left out */
  values: Record<string, number | AxisFigures>;
  /** of the task, 0 to 3; 0 without one */
  stars: number;
  /** whether the task has come to its end */
  done: boolean;
  /** why the flight does not count as its task; empty if it does, or has none */
  flaw: string;
}

/** A task in the air. */
export interface FlightTask {
  /** in logs */
  name: string;
  title: string;
  /** what is to be done */
  words: string;
  /** s; with marks to be reached, at most */
  duration: number;
  /** [time (s), θ − θ₀ as a share of the task's reach, ψ (rad)], in between smoothly */
  marks: [number, number, number][];
  /** by which stars are given; lower is better */
  figure: string;
  /** that are told, it first */
  figures: string[];
  /** its limits for one, two and three stars */
  stars: number[];
  /** that come, by the log's seed */
  gusts: number;
  /** of their torques, as a share of what a motor's limit gives */
  strength: number;
  /** whether set points are the pilot's */
  free: boolean;
  /** how it is done before its time */
  ends: '' | 'landed' | 'reached';
  /** whose hands share it */
  pilots: number;
  /** whether these limits are times V_p,max² + V_y,max² of the rig, V² */
  per_square_volt: boolean;
}

/** A flight that was marked: enough to tell later that a log is this one. */
export interface FlightTold {
  task: string;
  /** of its gusts and its noise */
  seed: number;
  /** how long it was */
  ticks: number;
  /** of its log */
  checksum: string;
  /** figures, some by axis */
  values: Record<string, number | Record<string, number>>;
}

/** One expression in three notations. */
export interface Formula {
  sympy: string;
  latex: string;
  mathml: string;
}

/** What was free, to be put in the request's place. */
export interface FoundChanges {
  poles?: Complex[];
  rotor_poles?: Complex[];
  loops?: FoundLoops;
  coupling?: string;
  lead?: string;
  /** shift c of Luenberger's basis */
  shift?: number;
  pairing?: string;
  decoupler?: boolean;
  observer?: FoundObserver;
  /** of states, inputs and integrals by name */
  weights?: Record<string, Record<string, number>>;
}

/** One design. */
export interface FoundDesign {
  figures: FoundFigure[];
  required: FoundRequirement[];
  stable: boolean;
  met: boolean;
  design: FoundChanges;
}

/** A figure of one design. */
export interface FoundFigure {
  /** left out where there is none, or no limit */
  value?: number;
  text: string;
}

/** What one requirement would have to become. */
export interface FoundGive {
  /** its place among the requirements */
  requirement: number;
  /** left out where nothing was found */
  value?: number;
  text: string;
  /** by how much it would have to give */
  by?: number;
  /** whether all other requirements are met then */
  others: boolean;
  message: string;
}

/** An axis' PI loop. */
export interface FoundLoop {
  /** V/rad */
  kp: number;
  /** s */
  ti: number;
}

/** Both PI loops. */
export interface FoundLoops {
  pitch: FoundLoop;
  yaw: FoundLoop;
}

/** The observer: its poles, and what was not free of it. */
export interface FoundObserver {
  poles: Complex[];
  coupling: string;
  lead: string;
}

/** A requirement of one design. */
export interface FoundRequirement {
  met: boolean;
  /** of the uncertain rigs that meet it */
  share?: number;
}

/** Why nothing meets everything, as far as was seen. */
export interface FoundWhy {
  /** requirements that no design tried meets, whatever else is asked */
  alone: number[];
  /** of the others the smallest set that no design tried meets together; empty where there is none */
  requirements: number[];
  /**
   * pairs of requirements whose limits exclude one another, before any design is tried; left out where there are none
   */
  excluding?: number[][];
  message: string;
  gives: FoundGive[];
}

/** L(jω) of the loop opened at one motor's input, the rest closed; the phase without jumps, rad. */
export interface FrequencyResponse {
  /** |L(jω)| */
  gain: number[];
  /** without jumps, rad */
  phase: number[];
}

/** Coulomb friction of one axis, with stiction. */
export interface Friction {
  /** torque against the motion, N·m */
  coulomb: number;
  /**
   * torque that an axis at rest withstands; less than the one against the motion counts as equal, N·m; as against the
   * motion where left out
   */
  static?: number;
}

/** Coulomb friction of one axis, with stiction. */
export interface FrictionChanges {
  /** torque against the motion, N·m */
  coulomb?: number | null;
  /**
   * torque that an axis at rest withstands; less than the one against the motion counts as equal, N·m; as against the
   * motion where left out
   */
  static?: number | null;
}

/** Friction of both axes. */
export interface FrictionPair {
  pitch: Friction;
  yaw: Friction;
}

/**
 * K in V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇, with rotors placed v_p, v_y in V/V; rows V_p, V_y.
 *
 * `integral` is a method's own integral action, V/(rad·s); `pole_error` is left out where the method chose its own
 * poles, `eigenvector_condition` where there are too few eigenvectors.
 */
export interface Gains {
  /** Frobenius norm of K: the size of all its gains */
  norm: number;
  /** spectral norm of K: the most it can amplify a state */
  spectral_norm: number;
  /** farthest distance of a computed pole from the placed one, rad/s; left out where the method chose its own poles */
  pole_error?: number;
  /**
   * how far rounding may have moved the poles told, and so their error, rad/s; left out where the method chose its own
   * poles
   */
  pole_error_bound?: number;
  /**
   * condition number of the eigenvectors of A − BK: how sensitive the poles are, at best 1; left out where there are
   * too few eigenvectors
   */
  eigenvector_condition?: number;
  /**
   * least time constant of both rotors alike at which the loop is no longer stable; where the rotors are placed, above
   * their own, s; left out where unlimited, and where the loop is not stable
   */
  lag_margin?: number;
  method: string;
  /** V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇, then V/V, columns v_p, v_y; rows V_p, V_y */
  K: number[][];
  /** the method's own integral action, V/(rad·s) */
  integral?: number[][];
  /** of the model, 4×4, x = [θ, ψ, θ̇, ψ̇], or 6×6, [x, v_p, v_y], SI */
  A: number[][];
  /** 4×2 or 6×2, inputs V_p, V_y, SI */
  B: number[][];
  poles: Complex[];
  /** asked for where the rotors are placed, rad/s */
  rotor_poles?: Complex[];
  closed_loop_poles: Complex[];
  /** of a quadratic method: its own, those of its integrators among them, rad/s */
  optimal_poles?: Complex[];
  /** one per input */
  controllability_indices: number[];
  /** where the request has one, or measures by it */
  observer?: ObserverGains;
  findings: Finding[];
}

/** A goal, as the head of a column. */
export interface GoalHead {
  name: string;
  label?: string;
  required_text?: string;
  /** points there are */
  points: number;
}

/** A goal or a question of an attempt, judged. */
export interface GoalTold {
  name: string;
  /** left out where it is marked by hand */
  met?: boolean;
  /** points given */
  points: number;
  /** points there are */
  of: number;
}

/** A block of the closed loop: its inputs and its poles, by position from 0. */
export interface Group {
  /** positions from 0 */
  inputs: number[];
  /** positions from 0 */
  poles: number[];
}

/** What the columns probably are. */
export interface Guess {
  columns: Record<string, string>;
  /** of the angles: rad or deg */
  unit: string;
  /** of angles whose unit is another one */
  units: Record<string, string>;
  /** of the column of time */
  time_unit: string | null;
  /** of both voltages */
  voltage_unit: string;
  /** usual time between two rows in that unit, s */
  sample_time: number | null;
}

/** An instructor's mark of an answer in words. */
export interface HandMark {
  /** the step's name */
  step: string;
  question: string;
  /** points given */
  points: number;
  comment?: string;
}

/** A hand mark, as it is kept. */
export interface HandMarked {
  question: string;
  /** points given */
  points: number;
  comment: string;
  at: string;
}

/** A goal that holds students up. */
export interface HeldUp {
  step: string;
  goal: string;
  /** who are there or have tried */
  students: number;
  /** who have tried */
  tried: number;
  /** of these, who meet it */
  met: number;
}

/** A hint. */
export interface Hint {
  /** its number, 1-based */
  hint: number;
  text: string;
  /** points that it costs */
  cost: number;
}

/** A hint that a student takes. */
export interface HintRequest {
  student: string;
  /** the step's name */
  step: string;
  /** its number, 1-based */
  hint: number;
}

/** The result over the socket; before it come `{"evaluations", "rms"}`. */
export interface IdentificationReply {
  done: boolean;
  estimates: EstimateReply[];
  /** with what was found, as a request takes them; quadratic curves say where they are matched */
  rotors: RotorPair;
  /** likewise */
  friction: FrictionPair;
  rms_before: PerAxis | null;
  rms: PerAxis;
  /** what was fitted, then what was held out where something was */
  parts: PartReply[];
  courses: FittedCourses;
  whiteness: WhitenessPair;
  /** of the recording, s */
  sample_time: number;
  segments: number;
  lags: number;
  evaluations: number;
  seconds: number;
  findings: Finding[];
}

/** A rig as it is thought to be, its rotors and friction too, and what of it is free. */
export interface IdentifyRequest extends DesignRequest {
  recording: string;
  columns: Mapping;
  /**
   * thrust constants, damping and stiffness by default, K_s only where it is not 0; names with dots are those of a
   * request: time constants of rotors, and friction; J_p and J_y scale with thrust and damping of their axis
   */
  free?:
    | ('K_pp' | 'K_py' | 'K_yp' | 'K_yy' | 'B_p' | 'B_y' | 'K_s' | 'rotors.pitch.tau' | 'rotors.yaw.tau' | 'friction.pitch.coulomb' | 'friction.yaw.coulomb' | 'J_p' | 'J_y')[]
    | null;
  /** s; by default by the rig's stability */
  segment?: number | null;
  /** share of the recording's time, its end, that is not fitted but held against the result */
  held_out?: number;
}

/** State at t = 0; angles are absolute. */
export interface Initial {
  /** pitch at t = 0, rad; at rest at the operating point (θ₀, 0) where left out */
  theta?: number | null;
  /** yaw at t = 0, rad; at rest at the operating point (θ₀, 0) where left out */
  psi?: number | null;
  /** rate of pitch at t = 0, rad/s */
  theta_dot?: number;
  /** rate of yaw at t = 0, rad/s */
  psi_dot?: number;
}

/** Volts that act on the motors besides the controller's, from `time` on. */
export interface InputDisturbance {
  /** added to the pitch motor's voltage, V */
  V_p?: number;
  /** added to the yaw motor's voltage, V */
  V_y?: number;
  /** when they begin to act, s */
  time?: number;
}

/** The diagonal of R. */
export interface InputWeights {
  /** on R's diagonal, 1/V² */
  V_p?: number | null;
  /** on R's diagonal, 1/V² */
  V_y?: number | null;
}

/** The diagonal of Q_z, where the method brings integral action. */
export interface IntegralWeights {
  /** on the integral of this error, 1/(rad·s)² */
  theta?: number | null;
  /** on the integral of this error, 1/(rad·s)² */
  psi?: number | null;
}

/** Somebody joins by their name, or comes back by their secret. */
export interface JoinClassRequest {
  /** of who comes back; all else is left out then */
  student?: string | null;
  /** as the instructor knows you */
  name?: string | null;
  /** for the grade book */
  email?: string | null;
  /** for the grade book */
  login?: string | null;
  id?: string | null;
}

/** Files of one run, sent before, to be joined into one recording. */
export interface JoinRequest {
  /** their ids */
  recordings: string[];
}

/** Where a student begins, or left off. */
export interface Joined {
  /** within this server */
  id: number;
  /** by order of joining */
  number: number;
  name: string;
  email?: string;
  login?: string;
  joined: string;
  last_seen: string;
  /** the server's time */
  at: string;
  code: string;
  title: string;
  open: boolean;
  closes?: string;
  closed_at?: string;
  ends: string;
  steps: Record<string, StepKept>;
  platform?: AtPlatform;
  /** the student's secret */
  student: string;
  /** their own rig: part of a design */
  rig: Record<string, unknown>;
  lab: LabView;
}

/** Which lab a class works on. */
export interface LabOfClass {
  name: string;
  /** place in the course */
  number?: number;
  title: string;
}

/** A lab in the list. */
export interface LabSummary {
  name: string;
  /** place in the course */
  number?: number;
  title: string;
  summary?: string;
  /** that it takes, min */
  minutes?: number;
  /** points there are */
  points: number;
  /** number of steps */
  steps: number;
  /** `shipped`, or `own` of who runs the server */
  source: string;
}

/** A lab as a student may see it: no answers, no solutions, no hint's text that costs points. */
export interface LabView {
  name: string;
  title: string;
  /** texts, locks, goals, questions; see docs/labs.md */
  steps: Record<string, unknown>[];
  /** of the seed asked for: part of a design */
  rig?: Record<string, unknown>;
}

/** The poles of the whole loop as the rotors' lag grows from nothing to what it is. */
export interface Lag {
  /** time constants at the end, pitch's and yaw's rotor, s */
  tau: number[];
  /** whether these are a real rig's, 0.16 s, as the rig given has none */
  assumed: boolean;
  /** of these, from nearly 0 to 1 */
  share: number[];
  /** per pole its course over `share`, rad/s */
  poles: Complex[][];
}

/** Limits that differ from the preset's. */
export interface LimitChanges {
  /** largest voltage of the pitch motor, either way, V */
  V_p?: number | null;
  /** largest voltage of the yaw motor, either way, V */
  V_y?: number | null;
  /** pitch travel to either side of level, rad; none where it is free */
  theta?: number | null;
}

/** Limits of one figure, in SI units but for %; one of them at least. */
export interface LimitedFigure {
  /** the axis that is stepped; both, the worse one, where left out */
  axis?: 'theta' | 'psi' | 'both' | null;
  /** the motor; both, the worse one, where left out */
  motor?: 'V_p' | 'V_y' | 'both' | null;
  /** of the response; nonlinear where left out */
  model?: 'linear' | 'nonlinear' | null;
  /** alone, each axis by itself, where left out; together, the scenario as it is set */
  steps?: 'alone' | 'together' | null;
  /** at most, in the figure's unit */
  max?: number | null;
  /** at least, in the figure's unit */
  min?: number | null;
}

/** Voltage limits, V, and pitch travel, rad, where it is not free. */
export interface Limits {
  /** largest voltage of the pitch motor, either way, V */
  V_p: number;
  /** largest voltage of the yaw motor, either way, V */
  V_y: number;
  /** pitch travel to either side of level, rad; none where it is free */
  theta?: number;
}

/** An evaluate request with the number that its answer will carry. */
export interface LiveRequest extends EvaluateRequest {
  seq: number;
}

/** PI(s) = kp (1 + 1/(ti s)) of one axis. */
export interface LoopChanges {
  /** proportional gain, V/rad */
  kp?: number | null;
  /** integral time, s */
  ti?: number | null;
}

/** Margins at each motor; left out where the loop is unstable. */
export interface LoopMargins {
  pitch?: Margins;
  yaw?: Margins;
}

/** PI values of both axes. */
export interface Loops {
  pitch: PI;
  yaw: PI;
}

/** The PI controllers of the pitch and the yaw error. */
export interface LoopsChanges {
  pitch?: LoopChanges;
  yaw?: LoopChanges;
}

/** A design with its outer loop, and frequencies at which L(jω) is wanted; of the scenario `measured` counts. */
export interface LoopsRequest extends StepRequest {
  /** rad/s */
  frequencies: number[];
}

/** Which two numbers of the design are moved, over which places, and what is measured there. */
export interface MapAsked {
  /** the axis that is stepped; both, the worse one, where left out */
  axis?: 'theta' | 'psi' | 'both' | null;
  /** the motor; both, the worse one, where left out */
  motor?: 'V_p' | 'V_y' | 'both' | null;
  /** of the response; nonlinear where left out */
  model?: 'linear' | 'nonlinear' | null;
  /** alone, each axis by itself, where left out; together, the scenario as it is set */
  steps?: 'alone' | 'together' | null;
  /** name of a figure of merit */
  measure?:
    | 'rise_time'
    | 'settling_time'
    | 'overshoot'
    | 'undershoot'
    | 'peak'
    | 'peak_time'
    | 'steady_state_error'
    | 'iae'
    | 'itae'
    | 'coupling_peak'
    | 'V_peak'
    | 'saturated'
    | 'effort'
    | 'gain_margin'
    | 'gain_reduction_margin'
    | 'phase_margin'
    | 'delay_margin'
    | 'sensitivity_peak'
    | 'sensitivity_peak_frequency'
    | 'disk_margin'
    | 'disk_frequency'
    | 'disk_gain_low'
    | 'disk_gain_high'
    | 'disk_phase'
    | 'lag_margin'
    | 'norm'
    | 'spectral_norm'
    | 'pole_error'
    | 'pole_error_bound'
    | 'eigenvector_condition'
    | 'lambda_11'
    | 'share_stable'
    | 'share_within_limits';
  /** a pair of poles, x ± jy, or k_p (x) and T_i (y) of an axis' PI loop */
  move: 'pitch-pair' | 'yaw-pair' | 'pitch-pi' | 'yaw-pi';
  /** [[x first, last], [y first, last]], rad/s, or V/rad and s; around the design where left out */
  over?: [[number, number], [number, number]] | null;
  /** places along x and along y */
  size?: [number, number];
  /** of a pair: both poles are real, x and y */
  real?: boolean;
  /** of gains: log where left out; of poles: linear */
  scale?: 'linear' | 'log' | null;
  /** needed for shares of uncertain rigs, and used for them alone */
  uncertainty?: UncertainRigs | null;
}

/** A figure at every place; row j of the tables is at y[j]. */
export interface MapReply {
  move: 'pitch-pair' | 'yaw-pair' | 'pitch-pi' | 'yaw-pi';
  real: boolean;
  scale: 'linear' | 'log';
  measure: string;
  axis?: 'theta' | 'psi' | 'both';
  motor?: 'V_p' | 'V_y' | 'both';
  model?: 'linear' | 'nonlinear';
  steps?: 'alone' | 'together';
  /** the figure and its response in words */
  title: string;
  /** of the values; empty of ratios and shares (0 to 1) */
  unit: string;
  /** which values are */
  better: 'lower' | 'higher' | 'none';
  /** rad/s, or k_p in V/rad */
  x: number[];
  /** rad/s, or T_i in s */
  y: number[];
  /** 0 where not valid */
  values: number[][];
  /** whether the loop is stable and has such a figure */
  valid: boolean[][];
  /** whether it has none because there is no limit, which is as good as can be */
  unlimited: boolean[][];
  /** whether the loop is stable */
  stable: boolean[][];
  /** left out where the design is none of this plane */
  here?: Place;
}

/** A design, an experiment, and what is mapped around them. */
export interface MapRequest extends StepRequest {
  map: MapAsked;
}

/** Which column is what, and how its angles become ours. */
export interface Mapping {
  /** of the file's angles, references and offsets included */
  unit?: 'rad' | 'deg';
  /** time between two rows, s; where no column is the time */
  sample_time?: number | null;
  /** of the column of time; what the file states, or s, where left out */
  time_unit?: 's' | 'ms' | 'us' | 'ns' | 'min' | 'h' | 'd' | null;
  /** of both voltages */
  voltage_unit?: 'V' | 'mV';
  /** of so many rows one is kept, and the voltages between are averaged */
  decimate?: number;
  time?: string | null;
  theta?: string | null;
  psi?: string | null;
  V_p?: string | null;
  V_y?: string | null;
  theta_ref?: string | null;
  psi_ref?: string | null;
  units?: AngleUnits;
  signs?: Signs;
  offsets?: Offsets;
}

/** Margins at one motor's input: factors, rad, s; left out where unlimited. */
export interface Margins {
  /** smallest factor above 1 on the motor’s gain that makes the loop unstable; left out where unlimited */
  gain_margin?: number;
  /** largest factor below 1 on the motor’s gain that makes the loop unstable; left out where unlimited */
  gain_reduction_margin?: number;
  /** smallest phase lag or lead at a gain crossover that makes the loop unstable, rad; left out where unlimited */
  phase_margin?: number;
  /**
   * smallest dead time at this axis’ own motor that makes the loop unstable: phase margin over crossover frequency, s;
   * left out where unlimited
   */
  delay_margin?: number;
}

/** An attempt at a lab's step without a class. */
export interface MarkRequest {
  /** of the rig: the same seed, the same rig */
  seed?: number;
  /** the step's name */
  step: string;
  /** as for evaluate */
  design: StepRequest;
  /** by the question's name: a number, a choice or several (1-based), or text */
  answers?: Record<string, string | number | number[] | null>;
  /** hints that were taken, 1-based */
  hints?: number[];
  flight?: Record<string, unknown> | null;
}

/** An attempt, marked. */
export interface Marked {
  goals: GoalTold[];
  questions: GoalTold[];
  /** points given */
  points: number;
  /** points there are */
  of: number;
  stable?: boolean;
  findings?: Finding[];
  /** where one was handed in and counts */
  flight?: FlightTold;
}

/** What the controller knew at its last sample. */
export interface MeasuredCourse {
  /** rad */
  theta: number[];
  /** rad */
  psi: number[];
  /** rad/s */
  theta_dot: number[];
  /** rad/s */
  psi_dot: number[];
}

/** Somebody in the course. */
export interface Member {
  /** empty where the platform keeps it to itself */
  name: string;
  instructor: boolean;
  /** id in the class; left out where they have not joined */
  student?: number;
}

/** Everybody in the course, as the platform tells it at this moment; nothing of it is kept. */
export interface MembersReply {
  members: Member[];
  /** ISO 8601, UTC */
  at: string;
}

/** A placement method; `needs` names the package that it takes, `couplings` are full-rank's alone. */
export interface Method {
  name: string;
  title: string;
  source: string;
  /** whether it takes the poles given, rather than choose its own */
  places_poles: boolean;
  /** whether it minimizes a quadratic cost, by weights */
  weighted: boolean;
  /** whether it brings integral action, in place of the PI loops */
  integrates: boolean;
  available: boolean;
  couplings: string[];
  leads: string[];
  needs?: string;
}

/** Metrics of each stepped axis, of the axis that is not, and of the motors. */
export interface Metrics {
  theta?: AxisMetrics;
  psi?: AxisMetrics;
  /** largest deviation of the axis that is not stepped, rad; left out where both are stepped */
  coupling_peak?: number;
  V_p: MotorMetrics;
  V_y: MotorMetrics;
}

/** Everything that is kept of a student. */
export interface Mine {
  /** within this server */
  id: number;
  /** by order of joining */
  number: number;
  name: string;
  email?: string;
  login?: string;
  joined: string;
  last_seen: string;
  /** the server's time */
  at: string;
  code: string;
  title: string;
  open: boolean;
  closes?: string;
  closed_at?: string;
  ends: string;
  steps: Record<string, StepKept>;
  platform?: AtPlatform;
}

/** A figure that is made as good as it can be. */
export interface MinimizedFigure {
  /** the axis that is stepped; both, the worse one, where left out */
  axis?: 'theta' | 'psi' | 'both' | null;
  /** the motor; both, the worse one, where left out */
  motor?: 'V_p' | 'V_y' | 'both' | null;
  /** of the response; nonlinear where left out */
  model?: 'linear' | 'nonlinear' | null;
  /** alone, each axis by itself, where left out; together, the scenario as it is set */
  steps?: 'alone' | 'together' | null;
  measure:
    | 'rise_time'
    | 'settling_time'
    | 'overshoot'
    | 'undershoot'
    | 'peak'
    | 'peak_time'
    | 'steady_state_error'
    | 'iae'
    | 'itae'
    | 'coupling_peak'
    | 'V_peak'
    | 'saturated'
    | 'effort'
    | 'gain_margin'
    | 'gain_reduction_margin'
    | 'phase_margin'
    | 'delay_margin'
    | 'sensitivity_peak'
    | 'sensitivity_peak_frequency'
    | 'disk_margin'
    | 'disk_frequency'
    | 'disk_gain_low'
    | 'disk_gain_high'
    | 'disk_phase'
    | 'lag_margin'
    | 'norm'
    | 'spectral_norm'
    | 'pole_error'
    | 'pole_error_bound'
    | 'eigenvector_condition'
    | 'lambda_11'
    | 'share_stable'
    | 'share_within_limits';
}

/** Largest |voltage|, V, share of time at the limit, and effort ∫ (V − V_trim)² dt, V²·s. */
export interface MotorMetrics {
  /** largest voltage of the motor, trim included, V */
  peak: number;
  /** share of time at its limit, 0 to 1 */
  saturated: number;
  /**
   * ∫ (V − V_trim)² dt over the time shown: what control costs beyond holding still; the inputs’ part of the quadratic
   * cost, V²·s
   */
  effort: number;
}

/** A design near the one that was asked about. */
export interface MoveReply {
  /** what moves */
  handles: ('pitch-pair' | 'yaw-pair' | 'pitch-pi' | 'yaw-pi')[];
  /**
   * root of the squares' sum: each pole by what it moves, as a share of its distance from the origin, each gain and
   * integral time by the logarithm of its ratio
   */
  distance: number;
  /** what moves where */
  words: string;
  design: Moved;
  /** one of each requirement */
  figures: FigureOfMove[];
}

/** Poles and loops of a design that is near. */
export interface Moved {
  /** p₁, p₂ (pitch's pair), p₃, p₄ (yaw's), rad/s */
  poles: Complex[];
  /** where they are placed, rad/s */
  rotor_poles?: number[];
  loops: Loops;
}

/** What is required, and what may move. */
export interface NearestAsked {
  /** by figure its limits, several in a list; none: the loop shall be stable */
  require: Record<string, LimitedFigure | LimitedFigure[]>;
  /** what may move: poles, loops, or one pair or one axis' PI; what moves nothing is left out */
  free?: ('poles' | 'loops' | 'pitch-pair' | 'yaw-pair' | 'pitch-pi' | 'yaw-pi')[];
  /** how far is near, as the moves' distances */
  within?: number;
}

/** The moves, nearest first. */
export interface NearestReply {
  /** whether the design meets everything as it is, and is stable */
  met: boolean;
  requirements: RequirementTold[];
  /** what was free and moves something in this design */
  free: ('pitch-pair' | 'yaw-pair' | 'pitch-pi' | 'yaw-pi')[];
  /** that meet everything: of all that is free, and of less where that is enough; each is proved by evaluate */
  moves: MoveReply[];
  /** where no design near meets everything: the one, within reach, that misses the least */
  closest?: MoveReply;
  /** positions of requirements that no design near has met */
  out_of_reach: number[];
  /** pairs of positions of requirements whose limits exclude one another; left out where there are none */
  excluding?: number[][];
  /** in words: where there is no move, all that the closest misses */
  summary: string;
  /** how far was looked */
  within: number;
  /** designs that were looked at */
  tried: number;
}

/** A design, an experiment, and what is required of them. */
export interface NearestRequest extends StepRequest {
  nearest: NearestAsked;
}

/** A class that was made; its secret is told this once. */
export interface NewClassReply {
  /** for the board */
  code: string;
  /** the instructor's secret */
  instructor: string;
  /** fragment of the page's address, for students */
  student_link: string;
  /** address of the wall, relative to the page's; holds the secret */
  instructor_link: string;
  /** when it is deleted with all that is in it */
  ends: string;
}

/** The instructor's new link; the old one has ended. */
export interface NewInstructorLink {
  /** the new secret */
  instructor: string;
  /** address of the wall, relative to the page's */
  instructor_link: string;
}

/** A student's new personal link; the old one has ended. */
export interface NewLink {
  /** the new secret */
  student: string;
  /** fragment of the page's address */
  link: string;
}

/** What estimates the states from the angles and the voltages. */
export interface ObserverChanges {
  /** full-rank: its poles are placed; kalman: optimal for white noise of these densities */
  method?: 'full-rank' | 'kalman';
  /** of the estimate's errors */
  coupling?: 'triangular' | 'input-diagonal' | 'axis-decoupled';
  /** the axis that leads where the errors' coupling is triangular */
  lead?: 'pitch' | 'yaw';
  /** white noise that a Kalman filter expects on the motors' voltages, V/√Hz */
  voltage_noise?: number;
  /** white noise that it expects on the measured angles, rad/√Hz */
  angle_noise?: number;
  /** of the estimate's errors: q₁, q₂ (pitch's pair), q₃, q₄ (yaw's), rad/s */
  poles?: (number | { re: number; im: number })[] | null;
}

/** What estimates the states: x̂' = A x̂ + B u + L (y − C x̂). */
export interface ObserverGains {
  /** 4×2, rows θ, ψ, θ̇, ψ̇, columns θ, ψ; 1/s, and 1/s² below */
  L: number[][];
  /** eigenvalues of A − LC, rad/s, slowest first */
  poles: Complex[];
}

/** The observer in numbers: the design's, or the usual one. */
export interface ObserverSteps {
  /** whether the design's feedback acts on its estimate */
  used: boolean;
  /** 4×2, 1/s and 1/s² */
  L: number[][];
  /** q₁ … q₄; left out of a Kalman filter */
  asked?: Complex[];
  /** of A − LC, rad/s */
  poles: Complex[];
}

/** Added to the file's angles after their signs, in its unit. */
export interface Offsets {
  /** to pitch, in the file's unit */
  theta?: number;
  /** to yaw, in the file's unit */
  psi?: number;
}

/** The loops opened at each motor, over frequency, rad/s; −1 is critical. */
export interface OpenLoops {
  /** rad/s */
  frequencies: number[];
  pitch: FrequencyResponse;
  yaw: FrequencyResponse;
  margins: LoopMargins;
  stable: boolean;
}

/** Where the rig rests and the model is linearized. */
export interface OperatingPoint {
  /** pitch angle θ₀ at which the rig rests and is linearized, rad */
  theta?: number | null;
}

/** Where the printed K puts the poles of one plant, rad/s. */
export interface Outcome {
  plant: string;
  poles: Complex[];
  unrounded: Complex[];
}

/** Measured and simulated, at no more than 1500 of the recording's times. */
export interface OverlayReply {
  driver: string;
  /** of the recording */
  samples: number;
  /** s */
  sample_time: number;
  /** s */
  duration: number;
  fit: PerAxis;
  rms: PerAxis;
  /** how often the simulation was begun anew */
  segments: number;
  /** s */
  t: number[];
  measured: Courses;
  simulated: Courses;
  residuals: Courses;
  references?: Courses;
  voltages: Volts;
  driving: Driving;
  findings: Finding[];
}

/** A design to lay over a recording. */
export interface OverlayRequest extends StepRequest {
  columns: Mapping;
  /**
   * voltages: one run under the recorded voltages; segments: begun anew every few seconds; references: the design's
   * loop under the recorded references
   */
  driver?: 'voltages' | 'segments' | 'references';
  /** s; by default by the rig's stability */
  segment?: number | null;
}

/** PI(s) = kp (1 + 1/(ti s)) of one axis. */
export interface PI {
  /** proportional gain, V/rad */
  kp: number;
  /** integral time, s */
  ti: number;
}

/** The paper, reproduced. */
export interface Paper {
  title: string;
  authors: string;
  equations: Equation[];
  symbols: Term[];
  numbers: PrintedNumber[];
  errata: Erratum[];
  consequence: Outcome[];
  figures: Figure[];
}

/** Parameters that differ from the preset's. */
export interface ParameterChanges {
  /** thrust torque about pitch per volt of the pitch motor, N·m/V */
  K_pp?: number | null;
  /** thrust torque about pitch per volt of the yaw motor, N·m/V */
  K_py?: number | null;
  /** thrust torque about yaw per volt of the pitch motor, N·m/V */
  K_yp?: number | null;
  /** thrust torque about yaw per volt of the yaw motor, N·m/V */
  K_yy?: number | null;
  /** moment of inertia about the pitch axis, kg·m² */
  J_p?: number | null;
  /** moment of inertia about the yaw axis, kg·m² */
  J_y?: number | null;
  /** moving mass, kg */
  m?: number | null;
  /** distance of the centre of mass from the pivot, m */
  l?: number | null;
  /** viscous damping about pitch, N·m·s/rad */
  B_p?: number | null;
  /** viscous damping about yaw, N·m·s/rad */
  B_y?: number | null;
  /** pitch stiffness, N·m/rad */
  K_s?: number | null;
  /** gravitational acceleration, m/s² */
  g?: number | null;
}

/** What a parameter or a limit means, and its range. */
export interface ParameterInfo {
  meaning: string;
  unit: string;
  /** lowest value allowed, in `unit` */
  minimum: number;
  /** highest value allowed, in `unit` */
  maximum: number;
}

/** A part of the recording. */
export interface PartReply {
  /** whether it was not fitted, but held against the result */
  held_out: boolean;
  /** where it begins, s */
  first: number;
  /** s */
  end: number;
  /** that were simulated in it */
  segments: number;
  /** of the rig as it was; null where it runs away */
  before: AgreementReply | null;
  /** of the rig as it was found */
  after: AgreementReply;
}

/** A number per axis; null where it is not defined. */
export interface PerAxis {
  /** of pitch; % or rad, as the field says */
  theta: number | null;
  /** of yaw */
  psi: number | null;
}

/** A design that a report lists beside its own. */
export interface PinnedDesign {
  /** structure of the closed loop */
  coupling?: 'triangular' | 'input-diagonal' | 'axis-decoupled' | null;
  /** axis that leads where the coupling is triangular */
  lead?: 'pitch' | 'yaw' | null;
  /** shift c of Luenberger's basis, q₁ → q₁ + c q₂ (yaw leading: q₂ → q₂ + c q₁); the structure's own where left out */
  shift?: number | null;
  /** pi: two PI loops (Fig. 3); none: inner loop alone (Fig. 2) */
  outer?: 'pi' | 'none' | null;
  /** which error drives which motor */
  pairing?: 'diagonal' | 'cross' | null;
  /** static decoupler Ĝ(0)⁻¹ diag(|ĝ|) between the PI controllers and the motors */
  decoupler?: boolean | null;
  /** the rotors' speeds are states of the model that is placed: full rank on six states, K is 2×6 */
  place_rotors?: boolean | null;
  /** name of a preset, see GET /api/v1/presets */
  preset?:
    | 'quanser-2dof-manual'
    | 'quanser-2dof-design-file'
    | 'paper-table-1'
    | 'paper-as-computed'
    | 'quanser-aero-2'
    | 'quanser-aero';
  parameters?: ParameterChanges;
  limits?: LimitChanges;
  operating_point?: OperatingPoint | null;
  /** p₁, p₂ (pitch's pair), p₃, p₄ (yaw's), rad/s */
  poles?: (number | { re: number; im: number })[] | null;
  /** see GET /api/v1/methods */
  method?: 'full-rank' | 'tits-yang' | 'knv0' | 'varga' | 'ackermann' | 'bass-gura' | 'lqr' | 'lqr-integral';
  /** which poles, by position from 0, form pitch's pair and which yaw's */
  split?: [number[], number[]] | null;
  weights?: WeightChanges;
  loops?: LoopsChanges;
  rotors?: RotorsChanges;
  friction?: AxisFrictionChanges;
  /** of pitch's and of yaw's rotor where they are placed, real, rad/s */
  rotor_poles?: (number | { re: number; im: number })[] | null;
  /** estimates the states where `scenario.measured` says so */
  observer?: ObserverChanges | null;
  scenario?: ScenarioChanges;
  /** what its row is called */
  name: string;
}

/** Where the design itself stands in the plane, and what it has. */
export interface Place {
  /** rad/s, or k_p in V/rad */
  x: number;
  /** rad/s, or T_i in s */
  y: number;
  /** left out where it has none */
  value?: number;
  /** whether it has none because there is no limit */
  unlimited: boolean;
}

/** Any system ẋ = Ax + Bu and its desired poles, row by row, in any units. */
export interface PlaceRequest {
  /** n×n, row by row */
  A: number[][];
  /** n×p, row by row */
  B: number[][];
  /** n, in the unit of A; complex ones with their conjugates */
  poles: (number | { re: number; im: number })[];
  method?: 'full-rank' | 'tits-yang' | 'knv0' | 'varga' | 'ackermann' | 'bass-gura' | 'lqr' | 'lqr-integral';
  /** full-rank: by default in the order of the poles */
  groups?: PoleGroup[] | null;
  /** full-rank: order in which the inputs are scanned */
  input_order?: number[] | null;
  /** full-rank: off-diagonal blocks that stay as the plant has them */
  triangle?: 'none' | 'lower' | 'upper';
  /** full-rank: p×p, leading rows q → shift · q */
  shift?: number[][] | null;
  /** lqr-integral: the outputs that it regulates */
  C?: number[][] | null;
  weights?: SystemWeights;
}

/** K of u = −Kx + v for any system; T, Q, indices and groups with full-rank placement. */
export interface Placement {
  /** Frobenius norm of K: the size of all its gains */
  norm: number;
  /** spectral norm of K: the most it can amplify a state */
  spectral_norm: number;
  /** farthest distance of a computed pole from the placed one, rad/s; left out where the method chose its own poles */
  pole_error?: number;
  /**
   * how far rounding may have moved the poles told, and so their error, rad/s; left out where the method chose its own
   * poles
   */
  pole_error_bound?: number;
  /**
   * condition number of the eigenvectors of A − BK: how sensitive the poles are, at best 1; left out where there are
   * too few eigenvectors
   */
  eigenvector_condition?: number;
  /** p×n, rows are inputs */
  K: number[][];
  /** p×q, the method's own integral action */
  integral?: number[][];
  /** n×n, x̄ = Tx */
  T?: number[][];
  /** p×p */
  Q?: number[][];
  /** one per input */
  controllability_indices?: number[];
  groups?: Group[];
  closed_loop_poles: Complex[];
  findings: Finding[];
}

/** A block of the closed loop: whose chains form it, and which poles it gets; positions from 0. */
export interface PoleGroup {
  /** positions from 0 */
  inputs: number[];
  /** positions from 0 */
  poles: number[];
}

/** The design that was sent. */
export interface PresentDesign {
  figures: FoundFigure[];
  required: FoundRequirement[];
  stable: boolean;
  met: boolean;
}

/** A rig with its source and everything that a design may change. */
export interface Preset {
  /** structure of the closed loop */
  coupling: 'triangular' | 'input-diagonal' | 'axis-decoupled';
  /** axis that leads where the coupling is triangular */
  lead: 'pitch' | 'yaw';
  /** shift c of Luenberger's basis, q₁ → q₁ + c q₂ (yaw leading: q₂ → q₂ + c q₁); the structure's own where left out */
  shift?: number;
  /** pi: two PI loops (Fig. 3); none: inner loop alone (Fig. 2) */
  outer: 'pi' | 'none';
  /** which error drives which motor */
  pairing: 'diagonal' | 'cross';
  /** static decoupler Ĝ(0)⁻¹ diag(|ĝ|) between the PI controllers and the motors */
  decoupler: boolean;
  /** the rotors' speeds are states of the model that is placed: full rank on six states, K is 2×6 */
  place_rotors: boolean;
  name: string;
  title: string;
  source: string;
  rig: 'helicopter' | 'aero';
  /** SI units, see `parameter_info` */
  parameters: Record<string, number>;
  parameter_info: Record<string, ParameterInfo>;
  /** in the units of `component_info` */
  components: Record<string, number>;
  component_info: Record<string, ComponentInfo>;
  limits: Limits;
  limit_info: Record<string, ParameterInfo>;
  /** counts per revolution */
  encoders: Record<string, number>;
  /** theta, rad */
  operating_point: Record<string, number>;
  poles: Complex[];
  loops: Loops;
  rotors: RotorPair;
  friction: FrictionPair;
  rotor_poles: Complex[];
  weights: Weights;
  scenario: Scenario;
}

/** A recording as it was read; `id` is kept for half an hour after its last use. */
export interface Preview {
  id: string;
  name: string;
  columns: string[];
  /** of numbers */
  rows: number;
  /** line of the file where they begin */
  first_row: number;
  /** the first rows, in the file's own units */
  preview: (number | null)[][];
  guess: Guess;
  /** of columns, where rows or cells of the file state them */
  units: Record<string, string>;
  /** of text; null of other files */
  dialect: Dialect | null;
  /** what was left out or read in a special way */
  findings: Finding[];
}

/** A printed number: from the printed formula, corrected, on the default rig; digits that agree. */
export interface PrintedNumber {
  where: string;
  name: string;
  printed: string;
  unit: string;
  printed_unit?: string;
  formula: string;
  /** by the printed formula, in `unit` */
  recomputed?: number;
  /** by the right formula, in `unit` */
  corrected?: number;
  /** on the default rig, in `unit` */
  on_rig?: number;
  /** significant digits that agree */
  digits?: number;
  /** significant digits printed */
  digits_printed: number;
  verdict: string;
  note: string;
}

/** What every error reply holds (RFC 9457), with code, field, value and hint added. */
export interface Problem {
  /** identifies the kind of problem */
  type: string;
  title: string;
  /** HTTP status */
  status: number;
  /** what is wrong, in words */
  detail: string;
  /** stable name for programs */
  code: string;
  /** JSON path of the offending input */
  field?: string;
  /** the offending value */
  value?: unknown;
  /** what to do */
  hint?: string;
  /** of the request, where the server failed: its log tells more */
  request_id?: string;
}

/** What is computed, what the right and the printed form give, what the two are called, whether it holds. */
export interface Proof {
  statement: string;
  correct: Evidence;
  printed: Evidence;
  holds: boolean;
  labels: string[];
}

/** The diagonal of Q. */
export interface ProposedQ {
  /** on Q's diagonal, 1/rad² */
  theta: number;
  /** on Q's diagonal, 1/rad² */
  psi: number;
  /** on Q's diagonal, s²/rad² */
  theta_dot: number;
  /** on Q's diagonal, s²/rad² */
  psi_dot: number;
}

/** The diagonal of Q_z. */
export interface ProposedQz {
  /** on the integral of this error, 1/(rad·s)² */
  theta: number;
  /** on the integral of this error, 1/(rad·s)² */
  psi: number;
}

/** The diagonal of R. */
export interface ProposedR {
  /** on R's diagonal, 1/V² */
  V_p: number;
  /** on R's diagonal, 1/V² */
  V_y: number;
}

/** A question, as the head of a column. */
export interface QuestionHead {
  name: string;
  kind: string;
  text: string;
  /** points there are */
  points: number;
  by_hand: boolean;
}

/** How far the inputs reach, or what the outputs tell. */
export interface Reached {
  /** per input the controllability index, per output the observability index */
  indices: number[];
  /** dimension of what is reached */
  reached: number;
  /** modes that are not, rad/s */
  lost: Complex[];
  /** the mode that is hardest to reach, rad/s */
  nearest: Complex;
  /** there the smallest singular value of [sI − A, B], in units of its own */
  distance: number;
}

/** Reference angles after t = 0, absolute. */
export interface Reference {
  /** pitch reference, rad; at rest at the operating point (θ₀, 0) where left out */
  theta?: number | null;
  /** yaw reference, rad; at rest at the operating point (θ₀, 0) where left out */
  psi?: number | null;
}

/** What is asked of the rig's steps, each axis alone, and of its loop. */
export interface Required {
  /** settling time, at most, s */
  settling?: number | null;
  /** overshoot, at most, % */
  overshoot?: number | null;
  /** lag margin, at least, s */
  lag?: number | null;
}

/** Limits of one figure, on the nominal rig and on a share of uncertain ones. */
export interface RequiredFigure {
  /** the axis that is stepped; both, the worse one, where left out */
  axis?: 'theta' | 'psi' | 'both' | null;
  /** the motor; both, the worse one, where left out */
  motor?: 'V_p' | 'V_y' | 'both' | null;
  /** of the response; nonlinear where left out */
  model?: 'linear' | 'nonlinear' | null;
  /** alone, each axis by itself, where left out; together, the scenario as it is set */
  steps?: 'alone' | 'together' | null;
  /** at most, in the figure's unit */
  max?: number | null;
  /** at least, in the figure's unit */
  min?: number | null;
  /** least share of the uncertain rigs that meet them, beside the nominal one */
  share?: number | null;
}

/** One requirement, and how the design stands to it. */
export interface RequirementTold {
  /** the figure and its response */
  words: string;
  /** as it is shown */
  limit: string;
  now: FigureOfMove;
}

/** As a step request, and what the reply shall hold besides. */
export interface ResponseRequest extends StepRequest {
  /** also reply the rates, and the integrals of the errors */
  states?: boolean;
}

/** RGA at s = 0, rows θ, ψ, columns V_p, V_y; left out without steady state. */
export interface Rga {
  /** RGA at s = 0; rows θ, ψ, columns V_p, V_y */
  rga?: number[][];
  pairing?: string[][];
  reason?: string;
  /** index of the diagonal pairing */
  niederlinski?: number;
  /** index of the cross pairing */
  niederlinski_cross?: number;
  dominance?: Dominance;
  /** rad/s */
  frequencies?: number[];
  /** |RGA(jω)|, 2×2 per frequency */
  rga_magnitude?: number[][][];
  findings: Finding[];
}

/** A design, and frequencies at which |RGA(jω)| is wanted. */
export interface RgaRequest extends DesignRequest {
  /** rad/s */
  frequencies?: number[];
}

/** After `done` of `samples` rigs; poles of the whole loop of the first of them, rad/s. */
export interface RobustnessReply {
  /** rigs so far */
  done: number;
  /** rigs in all */
  samples: number;
  loop_poles: Complex[][];
  /** s */
  t: number[];
  /** %, of `envelopes` */
  percentiles: number[];
  envelopes: Envelope;
  /** 0 to 1 */
  share_stable: number;
  /** 0 to 1 */
  share_within_limits: number;
}

/** A design, an experiment, and how far the rigs may differ from the nominal one. */
export interface RobustnessRequest extends StepRequest {
  /** of the parameters */
  distribution?: 'uniform' | 'normal';
  /** how many rigs */
  samples?: number;
  /** of the random rigs */
  seed?: number;
  /** relative, per parameter and per rotor's lag; by default 0.1 for all parameters but g */
  uncertainty?: Record<string, number> | null;
}

/** The poles of a quadratic method as R is multiplied by ρ; LQR's where the request's method has no weights. */
export interface RootLocus {
  /** factor on R, from large to small; 1 in the middle */
  rho: number[];
  /** per pole its course over `rho`, rad/s */
  poles: Complex[][];
}

/** One motor's rotor. */
export interface Rotor {
  /** time constant of the rotor's speed; 0, and what is below 1 µs, follows at once, s */
  tau: number;
  /** thrust by rotor speed: linear, or quadratic beyond the dead zone */
  curve: 'linear' | 'quadratic';
  /** speed, as a voltage, up to which a quadratic curve gives no thrust, V */
  dead_zone: number;
  /**
   * where a quadratic curve meets the linear one, V; the trim voltage where left out, or the limit of a motor that
   * rests at the trim
   */
  matched_at?: number;
}

/** One motor's rotor: how long it takes, and how thrust follows its speed. */
export interface RotorChanges {
  /** time constant of the rotor's speed; 0, and what is below 1 µs, follows at once, s */
  tau?: number | null;
  /** thrust by rotor speed: linear, or quadratic beyond the dead zone */
  curve?: 'linear' | 'quadratic' | null;
  /** speed, as a voltage, up to which a quadratic curve gives no thrust, V */
  dead_zone?: number | null;
  /**
   * where a quadratic curve meets the linear one, V; the trim voltage where left out, or the limit of a motor that
   * rests at the trim
   */
  matched_at?: number | null;
}

/** Both motors' rotors. */
export interface RotorPair {
  pitch: Rotor;
  yaw: Rotor;
}

/** Six states in numbers, as model=rotors names them; without K where there is none. */
export interface RotorSteps {
  /** whether the design itself places the rotors */
  placed: boolean;
  /** axes whose rotor has no lag in the design, and the usual one here */
  assumed: string[];
  /** letters and groups of the formulas, SI */
  names: Record<string, number>;
  /** p₅ and p₆, rad/s */
  rotor_poles: number[];
  /** 6×6, SI */
  A?: number[][];
  /** 6×2, SI */
  B?: number[][];
  /** 2×6, by the design's method */
  K?: number[][];
  /** of A − BK, rad/s */
  poles?: Complex[];
  /** why there is no K */
  refused?: string;
}

/**
 * The rotors' speeds, as the voltages that would hold them, V; left out where they follow at once.
 *
 * Linear: deviations from the trim.
 */
export interface Rotors {
  /** pitch motor's rotor, V */
  v_p: number[];
  /** yaw motor's rotor, V */
  v_y: number[];
}

/** The rotors of the pitch and the yaw motor. */
export interface RotorsChanges {
  pitch?: RotorChanges;
  yaw?: RotorChanges;
}

/** A design whose digital rig is to be recorded while its references step. */
export interface SampleRequest extends StepRequest {
  /** of the recording, s */
  length?: number;
  /** largest deviation of the recorded rig's parameters, relative */
  deviation?: number;
  /** standard deviation on the angles, rad */
  noise?: number;
  /** of steps, deviations and noise */
  seed?: number;
}

/** A preset's own experiment. */
export interface Scenario {
  /** length of the experiment, s */
  duration: number;
  /** number of times, both ends among them */
  samples: number;
  reference: Angles;
}

/** An experiment: references step at t = 0; without a reference the preset's own is used. */
export interface ScenarioChanges {
  /** length of the experiment, s */
  duration?: number | null;
  /** number of times, both ends among them */
  samples?: number | null;
  /** the voltages are limited */
  saturation?: boolean;
  /** what the PI integrators do at a limit */
  anti_windup?: 'none' | 'clamping' | 'back-calculation';
  /**
   * of back-calculation: how fast the integrals follow what the limits leave, s; each loop's integral time where left
   * out
   */
  tracking_time?: number | null;
  /** pitch is stopped at its limit, without rebound */
  travel_stops?: boolean;
  /** the trim voltages are added, so that the rig starts at rest */
  trim_feedforward?: boolean;
  /** tolerance of the nonlinear integration, relative and (rad, rad/s) absolute */
  rtol?: number;
  /**
   * what the state feedback acts on: the states (a digital controller: as its `rates` say), angles with filtered rates,
   * or an observer's estimate
   */
  measured?: 'states' | 'filtered' | 'observer';
  /** ignored by evaluate, which computes both */
  model?: 'linear' | 'nonlinear';
  reference?: Reference | null;
  initial?: Initial;
  noise?: AngleNoise;
  /** nonlinear model; null is continuous */
  digital?: DigitalController | null;
  /** nonlinear model */
  disturbance?: InputDisturbance | null;
}

/** Sensitivity peak and disk margin at both motors at once, rad/s; what the disk margin guarantees. */
export interface Sensitivity {
  /**
   * largest singular value of S(jω) over all frequencies, at the motors: its inverse is the distance to instability
   * under an additive change of the loop
   */
  peak: number;
  /** where the sensitivity peaks, rad/s; left out where it is approached at infinity alone */
  peak_frequency?: number;
  /**
   * size α of the disks of gain and phase changes, at both motors at once and independent of each other, that the loop
   * tolerates
   */
  disk_margin: number;
  /** where the disk margin is reached, rad/s; left out where it is approached at infinity alone */
  disk_frequency?: number;
  /** lowest factor on both gains that is borne */
  gain_low: number;
  /** highest factor on both gains that is borne; left out where unlimited */
  gain_high?: number;
  /** change of phase at both motors that is borne, ±, rad */
  phase: number;
}

/** Of the encoders, 1 or −1. */
export interface Signs {
  /** of pitch's */
  theta?: -1 | 1;
  /** of yaw's */
  psi?: -1 | 1;
}

/** The rotors' speeds, as the voltages that would hold them. */
export interface SpeedsCourse {
  /** V */
  v_p: number[];
  /** V */
  v_y: number[];
}

/** One way to deal the poles: positions of pitch's pair and of yaw's, and what it gives. */
export interface Split {
  /** positions from 0 of pitch's pair and of yaw's */
  split: number[][];
  poles: Complex[];
  /** V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y */
  K: number[][];
  /** Frobenius norm of K: the size of all its gains */
  norm: number;
  /** farthest distance of a computed pole from the placed one, rad/s */
  pole_error: number;
  /** RGA at s = 0; rows θ, ψ, columns V_p, V_y */
  rga?: number[][];
}

/** The diagonal of Q. */
export interface StateWeights {
  /** on Q's diagonal, 1/rad² */
  theta?: number | null;
  /** on Q's diagonal, 1/rad² */
  psi?: number | null;
  /** on Q's diagonal, s²/rad² */
  theta_dot?: number | null;
  /** on Q's diagonal, s²/rad² */
  psi_dot?: number | null;
}

/** What the outputs do not show; the integrals are left out where nothing integrates. */
export interface States {
  /** rad/s */
  theta_dot: number[];
  /** rad/s */
  psi_dot: number[];
  /** integral of the pitch error, rad·s */
  z_p?: number[];
  /** integral of the yaw error, rad·s */
  z_y?: number[];
  /**
   * states of what estimates, a row each, in deviations from the trim: an observer's theta, psi, theta_dot, psi_dot
   * and, where the rotors are placed, v_p, v_y; or filters' angles and rates by frequency
   */
  w?: number[][];
}

/**
 * A step response; s, rad, V. Linear voltages are deviations from the trim.
 *
 * `states` are there where they are asked for.
 */
export interface Step {
  /**
   * least time constant of both rotors alike at which the loop is no longer stable; where the rotors are placed, above
   * their own, s; left out where unlimited, and where the loop is not stable
   */
  lag_margin?: number;
  /** s */
  t: number[];
  /** pitch, absolute, rad */
  theta: number[];
  /** yaw, absolute, rad */
  psi: number[];
  /** pitch motor, V */
  V_p: number[];
  /** yaw motor, V */
  V_y: number[];
  states?: States;
  rotors?: Rotors;
  reference: Angles;
  trim: Voltages;
  metrics: Metrics;
  loop_poles: Complex[];
  observer?: ObserverGains;
  stable: boolean;
  findings: Finding[];
}

/** A step, as the head of columns. */
export interface StepHead {
  name: string;
  title: string;
  /** points there are */
  points: number;
  goals: GoalHead[];
  questions: QuestionHead[];
}

/** What is kept of a student's step. */
export interface StepKept {
  /** how many there were */
  attempts: number;
  /** those that were taken, 1-based */
  hints: number[];
  hand: HandMarked[];
  /** of the newest draft or attempt */
  design?: Record<string, unknown>;
  answers?: Record<string, unknown>;
  at?: string;
  /** of the newest draft */
  seq?: number;
  best?: Best;
}

/** A design and an experiment. */
export interface StepRequest extends DesignRequest {
  scenario?: ScenarioChanges;
}

/** A student's step on the wall. */
export interface StepTold {
  /** points given, by hand too */
  points: number;
  /** points there are */
  of: number;
  /** of the best attempt */
  goals: (boolean | null)[];
  /** of the newest one */
  last?: (boolean | null)[];
  /** how many */
  attempts: number;
  /** how many were taken */
  hints: number;
  /** answers in words that nobody has marked */
  to_mark: number;
}

/** Everything of one student, for the instructor. */
export interface StudentReply {
  /** within this server */
  id: number;
  /** by order of joining */
  number: number;
  name: string;
  email?: string;
  login?: string;
  joined: string;
  last_seen: string;
  /** the server's time */
  at: string;
  /** points given */
  points: number;
  /** points there are */
  of: number;
  steps: Record<string, Told>;
}

/** A student on the wall. */
export interface StudentRow {
  /** within this server */
  id: number;
  /** by order of joining */
  number: number;
  name: string;
  email?: string;
  login?: string;
  /** where they are */
  step?: string;
  /** points given */
  points: number;
  /** points there are */
  of: number;
  joined: string;
  last_seen: string;
  online: boolean;
  stable?: boolean;
  poles?: Complex[];
  steps: Record<string, StepTold>;
}

/** PI values and the whole loop's poles with them. */
export interface Suggestion {
  loops: Loops;
  loop_poles: Complex[];
  stable: boolean;
  rule: string;
}

/** A symbol of the formulas. */
export interface Symbol {
  name: string;
  latex: string;
  mathml: string;
  meaning: string;
  unit: string;
}

/** All formulas of one structure of the paper's four states. */
export interface Symbolic {
  A: Formula;
  /** of the canonical form; of (Aᵀ, Cᵀ) for L */
  T: Formula;
  Q: Formula;
  entries: Record<string, Record<string, Formula>>;
  /** in an order in which each stands on those before it */
  definitions: Record<string, Formula>;
  /** one per input; of (Aᵀ, Cᵀ) for L */
  controllability_indices: number[];
  symbols: Symbol[];
  B: Formula;
  controllability_matrix: Formula;
  A_bar: Formula;
  B_bar: Formula;
  K_bar: Formula;
  /** V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y */
  K: Formula;
  closed_loop: Formula;
  canonical_closed_loop: Formula;
  G: Formula;
  G_0: Formula;
  RGA: Formula;
  RGA_s: Formula;
}

/** what=L: the observer, whose gain is placed by duality; it is the same in both models. */
export interface SymbolicObserver {
  A: Formula;
  /** of the canonical form; of (Aᵀ, Cᵀ) for L */
  T: Formula;
  Q: Formula;
  entries: Record<string, Record<string, Formula>>;
  /** in an order in which each stands on those before it */
  definitions: Record<string, Formula>;
  /** one per input; of (Aᵀ, Cᵀ) for L */
  controllability_indices: number[];
  symbols: Symbol[];
  /** the estimate's rate */
  observer: Formula;
  /** matrix of the loop in [x, x − x̂] */
  separation: Formula;
  C: Formula;
  /** 1/s, and 1/s² below, columns θ, ψ; rows θ, ψ, θ̇, ψ̇ */
  L: Formula;
}

/** Any system ẋ = Ax + Bu of up to six states, row by row; nothing in it is ever run as code. */
export interface SymbolicPlaceRequest {
  /** n×n, row by row */
  A: (string | number)[][];
  /** n×p, row by row */
  B: (string | number)[][];
  /** n, complex ones with their conjugates; or symbols: p_1 … p_n */
  poles?: 'symbols' | (number | { re: number; im: number })[];
  /** by default in the order of the poles */
  groups?: PoleGroup[] | null;
}

/** K of u = −Kx + v in formulas, and where they hold. */
export interface SymbolicPlacementReply {
  A: Formula;
  B: Formula;
  /** n×n, x̄ = Tx */
  T: Formula;
  /** p×p, the nonzero rows of TB */
  Q: Formula;
  /** p×n, rows are inputs */
  K: Formula;
  /** A − BK */
  closed_loop: Formula;
  /** one per input, for letters in general position */
  controllability_indices: number[];
  groups: Group[];
  /** what must not be 0: where it is, an entry divides by 0 or the indices are others */
  holds_unless: Formula[];
  /** by its name the letter as the formulas have it: gamma_, where SymPy has a meaning for gamma */
  letters: Record<string, Formula>;
  findings: Finding[];
}

/** model=rotors: six states, with both rotors' speeds, and the K that places all of them. */
export interface SymbolicRotors {
  A: Formula;
  /** of the canonical form; of (Aᵀ, Cᵀ) for L */
  T: Formula;
  Q: Formula;
  entries: Record<string, Record<string, Formula>>;
  /** in an order in which each stands on those before it */
  definitions: Record<string, Formula>;
  /** one per input; of (Aᵀ, Cᵀ) for L */
  controllability_indices: number[];
  symbols: Symbol[];
  /** τ_p v̇_p = V_p − v_p */
  lag_pitch: Formula;
  lag_yaw: Formula;
  /** φ(v_j) of a quadratic curve with a dead zone */
  thrust: Formula;
  /** φ′(v_j) beyond the dead zone */
  slope: Formula;
  B: Formula;
  /** V/rad, V·s/rad and V/V, columns θ, ψ, θ̇, ψ̇, v_p, v_y; rows V_p, V_y */
  K: Formula;
}

/** What can be said of a system before anything is designed. */
export interface SystemAnalysis {
  /** eigenvalues of A, rad/s */
  poles: Complex[];
  /** invariant zeros, rad/s; none are told without C */
  zeros: Complex[];
  stable: boolean;
  inputs: Reached;
  /** left out without C */
  outputs?: Reached;
  /** n×n, x̄ = Tx */
  T?: number[][];
  /** p×p, the nonzero rows of TB */
  Q?: number[][];
  /** n×n, columns of the controllability matrix, [b₁ … A^(σ₁−1)b₁ | b₂ …] */
  M?: number[][];
  /** Ĝ(0), q×p */
  dc_gain?: number[][];
  /** at ω = 0, q×p */
  rga?: number[][];
  /** index of the diagonal pairing */
  niederlinski?: number;
}

/** Frequency responses as gain and phase, rad; per output (or loop), per input (or reference). */
export interface SystemBode {
  /** rad/s */
  frequencies: number[];
  /** gain and phase of Ĝ(jω) */
  plant: Record<string, number[][][]>;
  /** of each input's loop opened there, the others closed; −1 is critical */
  loops: Record<string, number[][]>;
  /** from references to outputs */
  closed: Record<string, number[][][]>;
  /** |RGA(jω)| of the plant, per output, per input */
  rga?: number[][][];
}

/** Responses over time, s; exact at every sample. */
export interface SystemCourses {
  /** s */
  t: number[];
  /** per reference every output; each reference steps by 1 */
  step_y: number[][][];
  /** per reference every input */
  step_u: number[][][];
  /** every state from x(0), the references 0 */
  initial_x: number[][];
  /** the outputs meanwhile */
  initial_y: number[][];
  /** the inputs meanwhile */
  initial_u: number[][];
  /** with an observer, which begins at 0, every estimate */
  estimate?: number[][];
  /** where the states begin */
  x0: number[];
}

/** The state feedback of a system, and what it does. */
export interface SystemDesign {
  /** p×n, u = −Kx + F r */
  K: number[][];
  /** p×q, of the integrated errors */
  K_z?: number[][];
  /** p×m, how the references enter */
  F: number[][];
  /** static, pseudo-inverse, integral or inputs: what F is */
  scaling: string;
  /** the same in a sentence */
  reason: string;
  /** of the closed loop without the observer, rad/s */
  poles: Complex[];
  /** largest distance to those asked for, rad/s */
  pole_error?: number;
  /** Frobenius norm of K */
  norm: number;
  /** κ₂ of the eigenvectors of A − BK */
  eigenvector_condition?: number;
  observer?: SystemObserver;
  courses: SystemCourses;
  bode: SystemBode;
  findings: Finding[];
}

/** A system, the poles it shall have, and the experiment on it. */
export interface SystemDesignRequest {
  /** n×n, row by row */
  A: number[][];
  /** n×p, row by row */
  B: number[][];
  /** q×n; all states are outputs where it is left out */
  C?: number[][] | null;
  /** q×p; 0 where it is left out */
  D?: number[][] | null;
  /** n, in the unit of A; complex ones with their conjugates */
  poles: (number | { re: number; im: number })[];
  method?: 'full-rank' | 'tits-yang' | 'knv0' | 'varga' | 'ackermann' | 'bass-gura' | 'lqr' | 'lqr-integral';
  /** n; no observer where left out */
  observer_poles?: (number | { re: number; im: number })[] | null;
  /** of the quadratic methods */
  weights?: SystemWeights;
  /** initial state, n; 1 for the first state where left out */
  x0?: number[] | null;
  /** of the responses, s */
  duration?: number | null;
  /** whether poles are told exactly where floats do not tell them, which takes longer */
  exactly?: boolean;
}

/** A system of a textbook, to be pasted. */
export interface SystemExample {
  name: string;
  title: string;
  source: string;
  text: string;
  method: string;
  /** of a quadratic method */
  weights?: Record<string, number[]>;
}

/** K and L in closed form. */
export interface SystemFormulas {
  K: Formula;
  /** as k_11, row by row */
  K_entries: Record<string, Formula>;
  T: Formula;
  Q: Formula;
  /** A − BK */
  closed_loop: Formula;
  /** one per input */
  controllability_indices: number[];
  /** what must not be 0 */
  holds_unless: Formula[];
  /** in the observer's poles q_1 … q_n */
  L?: Formula;
  L_entries?: Record<string, Formula>;
  /** one per output */
  observability_indices?: number[];
  observer_holds_unless?: Formula[];
  /** why there is no L, though C is given */
  reason?: string;
}

/** Any system of up to six states, in expressions; nothing in it is ever run as code. */
export interface SystemFormulasRequest {
  /** n×n, row by row */
  A: (string | number)[][];
  /** n×p, row by row */
  B: (string | number)[][];
  /** q×n, for the observer's gain */
  C?: (string | number)[][] | null;
}

/** A matrix as it was typed, as a formula, and in numbers. */
export interface SystemMatrix {
  rows: string[][];
  latex: string;
  mathml: string;
  /** row by row */
  values: number[][];
}

/** x̂' = Ax̂ + Bu + L (y − Cx̂ − Du). */
export interface SystemObserver {
  /** n×q */
  L: number[][];
  /** of A − LC, rad/s */
  poles: Complex[];
  /** largest distance to those asked for, rad/s */
  pole_error: number;
  /** Frobenius norm of L */
  norm: number;
}

/** A system as it was read, and what can be said of it. */
export interface SystemRead {
  /** A, B, and C and D where they are given */
  matrices: Record<string, SystemMatrix>;
  /** value of each letter; 1 where it has none */
  letters: Record<string, number>;
  /** letters without a value */
  missing: string[];
  /** desired ones, where the text has some */
  poles?: Complex[];
  observer_poles?: Complex[];
  analysis: SystemAnalysis;
  findings: Finding[];
}

/** A system as it is pasted from MATLAB, Python or a page of text; nothing in it is ever run as code. */
export interface SystemText {
  /** A = …, B = …, and C, D, letters' values, desired poles where they are given */
  text: string;
}

/** Diagonals of Q, R and of the integrals' weight; ones where left out. */
export interface SystemWeights {
  /** of Q, n */
  states?: number[] | null;
  /** of R, p */
  inputs?: number[] | null;
  /** of the integrated errors, one per row of C */
  integrals?: number[] | null;
}

/** A symbol of the formulas; `chapters` are those where it means this, none: all. */
export interface Term {
  name: string;
  latex: string;
  mathml: string;
  meaning: string;
  unit: string;
  chapters: string[];
}

/** A reply's part that the lab's own format describes further (docs/labs.md). */
export interface Told {
}

/** A figure that is told of every design. */
export interface ToldFigure {
  measure: string;
  axis?: 'theta' | 'psi' | 'both';
  motor?: 'V_p' | 'V_y' | 'both';
  model?: 'linear' | 'nonlinear';
  steps?: 'alone' | 'together';
  title: string;
  /** empty of ratios and shares, 0 to 1 */
  unit: string;
  better: 'lower' | 'higher' | 'none';
  minimized: boolean;
}

/** A requirement. */
export interface ToldRequirement {
  /** its place among the figures */
  figure: number;
  /** at most, in the figure's unit */
  max?: number;
  /** at least, in the figure's unit */
  min?: number;
  /** least share of the uncertain rigs, 0 to 1 */
  share?: number;
  words: string;
  limit: string;
}

/** Which number is swept, over what, and what is found along it. */
export interface TrackOptions {
  /**
   * of a number in a request, such as loops.pitch.kp, rotors.pitch.tau, parameters.m, operating_point.theta; or gain,
   * gain.pitch, gain.yaw (factor on the motors' voltages: 0 opens the loop, 1 is the design), poles.0 to poles.3,
   * pitch-pair.re, .im, .frequency, .damping (yaw-pair alike), poles.factor, rotors.tau (both)
   */
  path?:
    | 'gain'
    | 'gain.pitch'
    | 'gain.yaw'
    | 'poles.0'
    | 'poles.1'
    | 'poles.2'
    | 'poles.3'
    | 'pitch-pair.re'
    | 'pitch-pair.im'
    | 'pitch-pair.frequency'
    | 'pitch-pair.damping'
    | 'yaw-pair.re'
    | 'yaw-pair.im'
    | 'yaw-pair.frequency'
    | 'yaw-pair.damping'
    | 'poles.factor'
    | 'rotor_poles.0'
    | 'rotor_poles.1'
    | 'rotors.tau'
    | 'operating_point.theta'
    | 'parameters.K_pp'
    | 'parameters.K_py'
    | 'parameters.K_yp'
    | 'parameters.K_yy'
    | 'parameters.J_p'
    | 'parameters.J_y'
    | 'parameters.m'
    | 'parameters.l'
    | 'parameters.B_p'
    | 'parameters.B_y'
    | 'parameters.K_s'
    | 'parameters.g'
    | 'limits.V_p'
    | 'limits.V_y'
    | 'limits.theta'
    | 'shift'
    | 'loops.pitch.kp'
    | 'loops.pitch.ti'
    | 'loops.yaw.kp'
    | 'loops.yaw.ti'
    | 'rotors.pitch.tau'
    | 'rotors.pitch.dead_zone'
    | 'rotors.pitch.matched_at'
    | 'rotors.yaw.tau'
    | 'rotors.yaw.dead_zone'
    | 'rotors.yaw.matched_at'
    | 'friction.pitch.coulomb'
    | 'friction.pitch.static'
    | 'friction.yaw.coulomb'
    | 'friction.yaw.static'
    | 'observer.voltage_noise'
    | 'observer.angle_noise'
    | 'weights.states.theta'
    | 'weights.states.psi'
    | 'weights.states.theta_dot'
    | 'weights.states.psi_dot'
    | 'weights.inputs.V_p'
    | 'weights.inputs.V_y'
    | 'weights.integrals.theta'
    | 'weights.integrals.psi'
    | 'scenario.duration'
    | 'scenario.tracking_time'
    | 'scenario.rtol'
    | 'scenario.reference.theta'
    | 'scenario.reference.psi'
    | 'scenario.initial.theta'
    | 'scenario.initial.psi'
    | 'scenario.initial.theta_dot'
    | 'scenario.initial.psi_dot'
    | 'scenario.noise.theta'
    | 'scenario.noise.psi'
    | 'scenario.digital.sample_time'
    | 'scenario.digital.noise'
    | 'scenario.disturbance.V_p'
    | 'scenario.disturbance.V_y'
    | 'scenario.disturbance.time';
  /** lowest and highest value, in the number's unit; by default around its present one */
  over?: [number, number] | null;
  /** values asked for; more are added where poles move fast or meet */
  points?: number;
  /** even steps, or equal factors */
  scale?: 'linear' | 'log';
  /** the gains stay and only the rig changes; else each value has a design of its own */
  kept?: boolean;
  /** figures that are found at each value */
  measures?: TrackedFigure[];
}

/** Poles of the whole loop and figures over one number. */
export interface TrackReply {
  path: string;
  meaning: string;
  unit: string;
  symbol?: string;
  /** the design's own value; left out where it has none */
  now?: number;
  /** least value that the number may have */
  low?: number;
  /** largest one */
  high?: number;
  /** z where sample times are swept: s = ln z/Ts */
  plane: 's' | 'z';
  /** ascending, those of which there is a loop */
  values: number[];
  /** positions in `values` at which a stretch without gaps begins */
  starts: number[];
  /** per pole its course over `values`, rad/s or in the z-plane */
  poles: Complex[][];
  /** one per value */
  stable: boolean[];
  /** whether it is not stable, but no pole lies beyond the border of stability either: some lie on it */
  on_border: boolean[];
  /** of the border of stability, by value */
  crossings: Crossed[];
  /** where branches end as a gain grows without limit, rad/s */
  zeros: Complex[];
  /** in the order of the request's measures */
  figures: FigureTrack[];
}

/** A design with its experiment, and the number that is swept. */
export interface TrackRequest extends StepRequest {
  track?: TrackOptions;
}

/** A figure of merit, and of which response. */
export interface TrackedFigure {
  /** the axis that is stepped; both, the worse one, where left out */
  axis?: 'theta' | 'psi' | 'both' | null;
  /** the motor; both, the worse one, where left out */
  motor?: 'V_p' | 'V_y' | 'both' | null;
  /** of the response; nonlinear where left out */
  model?: 'linear' | 'nonlinear' | null;
  /** alone, each axis by itself, where left out; together, the scenario as it is set */
  steps?: 'alone' | 'together' | null;
  measure:
    | 'rise_time'
    | 'settling_time'
    | 'overshoot'
    | 'undershoot'
    | 'peak'
    | 'peak_time'
    | 'steady_state_error'
    | 'iae'
    | 'itae'
    | 'coupling_peak'
    | 'V_peak'
    | 'saturated'
    | 'effort'
    | 'gain_margin'
    | 'gain_reduction_margin'
    | 'phase_margin'
    | 'delay_margin'
    | 'sensitivity_peak'
    | 'sensitivity_peak_frequency'
    | 'disk_margin'
    | 'disk_frequency'
    | 'disk_gain_low'
    | 'disk_gain_high'
    | 'disk_phase'
    | 'lag_margin'
    | 'norm'
    | 'spectral_norm'
    | 'pole_error'
    | 'pole_error_bound'
    | 'eigenvector_condition'
    | 'lambda_11';
}

/** A formula in two notations. */
export interface Typeset {
  latex: string;
  mathml: string;
}

/** Why a method has no result here. */
export interface Unavailable {
  code: string;
  detail: string;
  hint?: string;
}

/** How far the rigs may differ from the nominal one, where other calls put designs on them. */
export interface UncertainRigs {
  /** of the parameters */
  distribution?: 'uniform' | 'normal';
  /** how many rigs */
  samples?: number;
  /** of the random rigs */
  seed?: number;
  /** relative, per parameter and per rotor's lag; by default 0.1 for all parameters but g */
  spread?: Record<string, number> | null;
}

/** Motor voltages, V. */
export interface Voltages {
  /** pitch motor, V */
  V_p: number;
  /** yaw motor, V */
  V_y: number;
}

/** V. */
export interface Volts {
  /** V */
  V_p: number[];
  /** V */
  V_y: number[];
}

/**
 * The derivation in numbers for one design: the paper's four states, then what follows.
 *
 * Another method than full-rank's has no coefficients, T, Q, A_bar, B_bar, K_bar and closed_loop_bar. G_0 and rga are
 * left out where a pole is 0.
 */
export interface Walkthrough {
  /** α, β₀, γ, a; SI */
  constants: Record<string, number>;
  /** 4×4, SI */
  A: number[][];
  /** 4×2, SI */
  B: number[][];
  /** V */
  trim: Record<string, number>;
  /** [B, AB, …], 4×8 */
  controllability_matrix: number[][];
  /** one per input */
  controllability_indices: number[];
  /** d₁₀, d₂₀ in 1/s², d₁₁, d₂₁ in 1/s */
  coefficients?: Record<string, number>;
  /** 4×4, x̄ = Tx */
  T?: number[][];
  /** 2×2 */
  Q?: number[][];
  /** T A T⁻¹ */
  A_bar?: number[][];
  /** T B */
  B_bar?: number[][];
  /** Q K T⁻¹ */
  K_bar?: number[][];
  /** V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y */
  K: number[][];
  /** the method's own integral action, V/(rad·s) */
  integral?: number[][];
  /** A − BK */
  closed_loop: number[][];
  /** T (A − BK) T⁻¹ */
  closed_loop_bar?: number[][];
  closed_loop_poles: Complex[];
  /** largest distance of a pole from the one asked for, rad/s */
  pole_error?: number;
  /** Ĝ(0), rad/V */
  G_0?: number[][];
  /** RGA at s = 0; rows θ, ψ, columns V_p, V_y */
  rga?: number[][];
  rotors: RotorSteps;
  /** left out where there is none */
  observer?: ObserverSteps;
}

/** Weights of the quadratic methods that differ from Bryson's rule for the preset's limits. */
export interface WeightChanges {
  states?: StateWeights;
  inputs?: InputWeights;
  integrals?: IntegralWeights;
}

/** Weights of the quadratic methods by Bryson's rule for this rig's limits. */
export interface Weights {
  states: ProposedQ;
  inputs: ProposedR;
  integrals: ProposedQz;
}

/** Of both axes. */
export interface WhitenessPair {
  theta: WhitenessReply;
  psi: WhitenessReply;
}

/** Correlations of the fitted residuals of one axis, 1, 2, … samples apart, and Ljung and Box's test of them. */
export interface WhitenessReply {
  /** whether nothing speaks against it */
  white: boolean;
  /** with which white residuals would be correlated as much */
  probability: number;
  /** shares of the residuals' power */
  correlations: number[];
  /** 99 % of those of white residuals lie within ± so much */
  band: number;
  /** over which they are correlated visibly, s */
  span: number;
}
