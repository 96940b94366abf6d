/** The server's MathML as elements: parsed as XML, never taken for HTML, matrices' brackets drawn as borders. */

const FUNCTIONS = new Set(['sin', 'cos', 'det']); // whose room the operator between would make, were it there

/**
 * Draws a matrix's brackets as borders: without a mathematical font a browser does not stretch them.
 * @param {Element} table
 */
function bracket(table) {
  const [before, after] = [table.previousElementSibling, table.nextElementSibling];
  if (before?.textContent?.trim() !== '[' || after?.textContent?.trim() !== ']') return;
  before.remove();
  after.remove();
  table.classList.add('bracketed');
}

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
  for (const table of node.querySelectorAll('mtable')) bracket(table);
  for (const name of node.querySelectorAll('mi'))
    if (FUNCTIONS.has(name.textContent ?? '')) name.classList.add('function');
  return node;
}
