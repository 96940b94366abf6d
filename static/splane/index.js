/** What other rooms may import of splane/. */
export { drawGrid } from './grid.js';
export { fit, keyStep, outgrown, pick, pinch, toPixel, toPlane, zoom } from './math.js';
export { SPlane } from './splane.js';
