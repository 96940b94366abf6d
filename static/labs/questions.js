/**
 * The questions of a step: a number with its unit, a choice, or text; and what was said of the answers.
 * @typedef {import('./shapes.js').Question} Question
 * @typedef {import('./shapes.js').Answers} Answers
 * @typedef {import('./shapes.js').Marked} Marked
 * @typedef {{question: Question, node: HTMLElement, told: HTMLElement,
 *   write: (answer: Answers[string]|undefined) => void}} Row
 */
import { count, parseNumber, say, t } from '../text/index.js';
import { h } from '../ui/index.js';
import { markdown, markdownLine } from '../markdown/index.js';
import { pointsText } from './goals.js';

export class Questions {
  /** @type {Row[]} */ #rows = [];
  /** @type {Answers} */ #answers = {};

  /** @param {import('./shapes.js').Formulas} formulas @param {(answers: Answers) => void} onChange */
  constructor(formulas, onChange) {
    this.formulas = formulas;
    this.onChange = onChange;
    this.node = h('section', { class: 'lab-questions', 'aria-label': 'Questions' });
  }

  /** @param {Question[]} questions @param {Answers} answers */
  show(questions, answers) {
    this.#answers = { ...answers };
    this.#rows = questions.map((question) => this.#row(question));
    for (const { question, write } of this.#rows) write(answers[question.name]);
    this.node.replaceChildren(
      ...(questions.length ? [h('h4', {}, 'Questions')] : []),
      ...this.#rows.map(({ node }) => node),
    );
    this.node.classList.toggle('none', !questions.length);
  }

  /** @param {string} name @param {Answers[string]|undefined} answer */
  #say(name, answer) {
    const { [name]: _old, ...others } = this.#answers;
    const none = answer === undefined || answer === '' || (Array.isArray(answer) && !answer.length);
    this.#answers = none ? others : { ...others, [name]: answer };
    this.onChange(this.#answers);
  }

  /** @param {Question} question @returns {Row} */
  #row(question) {
    const { name, kind, text, points } = question;
    const id = `lab-q-${name}`;
    const told = h('p', { class: 'lab-message', role: 'status', id: `${id}-told`, 'data-testid': `${id}-told` });
    const { nodes, write } =
      kind === 'choice'
        ? this.#choice(question, id)
        : kind === 'number'
          ? this.#number(question, id)
          : this.#text(question, id);
    const worth = h(
      'span',
      { class: 'lab-worth' },
      count(points, '{0} point', '{0} points').replace(/^\S+/, pointsText(points)),
    );
    const asked = h('div', { class: 'lab-asked', id: `${id}-text` }, markdown(text, this.formulas, 5), worth);
    const node = h(
      'div',
      { class: 'lab-question', role: 'group', 'aria-labelledby': `${id}-text`, 'data-testid': id },
      asked,
      nodes,
      told,
    );
    return { question, node, told, write };
  }

  /** @param {Question} question @param {string} id */
  #choice({ name, choices = [], several }, id) {
    const boxes = choices.map((choice, i) => {
      const box = h('input', {
        type: several ? 'checkbox' : 'radio',
        name: id,
        value: i + 1,
        'data-testid': `${id}-${i + 1}`,
        'aria-describedby': `${id}-told`,
        onchange: () => {
          const chosen = boxes.flatMap(({ box: own }, k) => (own.checked ? [k + 1] : []));
          this.#say(name, several ? chosen : chosen[0]);
        },
      });
      return {
        box,
        node: h('label', { class: 'lab-choice' }, box, h('span', {}, markdownLine(choice, this.formulas))),
      };
    });
    return {
      nodes: boxes.map(({ node }) => node),
      write: (/** @type {Answers[string]|undefined} */ answer) => {
        const chosen = [answer ?? []].flat().map(String);
        for (const { box } of boxes) box.checked = chosen.includes(box.value);
      },
    };
  }

  /** @param {Question} question @param {string} id */
  #number({ name, unit }, id) {
    const wrong = h('span', { class: 'field-error', role: 'status' });
    const input = h('input', {
      class: 'number',
      type: 'text',
      inputmode: 'text',
      autocomplete: 'off',
      spellcheck: 'false',
      'aria-label': unit ? say`Answer in ${unit}` : t('Answer'),
      'aria-describedby': `${id}-text ${id}-told`,
      'data-testid': `${id}-input`,
      oninput: () => {
        const text = input.value.trim();
        // a unit may be typed as well: the server understands it
        const number = parseNumber(text.replace(/(?<=\d)\s*[^\d\s.,eE+−-][^\d]*$/, ''));
        wrong.textContent = text && Number.isNaN(number) && !/\d/.test(text) ? t('enter a number') : '';
        this.#say(name, text);
      },
    });
    return {
      nodes: [
        h(
          'div',
          { class: 'lab-number' },
          h('span', { class: 'entry' }, input, wrong),
          unit && h('span', { translate: 'no' }, unit),
        ),
      ],
      write: (/** @type {Answers[string]|undefined} */ answer) => {
        input.value = answer === undefined ? '' : String(answer);
      },
    };
  }

  /** @param {Question} question @param {string} id */
  #text({ name }, id) {
    const area = h('textarea', {
      rows: 3,
      maxlength: 4000,
      'aria-label': 'Answer in words',
      'aria-describedby': `${id}-text ${id}-told`,
      'data-testid': `${id}-input`,
      oninput: () => this.#say(name, area.value),
    });
    return {
      nodes: [area],
      write: (/** @type {Answers[string]|undefined} */ answer) => {
        area.value = answer === undefined ? '' : String(answer);
      },
    };
  }

  /**
   * @param {Marked|null} marked the newest verdict, with the answers to which it was given
   * @param {import('./shapes.js').HandMark[]} hand
   * @param {Answers} answers
   */
  render(marked, hand, answers) {
    for (const { question, node, told } of this.#rows) {
      const { name, kind } = question;
      const own = hand.find((one) => one.question === name);
      // once another answer stands there, nothing is known of it
      const verdict =
        marked?.answers && JSON.stringify(marked.answers[name]) === JSON.stringify(answers[name])
          ? marked.questions.find((one) => one.name === name)
          : undefined;
      const met = own ? own.points >= question.points : verdict?.met;
      node.dataset.kind = met === true ? 'met' : met === false ? 'missed' : 'open';
      const words = own
        ? [
            say`Marked by your instructor: ${pointsText(own.points)} of ${pointsText(question.points)}.`,
            own.comment ?? '',
          ]
        : verdict?.met === true
          ? [`✓ ${t('right')}`]
          : verdict?.met === false
            ? [`✕ ${verdict.message || t('not right yet')}`]
            : [kind === 'text' ? verdict?.message || t('Marked by hand.') : ''];
      const text = words.filter(Boolean).join(' ');
      if (told.textContent !== text) told.textContent = text;
    }
  }
}
