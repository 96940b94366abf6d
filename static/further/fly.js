/**
 * The view Fly is fetched when it is seen first; where that fails, it says so, and the next visit tries again.
 * @typedef {import('./index.js').Page} Page
 * @typedef {import('./index.js').Loading} Loading
 */
import { t } from '../text/index.js';
import { byId, h } from '../ui/index.js';

export class FlyRoom {
  /** Whether its view is seen. */ #seen = false;
  /** Whether it is there, or on its way. */ #comes = false;

  /** @param {Page & import('../flight/scene_feed.js').SceneParts} page @param {Loading} loading */
  constructor(page, loading) {
    this.page = page;
    this.loading = loading;
  }

  /** @param {Pick<import('../types.js').State, 'view'>} state */
  render({ view }) {
    const seen = view === 'fly';
    if (seen && !this.#seen && !this.#comes) this.#fetch();
    this.#seen = seen;
  }

  async #fetch() {
    this.#comes = true;
    const root = byId('fly');
    root.replaceChildren();
    try {
      const view = await this.#made(root);
      this.loading.show([[view]]);
    } catch (why) {
      console.error(why);
      const words = t('Flying is not there: this browser could not fetch or start it. The next visit tries again.');
      root.replaceChildren(h('p', { class: 'fly-strip panel status failure', role: 'alert' }, words));
      this.#comes = false;
    }
  }

  /** @param {HTMLElement} root */
  async #made(root) {
    const { fetched, styles } = this.loading;
    const [{ FlyView }, { compiled, Flights, instantiated, MODULE }] = await fetched(() =>
      Promise.all([
        import('../flight/index.js'),
        import('../kernel/index.js'),
        ...['fly', 'hands', 'flight_instruments'].map(styles),
      ]),
    );
    const flights = new Flights(await instantiated(await compiled(await fetched(() => fetch(MODULE)))));
    return new FlyView(root, { ...this.page, flights });
  }
}
