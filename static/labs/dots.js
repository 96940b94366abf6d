/** The steps of a lab as a row of dots, and behind them its end. */
import { say, t } from '../text/index.js';
import { button, h, setAttr } from '../ui/index.js';
import { pointsText } from './goals.js';

export class StepDots {
  /** @param {import('./shapes.js').Lab} lab @param {(at: number) => void} go */
  constructor({ steps }, go) {
    this.steps = steps;
    this.dots = [...steps.keys(), steps.length].map((i) =>
      button(
        { class: 'dot', 'data-testid': `lab-step-${i + 1}`, onclick: () => go(i) },
        i < steps.length ? String(i + 1) : '⚑',
      ),
    );
    this.node = h('div', { class: 'dots', role: 'group', 'aria-label': 'Steps' }, this.dots);
  }

  /**
   * @param {ReturnType<typeof import('./verdict.js').progressOf>[]} reached of each step
   * @param {number} at the one that is shown
   */
  render(reached, at) {
    this.dots.forEach((dot, i) => {
      const own = this.steps[i];
      const { done = false, tried = false, points = 0 } = reached[i] ?? {};
      dot.classList.toggle('done', done);
      dot.classList.toggle('tried', tried && !done);
      setAttr(
        dot,
        'aria-label',
        !own
          ? t('The end')
          : tried
            ? say`Step ${i + 1}: ${own.title}, ${pointsText(points)} of ${pointsText(own.points)} points`
            : say`Step ${i + 1}: ${own.title}`,
      );
      setAttr(dot, 'title', own?.title ?? t('The end'));
      if (i === at) dot.setAttribute('aria-current', 'step');
      else dot.removeAttribute('aria-current');
    });
  }
}
