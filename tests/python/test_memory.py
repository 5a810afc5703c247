# SPDX-License-Identifier: BSD-3-Clause
"""Nothing is copied that need not be, nothing leaks, and nothing goes that is still in use."""
import ctypes
import gc
import resource
import weakref

import numpy as np
import pytest

import carreau
from carreau import _arrays
from hosts import TORUS_BOX, torus


def test_arrays_go_in_without_a_copy():
    given = np.arange(12.0).reshape(4, 3)
    assert _arrays.doubles(given, "given", None, 3) is given
    assert _arrays.Doubles.from_param(given).value == given.ctypes.data
    whole = np.arange(6, dtype=np.int32)
    assert _arrays.int32s(whole, "whole", None) is whole
    with pytest.raises(TypeError):
        _arrays.Doubles.from_param(given[:, ::2])  # not in C order: would be read as something else
    with pytest.raises(TypeError):
        _arrays.Doubles.from_param(whole)
    with pytest.raises(ValueError):
        _arrays.int32s([0.5], "half", None)
    with pytest.raises(ValueError):
        _arrays.int32s([2 ** 40], "large", None)


def test_callbacks_see_the_memory_of_the_library():
    memory = (ctypes.c_double * 6)(*range(6))
    seen = _arrays.view(ctypes.addressof(memory), (3, 2))
    assert seen.ctypes.data == ctypes.addressof(memory) and not seen.flags.owndata
    seen[1, 1] = 42
    assert memory[3] == 42
    asked = []

    def surface(uv):
        asked.append((uv.flags.owndata, uv.flags.writeable, uv.base is not None))
        return np.stack(torus(uv[:, 0], uv[:, 1]), axis=1)

    session = carreau.Session(hphydef=0.5)
    session.add(carreau.Patch(surface, TORUS_BOX))
    session.generate()
    assert set(asked) == {(False, False, True)}


def test_results_are_filled_where_they_lie():
    mesh = carreau.mesh(torus, domain=TORUS_BOX, size=0.5)
    for array in (mesh.vertices, mesh.triangles, mesh.edges, mesh.face_ids, mesh.corner_uv):
        assert array.flags.owndata and array.flags.c_contiguous and not array.flags.writeable
    meshio = pytest.importorskip("meshio")
    converted = mesh.to_meshio()
    assert isinstance(converted, meshio.Mesh)
    assert np.shares_memory(converted.points, mesh.vertices)


def test_arrays_outlive_everything():
    mesh = carreau.mesh(torus, domain=TORUS_BOX, size=0.5)
    area, vertices, triangles = mesh.quality.area, mesh.vertices, mesh.triangles
    session = weakref.ref(mesh.session)
    mesh.session.close()
    del mesh
    gc.collect()
    assert session() is None
    assert carreau.Mesh(vertices, triangles).quality.area == area


def test_callbacks_live_as_long_as_their_session():
    session = carreau.Session(hphydef=0.5)
    session.add(carreau.Patch(lambda u, v: torus(u, v), TORUS_BOX))
    session.set_sizes(lambda x: np.full(len(x), 0.4))
    gc.collect()
    garbage = [bytearray(100) for _ in range(10000)]
    assert len(session.generate().triangles) > 0
    assert session.delivered.triangles > 0  # asks them again
    del garbage


def test_a_mesh_is_measured_with_the_sizes_that_made_it():
    session = carreau.Session(hphydef=0.5, hphymin=0.1)
    session.add(carreau.Patch(torus, TORUS_BOX))
    asked = []
    first = lambda x: asked.append("first") or np.full(len(x), 0.4)  # noqa: E731
    session.set_sizes(first)
    session.generate()
    asked.clear()
    gone = weakref.ref(first)
    del first
    for _ in range(3):
        session.set_sizes(lambda x: np.full(len(x), 0.2))
    gc.collect()
    assert session.delivered.in_range > 0.8 and set(asked) == {"first"}
    session.generate()
    gc.collect()
    assert gone() is None


def test_no_cycle_keeps_a_session():
    gc.collect()
    gc.disable()
    try:
        function = lambda u, v: torus(u, v)  # noqa: E731
        gone = weakref.ref(function)
        session = carreau.Session(hphydef=0.5)
        session.add(carreau.Patch(function, TORUS_BOX))
        session.set_sizes(lambda x: np.full(len(x), 0.4))
        mesh = session.generate(progress=lambda *_: None)
        seen = weakref.ref(session)
        del session, function
        assert seen() is not None  # the mesh has it
        del mesh
        assert seen() is None and gone() is None
    finally:
        gc.enable()


def test_an_earlier_mesh_stays_as_it_was():
    session = carreau.Session(hphydef=0.5)
    session.add(carreau.Patch(torus, TORUS_BOX))
    first = session.generate()
    quality, count = first.quality, len(first.triangles)
    session["hphydef"] = 0.3
    second = session.generate()
    assert len(second.triangles) > count == len(first.triangles)
    assert first.quality == quality and first.quality.triangles == count
    assert second.quality.triangles == len(second.triangles)


def test_a_thousand_runs_take_no_more_memory_than_a_hundred():
    def run(times):
        for _ in range(times):
            carreau.mesh(torus, domain=TORUS_BOX, size=1.0, threads=1)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    early = run(100)
    assert run(300) - early < 4096  # KiB; a leak of a mesh each were 300 times some 50
