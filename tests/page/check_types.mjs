// `tsc` over static/ as tsconfig.json says, with one difference: what the page imports from static/vendor has the types
// of its npm package, so that neither the copy itself is checked nor the check needs it to be there.
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const VENDOR = /^[./]+\/vendor\/([^/]+)\/.+$/;

const root = fileURLToPath(new URL('../..', import.meta.url));
const { config, error } = ts.readConfigFile(`${root}tsconfig.json`, ts.sys.readFile);
const { fileNames, options, errors } = ts.parseJsonConfigFileContent(config, ts.sys, root);
const host = ts.createCompilerHost(options);
host.resolveModuleNameLiterals = (names, file) =>
  names.map(({ text }) => ts.resolveModuleName(text.replace(VENDOR, '$1'), file, options, host));
const program = ts.createProgram(fileNames, options, host);
const found = [...(error ? [error] : []), ...errors, ...ts.getPreEmitDiagnostics(program)];
if (found.length) console.error(ts.formatDiagnosticsWithColorAndContext(found, host));
else console.log(`${fileNames.length} files, no complaint`);
process.exitCode = found.length ? 1 : 0;
