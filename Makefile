# Every target sets up what it needs first (.ci/setup), which takes no time once that is there.
VENV_PYTHON := .venv/bin/python
SCENE ?= cornell-box
OUT ?= lightmeter-out/$(SCENE)
ARGS ?=

.PHONY: help setup compare test lint format bench doctor

help: ## what can be made
	@sed -n 's/^\([a-z]*\):.*## /  make \1\t/p' Makefile

setup: ## the virtual environment and the system's libraries
	@bash .ci/setup

compare: setup ## a real-time frame against the truth (SCENE=…, OUT=…, ARGS=…)
	@$(VENV_PYTHON) -m lightmeter compare $(SCENE) -o $(OUT) $(ARGS)
	@ls "$(abspath $(OUT))/report.html"

test: ## the tests (ARGS=… goes to pytest)
	@bash .ci/setup test
	@$(VENV_PYTHON) -m pytest -n auto --maxprocesses 4 --dist loadfile $(ARGS)

lint: ## ruff, import-linter, pyright
	@bash .ci/setup lint
	@bash .ci/lint

format: ## let ruff lay the code out
	@bash .ci/setup lint
	@$(VENV_PYTHON) -m ruff check --fix
	@$(VENV_PYTHON) -m ruff format

bench: ## speed, beside VTK and flip-evaluator
	@bash .ci/setup bench test
	@$(VENV_PYTHON) benchmarks/run.py $(ARGS)

doctor: setup ## what this machine has and lacks
	@$(VENV_PYTHON) -m lightmeter doctor
