/** "Export": the design as a file for other programs, as numbers, or as a report to print. */
import { messageOf, say } from '../text/index.js';
import { bodyOf, hidesRemarks, letterOf, scenarioOf } from '../model/index.js';
import { exportDesign } from '../net/index.js';
import { button, h, icon, popupButton, saveFile, setText } from '../ui/index.js';
import { EXPORTS } from './export_formats.js';

/** @typedef {import('./export_formats.js').Export} Export */
const [MOST_PINS, MOST_NAME] = [6, 60]; // that the server takes
const READ_MS = 60_000; // by then a tab has read its page

/** @param {import('../model/store.js').Store} store @param {import('../link/address.js').Address} address */
export function exportMenu(store, address) {
  return popupButton({
    label: 'Export this design as a file',
    text: h('span', { class: 'export' }, icon('save'), h('span', { class: 'word' }, 'Export')),
    testid: 'export',
    kind: '',
    content: () => menu(store, address),
  });
}

/** Those that have figures, as many as a report has room for. @param {import('../types.js').Pin[]} pins */
const pinsOf = (pins) =>
  pins
    .filter(({ refused }) => !refused)
    .slice(0, MOST_PINS)
    .map(({ index, name, design }) => ({
      ...bodyOf(design),
      scenario: scenarioOf(design),
      name: `${letterOf(index)} ${name}`.slice(0, MOST_NAME),
    }));

/** What a report has beside the design. @param {import('../types.js').State} state */
const beside = (state) => ({
  pins: pinsOf(state.pins),
  required: state.requirements,
  remarks: !hidesRemarks(state),
});

/** @param {import('../model/store.js').Store} store @param {import('../link/address.js').Address} address */
function menu(store, address) {
  const told = h('p', { class: 'told', role: 'status', 'data-testid': 'export-told' });
  /** @param {Export} format @returns {Promise<Blob|null>} null where the server refuses, which is told */
  async function made({ name, filename }) {
    const { design } = store.state;
    if (!design) return null;
    setText(told, say`Making ${filename}…`);
    try {
      return await exportDesign(name, `${location.origin}${location.pathname}${location.search}${address.link}`, {
        ...bodyOf(design),
        scenario: scenarioOf(design),
        ...(name === 'report' ? beside(store.state) : {}),
      });
    } catch (error) {
      setText(told, messageOf(error));
      return null;
    }
  }
  /** @param {Export} format */
  async function save(format) {
    const file = await made(format);
    if (!file) return;
    saveFile(format.filename, file);
    setText(told, say`${format.filename} is saved.`);
  }
  /** @param {Export} format */
  async function open(format) {
    const tab = window.open('', '_blank'); // at once: later the browser would take it for an advertisement
    const file = await made(format);
    if (!file || !tab)
      return tab ? tab.close() : file && setText(told, 'The browser blocked the new tab. Save the report instead.');
    const url = URL.createObjectURL(file);
    tab.location.href = url;
    setTimeout(() => URL.revokeObjectURL(url), READ_MS);
    setText(told, 'The report is open in a new tab.');
  }
  const saves = (/** @type {Export} */ format) =>
    button(
      {
        title: format.about,
        'aria-label': `${format.label}: ${format.about}`,
        'data-testid': `export-${format.name}`,
        onclick: () => save(format),
      },
      format.label,
    );
  const rows = EXPORTS.map(({ group, formats }) =>
    h(
      'tr',
      {},
      h('th', { scope: 'row' }, group),
      h(
        'td',
        {},
        h(
          'span',
          { class: 'row' },
          formats.map(saves),
          formats
            .filter(({ opens }) => opens)
            .map((format) =>
              button(
                {
                  title: 'Open it in a new tab, to read or to print',
                  'data-testid': `open-${format.name}`,
                  onclick: () => open(format),
                },
                'Open',
              ),
            ),
        ),
      ),
    ),
  );
  return [h('h3', {}, 'Export this design'), h('table', { class: 'copy-menu' }, h('tbody', {}, rows)), told];
}
