/** Maps by the server: those of designs that the page's kernel does not serve, and as files. */
import { messageOf, say, t } from '../text/index.js';
import { bodyOf, presetOf, scenarioOf } from '../model/index.js';
import { call, fileOf } from '../net/index.js';
import { button, h, icon, popupButton, saveFile, setText } from '../ui/index.js';
import { uncertain } from '../clouds/index.js';

const SIZE_OF_FILES = /** @type {[number, number]} */ ([64, 48]);
const RIGS = 40;

/**
 * @typedef {import('./feed.js').Wanted} Wanted
 * @typedef {import('../contract.js').MapReply} Reply
 * @typedef {import('../types.js').Asked<import('../contract.js').MapRequest>} Request
 */

/** @param {Wanted} wanted @param {[number, number]} size @returns {Request} */
export function requestOf({ design, preset, asked, spread }, size) {
  const { x, y } = asked.domain;
  const { name, ...where } = asked.measure;
  const ofRigs = name === 'share_within_limits';
  const names = uncertain(design, preset).filter((own) => own !== 'g');
  return {
    ...bodyOf(design),
    scenario: scenarioOf(design),
    map: {
      move: asked.move,
      real: asked.real,
      over: [
        [x.from, x.to],
        [y.from, y.to],
      ],
      size,
      measure: /** @type {import('../contract.js').MapAsked['measure']} */ (name),
      ...where,
      ...(ofRigs && { uncertainty: { spread: Object.fromEntries(names.map((own) => [own, spread])), samples: RIGS } }),
    },
  };
}

/** @param {Wanted} wanted @param {[number, number]} size @returns {Promise<import('./types.d.ts').Field>} */
export const fromServer = async (wanted, size) =>
  fieldOf(await call('api/v1/map', requestOf(wanted, size)), wanted.asked.domain);

/**
 * @param {Pick<Reply, 'values'|'valid'|'unlimited'|'stable'|'better'>} reply
 * @param {import('./types.d.ts').Field['domain']} domain
 * @returns {import('./types.d.ts').Field}
 */
export function fieldOf({ values, valid, unlimited, stable, better }, domain) {
  const [known, without] = [valid.flat(), unlimited.flat()];
  const good = better === 'higher' ? Infinity : -Infinity;
  return {
    columns: values[0].length,
    rows: values.length,
    domain,
    values: Float64Array.from(values.flat(), (v, i) => (known[i] ? v : without[i] ? good : NaN)),
    stable: Uint8Array.from(stable.flat(), (own) => (own ? 2 : 1)),
    abscissa: new Float64Array(known.length).fill(NaN),
    others: [],
    whole: true,
  };
}

const FILES = /** @type {const} */ ([
  ['svg', 'SVG', 'The map with title, axes and legend, to print'],
  ['csv', 'CSV', 'Numbers: a row for each place, units in the header'],
]);

/**
 * The button that saves the map in the plane.
 * @param {import('../model/store.js').Store} store
 * @param {() => {asked: import('./types.d.ts').Asked, spread: number}|null} shown
 */
export function saveButton(store, shown) {
  const told = h('p', { class: 'told', role: 'status', 'data-testid': 'map-told' });
  /** @param {string} kind */
  const save = async (kind) => {
    const { design } = store.state;
    const [map, preset] = [shown(), presetOf(store.state)];
    if (!map || !design || !preset) return setText(told, t('There is no map yet.'));
    const filename = `heli2dof-map.${kind}`;
    setText(told, say`Making ${filename}…`);
    try {
      saveFile(filename, await fileOf(`api/v1/map/${kind}`, requestOf({ design, preset, ...map }, SIZE_OF_FILES)));
      return setText(told, say`${filename} is saved.`);
    } catch (error) {
      return setText(told, messageOf(error));
    }
  };
  const content = () => {
    setText(told, '');
    return [
      h(
        'div',
        { class: 'row' },
        h('span', { class: 'caption' }, 'Save the map'),
        FILES.map(([kind, word, title]) =>
          button({ title, 'data-testid': `save-map-${kind}`, onclick: () => save(kind) }, word),
        ),
      ),
      told,
    ];
  };
  return popupButton({
    label: 'Save the map as a picture or as numbers',
    text: icon('save'),
    testid: 'save-map',
    content,
  });
}
