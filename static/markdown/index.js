/** What other rooms may import of markdown/. */
export { markdown, markdownLine } from './markdown.js';
