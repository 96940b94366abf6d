/** What other rooms may import of net/. */
export {
  call,
  cloudAddress,
  compareMethods,
  compareSplits,
  evaluateDesign,
  exportDesign,
  fileOf,
  findAddress,
  getMethods,
  getPaper,
  getPresets,
  getRigViews,
  getSymbolic,
  hubAddress,
  identifyAddress,
  joinRecordings,
  lagTrack,
  rootLocus,
  Live,
  liveSocket,
  motionFile,
  openLoops,
  overlayRecording,
  ProblemError,
  putRig,
  relativeGain,
  sampleRecording,
  sendRecording,
  socketAddress,
  suggestLoops,
  walkThrough,
  windowAddress,
} from './api.js';
export { backoff } from './backoff.js';
export { Latest, LatestSocket } from './latest.js';
export { hasWebGl, ofSession, session } from './session.js';
export { decodeFrame, encodeFrame } from './wire.js';
