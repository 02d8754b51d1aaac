"""A scene of two plates pressed together, its mesh and files beside it, which the tests of messages spoil."""

import plates

SCENE = """
mesh.file = "plates.msh"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { lower = "steel", upper = "steel" }
[[boundary]]
on = "lower_bottom"
displacement = { y = 0 }
[[boundary]]
on = ["lower_left", "upper_left"]
displacement = { x = 0 }
[[boundary]]
on = "upper_top"
pressure = 1e6
[[contact]]
between = ["upper_bottom", "lower_top"]
"""
PLATES = plates.mesh_of([
    plates.Body("lower", plates.even(2), 1, plates.between(0, 1, 0, 1), plates.QUAD4),
    plates.Body("upper", plates.even(3), 1, plates.between(0, 1, 1, 2), plates.QUAD4),
])  # fmt: skip
VTU = """<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="T" format="ascii">1 1 1 1</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">-1 -1 0 2 -1 0 2 3 0 -1 3 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">9</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
"""
ONE_BODY = """
mesh.file = "body.geo"
materials.steel = { young = 210e9, poisson = 0.3 }
bodies = { lower = "steel" }
[[boundary]]
on = "lower_bottom"
displacement = { x = 0, y = 0 }
"""
