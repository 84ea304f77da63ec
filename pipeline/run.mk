# SPDX-License-Identifier: AGPL-3.0-or-later
# The rules of a run: each stage is tied to the next by its files, so that nothing is done twice. A stage writes its
# record.json last, so the record stands for all its files. Included with ROOT, the top of the source, and BIN, the
# folder of the programs, set.
include $(ROOT)/pipeline/require.mk

# How the stages that run over MPI are started: by LAUNCHER, which brings its own number of ranks (srun -n 256); else by
# mpirun with NP ranks, on the hosts of the file HOSTS where that is given, as many as it has slots where NP is not. The
# flow is solved on this machine by NP ranks. cutwater_ranks_here: for needs.py, where all ranks are on this machine.
ifeq ($(HOSTS)$(LAUNCHER),)
NP ?= 2
cutwater_ranks_here = --ranks $(NP)
endif
ifneq ($(origin NP),undefined)
$(call cutwater_require,NP,$(NP),[1-9][0-9]*,a number of ranks from 1 on)
endif
$(if $(and $(HOSTS),$(LAUNCHER)),$(error HOSTS is for mpirun, and LAUNCHER is given; allowed: one of them))
$(call cutwater_require,SOLVE,$(SOLVE),1?,1 where a sweep solves its runs too)
cutwater_solves := $(SOLVE)$(filter solve curve %-solve %-curve,$(MAKECMDGOALS))
cutwater_flows := $(if $(filter curve %-curve,$(MAKECMDGOALS)),--curve,$(if $(cutwater_solves),--solve))
$(if $(and $(NP),$(LAUNCHER)),$(if $(cutwater_solves),,$\
  $(error NP is for mpirun, and LAUNCHER is given; allowed: the number of ranks in LAUNCHER, as 'srun -n 256')))
$(call cutwater_require_cells,CELLS,$(CELLS))
$(call cutwater_require,MOST,$(MOST),([1-9][0-9]*)?,a number of iterations from 1 on)
ifneq ($(HOSTS),)
override HOSTS := $(call cutwater_folder,HOSTS,$(HOSTS))
$(if $(shell test -f $(HOSTS) && test -r $(HOSTS) || echo no),$\
  $(error HOSTS is '$(HOSTS)'; allowed: a file with a line 'NAME slots=NUMBER' for each host))
endif

# Also as root. A host that falls silent is given up after a minute (Open MPI 4.1 by itself: after eight). On this
# machine also more ranks than it has cores, without binding, so that runs side by side do not share a core while
# another is free.
LAUNCHER ?= env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 $(if $(HOSTS),$\
  OMPI_MCA_oob_tcp_keepalive_time=30 OMPI_MCA_oob_tcp_keepalive_intvl=10 OMPI_MCA_oob_tcp_keepalive_probes=3 $\
  mpirun -q --hostfile $(HOSTS),$\
  mpirun -q --oversubscribe --bind-to none) $(if $(NP),-n $(NP))

# $(call cutwater_note,TEXT): puts the text into the target where it is not there yet.
define cutwater_note
mkdir -p $(@D) && { echo '$(1)' | cmp -s - $@ || echo '$(1)' > $@; }
endef

# $(call cutwater_inputs,RUN FOLDER): the files of the user's that its geometry was made from, by its record: as long as
# there is none the geometry is made anyway.
cutwater_inputs = $(wildcard $(shell sed -n '/^  "inputs": {/,/^  }/s/^    "\(.*\)": "[0-9a-f]*".*/\1/p' \
  $(1)/geometry/record.json 2> /dev/null))

# $(call cutwater_run,TARGET,CASE FILE,RUN FOLDER,CELLS): TARGET makes the whole run and tells what it made,
# TARGET-solve solves its steady flow too, and TARGET-curve the points of its characteristic curve. What is solved
# already stays. CELLS may be empty: the number of the case file.
define cutwater_run
.PHONY: $(1) $(1)-solve $(1)-curve
$(1)-solve $(1)-curve: $(1)-%: $(2) $(3)/export/record.json
	@python3 $(ROOT)/pipeline/solve/solve.py --case $(2) --run $(3) --ranks $(or $(NP),2) --bin $(BIN) \
	  $(if $(MOST),--most $(MOST)) $$(if $$(filter curve,$$*),--curve)
	@$(LAUNCHER) $(BIN)/cutwater-report --case $(2) --run $(3) $(if $(4),--cells $(4))
	@python3 $(ROOT)/pipeline/summary.py $(3)

.PHONY: $(1)-faces
$(1)-faces: $(3)/geometry/record.json
	@echo '$(3)/geometry/faces_sheet.csv'

$(1): $(3)/report/record.json
	@python3 $(ROOT)/pipeline/summary.py $(3)

# Changes where the folder gets another case, whose file may be older than what lies there.
$(3)/log/case: FORCE
	@$$(call cutwater_note,$(2))

$(3)/geometry/record.json: $(2) $(call cutwater_inputs,$(3)) $(3)/log/case $(BIN)/cutwater-geometry
	@$(BIN)/cutwater-geometry --case $(2) --run $(3) $(if $(4),--cells $(4))

# Changes only when the asked number does.
$(3)/log/cells: FORCE
	@$$(call cutwater_note,$(4))

$(3)/mesh/record.json: $(2) $(3)/log/cells $(3)/geometry/record.json $(BIN)/cutwater-mesh
	@python3 $(ROOT)/pipeline/needs.py $(3) --case $(2) $(cutwater_flows) $(cutwater_ranks_here) $(4)
	@$(LAUNCHER) $(BIN)/cutwater-mesh --case $(2) --run $(3) $(if $(4),--cells $(4))

$(3)/export/record.json: $(2) $(3)/mesh/record.json $(BIN)/cutwater-export
	@$(LAUNCHER) $(BIN)/cutwater-export --case $(2) --run $(3) $(if $(4),--cells $(4))

$(3)/report/record.json: $(2) $(3)/export/record.json $(BIN)/cutwater-report
	@$(LAUNCHER) $(BIN)/cutwater-report --case $(2) --run $(3) $(if $(4),--cells $(4))
endef
