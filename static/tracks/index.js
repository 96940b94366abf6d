/** What other rooms may import of tracks/. */
export { Tracks } from './tracks.js';
