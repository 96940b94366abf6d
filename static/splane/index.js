/** What other rooms may import of splane/. */
export { CloudFeed } from './cloud_feed.js';
export { toPixel } from './math.js';
export { SPlane } from './splane.js';
