# SPDX-License-Identifier: AGPL-3.0-or-later
# The front door.
#
#   make paper [CELLS=2M] [NP=2] [OUT=DIR]   the pump of the paper, from its design table to the solver's files
#   make solve [CELLS=..] [MOST=4000] ...    the same, and its steady flow with OpenFOAM until head and torque settle
#   make curve [CELLS=..] [MOST=4000] ...    the same at several flow rates: head, power and efficiency over flow
#   make report [OUT=runs]                   one page that sets the finished runs of a folder side by side
#   make check                               the quick tests, with everything they need
#   make check-long                          the long ones
#   make check-sanitized                     those of single modules and a whole run, under sanitizers, in build/sanitized
#   make -C cases NAME                       another case; `make -C cases` lists them
#   make measurements [SECTIONS="scale cases"]  the benches; writes docs/measurements.md (hours)
#   make verify [PARTS="heads ubaldi"]      solved flows beside published ones; writes docs/verification.md (hours)
#   make dist                                an archive of the last commit that builds without git, in build/
#   make clean                               removes build/ (runs/ stays)
#
# CELLS: asked number of cells (default: of the case file); NP: ranks; OUT: folder of the run (default runs/paper);
# MOST: iterations of a flow at most;
# HOSTS=FILE: mpirun's file of hosts; LAUNCHER="srun -n 256": instead of mpirun (docs/cluster.md).
ROOT := $(CURDIR)
include pipeline/build.mk
include pipeline/run.mk

.DEFAULT_GOAL := help
.PHONY: help solve curve report check check-long check-sanitized measurements verify dist clean

help:
	@sed -n '/^#   make/s/^#  //p; /^# \(CELLS\|MOST\|HOSTS\)/s/^# //p' Makefile

OUT ?= runs/paper
$(eval $(call cutwater_run,paper,$(ROOT)/cases/paper/case.yaml,$(call cutwater_folder,OUT,$(OUT)),$(CELLS)))

solve curve: %: paper-%

report:
	@python3 $(ROOT)/pipeline/compare.py $(call cutwater_folder,OUT,$(if $(filter file,$(origin OUT)),runs,$(OUT)))

check check-long: everything
check: CHOICE := -L '^quick$$'
check-long: CHOICE := -L '^long$$'
check check-long:
	@cd $(BUILD) && { ctest $(CHOICE) -j $(JOBS) --no-tests=error --no-label-summary --output-on-failure \
	  --output-junit $(BUILD)/$@.xml; python3 $(ROOT)/tests/tally.py $@ $(BUILD)/$@.xml; }
check-sanitized:
	@$(MAKE) --no-print-directory check BUILD=$(BUILD)/sanitized OPTIONS=-DCUTWATER_SANITIZE=ON \
	  CHOICE='-L quick -R "/test_|^run/quick$$$$"'

measurements: everything
	@python3 $(ROOT)/tests/bench/measurements.py $(SECTIONS)

verify: programs
	@python3 $(ROOT)/tests/bench/verify.py $(PARTS)

# The last commit, and what it is.
dist:
	@mkdir -p $(BUILD) && cmake -DROOT=$(ROOT) -DOUT=$(BUILD)/VERSION -P $(ROOT)/pipeline/cmake/version.cmake
	@! grep -q '\.changed$$' $(BUILD)/VERSION || echo 'dist: warning: changes that are not committed are left out' >&2
	@version=$$(sed 's/\.changed$$//' $(BUILD)/VERSION) && echo "$$version" > $(BUILD)/VERSION && \
	  git -C $(ROOT) archive --prefix=cutwater-$$version/pipeline/ --add-file=$(BUILD)/VERSION \
	    --prefix=cutwater-$$version/ -o $(BUILD)/cutwater-$$version.tar.gz HEAD && \
	  echo $(BUILD)/cutwater-$$version.tar.gz

clean:
	@rm -rf $(BUILD)
