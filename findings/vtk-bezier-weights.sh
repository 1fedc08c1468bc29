#!/usr/bin/env bash
# VTK takes the weights of Bézier cells from the array that the attribute RationalWeights of PointData
# names. An array that is only called so does not count, and the cell is polynomial.
. "$(dirname "$0")/install.sh"
debian_packages 9.1.0 python3-vtk9
cat <<'TEXT'
input: a quarter of a cylinder of radius 1 as one rational Bézier cell (.vtu) with an array called RationalWeights, which
  is also named as an attribute, or not
expected: the radius in the middle of the arc is 1 either way
TEXT
cat >program.py <<'PYTHON'
import math
import vtkmodules.vtkCommonDataModel
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

arc = [(1, 0), (1, 1), (0, 1)]
places = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]  # corners, edges, middle
points = [value for i, j in places for value in (*arc[i], j / 2)]
weights = [math.sqrt(0.5) if i == 1 else 1.0 for i, j in places]


def array(name, kind, values, components=1):
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
            f'{" ".join(map(repr, values))}</DataArray>')


for attribute in (' RationalWeights="RationalWeights"', ''):
    with open('cell.vtu', 'w') as file:
        file.write(f'<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian"><UnstructuredGrid>'
                   f'<Piece NumberOfPoints="9" NumberOfCells="1">'
                   f'<PointData{attribute}>{array("RationalWeights", "Float64", weights)}</PointData>'
                   f'<Points>{array("Points", "Float64", points, 3)}</Points>'
                   f'<Cells>{array("connectivity", "Int64", range(9))}{array("offsets", "Int64", [9])}'
                   f'{array("types", "UInt8", [77])}</Cells></Piece></UnstructuredGrid></VTKFile>')
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName('cell.vtu')
    reader.Update()
    middle = [0.0] * 3
    reader.GetOutput().GetCell(0).EvaluateLocation(reference(0), [0.5, 0.5, 0.0], middle, [0.0] * 9)
    print(f'{math.hypot(middle[0], middle[1]):.4f}')
PYTHON
export PYTHONPATH=$folder/usr/lib/python3/dist-packages
LD_LIBRARY_PATH=$(find "$folder/usr/lib" -maxdepth 1 -name '*-linux-gnu')
export LD_LIBRARY_PATH
mapfile -t said < <(/usr/bin/python3 program.py)
expect 'the radius, array named as an attribute' "${said[0]:-}" 1.0000
expect 'the radius, array called RationalWeights only' "${said[1]:-}" 1.0607
