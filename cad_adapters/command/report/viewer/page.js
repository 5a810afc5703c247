// SPDX-License-Identifier: BSD-3-Clause
// The page around the view: the picked triangle, the legend, tables, buttons.

const byId = (id) => document.getElementById(id);

function nameOfFace(face) { return face.name ? `${face.reference} (${face.name})` : String(face.reference); }

/** Values of a triangle, pairs of a name and a text. */
function factsOf(mesh, triangle) {
  const facts = [['Triangle', String(triangle + 1)], ['Face', nameOfFace(mesh.head.faces[mesh.faces[triangle]])]];
  for (const scale of mesh.head.values) {
    const value = textOf(valueOf(scale, mesh.codes[scale.key][triangle]));
    facts.push([scale.title, scale.unit === 'degrees' ? value + '°' : value]);
  }
  const vertices = [0, 1, 2].map((k) => mesh.corners[3 * triangle + k] + 1);
  facts.push(['Vertices', vertices.join(', ')]);
  return facts;
}

function showPicked(mesh, triangle) {
  const rows = triangle < 0 ? [] : factsOf(mesh, triangle).map(([name, text]) => {
    const row = document.createElement('div');
    row.append(Object.assign(document.createElement('dt'), { textContent: name }), Object.assign(document.createElement('dd'), { textContent: text }));
    return row;
  });
  byId('picked').replaceChildren(...rows);
}

function showLegend(mesh, key) {
  const scale = mesh.head.values.find((each) => each.key === key);
  byId('legend').hidden = !scale;
  if (!scale) return;
  const [low, high] = scale.shown.map(textOf);
  byId('bar').style.background = `linear-gradient(to right, ${mesh.head.colours.join(', ')})`;
  byId('bar').setAttribute('aria-label', `Colours of ${scale.title}, from ${low} to ${high}`);
  byId('bar-low').textContent = low;
  byId('bar-high').textContent = high;
  byId('bar-title').textContent = `${scale.title}${scale.unit ? ', ' + scale.unit : ''}${scale.logarithmic ? ', logarithmic' : ''}`;
}

/** Rows by a column: numbers by their value, texts by the alphabet. */
function sortTable(table, column, downwards) {
  const keyOf = (row) => row.cells[column].dataset.sort ?? row.cells[column].textContent;
  const rows = [...table.tBodies[0].rows];
  const numbers = rows.every((row) => row.cells[column].dataset.sort !== undefined);
  const compare = numbers ? (a, b) => Number(keyOf(a)) - Number(keyOf(b)) : (a, b) => keyOf(a).localeCompare(keyOf(b));
  rows.sort((a, b) => (downwards ? -1 : 1) * compare(a, b));
  table.tBodies[0].append(...rows);
  [...table.tHead.rows[0].cells].forEach((cell, i) => {
    if (i === column) cell.setAttribute('aria-sort', downwards ? 'descending' : 'ascending');
    else cell.removeAttribute('aria-sort');
  });
}

function wireTables() {
  document.addEventListener('click', (event) => {
    const button = event.target.closest('button.sort');
    if (!button) return;
    const cell = button.closest('th');
    sortTable(button.closest('table'), cell.cellIndex, cell.getAttribute('aria-sort') === 'ascending');
  });
  byId('face-filter')?.addEventListener('input', (event) => {
    const wanted = event.target.value.toLowerCase();
    for (const row of byId('faces-table').tBodies[0].rows) row.hidden = !row.textContent.toLowerCase().includes(wanted);
  });
  byId('scheme').addEventListener('click', () => {
    const root = document.documentElement;
    const dark = (root.dataset.scheme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';
    root.dataset.scheme = dark ? 'light' : 'dark';
  });
}

/** Buttons of tables show their row in the view. */
function wireRows(viewer) {
  document.addEventListener('click', (event) => {
    const button = event.target.closest('button.show');
    if (!button) return;
    document.querySelectorAll('tr.chosen').forEach((row) => row.classList.remove('chosen'));
    button.closest('tr').classList.add('chosen');
    if (button.dataset.triangle !== undefined) viewer.flyToTriangle(Number(button.dataset.triangle));
    else viewer.flyToFace(Number(button.dataset.face));
    const gentle = matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth';
    byId('stage').scrollIntoView({ block: 'nearest', behavior: gentle });
  });
}

function wireTools(viewer) {
  const colours = byId('colour-by');
  for (const [key, title] of [['face', 'Face'], ...viewer.mesh.head.values.map((scale) => [scale.key, scale.title])]) {
    colours.append(new Option(title, key));
  }
  colours.addEventListener('change', () => viewer.paint(colours.value));
  byId('view-from').addEventListener('change', (event) => viewer.lookFrom(event.target.value));
  byId('show-edges').addEventListener('change', (event) => {
    viewer.renderer.edges = event.target.checked;
    viewer.redraw(false);
  });
  byId('show-all').addEventListener('click', () => viewer.showAll());
  byId('next-worst').addEventListener('click', () => viewer.step(1));
  for (const id of ['colour-by', 'view-from', 'show-edges', 'show-all', 'next-worst']) byId(id).disabled = false;
  if (viewer.mesh.head.dimension === 2) byId('view-from').value = 'top';
}
