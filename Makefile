# Everything that a reader, a lecturer or a developer needs. `make help` lists it.
# Paths are relative on purpose: this folder may lie anywhere, also where names have spaces.

PY    := .venv/bin/python
READY := .venv/ready
# Every page anew: pages that were built before would keep their warnings to themselves.
BUILD := .venv/bin/jupyter-book build . --all -W -n --keep-going --quiet
# Tests on every core, those of one file on the same: they share a browser, a kernel, or what was compiled.
SIDE_BY_SIDE := -n auto --dist loadfile
PORT  ?= 8000

# The first of these that is new enough. Looked for only when .venv has to be made.
NEW_ENOUGH = import sys; sys.exit(sys.version_info < (3, 11))
PYTHON ?= $(firstword $(foreach name,python3 python3.13 python3.12 python3.11,\
            $(shell $(name) -c '$(NEW_ENOUGH)' 2>/dev/null && echo $(name))))

.DEFAULT_GOAL := help
.PHONY: help book serve lab test lint execute clean

help:  ## show this list
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "  make %-9s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

book: $(READY)  ## build the book into _build/html
	@$(PY) tools/vendor.py mathjax esbuild
	@echo "Building the book"
	@$(BUILD)

serve: book  ## build the book and show it at http://localhost:8000 (another port: make serve PORT=8001)
	@echo "The book is at http://localhost:$(PORT)/ - stop with Ctrl+C"
	@$(PY) -m http.server $(PORT) --bind 127.0.0.1 --directory _build/html

lab: $(READY)  ## open the chapters in JupyterLab, where every control is live
	@.venv/bin/jupyter trust book/*.ipynb
	@$(PY) -m jupyterlab book

test: lint  ## run every test: library, notebooks, and each page of the book in a real browser
	@$(PY) tools/vendor.py
	@$(PY) tools/browser.py
	$(PY) -m pytest $(SIDE_BY_SIDE)
	$(PY) -m pytest $(SIDE_BY_SIDE) -p tests.notebooks.strict book
	$(PY) -m pytest $(SIDE_BY_SIDE) --nbval book

lint: $(READY)  ## check style, types and the layers of the library
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	.venv/bin/lint-imports

execute: $(READY)  ## run the chapters and store their results
	$(PY) tools/execute.py

clean:  ## remove the built book and every cache, but not .venv
	rm -rf _build .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find benchmarks book rlnav tests tools -name __pycache__ -prune -exec rm -rf {} +

$(READY): requirements.txt pyproject.toml tools/setup.py
	@test -n "$(PYTHON)" || { echo "rlnav needs Python 3.11 or newer; none was found. Install it from" \
	  "https://www.python.org/downloads/ or name it: make PYTHON=/path/to/python3.12"; exit 1; }
	@"$(PYTHON)" tools/setup.py
