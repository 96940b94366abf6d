/**
 * Tasks in the air, and the figures of flights by which they are scored. Made of heli2dof_core/flight/tasks and of
 * heli2dof_core/figures by `python -m tests.page_flight_tasks`; not to be changed by hand.
 *
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {keyof typeof FLIGHT} Name  of a figure
 * @typedef {object} Task
 * @property {string} name
 * @property {string} title
 * @property {string} words  what is to be done
 * @property {number} duration  s
 * @property {[time: number, theta: number, psi: number][]} marks  what is asked: s, share of the reach from θ₀, rad
 * @property {Name} figure  by which stars are given
 * @property {Name[]} figures  that are told, it first
 * @property {[number, number, number]} stars  limits of one, two and three
 * @property {number} gusts
 * @property {number} strength  of their torques, as a share of what a motor's limit gives
 * @property {boolean} free  whether set points are the pilot's
 * @property {''|'landed'|'reached'} ends  how it is done before its time
 * @property {number} pilots
 * @property {boolean} per_square_volt  whether stars' limits are times V_p² + V_y² of the motors' limits
 */

/** What tasks and scores mean by near, at rest and later (flight/tasks/task.py). */
export const NEAR = {
  HIGHEST: 0.14,
  ROOM: 0.6,
  REACHED: 0.035,
  LANDED: 0.0175,
  AT_REST: 0.0175,
  RESTED: 1,
  EARLY: 1e-6,
  WITHIN: 0.0349065850398866,
};

/** @type {Task[]} */
export const TASKS = [
  {
    name: 'hold',
    title: 'Hold still',
    words: 'Keep pitch and yaw where they are while gusts come. Your design does it alone, or you do it by hand.',
    duration: 30,
    marks: [[0, 0, 0]],
    figure: 'path_error',
    figures: ['path_error', 'flight_error_rms', 'flight_error_max', 'time_within', 'flight_effort'],
    stars: [0.07, 0.025, 0.01],
    gusts: 9,
    strength: 0.12,
    free: false,
    ends: '',
    pilots: 1,
    per_square_volt: false,
  },
  {
    name: 'path',
    title: 'Follow the path',
    words: 'Follow the ghost with pitch and yaw, by set points or by the sticks.',
    duration: 40,
    marks: [
      [0, 0, 0],
      [3, 0, 0],
      [8, 1, 0.5235987755982988],
      [13, 0, 1.0471975511965976],
      [18, -0.6, 0.5235987755982988],
      [23, 0, 0],
      [28, 1, -0.5235987755982988],
      [33, 0, -0.7853981633974483],
      [38, 0, 0],
    ],
    figure: 'path_error',
    figures: ['path_error', 'flight_error_rms', 'flight_error_max', 'time_within', 'flight_effort'],
    stars: [0.14, 0.06, 0.03],
    gusts: 0,
    strength: 0,
    free: true,
    ends: '',
    pilots: 1,
    per_square_volt: false,
  },
  {
    name: 'land',
    title: 'Land on the mark',
    words: 'Bring it to the mark and rest there for a second, as soon as you can.',
    duration: 30,
    marks: [[0, 0.8, 1.0471975511965976]],
    figure: 'flight_time',
    figures: ['flight_time', 'landing_error', 'flight_impacts', 'flight_effort'],
    stars: [20, 8, 4],
    gusts: 0,
    strength: 0,
    free: true,
    ends: 'landed',
    pilots: 1,
    per_square_volt: false,
  },
  {
    name: 'effort',
    title: 'Least effort',
    words: 'Reach the marks one after the other. Each volt counts by its square and by how long it lasts.',
    duration: 40,
    marks: [
      [0, 0.8, 0.5235987755982988],
      [0, -0.5, -0.3490658503988659],
      [0, 0, 0],
    ],
    figure: 'flight_effort',
    figures: ['flight_effort', 'flight_time', 'flight_impacts'],
    stars: [2.5, 0.87, 0.56],
    gusts: 0,
    strength: 0,
    free: true,
    ends: 'reached',
    pilots: 1,
    per_square_volt: true,
  },
  {
    name: 'pair',
    title: 'One axis each',
    words: 'Two hands follow the path: one has pitch, the other has yaw.',
    duration: 40,
    marks: [
      [0, 0, 0],
      [3, 0, 0],
      [8, 1, 0.5235987755982988],
      [13, 0, 1.0471975511965976],
      [18, -0.6, 0.5235987755982988],
      [23, 0, 0],
      [28, 1, -0.5235987755982988],
      [33, 0, -0.7853981633974483],
      [38, 0, 0],
    ],
    figure: 'path_error',
    figures: ['path_error', 'flight_error_rms', 'flight_error_max', 'time_within'],
    stars: [0.14, 0.06, 0.03],
    gusts: 0,
    strength: 0,
    free: true,
    ends: '',
    pilots: 2,
    per_square_volt: false,
  },
];

/** Figures with a value per axis. */
export const BY_AXIS = ['flight_error_rms', 'flight_error_max'];

/**
 * @type {Record<'flight_error_rms' | 'flight_error_max' | 'path_error' | 'time_within' | 'flight_effort' |
 * 'flight_time' | 'landing_error' | 'flight_impacts' | 'by_hand', Figure>}
 */
export const FLIGHT = {
  flight_error_rms: {
    name: 'flight_error_rms',
    head: 'RMS error',
    short: 'RMS',
    hint: "root mean square, over the task's time, of what the angle differs from what the task asks",
    meaning: "Root mean square, over the task's time, of what the angle differs from what the task asks",
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
  },
  flight_error_max: {
    name: 'flight_error_max',
    head: 'Largest error',
    short: 'Largest',
    hint: 'largest difference of the angle from what the task asks',
    meaning: 'Largest difference of the angle from what the task asks',
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
  },
  path_error: {
    name: 'path_error',
    head: 'Path error',
    short: 'Path',
    hint: "root mean square, over the task's time, of the distance from what the task asks, both angles together",
    meaning: "Root mean square, over the task's time, of the distance from what the task asks, both angles together",
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
  },
  time_within: {
    name: 'time_within',
    head: 'Time within 2°',
    short: 'Within',
    hint: "share of the task's time in which both angles are within 2° of what it asks",
    meaning: "Share of the task's time in which both angles are within 2° of what it asks",
    digits: 0,
    scale: 100,
    after: ' %',
    better: 'higher',
  },
  flight_effort: {
    name: 'flight_effort',
    head: 'Effort',
    short: 'Effort',
    hint: "time integral of the squares of both motors' voltages",
    meaning: "Time integral of the squares of both motors' voltages",
    source: 'Dorf and Bishop, Modern Control Systems, 2017, section 5.7',
    digits: 0,
    after: ' V²s',
  },
  flight_time: {
    name: 'flight_time',
    head: 'Time',
    short: 'Time',
    hint: 'time until the last mark is reached, and rested at for 1 s where the task asks for it',
    meaning: 'Time until the last mark is reached, and rested at for 1 s where the task asks for it',
    notation: 'seconds',
    digits: 2,
  },
  landing_error: {
    name: 'landing_error',
    head: 'Landing error',
    short: 'Landing',
    hint: "larger of both angles' differences from the last mark, at the end",
    meaning: "Larger of both angles' differences from the last mark, at the end",
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
  },
  flight_impacts: {
    name: 'flight_impacts',
    head: 'Impacts',
    short: 'Impacts',
    hint: 'how often pitch met a stop of its travel',
    meaning: 'How often pitch met a stop of its travel',
    digits: 0,
  },
  by_hand: {
    name: 'by_hand',
    head: 'By hand',
    short: 'By hand',
    hint: "share of the time in which the sticks were the motors' voltages and the controller was off",
    meaning: "Share of the time in which the sticks were the motors' voltages and the controller was off",
    digits: 0,
    scale: 100,
    after: ' %',
    better: 'none',
  },
};
