# SPDX-License-Identifier: AGPL-3.0-or-later
"""A CGNS file as VTK's reader shows it."""
from collections import defaultdict

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOCGNSReader import vtkCGNSReader

TRIANGLE, QUAD, TETRAHEDRON, WEDGE = 5, 9, 10, 13  # vtkCellType.h


def blocks(block, path=""):
    """The data sets that have cells, by their names: "pump/ROTOR/Internal"."""
    if not block.IsA("vtkMultiBlockDataSet"):
        return {path: block}
    found = {}
    for k in range(block.GetNumberOfBlocks()):
        name = block.GetMetaData(k).Get(vtkCompositeDataSet.NAME())
        found |= blocks(block.GetBlock(k), f"{path}/{name}" if path else name)
    return found


def sizes(grid):
    """The areas or volumes of the cells of a data set, by the type of cell."""
    measure, found = vtkCellSizeFilter(), defaultdict(list)
    measure.SetInputData(grid)
    measure.Update()
    measured = measure.GetOutput()
    areas, volumes = (measured.GetCellData().GetArray(name) for name in ("Area", "Volume"))
    for cell in range(measured.GetNumberOfCells()):
        kind = measured.GetCellType(cell)
        found[kind].append((areas if kind in (TRIANGLE, QUAD) else volumes).GetValue(cell))
    return found


def read(path):
    """The sizes of the cells of a file, by the names of its data sets: zones and the patches of each."""
    reader = vtkCGNSReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.LoadBndPatchOn()
    reader.Update()
    return {name: sizes(grid) for name, grid in blocks(reader.GetOutput()).items()}
