# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes: things are drawn at their places, and the nearest to the eye in front."""
import struct
import zlib

import numpy as np
import pytest

import carreau


def pixels_of(data):
    """(height, width, 3) of a PNG, read by the format's own rules."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0]
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + length
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), dtype=np.uint8).reshape(height, 1 + 3 * width)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, 3)


def drawn(pixels):
    return np.any(pixels < 250, axis=2)


def test_a_triangle_covers_half_of_its_box():
    mesh = carreau.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)])
    pixels = pixels_of(mesh.picture(width=200, height=200, edges=False))
    rows, columns = np.nonzero(drawn(pixels))
    box = (np.ptp(rows) + 1) * (np.ptp(columns) + 1)
    assert len(rows) / box == pytest.approx(0.5, abs=0.02)
    assert drawn(pixels)[rows.max() - 5, columns.min() + 5] and not drawn(pixels)[rows.min() + 5, columns.max() - 5]


def test_near_things_hide_far_ones():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    vertices = [(x, y, z) for z in (0, 1) for x, y in square]
    triangles = [(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)]
    color = {}
    for view in ("top", "bottom"):
        mesh = carreau.Mesh(vertices, triangles, face_ids=[1, 1, 2, 2])
        pixels = pixels_of(mesh.picture(width=60, height=60, view=view, edges=False))
        color[view] = tuple(pixels[30, 30])
    assert color["top"] != color["bottom"]
    alone = carreau.Mesh(vertices, triangles[::-1], face_ids=[2, 2, 1, 1])  # the order does not matter
    assert tuple(pixels_of(alone.picture(width=60, height=60, view="top", edges=False))[30, 30]) == color["top"]


def test_depth_belongs_to_the_point_and_not_to_the_triangle():
    # Two long triangles that cross: each is nearer in its half.
    vertices = [(0, 0, 0), (4, 0, 4), (2, 2, 2), (0, 0.1, 4), (4, 0.1, 0), (2, 2, 2.0001)]
    mesh = carreau.Mesh(vertices, [(0, 1, 2), (3, 4, 5)], face_ids=[1, 2])
    pixels = pixels_of(mesh.picture(width=300, height=200, view="top", edges=False))
    rows, columns = np.nonzero(drawn(pixels))
    row = rows.max() - 15
    left, right = columns[rows == row].min() + 8, columns[rows == row].max() - 8
    hue = lambda p: np.argsort(p.astype(int))  # noqa: E731
    assert not np.array_equal(pixels[row, left], pixels[row, right]) and hue(pixels[row, left]).shape == (3,)


def test_values_are_colours_from_violet_to_yellow():
    mesh = carreau.mesh("z = 0 * x", size=0.2)
    for values in (mesh.vertices[:, 0], mesh.vertices[mesh.triangles][:, :, 0].mean(axis=1)):
        pixels = pixels_of(mesh.picture(view="top", colors=values, edges=False)).astype(int)
        rows, columns = np.nonzero(drawn(pixels))
        left, right = (pixels[240, columns.min() + 3], pixels[240, columns.max() - 3])
        assert left[2] > left[1] + 30 and right[0] > right[2] + 50 and right[1] > right[2] + 50
        assert right.sum() > left.sum() + 100  # and from dark to light
    with pytest.raises(ValueError, match="for each vertex"):
        mesh.picture(colors=[1, 2, 3])


def test_quality_and_notebooks(tmp_path):
    mesh = carreau.mesh("z = x * y", size=0.2)
    yellow = pixels_of(mesh.picture(tmp_path / "x.png", colors="quality", edges=False, view="top"))
    inside = yellow[yellow.shape[0] // 2, yellow.shape[1] // 2].astype(int)
    assert min(inside[:2]) > inside[2] + 50 and (tmp_path / "x.png").stat().st_size > 100
    assert mesh._repr_png_()[:4] == b"\x89PNG"
    html = mesh._repr_html_()
    assert "data:image/png;base64," in html and f"<td style='text-align:left'>{len(mesh.triangles)}</td>" in html
    with pytest.raises(ValueError, match="view is one of"):
        mesh.picture(view="behind")


def test_pyvista_is_requested_by_name():
    mesh = carreau.mesh("z = x * y", size=0.5)
    try:
        import pyvista
    except ImportError:
        with pytest.raises(ImportError, match="pip install pyvista"):
            mesh.to_pyvista()
    else:
        assert mesh.to_pyvista().n_cells == len(mesh.triangles) and pyvista


def test_meshio_has_cells_and_references():
    pytest.importorskip("meshio")
    converted = carreau.mesh("z = x * y", size=0.3, element="q1.0").to_meshio()
    blocks = {block.type: block.data for block in converted.cells}
    assert "quad" in blocks and "line" in blocks
    assert [len(refs) for refs in converted.cell_data["face"]] == [len(block.data) for block in converted.cells]
