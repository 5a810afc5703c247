// SPDX-License-Identifier: BSD-3-Clause
// The view of the mesh: a parallel projection, turned about its target.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const unit = (a) => { const n = Math.hypot(...a); return n > 0 ? a.map((x) => x / n) : a; };

/** Directions from the mesh to the eye. */
const directions = {
  iso: [1, -2, 1], front: [0, -1, 0], back: [0, 1, 0], left: [-1, 0, 0], right: [1, 0, 0], top: [0, 0, 1], bottom: [0, 0, -1],
};

/** Right, up and towards the eye; z is up where it can be. */
function frameOf(direction) {
  const toward = unit(direction);
  const up = Math.abs(toward[2]) > 0.999 ? [0, 1, 0] : [0, 0, 1];
  const right = unit(cross(up, toward));
  return { right, up: cross(toward, right), toward };
}

class Camera {
  /** `low`, `extent`: the box of the mesh, model lengths. */
  constructor(low, extent) {
    this.low = low;
    this.extent = extent;
    this.radius = Math.hypot(...extent) / 2 || 1;
    this.aspect = 1;
    this.look('iso');
  }

  centre() { return this.low.map((x, i) => x + this.extent[i] / 2); }

  /** The whole mesh from a named side. */
  look(name) {
    this.frame = frameOf(directions[name]);
    this.fit();
  }

  /** Target and scale that show the whole box as it is turned now. */
  fit() {
    this.target = this.centre();
    const half = (axis) => axis.reduce((sum, x, i) => sum + Math.abs(x) * this.extent[i], 0) / 2;
    this.half = 1.06 * Math.max(half(this.frame.up), half(this.frame.right) / this.aspect) || 1;
  }

  /** Half the height of the view, model length, bounded by single precision. */
  zoom(factor) { this.half = Math.min(20 * this.radius, Math.max(2e-6 * this.radius, this.half / factor)); }

  /** Turns by angles about the vertical and the horizontal of the screen. */
  turn(across, over) {
    const { right, up, toward } = this.frame;
    const spun = plus(toward.map((x) => x * Math.cos(across)), right, -Math.sin(across));
    const side = unit(cross(up, spun));
    this.frame.toward = unit(plus(spun.map((x) => x * Math.cos(over)), up, Math.sin(over)));
    this.frame.right = side;
    this.frame.up = cross(this.frame.toward, side);
  }

  /** Moves by shares of half the height. */
  move(x, y) {
    this.target = plus(plus(this.target, this.frame.right, x * this.half), this.frame.up, y * this.half);
  }

  /** In units of half the height: right, up. */
  project(point) {
    const d = plus(point, this.target, -1);
    return [dot(d, this.frame.right) / this.half, dot(d, this.frame.up) / this.half];
  }

  /** Half the depth of clip space, model length: the whole mesh is in it wherever the target is. */
  depth() { return 1.25 * this.radius + Math.hypot(...plus(this.target, this.centre(), -1)); }

  /** Column by column, from shares of the box to clip space. */
  toClip() {
    const rows = [[this.frame.right, 1 / (this.half * this.aspect)], [this.frame.up, 1 / this.half], [this.frame.toward, -1 / this.depth()]];
    const offset = plus(this.low, this.target, -1);
    const matrix = new Float32Array(16);
    rows.forEach(([axis, scale], row) => {
      for (let x = 0; x < 3; ++x) matrix[4 * x + row] = axis[x] * this.extent[x] * scale;
      matrix[12 + row] = dot(axis, offset) * scale;
    });
    matrix[15] = 1;
    return matrix;
  }

  copy() {
    return { frame: structuredClone(this.frame), target: [...this.target], half: this.half };
  }

  /** Between two copies, t from 0 to 1; axes are made orthonormal again. */
  between(a, b, t) {
    const mix = (p, q) => p.map((x, i) => x + t * (q[i] - x));
    const toward = unit(mix(a.frame.toward, b.frame.toward));
    const up = mix(a.frame.up, b.frame.up);
    const right = unit(cross(up, toward));
    this.target = mix(a.target, b.target);
    this.half = Math.exp((1 - t) * Math.log(a.half) + t * Math.log(b.half));
    // Opposite directions have no middle: the new one is taken at once.
    const lost = !(Math.hypot(...right) > 0.5 && Math.hypot(...toward) > 0.5);
    this.frame = lost ? structuredClone(b.frame) : { right, up: cross(toward, right), toward };
  }
}
