/**
 * The figures of merit: names, meanings, units, how they are written and which way is better. Made of
 * heli2dof_core/figures by `python -m tests.page_figures`; not to be changed by hand.
 *
 * @typedef {object} Figure
 * @property {string} name  of its value in replies
 * @property {string} [head]  of its row
 * @property {string} [short]  of its column
 * @property {string} [hint]  what is said of that column
 * @property {string} [meaning]
 * @property {string} [source]  of its definition
 * @property {string} [symbol]  subscripts after _
 * @property {'significant'|'seconds'|'decibel'|'exponent'} [notation]  without: fixed decimals
 * @property {number} digits  decimals, or significant digits
 * @property {number} [scale]  of a value when it is written
 * @property {string} [after]  each number: its unit
 * @property {'higher'|'none'} [better]  without: lower
 * @property {boolean} [signed]  its size alone is better or worse
 * @property {boolean} [detail]  seen only where more figures are asked for
 * @property {number} [least]  values that differ by less are alike
 */

/**
 * @type {Record<'rise' | 'settling' | 'overshoot' | 'undershoot' | 'peak' | 'peak_time' | 'error' | 'iae' | 'itae' |
 * 'settled', Figure>}
 */
export const AXIS = {
  rise: {
    name: 'rise_time',
    head: 'Rise time',
    short: 'Rise',
    hint: '10 to 90 % of this axis’ step',
    meaning: 'Time from 10 % to 90 % of the step',
    source: 'Ogata, Modern Control Engineering, 2010, section 5.3',
    symbol: 't_r',
    notation: 'seconds',
    digits: 2,
    least: 0.01,
  },
  settling: {
    name: 'settling_time',
    head: 'Settling time',
    short: 'Settling',
    hint: 'to within 2 % of this axis’ step',
    meaning: 'Time after which the angle stays within 2 % of the step around its reference',
    source: 'Ogata, Modern Control Engineering, 2010, section 5.3',
    symbol: 't_s',
    notation: 'seconds',
    digits: 2,
    least: 0.01,
  },
  overshoot: {
    name: 'overshoot',
    head: 'Overshoot',
    short: 'Over\u00adshoot',
    hint: 'beyond the reference of this axis’ step',
    meaning: 'Largest excess beyond the reference, in percent of the step',
    source: 'Ogata, Modern Control Engineering, 2010, section 5.3',
    symbol: 'M_p',
    digits: 1,
    after: ' %',
    least: 1,
  },
  undershoot: {
    name: 'undershoot',
    head: 'Undershoot',
    short: 'Under\u00adshoot',
    hint: 'from the start away from the reference of this axis’ step',
    meaning: 'Largest excursion from the start away from the reference, in percent of the step',
    source: 'Skogestad and Postlethwaite, Multivariable Feedback Control, 2005, section 5.6',
    digits: 1,
    after: ' %',
    detail: true,
    least: 1,
  },
  peak: {
    name: 'peak',
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
    better: 'none',
  },
  peak_time: {
    name: 'peak_time',
    symbol: 't_p',
    notation: 'seconds',
    digits: 2,
    better: 'none',
  },
  error: {
    name: 'steady_state_error',
    head: 'Error at the end',
    short: 'Error',
    hint: 'size of the error at the end',
    meaning: 'Reference minus the last angle shown',
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
    signed: true,
    least: 0.001,
  },
  iae: {
    name: 'iae',
    head: 'IAE, °s',
    meaning: '∫ |e| dt, integral of the absolute error over the time shown',
    source: 'Graham and Lathrop, Trans. AIEE 72 (1953) 273',
    notation: 'significant',
    digits: 3,
    scale: 57.29577951308232,
    detail: true,
    least: 0.0001,
  },
  itae: {
    name: 'itae',
    head: 'ITAE, °s²',
    meaning: '∫ t |e| dt, the absolute error weighted with time, over the time shown',
    source: 'Graham and Lathrop, Trans. AIEE 72 (1953) 273',
    notation: 'significant',
    digits: 3,
    scale: 57.29577951308232,
    detail: true,
    least: 0.0001,
  },
  settled: {
    name: 'settled',
    digits: 2,
    better: 'none',
  },
};

/** @type {Record<'coupling', Figure>} */
export const STEP = {
  coupling: {
    name: 'coupling_peak',
    head: 'Other axis moves',
    short: 'Other axis',
    hint: 'largest deviation of the axis that is not stepped',
    meaning: 'Largest deviation of the axis that is not stepped',
    digits: 2,
    scale: 57.29577951308232,
    after: '°',
    least: 0.001,
  },
};

/** @type {Record<'peak' | 'saturated' | 'effort', Figure>} */
export const MOTOR = {
  peak: {
    name: 'peak',
    head: 'peak',
    short: 'peak',
    hint: 'motor over both steps, trim included',
    meaning: 'Largest voltage of the motor, trim included',
    symbol: 'V',
    digits: 1,
    after: ' V',
    least: 0.5,
  },
  saturated: {
    name: 'saturated',
    digits: 0,
    scale: 100,
    after: ' %',
  },
  effort: {
    name: 'effort',
    head: 'effort, V²s',
    meaning:
      '∫ (V − V_trim)² dt over the time shown: what control costs beyond holding still; the inputs’ part of the ' +
      'quadratic cost',
    source: 'Anderson and Moore, Optimal Control, 1990',
    notation: 'significant',
    digits: 3,
    detail: true,
    least: 0.05,
  },
};

/** @type {Record<'gain' | 'gain_reduction_margin' | 'phase' | 'delay', Figure>} */
export const MARGINS = {
  gain: {
    name: 'gain_margin',
    head: 'Gain margin',
    short: 'Gain margin',
    hint: 'the smaller of both motors’, everything else closed',
    meaning: 'Smallest factor above 1 on the motor’s gain that makes the loop unstable',
    source: 'Ogata, Modern Control Engineering, 2010, section 7.7',
    notation: 'decibel',
    digits: 2,
    better: 'higher',
  },
  gain_reduction_margin: {
    name: 'gain_reduction_margin',
    notation: 'decibel',
    digits: 2,
  },
  phase: {
    name: 'phase_margin',
    head: 'Phase margin',
    short: 'Phase margin',
    hint: 'the smaller of both motors’, everything else closed',
    meaning: 'Smallest phase lag or lead at a gain crossover that makes the loop unstable',
    source: 'Ogata, Modern Control Engineering, 2010, section 7.7',
    digits: 0,
    scale: 57.29577951308232,
    after: '°',
    better: 'higher',
  },
  delay: {
    name: 'delay_margin',
    head: 'Delay margin',
    meaning:
      'Smallest dead time at this axis’ own motor that makes the loop unstable: phase margin over crossover frequency',
    notation: 'seconds',
    digits: 2,
    better: 'higher',
  },
};

/**
 * @type {Record<'sensitivity' | 'peak_frequency' | 'disk' | 'disk_frequency' | 'gain_low' | 'gain_high' | 'phase',
 * Figure>}
 */
export const SENSITIVITY = {
  sensitivity: {
    name: 'peak',
    head: 'Sensitivity peak',
    meaning:
      'Largest singular value of S(jω) over all frequencies, at the motors: its inverse is the distance to ' +
      'instability under an additive change of the loop',
    source: 'Skogestad and Postlethwaite, Multivariable Feedback Control, 2005, section 2.4.3',
    symbol: 'M_S',
    digits: 2,
    detail: true,
  },
  peak_frequency: {
    name: 'peak_frequency',
    notation: 'significant',
    digits: 3,
    after: ' rad/s',
    better: 'none',
  },
  disk: {
    name: 'disk_margin',
    head: 'Disk margin',
    short: 'Disk margin',
    hint: 'both motors at once',
    meaning:
      'Size α of the disks of gain and phase changes, at both motors at once and independent of each other, that ' +
      'the loop tolerates',
    source: 'Seiler, Packard and Gahinet, IEEE Control Systems 40 (2020) 78',
    symbol: 'α',
    digits: 2,
    better: 'higher',
    detail: true,
  },
  disk_frequency: {
    name: 'disk_frequency',
    digits: 2,
    after: ' rad/s',
    better: 'none',
  },
  gain_low: {
    name: 'gain_low',
    digits: 2,
  },
  gain_high: {
    name: 'gain_high',
    digits: 2,
    better: 'higher',
  },
  phase: {
    name: 'phase',
    digits: 0,
    scale: 57.29577951308232,
    after: '°',
    better: 'higher',
  },
};

/** @type {Record<'lag', Figure>} */
export const LOOP = {
  lag: {
    name: 'lag_margin',
    head: 'Lag margin',
    short: 'Lag margin',
    hint: 'how slow both rotors may be; an Aero’s need 0.16 s',
    meaning:
      'Least time constant of both rotors alike at which the loop is no longer stable; where the rotors are placed, ' +
      'above their own',
    notation: 'seconds',
    digits: 2,
    better: 'higher',
  },
};

/** @type {Record<'norm' | 'spectral' | 'error' | 'pole_error_bound' | 'kappa' | 'lambda', Figure>} */
export const DESIGN = {
  norm: {
    name: 'norm',
    short: 'norm',
    hint: 'Frobenius norm of K: the size of all its gains',
    symbol: '‖K‖_F',
    notation: 'significant',
    digits: 4,
  },
  spectral: {
    name: 'spectral_norm',
    short: 'spectral norm',
    hint: 'spectral norm of K: the most it can amplify a state',
    symbol: '‖K‖_2',
    notation: 'significant',
    digits: 4,
  },
  error: {
    name: 'pole_error',
    short: 'Pole error',
    hint: 'farthest distance of a computed pole from the placed one, rad/s',
    notation: 'exponent',
    digits: 0,
  },
  pole_error_bound: {
    name: 'pole_error_bound',
    digits: 2,
    after: ' rad/s',
  },
  kappa: {
    name: 'eigenvector_condition',
    short: 'condition',
    hint: 'condition number of the eigenvectors of A − BK: how sensitive the poles are, at best 1',
    symbol: 'κ_2(X)',
    notation: 'significant',
    digits: 3,
  },
  lambda: {
    name: 'relative_gain',
    short: 'relative gain',
    hint: 'relative gain at s = 0, dimensionless: at 1 the diagonal loops do not feel each other',
    symbol: 'λ_11',
    digits: 3,
    better: 'none',
  },
};

/** Rows of an axis' step, in their order. @type {Record<string, Figure>} */
export const RESPONSE = {
  rise: AXIS.rise,
  settling: AXIS.settling,
  overshoot: AXIS.overshoot,
  undershoot: AXIS.undershoot,
  error: AXIS.error,
  coupling: STEP.coupling,
  iae: AXIS.iae,
  itae: AXIS.itae,
};
