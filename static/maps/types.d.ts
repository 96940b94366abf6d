/** The shapes of maps. */
import type { Measure } from '../kernel/found.js';
import type { Axis } from '../types.js';

/** Of two numbers that a map is over. */
export interface Span {
  from: number;
  to: number;
  log: boolean;
}

export type Move = 'pitch-pair' | 'yaw-pair' | 'pitch-pi' | 'yaw-pi';

/** What a person has chosen to see. */
export interface Choice {
  /** a name of choices.js */
  name: string;
  /** that is stepped; own: that of what is moved */
  axis: Axis | 'both' | 'own';
  model: 'linear' | 'nonlinear';
  /** whose places are shown in the s-plane; hand: of those touched last */
  pair: 'hand' | 'pitch' | 'yaw';
}

/** Values over a grid of nodes, row by row. */
export interface Field {
  columns: number;
  rows: number;
  domain: { x: Span; y: Span };
  /** NaN where there is none, ±∞ where it is unlimited */
  values: Float64Array;
  /** 2 stable, 1 not, 0 no such design */
  stable: Uint8Array;
  /** the largest real part of the loop's poles, rad/s; NaN where it is not known */
  abscissa: Float64Array;
  /** what is required besides, by the requirements' order */
  others: Float64Array[];
  /** whether it is as fine as it gets */
  whole: boolean;
}

/** What a map shows: its measure, and what is required of others. */
export interface Asked {
  move: Move;
  /** a real pair's own plane, p₁ × p₂ */
  real: boolean;
  domain: { x: Span; y: Span };
  measure: Measure;
  /** upper limits that are required, with what they limit; first those of the measure itself */
  limits: { measure: Measure; max?: number; min?: number }[];
}
