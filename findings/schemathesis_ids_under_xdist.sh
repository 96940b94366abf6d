#!/bin/sh
# Schemathesis, pytest 9.2 and pytest-xdist: with --dist loadfile only one operation of an API is tested, and all is
#   green.
#
# One expects: @schema.parametrize() makes a test per operation, "test_api[GET /a]", "test_api[GET /b]" …, and all of
#   them run.
# What happens: from pytest 9.2 on they share the id "test_api". One process runs them all, but xdist's loadfile (and
#   loadscope) keeps its work by id: the first is run alone, "1 passed", exit status 0. With pytest 9.1.1 all are run.
# Seen with: schemathesis 4.32.5, pytest 9.1.1 and 9.2.0, pytest-xdist 3.8.0.
# Why it matters: an update of pytest took most of an API's tests away and made the suite faster. Check in
#   pytest_collection_modifyitems that no id is there twice.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
cat > "$folder/test_api.py" <<'EOF'
import schemathesis

ok = {"get": {"responses": {"200": {"description": "fine"}}}}
paths = {path: ok for path in ("/a", "/b", "/c")}
schema = schemathesis.openapi.from_dict({"openapi": "3.1.0", "info": {"title": "rig", "version": "1"}, "paths": paths})


@schema.parametrize()
def test_api(case):
    with open("called", "a") as file:
        file.write(case.path + "\n")
EOF
cd "$folder"
called() { # the pytest arguments given; prints what was called, once each
    rm -f called
    "$folder/venv/bin/python" -m pytest -q "$@" test_api.py > log 2>&1 || { cat log; exit 1; }
    sort -u called | tr '\n' ' '
}
for version in 9.1.1 9.2.0; do
    "$folder/venv/bin/pip" install --quiet schemathesis==4.32.5 pytest==$version pytest-xdist==3.8.0
    ids=$("$folder/venv/bin/python" -m pytest -q --collect-only test_api.py | grep '::' | sort -u | wc -l)
    alone=$(called)
    together=$(called -n 1 --dist loadfile)
    echo "pytest $version: $ids different ids; alone: $alone; with -n 1 --dist loadfile: $together"
    [ "$alone" = "/a /b /c " ]
    case $version in
        9.1.1) [ "$ids" -eq 3 ] && [ "$together" = "/a /b /c " ] ;;
        9.2.0) [ "$ids" -eq 1 ] && [ "$together" = "/a " ] ;;
    esac
done
