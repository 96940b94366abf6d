import assert from 'node:assert/strict';
import { test } from 'node:test';
import { RigKeeper } from '../../static/scene/rig_keeper.js';

/** A keeper, what its server was told, and what waits for its time. The server answers when `answer` says so. */
function keeper() {
  /** @type {string[]} */ const told = [];
  /** @type {((fails?: boolean) => Promise<void>)[]} */ const open = [];
  /** @type {{act: () => void, delay: number}[]} */ const later = [];
  const put = (/** @type {string} */ rig) => {
    told.push(rig);
    return new Promise((resolve, reject) =>
      open.push(async (fails = false) => {
        if (fails) reject(new Error('no answer'));
        else resolve(undefined);
        await settle();
      }),
    );
  };
  const it = new RigKeeper(put, (act, delay) => later.push({ act, delay }));
  return {
    it,
    told,
    later,
    answer: (/** @type {boolean} */ fails = false) => /** @type {any} */ (open.shift())(fails),
  };
}

const settle = () => new Promise((resolve) => setImmediate(resolve));

test('a rig is told once, and the caller waits for the answer', async () => {
  const { it, told, later, answer } = keeper();
  let done = false;
  it.want('aero').then(() => {
    done = true;
  });
  await settle();
  assert.deepEqual([told, done], [['aero'], false]);
  await answer();
  assert.deepEqual([told, done, later.length], [['aero'], true, 0]);
});

test('what the server did not hear is told again, ever later, until it is heard', async () => {
  const { it, told, later, answer } = keeper();
  it.want('aero');
  const delays = [];
  for (let k = 0; k < 9; k++) {
    await answer(true);
    assert.equal(later.length, 1);
    const [{ act, delay }] = later.splice(0);
    delays.push(delay);
    act();
  }
  await answer();
  assert.equal(later.length, 0);
  assert.deepEqual(told, Array(10).fill('aero'));
  assert.ok(delays[0] >= 375 && delays[0] <= 625, `${delays[0]}`);
  assert.ok(delays[4] > 4 * delays[0], `${delays}`);
  assert.ok(Math.max(...delays) <= 37_500, `${delays}`);
});

test('wishes do not overtake one another: one is under way, and the newest follows', async () => {
  const { it, told, later, answer } = keeper();
  it.want('helicopter');
  it.want('aero');
  it.want('helicopter');
  it.want('aero-2');
  await settle();
  assert.deepEqual(told, ['helicopter']);
  await answer(true); // its failure is nobody's loss
  assert.deepEqual(told, ['helicopter', 'aero-2']);
  await answer();
  assert.deepEqual([told.length, later.length], [2, 0]);
});

test('a scene that was built anew is told its rig; before there is one, nothing is', async () => {
  const { it, told, answer } = keeper();
  it.again();
  await settle();
  assert.deepEqual(told, []);
  it.want('aero');
  await answer();
  it.again();
  await settle();
  assert.deepEqual(told, ['aero', 'aero']);
});
