// Many designs by the page's module under Python's eyes. Per line of stdin a JSON object: a preset, a part of a design,
// where designs differ from it in the kernel's numbers and by what, and figures by their names. The answer is what the
// server would be asked, and what is found of each: values, whether it is stable, the loop's largest real part; null
// where the kernel does not serve.
import { readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { DesignRows } from '../../static/kernel/design_rows.js';
import { AT } from '../../static/kernel/layout.js';
import { compiled, instantiated, MODULE } from '../../static/kernel/module.js';
import { fill, serves, sizeOf } from '../../static/kernel/numbers.js';
import { designOf, evaluationOf } from '../../static/model/index.js';

const rows = new DesignRows(await instantiated(await compiled(readFileSync(MODULE))));
const told = (array) => Array.from(array, (v) => (Number.isFinite(v) ? v : String(v)));

function answer({ preset, part, at, values, measures, rigs, unstable }) {
  const design = { ...designOf(preset), ...part };
  if (!serves(design, preset)) return null;
  const numbers = new Float64Array(AT.NUMBERS);
  fill(numbers, design, preset);
  const task = {
    numbers,
    size: sizeOf(design, preset),
    at,
    values: Float64Array.from(values.flat()),
    measures,
    unstable,
  };
  const found = rows.run({ ...task, rigs: rigs && { count: rigs.length, drawn: Float64Array.from(rigs.flat()) } });
  return {
    body: evaluationOf(design),
    values: told(found.values),
    stable: [...found.stable],
    abscissa: told(found.abscissa),
  };
}

for await (const line of createInterface({ input: process.stdin }))
  console.log(JSON.stringify(answer(JSON.parse(line))));
