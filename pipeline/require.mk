# SPDX-License-Identifier: AGPL-3.0-or-later
# What the variables of a call may be. Checked before anything is built or run. Included with ROOT, the top of the
# source, set, and TOP, the folder that the paths of a call count from, where that is another one.
ifneq ($(origin TOP),file)
TOP := $(ROOT)
endif

# $(call cutwater_require,NAME,VALUE,PATTERN,ALLOWED): stops where the value is not of the pattern, an extended regular
# expression.
cutwater_require = $(if $(shell echo '$(subst ','\'',$(2))' | grep -Ex '$(3)' > /dev/null || echo no),$\
  $(error $(1) is '$(2)'; allowed: $(4)))

# $(call cutwater_require_cells,NAME,VALUE): empty, or as --cells takes it; whether it is in range the first stage
# tells.
cutwater_require_cells = $(call cutwater_require,$(1),$(2),([0-9][0-9.]*[kKMG]?)?,$\
  a number of cells as 500000 or 500k or 2M)

# Stops at a variable of the command line that is none of those in the list, such as CELL=2M.
cutwater_variables := BUILD CELLS CHOICE HOSTS JOBS LAUNCHER MOST NP OPTIONS OUT PARTS SECTIONS SOLVE SWEEP
$(foreach variable,$(filter-out $(cutwater_variables),$(.VARIABLES)),$(if $(filter command,$(origin $(variable))),$\
  $(error $(variable) is no variable of this project; allowed: $(cutwater_variables))))

# $(call cutwater_odd,PATH): its signs that mean something in a rule or to the shell, where paths stand as they are.
cutwater_signs := A-Za-z0-9/._+,@\200-\377-
cutwater_odd = $(shell printf %s '$(subst ','\'',$(1))' | tr -d '$(cutwater_signs)')
cutwater_allowed := without blanks, of letters, digits and / . _ + , @ -

# $(call cutwater_folder,NAME,VALUE): an absolute path; others count from TOP.
cutwater_folder = $(if $(filter 1,$(words $(2))$(call cutwater_odd,$(2))),$\
  $(abspath $(if $(filter /%,$(2)),$(2),$(TOP)/$(2))),$\
  $(error $(1) is '$(2)'; allowed: one folder, $(cutwater_allowed)))

$(if $(filter-out 1,$(words $(CURDIR)))$(call cutwater_odd,$(CURDIR)),$\
  $(error this folder is '$(CURDIR)'; allowed: a path $(cutwater_allowed)))
$(if $(call cutwater_odd,$(ROOT)),$(error Cutwater lies in '$(ROOT)'; allowed: a path $(cutwater_allowed)))
