/**
 * Plain text of the server as typeset text: K_pp gets its subscript, −8.7 its minus, "Eq. 13" leads to it, and $x$ is
 * mathematics.
 */
import { h, letters, math, symbol } from '../ui/index.js';
import { anchorOf, minus } from './math.js';

const PIECE = /\$([^$]+)\$|([A-Za-zα-ωΑ-Ω])_([A-Za-z0-9]+(?:,[a-z])?)|(\b(?:Eq|Fig)\. \d+|\bTable I\b)/g;
const LETTERS = /(\p{L}\p{Mn}?)/u;
const FIRM = '\u00a0'; // a space that MathML keeps

/** Mathematics in a line: letters in italics, all else upright. @param {string} text */
const inline = (text) =>
  h(
    'span',
    { class: 'sym' },
    math(
      'math',
      {},
      ...text
        .normalize('NFD')
        .split(LETTERS)
        .flatMap((part, i) => (i % 2 ? letters(part) : part ? [math('mtext', {}, part.replaceAll(' ', FIRM))] : [])),
    ),
  );

/**
 * @param {string} text
 * @param {string} [self] the anchor where it stands, to which it need not lead
 * @returns {(Node|string)[]}
 */
export function rich(text, self) {
  /** @type {(Node|string)[]} */ const parts = [];
  let end = 0;
  for (const match of text.matchAll(PIECE)) {
    const [all, line, base, sub, place] = match;
    parts.push(minus(text.slice(end, match.index)));
    if (line) parts.push(inline(line));
    else if (base) parts.push(symbol(base, sub));
    else parts.push(anchorOf(place) === self ? all : h('a', { href: `#${anchorOf(place)}` }, all));
    end = match.index + all.length;
  }
  parts.push(minus(text.slice(end)));
  return parts;
}

/** A quantity's name. @param {string} name @returns {(Node|string)[]} */
export const named = (name) => (/^[A-Za-zα-ω]$/.test(name) ? [symbol(name)] : rich(name));
