# `make run` shows the 2013 test and the model's answer to it; `make test` runs every check.
# Both set up what they need by themselves, once.

# Another Python: make PYTHON=python3.12 run
PYTHON ?= python3
# Test processes at a time.
JOBS ?= 2
# What `make prove` does: `sample` makes and diagnoses the first sealed cases of each world again and
# compares with the published answers; ci is a set of 24 small cases, dev of 172, test of 400.
SET ?= sample

OUT := out
RECORD := config/recordings/test_2013_steer_blowout.csv
BIN := .venv/bin
# The files in the order of test/conftest.py: the long ones with few tests would otherwise come last,
# one behind another.
PYTEST := -m pytest -n $(JOBS) --dist loadfile --no-loadscope-reorder

# The environment is complete in itself: what a sourced ROS installation, or a Python that is already
# inside such an environment, left in the variables must not leak in.
unexport PYTHONPATH AMENT_PREFIX_PATH _ROS_WHEELS_BOOTSTRAP_COMPLETE

.DEFAULT_GOAL := help
.PHONY: help run test test-ros-all prove bench docs site clean distclean

help:
	@echo "make run           the 2013 blowout test: simulated, compared, diagnosed: $(OUT)/index.html"
	@echo "make test          every check: tests, style, types, architecture"
	@echo "make test-ros-all  the node tests with ROS 2 kilted, then with jazzy"
	@echo "make prove         sealed cases of each world, diagnosed again: as published? (or SET=ci|dev|test)"
	@echo "make bench         speed of the model beside a peer, cost of the nodes"
	@echo "make docs          redraw the pictures under docs/, run the notebooks, write the references"
	@echo "make site          the documentation as a site: $(OUT)/site/index.html"
	@echo "make clean         remove what was made; make distclean: the environments too"

run: .venv/ready
	@echo "1. The scenario, simulated: a bag in $(OUT)/steer_axle_blowout"
	$(BIN)/truck-blowout run steer_axle_blowout -o $(OUT)/steer_axle_blowout --force
	@echo; echo "2. The test's record beside the model: a page in $(OUT)/comparison"
	$(BIN)/truck-blowout compare test_2013_steer_blowout --force -o $(OUT)/comparison
	@echo; echo "3. What the model lacks, found from the record: $(OUT)/diagnosis"
	$(BIN)/truck-blowout diagnose $(RECORD) --settings rebuilt_record --quick --force -o $(OUT)/diagnosis
	@echo; echo "4. Model and record moving in 3-D: $(OUT)/view.html"
	$(BIN)/truck-blowout view $(OUT)/steer_axle_blowout $(RECORD) --force -o $(OUT)/view.html
	@echo; echo "5. The same run over ROS 2, in real time: bag and page in $(OUT)/over_dds"
	scripts/run_over_dds.sh $(OUT)/over_dds
	@echo; echo "The whole way on one page:"
	$(BIN)/python scripts/tell_story.py $(RECORD) $(OUT)/diagnosis $(OUT)/index.html \
		"the run=steer_axle_blowout.html" "the truck in 3-D=view.html" \
		"the comparison=comparison/report.html" "the diagnosis=diagnosis/report.html"

test: .venv/ready
	$(BIN)/python $(PYTEST)

test-ros-all: .venv/ready .venv-jazzy/ready
	$(BIN)/python $(PYTEST) test/nodes
	.venv-jazzy/bin/python $(PYTEST) test/nodes

prove: .venv/ready
ifeq ($(SET),sample)
	$(BIN)/python scripts/repeat_proof.py $(OUT)/proof_sample 4 $(JOBS)
else
	$(BIN)/truck-blowout prove --set $(SET) --workers $(JOBS) --renew -o $(OUT)/proof
endif

bench: .venv/ready-for-bench
	$(BIN)/python -m benchmarks
	$(BIN)/python -m benchmarks.nodes both

docs: .venv/ready
	$(BIN)/python scripts/draw_architecture.py
	$(BIN)/python scripts/write_notebooks.py
	$(BIN)/python scripts/write_command_reference.py
	$(BIN)/truck-blowout compare test_2013_steer_blowout --force -o $(OUT)/comparison
	cp $(OUT)/comparison/figures/yaw_rate_tractor.png docs/steer_axle_blowout.png
	$(BIN)/python scripts/draw_blowout_picture.py docs/truck_at_blowout.jpg

site: .venv/ready-for-docs
	$(BIN)/python scripts/write_command_reference.py
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --strict
	@echo "$(OUT)/site/index.html"

# requirements/<distribution>.txt pins everything; a newer file there sets up anew.
.venv/ready: requirements/kilted.txt setup.py setup.cfg
	@PYTHON="$(PYTHON)" scripts/set_up_environment.sh .venv requirements/kilted.txt

.venv/ready-for-bench: requirements/bench.txt .venv/ready
	@$(BIN)/python -m pip install --quiet --quiet --disable-pip-version-check -r requirements/bench.txt
	@touch $@

.venv/ready-for-docs: requirements/docs.txt .venv/ready
	@$(BIN)/python -m pip install --quiet --quiet --disable-pip-version-check -r requirements/docs.txt
	@touch $@

.venv-jazzy/ready: requirements/jazzy.txt setup.py setup.cfg
	@PYTHON="$(PYTHON)" scripts/set_up_environment.sh .venv-jazzy requirements/jazzy.txt

clean:
	rm -rf $(OUT) build dist install log *.egg-info .pytest_cache .mypy_cache .ruff_cache \
		.hypothesis .import_linter_cache
	find . -name __pycache__ -not -path './.venv*' -prune -exec rm -rf {} +

distclean: clean
	rm -rf .venv .venv-jazzy
