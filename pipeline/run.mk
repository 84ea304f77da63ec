# SPDX-License-Identifier: AGPL-3.0-or-later
# The rules of a run: each stage is tied to the next by its files, so that nothing is done twice. A stage writes its
# record.json last, so the record stands for all its files. Included with ROOT, the top of the source, and BIN, the
# folder of the programs, set.
include $(ROOT)/pipeline/require.mk
NP ?= 2
$(call cutwater_require,NP,$(NP),[1-9][0-9]*,a number of ranks from 1 on)
$(call cutwater_require_cells,CELLS,$(CELLS))

# All ranks on this machine, also as root and also more than it has cores. Without binding, so that runs side by side
# do not share a core while another is free; without copies across processes, which containers forbid.
MPIRUN ?= env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none \
  mpirun -q --oversubscribe --bind-to none -n $(NP)

# $(call cutwater_note,TEXT): puts the text into the target where it is not there yet.
define cutwater_note
mkdir -p $(@D) && { echo '$(1)' | cmp -s - $@ || echo '$(1)' > $@; }
endef

# $(call cutwater_run,TARGET,CASE FILE,RUN FOLDER,CELLS): TARGET makes the whole run and tells what it made, TARGET-solve
# solves its steady flow too, and TARGET-curve the points of its characteristic curve. What is solved already stays.
# CELLS may be empty: the number of the case file.
define cutwater_run
.PHONY: $(1) $(1)-solve $(1)-curve
$(1)-solve $(1)-curve: $(1)-%: $(2) $(3)/export/record.json
	@python3 $(ROOT)/pipeline/solve/solve.py --case $(2) --run $(3) --ranks $(NP) --bin $(BIN) $$(if $$(filter curve,$$*),--curve)
	@$(BIN)/cutwater-report --case $(2) --run $(3) $(if $(4),--cells $(4))
	@python3 $(ROOT)/pipeline/summary.py $(3)

$(1): $(3)/report/record.json
	@python3 $(ROOT)/pipeline/summary.py $(3)

# Changes where the folder gets another case, whose file may be older than what lies there.
$(3)/log/case: FORCE
	@$$(call cutwater_note,$(2))

$(3)/geometry/record.json: $(2) $(3)/log/case $(BIN)/cutwater-geometry
	@$(BIN)/cutwater-geometry --case $(2) --run $(3) $(if $(4),--cells $(4))

# Changes only when the asked number does.
$(3)/log/cells: FORCE
	@$$(call cutwater_note,$(4))

$(3)/mesh/record.json: $(2) $(3)/log/cells $(3)/geometry/record.json $(BIN)/cutwater-mesh
	@$(MPIRUN) $(BIN)/cutwater-mesh --case $(2) --run $(3) $(if $(4),--cells $(4))

$(3)/export/record.json: $(2) $(3)/mesh/record.json $(BIN)/cutwater-export
	@$(MPIRUN) $(BIN)/cutwater-export --case $(2) --run $(3) $(if $(4),--cells $(4))

$(3)/report/record.json: $(2) $(3)/export/record.json $(BIN)/cutwater-report
	@$(BIN)/cutwater-report --case $(2) --run $(3) $(if $(4),--cells $(4))
endef
