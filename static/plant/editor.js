/**
 * Where a system is pasted: the text, the textbooks' systems, what is wrong with it and where, the matrices as they
 * were read, a field for each letter.
 * @typedef {import('../contract.js').SystemRead} SystemRead
 * @typedef {import('../contract.js').SystemExample} SystemExample
 */
import { inField, parseNumber, say } from '../text/index.js';
import { copyButton, formula, h, setText } from '../ui/index.js';
import { withLetter } from './link_text.js';

const DELAY_MS = 350;
const PLACEHOLDER = 'A = [0 1; -k/m -b/m];\nB = [0; 1/m];\nC = [1 0];\nk = 3, m = 2, b = 0.5';
const PLACE = /^line (\d+), column (\d+)/;

export class Editor {
  /** @type {ReturnType<typeof setTimeout>|undefined} */ #timer;
  /** @type {SystemExample[]} */ #examples = [];
  /** @type {Map<string, HTMLInputElement>} */ #fields = new Map();

  /** @type {SystemExample|null} the one that is shown as it stands in its book */ example = null;
  /** What is typed before the field is left belongs together. */ session = 0;

  /**
   * @param {{onText: (text: string, session?: number) => void, onExample: (example: SystemExample) => void,
   *   onLeave: () => void}} how  session: of typing; none where a value was given at once
   */
  constructor({ onText, onExample, onLeave }) {
    this.onText = onText;
    this.area = h('textarea', {
      class: 'plant-text',
      rows: 9,
      spellcheck: 'false',
      autocomplete: 'off',
      autocapitalize: 'off',
      placeholder: PLACEHOLDER,
      'aria-label': 'The system as text',
      'aria-describedby': 'plant-help plant-trouble',
      'data-testid': 'plant-text',
      oninput: () => this.#later(),
      onblur: () => {
        this.session += 1;
        onLeave();
      },
    });
    this.menu = h(
      'select',
      {
        'aria-label': 'Systems of textbooks',
        'data-testid': 'plant-examples',
        onchange: () => {
          const chosen = this.#examples.find((example) => example.name === this.menu.value);
          if (chosen) onExample(chosen);
        },
      },
      h('option', { value: '' }, 'Textbook systems …'),
    );
    this.source = h('p', { class: 'caption', 'data-testid': 'plant-source' });
    this.trouble = h('p', {
      class: 'plant-trouble',
      id: 'plant-trouble',
      role: 'status',
      'data-testid': 'plant-trouble',
    });
    this.letters = h('div', {
      class: 'plant-letters',
      role: 'group',
      'aria-label': 'Values of the letters',
      hidden: true,
    });
    this.formulas = h('div', {
      class: 'plant-formulas sideways',
      tabindex: 0,
      role: 'group',
      'aria-label': 'The matrices as they were read',
      'data-testid': 'plant-matrices',
    });
    this.node = h(
      'section',
      { class: 'card plant-editor', 'aria-label': 'The system' },
      h('div', { class: 'plant-row' }, h('h3', {}, 'The system'), this.menu),
      this.source,
      this.area,
      h(
        'p',
        { class: 'caption', id: 'plant-help' },
        'Paste A, B, C, D from MATLAB, Python or plain text. Letters may have values: m = 2. ' +
          'Desired poles: p = [ … ], the observer’s: q = [ … ].',
      ),
      this.trouble,
      this.letters,
      this.formulas,
    );
  }

  /** @param {SystemExample[]} examples */
  offer(examples) {
    this.#examples = examples;
    this.menu.append(
      ...examples.map(({ name, title, source }) => h('option', { value: name }, `${title} (${source.split(',')[0]})`)),
    );
  }

  get text() {
    return this.area.value;
  }

  /** @param {string} text @param {SystemExample|null} [example] */
  set(text, example = null) {
    clearTimeout(this.#timer);
    this.example = example;
    if (this.area.value !== text) this.area.value = text;
    this.menu.value = example?.name ?? '';
    setText(this.source, example?.source ?? '');
  }

  #later() {
    this.example = null;
    this.menu.value = '';
    setText(this.source, '');
    clearTimeout(this.#timer);
    const { session } = this;
    this.#timer = setTimeout(() => this.onText(this.area.value, session), DELAY_MS);
  }

  /**
   * What is wrong with the text; the place is marked where the text is not being typed.
   * @param {import('../types.js').Problem|null} problem
   */
  complain(problem) {
    this.node.classList.toggle('wrong', problem !== null);
    if (problem) this.area.setAttribute('aria-invalid', 'true');
    else this.area.removeAttribute('aria-invalid');
    setText(this.trouble, problem ? [problem.detail, problem.hint].filter(Boolean).join(' ') : '');
    const place = PLACE.exec(problem?.detail ?? '');
    if (!place || document.activeElement === this.area) return;
    const lines = this.area.value.split('\n').slice(0, Number(place[1]) - 1);
    const at = lines.join('\n').length + (lines.length ? 1 : 0) + Number(place[2]) - 1;
    this.area.setSelectionRange(at, at + 1);
  }

  /** @param {SystemRead} read */
  show(read) {
    const items = Object.entries(read.matrices);
    const copied = () => items.map(([name, { values, latex }]) => ({ name, matrix: values, latex }));
    this.formulas.replaceChildren(
      ...items.map(([name, { mathml }]) =>
        h('div', { class: 'plant-formula' }, h('i', { translate: 'no' }, `${name} =`), formula(mathml)),
      ),
      copyButton('plant-matrices', copied),
    );
    const own = Object.entries(read.letters);
    this.letters.hidden = own.length === 0;
    if (own.map(([name]) => name).join() !== [...this.#fields.keys()].join()) this.#make(own.map(([name]) => name));
    for (const [name, value] of own) {
      const field = this.#fields.get(name);
      if (!field) continue;
      const missing = read.missing.includes(name);
      field.classList.toggle('missing', missing);
      if (document.activeElement !== field) field.value = inField(value);
    }
  }

  /** @param {string[]} names */
  #make(names) {
    this.#fields = new Map(
      names.map((name) => [
        name,
        h('input', {
          class: 'number',
          type: 'text',
          inputmode: 'decimal',
          autocomplete: 'off',
          'data-testid': `plant-letter-${name}`,
          'aria-label': say`Value of ${name}`,
          onchange: (/** @type {Event} */ e) => this.#letter(name, /** @type {HTMLInputElement} */ (e.target)),
        }),
      ]),
    );
    this.letters.replaceChildren(
      ...[...this.#fields].map(([name, field]) => h('label', {}, h('i', { translate: 'no' }, name), field)),
    );
  }

  /** @param {string} name @param {HTMLInputElement} field */
  #letter(name, field) {
    const value = parseNumber(field.value);
    if (!Number.isFinite(value)) {
      field.setAttribute('aria-invalid', 'true');
      return;
    }
    field.removeAttribute('aria-invalid');
    this.set(withLetter(this.area.value, name, value));
    this.onText(this.area.value);
  }
}
