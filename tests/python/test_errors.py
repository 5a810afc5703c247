# SPDX-License-Identifier: BSD-3-Clause
"""Errors are exceptions with their places, and the session stays usable."""
import math

import numpy as np
import pytest

import carreau
from hosts import TORUS_BOX, torus, torus_of_floats


class Unlucky(Exception):
    pass


def beyond(limit, message="too far"):
    def surface(u, v):
        if np.any(u > limit):
            raise Unlucky(message)
        return u, v, 0 * u
    return surface


def test_an_exception_of_a_surface_is_the_cause_and_has_the_place():
    with pytest.raises(carreau.CallbackError, match="Unlucky: too far") as caught:
        carreau.mesh(beyond(2.0), size=0.1, domain=(0, 0, 3, 1))
    assert isinstance(caught.value.__cause__, Unlucky)
    assert caught.value.__cause__.__traceback__ is not None and caught.value.face == 1


def test_the_place_of_a_scalar_function_is_exact():
    @carreau.scalar
    def surface(u, v):
        if 0.4 < u < 0.6 and 0.4 < v < 0.6:
            raise Unlucky(f"{u} {v}")
        return u, v, 0.0

    session = carreau.Session(hphydef=0.1)
    session.add(carreau.Patch(surface))
    with pytest.raises(carreau.CallbackError) as caught:
        session.generate()
    error = caught.value
    assert error.face == 1 and error.status == carreau.capi.ERR_CALLBACK
    assert str(error.__cause__) == "{} {}".format(*error.uv)
    assert "face 1, u = 0." in str(error)
    with pytest.raises(carreau.SequenceError):
        session.mesh


def test_faces_of_a_second_geometry_are_reported_as_the_session_has_them():
    session = carreau.Session(hphydef=0.2)
    session.add([carreau.Patch(lambda u, v: (u, v, 0 * u)), carreau.Patch(lambda u, v: (u, v, 0 * u + 5))])
    session.add(carreau.Patch(carreau.scalar(lambda u, v: 1 / 0)))
    with pytest.raises(carreau.CallbackError) as caught:
        session.generate()
    assert caught.value.face == 3 and isinstance(caught.value.__cause__, ZeroDivisionError)


def test_curves_pass_their_rank_and_t():
    sides = carreau.box(0, 0, 1, 1)
    session = carreau.Session(hphydef=0.2)
    session.add(carreau.Patch(lambda u, v: (u, v, 0 * u), sides[:2] + [carreau.Curve(carreau.scalar(lambda t: (1 - t, 1 / 0)))] + sides[3:]))
    with pytest.raises(carreau.CallbackError) as caught:
        session.generate()
    assert (caught.value.face, caught.value.ic) == (1, 3) and 0 <= caught.value.t <= 1


def test_sizes_that_fail_and_sizes_that_are_none():
    with pytest.raises(carreau.CallbackError) as caught:
        carreau.mesh(torus, domain=TORUS_BOX, size=lambda x: 1 / 0)
    assert isinstance(caught.value.__cause__, ZeroDivisionError) and caught.value.face == 1 and caught.value.uv is not None
    session = carreau.Session(hphydef=0.3)
    session.add(carreau.Patch(torus, TORUS_BOX))
    session.set_sizes(lambda z: z)  # negative below
    with pytest.raises(carreau.CallbackError, match="which is not positive") as caught:
        session.generate()
    assert caught.value.__cause__ is None and caught.value.uv is not None


def test_a_value_that_is_not_finite_is_reported_by_the_library():
    session = carreau.Session(hphydef=0.2)
    session.add(carreau.Patch(lambda u, v: (u, v, np.log(u - 0.5))))
    with pytest.raises(carreau.CallbackError) as caught, np.errstate(all="ignore"):
        session.generate()
    assert caught.value.face == 1


def test_wrong_shapes_are_reported():
    for wrong in (lambda u, v: np.zeros((3, len(u) + 1)), lambda u, v: (u, v)):
        with pytest.raises(carreau.CallbackError, match=r"shape|must be") as caught:
            session = carreau.Session(hphydef=0.2)
            session.add(carreau.Patch(wrong))
            session.generate()
        assert isinstance(caught.value.__cause__, ValueError)


def test_a_failed_session_is_of_use_again():
    session = carreau.Session(hphydef=0.2)
    broken = [True]

    def surface(u, v):
        if broken[0]:
            raise Unlucky
        return u, v, 0 * u

    session.add(carreau.Patch(surface))
    with pytest.raises(carreau.CallbackError):
        session.generate()
    broken[0] = False
    assert session.generate().quality.area == pytest.approx(1)
    before = session.mesh
    broken[0] = True
    session["hphydef"] = 0.1
    with pytest.raises(carreau.CallbackError):
        session.generate()
    assert np.array_equal(session.mesh.vertices, before.vertices)


def test_keyboard_interrupt_and_exit_pass_as_they_are():
    for kind in (KeyboardInterrupt, SystemExit):
        def surface(u, v):
            raise kind
        with pytest.raises(kind):
            session = carreau.Session(hphydef=0.2)
            session.add(carreau.Patch(surface))
            session.generate()


def test_progress_stops_and_its_exceptions_arrive():
    with pytest.raises(carreau.Cancelled):
        carreau.mesh(torus, domain=TORUS_BOX, size=0.1, progress=lambda fraction, phase, entity: fraction > 0.05)

    def fails(fraction, phase, entity):
        raise Unlucky("bar")
    with pytest.raises(carreau.CallbackError, match="bar") as caught:
        carreau.mesh(torus, domain=TORUS_BOX, size=0.1, progress=fails)
    assert isinstance(caught.value.__cause__, Unlucky)


def test_exceptions_too_late_to_stop_a_run_are_raised():
    def at_the_end(fraction, phase, entity):
        if fraction == 1:
            raise Unlucky("late")
    with pytest.raises(carreau.CallbackError, match="late"):
        carreau.mesh(torus, domain=TORUS_BOX, size=0.5, progress=at_the_end)


def test_points_that_a_callback_cannot_give():
    session = carreau.Session()
    session.add(carreau.Patch(carreau.scalar(lambda u, v: (u, v, 1 / (u - 0.5)))))
    assert session.points(1, [(0.25, 0)]).tolist() == [[0.25, 0, -4]]
    with pytest.raises(carreau.CallbackError) as caught:
        session.points(1, [(0.5, 0)])
    assert isinstance(caught.value.__cause__, ZeroDivisionError) and caught.value.uv == (0.5, 0)


def test_progress_never_falls_and_ends():
    told = []
    carreau.mesh([carreau.Patch(lambda u, v, k=k: (u + 2 * k, v, u * v)) for k in range(4)], size=0.1,
                 progress=lambda fraction, phase, entity: told.append((fraction, phase)))
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions) and fractions[-1] == 1 and {"curves", "patches"} <= {phase for _, phase in told}


def test_a_bar_is_drawn_and_taken_away(capsys):
    carreau.mesh(torus_of_floats, domain=TORUS_BOX, size=0.05, progress=True)
    told = capsys.readouterr().err
    assert "%" in told and "#" in told and told.endswith("\r")


def test_names_that_mean_nothing():
    with pytest.raises(carreau.ArgumentError, match="did you mean 'hphydef'"):
        carreau.mesh("z = x", hphydeff=1)
    with pytest.raises(carreau.ArgumentError, match="not a length"):
        carreau.mesh("z = x", size="wide")
    with pytest.raises(carreau.ArgumentError, match="min .* is above max"):
        carreau.mesh("z = x", size=0.1, min=0.3, max=0.2)
    with pytest.raises(carreau.ArgumentError, match="goes with angle or chord"):
        carreau.mesh("z = x", anisotropic=True)
    with pytest.raises(carreau.ArgumentError, match="position 5: .* not expected"):
        carreau.mesh("z = x +* y")
    with pytest.raises(carreau.ArgumentError, match="there is no face '9'"):
        carreau.mesh("z = x", face_size={9: 1})
    with pytest.raises(carreau.ArgumentError, match="the parameter q"):
        carreau.mesh(lambda u, q: u)
    with pytest.raises(carreau.ArgumentError):
        carreau.Session()["hphydef"] = -1
    with pytest.raises(ValueError):  # ArgumentError is one
        carreau.Session(no_such_parameter=1)


def test_files_that_are_not_there():
    with pytest.raises(carreau.FileError, match="missing.stl"):
        carreau.mesh("missing.stl")
    with pytest.raises(OSError):
        carreau.read("missing.mesh")


def test_parameters_have_their_types():
    session = carreau.Session()
    session["hphydef"] = 1
    assert session["hphydef"] == 1.0 and isinstance(session["hphydef"], float)
    session["element"] = "p2"
    assert session["element"] == "p2"
    session["threads"] = 2
    assert session["threads"] == 2
    session["hphydef"] = "1.5d-1"
    assert session["hphydef"] == 0.15
    known = carreau.parameters()
    assert known["hphydef"].help and math.isinf(known["hphydef"].maximum)


def test_a_session_in_its_own_callback_is_busy():
    session = carreau.Session(hphydef=0.3)

    def surface(u, v):
        session["hphydef"] = 1
        return u, v, u

    session.add(carreau.Patch(surface))
    with pytest.raises(carreau.CallbackError) as caught:
        session.generate()
    assert isinstance(caught.value.__cause__, carreau.BusyError)


def test_closed_sessions_raise_errors_and_meshes_live_on():
    with carreau.Session(hphydef=0.2) as session:
        session.add(carreau.Patch(lambda u, v: (u, v, 0 * u)))
        mesh = session.generate()
        quality = mesh.quality
    with pytest.raises(ValueError, match="closed"):
        session.generate()
    assert mesh.quality == quality
