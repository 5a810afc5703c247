# SPDX-License-Identifier: BSD-3-Clause
"""Meshes in Gmsh's model of the same file, in meshio and in pyvista (Debian packages python3-gmsh, python3-meshio; Debian has no pyvista, and
a stand-in records its calls)."""
import math
import sys
import types

import numpy as np
import pytest

import carreau

SHAPES = {
    "box": (lambda occ: occ.addBox(0, 0, 0, 3, 2, 1), 6),
    "sphere": (lambda occ: occ.addSphere(0, 0, 0, 1), 4 * math.pi / 3),
    "torus": (lambda occ: occ.addTorus(0, 0, 0, 2, 0.5), 2 * math.pi ** 2 * 2 * 0.25),
    "cone": (lambda occ: occ.addCone(0, 0, 0, 0, 0, 2, 1, 0.5), math.pi / 3 * 2 * (1 + 0.5 + 0.25)),
    "drilled": (lambda occ: occ.cut([(3, occ.addBox(-1, -1, 0, 2, 2, 1))], [(3, occ.addCylinder(0, 0, -1, 0, 0, 3, 0.5))]), 4 - math.pi / 4),
}


@pytest.fixture
def gmsh():
    module = pytest.importorskip("gmsh")
    module.initialize()
    module.option.setNumber("General.Terminal", 0)
    yield module
    module.finalize()


def opened(gmsh, tmp_path, name):
    """The path of a STEP file that is open in Gmsh."""
    path = str(tmp_path / (name + ".step"))
    SHAPES[name][0](gmsh.model.occ)
    gmsh.model.occ.synchronize()
    gmsh.write(path)
    gmsh.clear()
    gmsh.model.occ.importShapes(path)
    gmsh.model.occ.synchronize()
    return path


def rows(array):
    return set(map(tuple, np.asarray(array).round(9) + 0.0))


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_a_script_of_gmsh_goes_on_behind_the_mesh(gmsh, tmp_path, name):
    mesh = carreau.mesh(opened(gmsh, tmp_path, name), size=0.3, unit="mm")
    carreau.to_gmsh(mesh)
    entities = gmsh.model.getEntities
    # Tags are equal, and each surface has its own triangles.
    for _, tag in entities(2):
        types_, numbers, nodes = gmsh.model.mesh.getElements(2, tag)
        assert list(types_) == [2] and len(numbers[0]) == (mesh.face_ids == tag).sum()
        points = [gmsh.model.mesh.getNode(node)[0] for node in nodes[0]]
        assert rows(points) == rows(mesh.vertices[np.unique(mesh.triangles[mesh.face_ids == tag])])
        # Parameters of nodes are on the surface.
        _, xyz, uv = gmsh.model.mesh.getNodes(2, tag)
        assert len(uv) * 3 == len(xyz) * 2
        assert np.allclose(gmsh.model.getValue(2, tag, uv), xyz, atol=1e-6)
    assert sum(len(gmsh.model.mesh.getElements(1, tag)[1][0]) for _, tag in entities(1) if gmsh.model.mesh.getElements(1, tag)[1]) == len(mesh.edges)
    before = rows(np.array(gmsh.model.mesh.getNodesByElementType(2)[1]).reshape(-1, 3))
    gmsh.model.addPhysicalGroup(3, [1], 1)
    gmsh.model.mesh.generate(3)
    after = rows(np.array(gmsh.model.mesh.getNodesByElementType(2)[1]).reshape(-1, 3))
    assert before == after == rows(mesh.vertices)
    corners = np.array(gmsh.model.mesh.getNodesByElementType(4)[1]).reshape(-1, 4, 3)
    volume = abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum() / 6
    signed = np.einsum("ij,ij->", mesh.vertices[mesh.triangles[:, 0]], np.cross(mesh.vertices[mesh.triangles[:, 1]], mesh.vertices[mesh.triangles[:, 2]])) / 6
    assert volume == pytest.approx(signed, rel=1e-9) and volume == pytest.approx(SHAPES[name][1], rel=0.06)
    gmsh.model.mesh.setOrder(2)  # nodes move to the surface of the model
    assert len(gmsh.model.mesh.getNodesByElementType(11)[0]) == 10 * len(corners)


def test_elements_of_order_two_and_another_model(gmsh, tmp_path):
    path = opened(gmsh, tmp_path, "torus")
    mesh = carreau.mesh(path, size=0.4, element="p2")
    mesh.to_gmsh()
    assert [list(gmsh.model.mesh.getElements(2, tag)[0]) for _, tag in gmsh.model.getEntities(2)] == [[9]]
    assert rows(np.array(gmsh.model.mesh.getNodesByElementType(9)[1]).reshape(-1, 3)) == rows(mesh.vertices)
    gmsh.clear()
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    with pytest.raises(carreau.ArgumentError, match="of the mesh is no .* of Gmsh's model"):
        mesh.to_gmsh()


def test_meshio_keeps_groups_orders_and_fields(tmp_path):
    meshio = pytest.importorskip("meshio")
    with carreau.Session() as session:
        torus = lambda u, v: ((2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v))  # noqa: E731
        mesh = carreau.mesh(torus, domain=(0, 0, 2 * np.pi, 2 * np.pi), size=0.8, element="p2")
        assert session is not None
    made = mesh.to_meshio()
    assert [block.type for block in made.cells][0] == "triangle6" and {"line3"} == {block.type for block in made.cells[1:]}
    assert made.field_data["face_1"].tolist() == [1, 2]
    assert (made.cell_data["gmsh:physical"][0] == 1).all() and len(made.point_data["size"]) == len(mesh.vertices)
    plain = carreau.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 2), (1, 3, 2)], face_ids=[4, 7])
    plain.add_field("height", [0, 1, 2, 3])
    plain.add_field("flux", [5, 6])
    path = tmp_path / "plain.msh"
    plain.to_meshio().write(path, file_format="gmsh22")
    back = meshio.read(path)
    assert back.point_data["height"].ravel().tolist() == [0, 1, 2, 3] and back.cell_data["flux"][0].ravel().tolist() == [5, 6]
    assert {name: value.tolist() for name, value in back.field_data.items()} == {"face_4": [4, 2], "face_7": [7, 2]}
    assert back.cell_data["gmsh:physical"][0].tolist() == [4, 7]


def test_pyvista_gets_elements_and_fields(monkeypatch):
    class Grid:
        def __init__(self, *arrays):
            self.arrays, self.cell_data, self.point_data, self.field_data = arrays, {}, {}, {}
            self.n_cells = len(arrays[1]) // 4 if len(arrays) == 2 else len(arrays[1])

    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(PolyData=Grid, UnstructuredGrid=Grid))
    plain = carreau.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 1, 2), (1, 3, 2)], face_ids=[1, 2])
    plain.add_field("flux", [5, 6])
    made = plain.to_pyvista()
    assert made.arrays[1].tolist() == [3, 0, 1, 2, 3, 1, 3, 2] and made.cell_data["flux"].tolist() == [5, 6]
    assert made.field_data["face_names"] == ["", ""]
    assert made.cell_data["group"].tolist() == [1, 2]
    assert made.field_data["group_names"] == ["face_1", "face_2"] and made.field_data["group_numbers"] == [1, 2]
    dome = lambda u, v: (u, v, u * u + v * v)  # noqa: E731
    mesh = carreau.mesh(dome, domain=(0, 0, 1, 1), size=0.5, element="p2")
    curved = mesh.to_pyvista()
    assert set(curved.arrays[1]) == {22} and len(curved.arrays[0]) == 7 * curved.n_cells
    mesh.add_field("flux", np.arange(len(mesh.triangles)))
    curved = mesh.to_pyvista(edges=True)
    n = len(mesh.triangles)
    assert curved.arrays[1].tolist() == [22] * n + [21] * len(mesh.edges) and curved.cell_data["curve"][n:].tolist() == mesh.curve_ids.tolist()
    assert curved.cell_data["face"].tolist() == [1] * n + [0] * len(mesh.edges) == curved.cell_data["group"].tolist()
    assert curved.cell_data["flux"][:n].tolist() == list(range(n)) and np.isnan(curved.cell_data["flux"][n:]).all()


@pytest.mark.parametrize("order", [3, 4])
@pytest.mark.parametrize("element", ["p2", "q2.1"])
def test_orders_three_and_four_keep_groups_and_edges(tmp_path, order, element):
    meshio, vtk = pytest.importorskip("meshio"), pytest.importorskip("vtk")
    session = carreau.Session(hphydef=0.4, element=element)
    session.add(carreau.Patch(lambda u, v: (u, v, 0.3 * u * v)))
    mesh = session.generate()
    raised = session.raise_order(order)
    width = (order + 1) * (order + 2) // 2 if element == "p2" else (order + 1) ** 2
    made = raised.to_meshio(mesh)
    name = f"{'triangle' if element == 'p2' else 'quad'}{width}"
    assert [block.type for block in made.cells] == [name, f"line{order + 1}"]
    assert made.field_data["face_1"].tolist() == [1, 2] and set(made.cell_data["gmsh:physical"][1]) == set(mesh.curve_ids)
    made.write(tmp_path / "raised.msh", file_format="gmsh22")
    back = carreau.read(tmp_path / "raised.msh")
    assert back.order == order and len(back.edges) == len(mesh.edges)

    class Grid:
        def __init__(self, rows, kinds, points):
            self.rows, self.kinds, self.points, self.n_cells = rows, kinds, points, len(kinds)
            self.cell_data, self.point_data, self.field_data = {}, {}, {}

    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "pyvista", types.SimpleNamespace(UnstructuredGrid=Grid))
        grid = raised.to_pyvista(mesh)
    lines = len(raised.edges)
    assert grid.kinds.tolist() == [69 if element == "p2" else 70] * (grid.n_cells - lines) + [68] * lines
    assert grid.cell_data["curve"][-lines:].tolist() == raised.edge_refs.tolist() and grid.field_data["group_names"] == ["face_1"]
    # VTK's own places of the nodes of a cell give the nodes: u and v are the first coordinates, and cells are affine in them but for improved places.
    cell = vtk.vtkLagrangeTriangle() if element == "p2" else vtk.vtkLagrangeQuadrilateral()
    cell.GetPointIds().SetNumberOfIds(width), cell.GetPoints().SetNumberOfPoints(width)
    if element != "p2":
        cell.SetOrder(order, order)
    cell.Initialize()
    places = np.array([cell.GetParametricCoords()[k] for k in range(3 * width)]).reshape(-1, 3)[:, :2]
    nodes = raised.nodes[grid.rows[: (width + 1) * (grid.n_cells - lines)].reshape(-1, width + 1)[:, 1:]]
    r, s = places[:, 0, None], places[:, 1, None]
    for corner in nodes:
        if element == "p2":
            expected = (1 - r - s) * corner[0] + r * corner[1] + s * corner[2]
        else:
            expected = (1 - r) * (1 - s) * corner[0] + r * (1 - s) * corner[1] + r * s * corner[2] + (1 - r) * s * corner[3]
        assert np.allclose(corner[:, :2], expected[:, :2], atol=0.03)
