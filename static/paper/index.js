/** What other rooms may import of paper/. */
export { FormulasPanel } from './formulas.js';
export { PaperPanel } from './panel.js';
