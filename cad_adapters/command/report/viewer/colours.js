// SPDX-License-Identifier: BSD-3-Clause
// Colours of triangles.

const bytesOf = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** Share of a value on the scale that is shown, 0 to 1. */
function shareOf(scale, value) {
  const [low, high] = scale.shown;
  const share = scale.logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  return Math.min(1, Math.max(0, share));
}

/** The colour at a share of the scale: linear between stops. */
function scaleColour(stops, share) {
  const x = share * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2);
  return stops[i].map((byte, k) => Math.round(byte + (x - i) * (stops[i + 1][k] - byte)));
}

const grey = [188, 198, 210];
const shown = [224, 123, 31];  // a face among others that fade
const faded = (colour) => colour.map((byte) => 0.15 * byte + 0.85 * 208);

/** The colour of each of the 65536 codes of a scale, three bytes each. */
function coloursOfCodes(mesh, scale) {
  const stops = mesh.head.colours.map(bytesOf);
  const table = new Uint8Array(3 * 65536);
  table.set(grey, 0);
  for (let code = 1; code < 65536; ++code) table.set(scaleColour(stops, shareOf(scale, valueOf(scale, code))), 3 * code);
  return table;
}

/** The colour of each face, three bytes each; others than `face` fade, unless it is -1. */
function coloursOfFaces(mesh, face) {
  const table = new Uint8Array(3 * mesh.head.faces.length);
  mesh.head.faces.forEach((each, i) => {
    const own = bytesOf(each.colour);
    table.set(face < 0 ? own : face === i ? shown : faded(own), 3 * i);
  });
  return table;
}

/**
 * Four bytes a triangle: red, green, blue, and the bits of its sides. `key`: of a scale, or "face". `face`: the face
 * that is shown alone, -1: all.
 */
function coloursOf(mesh, key, face) {
  const scale = mesh.head.values.find((each) => each.key === key);
  const table = scale ? coloursOfCodes(mesh, scale) : coloursOfFaces(mesh, face);
  const codes = scale ? mesh.codes[key] : mesh.faces;
  const colours = new Uint8Array(4 * codes.length);
  const fading = scale && face >= 0;  // the table of faces has it
  for (let t = 0; t < codes.length; ++t) {
    const colour = table.subarray(3 * codes[t], 3 * codes[t] + 3);
    colours.set(fading && mesh.faces[t] !== face ? faded([...colour]) : colour, 4 * t);
    colours[4 * t + 3] = mesh.sides[t];
  }
  return colours;
}

/** Makes the colours of drawn pieces, `length` bytes: a piece has the colour of its triangle, and its own sides. */
function coloursOfPieces(mesh, ofTriangles, length) {
  const colours = new Uint8Array(length), { sides, triangle } = mesh.pieces;
  if (!triangle) colours.set(ofTriangles);
  else sides.forEach((bits, i) => {
    colours.set(ofTriangles.subarray(4 * triangle[i], 4 * triangle[i] + 3), 4 * i);
    colours[4 * i + 3] = bits;
  });
  return colours;
}
