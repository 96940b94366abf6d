/** The few lines that a page without a framework needs to make elements. */

const SVG = 'http://www.w3.org/2000/svg';

/** @param {Element} node @param {Record<string, any>} attributes @param {any[]} children */
function dress(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? '' : String(value));
  }
  node.append(...children.flat().filter((c) => c !== null && c !== undefined));
  return node;
}

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag @param {Record<string, any>} [attributes] `onclick` and the like add listeners @param {...any} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function h(tag, attributes = {}, ...children) {
  return /** @type {any} */ (dress(document.createElement(tag), attributes, children));
}

/**
 * @template {keyof SVGElementTagNameMap} T
 * @param {T} tag @param {Record<string, any>} [attributes] @param {...any} children
 * @returns {SVGElementTagNameMap[T]}
 */
export function svg(tag, attributes = {}, ...children) {
  return /** @type {any} */ (dress(document.createElementNS(SVG, tag), attributes, children));
}

/** Writes text only where it differs: most of the page stays as it is while one pole moves. @param {Node} node @param {string} text */
export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

/** @param {Element} node @param {string} name @param {string|number} value */
export function setAttr(node, name, value) {
  const text = String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}

/** @param {string} id @returns {HTMLElement} */
export function byId(id) {
  const node = document.getElementById(id);
  if (!node) throw new Error(`the page has no element #${id}`);
  return node;
}

/** A symbol with subscript, as in K_pp. @param {string} base @param {string} [sub] @returns {HTMLElement} */
export const symbol = (base, sub) => h('span', { class: 'sym' }, h('i', {}, base), ...(sub ? [h('sub', {}, sub)] : []));
