/** What other rooms may import of exports/. */
export { exportMenu } from './export_menu.js';
