// A log that is flown again at once, and judged by its own states.
import { scriptOf } from '../../static/flight/log.js';
import { LOG } from '../../static/kernel/index.js';

/** The craft behind its last tick, and how far it has been from what the log tells, rad and rad/s. */
export async function flownAgain(log, designs) {
  const script = await scriptOf(log, designs);
  const craft = script.begun();
  while (!craft.ended) {
    script.act(craft);
    if (craft.tick >= log.ticks) break;
    const ticks = Math.min(Math.max(script.until(craft), craft.tick + 1), log.ticks) - craft.tick;
    craft.settle();
    craft.fly(craft.waiting ? Math.min(ticks, craft.untilSample) : ticks);
  }
  const apart = script.apart(craft);
  if (!(apart <= LOG.AGREED)) throw new Error(`its states are ${apart} from those that its events lead to`);
  return { craft, apart };
}
