/**
 * The room net of a page without any server, as `heli2dof lab scorm` packs it: it takes the place of index.js and has
 * its names. Whoever asks is told that nobody answers.
 */
import { t } from '../text/index.js';
import { ProblemError } from './api.js';

export { ProblemError };
export { backoff } from './backoff.js';
export { Latest, LatestSocket } from './latest.js';
export { hasWebGl, ofSession, session } from './session.js';
export { decodeFrame, encodeFrame } from './wire.js';

const why = () =>
  new ProblemError({ code: 'needs_server', detail: t('This needs a server; the page works here without one.') });

/** @returns {Promise<never>} */
const nobody = () => Promise.reject(why());

/** @returns {never} */
function nowhere() {
  throw why();
}

export {
  nobody as call,
  nobody as compareMethods,
  nobody as compareSplits,
  nobody as evaluateDesign,
  nobody as exportDesign,
  nobody as fileOf,
  nobody as getMethods,
  nobody as getPaper,
  nobody as getPresets,
  nobody as getRigViews,
  nobody as getSymbolic,
  nobody as joinRecordings,
  nobody as lagTrack,
  nobody as motionFile,
  nobody as openLoops,
  nobody as overlayRecording,
  nobody as putRig,
  nobody as relativeGain,
  nobody as rootLocus,
  nobody as sampleRecording,
  nobody as sendRecording,
  nobody as suggestLoops,
  nobody as walkThrough,
  nowhere as cloudAddress,
  nowhere as findAddress,
  nowhere as hubAddress,
  nowhere as identifyAddress,
  nowhere as Live,
  nowhere as liveSocket,
  nowhere as socketAddress,
  nowhere as windowAddress,
};
