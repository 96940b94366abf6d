/** What other rooms may import of plots/. */
export { linesMenu, pictureMenu, subtitle } from './menu.js';
export { Plots } from './plots.js';
export { drawLabel, drawRule } from './rules.js';
