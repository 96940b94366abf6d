/** What other rooms may import of clouds/. */
export { Clouds } from './clouds.js';
export { uncertain } from './feed.js';
