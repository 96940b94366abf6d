/** What other rooms may import of recordings/. */
export { RecordingsPanel } from './panel.js';
