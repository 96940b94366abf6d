/** What other rooms may import of scene/. */
export { SceneSharing } from './sharing.js';
export { SceneView } from './view.js';
