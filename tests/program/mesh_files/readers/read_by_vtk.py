"""What VTK reads from .vtu and VTKHDF files: one JSON object a file. A file may be followed by a CSV
file of `simdbezier evaluate`, whose positions are then compared with those that VTK finds on its
cells.
"""
import csv
import json
import sys

import vtk
from vtk.util.numpy_support import vtk_to_numpy


def arrays_of(attributes):
    arrays = {}
    for k in range(attributes.GetNumberOfArrays()):
        array = attributes.GetArray(k)
        arrays[array.GetName()] = {'type': array.GetDataTypeAsString(),
                                   'components': array.GetNumberOfComponents(),
                                   'values': vtk_to_numpy(array).ravel().tolist()}
    return arrays


def describe(grid):
    cells = range(grid.GetNumberOfCells())
    points = vtk_to_numpy(grid.GetPoints().GetData()).tolist() if grid.GetPoints() else []
    data = grid.GetPointData()
    faces = []
    for k in cells:
        cell = grid.GetCell(k)
        faces.append([cell.GetPointId(c) for c in range(cell.GetNumberOfPoints())])
    return {'points': points, 'faces': faces, 'types': [grid.GetCellType(k) for k in cells],
            'point_data': arrays_of(data), 'cell_data': arrays_of(grid.GetCellData()),
            'fields': arrays_of(grid.GetFieldData()),
            'normals': data.GetNormals() is not None, 'tcoords': data.GetTCoords() is not None}


def largest_difference(grid, path):
    largest = 0
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            cell = grid.GetCell(int(row['patch']))
            found, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
            place = [float(row['u']), float(row['v']), 0]
            cell.EvaluateLocation(vtk.reference(0), place, found, weights)
            largest = max([largest] + [abs(a - float(row[c])) for a, c in zip(found, 'xyz')])
    return largest


for name in sys.argv[1:]:
    if name.endswith('.csv'):
        print(json.dumps({'difference': largest_difference(grid, name)}))
        continue
    is_hdf = name.endswith('.hdf')
    reader = vtk.vtkHDFReader() if is_hdf else vtk.vtkXMLUnstructuredGridReader()
    complaints = []
    reader.AddObserver('ErrorEvent', lambda *_: complaints.append('error'))
    reader.AddObserver('WarningEvent', lambda *_: complaints.append('warning'))
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    print(json.dumps({**describe(grid), 'complaints': complaints}))
