/**
 * Where the page's pure modules can be changed in one place, and into what, by TypeScript's own parser: those that the
 * page's tests import, by themselves or through others. Called with the checkout's root; prints JSON.
 */

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, relative, resolve } from 'node:path';

const root = resolve(process.argv[2]);
const require = createRequire(join(root, 'package.json'));
const { API } = require('typescript/unstable/sync');
const ts = require('typescript/unstable/ast');
const K = ts.SyntaxKind;
const COMMENT = /\/\*.*?\*\//gs; // types are imported there
const IMPORTED = /\b(?:from|import)\s*\(?\s*['"](\.[^'"]+)['"]/g;

const OPERATORS = new Map([
  [K.PlusToken, ['-']],
  [K.MinusToken, ['+']],
  [K.AsteriskToken, ['/']],
  [K.SlashToken, ['*']],
  [K.PercentToken, ['*']],
  [K.AsteriskAsteriskToken, ['*']],
  [K.LessThanToken, ['<=', '>=']],
  [K.LessThanEqualsToken, ['<', '>']],
  [K.GreaterThanToken, ['>=', '<=']],
  [K.GreaterThanEqualsToken, ['>', '<']],
  [K.EqualsEqualsEqualsToken, ['!==']],
  [K.ExclamationEqualsEqualsToken, ['===']],
  [K.AmpersandAmpersandToken, ['||']],
  [K.BarBarToken, ['&&']],
  [K.QuestionQuestionToken, ['&&']],
  [K.PlusEqualsToken, ['-=']],
  [K.MinusEqualsToken, ['+=']],
  [K.AsteriskEqualsToken, ['/=']],
  [K.SlashEqualsToken, ['*=']],
]);
const BOUNDARIES = new Set(['<', '<=', '>', '>=']);
const ARITHMETIC = new Set(['+', '-', '*', '/', '%', '**', '+=', '-=', '*=', '/=']);
const TWINS = {
  min: 'max',
  max: 'min',
  sin: 'cos',
  cos: 'sin',
  some: 'every',
  every: 'some',
  floor: 'ceil',
  ceil: 'floor',
};

/** The modules, relative to the root, from the tests' imports on. */
function modules() {
  const tests = join(root, 'tests/page');
  const waiting = readdirSync(tests)
    .filter((name) => name.endsWith('.test.mjs'))
    .map((name) => join(tests, name));
  const seen = new Set(waiting);
  for (const file of waiting) {
    for (const [, name] of readFileSync(file, 'utf8').replaceAll(COMMENT, '').matchAll(IMPORTED)) {
      const target = resolve(file, '..', name);
      if (seen.has(target) || !existsSync(target) || !/\.m?js$/.test(target)) continue;
      seen.add(target);
      waiting.push(target);
    }
  }
  return waiting
    .map((file) => relative(root, file))
    .filter((name) => name.startsWith('static/'))
    .sort();
}

/** The changes of one module of TypeScript's program. */
function sitesOf(name, program) {
  const file = program.getSourceFile(join(root, name));
  const found = [];
  const add = (start, end, news, kind, scope) => {
    for (const change of news) found.push({ start, end, new: change, kind, scope });
  };
  const whole = (node, news, kind, scope) => add(node.getStart(file), node.end, news, kind, scope);
  const isText = (node) => ts.isStringLiteralLikeNode(node) || ts.isTemplateExpression(node);

  function visit(node, scope) {
    if (ts.isThrowStatement(node) || ts.isImportDeclaration(node) || ts.isTypeNode(node)) return;
    if (ts.isBinaryExpression(node) && !isText(node.left) && !isText(node.right)) {
      const token = node.operatorToken;
      for (const change of OPERATORS.get(token.kind) ?? []) {
        const old = token.getText(file);
        const kind = ARITHMETIC.has(old)
          ? 'arithmetic'
          : BOUNDARIES.has(old) && change.replace('=', '') === old.replace('=', '')
            ? 'boundary'
            : /[&|?]/.test(old)
              ? 'boolean'
              : 'comparison';
        whole(token, [change], kind, scope);
      }
    }
    if (ts.isPrefixUnaryExpression(node) && (node.operator === K.ExclamationToken || node.operator === K.MinusToken)) {
      add(node.getStart(file), node.getStart(file) + 1, [''], 'dropped sign or not', scope);
    }
    if (ts.isPrefixUnaryExpression(node) || ts.isPostfixUnaryExpression(node)) {
      const at = ts.isPrefixUnaryExpression(node) ? node.getStart(file) : node.operand.end;
      if (node.operator === K.PlusPlusToken) add(at, at + 2, ['--'], 'arithmetic', scope);
      if (node.operator === K.MinusMinusToken) add(at, at + 2, ['++'], 'arithmetic', scope);
    }
    if (ts.isNumericLiteral(node)) {
      const value = Number(node.text);
      const news = Number.isInteger(value) && value < 20 ? [value + 1, value - 1] : [2 * value, value / 2];
      whole(
        node,
        news.map((n) => (n < 0 ? `(${n})` : `${n}`)),
        'constant',
        scope,
      );
    }
    if (node.kind === K.TrueKeyword) whole(node, ['false'], 'constant', scope);
    if (node.kind === K.FalseKeyword) whole(node, ['true'], 'constant', scope);
    if (ts.isPropertyAccessExpression(node) && Object.hasOwn(TWINS, node.name.text)) {
      whole(node.name, [TWINS[node.name.text]], 'function', scope);
    }
    if (ts.isReturnStatement(node) && node.expression && node.expression.kind !== K.NullKeyword) {
      whole(node.expression, ['undefined'], 'return', scope);
    }
    const test =
      ts.isIfStatement(node) || ts.isWhileStatement(node)
        ? node.expression
        : ts.isConditionalExpression(node)
          ? node.condition
          : undefined;
    if (test && (ts.isIdentifier(test) || ts.isPropertyAccessExpression(test) || ts.isCallExpression(test))) {
      whole(test, [`!(${test.getText(file)})`], 'condition', scope);
    }
    const own =
      node.name &&
      ts.isIdentifier(node.name) &&
      (ts.isFunctionLikeDeclaration(node) ||
        ts.isClassDeclaration(node) ||
        (ts.isVariableDeclaration(node) && node.parent.parent.parent === file));
    node.forEachChild((child) => visit(child, own ? `${scope}.${node.name.text}`.replace(/^\./, '') : scope));
  }
  visit(file, '');
  return found;
}

const api = new API({ cwd: root });
const [{ program }] = api.updateSnapshot({ openProjects: [join(root, 'tsconfig.json')] }).getProjects();
const found = Object.fromEntries(modules().map((name) => [name, sitesOf(name, program)]));
api.close();
process.stdout.write(JSON.stringify(found));
