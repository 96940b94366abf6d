/** What other rooms may import of charts/. */
export { chartBody, ink, makeChart, readByKeys, readIndex, readingFigure, scaled } from './chart.js';
