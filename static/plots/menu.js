/** The small menu of a plot: its picture and its numbers as files. */
import { polesText, say } from '../text/index.js';
import { nameOf } from '../model/index.js';
import { button, h, icon, popupButton, saveFile } from '../ui/index.js';
import { drawPicture } from './picture.js';
import { csvOf, linesOf, tableOf } from './export.js';
import { drawPlot, fileName } from './image.js';

/**
 * @typedef {import('../model/traces.js').Signal} Signal
 * @typedef {import('./image.js').Seen} Seen
 * @typedef {import('./picture.js').Picture} Picture
 */

/** What the picture is of. @param {import('../model/store.js').Store} store */
export function subtitle(store) {
  const { design } = store.state;
  if (!design) return '';
  const rig = store.preset?.title ?? design.preset;
  const about = say`${rig} · poles ${polesText(design.poles)} rad/s · ${nameOf(design)}`;
  return design.outer === 'pi' ? say`${about}, PI loops` : about;
}

const WORDS = {
  PNG: 'Picture: what is seen, with title, axes and legend, on white',
  CSV: 'Numbers: time and every line, units in the header',
};

/**
 * The button that saves as a picture or as numbers.
 * @param {string} testid
 * @param {string} title
 * @param {{PNG: () => void, CSV: () => void}} save
 */
function saveButton(testid, title, save) {
  const content = () => [
    h(
      'div',
      { class: 'row' },
      h('span', { class: 'caption' }, `Save ${title}`),
      .../** @type {('PNG'|'CSV')[]} */ (['PNG', 'CSV']).map((kind) =>
        button({ title: WORDS[kind], 'data-testid': `save-${testid}-${kind}`, onclick: save[kind] }, kind),
      ),
    ),
  ];
  return popupButton({
    label: `Save ${title} as picture or numbers`,
    text: icon('save'),
    testid: `save-${testid}`,
    content,
  });
}

/** @param {HTMLCanvasElement} canvas @param {string} name */
function savePicture(canvas, name) {
  // Not toBlob: browsers encode there when they are idle, which beside a rig in motion takes seconds.
  const [, base64] = canvas.toDataURL('image/png').split(',');
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  saveFile(`${name}.png`, new Blob([bytes], { type: 'image/png' }));
}
const saveNumbers = (/** @type {string} */ csv, /** @type {string} */ name) =>
  saveFile(`${name}.csv`, new Blob([csv], { type: 'text/csv;charset=utf-8' }));

/**
 * @param {import('../model/store.js').Store} store
 * @param {Signal} signal
 * @param {string} title
 * @param {() => Seen} seen
 */
export const plotMenu = (store, signal, title, seen) =>
  saveButton(signal, title, {
    PNG: () =>
      savePicture(
        drawPlot(signal, linesOf(store.state, signal), store.state.pins, { ...seen(), subtitle: subtitle(store) }),
        fileName(signal),
      ),
    CSV: () => saveNumbers(csvOf(signal, linesOf(store.state, signal)), fileName(signal)),
  });

/**
 * The same for lines that are not the design's.
 * @param {string} name of the file
 * @param {string} title
 * @param {Signal} signal
 * @param {import('./export.js').Line[]} lines
 * @param {Seen & {subtitle: string}} seen
 */
export const linesMenu = (name, title, signal, lines, seen) =>
  saveButton(name, title, {
    PNG: () => savePicture(drawPlot(signal, lines, [], seen), name),
    CSV: () => saveNumbers(csvOf(signal, lines), name),
  });

/**
 * The same for what is not over time.
 * @param {string} name of the file
 * @param {string} title
 * @param {() => Picture} picture
 * @param {string} over header of what the lines are over
 */
export const pictureMenu = (name, title, picture, over) =>
  saveButton(name, title, {
    PNG: () => savePicture(drawPicture(picture()), name),
    CSV: () =>
      saveNumbers(
        tableOf(picture().lines, over, (line) => line),
        name,
      ),
  });
