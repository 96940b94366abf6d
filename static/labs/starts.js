/**
 * The designs with which a step begins, as heli2dof_core/labs/rigs.py has them: the student's rig, over it what the
 * step says; where it goes on, the student's own design of the step before, as far as it was the student's to change.
 * Pure.
 * @typedef {import('./shapes.js').Lab} Lab
 * @typedef {import('./shapes.js').Step} Step
 * @typedef {import('./shapes.js').Kept} Kept
 * @typedef {import('../types.js').Design} Design
 * @typedef {import('../types.js').Preset} Preset
 * @typedef {import('../bodies/bodies.js').Body} Body
 */
import { guarded } from '../model/index.js';
import { bodyFrom, designFrom, merged } from '../bodies/index.js';
import { locksOf } from './parts.js';

/** The step before, where one goes on from there. @param {Lab} lab @param {Step} step */
const before = (lab, step) => (step.continue ? lab.steps[lab.steps.indexOf(step) - 1] : undefined);

/**
 * What is free in a step, or was in those that it continues.
 * @param {Lab} lab @param {Step} step @returns {string[]}
 */
function freeIn(lab, step) {
  const previous = before(lab, step);
  return [...new Set([...(step.unlocked ?? []), ...(previous ? freeIn(lab, previous) : [])])];
}

/**
 * @param {Lab} lab
 * @param {Step} step
 * @param {Body} rig
 * @param {Record<string, Kept>} kept
 * @param {Preset[]} presets
 * @returns {Design}
 */
export function startOf(lab, step, rig, kept, presets) {
  const previous = before(lab, step);
  if (!previous) return designFrom(merged(rig, step.start), presets);
  const base = startOf(lab, previous, rig, kept, presets);
  const own = kept[previous.name]?.design;
  const { locks, free } = locksOf(freeIn(lab, previous));
  const design = own ? guarded(base, designFrom(merged({ preset: rig.preset }, own), presets), locks, free) : base;
  return designFrom(merged(bodyFrom(design), step.start), presets);
}

/**
 * The design with which a step is shown: the one that was kept of it, on the student's rig and with what is fixed as
 * the step has it; else the start.
 * @param {Lab} lab @param {Step} step @param {Body} rig @param {Record<string, Kept>} kept @param {Preset[]} presets
 * @returns {Design}
 */
export function designIn(lab, step, rig, kept, presets) {
  const start = startOf(lab, step, rig, kept, presets);
  const own = kept[step.name]?.design;
  if (!own) return start;
  const { locks, free } = locksOf(step.unlocked ?? []);
  return guarded(start, designFrom(own, presets), locks, free);
}
