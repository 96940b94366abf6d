/** What other rooms may import of plots/. */
export { draughtsman, linesMenu, pictureMenu, subtitle } from './menu.js';
export { Plots } from './plots.js';
export { drawNamedRules, drawShades } from './rules.js';
