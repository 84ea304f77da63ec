# SPDX-License-Identifier: AGPL-3.0-or-later
# How the programs come about: packages from Debian, then CMake. Included with ROOT, the top of the source, set.
include $(ROOT)/pipeline/require.mk
BUILD ?= build
override BUILD := $(call cutwater_folder,BUILD,$(BUILD))
BIN := $(BUILD)/bin
JOBS ?= $(shell nproc)
$(call cutwater_require,JOBS,$(JOBS),[1-9][0-9]*,a number of processes from 1 on)
STAGES := geometry mesh export report
PROGRAMS := $(STAGES:%=$(BIN)/cutwater-%)

# Runs a command with its output in a log; shows the errors of the log, and its end, where it fails.
define cutwater_logged
{ $(1); } > $(2) 2>&1 || { grep -E 'error|Error' $(2) | head -n 20 >&2; tail -n 5 $(2) >&2; \
  echo 'build: error: see $(2)' >&2; exit 1; }
endef

.PHONY: packages configure programs everything FORCE

# Checks need the programs of others too, solving one of them.
packages:
	@$(ROOT)/pipeline/packages.sh $(if $(filter check-long,$(MAKECMDGOALS)),check-long,$\
	  $(if $(filter check measurements verify,$(MAKECMDGOALS)),check,$\
	  $(if $(SOLVE)$(filter solve curve %-solve %-curve,$(MAKECMDGOALS)),solve,build)))

configure: packages
	@mkdir -p $(BUILD)
	@test -e $(BUILD)/Makefile || $(call cutwater_logged,cmake -S $(ROOT) -B $(BUILD) $(OPTIONS),$(BUILD)/configure.log)
	@$(call cutwater_logged,cmake --build $(BUILD) --target cmake_check_build_system,$(BUILD)/configure.log)

programs: configure
	@test -e $(BIN)/cutwater-report || echo 'build: some minutes the first time, log in $(BUILD)/build.log' >&2
	@$(call cutwater_logged,cmake --build $(BUILD) -j $(JOBS) --target $(STAGES:%=cutwater-%),$(BUILD)/build.log)

# CMake knows whether a program is out of date; make looks only whether the file has changed.
$(PROGRAMS): programs
	@test -x $@

everything: configure
	@echo 'build: programs and tests, some minutes the first time, log in $(BUILD)/build.log' >&2
	@$(call cutwater_logged,cmake --build $(BUILD) -j $(JOBS),$(BUILD)/build.log)
