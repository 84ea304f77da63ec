# SPDX-License-Identifier: AGPL-3.0-or-later
"""How many cells the mesh has whose solved flow is the start of a finer one."""

SHARE = 8      # of the fine mesh's cells, so half the resolution along each axis
LEAST = 30000  # cells


def start_cells(cells):
    """0: that flow starts from rest."""
    return cells // SHARE if cells // SHARE >= LEAST else 0
