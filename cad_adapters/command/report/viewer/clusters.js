// SPDX-License-Identifier: BSD-3-Clause
// A coarse version of a large mesh for slow machines: vertices of a cell of a grid become one, triangles that
// have lost a corner go (J. Rossignac, P. Borrel, "Multi-resolution 3D approximations", 1993).

/** Twice the area of all triangles, model units. */
function doubleArea(mesh) {
  const { positions, corners, head: { box: { quantum } } } = mesh;
  let sum = 0;
  for (let i = 0; i < corners.length; i += 3) {
    const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
    const px = (positions[b] - positions[a]) * quantum[0], qx = (positions[c] - positions[a]) * quantum[0];
    const py = (positions[b + 1] - positions[a + 1]) * quantum[1], qy = (positions[c + 1] - positions[a + 1]) * quantum[1];
    const pz = (positions[b + 2] - positions[a + 2]) * quantum[2], qz = (positions[c + 2] - positions[a + 2]) * quantum[2];
    sum += Math.hypot(py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx);
  }
  return sum;
}

/** For each vertex the number of its cell, in the order in which cells come; cells of about `size`, model units. */
function cellsOf(mesh, size) {
  const { positions, extent, head: { box: { quantum } } } = mesh;
  const steps = extent.map((x) => Math.min(65536, Math.floor(x / size) + 1));
  const scale = [0, 1, 2].map((x) => (extent[x] > 0 ? (quantum[x] * steps[x]) / extent[x] : 0));
  const cells = new Uint32Array(positions.length / 3), numbers = new Map(), first = [];
  for (let v = 0; v < cells.length; ++v) {
    let key = 0;
    for (let x = 2; x >= 0; --x) key = key * steps[x] + Math.min(steps[x] - 1, Math.floor(positions[3 * v + x] * scale[x]));
    let number = numbers.get(key);
    if (number === undefined) {
      numbers.set(key, number = first.length);
      first.push(v);
    }
    cells[v] = number;
  }
  return { cells, first };
}

/**
 * About `wanted` triangles for a mesh of many more: corners, vertices of the mesh, three a triangle; `from`: the
 * triangle of the mesh that each comes from.
 */
function coarseMesh(mesh, wanted) {
  // A surface meets about 3/2 area / size^2 cells, with two triangles each.
  const { cells, first } = cellsOf(mesh, Math.sqrt((1.5 * doubleArea(mesh)) / wanted) || 1);
  const corners = [], from = [], known = new Set(), n = first.length;
  for (let t = 0; t < mesh.corners.length / 3; ++t) {
    const a = cells[mesh.corners[3 * t]], b = cells[mesh.corners[3 * t + 1]], c = cells[mesh.corners[3 * t + 2]];
    if (a === b || b === c || c === a) continue;
    const low = Math.min(a, b, c), high = Math.max(a, b, c), middle = a + b + c - low - high;
    const key = (low * n + middle) * n + high;  // exact below 2^53: as far as 200 000 cells
    if (known.has(key)) continue;
    known.add(key);
    corners.push(first[a], first[b], first[c]);
    from.push(t);
  }
  return { corners, from };
}
