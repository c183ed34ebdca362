# Everything runs in virtual environments of its own; nothing is installed elsewhere.
PYTHON ?= python3
BIN = .venv/bin
OLDEST = .venv-oldest/bin
QUIETLY = -qq --disable-pip-version-check
CASE ?= cases/zf-8hp70.yaml
# A process of pytest for each core; make test TEST_JOBS=0 runs the tests in one.
TEST_JOBS ?= logical
SOURCES := $(shell find vstatics -name '*.py')
# What pytest makes of the asserts is kept: each run would take them apart anew, in each process.
unexport PYTHONDONTWRITEBYTECODE

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

run: .venv/compiled.stamp ## show the gears of the ZF 8HP70 in one table (another case: make run CASE=file)
	@$(BIN)/vstatics run "$(CASE)" --pretty

FAST = $(BIN)/pytest -q -n $(TEST_JOBS) --dist worksteal -m "not slow"
test: .venv/dev.stamp ## the fast tests, one case of each (ALL=1: all cases; ROOM=torsion: of a room; ABOVE=1: and of what stands on it)
	@tests="$(if $(ROOM),$$($(BIN)/python -m tests.rooms $(ROOM) $(ABOVE)))" && set -x && \
	$(FAST) --cases=$(if $(ALL),all,first) $$tests

test-changed: .venv/dev.stamp ## the other cases of all that a change can break (SINCE=commit: all changes after it)
	@tests="$$($(BIN)/python -m tests.changed $(SINCE))" && set -x && \
	$(FAST) --cases=other $$tests

browser: ## install Chromium, in which the tests of pages run (Debian)
	$(if $(filter 0,$(shell id -u)),,sudo) apt-get install -y chromium

# The annexes in their order, without those that are not installed here.
ANNEXES = $(shell $(BIN)/python -c "from vstatics.core.annexes import annexes; print(*(a.name for a in annexes()))")
test-without: .venv/dev.stamp ## the fast tests of a copy without an annex (ANNEX=torsion) and what needs it
	$(BIN)/python -m tests.without $(ANNEX) -n $(TEST_JOBS)

pictures: .venv/dev.stamp ## draw the pictures of README.md and docs anew
	$(BIN)/python -m tests.documented_pictures

test-slow: ## the slow tests: test-beside, then test-alone
	$(MAKE) test-beside
	$(MAKE) test-alone

# Only files with a mark are collected for it, without doctests, which are all fast.
MARKED = $(BIN)/pytest -q -o addopts="--strict-markers --strict-config"
with_mark = $$(grep -rl --include='test_*.py' 'mark\.$(1)\|with_$(1)(' tests)
test-beside: .venv/dev.stamp ## the slow tests that others do not disturb, on all cores
	$(MARKED) -n $(TEST_JOBS) -m "slow and not alone" $(call with_mark,slow)

test-alone: .venv/dev.stamp ## the slow tests that disturb or time processes, one by one
	$(MARKED) -n 0 -m "slow and alone" $(call with_mark,alone)

# ALL=1 (each night): also the rooms whose use of other packages the tests of `cli` reach, too.
PLAIN_ROOMS := core/model core/statics core/elements simulation core/flow core/summary pictures page/report
PLAIN_TESTS := $(PLAIN_ROOMS:%=tests/%) $(PLAIN_ROOMS:%=vstatics/%) tests/published tests/oracle
test-oldest: .venv-oldest/stamp ## the fast tests with the oldest versions allowed (Python 3.11)
	$(OLDEST)/pytest -q -n $(TEST_JOBS) -m "not slow" -p no:cacheprovider \
	$(if $(ALL),,$(PLAIN_TESTS:%=--ignore=%))

# Other processors: other kernels of OpenBLAS, and NumPy without what it has for this processor.
PROCESSORS := Haswell Zen Nehalem
NUMPY_EXTENSIONS = $(shell $(BIN)/python -c "from numpy._core._multiarray_umath import __cpu_dispatch__ as own; print(*own)")
# Random tests try other and more examples; the same again: make test-random FRESH_SEED=N, or
# VSTATICS_TEST_SEED=N make test-slow.
FRESH_SEED := $(shell date +%s)
nightly: .venv/dev.stamp ## the fast tests on other processors, with the oldest versions and without each annex, more and fresh random examples
	$(foreach kind,$(PROCESSORS),OPENBLAS_CORETYPE=$(kind) $(MAKE) test ALL=1 &&) true
	NPY_DISABLE_CPU_FEATURES="$(NUMPY_EXTENSIONS)" OPENBLAS_CORETYPE=Nehalem $(MAKE) test ALL=1
	$(MAKE) test-oldest ALL=1
	$(foreach annex,$(ANNEXES),$(MAKE) test-without ANNEX=$(annex) &&) true
	$(MAKE) test-random FRESH_SEED=$(FRESH_SEED)
	VSTATICS_TEST_SEED=$(FRESH_SEED) $(MAKE) test-slow

test-random: .venv/dev.stamp ## the fast tests of random examples, with more and fresh ones
	VSTATICS_TEST_SEED=$(FRESH_SEED) $(BIN)/pytest -q -n $(TEST_JOBS) -m "hypothesis and not slow"

coverage: .venv/dev.stamp ## the fast tests, with the lines that they miss
	$(BIN)/pytest -q -m "not slow" --cov=vstatics --cov-report=term-missing

lint: .venv/dev.stamp ## ruff: lint and format
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: .venv/dev.stamp ## mypy --strict
	$(BIN)/mypy

golden: .venv/dev.stamp ## rewrite tests/golden; fails where something changed
	$(BIN)/pytest -q -n 0 tests/test_golden.py --regenerate

examples: .venv/dev.stamp ## rewrite the outputs shown in documents (PAGES="docs/ci.md README.md")
	$(BIN)/python -m tests.examples $(PAGES)

site: .venv/dev.stamp ## build the site in site/, to be read from the disk or served (two minutes)
	$(BIN)/python -m website site

schema: .venv/dev.stamp ## rewrite schemas/ from the declarations
	$(BIN)/python -m vstatics.core.cli.schemas schemas

KNOWN = vstatics/synthesis/boxes/figures/known.jsonl
known: .venv/dev.stamp ## rewrite the table of gearboxes that synth box names, from cases/
	$(BIN)/python -m vstatics.synthesis.boxes.figures.shipped $(KNOWN)

bench: .venv/dev.stamp ## measure the table of docs/performance.md (C compiler, 5 minutes; BOXES=1: the long search, too)
	$(BIN)/python -m benchmarks $(if $(BOXES),--boxes) --page docs/performance.md

SHA256 = import hashlib, pathlib, sys; [print(hashlib.sha256(pathlib.Path(name).read_bytes()).hexdigest(), "", name) for name in sys.argv[1:]]
dist: .venv/dev.stamp ## build wheel and source in dist/, with their SHA-256, and try the wheel without extras
	rm -rf dist
	$(BIN)/python -m build --outdir dist
	cd dist && ../$(BIN)/python -c '$(SHA256)' * > SHA256SUMS && cat SHA256SUMS
	$(BIN)/pytest -q -n 0 tests/test_wheel.py --wheel dist/*.whl

clean: ## remove what make has made
	rm -rf .venv .venv-oldest dist site .coverage .hypothesis .mypy_cache .pytest_cache .ruff_cache

# An environment without a pip of its own and without byte code of packages is there in half the
# time: the pip of $(PYTHON) installs into it, pip too. Where $(PYTHON) has none, venv brings it.
.venv/run.stamp: pyproject.toml
	$(PYTHON) -m venv --without-pip .venv
	$(PYTHON) -m pip --python $(BIN)/python install $(QUIETLY) --no-compile pip -e . || \
	{ $(PYTHON) -m venv .venv && $(BIN)/pip install $(QUIETLY) --no-compile -e .; }
	touch $@

# Where PYTHONDONTWRITEBYTECODE is set every start outside make would compile the package anew.
.venv/compiled.stamp: .venv/run.stamp $(SOURCES)
	$(BIN)/python -m compileall -q -j 0 vstatics
	touch $@

.venv/dev.stamp: .venv/compiled.stamp
	$(BIN)/pip install $(QUIETLY) -e ".[dev]"
	touch $@

.venv-oldest/stamp: pyproject.toml constraints-oldest.txt
	$(PYTHON) -m venv .venv-oldest
	$(OLDEST)/pip install $(QUIETLY) -e ".[dev]" -c constraints-oldest.txt
	touch $@

.DEFAULT_GOAL := help
.PHONY: help run test test-changed browser test-slow test-beside test-alone test-without test-oldest nightly test-random coverage lint types golden examples site schema known bench dist clean
