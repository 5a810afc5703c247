// SPDX-License-Identifier: BSD-3-Clause
// Pointer, wheel and keys on the canvas.

const degree = Math.PI / 180;

class Controls {
  /** `viewer` has camera, redraw(moving), pickAt(x, y), letGo(), step(forward), showAll(). */
  constructor(canvas, viewer) {
    this.canvas = canvas;
    this.viewer = viewer;
    this.pointers = new Map();
    this.dragged = false;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => this.up(event));
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  /** Place of an event, as shares of the canvas. */
  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    this.dragged = this.pointers.size > 1;
    this.start = [event.clientX, event.clientY];
  }

  up(event) {
    const known = this.pointers.delete(event.pointerId);
    if (known && event.type === 'pointerup' && !this.dragged && event.button === 0) this.viewer.pickAt(...this.place(event));
    this.viewer.redraw(false);
  }

  drag(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const still = 4;  // pixels: a click that trembles
    if (!this.dragged && Math.hypot(now[0] - this.start[0], now[1] - this.start[1]) < still) return;
    this.dragged = true;
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    const half = this.canvas.clientHeight / 2;
    if (this.pointers.size === 2) this.pinch(event.pointerId, before, now, half);
    else if (event.shiftKey || event.buttons & 6) this.viewer.camera.move(-dx / half, dy / half);
    else this.viewer.camera.turn((dx / half) * 90 * degree, (dy / half) * 90 * degree);
    this.pointers.set(event.pointerId, now);
    this.viewer.redraw(true);
  }

  /** Two fingers: their middle moves the mesh, their distance zooms. */
  pinch(id, before, now, half) {
    const other = [...this.pointers].find(([key]) => key !== id)[1];
    const distance = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
    this.viewer.camera.move(-(now[0] - before[0]) / 2 / half, (now[1] - before[1]) / 2 / half);
    this.viewer.camera.zoom(distance(now) / distance(before));
  }

  /** Towards the place under the pointer. */
  wheel(event) {
    event.preventDefault();
    const camera = this.viewer.camera;
    const [x, y] = this.place(event);
    const right = (2 * x - 1) * camera.aspect, up = 1 - 2 * y;
    const before = camera.half;
    camera.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)));
    const gained = before / camera.half - 1;
    camera.move(right * gained, up * gained);
    this.viewer.redraw(true);
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { viewer } = this, { camera } = viewer;
    const step = 10 * degree, way = 0.1;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const arrow = arrows[event.key];
    const others = {
      '+': () => camera.zoom(1.25), '=': () => camera.zoom(1.25), '-': () => camera.zoom(0.8),
      Home: () => viewer.showAll(), Enter: () => viewer.pickAt(0.5, 0.5), Escape: () => viewer.letGo(),
      n: () => viewer.step(1), p: () => viewer.step(-1),
    };
    if (arrow && event.shiftKey) camera.move(-way * arrow[0], way * arrow[1]);
    else if (arrow) camera.turn(step * arrow[0], step * arrow[1]);
    else if (others[event.key]) others[event.key]();
    else return;
    event.preventDefault();
    viewer.redraw(true);
  }
}
