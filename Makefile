# make demo   set up and run the lab on a shipped MATLAB file   (ARGS=--once ends by itself)
# make setup  set up what is missing or older than its sources, as after git pull
# make test   set up and run every test, in three processes (ARGS passes options to pytest: ARGS='-m fast'
#             runs those that need no graph; ARGS='-n 0' runs all in one process, as --pdb needs)
# make bench  run every benchmark, past one that fails          (ARGS=--quick for a minute each)
# make robots  generate the robots' bodies anew from their descriptions (tens of minutes)
# make objects generate the meshes of config/objects anew       (seconds)
# make gallery render every robot into docs/gallery (minutes)
# make docs   write the generated pages anew
# make site   build the site of docs/ into build/site        (ARGS=--serve shows it while you write)
# make dist   build the wheel and the source archive into dist/
# make lint   ruff and mypy
# make lock   write the lock files anew from requirements*.in
# make audit  list every locked package with its licence, and the advisories that files of OSV have for it
#             (ARGS='PyPI.zip npm.zip'; docs/security-model.md says where they are)
# make clean  remove everything that set-up made

SHELL := /bin/bash
ENV := . .venv/mrlab.sh &&

.PHONY: audit demo test bench robots objects gallery docs site dist lint lock setup clean

setup:
	@python3 scripts/bootstrap.py

demo: setup
	@$(ENV) exec mrlab demo $(ARGS)

test:
	@python3 scripts/bootstrap.py --dev --test-tools
	@$(ENV) PYTHONDONTWRITEBYTECODE= exec python -m pytest -n 3 --dist loadfile --no-loadscope-reorder $(ARGS)

dist:
	@python3 scripts/bootstrap.py
	@$(ENV) python scripts/dist.py

lint:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) ruff check . && ruff format --check . && mypy && scripts/npm run check

bench:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) python bench/run.py $(ARGS)

robots:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) uv pip install -q --require-hashes --no-deps -r requirements-robots.txt
	@$(ENV) python scripts/bodies/generate.py $(ARGS)
	@$(ENV) python scripts/bodies/levels.py --stale $(ARGS)

objects:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) python scripts/bodies/objects.py $(ARGS)

gallery:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) python scripts/bodies/gallery.py $(ARGS)

docs:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) python scripts/docs/generate.py

site:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) python scripts/site/build.py $(ARGS)

lock:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) uv pip compile -q --universal --python-version 3.10 --generate-hashes requirements.in -o requirements.lock
	@$(ENV) uv pip compile -q --universal --python-version 3.10 --generate-hashes requirements-dev.in -o requirements-dev.lock
	@$(ENV) uv pip compile -q --universal --python-version 3.10 --generate-hashes requirements-docs.in -o requirements-docs.lock
	@$(ENV) uv pip compile -q --universal --python-version 3.12 --generate-hashes requirements-ros.in -o requirements-ros.lock

audit:
	@python3 scripts/bootstrap.py --dev
	@$(ENV) python scripts/docs/audit.py $(ARGS)

clean:
	rm -rf .venv build dist install log web/node_modules web/dist
