/** The small menu of a plot: its picture and its numbers as files. */
import { polesText, say } from '../text/index.js';
import { isVoltage, nameOf } from '../model/index.js';
import { button, h, icon, popupButton, saveFile } from '../ui/index.js';

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
  SVG: 'The same as lines and letters, sharp at any size, to be edited',
  CSV: 'Numbers: time and every line, units in the header',
};

/** The pictures of the plots that the page always has. @type {Map<Signal, () => Promise<Picture>>} */ const always =
  new Map();

/**
 * The button that saves as a picture or as numbers.
 * @param {string} testid
 * @param {string} title
 * @param {string} name of the files
 * @param {() => Promise<Picture>} picture
 * @param {() => Promise<string>} csv
 * @param {boolean} [all] whether the other plots are saved from here, too
 */
function saveButton(testid, title, name, picture, csv, all = false) {
  const save = {
    PNG: async () => savePicture(await picture(), name),
    SVG: async () => saveDrawing([await picture()], name),
    CSV: async () => saveFile(`${name}.csv`, new Blob([await csv()], { type: 'text/csv;charset=utf-8' })),
  };
  const row = (/** @type {string} */ what, /** @type {Node[]} */ ...buttons) =>
    h('div', { class: 'row' }, h('span', { class: 'caption' }, what), ...buttons);
  const content = () => [
    row(
      `Save ${title}`,
      .../** @type {('PNG'|'SVG'|'CSV')[]} */ (['PNG', 'SVG', 'CSV']).map((kind) =>
        button({ title: WORDS[kind], 'data-testid': `save-${testid}-${kind}`, onclick: save[kind] }, kind),
      ),
    ),
    ...(all
      ? [
          row(
            'Save all plots',
            button(
              {
                title: WORDS.SVG,
                'aria-label': 'Save all plots as SVG',
                'data-testid': 'save-all-SVG',
                onclick: async () =>
                  saveDrawing(await Promise.all([...always.values()].map((make) => make())), 'heli2dof-plots'),
              },
              'SVG',
            ),
          ),
        ]
      : []),
  ];
  return popupButton({
    label: `Save ${title} as picture or numbers`,
    text: icon('save'),
    testid: `save-${testid}`,
    content,
  });
}

/** What draws pictures; the first view does not need it, but it shall be there when the server is not. */
export const draughtsman = () =>
  Promise.all([import('./picture.js'), import('./vector.js'), import('./export.js'), import('./image.js')]);

/** @param {Picture} picture @param {string} name */
async function savePicture(picture, name) {
  const [{ drawPicture }] = await draughtsman();
  const canvas = drawPicture(picture);
  // Not toBlob: browsers encode there when they are idle, which beside a rig in motion takes seconds.
  const [, base64] = canvas.toDataURL('image/png').split(',');
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  saveFile(`${name}.png`, new Blob([bytes], { type: 'image/png' }));
}

/** @param {Picture[]} pictures @param {string} name */
async function saveDrawing(pictures, name) {
  const [, { measuring, svgOf }] = await draughtsman();
  saveFile(`${name}.svg`, new Blob([svgOf(pictures, measuring())], { type: 'image/svg+xml' }));
}

/**
 * @param {import('../model/store.js').Store} store
 * @param {Signal} signal
 * @param {string} title
 * @param {() => Seen} seen
 */
export function plotMenu(store, signal, title, seen) {
  const picture = async () => {
    const [, , { linesOf }, { pictureOf }] = await draughtsman();
    return pictureOf(signal, linesOf(store.state, signal), store.state.pins, { ...seen(), subtitle: subtitle(store) });
  };
  const csv = async () => {
    const [, , { csvOf, linesOf }] = await draughtsman();
    return csvOf(signal, linesOf(store.state, signal));
  };
  always.set(signal, picture);
  return saveButton(signal, title, `heli2dof-${signal}-${isVoltage(signal) ? 'V' : 'deg'}`, picture, csv, true);
}

/**
 * The same for lines that are not the design's.
 * @param {string} name of the file
 * @param {string} title
 * @param {Signal} signal
 * @param {import('./export.js').Line[]} lines
 * @param {Seen & {subtitle: string}} seen
 */
export const linesMenu = (name, title, signal, lines, seen) =>
  saveButton(
    name,
    title,
    name,
    async () => (await draughtsman())[3].pictureOf(signal, lines, [], seen),
    async () => (await draughtsman())[2].csvOf(signal, lines),
  );

/**
 * The same for what is not over time.
 * @param {string} name of the file
 * @param {string} title
 * @param {() => Picture} picture
 * @param {string} over header of what the lines are over
 */
export const pictureMenu = (name, title, picture, over) =>
  saveButton(
    name,
    title,
    name,
    async () => picture(),
    async () => (await draughtsman())[2].tableOf(picture().lines, over, (line) => line),
  );
