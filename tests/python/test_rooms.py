# SPDX-License-Identifier: BSD-3-Clause
"""Other functions of a session and of the modules, by mathematics."""
import math
import os

import numpy as np
import pytest

import carreau
from carreau import metric
from hosts import TORUS_AREA, TORUS_BOX, torus


def random_metrics(n, d, seed=1):
    a = np.random.default_rng(seed).normal(size=(n, d, d))
    m = a @ a.transpose(0, 2, 1) + 0.1 * np.eye(d)
    upper = np.triu_indices(d)
    return m, m[:, upper[0], upper[1]]


@pytest.mark.parametrize("d", [2, 3])
def test_metric_sizes_match_eigenvalues(d):
    full, rows = random_metrics(50, d)
    sizes, axes = metric.sizes(rows)
    values, _ = np.linalg.eigh(full)
    assert np.allclose(sizes, 1 / np.sqrt(values[:, ::-1]), rtol=1e-10)
    assert np.allclose(np.einsum("nij,njk,nik->ni", axes, full, axes), sizes ** -2, rtol=1e-9)
    assert np.allclose(metric.of_sizes(sizes, axes), rows, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("d", [2, 3])
def test_metric_reduction_interpolation_and_intersection(d):
    p_full, p = random_metrics(30, d, 2)
    q_full, q = random_metrics(30, d, 3)
    of_p, of_q, directions = metric.reduce(p, q)
    for full, sizes in ((p_full, of_p), (q_full, of_q)):
        products = directions @ full @ directions.transpose(0, 2, 1)
        assert np.allclose(products, products * np.eye(d), atol=1e-8)
        assert np.allclose(np.diagonal(products, axis1=1, axis2=2), sizes ** -2, rtol=1e-8)
    assert np.allclose(metric.interpolate(p, q, 0), p, rtol=1e-8) and np.allclose(metric.interpolate(p, q, 1), q, rtol=1e-8)
    both = metric.intersect(np.stack([p, q], axis=1))
    vectors = np.random.default_rng(4).normal(size=(30, d))
    upper = np.triu_indices(d)
    full = np.zeros((30, d, d))
    full[:, upper[0], upper[1]] = full[:, upper[1], upper[0]] = both
    length = lambda m: np.einsum("ni,nij,nj->n", vectors, m, vectors)  # noqa: E731
    assert np.all(length(full) >= np.maximum(length(p_full), length(q_full)) * (1 - 1e-9))


def test_metric_lengths():
    h = np.array([[0.1, 0.1], [0.2, 0.2]])
    edges = np.array([[[0, 0], [1, 0]], [[0, 0], [0, 3]]], dtype=float)
    rows = np.stack([metric.isotropic(h[:, 0], 2), metric.isotropic(h[:, 1], 2)], axis=1)
    assert np.allclose(metric.lengths(edges, rows), [10, 15], rtol=1e-4)
    with pytest.raises(carreau.ArgumentError, match="positive definite"):
        metric.sizes([[1, 2, 1]])


def test_curves_are_split_in_their_metric():
    # Sizes h(s) = 0.1 + 0.1 s along a line of length 3: its length is the integral of 1 / h, 10 ln 4.
    s = np.linspace(0, 3, 31)
    line = np.column_stack([s, 0 * s])
    cuts, length = metric.split(line, metric.isotropic(0.1 + 0.1 * s, 2))
    assert length == pytest.approx(10 * math.log(4), rel=1e-3) and len(cuts) == round(length) + 1
    assert cuts[0] == 0 and cuts[-1] == pytest.approx(3)
    each = 10 * np.diff(np.log(1 + cuts))
    assert np.allclose(each, length / (len(cuts) - 1), rtol=2e-3)
    with pytest.raises(carreau.ArgumentError):
        metric.split(line, np.tile((-1, 0, -1), (len(s), 1)))
    with pytest.raises(ValueError, match="31 x 3"):
        metric.split(line, metric.isotropic(1 + s, 2)[:5])


def test_a_plane_with_a_hole():
    ring = lambda r, n: r * np.stack([np.cos(np.arange(n) * 2 * np.pi / n), np.sin(np.arange(n) * 2 * np.pi / n)], axis=1)  # noqa: E731
    outer, inner = ring(1, 64), ring(0.4, 32)
    mesh = carreau.mesh(carreau.polygons(outer, inner), size=0.08)
    area = lambda p: 0.5 * np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))  # noqa: E731
    assert mesh.quality.area == pytest.approx(area(outer) - area(inner), rel=1e-12)
    assert mesh.dimension == 2 and np.all(mesh.vertices[:, 2] == 0) and mesh.check() == []
    with pytest.raises(carreau.ModelError):
        carreau.mesh(carreau.polygons([(0, 0), (1, 1), (1, 0), (0, 1)]), size=0.1)


def test_subdomains_and_splines():
    points = [(0, 0), (2, 0), (2, 1), (0, 1), (1, 0), (1, 1)]
    domain = carreau.PlaneDomain(points, [[0, 4, 1, 2, 5, 3, 0], [4, 5]], seeds=[(0.5, 0.5), (1.5, 0.5)], seed_refs=[11, 12])
    mesh = carreau.mesh(domain, size=0.2)
    assert [mesh.areas[mesh.face_ids == ref].sum() for ref in (11, 12)] == pytest.approx([1, 1])
    n = 12
    circle = [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]
    spline = carreau.mesh(carreau.PlaneDomain(circle, [list(range(n)) + [0]], kinds="spline"), size=0.05)
    assert spline.quality.area == pytest.approx(math.pi, rel=5e-3)
    arcs = carreau.mesh(carreau.PlaneDomain([(1, 0), (-1, 0)], [[0, 1, 0]], kinds="arcs"), size=0.05)
    assert arcs.quality.area == pytest.approx(math.pi, rel=5e-3)


def test_plane_takes_files_polygons_and_sizes(tmp_path, source):
    square = carreau.plane([[(0, 0), (1, 0), (1, 1), (0, 1)]], size=0.1)
    assert square.dimension == 2 and square.quality.area == pytest.approx(1)
    plate = carreau.plane(os.path.join(source, "tests/data/plane/plate.poly"), size=0.2)
    assert plate.check() == [] and plate.dimension == 2
    stretched = carreau.plane([[(0, 0), (1, 0), (1, 1), (0, 1)]], metric=lambda x: np.tile((0.05, 0.2, 1, 0, 0), (len(x), 1)))
    assert np.abs(np.diff(stretched.vertices[stretched.edges], axis=1)).max(axis=0)[0, 1] > 0.15
    carreau.fields(square, tmp_path / "f.png", longest=32, face=1)
    assert (tmp_path / "f.png").stat().st_size > 0
    carreau.fields("z = x * y", tmp_path / "g.exr", longest=16, channels=["size", "mask"], size=0.3)
    assert list(tmp_path.glob("g.face.1.exr"))


def test_sizes_on_curves_and_at_points():
    def boundary(**named):
        session = carreau.Session(hphydef=0.25, hphymin=0.001, hphymax=1, hphy_flag=2)
        session.add(carreau.Patch(lambda u, v: (u, v, 0 * u)))
        session.set_sizes(**named)
        return len(session.generate().edges)
    assert boundary(on_curve=lambda t: 0.05) == 80
    assert boundary(on_curve=lambda ic: 0.05 if ic == 1 else 0.5) == 20 + 3 * 2
    assert boundary(at_point=lambda point: 0.1, on_curve=lambda t: None) == 40


def test_refined_triangles_are_on_the_smooth_surface():
    coarse = carreau.mesh(torus, domain=TORUS_BOX, size=0.5)
    session = carreau.Session()
    session.add_triangles(coarse.vertices, coarse.triangles)
    fine = session.refine_triangles(5)
    assert len(fine.triangles) > 2 * len(coarse.triangles) and fine.check(closed=True) == []
    assert TORUS_AREA - fine.quality.area < (TORUS_AREA - coarse.quality.area) / 2
    assert len(session.refine_triangles(5, depth=0).triangles) == len(coarse.triangles)


def test_bezier_nets_and_their_points():
    net = np.zeros((2, 2, 3))
    net[1, :, 0], net[:, 1, 1], net[1, 1, 2] = 1, 1, 1  # z = u v
    session = carreau.Session(hphydef=0.1)
    session.add_bezier([net])
    uv = np.random.default_rng(5).random((20, 2))
    assert np.allclose(session.points(1, uv), np.column_stack([uv, uv.prod(axis=1)]), atol=1e-15)
    assert session.geometries[0].kind == carreau.capi.GEOMETRY_BEZIER and session.faces.tolist() == [1]
    assert len(session.generate().triangles) > 100


def test_a_ball_as_molecule():
    areas = carreau.areas(([(0, 0, 0)], [2.0]), probe=1.4)
    assert areas.vws.area == pytest.approx(16 * math.pi) and areas.sas.volume == pytest.approx(4 / 3 * math.pi * 3.4 ** 3)
    session = carreau.Session()
    session.add_molecule([(0, 0, 0), (1.5, 0, 0)], [1.0, 1.0], surface="vws")
    mesh = carreau.mesh(session, size=0.1, eps_ends=1e-9)
    cap = 2 * math.pi * (1 - 0.75)
    assert session.molecule.area == pytest.approx(2 * (4 * math.pi - cap)) and session.atom_areas().sum() == pytest.approx(session.molecule.area)
    assert session.atom_names() == ["", ""]
    assert mesh.quality.area == pytest.approx(session.molecule.area, rel=3e-3) and mesh.check(closed=True) == []


def test_a_grid_of_a_cylinder():
    angle, z = np.linspace(0, math.pi, 40), np.linspace(0, 2, 15)
    nodes = np.stack(np.broadcast_arrays(np.cos(angle)[None, :], np.sin(angle)[None, :], z[:, None]), axis=2)
    session = carreau.Session(hphydef=0.1)
    session.add_grid(nodes)
    assert session.generate().quality.area == pytest.approx(2 * math.pi, rel=2e-3)


def test_ridges_of_a_grid_are_edges():
    t, y = np.linspace(-1.25, 1.25, 32), np.linspace(0, 2, 11)  # an elliptic cylinder: its radius is .5 along (2, y, 0)
    nodes = np.stack(np.broadcast_arrays(2 * np.cos(t)[None, :], y[:, None], np.sin(t)[None, :]), axis=2)
    session = carreau.Session(hphydef=0.25)
    session.add_grid(nodes, continuity=2)
    assert session.embed_ridges(0.4) == 0 and session.embed_ridges(0.6) == 1
    mesh = session.generate()
    on = np.hypot(mesh.vertices[:, 0] - 2, mesh.vertices[:, 2]) < 1e-3
    ridge = mesh.edges[np.all(on[mesh.edges], axis=1)]
    assert np.abs(np.diff(mesh.vertices[ridge][:, :, 1], axis=1)).sum() == pytest.approx(2)


def test_another_mesh_of_triangles():
    first = carreau.mesh(torus, domain=TORUS_BOX, size=0.15)
    again = carreau.mesh((first.vertices, first.triangles), size=0.3)
    assert again.quality.area == pytest.approx(TORUS_AREA, rel=0.02) and again.check(closed=True) == []
    report = again.session.triangles
    assert report.euler_number == 0 and report.triangles == len(first.triangles)
    assert max(again.session.triangles_distances()) < 0.05
    there, back = again.session.triangles_distances()
    bounds = again.session.triangles_bounds(share=1e-3)
    assert there <= bounds[1] <= 1.001 * bounds[0] + 1e-5 and back <= bounds[3] <= 1.001 * bounds[2] + 1e-5
    delivered = again.session.delivered
    assert bounds[0] <= delivered.input_bound <= 1.01 * bounds[1] + 1e-5
    assert len(carreau.mesh(first, size=0.3).triangles) == len(again.triangles)


def test_two_surfaces_of_triangles_and_a_patch():
    first = carreau.mesh(torus, domain=TORUS_BOX, size=0.3)
    session = carreau.Session()
    session.add_triangles(first.vertices, first.triangles)
    session.add_triangles(first.vertices + [0, 0, 10], first.triangles)
    session.add_bezier([np.array([[[10, 0, 0], [10, 1, 0]], [[11, 0, 0], [11, 1, 0]]], dtype=float)])
    session["hphydef"] = 0.3
    mesh = session.generate()
    assert session.triangles.shells == 2 and mesh.quality.area == pytest.approx(2 * TORUS_AREA + 1, rel=0.03)
    assert len(mesh.faces) == 3


def test_an_atlas_of_a_sphere():
    coarse = carreau.mesh([carreau.Patch(lambda u, v, s=s: (2 * u / (1 + u * u + v * v) * s, 2 * v / (1 + u * u + v * v),
                                                            s * (u * u + v * v - 1) / (1 + u * u + v * v)), carreau.disc(0, 0, 1))
                           for s in (1, -1)], size=0.3)
    atlas = carreau.Atlas(coarse.vertices, coarse.triangles)
    assert atlas.counts.charts > 3
    frame = atlas.chart(0)
    assert np.linalg.norm(frame.normal) == pytest.approx(1)
    mesh = carreau.mesh(atlas, size=0.15)
    assert mesh.check(closed=True) == []
    assert np.allclose(np.linalg.norm(mesh.vertices, axis=1), 1, atol=0.03)


def test_loops_and_annuli():
    corner = lambda r, n, turn=0: r * np.stack([np.cos(turn + np.arange(n) * 2 * np.pi / n), np.sin(turn + np.arange(n) * 2 * np.pi / n)], axis=1)  # noqa: E731
    hexagon = corner(1, 6)
    loop = carreau.Loop(hexagon, smooth=True)
    phi = np.linspace(0.05, 6.2, 40)
    points, derivatives = loop.points(phi)
    assert np.allclose(loop.invert(points), phi, atol=1e-9) and np.allclose(loop.points([0.0])[0], hexagon[0])
    # Points of this polygon lie between its inscribed and circumscribed circles.
    assert np.all(np.linalg.norm(points, axis=1) <= 1 + 1e-12) and np.all(np.linalg.norm(points, axis=1) >= math.sqrt(3) / 2 - 1e-12)
    ahead = loop.points(phi + 1e-6)[0]
    assert np.median(np.linalg.norm((ahead - points) / 1e-6 - derivatives, axis=1)) < 1e-4
    with pytest.raises(carreau.DomainError):
        carreau.Loop(hexagon[::-1])
    annulus = carreau.Annulus(hexagon, corner(2, 6))
    places = np.column_stack([np.linspace(0.1, 0.9, 20), np.linspace(0.1, 6, 20)])
    inside, _ = annulus.points(places)
    again, zones = annulus.invert(inside)
    assert np.allclose(again, places, atol=1e-8) and set(zones.tolist()) == {1}
    assert annulus.invert([(0, 0), (9, 9)])[1].tolist() == [2, 0]
    assert len(annulus.pivots) >= 1 and annulus.outer_border.shape[1] == 2 and annulus.skeleton.shape[1:] == (2, 2)


def test_adaptation_meets_its_tolerance():
    front = lambda x, y: np.tanh(20 * (x * x + y * y - 0.25))  # noqa: E731
    mesh = carreau.adapt("z = 0 * x", front, tolerance=0.02, size="5%", gradation=2)
    report = mesh.session.adaptation
    assert report.error_max < report.error_max_before / 4 and report.iterations > 0
    middles = mesh.vertices[mesh.triangles].mean(axis=1)
    linear = front(*mesh.vertices[:, :2].T)[mesh.triangles].mean(axis=1)
    assert np.sqrt(np.mean((linear - front(*middles[:, :2].T)) ** 2)) < 0.02
    stretched = carreau.adapt("z = 0 * x", front, tolerance=0.02, size="5%", gradation=2, shape="anisotropic")
    assert len(stretched.triangles) < len(mesh.triangles)
    bent = carreau.adapt("z = x * x", lambda x: 0 * x, size="10%", angle=3)
    assert len(bent.triangles) > 3 * len(carreau.adapt("z = x * x", lambda x: 0 * x, size="10%").triangles)
    with pytest.raises(carreau.CallbackError) as caught:
        carreau.adapt("z = 0 * x", lambda x: 1 / 0)
    assert isinstance(caught.value.__cause__, ZeroDivisionError)


def test_estimates_and_transfers():
    session = carreau.Session(hphydef=0.1, hphymin=1e-3, hphymax=1)
    session.add(carreau.Patch(lambda u, v: (u, v, 0 * u)))
    mesh = session.generate()
    values = mesh.vertices[:, 0] ** 2 / 2  # second derivative 1: e = h^2 / 8 for a linear interpolation along x
    sizes = session.estimate(values, tolerance=0.005)
    inside = np.all((mesh.vertices[:, :2] > 0.2) & (mesh.vertices[:, :2] < 0.8), axis=1)
    assert np.ptp(sizes[inside]) < 0.05 * sizes[inside].mean()
    # The graph of the field is a sphere of radius 2: sizes are 2 R sin(8 degrees) in its tangent planes, and z / R of it in the plane.
    z = np.sqrt(4 - np.sum(mesh.vertices[:, :2] ** 2, axis=1))
    xx, xy, _, yy = session.estimate(z, tolerance=8, source="curvature", shape="graph", recovery="quadric")[:, :4].T
    shortest = ((xx + yy) / 2 + np.hypot((xx - yy) / 2, xy)) ** -0.5
    assert abs(np.mean((shortest / (2 * np.sin(np.radians(8)) * z))[inside]) - 1) < 0.1
    session.set_vertex_sizes(np.full(len(sizes), 0.05))
    fine = session.generate()
    assert len(fine.triangles) > 3 * len(mesh.triangles)
    assert np.allclose(session.transfer(mesh.vertices[:, :2] @ (1, 2)), fine.vertices[:, :2] @ (1, 2))
    assert session.transfer(mesh.vertices).shape == fine.vertices.shape
    session.clear_background()
    session.add_attractor([[0, 0, 0]], [[0, 0, 0]], 0.01, 0.2, 0.5)
    fine = session.generate()
    session.clear_attractors()
    session.add_layers([1], 0.002, ratio=1.3, count=4)
    session.generate()
    report = session.layers()
    assert report.rows == 4 and abs(report.first_mean - 0.002) < 1e-4 and abs(report.growth_mean - 1.3) < 0.01
    session.clear_layers()
    assert len(fine.triangles) > len(session.generate().triangles)
    session.set_background(mesh.vertices, mesh.triangles, sizes=np.full(len(mesh.vertices), 0.2))
    assert len(session.generate().triangles) < len(mesh.triangles) and session.background.outside == 0


def test_remeshing_carries_fields():
    square = carreau.mesh(carreau.polygons([(0, 0), (1, 0), (1, 1), (0, 1)]), size=0.1)
    xy = square.vertices[:, :2]
    nodal = np.column_stack([xy @ (1, 2), np.ones(len(xy))])
    mass = np.random.default_rng(6).random(len(square.triangles))
    next_one = carreau.remesh(xy, square.triangles, h_min=0.03, h_max=0.08, step=0.01, nodal=nodal, elements=mass, conserved=[True],
                              damage=np.zeros(len(mass)), curves="polygon")
    mesh = next_one.mesh
    assert next_one.summary.area == pytest.approx(1) and mesh.dimension == 2 and len(mesh.triangles) > len(square.triangles)
    assert np.allclose(next_one.nodal, np.column_stack([mesh.vertices[:, :2] @ (1, 2), np.ones(len(mesh.vertices))]))
    assert (next_one.elements * mesh.areas).sum() == pytest.approx((mass * square.areas).sum())
    assert next_one.damage.max() == 0 and next_one.elements.ndim == 1
    with pytest.raises(carreau.ArgumentError):
        carreau.remesh(xy, square.triangles, h_min=0.03, h_max=0.08, step=1.0)


def test_elements_of_second_order_and_quadrilaterals():
    curved = carreau.mesh(torus, domain=TORUS_BOX, size=0.4, element="p2")
    nodes, refs = curved.cells["triangle6"]
    assert nodes.shape == (len(curved.triangles), 6) and set(refs.tolist()) == {1}
    straight_error = TORUS_AREA - curved.quality.area
    assert abs(TORUS_AREA - curved.cell_quality.area) < straight_error / 20
    quads = carreau.mesh("z = x * y", size=0.1, element="q1.1")
    assert "triangle" not in quads.cells and quads.cell_quality.quads4 == len(quads.cells["quad"][0])


def test_the_delivered_mesh(tmp_path):
    session = carreau.mesh(torus, domain=TORUS_BOX, size=0.2).session
    assert session.delivered.in_range > 0.9
    spread, values = session.measure("length")
    assert spread.values == len(values) and np.nanmean(values) == pytest.approx(spread.mean)
    ends, curves = session.measured_edges()
    assert len(ends) == len(values) and np.all(ends[:, 0] < ends[:, 1])
    assert sorted(map(tuple, ends[curves > 0].tolist())) == sorted(tuple(sorted(edge)) for edge in session.mesh.edges.tolist())
    bounds, counts = session.histogram("length")
    assert counts.sum() == np.isfinite(values).sum() and bounds[0] == -np.inf
    assert counts.tolist() == np.histogram(values[np.isfinite(values)], np.append(bounds, np.inf))[0].tolist()
    session.write_delivered(tmp_path / "delivered.json")
    assert "length" in (tmp_path / "delivered.json").read_text()
    with pytest.raises(carreau.ArgumentError, match="kind is one of"):
        session.measure("width")


def test_files_come_back(tmp_path):
    mesh = carreau.mesh("z = x * y", size=0.2)
    for suffix in (".mesh", ".meshb", ".vtu", ".msh"):
        mesh.write(tmp_path / ("x" + suffix))
        again = carreau.read(tmp_path / ("x" + suffix))
        assert np.array_equal(again.vertices, mesh.vertices) and np.array_equal(again.triangles, mesh.triangles)
    mesh.session.write_fields(tmp_path / "fields.png", longest=64)
    assert os.path.getsize(tmp_path / "fields.face.1.png") > 0
    (tmp_path / "x.sol").write_text(f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices {len(mesh.vertices)}\n1 1\n"
                                    + "".join(f"{x:.17g}\n" for x in mesh.vertices[:, 0]) + "End\n")
    mesh.session["hphydef"] = 0.1
    finer = mesh.session.generate()
    assert mesh.session.transfer_files(tmp_path / "x.mesh", tmp_path / "x.sol", tmp_path / "y.sol") == 0
    carried = [float(word) for word in (tmp_path / "y.sol").read_text().split("1 1\n")[1].split()[:-1]]
    assert np.allclose(carried, finer.vertices[:, 0], atol=0.02)  # the nearest point of a chord
    mesh.add_field("height", mesh.vertices[:, 2])
    mesh.write(tmp_path / "field.vtu")
    assert b"height" in (tmp_path / "field.vtu").read_bytes()


def test_arrays_become_a_mesh():
    mesh = carreau.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)], face_ids=[1, 2, 3, 3])
    assert mesh.check(closed=True) == [] and mesh.quality.area == pytest.approx(1.5 + math.sqrt(3) / 2)
    assert [face.triangles for face in mesh.faces] == [1, 1, 2]
    solids, inside = mesh.regions()
    assert solids.tolist() == [1] and min(inside[0]) > 0 and sum(inside[0]) < 1
    assert mesh.triangle_sides.tolist() == [[1, 0]] * 4
    crossing = carreau.Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.2, -1), (0.3, 0.2, 1), (0.2, 0.3, 1)], [(0, 1, 2), (3, 4, 5)])
    pairs, places = crossing.crossings()
    assert pairs.tolist() == [[0, 1]] and abs(places[0, 2]) < 1e-12
    with pytest.raises(carreau.ArgumentError):
        carreau.Mesh([(0, 0, 0)], [(0, 1, 2)])


def test_faces_that_fail_are_left_out(caplog):
    good = carreau.Patch(lambda u, v: (u, v, 0 * u))
    bad = carreau.Patch(lambda u, v: (u + 2, v, 0 * u), carreau.polygon([(0, 0), (1, 1), (1, 0), (0, 1)]))
    mesh = carreau.mesh([good, bad], size=0.2)
    assert [face.ref for face in mesh.failed] == [2] and mesh.failed[0].why
    assert mesh.quality.area == pytest.approx(1)
    assert any("face 2 has no mesh" in record.getMessage() for record in caplog.records)


def test_faces_are_images_of_each_other():
    session = carreau.Session(hphydef=0.2)
    session.add([carreau.Patch(lambda u, v, k=k: (u, v, k + 0.1 * np.sin(3 * u))) for k in range(2)])
    session.add_periodicity([2], [1], [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 1)])
    mesh = session.generate()
    dimension, slave, master, transform, nodes = mesh.periodic()[-1]
    assert (dimension, slave, master) == (2, 2, 1) and transform[2, 3] == 1 and 2 * len(nodes) == len(mesh.vertices)
    assert np.abs(mesh.vertices[nodes[:, 1]] + (0, 0, 1) - mesh.vertices[nodes[:, 0]]).max() < 1e-12
    with pytest.raises(carreau.ArgumentError):
        session.add_period((0, 0, 0))
    with pytest.raises(ValueError):
        session.add_periodicity([2], [])


def test_faces_are_left_out_by_hand():
    session = carreau.Session(hphydef=0.3)
    session.add([carreau.Patch(lambda u, v, k=k: (u + 2 * k, v, 0 * u)) for k in range(2)])
    session.leave_out_face(1, "not wanted")
    mesh = session.generate()
    assert set(mesh.face_ids.tolist()) == {2} and mesh.failed[0].why == "not wanted"
    session.leave_out_face(1, "")
    assert set(session.generate().face_ids.tolist()) == {1, 2}


def test_messages_go_to_the_logger(caplog):
    caplog.set_level("INFO", "carreau")
    session = carreau.mesh("z = x", size=0.3, verb=10).session
    assert session.messages and any(record.name == "carreau" for record in caplog.records)
