/** What other rooms may import of clouds/. */
export { Clouds } from './clouds.js';
