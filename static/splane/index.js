/** What other rooms may import of splane/. */
export { toPixel } from './math.js';
export { SPlane } from './splane.js';
