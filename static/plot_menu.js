/** The small menu of a plot: its picture and its numbers as files. */
import { saveFile } from './clipboard.js';
import { fixed } from './format.js';
import { h } from './dom.js';
import { nameOf } from './methods.js';
import { csvOf, linesOf } from './plot_export.js';
import { drawPlot, fileName } from './plot_image.js';
import { icon, popupButton } from './popup.js';

/** @typedef {import('./traces.js').Signal} Signal @typedef {{x: [number, number], y: [number, number], rules: {value: number, label: string, danger: boolean}[]}} Seen */

/** What the picture is of. @param {import('./store.js').Store} store */
function subtitle(store) {
  const { design } = store.state;
  if (!design) return '';
  const poles = design.poles.filter((p) => p.im >= 0).map((p) => (p.im ? `${fixed(p.re)} ± ${fixed(p.im)}j` : fixed(p.re))).join(', ');
  return `${store.preset?.title ?? design.preset} · poles ${poles} rad/s · ${nameOf(design)}${design.outer === 'pi' ? ', PI loops' : ''}`;
}

/** @param {import('./store.js').Store} store @param {Signal} signal @param {string} title @param {() => Seen} seen */
export function plotMenu(store, signal, title, seen) {
  const save = {
    PNG: () => drawPlot(signal, linesOf(store.state, signal), store.state.pins, { ...seen(), subtitle: subtitle(store) }).toBlob((blob) => blob && saveFile(`${fileName(signal)}.png`, blob), 'image/png'),
    CSV: () => saveFile(`${fileName(signal)}.csv`, new Blob([csvOf(signal, linesOf(store.state, signal))], { type: 'text/csv;charset=utf-8' })),
  };
  const words = { PNG: 'Picture: what is seen, with title, axes and legend, on white', CSV: 'Numbers: time and every line, units in the header' };
  const content = () => [h('div', { class: 'row' }, h('span', { class: 'caption' }, `Save ${title}`), .../** @type {('PNG'|'CSV')[]} */ (['PNG', 'CSV']).map((kind) =>
    h('button', { type: 'button', title: words[kind], 'data-testid': `save-${signal}-${kind}`, onclick: save[kind] }, kind)))];
  return popupButton({ label: `Save ${title} as picture or numbers`, text: icon('save'), testid: `save-${signal}`, content });
}
