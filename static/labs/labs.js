/**
 * Labs in the page: what the address asks for, `#labs` the list, `#lab=NAME` one alone, `#class=CODE` one in a class,
 * with `&me=SECRET` by a personal link, is shown beside the instrument; on small windows in a sheet over its lower
 * part.
 * @typedef {import('./shapes.js').Desk} Desk
 */
import { messageOf, t } from '../text/index.js';
import { isView, STANDARD_VIEW } from '../model/index.js';
import { backoff, ProblemError } from '../net/index.js';
import { button, h } from '../ui/index.js';
import { AloneDesk } from './alone.js';
import { aboutClass, ClassDesk, forget, known, meaning } from './class.js';
import { joinForm } from './join.js';
import { labList } from './list.js';
import { LabPanel } from './panel.js';
import { Sheet } from './sheet.js';

/**
 * What an address asks for.
 * @param {string} hash
 * @returns {{lab?: string, code?: string, me?: string}|null} null: nothing of labs
 */
export function readLabHash(hash) {
  if (hash === '#labs') return {};
  const parts = new URLSearchParams(hash.replace(/^#/, ''));
  const [lab, code] = [parts.get('lab'), parts.get('class')];
  if (lab && /^[a-z0-9-]{1,40}$/.test(lab)) return { lab };
  const me = parts.get('me') ?? undefined;
  return code ? { code: code.trim().toUpperCase(), ...(me && { me }) } : null;
}

export class Labs {
  /** @type {LabPanel|null} */ #panel = null;
  #shown = '';
  #turn = 0;

  /** @param {import('../model/store.js').Store} store @param {import('../link/address.js').Address} address */
  constructor(store, address) {
    this.store = store;
    this.address = address;
    this.root = h('div', { class: 'lab-body', 'data-testid': 'lab-body' });
    this.sheet = new Sheet(this.root);
    document.body.insertBefore(this.sheet.node, document.querySelector('.instrument'));
    addEventListener('pagehide', () => this.#panel?.desk.leave());
  }

  /** @param {string} hash */
  async open(hash) {
    const asked = readLabHash(hash);
    const shown = !asked ? '#labs' : asked.lab ? `#lab=${asked.lab}` : asked.code ? `#class=${asked.code}` : '#labs';
    const on = this.#panel !== null;
    if (on && (shown === '#labs' || (shown === this.#shown && !asked?.me))) {
      const view = new URLSearchParams(hash.slice(1)).get('view') ?? STANDARD_VIEW;
      if (shown === this.#shown && isView(view)) this.store.set({ view }); // by Back or Forward
      this.address.hold(this.#shown, () => this.#end());
      return this.#lead(); // the lab that is on
    }
    this.#close();
    this.#shown = shown;
    this.address.hold(shown, () => this.#end());
    this.sheet.show();
    this.#say('Loading…');
    const turn = ++this.#turn;
    const made = await this.#made(asked ?? {}, () => turn === this.#turn);
    if (turn === this.#turn && made) this.#begin(made);
    else if (made) made.leave();
  }

  /**
   * @param {{lab?: string, code?: string, me?: string}} asked
   * @param {() => boolean} wanted whether nothing else has been asked for meanwhile
   * @returns {Promise<Desk|null>}
   */
  async #made({ lab, code, me }, wanted) {
    for (let attempt = 0; wanted(); attempt++) {
      try {
        if (lab) return await AloneDesk.open(lab);
        const student = code && (me ?? known(code)?.student);
        if (code && student) return await ClassDesk.open(code, { student });
        const nodes = code
          ? this.#joining(code, await aboutClass(code), wanted)
          : await labList((to) => (location.hash = to));
        if (wanted()) this.#put(nodes);
        return null;
      } catch (error) {
        if (!wanted()) return null;
        if (code && meaning(error) !== 'away') return this.#refused(code, error);
        if (error instanceof ProblemError && !((error.problem.status ?? 0) >= 500)) return this.#refused('', error);
        this.#say(`${messageOf(error)} ${t('It is tried again.')}`);
        await new Promise((again) => setTimeout(again, backoff(attempt, 500, 10_000)));
      }
    }
    return null;
  }

  /** @param {string} code empty: no class @param {unknown} error */
  #refused(code, error) {
    const hint = error instanceof ProblemError ? (error.problem.hint ?? '') : '';
    const other = button(
      {
        'data-testid': 'lab-other',
        onclick: () => {
          forget(code);
          this.#again(`#class=${code}`);
        },
      },
      'Join as somebody else',
    );
    this.#put([
      h('h2', {}, code ? t('This class cannot be opened') : t('This lab cannot be opened')),
      h('p', { class: 'lab-trouble', role: 'alert', 'data-testid': 'lab-refused' }, messageOf(error)),
      h('p', {}, hint),
      h('div', { class: 'lab-foot' }, code && known(code) ? other : null, this.#leave('All labs', '#labs')),
    ]);
    return null;
  }

  /** @param {string} code @param {import('./class.js').About} about @param {() => boolean} wanted */
  #joining(code, about, wanted) {
    return joinForm(about, async (who) => {
      const desk = await ClassDesk.open(code, who);
      if (wanted()) this.#begin(desk);
      else desk.leave();
    });
  }

  /** @param {Desk} desk */
  #begin(desk) {
    const { code } = /** @type {{code?: string}} */ (desk);
    const root = h('div', { class: 'lab' });
    this.#put([root]);
    document.documentElement.classList.add('lab-on');
    this.#panel = new LabPanel(root, this.store, desk, {
      leave: () => this.#again('#labs'),
      notMe: code
        ? () => {
            forget(code);
            this.#again(`#class=${code}`);
          }
        : undefined,
    });
    this.#name();
  }

  /** Another address of labs, from the beginning. @param {string} hash */
  #again(hash) {
    this.#close();
    if (location.hash === hash) this.open(hash);
    else location.hash = hash;
  }

  /** @param {string} text @param {string} hash */
  #leave(text, hash) {
    return button({ onclick: () => this.#again(hash) }, text);
  }

  /** @param {(Node|string)[]} nodes */
  #put(nodes) {
    const closing = button(
      { class: 'lab-close', 'aria-label': 'Close', 'data-testid': 'lab-close', onclick: () => this.leave() },
      '×',
    );
    this.root.replaceChildren(...nodes);
    if (!nodes.some((node) => node instanceof Element && node.matches('.lab'))) this.root.prepend(closing);
  }

  /** @param {string} words */
  #say(words) {
    this.#put([h('p', { role: 'status' }, words)]);
  }

  /** What the header calls it. */
  #name() {
    const link = document.querySelector('[data-testid=view-labs]');
    if (link) link.textContent = t(this.#panel ? 'Lab' : 'Labs');
  }

  /** To the lab that is on. */
  #lead() {
    this.sheet.rise();
    /** @type {HTMLElement|null} */ (this.root.querySelector('h3'))?.focus({ preventScroll: true });
  }

  /** The panel alone goes. */
  #close() {
    this.#panel?.close();
    this.#panel = null;
    document.documentElement.classList.remove('lab-on');
    this.#name();
  }

  /** Another design was opened by its link. */
  #end() {
    this.#turn += 1;
    this.#close();
    this.sheet.hide();
  }

  /** Back to the instrument alone. */
  leave() {
    this.#end();
    this.address.hold('');
  }
}
