/** What other rooms may import of charts/. */
export { chartBody, ink, makeChart, RECORDED, readByKeys, readIndex, readingFigure, scaled } from './chart.js';
