/** What other rooms may import of ui/. */
export { copyText, saveFile } from './clipboard.js';
export { copyButton, readyToCopy } from './copy_button.js';
export { button, byId, check, h, setAttr, setText, svg } from './dom.js';
export { Choice, designField, NumberField } from './fields.js';
export { isolated } from './isolated.js';
export { Lazy, whileSeen } from './lazy.js';
export { formula, letters, math, printed, symbol } from './mathml.js';
export { GAIN, gainMatrix, integralMatrix, Matrix, relativeGains } from './matrix.js';
export { recall, remember } from './memory.js';
export { CALM, Turns } from './pace.js';
export { drawingUnit, followsPage, pictureScale, rescale } from './picture_scale.js';
export { closePopup, icon, popupButton, showTip } from './popup.js';
export { Projector, projectorWanted } from './projector.js';
export { Stats } from './stats.js';
export { groupedHead, head, keepingFocus, shape, wide } from './tables.js';
export { watched } from './watch.js';
