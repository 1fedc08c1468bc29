"""What h5py reads from VTKHDF files: one JSON object a file, with the names of read_by_vtk.py."""
import json
import sys

import h5py


def arrays_of(group):
    return {name: {'type': str(array.dtype), 'components': (array.shape + (1,))[1],
                   'values': array[()].ravel().tolist()} for name, array in group.items()}


for path in sys.argv[1:]:
    with h5py.File(path, 'r') as file:
        grid = file['VTKHDF']
        ends, corners = grid['Offsets'][()].tolist(), grid['Connectivity'][()].tolist()
        counts = {name: grid[name][()].tolist() for name in
                  ('NumberOfPoints', 'NumberOfCells', 'NumberOfConnectivityIds')}
        print(json.dumps({
            'attributes': {name: str(value) for name, value in grid.attrs.items()},
            'counts': counts, 'ends': len(ends), 'corners': len(corners),
            'points': grid['Points'][()].tolist(), 'point_type': str(grid['Points'].dtype),
            'index_types': [str(grid[name].dtype) for name in ('Offsets', 'Connectivity')],
            'faces': [corners[a:b] for a, b in zip(ends, ends[1:])],
            'types': grid['Types'][()].tolist(), 'point_data': arrays_of(grid['PointData']),
            'cell_data': arrays_of(grid['CellData']), 'fields': arrays_of(grid['FieldData'])}))
