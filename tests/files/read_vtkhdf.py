"""Opens a sphere file as ParaView does and prints what VTK found in it, one fact a line."""

import sys

from vtkmodules.vtkCommonDataModel import VTK_VERTEX
from vtkmodules.vtkIOHDF import vtkHDFReader

reader = vtkHDFReader()
if not reader.CanReadFile(sys.argv[1]):
    sys.exit("vtkHDFReader cannot read the file")
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
print("class", grid.GetClassName())
print("points", grid.GetNumberOfPoints(), grid.GetPoints().GetData().GetDataTypeAsString())
print("cells", grid.GetNumberOfCells())
vertices = sum(grid.GetCellType(c) == VTK_VERTEX and grid.GetCell(c).GetPointId(0) == c
               for c in range(grid.GetNumberOfCells()))
print("vertices", vertices)
data = grid.GetPointData()
for a in sorted(range(data.GetNumberOfArrays()), key=data.GetArrayName):
    array = data.GetArray(a)
    print("array", array.GetName(), array.GetNumberOfTuples(), array.GetNumberOfComponents(),
          array.GetDataTypeAsString())
last = grid.GetNumberOfPoints() - 1
print("last", *(value.hex() for value in grid.GetPoint(last)),
      data.GetArray("radius").GetTuple1(last).hex())
print("block", *(int(value) for value in data.GetArray("block").GetTuple3(last)))
