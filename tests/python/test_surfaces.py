# SPDX-License-Identifier: BSD-3-Clause
"""Callbacks in Python get the calls that C gets, one by one or many at a time."""
import math

import numpy as np
import pytest

import carreau
from hosts import HostInC, TORUS_AREA, TORUS_BOX, same, sphere, torus, torus_of_floats

CAP = (-0.5, -0.5, 0.5, 0.5)


def generated(patch, **parameters):
    session = carreau.Session(**parameters)
    session.add(patch)
    return session.generate()


def in_c(name, box, size=None, **parameters):
    return HostInC(name, box, size=size).add_to(carreau.Session(**parameters)).generate()


def test_scalar_batched_and_c_make_one_mesh_bit_for_bit():
    reference = in_c("sphere_surface", CAP, hphydef=0.05)
    assert len(reference.triangles) > 500
    assert same(generated(carreau.Patch(sphere, CAP), hphydef=0.05), reference)
    assert same(generated(carreau.Patch(carreau.scalar(sphere), CAP), hphydef=0.05), reference)
    rows = carreau.Patch(lambda uv: np.stack(sphere(uv[:, 0], uv[:, 1]), axis=1), CAP)
    assert same(generated(rows, hphydef=0.05), reference)


def test_a_torus_by_the_functions_of_libm_is_identical_to_the_torus_in_c():
    assert same(generated(carreau.Patch(torus_of_floats, TORUS_BOX), hphydef=0.2), in_c("torus_surface", TORUS_BOX, hphydef=0.2))


def test_sizes_scalar_batched_and_in_c_are_the_same():
    reference = in_c("torus_surface", TORUS_BOX, size="torus_size", hphydef=0.2, hphymin=0.01)
    assert reference.sizes.min() < 0.06 and reference.sizes.max() > 0.12

    def with_sizes(function):
        session = carreau.Session(hphydef=0.2, hphymin=0.01)
        session.add(carreau.Patch(torus_of_floats, TORUS_BOX))
        session.set_sizes(function)
        return session.generate()

    one = with_sizes(carreau.scalar(lambda v: 0.05 + abs(math.sin(v)) / 10))
    assert same(one, reference)
    many = with_sizes(lambda v: np.array([0.05 + abs(math.sin(each)) / 10 for each in v]))
    assert same(many, reference)
    metric = with_sizes(lambda v: carreau.metric.isotropic([0.05 + abs(math.sin(each)) / 10 for each in v]))
    assert len(metric.triangles) == pytest.approx(len(reference.triangles), rel=0.02)


def test_sizes_get_the_points_in_space():
    seen = []

    def size(xyz, uv, face):
        seen.append((face, xyz.copy(), uv.copy()))
        return np.full(len(xyz), 0.3)

    carreau.mesh(torus, domain=TORUS_BOX, size=size)
    assert all(face == 1 and np.allclose(xyz, np.stack(torus(*uv.T), axis=1), atol=1e-12) for face, xyz, uv in seen)


def test_the_area_of_a_torus_converges_with_order_two():
    errors = [TORUS_AREA - carreau.mesh(torus, domain=TORUS_BOX, size=h).quality.area for h in (0.4, 0.2, 0.1)]
    assert errors[2] > 0
    for coarse, fine in zip(errors, errors[1:]):
        assert 3.2 < coarse / fine < 4.8


def test_two_halves_of_a_sphere_are_glued_and_close():
    north = carreau.Patch(lambda u, v: (sphere(v, u)[0], sphere(v, u)[1], -sphere(v, u)[2]), carreau.disc(0, 0, 1), name="north")
    south = carreau.Patch(sphere, carreau.disc(0, 0, 1), name="south")
    errors = []
    for h in (0.2, 0.1):
        mesh = carreau.mesh([south, north], size=h)
        assert mesh.check(closed=True) == [] and mesh.quality.open_edges == 0
        assert [face.name for face in mesh.faces] == ["south", "north"]
        assert len(mesh.vertices) - len(mesh.triangles) / 2 == 2  # Euler
        errors.append(4 * math.pi - mesh.quality.area)
    assert 3.2 < errors[0] / errors[1] < 4.8


def test_derivatives_given_and_found_agree():
    class Paraboloid:
        """The protocol: point, first, second."""

        def point(self, u, v):
            return u, v, (u * u + v * v) / 2

        def first(self, u, v):
            return (1, 0, u), (0, 1, v)

        def second(self, u, v):
            return (0, 0, 1), (0, 0, 0), (0, 0, 1)

    given = carreau.mesh(carreau.Patch(Paraboloid()), angle=4)
    report = given.session.report
    found = carreau.mesh(carreau.Patch(Paraboloid().point), angle=4)
    assert report.surf2_calls > 0 and found.session.report.surf2_calls == 0
    assert len(given.triangles) == pytest.approx(len(found.triangles), rel=0.03)


@pytest.mark.parametrize("derivatives, options, most_calls", [
    (True, {"size": 0.05}, 1.6), (True, {"angle": 6}, None), (False, {"size": 0.05}, 2.5), (False, {"angle": 6}, None)])
def test_places_of_callbacks(derivatives, options, most_calls):
    """In the closed domain, a disc, with and without derivatives (docs/explanation/guarantees.md)."""
    reach = []

    def seen(u, v):
        reach.append(np.hypot(u, v).max())
        return np.zeros_like(u), np.ones_like(u)

    def point(u, v):
        seen(u, v)
        return u, v, (u * u + v * v) / 2

    def first(u, v):
        zero, one = seen(u, v)
        return (one, zero, u), (zero, one, v)

    def second(u, v):
        zero, one = seen(u, v)
        return (zero, zero, one), (zero, zero, zero), (zero, zero, one)

    surface = carreau.Surface(point, first, second) if derivatives else carreau.Surface(point)
    mesh = carreau.mesh(carreau.Patch(surface, carreau.disc(0, 0, 1)), **options)
    assert max(reach) <= 1 + 1e-15
    calls = mesh.session.report
    assert calls.curv0_calls <= 400  # the domain is known by the samples of its curves
    if most_calls:
        assert calls.surf0_calls + calls.surf1_calls + calls.surf2_calls <= most_calls * len(mesh.vertices)


def test_curves_by_functions_and_imposed_points():
    ellipse = carreau.Curve(lambda t: (2 * np.cos(t), np.sin(t)), 0, math.pi)
    back = carreau.Curve(lambda t: np.stack([2 * np.cos(t), np.sin(t)], axis=1), math.pi, 2 * math.pi)
    assert ellipse.at(math.pi / 2) == pytest.approx((0, 1))
    patch = carreau.Patch(lambda u, v: (u, v, 0), [ellipse, back], points=[(0.3, 0.2)], point_refs=[7])
    mesh = carreau.mesh(patch, size=0.05)
    assert mesh.quality.area == pytest.approx(2 * math.pi, rel=2e-3)
    place, = np.flatnonzero(mesh.vertex_ids == 7)
    assert mesh.vertices[place].tolist() == [0.3, 0.2, 0]


def test_an_internal_curve_is_followed_by_edges():
    line = carreau.segment((0.2, 0.5), (0.8, 0.5), internal=True)
    mesh = carreau.mesh(carreau.Patch(lambda u, v: (u, v, 0 * u), carreau.box(0, 0, 1, 1) + [line]), size=0.1)
    ids = mesh.curve_ids[np.all(np.abs(mesh.vertices[mesh.edges][:, :, 1] - 0.5) < 1e-12, axis=1)]
    assert len(ids) >= 6 and len(set(ids.tolist())) == 1


def test_any_number_of_threads_makes_one_mesh():
    patches = [carreau.Patch(lambda u, v, k=k: (u + k, v, np.sin(3 * u) / 5)) for k in range(6)]
    assert same(carreau.mesh(patches, size=0.05, threads=1), carreau.mesh(patches, size=0.05, threads=4))


def test_sessions_in_threads_of_python_do_not_disturb_each_other():
    from concurrent.futures import ThreadPoolExecutor
    sizes = [0.2, 0.25, 0.3, 0.35]
    alone = [carreau.mesh(torus_of_floats, domain=TORUS_BOX, size=h) for h in sizes]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda h: carreau.mesh(torus_of_floats, domain=TORUS_BOX, size=h), sizes))
    assert all(same(a, b) for a, b in zip(alone, together))


def test_metrics_stretch_triangles():
    flat = carreau.Patch(lambda u, v: (u, v, 0 * u))
    mesh = carreau.mesh(flat, metric=lambda x: np.tile((1 / 0.02 ** 2, 0, 0, 1 / 0.1 ** 2, 0, 1 / 0.1 ** 2), (len(x), 1)))
    isotropic = carreau.mesh(flat, size=0.1)
    assert len(mesh.triangles) == pytest.approx(5 * len(isotropic.triangles), rel=0.25)
    directed = carreau.mesh(flat, metric=lambda x: np.tile((0.02, 0.1, 1, 0, 0), (len(x), 1)))
    assert len(directed.triangles) == pytest.approx(len(mesh.triangles), rel=0.05)
