/**
 * The page's words in other languages, as gettext does it: the English text is the key, and what a language does not
 * know stays English.
 *
 * Static strings are looked up where they reach the page, in `h`, `setText` and `setAttr` of dom.js; sentences with
 * values in them are written with `say` and `count`. Words painted on canvases go through the same two. Words of the
 * server (findings, presets, methods) are not asked for. A language is a module in languages/ that exports its
 * catalogue, and a line in CATALOGUES; it is loaded only where it is wanted. Knows no DOM but for `translatePage`.
 * @typedef {Partial<Record<Intl.LDMLPluralRule, string>>} Plurals
 * @typedef {{get: (key: string) => string|Plurals|undefined}} Catalogue  a Map, for one
 */

/** @type {Record<string, () => Promise<{default: Catalogue}>>} */
const CATALOGUES = { 'qps-ploc': () => import('./languages/pseudo.js') };
const WORD = /\p{L}{2}/u;
const TRIMMED = /^(\s*)([\s\S]*?)(\s*)$/;
/** Attributes that people read or hear. */
export const SPOKEN = new Set([
  'title',
  'aria-label',
  'aria-description',
  'aria-valuetext',
  'placeholder',
  'alt',
  'label',
]);

/** @type {Catalogue|null} */ let catalogue = null;
let language = 'en';

/** @param {string} text @returns {string} */
function translated(text) {
  const [, before, key, after] = /** @type {RegExpExecArray} */ (TRIMMED.exec(text));
  if (!WORD.test(key)) return text;
  const found = catalogue?.get(key);
  return typeof found === 'string' ? before + found + after : text;
}

/** A static string. @param {string} text */
export const t = (text) => (catalogue === null ? text : translated(text));

/** @param {string} pattern with {0}, {1}, … @param {readonly unknown[]} values */
const filled = (pattern, values) => pattern.replace(/\{(\d)\}/g, (_, i) => String(values[Number(i)]));

/**
 * A sentence with values: say`${n} of ${m}` has the key "{0} of {1}".
 * @param {TemplateStringsArray} parts
 * @param {...unknown} values
 */
export function say(parts, ...values) {
  const key = parts.reduce((text, part, i) => `${text}{${i - 1}}${part}`);
  return filled(t(key), values);
}

/** What went wrong, in words. @param {unknown} error */
export const messageOf = (error) => (error instanceof Error ? error.message : String(error));

/**
 * A number of things: count(2, '{0} limit', '{0} limits'). The key is the plural; a catalogue may hold all the forms
 * that its language has.
 * @param {number} n
 * @param {string} one
 * @param {string} other
 */
export function count(n, one, other) {
  const found = catalogue?.get(other);
  const forms = typeof found === 'object' ? found : { one: found ?? one, other: found ?? other };
  const form = forms[new Intl.PluralRules(language).select(n)] ?? forms.other ?? other;
  return filled(form, [n]);
}

/**
 * What is asked for in the address comes first, then what the browser prefers; English where none is known.
 * @param {string} search
 * @param {readonly string[]} preferred
 * @param {readonly string[]} [known]
 */
export function languageOf(search, preferred, known = Object.keys(CATALOGUES)) {
  const asked = new URLSearchParams(search).get('lang');
  for (const tag of asked ? [asked] : preferred) {
    const parts = tag.toLowerCase().split('-');
    for (let n = parts.length; n > 0; n--) {
      const name = parts.slice(0, n).join('-');
      if (name === 'en' || known.includes(name)) return name;
    }
  }
  return 'en';
}

/** @param {Catalogue|null} words null: English @param {string} [name] */
export function useWords(words, name = 'en') {
  catalogue = words;
  language = words && Intl.PluralRules.supportedLocalesOf(name).length ? name : 'en';
}

/**
 * Loads a language's words; English stays where that fails.
 * @param {string} name
 * @returns {Promise<boolean>} whether they are others than English
 */
export async function loadWords(name) {
  if (!Object.hasOwn(CATALOGUES, name)) return false;
  try {
    useWords((await CATALOGUES[name]()).default, name);
    return true;
  } catch {
    return false;
  }
}

/** What index.html holds before any view has been made. @param {Document} document @param {string} name */
export function translatePage(document, name) {
  document.documentElement.lang = name;
  document.title = t(document.title);
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode())
    if (!walker.currentNode.parentElement?.closest('[translate=no]'))
      walker.currentNode.nodeValue = t(walker.currentNode.nodeValue ?? '');
  for (const name of SPOKEN)
    for (const node of document.body.querySelectorAll(`[${name}]`))
      node.setAttribute(name, t(node.getAttribute(name) ?? ''));
}
