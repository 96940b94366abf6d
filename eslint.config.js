// ESLint of the page: the recommended rules, and which room may import from which.
import js from '@eslint/js';
import globals from 'globals';

/** The page's rooms, floor by floor: a module imports from rooms on floors below alone, and through their index.js. */
const FLOORS = [
  ['text'],
  ['model', 'net'],
  ['ui', 'link', 'kernel'],
  ['charts'],
  ['rigs', 'markdown', 'bodies'],
  ['plots', 'splane', 'scene', 'recordings', 'explore', 'exports', 'panels'],
  ['paper', 'compare', 'rig', 'machine', 'clouds', 'plant', 'labs'],
  ['finder', 'nearest', 'optimal', 'wall', 'maps', 'tracks'],
  ['flight'],
  ['further'],
  ['scorm'],
];
const TOP = ['static/main.js', 'static/class.js', 'static/api_docs.js', 'static/lti/launch.js'];

/** No room but these may be imported from a folder, whose modules begin their imports with `up`. */
function doors(rooms, up) {
  const others = rooms.length ? `(?!(?:${rooms.join('|')})/index\\.js$)` : '';
  const regex = `^${up}(?:(?!vendor/)${others})[^.].*`;
  const message = 'Rooms import from floors below, through their index.js (FLOORS in eslint.config.js).';
  return {
    'no-restricted-imports': ['error', { patterns: [{ regex, message }] }],
    'no-restricted-syntax': [
      'error',
      { selector: `ImportExpression > Literal[value=/${regex.replaceAll('/', '\\/')}/]`, message },
    ],
  };
}

const rooms = FLOORS.flatMap((floor, k) =>
  floor.map((room) => ({
    files: [`static/${room}/*.js`],
    rules: doors(FLOORS.slice(0, k).flat(), '\\.\\./'),
  })),
);

export default [
  { ignores: ['static/vendor/'] },
  js.configs.recommended,
  { files: ['static/**'], languageOptions: { globals: globals.browser } },
  { files: ['tests/**', 'eslint.config.js'], languageOptions: { globals: globals.node } },
  {
    rules: {
      eqeqeq: 'error',
      'no-var': 'error',
      'prefer-const': ['error', { destructuring: 'all', ignoreReadBeforeAssign: true }],
      'no-unused-vars': ['error', { argsIgnorePattern: '^_', varsIgnorePattern: '^_' }],
    },
  },
  {
    files: ['static/**/*.js'],
    ignores: [...TOP, 'static/text/languages/*.js', ...FLOORS.flat().map((room) => `static/${room}/*.js`)],
    rules: { 'no-restricted-syntax': ['error', { selector: 'Program', message: 'In no room (eslint.config.js).' }] },
  },
  ...rooms,
  { files: TOP, rules: doors(FLOORS.flat(), '\\./') },
];
