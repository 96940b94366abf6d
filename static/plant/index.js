/** What other rooms may import of plant/. */
export { PlantPanel } from './panel.js';
