/** What other rooms may import of rig/. */
export { RigPanel } from './rig_panel.js';
