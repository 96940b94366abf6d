/** A student's design as a link that opens it in the instrument; what this needs is fetched when it is wanted. */

/** @typedef {import('./shapes.js').Body} Body */
/** @typedef {(body: Body) => string} LinkOf */

/** @type {Promise<LinkOf>|null} */ let making = null;

async function make() {
  const [{ designFrom }, { linkOf }, { initialState }, { getPresets }] = await Promise.all([
    import('../bodies/index.js'),
    import('../link/index.js'),
    import('../model/index.js'),
    import('../net/index.js'),
  ]);
  const presets = await getPresets();
  return (/** @type {Body} */ body) =>
    `./${linkOf({ ...initialState(), design: designFrom(body, presets) }, { presets, methods: [] })}`;
}

/** What makes such links; where it could not be fetched, the next call tries again. @returns {Promise<LinkOf>} */
export function designLinks() {
  making ??= make().catch((error) => {
    making = null;
    throw error;
  });
  return making;
}
