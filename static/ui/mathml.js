/** Symbols and formulas as MathML: the page's own, and the server's, parsed as XML and never taken for HTML. */
import { h } from './dom.js';

const FUNCTIONS = new Set(['sin', 'cos', 'det']); // whose room the operator between would make, were it there

/**
 * The server's own MathML, parsed as XML and adopted: it is never taken for HTML.
 * @param {string|undefined} text
 * @returns {Node}
 */
export function formula(text) {
  if (!text) return document.createTextNode('–');
  const source = text.includes('xmlns')
    ? text
    : text.replace('<math', '<math xmlns="http://www.w3.org/1998/Math/MathML"');
  const parsed = new DOMParser().parseFromString(source, 'application/xml').documentElement;
  if (parsed.localName !== 'math') return document.createTextNode('This formula could not be read.');
  const node = /** @type {Element} */ (document.importNode(parsed, true));
  for (const element of [node, ...node.querySelectorAll('*')]) {
    for (const { name } of [...element.attributes])
      if (name.startsWith('on') || name === 'href' || name === 'style') element.removeAttribute(name);
  }
  node.setAttribute('display', 'block');
  for (const name of node.querySelectorAll('mi'))
    if (FUNCTIONS.has(name.textContent ?? '')) name.classList.add('function');
  return node;
}

const MATHML = 'http://www.w3.org/1998/Math/MathML';
/** Combining marks, and the signs of the same accents. */
const ACCENTS = /** @type {Record<string, string>} */ ({ '\u0302': 'ˆ', '\u0304': '¯', '\u0307': '˙', '\u0308': '¨' });

/**
 * An element of MathML.
 * @param {string} tag
 * @param {Record<string, string>} attributes
 * @param {(Node|string)[]} children
 */
export function math(tag, attributes, ...children) {
  const node = document.createElementNS(MATHML, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/** Letters as they are slanted: one by one, but a word's upright; axes as in K_py are no word. @param {string} text */
export function letters(text) {
  if (/^[A-Za-z]{2,}$/.test(text) && !/^[py]{2}$/.test(text)) return [math('mtext', {}, text)];
  return Array.from(
    text.normalize('NFD').matchAll(/(\d+)|(\p{L})(\p{Mn}?)|([^\p{L}\d\s])/gu),
    ([, digits, base, mark, sign]) => {
      if (digits) return math('mn', {}, digits);
      if (sign) return math('mo', {}, sign);
      const letter = math('mi', {}, base);
      const accent = ACCENTS[mark];
      return accent ? math('mover', { accent: 'true' }, letter, math('mo', { stretchy: 'false' }, accent)) : letter;
    },
  );
}

const row = (/** @type {Element[]} */ parts) => (parts.length === 1 ? parts[0] : math('mrow', {}, ...parts));

/**
 * A symbol with subscript, as in K_pp; between bars, where it is a norm.
 * @param {string} base
 * @param {string} [sub]
 * @param {string} [bars]
 * @returns {HTMLElement}
 */
export function symbol(base, sub, bars) {
  const bar = () => (bars ? [math('mo', { stretchy: 'false', form: 'prefix' }, bars)] : []);
  const inner = [...bar(), ...letters(base), ...bar()];
  const body = sub ? [math('msub', {}, row(inner), row(letters(sub)))] : inner;
  // the label is what a table's head or a field is called by
  return h(
    'span',
    { class: 'sym' },
    math('math', { 'aria-label': `${bars ?? ''}${base}${bars ?? ''}${sub ?? ''}` }, ...body),
  );
}

/** A symbol as the registry of figures prints it: ‖K‖_F, κ_2(X), V_p. @param {string} text @returns {HTMLElement} */
export function printed(text) {
  const [, norm, base, sub, of] = /** @type {RegExpExecArray} */ (/^(‖?)(.+?)‖?(?:_(\w+))?(?:\((\w)\))?$/.exec(text));
  if (norm) return symbol(base, sub, '‖');
  return of ? h('span', { class: 'sym' }, symbol(base, sub), '(', symbol(of), ')') : symbol(base, sub);
}
