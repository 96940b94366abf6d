/** The way from a step to its flight, and what of it is handed in. */
import { say, t } from '../text/index.js';
import { button, h, setText } from '../ui/index.js';
import { flightOf } from './flights.js';

export class FlyLine {
  /** @param {() => void} fly */
  constructor(fly) {
    this.fly = button(
      {
        class: 'primary',
        'data-testid': 'lab-fly',
        title: 'In the view Fly, with the design that you have',
        onclick: fly,
      },
      'Fly it',
    );
    this.words = h('p', { role: 'status', 'data-testid': 'lab-flight' });
    this.node = h('div', { class: 'lab-fly', hidden: true }, this.fly, this.words);
  }

  /**
   * @param {import('./shapes.js').Step|undefined} step
   * @param {import('./flights.js').StepFlights} flights
   */
  render(step, flights) {
    const asked = flightOf(step);
    this.node.hidden = !asked;
    if (!asked) return;
    const { best, changed, stale } = flights;
    const hands = asked.hands === 'on' ? ` ${t('With hands on: the controller is off.')}` : '';
    const own = best
      ? say`Your best flight, ${best.log.checksum}, will be handed in with this design.`
      : stale
        ? t('Your flight was with another design: fly it with this one.')
        : `${t('Not flown yet.')}${hands}`;
    const lost = t('The design was changed in the air, so the last flight does not count.');
    setText(this.words, changed ? `${lost} ${own}` : own);
  }
}
