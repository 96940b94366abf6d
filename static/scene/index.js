/** What other rooms may import of scene/. */
export { SceneSharing } from './sharing.js';
export { SceneView } from './view.js';

/** What comes after the first view: the menu beside the transport; poses and ghosts for who moves the rig otherwise. */
export const late = () => Promise.all([import('./menu.js'), import('./pose.js'), import('./ghosts.js')]);
