/** Shows the REST API's description by Swagger UI, which the page has loaded before. */
/** @typedef {((how: object) => void) & {presets: {apis: unknown}, SwaggerUIStandalonePreset: unknown}} Bundle */
const { SwaggerUIBundle } = /** @type {Window & {SwaggerUIBundle: Bundle}} */ (/** @type {Window} */ (window));

SwaggerUIBundle({
  url: 'openapi.json',
  dom_id: '#swagger-ui',
  deepLinking: true,
  showExtensions: true,
  showCommonExtensions: true,
  presets: [SwaggerUIBundle.presets.apis, SwaggerUIBundle.SwaggerUIStandalonePreset],
  layout: 'BaseLayout',
});
