/**
 * The few lines that a page without a framework needs to make elements; static strings pass the words of the page's
 * language here.
 */
import { SPOKEN, t } from '../text/index.js';

const SVG = 'http://www.w3.org/2000/svg';

/** @typedef {Node|string|null|undefined} Child */
/** @typedef {(Child|readonly Child[])[]} Children */

/**
 * @template {Element} E
 * @param {E} node
 * @param {Record<string, unknown>} attributes
 * @param {Children} children
 * @returns {E}
 */
function dress(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), /** @type {EventListener} */ (value));
    else node.setAttribute(name, value === true ? '' : SPOKEN.has(name) ? t(String(value)) : String(value));
  }
  const own = attributes.translate === 'no'; // symbols and units are the same in every language
  node.append(
    ...children
      .flat()
      .filter((c) => c !== null && c !== undefined)
      .map((c) => (typeof c === 'string' && !own ? t(c) : c)),
  );
  return node;
}

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, unknown>} [attributes] `onclick` and the like add listeners
 * @param {Children} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function h(tag, attributes = {}, ...children) {
  return dress(document.createElement(tag), attributes, children);
}

/** One that submits nothing. @param {Record<string, unknown>} attributes @param {Children} children */
export const button = (attributes, ...children) => h('button', { type: 'button', ...attributes }, ...children);

/**
 * A box to be ticked, in its label.
 * @param {Record<string, unknown>} attributes the box'; but `title` and `hidden` are the label's
 * @param {Children} label
 */
export function check({ title, hidden, ...of }, ...label) {
  const box = h('input', { type: 'checkbox', ...of });
  return { box, node: h('label', { class: 'check', title, hidden }, box, ...label) };
}

/**
 * @template {keyof SVGElementTagNameMap} T
 * @param {T} tag
 * @param {Record<string, unknown>} [attributes]
 * @param {Children} children
 * @returns {SVGElementTagNameMap[T]}
 */
export function svg(tag, attributes = {}, ...children) {
  return dress(document.createElementNS(SVG, tag), attributes, children);
}

/**
 * Writes text only where it differs: most of the page stays as it is while one pole moves.
 * @param {Node} node
 * @param {string} text
 */
export function setText(node, text) {
  const said = t(text);
  if (node.textContent !== said) node.textContent = said;
}

/** @param {Element} node @param {string} name @param {string|number} value */
export function setAttr(node, name, value) {
  const text = SPOKEN.has(name) ? t(String(value)) : String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}

/** @param {string} id @returns {HTMLElement} */
export function byId(id) {
  const node = document.getElementById(id);
  if (!node) throw new Error(`the page has no element #${id}`);
  return node;
}
