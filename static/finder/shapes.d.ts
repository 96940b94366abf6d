/** What the finder is asked and what it answers, as the page names it. */
import type * as contract from '../contract.js';

/** Of which response a figure is meant. */
export type Where = Pick<contract.ToldFigure, 'axis' | 'motor' | 'model' | 'steps'>;
export type Limit = Where & Pick<contract.ToldRequirement, 'max' | 'min' | 'share'>;

export interface Asked {
  free: string[];
  require: Record<string, Limit[]>;
  minimize: (Where & { measure: string })[];
  uncertainty?: { spread: Record<string, number> };
  designs: number;
  seconds: number;
  seed: number;
}

export type Found = contract.FindReply;
/** A figure that a design is looked at by. */
export type Seen = Where & Pick<contract.ToldFigure, 'measure' | 'title'>;
/** What the scatter draws: designs by their figures. */
export type Drawn = Pick<Found, 'designs' | 'requirements' | 'present'> & { figures: Seen[] };
/** The front of a search that goes on: rows of the figures that it makes better. */
export interface SoFar {
  figures: Seen[];
  points: number[][];
}
export type Progress = contract.FindProgress;
/** What a design comes to. */
export type Outcome = contract.PresentDesign;
export type Requirement = contract.ToldRequirement;
