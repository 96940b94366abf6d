// Tasks as the page flies and scores them, under Python's eyes: {preset, part, task, seed, hands} in a line of stdin;
// the answer is the log, the page's values and stars, and where the design alone would be at the end.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { Alone } from '../../static/flight/beside.js';
import { Flight } from '../../static/flight/flight.js';
import { planOf, rigOf, Scoring } from '../../static/flight/scoring.js';
import { compiled, Flights, instantiated, MODULE, TASKS } from '../../static/kernel/index.js';
import { designOf, Store } from '../../static/model/index.js';

const flights = new Flights(await instantiated(await compiled(readFileSync(MODULE))));

async function flown({ preset, part, task: name, seed, hands }) {
  const store = new Store();
  store.set({ presets: [preset] });
  store.load({ ...designOf(preset), ...part });
  const { design } = store.state;
  const rig = rigOf(design, preset);
  const task = TASKS.find((own) => own.name === name);
  let wall = 1000;
  const flight = new Flight(store, flights, { now: () => 0 });
  const scoring = new Scoring(task, rig);
  flight.addEventListener('frame', ({ detail }) => {
    scoring.put(detail, flight.craft.hands);
    if (scoring.done) flight.end();
  });
  const plan = [{ time: 0, event: () => ['reference', rig.theta0, 0] }, ...planOf(task, rig, seed)];
  const still = { ...design, scenario: { ...design.scenario, reference: { theta: rig.theta0, psi: 0 } } };
  await flight.start({ task: name, seed, plan, design: still });
  const alone = new Alone(flights, flight.craft.aboard, task, rig, seed);
  for (let n = 0; flight.state.mode === 'flying' && n < 60 * 60; n++) {
    const { time } = flight.craft;
    const asked = scoring.asked(time);
    if (!hands && asked && n % 3 === 0) flight.do('reference', ...asked);
    if (hands && n === 200) flight.do('hands', 1);
    if (hands && n === 300) flight.do('hands', 0);
    flight.frame((wall += 1000 / 60));
  }
  alone.to(task.duration + 0.1, Infinity); // a row lasts until the next one
  return { log: flight.log(), values: scoring.values, stars: scoring.stars, alone: alone.scoring.values };
}

for await (const line of createInterface({ input: process.stdin }))
  process.stdout.write(`${JSON.stringify(await flown(JSON.parse(line)))}\n`);
