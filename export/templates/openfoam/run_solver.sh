# SPDX-License-Identifier: AGPL-3.0-or-later
# Sourced by the Allrun scripts, whose name it tells errors by.
: "${WM_PROJECT_DIR:=@project_folder@}"
export WM_PROJECT_DIR
export LC_ALL=C # numbers have a point, and fields are bytes
# Open MPI: also as root, and with more ranks than cores.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
usual_ranks=@usual_ranks@ # where the caller asks for none

die() {
    echo "Allrun: $1" >&2
    exit 1
}

require_count() { # $1: what it is, $2: its value
    case $2 in
    0* | *[!0-9]*) die "$1 is '$2'; allowed: a number from 1 on" ;;
    esac
}

logged() { # runs PROGRAM ARGUMENTS..., its words into log.PROGRAM
    "$@" > "log.$1" 2>&1 || die "$1 failed: see log.$1"
}

divided() { # whether the mesh of the case folder $1 was exported in parts
    [ -e "$1/processor0/constant" ] && [ ! -e "$1/constant/polyMesh/points" ]
}

solved() { # the times after 0 of the case folder $1 that have fields, the latest last
    divided "$1" && set -- "$1/processor0"
    for folder in "$1"/[0-9]*; do
        [ -e "$folder/U" ] && [ "${folder##*/}" != 0 ] && echo "${folder##*/}"
    done | sort -g
}

latest() { # the last of them; nothing without one
    solved "$1" | tail -n 1
}

places() { # the folders that have the fields of this case: its parts, processor0 behind the others, or itself
    if divided .; then ls -rd processor[0-9]*; else echo .; fi
}

rank_count() { # the ranks that the caller asks for: $1, else as many as the mesh is divided for, else the usual ones
    divided . || { echo "${1:-$usual_ranks}" && return; }
    parts=$(find . -maxdepth 1 -name 'processor[0-9]*' | wc -l)
    [ "${1:-$parts}" = "$parts" ] || die "RANKS is '$1'; allowed: $parts, for which the mesh is divided"
    echo "$parts"
}

on_ranks() { # $1: ranks, then PROGRAM ARGUMENTS..., its words into log.PROGRAM
    count=$1
    shift
    [ "$count" -gt 1 ] || { logged "$@" && return; }
    mpirun -n "$count" "$@" -parallel > "log.$1" 2>&1 || die "$1 failed: see log.$1"
}

divide() { # for $1 ranks, if there are several, a mesh that is whole, with its latest fields
    divided . || [ "$1" = 1 ] && return
    [ "$usual_ranks" = 1 ] || echo "divides the mesh on one core, which takes 0.6 GB for a million cells; a case with" \
        "openfoam.processors: $1 has it exported divided, on all ranks"
    foamDictionary -entry numberOfSubdomains -set "$1" system/decomposeParDict > /dev/null || exit 1
    if grep -q hierarchical system/decomposeParDict; then
        foamDictionary -entry coeffs/n -set "($1 1 1)" system/decomposeParDict > /dev/null || exit 1
    fi
    logged decomposePar -force -latestTime
}

rejoin() { # puts together the latest fields that a run on several ranks, which was stopped, has in all its parts
    divided . && return
    last=$(latest .)
    found=
    for found in $(solved processor0 | sort -gr); do
        [ "$(printf '%s\n' "$last" "$found" | sort -g | tail -n 1)" != "$last" ] || return 0
        reconstructPar -time "$found" > log.reconstructPar 2>&1 && return
        rm -rf "$found" # some part was stopped before it had written it
    done
    [ -z "$found" ] || die "reconstructPar failed: see log.reconstructPar"
}

run_solver() { # $1: the solver, $2: ranks, for which the mesh is divided
    on_ranks "$2" "$1"
    divided . || [ "$2" = 1 ] || logged reconstructPar -latestTime
}
