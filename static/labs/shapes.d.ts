/** What labs send and take (app/contract/labs.py, app/contract/classes.py), as the page reads it. */
import type { Axis, Motor, View } from '../types.js';
import type { Body } from '../bodies/bodies.js';
import type { Figure } from '../model/figures.js';

/** MathML by LaTeX. */
export type Formulas = Record<string, string>;

export interface Goal {
  name: string;
  kind: string;
  label: string;
  points: number;
  required_text: string;
  /** of the registry */
  figure?: string;
  of?: string | null;
  axis?: Axis | 'both' | null;
  motor?: Motor | 'both' | null;
  model?: 'linear' | 'nonlinear';
  /** each axis alone, or as the scenario has them */
  steps?: 'alone' | 'together';
  /** in SI units */
  max?: number | null;
  min?: number | null;
  /** whether an unstable loop may meet it */
  unstable?: boolean;
  /** of a setting: where it stands in a body */
  path?: string;
  /** of its limits, and what leads there from SI */
  unit?: string;
  scale?: number;
  /** false: the server alone can tell */
  page?: boolean;
  /** of a flight: how its figure is written, as the registry has it */
  written?: Omit<Figure, 'name'>;
  /** of a flight: what is flown, whether with the controller off, and whether the design may change in the air */
  task?: string;
  hands?: 'on' | 'off';
  changes?: 'allowed';
  /** of its gusts */
  seed?: number;
}

/** Of a flight, as static/flight/log.js writes it. */
export interface Log {
  task: string;
  seed: number;
  ticks: number;
  checksum: string;
  design: Body;
  events: [tick: number, word: string, ...values: (number | Body)[]][];
  [part: string]: unknown;
}

/** What is flown in a step of a lab. */
export interface FlightAsked {
  task: string;
  hands?: 'on' | 'off';
  changes?: 'allowed';
  /** of the gusts; without: each flight its own */
  seed?: number;
}

/** A flight's figures, some by axis. */
export type FlightValues = Record<string, number | Partial<Record<Axis, number>>>;

export interface Question {
  name: string;
  kind: 'number' | 'choice' | 'text' | string;
  text: string;
  points: number;
  unit?: string | null;
  choices?: string[];
  /** whether several may be right */
  several?: boolean;
}

export interface Step {
  name: string;
  title: string;
  text?: string;
  view?: View;
  continue?: boolean;
  start?: Body;
  unlocked?: string[];
  hidden?: string[];
  points: number;
  goals: Goal[];
  questions: Question[];
  hints: { cost: number; text?: string }[];
  /** that there is a recording of the student's own rig */
  recording?: boolean;
}

export interface Lab {
  name: string;
  number?: number | null;
  title: string;
  minutes?: number | null;
  summary?: string;
  preset: string;
  text?: string;
  end?: string;
  points: number;
  math?: Formulas;
  steps: Step[];
}

/** One of the list. */
export interface Listed {
  name: string;
  number?: number | null;
  title: string;
  summary?: string;
  minutes?: number | null;
  points: number;
  steps: number | unknown[];
  source: string;
  alone?: boolean;
}

/** Of a goal or a question. */
export interface Told {
  name: string;
  label: string;
  /** null: marked by hand */
  met: boolean | null;
  value?: number | null;
  value_text?: string;
  required_text?: string;
  points: number;
  of: number;
  message?: string;
}

export interface Marked {
  goals: Told[];
  questions: Told[];
  points: number;
  of: number;
  /** points that hints took */
  cost?: number;
  stable?: boolean;
  findings?: { code?: string; message: string }[];
  ignored?: string[];
  best?: Marked;
  /** that were handed in, where they are known */
  answers?: Answers;
}

export interface HandMark {
  question: string;
  points: number;
  comment?: string | null;
}

export type Answers = Record<string, string | number | number[]>;
export interface HintText {
  text: string;
  math?: Formulas;
}

/** Of a step, what is kept. */
export interface Kept {
  design?: Body | null;
  answers?: Answers;
  best?: Marked | null;
  attempts?: number;
  /** numbers of those that were taken, from 1; their texts where they are known */
  hints?: (number | (HintText & { hint: number }))[];
  hand?: HandMark[];
}

/** How things stand with those who mark. */
export interface Standing {
  kind: 'fine' | 'away' | 'closed' | 'gone' | 'waiting';
  /** what is to be told at the top; empty where nothing is */
  words: string;
}

/** Of an attempt that could not be sent at once: its mark, or null and why it was refused for good. */
export type Arrived = (
  attempt: { step: string; design: Body; answers: Answers; flight?: Log },
  marked: Marked | null,
  error?: unknown,
) => void;

/** Who marks and keeps a lab: this browser and a server without a class, a class, or an LMS. */
export interface Desk {
  lab: Lab;
  /** a part of a body: the student's own rig */
  rig: Body;
  kept: Record<string, Kept>;
  /** the step where the student is */
  at: string;
  /** whose it is; empty: nobody is named */
  who: string;
  standing: Standing;
  /** null: it waits, and `changed` tells when it was marked */
  mark(step: string, design: Body, answers: Answers, flight?: Log): Promise<Marked | null>;
  /** `hint` from 1 */
  hint(step: string, hint: number): Promise<HintText>;
  /** where the student is, with what; soon after, and the newest alone */
  keep(step: string, design: Body, answers: Answers): void;
  /** `told` is called where `kept` or `standing` are others, `arrived` where what had waited is marked */
  onChange(told: () => void, arrived: Arrived): void;
  /** under which name this browser keeps a step's flight; left out where nothing is flown */
  flightName?(step: string): string;
  /** a personal link to it; null where there is none */
  link?: string | null;
  /** a recording of the student's own rig */
  recording?(step: string): Promise<Blob>;
  /** what is said of handing in, where no server marks */
  words?: { handIn?: string };
  /** the server can be reached again: what waits is sent */
  heal?(): Promise<void>;
  /** nobody is here any more */
  leave(): void;
}
