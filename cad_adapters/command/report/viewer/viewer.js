// SPDX-License-Identifier: BSD-3-Clause
// The view: drawing, picking and flights.

const textOf = (x) => (Number.isFinite(x) ? Number(x.toPrecision(4)).toString() : 'none');

/** How much is drawn while the mesh moves: all; a quarter of the pixels; of a large mesh the coarse one, with a quarter of the pixels. */
class Pace {
  constructor(hasCoarse) {
    this.last = hasCoarse ? 2 : 1;
    this.level = 0;
    this.slow = 0;
  }

  density() { return this.level > 0 ? 0.5 : 1; }

  isCoarse() { return this.level > 1; }

  isFineAtRest() { return this.level < 2; }

  /** Milliseconds of a picture. Two that are too slow while the mesh moves lead to the next level, one of all that is fast at rest back. */
  note(took, moving) {
    const slowest = 45;
    this.slow = moving && took > slowest ? this.slow + 1 : 0;
    if (this.slow > 1 && this.level < this.last) ++this.level, this.slow = 0;
    if (!moving && took < slowest) this.level = 0;
  }
}

class Viewer {
  constructor(mesh) {
    this.mesh = mesh;
    this.canvas = document.getElementById('canvas');
    this.renderer = new Renderer(this.canvas, mesh);
    this.camera = new Camera(mesh.head.box.low, mesh.extent);
    this.face = -1;
    this.pace = new Pace(this.renderer.hasCoarse());
    this.worst = [...document.querySelectorAll('#worst button[data-triangle]')].map((button) => Number(button.dataset.triangle));
    this.at = -1;
    this.controls = new Controls(this.canvas, this);
    this.watch();
    this.paint('face');
    this.lookFrom(mesh.head.dimension === 2 ? 'top' : 'iso');
  }

  watch() {
    new ResizeObserver(() => this.redraw(false)).observe(this.canvas);
    this.canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.canvas.addEventListener('webglcontextrestored', () => {
      this.renderer.upload();
      this.paint(this.key);
    });
  }

  /** Once a frame at most, and not before the last picture is there. `moving`: less is drawn on slow machines, until it rests. */
  redraw(moving) {
    this.moving = moving;
    clearTimeout(this.resting);
    if (moving) this.resting = setTimeout(() => this.redraw(false), 250);
    if (!this.frame) this.frame = requestAnimationFrame(() => this.drawFrame());
  }

  drawFrame() {
    this.frame = 0;
    if (this.drawing) {
      this.late = true;
      return;
    }
    const { moving, pace } = this;
    this.drawing = true;
    this.renderer.resize(Math.min(2, devicePixelRatio) * (moving ? pace.density() : 1));
    this.renderer.draw(this.camera, !moving && pace.isFineAtRest(), moving && pace.isCoarse());
    this.placeRing();
    this.renderer.finished().then((took) => {
      this.drawing = false;
      pace.note(took, moving);
      if (this.late && !this.frame) this.frame = requestAnimationFrame(() => this.drawFrame());
      this.late = false;
    });
  }

  /** A ring on the page around the triangle that is picked, however small it is. */
  placeRing() {
    const ring = document.getElementById('ring');
    ring.hidden = this.renderer.chosen < 0;
    if (ring.hidden) return;
    const [x, y] = this.onPage(this.renderer.chosen);
    ring.style.transform = `translate(${x}px, ${y}px)`;
  }

  /** The middle of a triangle, pixels of the canvas on the page from its upper left corner. */
  onPage(triangle) {
    const [right, up] = this.camera.project(this.middle(triangle));
    const half = this.canvas.clientHeight / 2;
    return [this.canvas.clientWidth / 2 + right * half, half - up * half];
  }

  corners(triangle) { return [0, 1, 2].map((k) => cornerOf(this.mesh, triangle, k)); }

  middle(triangle) {
    const [a, b, c] = this.corners(triangle);
    return a.map((x, i) => (x + b[i] + c[i]) / 3);
  }

  paint(key) {
    this.key = key;
    this.renderer.paint(key, this.face);
    showLegend(this.mesh, key);
    this.redraw(false);
  }

  lookFrom(name) {
    this.camera.aspect = this.canvas.clientWidth / Math.max(1, this.canvas.clientHeight);
    this.camera.look(name);
    this.redraw(false);
  }

  showAll() {
    const from = this.camera.copy();
    this.camera.fit();
    this.fly(from, this.camera.copy());
    if (this.face >= 0) this.showFace(-1);
  }

  pickAt(x, y) {
    const triangle = this.renderer.pick(this.camera, x, y);
    if (triangle >= 0) this.choose(triangle);
    else this.letGo();
  }

  choose(triangle) {
    this.renderer.chosen = triangle;
    showPicked(this.mesh, triangle);
    this.redraw(false);
  }

  letGo() {
    this.renderer.chosen = -1;
    showPicked(this.mesh, -1);
    if (this.face >= 0) this.showFace(-1);
    this.redraw(false);
  }

  /** All but one face fade; -1: none does. */
  showFace(face) {
    this.face = face;
    this.paint(this.key);
  }

  /** To the next or the last one of the list of the worst. */
  step(forward) {
    if (this.worst.length === 0) return;
    this.at = this.at < 0 ? (forward > 0 ? 0 : this.worst.length - 1) : (this.at + forward + this.worst.length) % this.worst.length;
    this.flyToTriangle(this.worst[this.at]);
  }

  /** From above the triangle, a few times as wide as it is. */
  flyToTriangle(triangle) {
    const [a, b, c] = this.corners(triangle);
    const normal = cross(plus(b, a, -1), plus(c, a, -1));
    const longest = Math.max(...[[a, b], [b, c], [c, a]].map(([p, q]) => Math.hypot(...plus(p, q, -1))));
    const facing = Math.hypot(...normal) > 0 ? frameOf(normal) : this.camera.frame;
    this.choose(triangle);
    this.flyTo(this.middle(triangle), facing, 5 * longest);
  }

  /** From where the triangle in its middle faces, with its whole box. */
  flyToFace(face) {
    const low = [Infinity, Infinity, Infinity], high = low.map((x) => -x), normal = [0, 0, 0];
    for (let t = 0; t < this.mesh.head.triangles; ++t) {
      if (this.mesh.faces[t] !== face) continue;
      const [a, b, c] = this.corners(t);
      for (const p of [a, b, c]) p.forEach((x, i) => { low[i] = Math.min(low[i], x); high[i] = Math.max(high[i], x); });
      cross(plus(b, a, -1), plus(c, a, -1)).forEach((x, i) => { normal[i] += x; });
    }
    const size = Math.hypot(...plus(high, low, -1));
    const facing = Math.hypot(...normal) > 1e-6 * size * size ? frameOf(normal) : this.camera.frame;
    this.showFace(face);
    this.flyTo(low.map((x, i) => (x + high[i]) / 2), facing, 0.75 * size);
  }

  flyTo(target, frame, half) {
    const from = this.camera.copy();
    this.camera.half = half;
    this.camera.zoom(1);
    this.fly(from, { target, frame: structuredClone(frame), half: this.camera.half });
  }

  fly(from, to) {
    cancelAnimationFrame(this.flight);
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const start = performance.now(), whole = still ? 0 : 450;
    const next = (now) => {
      const t = whole > 0 ? Math.min(1, Math.max(0, (now - start) / whole)) : 1;
      this.camera.between(from, to, t * t * (3 - 2 * t));
      if (t < 1) this.flight = requestAnimationFrame(next);
      this.redraw(t < 1);
    };
    next(start);
  }
}
