# SPDX-License-Identifier: BSD-3-Clause
"""Parameters and files of sessions, charts of atlases, questions to CAD files, domains."""
import math
import os
import subprocess
import threading

import numpy as np
import pytest

import carreau
from carreau import domains
from conftest import needs
from hosts import TORUS_BOX, torus


def test_parameters_are_set_read_and_reset(tmp_path):
    session = carreau.Session(hphydef=0.25)
    assert session.is_set("hphydef") and session["hphydef"] == 0.25
    session.reset("hphydef")
    assert not session.is_set("hphydef")  # a share of a diagonal that nobody knows yet
    env = tmp_path / "x.env"
    env.write_text("hphydef 0.125\nangle_mesh 6\ncall exit\n")
    session.read_env(env)
    assert session["hphydef"] == 0.125 and session["angle_mesh"] == 6
    session.reset()
    assert session["angle_mesh"] == carreau.parameters()["angle_mesh"].default_number
    env.write_text("hphydef 0.5\nhphydeff 1\ncall exit\n")
    with pytest.raises(carreau.CarreauError, match="hphydeff") as caught:
        session.read_env(env)
    assert caught.value.line == 2


def test_a_blsurf_env_runs(tmp_path):
    mesh = carreau.mesh(torus, domain=TORUS_BOX, size=0.5)
    env = tmp_path / "blsurf.env"
    env.write_text("hphydef 0.5\ncall inimesh\npref torus\ncall export\ncall exit\n")
    mesh.session.run_env(env)
    written = carreau.read(tmp_path / "torus.mesh")
    assert len(written.triangles) > 500 and 2 * len(written.vertices) == len(written.triangles)  # Euler's number of a torus is 0


def test_points_are_projected_to_the_geometry_of_a_mesh():
    session = carreau.mesh(torus, domain=TORUS_BOX, size=0.5).session
    x = np.random.default_rng(1).uniform(-4, 4, (200, 3))
    found = session.project(x)
    assert np.allclose(np.linalg.norm(found.xyz - x, axis=1), found.distances, atol=1e-12)
    assert set(found.refs) == {1}
    at = session.evaluate(found.parameters, ref=1, order=2)
    assert np.allclose(at.xyz, found.xyz, atol=1e-12) and at.second.shape == (200, 3, 3)
    assert np.abs(np.einsum("nij,nj->ni", at.first, x - at.xyz)).max() < 1e-7  # the closest point lies on a normal
    curves = session.project(x, dimension=1)
    assert (curves.distances >= found.distances - 1e-12).all() and curves.parameters.shape == (200, 1)
    ref = int(curves.refs[0])
    assert np.allclose(session.evaluate(curves.parameters[:1], ref, dimension=1).xyz, curves.xyz[:1], atol=1e-10)
    assert session.project(x, dimension=0).parameters.shape == (200, 0)
    with pytest.raises(carreau.CarreauError, match="77"):
        session.project(x, ref=77)
    for dimension in (0, -1, 3):
        with pytest.raises(carreau.CarreauError, match=f"dimension is {dimension}"):
            session.evaluate([[0.5, 0.5]], ref=1, dimension=dimension)


def test_places_of_space_are_embedded():
    session = carreau.mesh(torus, domain=TORUS_BOX, size=0.5).session
    t = np.linspace(-1, 1, 41)
    x, y, z = session.evaluate([[0.0, 0.5]], ref=1).xyz[0]
    line = np.stack([x * np.cos(t) - y * np.sin(t), x * np.sin(t) + y * np.cos(t), np.full(41, z)], axis=1)  # across a seam
    curve = session.embed_polyline(line, "equator")
    point = session.embed_point(session.project([[-9, 0.5, 0.5]]).xyz[0])
    assert session.embed_wires() == 0
    mesh = session.generate()
    on = mesh.vertices[mesh.edges[mesh.curve_ids == curve].ravel()]
    assert len(on) > 4 and np.allclose(np.hypot(on[:, 0], on[:, 1]), np.hypot(x, y), atol=1e-2) and np.allclose(on[:, 2], z, atol=1e-2)
    assert (mesh.vertex_ids == point).sum() == 1
    with pytest.raises(carreau.CarreauError, match="embed_tolerance"):
        session.embed_point([0, 0, 0])


def ring(radius):
    """A torus of this radius around the circle of radius 3."""
    session = carreau.Session(hphydef=1)
    session.add(carreau.Patch(lambda u, v: ((3 + radius * np.cos(v)) * np.cos(u), (3 + radius * np.cos(v)) * np.sin(u), radius * np.sin(v)), domain=TORUS_BOX))
    return session


def test_meshes_follow_their_geometry():
    first = ring(1)
    mesh = first.generate()
    up, down = (ring(1 + d).carry(mesh) for d in (1e-4, -1e-4))
    assert (up.triangles == mesh.triangles).all()
    derivative = (up.vertices - down.vertices) / 2e-4  # of a point by the radius: its unit normal
    around = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 1])
    normal = mesh.vertices * np.stack([1 - 3 / around, 1 - 3 / around, np.ones(len(around))], 1)
    assert np.allclose(derivative, normal, atol=1e-7)
    with pytest.raises(ValueError, match="match"):
        ring(1).carry(mesh, match="colour")
    assert len(first.refine(elements=[0]).triangles) > len(mesh.triangles)
    with pytest.raises(ValueError, match="one of"):
        first.refine()
    edge = first.mesh.triangles[0, :2]
    before = len(first.mesh.triangles)
    assert len(first.refine(edges=[edge]).triangles) > before
    assert len(first.refine(sizes=np.full(len(first.mesh.vertices), 0.4)).triangles) > 4 * before
    before = len(first.mesh.triangles)
    assert len(first.halve().triangles) == 4 * before


@pytest.mark.parametrize("places", ["equidistant", "gauss-lobatto"])
def test_elements_of_order_three_and_four(tmp_path, places):
    session = ring(1)
    session["element"] = "p2"
    session.generate()
    for order in (3, 4):
        raised = session.raise_order(order, places)
        assert raised.invalid == 0 and raised.triangles.shape == (len(session.mesh.triangles), (order + 1) * (order + 2) // 2)
        assert np.allclose(np.hypot(np.hypot(raised.nodes[:, 0], raised.nodes[:, 1]) - 3, raised.nodes[:, 2]), 1, atol=1e-9)
        for suffix in ("msh", "vtu", "mesh"):
            session.write_raised(str(tmp_path / f"x.{suffix}"))
            read = carreau.read(tmp_path / f"x.{suffix}")
            assert read.order == order and len(read.triangles) == len(session.mesh.triangles)
            assert len(read.vertices) == len(session.mesh.vertices) and len(read.edges) == len(session.mesh.edges)
        text = (tmp_path / "x.mesh").read_text()
        assert text.startswith("MFEM mesh v1.0") and f"L2_T1_2D_P{order}" in text
        points = np.array(text[text.index("Ordering: 1") + 11:].split(), dtype=float).reshape(-1, 3)
        assert len(points) == raised.triangles.size
        corners = raised.nodes[raised.triangles[:, :3]]
        width = raised.triangles.shape[1]
        assert np.allclose(points[::width], corners[:, 0]) and np.allclose(points[order::width], corners[:, 1]) and np.allclose(points[width - 1::width], corners[:, 2])
    with pytest.raises(ValueError, match="places"):
        session.raise_order(3, "uniform")


def test_vertices_know_the_entities_that_they_lie_on():
    mesh = carreau.mesh(torus, domain=TORUS_BOX, size=0.5)
    dimensions, refs = mesh.vertex_entities()
    assert (dimensions == 0).sum() == 1 and (dimensions == 1).sum() == len(mesh.edges) - 2  # two closed seams through one corner
    assert (refs > 0).all() and ((dimensions == 0) == (mesh.vertex_ids != 0)).all()
    for dimension in (1, 2):
        k = dimensions == dimension
        for ref in set(refs[k].tolist()):
            on = mesh.vertices[k & (refs == ref)]
            assert mesh.session.project(on, dimension, ref).distances.max() < 1e-12
    t, faces, ics = mesh.edge_parameters()
    for ref in set(mesh.curve_ids.tolist()):
        k = mesh.curve_ids == ref
        for end in (0, 1):
            assert np.allclose(mesh.session.evaluate(t[k, end], ref, dimension=1).xyz, mesh.vertices[mesh.edges[k, end]], atol=1e-12)
    assert set(faces) == {1} and set(ics) <= {1, 2, 3, 4}


@needs("CARREAU_MAKE_SHAPES")
def test_vertices_of_a_mesh_across_patches_lie_on_their_curves(tmp_path):
    subprocess.run([os.environ["CARREAU_MAKE_SHAPES"], str(tmp_path)], check=True)
    for size in ("8%", "12%"):
        mesh = carreau.mesh(tmp_path / "bracket.step", size=size, independent=True)
        dimensions, refs = mesh.vertex_entities()
        assert (dimensions == 1).sum() > 60
        for ref in set(refs[dimensions == 1].tolist()):
            on = mesh.vertices[(dimensions == 1) & (refs == ref)]
            assert mesh.session.project(on, 1, ref).distances.max() < 1e-10, ref


@pytest.mark.parametrize("name", ["grid/volcano.txt", "molecule/caffeine.xyzr", "triangles/fading_line.off", "plane/plate.poly"])
def test_vertices_lie_on_geometries_of_any_kind(source, name):
    mesh = carreau.mesh(os.path.join(source, "tests/data", name), size="10%")
    scale = np.ptp(mesh.vertices, axis=0).max()
    found = mesh.session.project(mesh.vertices)
    assert found.distances.max() < 1e-12 * scale
    x = np.random.default_rng(2).uniform(mesh.vertices.min(0) - scale / 3, mesh.vertices.max(0) + scale / 3, (100, 3))
    far = mesh.session.project(x)
    nearest = np.linalg.norm(mesh.vertices[None] - x[:, None], axis=2).min(1)
    assert (far.distances <= nearest + 1e-12 * scale).all()
    for ref in set(far.refs.tolist()):
        k = far.refs == ref
        assert np.allclose(mesh.session.evaluate(far.parameters[k], ref).xyz, far.xyz[k], atol=1e-11 * scale)


def test_a_thread_stops_a_run():
    begun = threading.Event()
    session = carreau.mesh(torus, domain=TORUS_BOX, size=0.5).session
    session["hphydef"] = 0.003
    stopper = threading.Thread(target=lambda: (begun.wait(), session.stop()))
    stopper.start()
    with pytest.raises(carreau.Cancelled):
        session.generate(progress=lambda *_: begun.set())
    stopper.join()


def octahedron(times):
    xyz = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(times):
        known = {}

        def middle(a, b):
            if (min(a, b), max(a, b)) not in known:
                p = np.add(xyz[a], xyz[b])
                known[min(a, b), max(a, b)] = len(xyz)
                xyz.append(tuple(p / np.linalg.norm(p)))
            return known[min(a, b), max(a, b)]

        triangles = [t for a, b, c in triangles for ab, bc, ca in [(middle(a, b), middle(b, c), middle(c, a))]
                     for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    return np.array(xyz, dtype=float), np.array(triangles)


def test_charts_agree_where_they_overlap():
    atlas = carreau.Atlas(*octahedron(3))
    n, weights = atlas.counts.charts, np.zeros(1)
    # Places far from the middle of a chart are shared.
    for radius in np.linspace(0.1, 1, 30):
        place = np.array([[radius, 0.0]])
        if atlas.zones(0, place)[0][0] == 1:
            break
    zone, weights = atlas.zones(0, place)
    assert zone[0] == 1
    here = atlas.points(0, place)[0]
    shared = 0
    for j in range(1, n):
        there, found = atlas.transition(0, j, place)
        if not found[0]:
            assert np.isnan(there).all()
            continue
        shared += 1
        weights = weights + atlas.zones(j, there)[1]
        assert np.allclose(atlas.points(j, there)[0], here, atol=1e-9)
    assert shared >= 1 and abs(weights[0] - 1) < 1e-9


@needs("CARREAU_MAKE_SHAPES")
def test_a_cad_file_answers(source):
    file = carreau.CadFile(os.path.join(source, "tests/packages/cad/sphere.brep"))
    figures = file.figures(1)
    assert figures.kind == "sphere" and figures.area > 0
    report, dangers = file.inspect()
    assert report.faces == 1 and len(dangers) == report.dangers
    counts = []
    for size in (0.2, 0.1):
        session = carreau.Session(hphy_flag=2)
        file.add_to(session)
        file.set_face_size(1, size * math.sqrt(figures.area / (4 * math.pi)))
        counts.append(len(session.generate().triangles))
    assert abs(counts[1] / counts[0] - 4) < 0.4


def test_domains_enclose_their_areas():
    half = [domains.arc((0, 0), 2, 0, math.pi), domains.segment((-2, 0), (2, 0))]
    for domain, area in ((half, 2 * math.pi), ("ring:0,0,1,2", 3 * math.pi), ((0, 0, 3, 1), 3)):
        assert len(domains.domain_of(domain)) >= 2
        mesh = carreau.mesh(lambda u, v: (u, v, 0 * u), domain=domain, size=0.05)
        corners = mesh.vertices[mesh.triangles]
        found = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
        assert abs(found / area - 1) < 1e-3
    with pytest.raises(carreau.ArgumentError):
        domains.arc((0, 0), 0, 0, 1)


def test_surfaces_fill_arrays_up_to_an_order():
    surface = carreau.Surface(lambda u, v: (u, v, u * v))
    out = [np.full((2, 3), np.nan) for _ in range(6)]
    surface.fill(1, np.array([[1.0, 2.0], [3.0, 4.0]]), 0, out)
    assert np.array_equal(out[0], [[1, 2, 2], [3, 4, 12]]) and np.isnan(out[1]).all()


def test_curves_are_divided_as_prescribed():
    session = carreau.mesh(lambda u, v: (u, v, 0 * u), domain="box:0,0,1,1", size=0.5).session
    session.divide_curve(1, 1, 5, geometric=2)
    session.divide_curve(1, 2, 4, arithmetic=3)
    session.divide_curve(1, 3, [0.25, 0.3])
    xyz = session.generate().vertices

    def along(axis, other, value):
        return np.sort(xyz[xyz[:, other] == value][:, axis])

    assert np.allclose(np.diff(along(0, 1, 0)), 2.0 ** np.arange(5) / 31, rtol=1e-9)
    assert np.allclose(np.diff(along(1, 0, 1)), np.array([3, 5, 7, 9]) / 24, rtol=1e-9)
    assert np.allclose(along(0, 1, 1), [0, 0.7, 0.75, 1])
    session.divide_curve(1, 1, 0)
    with pytest.raises(carreau.ArgumentError):
        session.divide_curve(1, 3, [0.5, 0.25])
