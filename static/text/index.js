/** What other rooms may import of text/. */
export {
  brief,
  complex,
  complexIn,
  conjugates,
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
  share,
  polesText,
  poleText,
  seconds,
  significant,
  typographic,
} from './format.js';
export { count, languageOf, loadWords, messageOf, say, SPOKEN, t, translatePage } from './words.js';
