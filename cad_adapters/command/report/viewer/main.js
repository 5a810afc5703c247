// SPDX-License-Identifier: BSD-3-Clause
// Starts the page. Without WebGL, or with unreadable data, tables and histograms stay, and a sentence reports the
// reason.

/**
 * For tests and measurements: the time of each of n pictures, milliseconds, the mesh turning; each is waited for. `fine`: as
 * when it rests; `density`: pixels of the drawing for one of the page, 0.5 while it moves on slow machines; `coarse`: as a large mesh then.
 */
function timesOfFrames(viewer, n, fine, density, coarse) {
  const { renderer, camera } = viewer;
  const pixel = new Uint8Array(4), times = [];
  renderer.resize(density);
  for (let i = 0; i < n; ++i) {
    const start = performance.now();
    camera.turn(0.05, 0.02);
    renderer.draw(camera, fine, coarse);
    renderer.gl.readPixels(0, 0, 1, 1, renderer.gl.RGBA, renderer.gl.UNSIGNED_BYTE, pixel);
    times.push(performance.now() - start);
  }
  viewer.redraw(false);
  return times;
}

async function start() {
  wireTables();
  if (!byId('viewer-data')) {
    byId('message').textContent = 'There is nothing to draw.';
    return null;
  }
  byId('message').textContent = 'The mesh is unpacked …';
  const mesh = await readMesh();
  const viewer = new Viewer(mesh);
  wireTools(viewer);
  wireRows(viewer);
  byId('message').textContent = '';
  return viewer;
}

const ready = start().catch((error) => {
  byId('message').textContent = error.message;
  document.querySelectorAll('button.show').forEach((button) => { button.disabled = true; });
  return null;
});
window.carreauReport = { ready, timesOfFrames, factsOf, readMesh, coarseMesh, Pace };
