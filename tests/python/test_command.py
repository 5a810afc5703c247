# SPDX-License-Identifier: BSD-3-Clause
"""The words of carreau.mesh agree with the options of `carreau mesh`: identical meshes."""
import os
import subprocess

import numpy as np
import pytest

import carreau
from conftest import needs

pytestmark = needs("CARREAU_COMMAND")


@pytest.fixture(scope="module")
def shapes(tmp_path_factory):
    """A folder with files of CAD."""
    folder = tmp_path_factory.mktemp("shapes")
    if os.environ.get("CARREAU_MAKE_SHAPES"):
        subprocess.run([os.environ["CARREAU_MAKE_SHAPES"], str(folder)], check=True)
    return folder


def by_command(tmp_path, source, *options):
    out = tmp_path / "by_command.mesh"
    subprocess.run([os.environ["CARREAU_COMMAND"], "mesh", str(source), "-o", str(out), "-q", *options], check=True)
    return carreau.read(out)


def agree(mesh, other):
    assert len(mesh.triangles) > 50
    for name in ("vertices", "triangles", "face_ids", "edges", "curve_ids"):
        assert np.array_equal(getattr(mesh, name), getattr(other, name)), name


@pytest.mark.parametrize("words, options", [
    ({"size": 0.2}, ["--size", "0.2"]),
    ({"angle": 15, "gradation": 1.4}, ["--angle", "15", "--gradation", "1.4"]),
    ({"size": "4%", "chord": 0.01, "max": 0.5}, ["--size", "4%", "--chord", "0.01", "--max", "0.5"]),
    ({"angle": 12, "anisotropic": 20, "min": 0.05}, ["--angle", "12", "--anisotropic=20", "--min", "0.05"]),
    ({"size": 0.4, "face_size": {3: 0.1, "7": 0.15}}, ["--size", "0.4", "--face-size", "3=0.1", "--face-size", "7=0.15"]),
    ({"size": 0.3, "element": "p2", "edge_gradation": 1.2}, ["--size", "0.3", "--element", "p2", "--set", "edge_gradation=1.2"]),
    ({"size": 0.3, "effort": 0}, ["--size", "0.3", "--effort", "0"]),
    ({"size": 0.3, "effort": 2}, ["--size", "0.3", "--effort", "2"]),
    ({"size": 0.3, "independent": True, "sharp_angle": 30}, ["--size", "0.3", "--independent", "--sharp-angle", "30"]),
])
def test_bezier_patches(source, tmp_path, words, options):
    teapot = os.path.join(source, "fortran_examples/teapot/teapot.bpt")
    agree(carreau.mesh(teapot, **words), by_command(tmp_path, teapot, *options))


@pytest.mark.parametrize("name", ["assembly.step", "plate.igs", "cylinder.brep"])
@needs("CARREAU_MAKE_SHAPES")
def test_files_of_cad(shapes, tmp_path, name):
    agree(carreau.mesh(shapes / name, size="3%", angle=10), by_command(tmp_path, shapes / name, "--size", "3%", "--angle", "10"))


@pytest.mark.parametrize("words, options", [({}, []), ({"max": 20, "min": "0.5%"}, ["--max", "20", "--min", "0.5%"]),
                                            ({"anisotropic": True, "gradation": 1.5}, ["--anisotropic", "--gradation", "1.5"])])
@needs("CARREAU_MAKE_SHAPES")
def test_files_of_cad_without_sizes(shapes, tmp_path, words, options):
    agree(carreau.mesh(shapes / "bracket.step", **words), by_command(tmp_path, shapes / "bracket.step", *options))


@needs("CARREAU_MAKE_SHAPES")
def test_sizes_of_named_faces(shapes, tmp_path):
    part = shapes / "assembly.step"
    names = {face.name for face in carreau.CadFile(part).faces}
    assert "ball" in names
    agree(carreau.mesh(part, size="4%", face_size={"ba*": "1%"}), by_command(tmp_path, part, "--size", "4%", "--face-size", "ba*=1%"))


def test_molecules_grids_and_triangles(source, tmp_path):
    data = os.path.join(source, "tests/data")
    agree(carreau.mesh(f"{data}/molecule/1bna.pdb", size=2.0), by_command(tmp_path, f"{data}/molecule/1bna.pdb", "--size", "2"))
    agree(carreau.mesh(f"{data}/grid/wing.fmt", angle=20, lengths=True), by_command(tmp_path, f"{data}/grid/wing.fmt", "--angle", "20", "--lengths"))
    agree(carreau.mesh(f"{data}/grid/volcano.txt", step=10, size=60), by_command(tmp_path, f"{data}/grid/volcano.txt", "--step", "10", "--size", "60"))
    cube = carreau.mesh("z = x * y", size=0.2)
    cube.write(tmp_path / "given.stl")
    agree(carreau.mesh(tmp_path / "given.stl", size=0.15), by_command(tmp_path, tmp_path / "given.stl", "--size", "0.15"))


def test_formulas_and_size_maps(tmp_path):
    saddle = "x = u; y = v; z = u * v - u / (2 + v)"
    agree(carreau.mesh(saddle, size=0.1), by_command(tmp_path, saddle, "--size", "0.1"))
    agree(carreau.mesh(saddle, size_map="0.05 + x * x / 4"), by_command(tmp_path, saddle, "--size-map", "0.05 + x * x / 4"))
    agree(carreau.mesh(saddle, size=lambda x: 0.05 + x * x / 4), by_command(tmp_path, saddle, "--size-map", "0.05 + x * x / 4"))
    ring = "z = x * x - y"
    agree(carreau.mesh(ring, domain="ring:0.1,0,0.3,1", size=0.1), by_command(tmp_path, ring, "--domain", "ring:0.1,0,0.3,1", "--size", "0.1"))


@pytest.mark.parametrize("shape", ["isotropic", "anisotropic"])
def test_adaptation_to_a_formula(tmp_path, shape):
    out = tmp_path / "by_command.mesh"
    subprocess.run([os.environ["CARREAU_COMMAND"], "adapt", "z = x * y", "--formula", "x * x * x - x * y * z", "--tolerance", "0.001",
                    "--shape", shape, "--size", "10%", "--min", "0.01", "--gradation", "1.5", "-o", str(out), "-q"], check=True)
    mesh = carreau.adapt("z = x * y", lambda x, y, z: x * x * x - x * y * z, tolerance=0.001, shape=shape, size="10%", min=0.01, gradation=1.5)
    agree(mesh, carreau.read(out))


def test_a_model_with_a_library_of_cad_m(tmp_path):
    host = os.environ["CARREAU_PYTHON_HOST"]
    session = carreau.Session()
    session.add(carreau.Patch(lambda u, v: (u, v, (u * u + v * v) / 2)))
    session.write_pardom(tmp_path / "x.pardom")
    mesh = carreau.mesh(tmp_path / "x.pardom", host=host, size="5%")
    agree(mesh, by_command(tmp_path, tmp_path / "x.pardom", "--host", host, "--size", "5%"))
    with pytest.raises(carreau.ArgumentError, match="host names"):
        carreau.mesh(tmp_path / "x.pardom")
    with pytest.raises(OSError):
        carreau.mesh(tmp_path / "x.pardom", host="no.so")


def test_an_env_file(source, tmp_path):
    (tmp_path / "sizes.env").write_text("hphydef 0.25\nelement p1\nnarrow_ratio 0.001\n")
    teapot = os.path.join(source, "fortran_examples/teapot/teapot.bpt")
    agree(carreau.mesh(teapot, env=tmp_path / "sizes.env"), by_command(tmp_path, teapot, "--env", str(tmp_path / "sizes.env")))
