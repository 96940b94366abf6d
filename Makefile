# heli2dof: `make serve` starts the app, `make test` runs every test, `make help` lists the rest.
SHELL := bash
PYTHON ?= python3
PORT ?= 8000
VENV := .venv
BIN := $(VENV)/bin
IMAGE ?= heli2dof
IMAGE_BUILDER ?= docker build
BESIDE := --numprocesses=2 --dist=loadfile
# Children of the tests start as a user's do, with Python's bytecode kept.
unexport PYTHONDONTWRITEBYTECODE
PACKAGING := pyproject.toml constraints.txt package.json package-lock.json hatch_build.py
SOURCES := $(shell find app heli2dof_core static -type f -not -path '*/vendor/*' -not -name '*.pyc' 2>/dev/null)
JAVASCRIPT := static eslint.config.js 'tests/**/*.mjs'
PYTEST = CHROMIUM=$(CHROMIUM) $(BIN)/pytest $(BESIDE)
# Without windows (chromium-headless-shell, as Playwright itself prefers) the tests take two thirds of the time.
CHROMIUM ?= $(firstword $(shell command -v chromium-headless-shell chromium chromium-browser google-chrome))

.PHONY: help serve test quick check style format static-types floors types kernels unit page-test e2e steady mutation contract screenshot \
  wasm bench docs image clean browser
help: ## this list
	@grep -hE '^[a-z0-9-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

serve: $(VENV)/.installed ## build what is needed and start the app on http://127.0.0.1:$(PORT)
	@exec $(BIN)/heli2dof serve --port $(PORT)

test: $(VENV)/.tools node_modules/.installed browser ## build what the tests need and run them all
	@$(MAKE) --no-print-directory --jobs=2 --output-sync=target check page-test kernels
	@$(MAKE) --no-print-directory unit

quick: $(VENV)/.tools node_modules/.installed browser ## what is soon told: style, types, floors, laws of the core, the page's units, a page that opens
	@$(MAKE) --no-print-directory --jobs=2 --output-sync=target check page-test kernels
	@$(PYTEST) -m "not slow" tests/core tests/authorities tests/test_architecture.py tests/test_architecture_docs.py \
	  tests/e2e/test_page.py::test_gain_shown_is_the_gain_of_the_poles_shown

check: style static-types types floors ## style, types, floors

style: $(VENV)/.tools node_modules/.installed ## Ruff for Python; Prettier and ESLint for JavaScript, the page's rooms among it
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/npx prettier --cache --log-level warn --check $(JAVASCRIPT)
	@$(BIN)/npx eslint --cache --cache-location node_modules/.cache/eslint/ $(JAVASCRIPT)

format: $(VENV)/.tools node_modules/.installed ## bring all into Ruff's and Prettier's form
	@$(BIN)/ruff format .
	@$(BIN)/npx prettier --log-level warn --write $(JAVASCRIPT)

static-types: $(VENV)/.tools
	@$(BIN)/pyright

floors: $(VENV)/.tools
	@$(BIN)/lint-imports

types: $(VENV)/.tools node_modules/.installed ## the page's JSDoc types, by TypeScript
	@$(BIN)/node tests/page/check_types.mjs

kernels: $(VENV)/.tools # once, not in each process at once
	@$(BIN)/python -c 'from heli2dof_core.engine import warm_up; warm_up()'

unit: $(VENV)/.tools node_modules/.installed kernels ## the Python tests, the browser's among them, in two processes
	@$(PYTEST)

page-test: $(VENV)/.tools ## the page's pure modules
	@$(BIN)/node --test --test-reporter=dot tests/page/*.test.mjs

e2e: $(VENV)/.tools node_modules/.installed browser kernels ## the browser tests alone
	@$(PYTEST) -m browser

steady: $(VENV)/.tools node_modules/.installed browser kernels ## the browser tests beside busy processes, and with all late
	CHROMIUM=$(CHROMIUM) $(BIN)/python -m tests.steady

mutation: $(VENV)/.tools node_modules/.installed ## change the core and the page in forty places, one by one: which changes does no test see?
	$(BIN)/python -m tests.mutation --jobs 2 $(if $(SEED),--seed $(SEED))

contract: $(VENV)/.tools ## make what follows from the core and the contract: the page's figures, methods, quantities, layout, types; labs' schema; K as kernels
	$(BIN)/python -m tests.kernel_formulas
	$(BIN)/python -m tests.page_figures
	$(BIN)/python -m tests.page_flight_tasks
	$(BIN)/python -m tests.page_methods
	$(BIN)/python -m tests.page_quantities
	$(BIN)/python -m tests.page_kernel
	$(BIN)/python -m tests.page_types
	$(BIN)/python -m tests.lab_schema

wasm: $(VENV)/.tools ## make static/kernel/kernels.wasm and its table anew, from the kernels
	@command -v wasm-ld >/dev/null || $(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt '.[wasm]'
	$(BIN)/python -m wasm

screenshot: $(VENV)/.tools browser ## take the pictures of README and docs anew, draw docs/map.svg
	CHROMIUM=$(CHROMIUM) $(BIN)/python -m tests.e2e.screenshot docs/screenshot.png
	CHROMIUM=$(CHROMIUM) $(BIN)/python -m tests.e2e.wall_screenshot docs/wall.png
	CHROMIUM=$(CHROMIUM) $(BIN)/python -m tests.e2e.fly_screenshot docs/fly.png
	$(BIN)/python -m app map --poles=-12,-10,-6±3j --move yaw-pair --axis psi --force -o docs/map.svg

bench: $(VENV)/.tools ## time all against python-control and SciPy, as ratios; writes docs/performance.md
	$(BIN)/python -W ignore -m tests.bench.placement
	$(BIN)/python -W ignore -m tests.bench.maps
	$(BIN)/python -W ignore -m tests.bench.update docs/performance.md

docs: $(VENV)/.tools ## the library's reference, into build/docs
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt '.[docs]'
	$(BIN)/pdoc --docformat google --math --output-directory build/docs heli2dof_core

image: ## build the container with $(IMAGE_BUILDER)
	$(IMAGE_BUILDER) -t $(IMAGE) .

clean: ## remove what was built
	rm -rf $(VENV) node_modules static/vendor build dist

browser:
	@test -n "$(CHROMIUM)" || { echo "The browser tests need Chromium. Debian: sudo apt-get install chromium-headless-shell. \
	Elsewhere: install Chromium or Chrome and call: make test CHROMIUM=/path/to/it" >&2; exit 1; }

$(BIN)/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "heli2dof needs Python 3.11 or newer; PYTHON= names one")'
	@$(PYTHON) -m venv $(VENV)

# The real wheel, so that what is tried is what ships; all packages anew only where the packaging changed.
$(VENV)/.installed: $(SOURCES) $(PACKAGING) | $(BIN)/pip
	@echo "Installing heli2dof into $(VENV); the first time takes two minutes."
	@$(BIN)/pip install --quiet --disable-pip-version-check \
	  $(if $(filter $(PACKAGING),$?),-c constraints.txt,--no-deps --force-reinstall) '.[matlab]'
	@$(if $(filter $(PACKAGING),$?),echo "Compiling the kernels; this is done once."; $(BIN)/python -P -c 'from heli2dof_core.engine import warm_up; warm_up()')
	@touch $@

# TypeScript and axe-core, for the tests alone; what ships is fetched by hatch_build.py.
node_modules/.installed: package.json package-lock.json .npmrc | $(VENV)/.tools
	@NODE_USE_SYSTEM_CA=1 $(BIN)/npm ci --silent
	@touch $@

$(VENV)/.tools: $(PACKAGING) | $(BIN)/pip
	@echo "Installing what the tests need into $(VENV)"
	@$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt '.[test]'
	@touch $@
