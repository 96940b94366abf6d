/** The small menu beside the transport: the rig in a window of its own, and its motion as a file to take away. */
import { messageOf } from '../text/index.js';
import { bodyOf, scenarioOf } from '../model/index.js';
import { motionFile, windowAddress } from '../net/index.js';
import { button, copyText, h, popupButton, saveFile, setText, svg } from '../ui/index.js';

const arrow = () =>
  svg(
    'svg',
    { class: 'icon-tool', viewBox: '0 0 12 12', 'aria-hidden': 'true' },
    svg('path', { d: 'M 5 2 H 1.5 V 10.5 H 10 V 7 M 7 1.5 H 10.5 V 5 M 10.5 1.5 L 5.5 6.5' }),
  );

/**
 * The motion that is played, as a call of its own: an axis that is not stepped has no reference.
 * @param {import('../types.js').State} state
 */
function requestOf({ design, motion }) {
  if (!design) return null;
  const scenario = scenarioOf(design);
  const { theta, psi } = scenario.reference;
  const reference = motion === 'theta' ? { theta } : motion === 'psi' ? { psi } : { theta, psi };
  return { ...bodyOf(design), scenario: { ...scenario, reference } };
}

/** @param {import('../model/store.js').Store} store @param {string} session */
export function sceneMenu(store, session) {
  const content = () => {
    const address = windowAddress(session);
    const told = h('p', { class: 'caption', role: 'status', 'data-testid': 'scene-told' });
    const link = h('input', {
      class: 'link',
      readonly: true,
      value: address,
      'aria-label': 'Link of the rig’s own window',
      'data-testid': 'window-link',
      onfocus: () => link.select(),
    });
    const copy = async () =>
      setText(told, (await copyText(address)) ? 'Copied.' : 'Not copied: select it and copy it by hand.');
    /** @param {'html'|'viser'} format */
    const save = async (format) => {
      const request = requestOf(store.state);
      if (!request) return;
      setText(told, 'Making the file…');
      try {
        saveFile(`heli2dof-motion.${format}`, await motionFile(format, request));
        setText(told, 'Saved.');
      } catch (error) {
        setText(told, messageOf(error));
      }
    };
    return [
      h('h3', {}, 'The rig in its own window'),
      h('p', { class: 'caption' }, 'For a second screen, a projector or a tablet: it plays in step.'),
      h('p', { class: 'caption' }, 'Its sliders move this page too: anyone with the link can use them.'),
      link,
      h(
        'div',
        { class: 'row' },
        button(
          {
            'data-testid': 'open-window',
            onclick: () => open(address, '_blank', 'popup,width=1100,height=760,noopener'),
          },
          'Open',
        ),
        button({ 'data-testid': 'copy-window-link', onclick: copy }, 'Copy link'),
      ),
      h('h3', {}, 'Take the motion away'),
      h(
        'div',
        { class: 'row' },
        button(
          {
            title: 'One file that plays in any browser, without a network',
            'data-testid': 'save-motion-html',
            onclick: () => save('html'),
          },
          '3D page',
        ),
        button(
          {
            title: 'Viser’s own recording',
            'data-testid': 'save-motion-viser',
            onclick: () => save('viser'),
          },
          h('span', { translate: 'no' }, '.viser'),
        ),
      ),
      told,
    ];
  };
  return popupButton({
    label: 'The rig in its own window, or its motion as a file',
    text: arrow(),
    testid: 'scene-menu',
    content,
  });
}
