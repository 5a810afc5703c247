// SPDX-License-Identifier: BSD-3-Clause
// The data of the page: numbers as planes of bytes, zlib's stream, base64 (packing.h encodes them).

/** The header: counts, box, faces, scales. */
function readHead() {
  return JSON.parse(document.getElementById('viewer-data').textContent);
}

async function inflate(base64) {
  const letters = atob(base64);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function fromPlanes(planes, count, bytes) {
  const numbers = bytes === 1 ? new Uint8Array(count) : bytes === 2 ? new Uint16Array(count) : new Uint32Array(count);
  for (let plane = 0; plane < bytes; ++plane) {
    for (let i = 0, at = plane * count; i < count; ++i) numbers[i] |= planes[at + i] << (8 * plane);
  }
  return numbers;
}

/** Differences, folded (0, -1, 1, -2, ... are 0, 1, 2, 3, ...), modulo 2^(8 bytes), become numbers, in place. */
function addUp(numbers, stride, bytes) {
  const mask = bytes === 4 ? -1 : (1 << (8 * bytes)) - 1;
  for (let i = 0; i < numbers.length; ++i) {
    const folded = numbers[i];
    const difference = (folded >>> 1) ^ -(folded & 1);
    numbers[i] = ((i < stride ? 0 : numbers[i - stride]) + difference) & mask;
  }
}

/** The numbers of one array. */
async function unpack(head, name) {
  const { count, bytes, stride, delta } = head.blocks[name];
  const planes = await inflate(document.getElementById('data-' + name).textContent);
  if (planes.length !== count * bytes) throw new Error('The array ' + name + ' is incomplete.');
  const numbers = fromPlanes(planes, count, bytes);
  if (delta) addUp(numbers, stride, bytes);
  return numbers;
}

/** A code of an array of values as the value; NaN: none. */
function valueOf(scale, code) {
  if (code === 0) return NaN;
  const share = (code - 1) / 65534;
  return scale.logarithmic ? scale.low * (scale.high / scale.low) ** share : scale.low + share * (scale.high - scale.low);
}

/** The drawn triangles, or, where elements are curved, pieces of them: corners, sides, the triangle of each. */
async function readPieces(head, mesh) {
  if (!head.blocks['piece-corners']) return { corners: mesh.corners, sides: mesh.sides, triangle: null };
  const [corners, sides, triangle] = await Promise.all(['piece-corners', 'piece-sides', 'piece-triangle'].map((name) => unpack(head, name)));
  return { corners, sides, triangle };
}

/** The mesh, with one array a name: positions (shares of the box, 0 to 1), corners, faces, sides, values by their keys. */
async function readMesh() {
  const head = readHead();
  const names = ['positions', 'corners', 'faces', 'sides', ...head.values.map((scale) => scale.key)];
  const arrays = await Promise.all(names.map((name) => unpack(head, name)));
  const mesh = { head, codes: {} };
  names.forEach((name, i) => {
    if (i < 4) mesh[name] = arrays[i];
    else mesh.codes[name] = arrays[i];
  });
  mesh.pieces = await readPieces(head, mesh);
  mesh.most = head.blocks.positions.bytes === 2 ? 0xffff : 0xffffff;
  mesh.extent = head.box.quantum.map((quantum) => quantum * mesh.most);
  return mesh;
}

/** The triangle that a piece is of. */
function triangleOf(mesh, piece) { return mesh.pieces.triangle ? mesh.pieces.triangle[piece] : piece; }

/** The first piece of a triangle, and how many it has. */
function piecesOf(mesh, triangle) {
  const owners = mesh.pieces.triangle;
  if (!owners) return { first: triangle, count: 1 };
  let low = 0, high = owners.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (owners[middle] < triangle) low = middle + 1;
    else high = middle;
  }
  let end = low;
  while (end < owners.length && owners[end] === triangle) ++end;
  return { first: low, count: end - low };
}

/** Coordinates of a corner, k from 0 to 2, of a triangle. */
function cornerOf(mesh, triangle, k) {
  const vertex = mesh.corners[3 * triangle + k];
  return [0, 1, 2].map((x) => mesh.head.box.low[x] + mesh.positions[3 * vertex + x] * mesh.head.box.quantum[x]);
}
