// `tsc` over static/ as tsconfig.json says, with one difference: what the page imports from static/vendor has the types
// of its npm package, so that neither the copy itself is checked nor the check needs it to be there.
import { readFileSync } from 'node:fs';
import { relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { API } from 'typescript/unstable/sync';

const root = fileURLToPath(new URL('../..', import.meta.url));
const VENDORED = /\/static\/vendor\/(?!node_modules)([^/]+)(?:\/[^/]+)?$/;
const DECLARED = /\/static\/vendor\/(?!node_modules)([^/]+)\/[^/]+\.d\.ts$/;

/** Beside each file of static/vendor TypeScript sees one of declarations: its package's. */
const fs = {
  directoryExists: (path) => VENDORED.test(path) || undefined,
  fileExists: (path) => DECLARED.test(path) || undefined,
  readFile: (path) =>
    DECLARED.exec(path)
      ?.slice(1)
      .map((name) => `import own from '${name}';\nexport default own;\n`)[0],
};

/** A complaint as editors link it, with what led to it. */
function told({ fileName, pos, code, text, messageChain = [] }) {
  const lines = fileName ? readFileSync(fileName, 'utf8').slice(0, pos).split('\n') : [];
  const place = fileName ? `${relative(root, fileName)}:${lines.length}:${lines.at(-1).length + 1} ` : '';
  return `${place}TS${code}: ${reasons(text, messageChain).join('\n')}`;
}

const reasons = (text, chain, depth = 0) => [
  `${'  '.repeat(depth)}${text}`,
  ...(chain ?? []).flatMap((next) => reasons(next.text, next.messageChain, depth + 1)),
];

const api = new API({ cwd: root, fs });
const [{ program, rootFiles }] = api.updateSnapshot({ openProjects: [`${root}tsconfig.json`] }).getProjects();
const found = [
  program.getConfigFileParsingDiagnostics(),
  program.getProgramDiagnostics(),
  program.getSyntacticDiagnostics(),
  program.getGlobalDiagnostics(),
  program.getSemanticDiagnostics(),
].flat();
api.close(); // its process may say "context canceled" as it ends
if (found.length) console.error([...new Set(found.map(told))].join('\n'));
else console.log(`${rootFiles.length} files, no complaint`);
process.exitCode = found.length ? 1 : 0;
