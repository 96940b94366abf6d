// A picture as SVG is what the canvas would have been asked for.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { svgOf, VectorContext } from '../../static/plots/vector.js';

const widthOf = (text) => 6 * text.length;
const PICTURE = {
  title: 'Pitch θ & <more>',
  subtitle: 'rig "A"',
  x: { range: [0, 2], title: 'Time in s' },
  y: { range: [-1, 1], title: 'θ in degrees' },
  lines: [
    { name: 'pitch step', kind: 'pitch', t: [0, 1, 2], values: [0, 1, -1] },
    { name: 'linear', kind: 'pitch', linear: true, t: [0, 1, 2], values: [0, NaN, 0.5] },
  ],
  rules: [{ value: 0.5, label: 'limit', danger: true }],
  marks: [{ kind: 'peak', axis: 'theta', t: 1, value: 1, brief: '1.0°' }],
};

test('curves stand where the axes say, with gaps where there is no value', () => {
  const svg = svgOf([PICTURE], widthOf);
  // 64…780 px for 0…2 s, 46…400 px for 1…−1
  assert.match(svg, /d="M64 223L422 46L780 400" fill="none" stroke="#b94a2c" stroke-width="2.4"/);
  assert.match(svg, /d="M64 223M780 134\.5" fill="none" [^>]*stroke-dasharray="7 4"/);
  assert.match(svg, /<text x="422" y="[\d.]+" [^>]*text-anchor="middle" fill="#18222a">Time in s<\/text>/);
  assert.match(svg, /<text transform="matrix\(0 -1 1 0 [\d.]+ 223\)"[^>]*>θ in degrees</);
  assert.match(svg, />limit<\/text>/);
});

test('what is text cannot be markup', () => {
  const svg = svgOf([{ ...PICTURE, subtitle: '</svg><script>\u0000' }], widthOf);
  assert.ok(!svg.includes('<script') && !svg.includes('\u0000') && !svg.includes('<more>'));
  assert.match(svg, /Pitch θ &#38; &#60;more&#62;/);
});

test('several pictures stand below one another and their clips keep apart', () => {
  const svg = svgOf([PICTURE, PICTURE], widthOf);
  const names = [...svg.matchAll(/clipPath id="([^"]+)"/g)].map(([, id]) => id);
  assert.ok(names.length >= 2 && new Set(names).size === names.length);
  for (const [, used] of svg.matchAll(/url\(#([^)]+)\)/g)) assert.ok(names.includes(used), used);
  assert.match(svg, /viewBox="0 0 800 952"/); // 450 and a legend's line of 20, twice, and what is between
  assert.match(svg, /translate\(0 482\)/);
});

test('transforms, clips and styles are kept and given back', () => {
  const context = new VectorContext('p', widthOf);
  context.save();
  context.translate(10, 20);
  context.rotate(-Math.PI / 2);
  context.strokeStyle = 'red';
  context.beginPath();
  context.rect(0, 0, 5, 5);
  context.clip();
  context.beginPath();
  context.lineTo(1, 2);
  context.lineTo(3, 4);
  context.stroke();
  context.restore();
  context.globalAlpha = 0.5;
  context.fillRect(0, 0, 1, 1);
  const [clip, stroked, filled] = context.parts;
  assert.match(clip, /<clipPath id="p-clip-1"><path d="M10 20L10 15L15 15L15 20Z"/);
  assert.match(stroked, /d="M12 19L14 17" .*stroke="red".*clip-path="url\(#p-clip-1\)"/);
  assert.match(filled, /d="M0 0L1 0L1 1L0 1Z" fill="#000" fill-opacity="0.5"\/>/);
  assert.equal(context.measureText('abc').width, 18);
});

test('a mark is round on pitch’s curve', () => {
  assert.match(svgOf([PICTURE], widthOf), /d="M417 46A5 5 0 0 1 427 46A5 5 0 0 1 417 46Z"/);
});
