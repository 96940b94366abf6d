/** Recordings: what is asked of the server, words and curves, and the feed: newest file, progress, cancel. */
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { RecordingFeed } from '../../static/recordings/feed.js';
import {
  adopted,
  columnsBody,
  curves,
  fitText,
  freeAtFirst,
  guessed,
  isMapped,
  nothing,
  missingWords,
  overlayWords,
  previewWords,
  rangeOfCurves,
} from '../../static/recordings/recordings.js';
import { estimateRows } from '../../static/recordings/found.js';
import { designOf, Store } from '../../static/model/store.js';
import { MACHINE } from './presets.mjs';

const preset = {
  name: 'rig',
  title: '',
  source: '',
  rig: 'helicopter',
  parameters: { K_pp: 1, K_s: 0 },
  limits: { V_p: 24, V_y: 15 },
  poles: [-1, -2, -3, -4].map((re) => ({ re, im: 0 })),
  loops: { pitch: { kp: 1, ti: 1 }, yaw: { kp: 1, ti: 1 } },
  ...MACHINE,
  scenario: { reference: { theta: 0.1, psi: 0.2 }, duration: 3 },
};
const names = { time: 't', theta: 'a', psi: 'b', V_p: 'c', V_y: 'd' };
const preview = {
  id: 'x',
  name: 'run.csv',
  columns: Object.values(names),
  rows: 9,
  first_row: 2,
  preview: [],
  units: {},
  dialect: { separator: 'comma', decimal: 'point' },
  findings: [],
  guess: { columns: names, unit: 'deg', units: { psi: 'rad' }, time_unit: 'ms', voltage_unit: 'V', sample_time: 0.002 },
};
const found = {
  done: true,
  evaluations: 3,
  seconds: 1,
  findings: [],
  rotors: { pitch: { tau: 0, curve: 'linear', dead_zone: 0 }, yaw: { tau: 0, curve: 'linear', dead_zone: 0 } },
  friction: { pitch: { coulomb: 0 }, yaw: { coulomb: 0 } },
  estimates: [
    {
      name: 'K_pp',
      unit: 'N·m/V',
      before: 1,
      value: 1.25,
      low: 1.2,
      high: 1.3,
      noise: 0.03,
      plain: 0.02,
      adopted: 1.25,
    },
  ],
};

test('columns are asked for as the server takes them', () => {
  const columns = guessed(preview);
  assert.ok(isMapped(columns));
  const told = {
    ...names,
    unit: 'deg',
    units: { psi: 'rad' },
    voltage_unit: 'V',
    signs: { theta: 1, psi: 1 },
    offsets: { theta: 0, psi: 0 },
    decimate: 1,
  };
  assert.deepEqual(columnsBody(columns), { ...told, time_unit: 'ms' });
  const timeless = { ...columns, names: { ...names, time: '' } };
  assert.ok(!isMapped(timeless), 'without a time nothing is simulated');
  assert.match(missingWords(timeless), /sample time/);
  const sampled = { ...timeless, sample_time: 0.01 };
  assert.ok(isMapped(sampled) && missingWords(sampled) === '');
  assert.equal(columnsBody(sampled).sample_time, 0.01);
  assert.ok(!('time' in columnsBody(sampled)) && !('time_unit' in columnsBody(sampled)));
  assert.ok(!isMapped({ ...columns, names: { ...names, V_y: '' } }));
  assert.ok(!isMapped(null));
});

test('curves are in degrees, gaps stay gaps, and what runs away is cut off', () => {
  const overlay = { t: [0, 1], measured: { theta: [0, Math.PI / 18] }, simulated: { theta: [null, 100] } };
  const data = curves(overlay, 'theta');
  assert.deepEqual(
    data.map((c) => c.length),
    [2, 2, 2, 2],
  );
  assert.ok(Math.abs(data[1][1] - 10) < 1e-12);
  assert.deepEqual([data[2][0], data[3]], [null, [null, null]]);
  const [low, high] = rangeOfCurves(data);
  assert.ok(low < 0 && high > 10 && high < 20);
});

test('words', () => {
  assert.equal(fitText(98.76), 'fit 98.8 %');
  assert.equal(fitText(-500), 'fit below −100 %');
  assert.match(fitText(null), /never moves/);
  assert.match(
    overlayWords({ samples: 100, duration: 2, sample_time: 0.02, segments: 3 }),
    /100 samples in 2\.0 s, 20\.0 ms apart, 3 segments/,
  );
  assert.equal(previewWords(preview), 'run.csv: 9 rows, 5 columns, 2.00 ms apart');
  assert.deepEqual(estimateRows(found)[0], {
    name: 'K_pp',
    unit: 'N·m/V',
    before: '1',
    value: '1.250',
    width: '± 0.050',
    noise: '± 0.030',
    interval: '1.200 … 1.300',
  });
  assert.ok(!freeAtFirst(preset.parameters).includes('K_s'));
  assert.ok(freeAtFirst({ K_s: 1 }).includes('K_s'));
});

test('what was found of rotors and friction is adopted at its place, and only where it matters', () => {
  const design = designOf(preset);
  assert.deepEqual(adopted(design, found), { ...design, parameters: { K_pp: 1.25 } });
  const [thrust] = found.estimates;
  const lag = { ...thrust, name: 'rotors.yaw.tau', adopted: 0.123456789 };
  const yaw = { tau: 0.123456789, curve: 'linear', dead_zone: 0 };
  const late = { ...found, estimates: [thrust, lag], rotors: { ...found.rotors, yaw } };
  const { parameters, rotors, friction } = adopted(design, late);
  assert.deepEqual(parameters, { K_pp: 1.25 });
  assert.deepEqual(rotors, { ...found.rotors, yaw: { ...yaw, tau: 0.1234568 } });
  assert.deepEqual(friction, found.friction);
  const curved = { ...found.rotors.pitch, curve: 'quadratic', matched_at: 12.34567891 };
  const matched = adopted(design, { ...found, rotors: { ...found.rotors, pitch: curved } });
  assert.equal(matched.rotors.pitch.matched_at, 12.34568, 'another K_pp would match it elsewhere');
  assert.deepEqual(
    freeAtFirst(preset.parameters).filter((name) => name.includes('.')),
    [],
  );
});

function rigged() {
  const store = new Store();
  store.set({ presets: [preset] });
  store.load(designOf(preset));
  store.set({ recorded: { ...nothing(), preview, columns: guessed(preview) } });
  const sockets = [];
  const feed = new RecordingFeed(store, () => {
    const socket = {
      sent: [],
      closed: false,
      send(text) {
        this.sent.push(JSON.parse(text));
      },
      close() {
        this.closed = true;
      },
    };
    sockets.push(socket);
    return socket;
  });
  const tell = (socket, message) => socket.onmessage({ data: JSON.stringify(message) });
  return { store, feed, sockets, tell };
}

test('identification: progress, then the result and the rig that it belongs to', () => {
  const { store, feed, sockets, tell } = rigged();
  feed.identify(['K_pp']);
  sockets[0].onopen();
  assert.deepEqual([sockets[0].sent[0].recording, sockets[0].sent[0].free], ['x', ['K_pp']]);
  assert.ok(!('held_out' in sockets[0].sent[0]), 'how much is held out is the contract’s to say');
  tell(sockets[0], { done: false, evaluations: 2, rms: { theta: 0.1, psi: 0.1 } });
  assert.equal(store.state.recorded.progress.evaluations, 2);
  tell(sockets[0], found);
  assert.deepEqual([store.state.recorded.found.done, store.state.recorded.busy, sockets[0].closed], [true, '', true]);
  assert.equal(store.state.recorded.foundFor, store.state.design);
});

test('cancelled, nothing that still comes is shown; a lost connection is told', () => {
  const { store, feed, sockets, tell } = rigged();
  feed.identify(['K_pp']);
  feed.cancel();
  tell(sockets[0], found);
  assert.deepEqual([store.state.recorded.found, store.state.recorded.busy, sockets[0].closed], [null, '', true]);
  feed.identify(['K_pp']);
  tell(sockets[1], { status: 422, detail: 'No.', code: 'unusable_recording' });
  assert.equal(store.state.recorded.problem.detail, 'No.');
  feed.identify(['K_pp']);
  sockets[2].onclose();
  assert.match(store.state.recorded.problem.detail, /cannot be reached/);
});

test('several files become one recording, and text is read again as the user says', async () => {
  const { store, feed } = rigged();
  const asked = [];
  const before = globalThis.fetch;
  globalThis.document ??= { baseURI: 'http://127.0.0.1/' };
  globalThis.fetch = async (address, options) => {
    asked.push([
      String(address).replace(/^.*api\/v1\/|&?session=[^&]*|\?session=[^&]*$/g, ''),
      options.method,
      typeof options.body === 'string' ? JSON.parse(options.body) : null,
    ]);
    if (String(address).includes('semicolon'))
      return new Response(JSON.stringify({ detail: 'No.', field: 'file' }), { status: 422 });
    return new Response(
      JSON.stringify({ ...preview, id: `id${asked.length}`, guess: { ...preview.guess, columns: {} } }),
      { headers: { 'Content-Type': 'application/json' } },
    );
  };
  try {
    await feed.send([
      { file: new Blob(['1']), name: 'pitch.csv' },
      { file: new Blob(['2']), name: 'yaw.csv' },
    ]);
    assert.deepEqual(
      asked.map(([path]) => path),
      ['recordings?name=pitch.csv', 'recordings?name=yaw.csv', asked[2][0]],
    );
    assert.match(asked[2][0], /recordings\/join/);
    assert.deepEqual(asked[2][2], { recordings: ['id1', 'id2'] });
    assert.equal(store.state.recorded.preview.id, 'id3');
    await feed.send([{ file: new Blob(['1']), name: 'run.csv' }]);
    assert.deepEqual(feed.dialect(store.state.recorded), preview.dialect);
    await feed.reread({ separator: 'semicolon' });
    assert.match(asked.at(-1)[0], /name=run\.csv&separator=semicolon/);
    assert.deepEqual(
      feed.dialect(store.state.recorded),
      { separator: 'semicolon', decimal: '' },
      'still to be chosen where nothing was read',
    );
  } finally {
    globalThis.fetch = before;
  }
});
