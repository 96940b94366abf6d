/**
 * The shapes that travel through the page. Types only: nothing here runs.
 *
 * @typedef {{re: number, im: number}} Complex
 * @typedef {[Complex, Complex, Complex, Complex]} Poles  1 and 2 are pitch's pair, 3 and 4 yaw's
 * @typedef {{kp: number, ti: number}} Pi
 * @typedef {{pitch: Pi, yaw: Pi}} Loops
 * @typedef {{theta: number, psi: number}} Reference  step sizes, rad
 * @typedef {{V_p?: number, V_y?: number, theta?: number|null}} Limits  V, rad; null: free travel
 * @typedef {{meaning: string, unit: string, minimum: number, maximum: number}} Range
 * @typedef {'triangular'|'input-diagonal'|'axis-decoupled'} Coupling
 *
 * What the user chose, and all of it: everything else on the page follows from this.
 * @typedef {object} Design
 * @property {string} preset
 * @property {Record<string, number>} parameters  overrides of the preset's values
 * @property {Limits} limits  overrides of the preset's
 * @property {number} theta0  the pitch angle at which the rig rests and is linearized, rad
 * @property {Poles} poles
 * @property {string} method  a name of GET methods
 * @property {Coupling} coupling  full-rank's only, as is lead
 * @property {'pitch'|'yaw'} lead
 * @property {'pi'|'none'} outer
 * @property {'diagonal'|'cross'} pairing
 * @property {boolean} decoupler  whether Ĝ(0)⁻¹ stands between the PI loops and the motors
 * @property {Loops} loops
 * @property {Scenario} scenario
 *
 * An experiment, in the contract's names and units; what is absent is standard (see experiment.js).
 * @typedef {object} Scenario
 * @property {Reference} reference
 * @property {number} duration  s
 * @property {{theta?: number, psi?: number}} [initial]  rad, absolute; absent: at rest
 * @property {boolean} [saturation]
 * @property {'none'|'clamping'|'back-calculation'} [anti_windup]
 * @property {number} [tracking_time]  of back-calculation, s; absent: each loop's integral time
 * @property {boolean} [travel_stops]
 * @property {boolean} [trim_feedforward]
 * @property {number} [rtol]
 * @property {Digital} [digital]  absent: continuous
 * @property {Disturbance} [disturbance]
 * @typedef {{sample_time?: number, delay?: boolean, encoders?: Encoders, rates?: 'filtered'|'true', noise?: number,
 *   seed?: number}} Digital
 * @typedef {{V_p: number, V_y: number, time: number}} Disturbance  V, s
 * @typedef {{theta: number, psi: number}} Encoders  counts per revolution; 0: exact
 *
 * @typedef {object} Preset
 * @property {string} name
 * @property {string} title
 * @property {string} source
 * @property {string} rig
 * @property {Record<string, number>} parameters
 * @property {{V_p: number, V_y: number, theta?: number}} limits
 * @property {Record<string, Range>} [parameter_info]
 * @property {Record<string, Range>} [limit_info]
 * @property {Complex[]} poles
 * @property {Loops} loops
 * @property {{reference: Reference, duration: number}} scenario
 * @property {string} [coupling]
 * @property {'pitch'|'yaw'} [lead]
 * @property {string} [pairing]
 * @property {string} [outer]
 * @property {boolean} [decoupler]
 * @property {{theta: number}} [operating_point]
 * @property {Encoders} [encoders]
 *
 * @typedef {object} Method
 * @property {string} name
 * @property {string} title
 * @property {string} source
 * @property {boolean} places_poles
 * @property {boolean} integrates  whether it brings integral action, in place of the PI loops
 * @property {boolean} available
 * @property {string} [needs]  the package that it is computed with
 *
 * @typedef {{code: string, severity: 'info'|'warning'|'error', message: string}} Finding
 * @typedef {ArrayLike<number>} Series
 *
 * @typedef {import('./model/figures.js').AxisMetrics} AxisMetrics
 *
 * @typedef {object} Step
 * @property {Series} t
 * @property {Series} theta
 * @property {Series} psi
 * @property {Series} V_p
 * @property {Series} V_y
 * @property {Reference} reference
 * @property {{V_p: number, V_y: number}} trim
 * @property {Record<string, any>} metrics
 * @property {boolean} stable
 *
 * @typedef {{linear: Step, nonlinear: Step}} StepPair
 *
 * @typedef {object} Reply
 * @property {number} seq
 * @property {{K: number[][], A?: number[][], B?: number[][], closed_loop_poles: Complex[], pole_error?: number, norm:
 *   number}} gains
 * @property {Complex[]} open_loop_poles
 * @property {{rga?: number[][], pairing?: string[][], reason?: string, niederlinski?: number, niederlinski_cross?:
 *   number}} [rga]
 * @property {StepPair} step
 * @property {{theta?: StepPair, psi?: StepPair}} axis_steps
 * @property {Record<string, import('./model/figures.js').Margins>} [margins]
 * @property {import('./model/figures.js').Sensitivity} [sensitivity]
 * @property {Complex[]} loop_poles
 * @property {boolean} stable
 * @property {{V_p: number, V_y: number}} trim
 * @property {{V_p?: number, V_y?: number, theta?: number}} limits
 * @property {Finding[]} findings
 *
 * @typedef {{title?: string, detail?: string, code?: string, field?: string, value?: any, hint?: string, seq?: number}}
 *   Problem
 * @typedef {'theta'|'psi'|'both'} Motion
 * @typedef {'connecting'|'open'|'lost'} Connection
 *
 * @typedef {{theta: number[][], psi: number[][]}} Envelopes  a row per percentile
 * @typedef {{done: number, samples: number, loop_poles: Complex[][], t: number[], envelopes: Envelopes, share_stable:
 *   number, share_within_limits: number}} Cloud
 *
 * What the placed poles are held to; null: not asked. It is the yardstick, not the design, so undo leaves it alone.
 * @typedef {{settling: number|null, overshoot: number|null}} Requirements  s, %
 *
 * A design that is kept for comparison; its reply is missing until the server has given one.
 * @typedef {{id: number, index: number, name: string, design: Design, reply: Reply|null, refused?: string}} Pin index:
 *   its letter, colour and mark
 *
 * @typedef {{names: Record<string, string>, time_unit: string, unit: string, units: Record<string, string>,
 *   voltage_unit: string, signs: {theta: number, psi: number},
 *   offsets: {theta: number, psi: number}, sample_time: number|null, decimate: number}} RecordingColumns names: column
 *   by role
 * @typedef {{preview: any, columns: RecordingColumns|null, driver: string, busy: string, problem: Problem|null,
 *   overlay: any, overlaid: Design|null, progress: any, found: any, foundFor: Design|null}} Recorded a recording of a
 *   real rig, and what is known of it
 *
 * @typedef {object} State
 * @property {Requirements} requirements
 * @property {number} spread  relative uncertainty of the rigs in the cloud; 0: no cloud
 * @property {Cloud|null} cloud
 * @property {Preset[]} presets
 * @property {Method[]} methods
 * @property {Design|null} design
 * @property {Reply|null} reply
 * @property {Design|null} answered  the design that `reply` belongs to
 * @property {Problem|null} problem
 * @property {Connection} connection
 * @property {Motion} motion
 * @property {boolean} showLinear
 * @property {boolean} showMarks  rise, peak and settling on the curves
 * @property {boolean} dragging
 * @property {boolean} canUndo
 * @property {boolean} canRedo
 * @property {Pin[]} pins
 * @property {string[]} locks  names in locks.js
 * @property {Recorded} recorded
 * @property {string|null} notice  what is to be said of the link that was opened
 * @property {string|null} fault  that a part of the page could not be drawn
 */
export {};
