# SPDX-License-Identifier: BSD-3-Clause
"""Meshes in the model of a running Gmsh."""
from __future__ import annotations

import logging
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import NDArray

from ._content import MeshContent
from .convert import package
from .errors import ArgumentError

log = logging.getLogger("carreau")
Ints = NDArray[np.int32]
#: Numbers of Gmsh's elements by the names of Mesh.cells. Nodes have the order of Gmsh.
TYPES = {"triangle": 2, "triangle6": 9, "quad": 3, "quad8": 16}
LINES = {2: 1, 3: 8}


def to_gmsh(mesh: MeshContent, tolerance: float = 1e-3) -> None:
    """Puts the mesh into the current model of a Gmsh that has the same STEP, IGES or BREP file open (gmsh.model.occ.importShapes): nodes with
    their parameters and elements on each vertex, curve and surface of the model, in place of their meshes.

    Both programs number entities in the order of the file. If a number has another place (Gmsh removes duplicates), points, curves and
    surfaces are compared by their places within `tolerance` times the diagonal. Everything behind gmsh.model.mesh.generate(2) works as with
    a mesh of Gmsh: physical groups, generate(3), partition, write. The option Mesh.MeshOnlyEmpty becomes 1, so that generate(3) keeps the
    surface. Elements of order 2 stay on the surface; for volumes of order 2 give a mesh of order 1 and call setOrder(2) behind generate(3).

    Raises ArgumentError when the model has other surfaces or curves than the mesh, ImportError without the package gmsh."""
    gmsh = package("gmsh", ", or apt-get install python3-gmsh", "to_gmsh()")
    _Filling(gmsh, mesh, tolerance).run()


class _Filling:
    def __init__(self, gmsh: Any, mesh: MeshContent, tolerance: float) -> None:
        self.gmsh, self.model, self.mesh = gmsh, gmsh.model, mesh
        self.points = np.asarray(mesh.vertices, dtype=float)
        if len(self.points) == 0:
            raise ArgumentError("the mesh is empty")
        self.near = tolerance * float(np.linalg.norm(np.ptp(self.points, axis=0)))
        self.tags = np.zeros(len(self.points), dtype=np.int64)  # of nodes, once they are in the model

    def run(self) -> None:
        corners, curves, faces = self._of_points(), self._of_curves(), self._of_faces()
        self.gmsh.option.setNumber("Mesh.MeshOnlyEmpty", 1)
        self.model.mesh.generate(1)  # otherwise the first generate(3) of Gmsh 4.8 meshes surfaces anew
        self.model.mesh.clear()
        self.next = 1
        for tag, vertex in sorted(corners.items()):
            self._add_nodes(0, tag, np.array([vertex]), None)
            self.model.mesh.addElementsByType(tag, 15, [], [int(self.tags[vertex])])
        for tag, rows in sorted(curves.items()):
            inside = self._fresh(rows)
            self._add_nodes(1, tag, inside, self._parameters(1, tag))
            self.model.mesh.addElementsByType(tag, LINES[rows.shape[1]], [], self.tags[rows].ravel().tolist())
        for tag, blocks in sorted(faces.items()):
            inside = self._fresh(np.concatenate([rows.ravel() for _, rows in blocks]))
            self._add_nodes(2, tag, inside, self._parameters(2, tag))
            for name, rows in blocks:
                self.model.mesh.addElementsByType(tag, TYPES[name], [], self.tags[rows].ravel().tolist())

    def _parameters(self, dimension: int, tag: int) -> Callable[[Any], Any]:
        return lambda xyz: self.model.getParametrization(dimension, tag, xyz)

    def _fresh(self, nodes: Any) -> Any:
        """Nodes that no entity has yet, each once, in their order."""
        own = np.unique(np.asarray(nodes).ravel())
        return own[self.tags[own] == 0]

    def _add_nodes(self, dimension: int, tag: int, nodes: Any, parameters: Optional[Callable[[Any], Any]]) -> None:
        if len(nodes) == 0:
            return
        self.tags[nodes] = np.arange(self.next, self.next + len(nodes))
        self.next += len(nodes)
        xyz = self.points[nodes].ravel().tolist()
        uv = [] if parameters is None else list(parameters(xyz))
        self.model.mesh.addNodes(dimension, tag, self.tags[nodes].tolist(), xyz, uv)

    # ---- which entity of the model each entity of the mesh is ----

    def _of_points(self) -> dict[int, int]:
        """Vertices of the mesh at points of the model."""
        ids = np.asarray(self.mesh.vertex_ids)
        on_curves = np.flatnonzero(ids > 0)
        found = {}
        for _, tag in self.model.getEntities(0):
            place = np.array(self.model.getValue(0, tag, []))
            numbered = on_curves[ids[on_curves] == tag]
            for candidates in (numbered, on_curves, np.arange(len(self.points))):
                if len(candidates) == 0:
                    continue
                distance = np.linalg.norm(self.points[candidates] - place, axis=1)
                if distance.min() <= self.near:
                    found[tag] = int(candidates[distance.argmin()])
                    break
            else:
                log.warning("no vertex of the mesh is at point %d of Gmsh's model", tag)
        return found

    def _matched(self, dimension: int, what: str, samples: dict[int, Any]) -> dict[int, int]:
        """Tags of the model by references of the mesh. samples: points of the mesh by reference."""
        tags = [tag for _, tag in self.model.getEntities(dimension)]
        boxes = {tag: np.array(self.model.getBoundingBox(dimension, tag)).reshape(2, 3) for tag in tags}

        def fits(tag: int, points: Any) -> bool:
            low, high = boxes[tag]
            slack = self.near + 1e-6  # OpenCASCADE's boxes are larger by a tolerance
            if (points < low - slack).any() or (points > high + slack).any():
                return False
            try:
                closest = np.array(self.model.getClosestPoint(dimension, tag, points.ravel().tolist())[0]).reshape(-1, 3)
            except Exception:  # gmsh raises no other class; a degenerate curve has no points
                return False
            return bool((np.linalg.norm(closest - points, axis=1) <= self.near).all())

        found: dict[int, int] = {}
        left = set(tags)
        for ref, points in samples.items():
            if ref in left and fits(ref, points):
                found[ref] = ref
                left.discard(ref)
        for ref, points in samples.items():
            if ref in found:
                continue
            others = [tag for tag in sorted(left) if fits(tag, points)]
            if not others:
                raise ArgumentError(f"{what} {ref} of the mesh is no {what} of Gmsh's model: is it of the same file, and in the same unit?")
            found[ref] = others[0]
            left.discard(others[0])
        return found

    @staticmethod
    def _some(rows: Any) -> Any:
        return rows[:: max(1, len(rows) // 8)]

    def _of_curves(self) -> dict[int, Any]:
        edges, ids = np.asarray(self.mesh.edges), np.asarray(self.mesh.curve_ids)
        mids = np.asarray(self.mesh.edge_mids)
        blocks = {}
        for ref in np.unique(ids):
            rows = edges[ids == ref]
            own = mids[ids == ref]
            blocks[int(ref)] = np.column_stack([rows, own]) if (own >= 0).all() and len(own) else rows
        samples = {ref: self._some(self.points[np.unique(rows)]) for ref, rows in blocks.items()}
        found = self._matched(1, "curve", samples)
        return {found[ref]: rows for ref, rows in blocks.items()}

    def _of_faces(self) -> dict[int, Any]:
        blocks: dict[int, list[tuple[str, Any]]] = {}
        for name, (rows, refs) in self.mesh.cells.items():
            for ref in np.unique(refs):
                blocks.setdefault(int(ref), []).append((name, rows[refs == ref]))
        samples = {ref: self._some(self.points[np.unique(np.concatenate([rows.ravel() for _, rows in each]))]) for ref, each in blocks.items()}
        found = self._matched(2, "surface", samples)
        return {found[ref]: each for ref, each in blocks.items()}
