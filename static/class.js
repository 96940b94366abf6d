/** Wires the instructor's page: its address to what is shown. */
import { languageOf, loadWords, t, translatePage } from './text/index.js';
import { byId, h, setText } from './ui/index.js';
import { hashOf, JoinSheet, keep, keptClass, Maker, placeOf, Wall } from './wall/index.js';

const language = languageOf(location.search, navigator.languages);
if (await loadWords(language)) translatePage(document, language);

const content = byId('content');
const told = byId('told');
/** @type {Wall|null} */ let wall = null;
/** @type {JoinSheet|null} */ let sheet = null;

byId('head').append(
  h(
    'nav',
    { 'aria-label': 'Pages' },
    h('a', { href: '#', 'data-testid': 'to-classes' }, 'Classes'),
    h('a', { href: './', 'data-testid': 'to-instrument' }, 'The instrument'),
  ),
);

/** @param {string} words @param {boolean} [bad] */
function tell(words, bad = false) {
  told.classList.toggle('bad', bad);
  setText(told, words);
}

/** @param {string} code @param {string} key @param {boolean} masked */
const openWall = (code, key, masked) =>
  new Wall({
    code,
    key,
    masked,
    tell,
    onChange: (room) => sheet?.show(room),
    onGone: (words) => {
      leave();
      content.replaceChildren(h('p', { class: 'panel empty', 'data-testid': 'gone' }, words), new Maker(made).node);
    },
  });

/** @param {string} code */
function made(code) {
  location.hash = hashOf({ kind: 'wall', code });
}

function leave() {
  wall?.stop();
  wall = sheet = null;
  tell('');
}

function show() {
  const place = placeOf(location.hash);
  leave();
  if (place.kind !== 'new' && place.key) {
    // what is projected or mailed shall not have it
    keep({ title: '', ends: '', ...keptClass(place.code), code: place.code, key: place.key });
    history.replaceState(null, '', hashOf(place));
  }
  document.documentElement.dataset.place = place.kind;
  const known = place.kind === 'new' ? undefined : keptClass(place.code);
  if (place.kind === 'new') content.replaceChildren(new Maker(made).node);
  else if (place.kind === 'join') {
    sheet = new JoinSheet(place.code, known !== undefined);
    if (known) wall = openWall(known.code, known.key, true); // it counts who has joined
    content.replaceChildren(sheet.node);
  } else if (known) {
    wall = openWall(known.code, known.key, place.kind === 'projector');
    content.replaceChildren(wall.node);
  } else
    content.replaceChildren(
      h(
        'p',
        { class: 'panel empty', 'data-testid': 'no-key' },
        t('This browser does not have this class’ secret link. Open the link that was shown when the class was made.'),
      ),
    );
  scrollTo(0, 0);
}

document.querySelector('.skip')?.addEventListener('click', (event) => {
  event.preventDefault(); // the part behind # is ours
  content.focus();
});
addEventListener('hashchange', show);
addEventListener('online', () => wall?.feed.start());
addEventListener('pagehide', () => wall?.stop());
addEventListener('pageshow', (event) => event.persisted && show());
show();
