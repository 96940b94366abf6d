/**
 * Wires only: the rooms that the first view does not need, fetched when it is there.
 * @typedef {import('../types.js').State} State
 * @typedef {import('../types.js').Design} Design
 * @typedef {{render: (state: State) => void}} Part
 * @typedef {object} Page  what they are parts of
 * @property {import('../model/store.js').Store} store
 * @property {import('../link/address.js').Address} address
 * @property {import('../splane/splane.js').SPlane} plane
 * @property {import('../plots/plots.js').Plots} plots
 * @property {(design: Design) => import('../types.js').Reply|null|undefined} reply  the page's own
 * @property {() => import('../kernel/designs.js').Designs|null} pool
 * @property {import('../scene/view.js').SceneView} scene
 * @property {import('../scene/sharing.js').SceneSharing} sharing
 * @typedef {object} Loading
 * @property {<T>(load: () => Promise<T>) => Promise<T>} fetched  again and again, where the server has gone away
 * @property {(name: string) => Promise<unknown>} styles  a sheet
 * @property {(parts: [Part, HTMLElement?][]) => void} show
 */
import { byId } from '../ui/index.js';
import { draughtsman } from '../plots/index.js';
import { late } from '../scene/index.js';
import { FlyRoom } from './fly.js';

/** @param {Page} page @param {Loading} loading */
export async function further(page, loading) {
  const { store, address, plane, plots, reply, pool, scene } = page;
  const { fetched, styles, show } = loading;
  const [{ sceneMenu }, poses, ghosts] = await fetched(late);
  if (scene.webgl) scene.transport.node.append(sceneMenu(store, scene.session));
  show([[new FlyRoom({ ...page, poses, ghosts }, loading)]]);
  const [{ exportMenu }, compare, { RigPanel }, { RecordingsPanel }, paper, { OwnRigs }] = await fetched(() =>
    Promise.all([
      import('../exports/index.js'),
      import('../compare/index.js'),
      import('../rig/index.js'),
      import('../recordings/index.js'),
      import('../paper/index.js'),
      import('../rigs/index.js'),
      draughtsman(),
      ...['recordings', 'rigs', 'paper', 'math'].map(styles),
    ]),
  );
  byId('exports').replaceChildren(exportMenu(store, address));
  await paper.formulaFont(); // before any formula is drawn, so that none moves
  show([
    [new compare.PinsPanel(byId('pins'), store), byId('pins')],
    [new compare.ComparePanel(byId('compare'), store), byId('compare')],
    [new RigPanel(byId('rig'), store), byId('rig')],
    [new RecordingsPanel(byId('recordings'), store, plots), byId('recordings')],
    [new paper.FormulasPanel(byId('formulas'), store), byId('formulas')],
    [new paper.PaperPanel(byId('paper'), store), byId('paper')],
    [new OwnRigs(byId('own-rigs'), store)],
  ]);
  const [{ PlantPanel }, { Finder }, { Nearest }, { Tracks }] = await fetched(() =>
    Promise.all([
      import('../plant/index.js'),
      import('../finder/index.js'),
      import('../nearest/index.js'),
      import('../tracks/index.js'),
      ...['plant', 'finder', 'nearest', 'tracks'].map(styles),
    ]),
  );
  const finder = new Finder(byId('find'), store, reply, plane);
  show([
    [new PlantPanel(byId('plant'), store), byId('plant')],
    [new Nearest(plane, byId('loops'), store, finder.preview)],
    [new Tracks(plane, store, finder.preview, pool)],
  ]);
  return finder;
}
