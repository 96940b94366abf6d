/** What the server tells an instructor of a class; what the contract leaves to a lab's own format is said here. */
import type * as contract from '../contract.js';

export type ClassRoom = contract.ClassReply;
export type Student = contract.StudentRow;
/** Of one student in one step; goals as the best attempt meets them, in the step's order, empty before any. */
export type Done = contract.StepTold;
export type LabCard = contract.LabSummary;
export type About = contract.ClassAbout;
export type HandMark = contract.HandMarked;

/** Its choices and a good answer are told with the lab alone. */
export type Question = contract.QuestionHead & { choices?: string[]; sample?: string };
export type Step = Omit<contract.StepHead, 'questions'> & { questions: Question[] };

/** Of a goal or a question; `met` is left out where a person has to mark it. */
export type Told = contract.GoalTold & {
  label?: string;
  value_text?: string;
  required_text?: string;
  message?: string;
};
export type Marked = Omit<contract.Marked, 'goals' | 'questions'> & { goals: Told[]; questions: Told[] };

/** A design as a request has it. */
export type Body = Record<string, unknown>;
export type Answers = Record<string, unknown>;

export interface Attempt {
  id: string;
  at: string;
  /** by the student's clock, of an attempt made offline */
  handed_at?: string;
  points: number;
  of: number;
  design?: Body;
  answers?: Answers;
  result: Marked;
}

/** What is kept of one student in one step. */
export interface Work {
  attempts: number;
  /** the attempts themselves */
  tries?: Attempt[];
  draft?: { design: Body; answers: Answers; at: string };
  best?: Marked;
  hints: number[];
  hand: HandMark[];
}

/** All that is kept of one student. */
export type Whole = Pick<Student, 'id' | 'number' | 'name' | 'email' | 'login' | 'joined' | 'last_seen'> & {
  steps: Record<string, Work>;
};

/** The lab as its instructor may see it. */
export interface Notes {
  instructor?: string;
  math?: Record<string, string>;
  steps?: { name: string; questions?: Question[] }[];
}

/** A class that this browser has the instructor's link of. */
export interface Known {
  code: string;
  key: string;
  title: string;
  ends: string;
}
