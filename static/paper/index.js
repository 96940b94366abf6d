/** What other rooms may import of paper/. */
export { formulaFont } from './ends.js';
export { FormulasPanel } from './formulas.js';
export { PaperPanel } from './panel.js';
