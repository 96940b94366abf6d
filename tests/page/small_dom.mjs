/** As much of a document as the page's own elements ask for; what lies where is the browser tests' matter. */

class SmallNode {
  parent = null;
  children = [];
  listeners = new Map();

  /** An event here, which rises to all that this stands in. */
  send(type, more = {}) {
    for (let node = this; node; node = node.parent) {
      for (const listen of node.listeners.get(type) ?? []) listen({ type, target: this, preventDefault() {}, ...more });
    }
  }

  addEventListener(type, listen) {
    this.listeners.set(type, [...(this.listeners.get(type) ?? []), listen]);
  }
}

class SmallElement extends SmallNode {
  attributes = new Map();
  style = { setProperty() {} };
  dataset = {};

  constructor(name) {
    super();
    this.tagName = name.toUpperCase();
  }

  setAttribute(name, value) {
    this.attributes.set(name, value);
  }
  getAttribute(name) {
    return this.attributes.get(name) ?? null;
  }
  removeAttribute(name) {
    this.attributes.delete(name);
  }
  get hidden() {
    return this.attributes.has('hidden');
  }
  set hidden(on) {
    if (on) this.setAttribute('hidden', '');
    else this.removeAttribute('hidden');
  }
  get className() {
    return this.getAttribute('class') ?? '';
  }
  set className(text) {
    this.setAttribute('class', text);
  }

  get classList() {
    const names = () => new Set(this.className.split(' ').filter(Boolean));
    return {
      contains: (name) => names().has(name),
      toggle: (name, on) => {
        const own = names();
        if (on) own.add(name);
        else own.delete(name);
        this.className = [...own].join(' ');
      },
    };
  }

  get options() {
    return this.children.filter(({ tagName }) => tagName === 'OPTION');
  }
  get value() {
    return this.own ?? this.getAttribute('value') ?? this.options[0]?.value ?? '';
  }
  set value(value) {
    this.own = String(value);
  }

  append(...nodes) {
    for (const node of nodes) {
      if (node instanceof SmallElement) node.parent = this;
      this.children.push(node);
    }
  }

  replaceChildren(...nodes) {
    this.children = [];
    this.append(...nodes);
  }

  get textContent() {
    return this.children.map((node) => (node instanceof SmallElement ? node.textContent : String(node))).join('');
  }
  set textContent(text) {
    this.replaceChildren(text);
  }
  contains(other) {
    return other === this || this.children.some((node) => node instanceof SmallElement && node.contains(other));
  }
}

/** A document for the time of a test; `document.send("pointerdown")` is a press beside everything. */
export function smallDocument() {
  const document = new SmallNode();
  document.createElement = (name) => new SmallElement(name);
  document.createElementNS = (_space, name) => new SmallElement(name);
  globalThis.document = document;
  return document;
}
