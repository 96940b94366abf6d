/** What other rooms may import of text/. */
export {
  brief,
  complex,
  decibel,
  DEGREE,
  degrees,
  differs,
  fixed,
  forField,
  inField,
  parseComplex,
  parseNumber,
  percent,
  poleText,
  seconds,
  significant,
} from './format.js';
export { count, languageOf, loadWords, say, SPOKEN, t, translatePage } from './words.js';
