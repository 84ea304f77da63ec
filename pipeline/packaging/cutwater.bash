# SPDX-License-Identifier: AGPL-3.0-or-later
# Completion for bash: options of the stages as their --help names them, cases and variables of `cutwater`.
_cutwater() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words name
  case ${program##*/} in
  cutwater)
    [[ $before != report ]] || return
    for name in $("$program" 2> /dev/null); do words+="$name $name-faces $name-solve $name-curve $name-sweep "; done
    words+=$("$program" --help | grep -oE '^  ([A-Z]+=|--[a-z]+|report)')
    ;;
  *)
    case $before in --case | --run | --cells | --stop-after) return ;; esac
    words=$("$program" --help 2> /dev/null | grep -oE '^  --[a-z-]+')
    ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  [[ ${COMPREPLY[0]} != *= ]] || compopt -o nospace 2> /dev/null
}
complete -o default -F _cutwater cutwater cutwater-geometry cutwater-mesh cutwater-export cutwater-report
