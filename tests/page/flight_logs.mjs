// The page's flights under Python's eyes. Per line of stdin a JSON object; the answer is one line.
//   {preset, parts}: parts of designs; answers the bodies that a log keeps of them, and of those that the page's kernel
//     knows the numbers (others: null), as base64 of float64.
//   {preset, parts, numbers, seed, frames, plan}: flies the first part's design by these frames, each of them a list of
//     what is done before it: [word, …values], ['part', n], ['rewind', s], ['speed', x], ['freeze'], ['go'] or
//     ['wait', ms]; `numbers` are the server's for the bodies that the page does not know. Answers the log, all rows
//     and takeovers, and how far a replay of the log is from its own states.
//   {log}: what the page says of a log: its checksum, or why it takes it not.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { bodyOfFlight, Designs } from '../../static/flight/designs.js';
import { checksum } from '../../static/flight/checksum.js';
import { Flight } from '../../static/flight/flight.js';
import { readLog } from '../../static/flight/log.js';
import { compiled, Flights, instantiated, MODULE, ROW } from '../../static/kernel/index.js';
import { designOf, Store } from '../../static/model/index.js';
import { flownAgain } from './flown_again.mjs';

const FRAME_MS = 1000 / 60;
const flights = new Flights(await instantiated(await compiled(readFileSync(MODULE))));

const base64 = (floats) => Buffer.from(floats.buffer, floats.byteOffset, floats.byteLength).toString('base64');
const floats = (text) => new Float64Array(Uint8Array.from(Buffer.from(text, 'base64')).buffer);

function bodies({ preset, parts }) {
  const designs = new Designs(flights, () => [preset]);
  const all = parts.map((part) => bodyOfFlight({ ...designOf(preset), ...part }, [preset]));
  const numbers = all.map((body) => designs.here(body)?.controller.numbers);
  return {
    bodies: all,
    texts: all.map((body) => JSON.stringify(body)),
    numbers: numbers.map((own) => own && base64(own)),
  };
}

/** A course as it was shown, without what was taken back. */
class Shown {
  ticks = [];
  rows = [];

  put({ rows, count, firstTick }) {
    for (let i = 0; i < count; i++) {
      this.ticks.push(firstTick + i);
      this.rows.push(rows.slice(i * ROW.FLIGHT_ROW, (i + 1) * ROW.FLIGHT_ROW));
    }
  }

  cut(tick) {
    const kept = this.ticks.findIndex((own) => own >= tick);
    if (kept >= 0) this.ticks.length = this.rows.length = kept;
  }

  get whole() {
    const all = new Float64Array(this.rows.length * ROW.FLIGHT_ROW);
    this.rows.forEach((row, n) => all.set(row, n * ROW.FLIGHT_ROW));
    return all;
  }
}

async function flown({ preset, parts, numbers, seed, frames, plan }) {
  const store = new Store();
  const designs = parts.map((part) => ({ ...designOf(preset), ...part }));
  store.set({ presets: [preset] });
  store.load(designs[0]);
  const ask = async (body) => floats(numbers[JSON.stringify(body)]);
  const flight = new Flight(store, flights, { ask, now: () => 0 });
  const shown = new Shown();
  flight.addEventListener('frame', ({ detail }) => shown.put(detail));
  flight.addEventListener('cut', ({ detail }) => shown.cut(detail.tick));
  const planned = plan.map(({ time, event }) => ({ time, event: () => event }));
  await flight.start({ seed, task: 'any', plan: planned });
  let now = 1000;
  for (const frame of frames) {
    for (const [word, ...values] of frame) {
      if (word === 'part') store.restore(designs[values[0]]);
      else if (word === 'rewind') flight.rewind(values[0]);
      else if (word === 'speed') flight.setSpeed(values[0]);
      else if (word === 'freeze') flight.freeze();
      else if (word === 'go') flight.go();
      else if (word === 'wait') now += values[0];
      else flight.do(word, ...values);
    }
    now += FRAME_MS;
    flight.frame(now);
    await null; // for answers of the server
    await null;
    await null;
  }
  const log = flight.log();
  if (!log) return { log };
  const again = await flownAgain(readLog(JSON.stringify(log)), new Designs(flights, () => [preset], ask));
  return {
    log,
    ticks: shown.ticks.length,
    inOrder: shown.ticks.every((tick, n) => tick === n),
    rows: base64(shown.whole),
    takeovers: flight.craft.takeovers,
    ended: flight.state.why,
    problem: flight.state.problem,
    again: [again.apart, ...again.craft.check.map((own, n) => own - flight.craft.check[n])],
  };
}

function judged({ log }) {
  try {
    readLog(log);
    return { refused: null };
  } catch (problem) {
    return { refused: problem.constructor.name, message: problem.message };
  }
}

const answer = async (question) => {
  if ('log' in question) return judged(question);
  if ('sums' in question) return question.sums.map(checksum);
  return 'frames' in question ? flown(question) : bodies(question);
};

for await (const line of createInterface({ input: process.stdin }))
  console.log(JSON.stringify(await answer(JSON.parse(line))));
