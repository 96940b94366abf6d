/**
 * The part of Markdown that labs are written in, as a tree: headings, paragraphs, lists, quotes, tables, fenced code;
 * emphasis, code, links, formulas in `$…$` and `$$…$$`. All else is text, HTML above all: nothing of a lab's file ever
 * reaches the page but as these. Pure.
 * @typedef {{kind: 'text'|'code'|'math', text: string} | {kind: 'strong'|'em', inside: Inline[]} |
 *   {kind: 'link', to: string, inside: Inline[]} | {kind: 'break'}} Inline
 * @typedef {{kind: 'heading', level: number, inside: Inline[]} | {kind: 'paragraph', inside: Inline[]} |
 *   {kind: 'code'|'math', text: string} | {kind: 'quote', blocks: Block[]} |
 *   {kind: 'list', ordered: boolean, start: number, items: Block[][]} |
 *   {kind: 'table', head: Inline[][], rows: Inline[][][]}} Block
 */

const FENCE = /^ {0,3}(`{3,}|~{3,})\s*\S*\s*$/;
const HEADING = /^ {0,3}(#{1,6})\s+(.*?)\s*#*$/;
const QUOTE = /^ {0,3}> ?/;
const ITEM = /^( {0,3})([-*+]|\d{1,9}[.)])( +)(?=\S)/;
const RULE = /^\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)+\|?\s*$/;
/** Where a link may lead: to other pages by HTTP, and to places on this one. */
const ADDRESS = /^(https?:\/\/|#)[^\s<>"]+$/;

/** Lists and quotes within one another. */
const DEEPEST = 8;

/** At a place in the text: escaped, code, formula, link, emphasis, line break, in this order. */
const INLINE = new RegExp(
  [
    /\\([!-/:-@[-`{-~])/,
    /(`+)(?!`)([\s\S]*?[^`])\2(?!`)/,
    /\$\$([^$]+)\$\$/,
    /\$(?![\s$])((?:\\.|[^$\\])*?)(?<!\s)\$(?!\d)/,
    /\[((?:[^[\]\\]|\\.)*)\]\(([^()\s]+)\)/,
    /\*\*(?=\S)([\s\S]*?\S)\*\*(?!\*)/,
    /\*(?=[^\s*])((?:[^*]|\*\*[^*]+\*\*)*?[^\s*])\*(?!\*)/,
    /(?<![\p{L}\d_])_(?=[^\s_])([^_]*?[^\s_])_(?![\p{L}\d_])/u,
    /(?: {2,}|\\)\n/,
  ]
    .map(({ source }) => source)
    .join('|'),
  'gu',
);

/**
 * What stands in a line or paragraph.
 * @param {string} text
 * @returns {Inline[]}
 */
export function inline(text) {
  /** @type {Inline[]} */ const out = [];
  const say = (/** @type {string} */ words) => {
    const last = out.at(-1);
    if (!words) return;
    if (last?.kind === 'text') last.text += words;
    else out.push({ kind: 'text', text: words });
  };
  let at = 0;
  for (const found of text.matchAll(INLINE)) {
    const [all, escaped, , code, shown, math, link, to, strong, starred, underlined] = found;
    say(text.slice(at, found.index));
    at = found.index + all.length;
    const em = starred ?? underlined;
    if (escaped !== undefined) say(escaped);
    else if (code !== undefined) out.push({ kind: 'code', text: code.replace(/^ (.*\S.*) $/s, '$1') });
    else if (shown !== undefined || math !== undefined) out.push({ kind: 'math', text: (shown ?? math).trim() });
    else if (link !== undefined && ADDRESS.test(to)) out.push({ kind: 'link', to, inside: inline(link) });
    else if (link !== undefined) say(all);
    else if (strong !== undefined) out.push({ kind: 'strong', inside: inline(strong) });
    else if (em !== undefined) out.push({ kind: 'em', inside: inline(em) });
    else out.push({ kind: 'break' });
  }
  say(text.slice(at));
  return out;
}

/** The cells of a table's line. @param {string} line */
const cells = (line) =>
  line
    .trim()
    .replace(/^\||(?<!\\)\|$/g, '')
    .split(/(?<!\\)\|/)
    .map((cell) => inline(cell.trim().replaceAll('\\|', '|')));

/** Lines from `at` on while they are such. @param {string[]} lines @param {number} at @param {RegExp} kind */
function run(lines, at, kind) {
  let end = at;
  while (end < lines.length && kind.test(lines[end])) end += 1;
  return end;
}

/**
 * @param {string[]} lines @param {number} at where a list begins @param {number} depth
 * @returns {{block: Block, end: number}}
 */
function list(lines, at, depth) {
  const [, , mark] = /** @type {RegExpExecArray} */ (ITEM.exec(lines[at]));
  const ordered = /\d/.test(mark);
  /** @type {Block[][]} */ const items = [];
  let end = at;
  while (end < lines.length) {
    const found = ITEM.exec(lines[end]);
    if (!found || /\d/.test(found[2]) !== ordered) break;
    const width = found[0].length;
    const own = [lines[end].slice(width)];
    for (end += 1; end < lines.length; end++) {
      const line = lines[end];
      const deep = /^ */.exec(line)?.[0].length ?? 0;
      const goesOn = line.trim() ? deep >= Math.min(width, 2) : /^\s{2,}\S/.test(lines[end + 1] ?? '');
      const lazy = line.trim() && own.at(-1)?.trim() && !ITEM.test(line) && !HEADING.test(line);
      if (!goesOn && !lazy) break;
      own.push(line.slice(Math.min(deep, width)));
    }
    items.push(blocks(own, depth + 1));
    while (end < lines.length && !lines[end].trim() && ITEM.test(lines[end + 1] ?? '')) end += 1;
  }
  return { block: { kind: 'list', ordered, start: ordered ? parseInt(mark, 10) : 1, items }, end };
}

/**
 * The block that begins at a line which is not empty.
 * @param {string[]} lines @param {number} at @param {number} depth
 */
function block(lines, at, depth) {
  const line = lines[at];
  const fence = FENCE.exec(line);
  if (fence) {
    const close = new RegExp(`^ {0,3}${fence[1][0]}{${fence[1].length},}\\s*$`);
    const rest = lines.slice(at + 1);
    const length = rest.findIndex((own) => close.test(own));
    const inside = length < 0 ? rest : rest.slice(0, length);
    return { block: { kind: 'code', text: inside.join('\n') }, end: at + 2 + inside.length };
  }
  const heading = HEADING.exec(line);
  if (heading) return { block: { kind: 'heading', level: heading[1].length, inside: inline(heading[2]) }, end: at + 1 };
  if (QUOTE.test(line) && depth < DEEPEST) {
    const end = run(lines, at, QUOTE);
    const inside = lines.slice(at, end).map((own) => own.replace(QUOTE, ''));
    return { block: { kind: 'quote', blocks: blocks(inside, depth + 1) }, end };
  }
  if (ITEM.test(line) && depth < DEEPEST) return list(lines, at, depth);
  if (line.includes('|') && RULE.test(lines[at + 1] ?? '')) {
    const end = run(lines, at + 2, /\|/);
    return { block: { kind: 'table', head: cells(line), rows: lines.slice(at + 2, end).map(cells) }, end };
  }
  let end = at + 1;
  const ends = (/** @type {string} */ own) =>
    !own.trim() || [FENCE, HEADING, QUOTE].some((kind) => kind.test(own)) || /^ {0,3}(?:[-*+]|1[.)]) +\S/.test(own);
  while (end < lines.length && !ends(lines[end])) end += 1;
  const text = lines
    .slice(at, end)
    .map((own) => own.replace(/^\s+/, ''))
    .join('\n')
    .trimEnd();
  const alone = /^\$\$([^$]+)\$\$$/.exec(text);
  return {
    block: alone ? { kind: 'math', text: alone[1].trim() } : { kind: 'paragraph', inside: inline(text) },
    end,
  };
}

/** @param {string[]} lines @param {number} depth @returns {Block[]} */
function blocks(lines, depth) {
  const out = [];
  for (let at = 0; at < lines.length;) {
    if (!lines[at].trim()) {
      at += 1;
      continue;
    }
    const found = block(lines, at, depth);
    out.push(/** @type {Block} */ (found.block));
    at = found.end;
  }
  return out;
}

/** A text as a tree. @param {string} text @returns {Block[]} */
export const parse = (text) => blocks(text.replaceAll('\r\n', '\n').replaceAll('\t', '    ').split('\n'), 0);
