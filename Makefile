# Every target is a script in scripts/; see CONTRIBUTING.md.
# PG_CONFIG=/path/to/pg_config chooses another PostgreSQL, 14 to 18; "make test" without it tests on 15 and 18.

.PHONY: help setup build db db-stop clean-db demo test attack crash-test bench-index bench-point bench-cells bench-edits install lint fmt

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-11s %s\n", $$1, $$2 }' Makefile

setup: ## install what a bare Debian 12 lacks
	@scripts/setup

build: setup ## build the extension and the command line, and stage the extension
	@scripts/build

db: build ## start or reuse this checkout's private cluster; its URL is the last line
	@scripts/db start

db-stop: ## stop it
	@scripts/db stop

clean-db: ## stop it and delete its data
	@scripts/db clean

demo: ## a real city to a visible answer (CITY=file, FRESH=1)
	@scripts/demo

test: ## run every test; ends with "N passed, N failed"
	@scripts/test

attack: build ## sessions that edit and query for MINUTES=10, every answer judged (SEED=1)
	@scripts/attack $(or $(MINUTES),10) $(or $(SEED),1)

crash-test: build ## kill a server at random moments of its work, and look at what is there afterwards (KILLS=100, SEED=number)
	@scripts/crash-test --kills $(or $(KILLS),100) $(if $(SEED),--seed $(SEED)) --plant

bench-index: build ## the indexes of box3d against PostGIS and cube (ROWS=100000 is quick, FORMAT=markdown)
	@scripts/bench index

bench-point: build ## live answers against PostGIS, Embree and the way of 2004 (FEATURES="10000 100000" is quicker, FORMAT=markdown, EMBREE=no)
	@scripts/bench point

bench-cells: build ## view cells, computed and stored, against one erosion, umbrae and Embree (FEATURES=10000 TOWN=300 is quicker, FORMAT=markdown, EMBREE=no)
	@scripts/bench cells

bench-edits: build ## what edits, repairs, counters, dump and restore cost (DELFT=no TOWN=2000 is quicker, FORMAT=markdown)
	@scripts/bench edits

install: ## copy what "make build" made into the server of PG_CONFIG
	@scripts/install

lint: setup ## every check that needs no database
	@scripts/lint

fmt: ## format the Rust code
	@cargo fmt --all
