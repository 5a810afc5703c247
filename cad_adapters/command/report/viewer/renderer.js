// SPDX-License-Identifier: BSD-3-Clause
// Triangles on a canvas, by WebGL 2: one draw call a picture, one more for the triangle that is picked.

const vertexShader = `#version 300 es
precision highp float;
in vec3 position;
uniform mat4 toClip;
uniform vec3 toPixels;
flat out int triangle;
out vec3 place, weights;
void main() {
  gl_Position = toClip * vec4(position, 1.0);
  place = gl_Position.xyz * toPixels;
  int k = gl_VertexID % 3;
  weights = vec3(k == 0, k == 1, k == 2);
  triangle = gl_VertexID / 3;
}`;

// Two lamps and some light from everywhere; both sides of a triangle are lit, as on pictures of the command. Lines along
// sides fade where triangles are few pixels wide, or a fine mesh would be black.
const fragmentShader = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
flat in int triangle;
in vec3 place, weights;
uniform sampler2D colours;
uniform bool edges, chosen;
out vec4 colour;
void main() {
  vec4 own = texelFetch(colours, ivec2(triangle % 2048, triangle / 2048), 0);
  int sides = int(own.a * 255.0 + 0.5);
  vec3 normal = cross(dFdx(place), dFdy(place));
  float size = length(normal);
  normal = size > 0.0 ? normal / size : vec3(0.0, 0.0, 1.0);
  if (normal.z < 0.0) normal = -normal;
  float light = 0.21 + 0.75 * max(0.0, dot(normal, vec3(-0.42, 0.63, 0.653))) + 0.16 * max(0.0, dot(normal, vec3(0.78, -0.1, 0.618)));
  vec3 base = chosen ? vec3(0.75, 0.08, 0.0) : pow(own.rgb, vec3(2.2));
  vec3 lit = base * light;
  vec3 width = max(fwidth(weights), vec3(1e-9));
  vec3 pixels = weights / width;
  float ink = 0.0;
  for (int k = 0; k < 3; ++k) {
    float away = pixels[(k + 2) % 3], height = 1.0 / width[(k + 2) % 3];
    bool curve = (sides >> k & 1) == 1, hidden = (sides >> (3 + k) & 1) == 1;
    if (curve) ink = max(ink, 0.95 * (1.0 - smoothstep(0.8, 1.6, away)));
    else if (edges && !hidden) ink = max(ink, 0.75 * clamp((height - 3.0) / 8.0, 0.0, 1.0) * (1.0 - smoothstep(0.3, 1.0, away)));
  }
  float bright = dot(base, vec3(0.2126, 0.7152, 0.0722));
  lit = mix(lit, bright < 0.025 ? vec3(0.45) : vec3(0.01), ink);
  colour = vec4(pow(lit, vec3(1.0 / 2.2)), 1.0);
}`;

const pickShader = `#version 300 es
precision highp float;
precision highp int;
flat in int triangle;
out vec4 colour;
void main() {
  int id = triangle + 1;
  colour = vec4(id & 255, id >> 8 & 255, id >> 16 & 255, id >> 24 & 255) / 255.0;
}`;

const textureWidth = 2048;  // as in the shader

function compiled(gl, fragment) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, 'position');
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) || 'A shader fails.');
  const at = (name) => gl.getUniformLocation(program, name);
  return { program, toClip: at('toClip'), toPixels: at('toPixels'), colours: at('colours'), edges: at('edges'), chosen: at('chosen') };
}

/** Corner by corner of triangles: 16 bits a coordinate where the data has as many, else single precision. */
function cornerArray(mesh, corners) {
  const narrow = mesh.most === 0xffff;
  const step = narrow ? 4 : 3;  // bytes of an attribute are a multiple of four
  const array = narrow ? new Uint16Array(step * corners.length) : new Float32Array(step * corners.length);
  const scale = narrow ? 1 : 1 / mesh.most;
  for (let i = 0; i < corners.length; ++i) {
    const from = 3 * corners[i];
    for (let x = 0; x < 3; ++x) array[step * i + x] = mesh.positions[from + x] * scale;
  }
  return { array, narrow };
}

const coarseCount = 60000;            // triangles of the coarse mesh, about
const coarseFrom = 3 * coarseCount;   // a mesh of fewer has none
const allHidden = 0b111000;           // sides without lines

class Renderer {
  /** Throws Error when there is no WebGL 2. */
  constructor(canvas, mesh) {
    this.canvas = canvas;
    this.mesh = mesh;
    this.gl = canvas.getContext('webgl2', { antialias: false, alpha: true });
    if (!this.gl) throw new Error('This browser has no WebGL 2: tables and histograms are all there is.');
    this.edges = true;
    this.chosen = -1;
    this.upload();
  }

  /** All that is on the graphics card; again when it was lost. */
  upload() {
    const gl = this.gl;
    this.fine = this.coarse = null;
    this.drawing = compiled(gl, fragmentShader);
    this.picking = compiled(gl, pickShader);
    this.whole = this.makeSet(this.mesh.pieces.corners);
    this.bytes = this.whole.bytes;
    gl.enable(gl.DEPTH_TEST);
  }

  /** Triangles on the card: their corners, and a texture for their colours. */
  makeSet(corners) {
    const gl = this.gl;
    const { array, narrow } = cornerArray(this.mesh, corners);
    const set = { vertices: gl.createVertexArray(), texture: gl.createTexture(), triangles: corners.length / 3 };
    gl.bindVertexArray(set.vertices);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, narrow ? gl.UNSIGNED_SHORT : gl.FLOAT, narrow, narrow ? 8 : 12, 0);
    gl.bindTexture(gl.TEXTURE_2D, set.texture);
    for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, which, gl.NEAREST);
    set.rows = Math.max(1, Math.ceil(set.triangles / textureWidth));
    set.bytes = { corners: array.byteLength, colours: 4 * textureWidth * set.rows };
    return set;
  }

  bind(set) {
    this.gl.bindVertexArray(set.vertices);
    this.gl.bindTexture(this.gl.TEXTURE_2D, set.texture);
  }

  setColours(set, colours) {
    const gl = this.gl;
    this.bind(set);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, textureWidth, set.rows, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours);
  }

  paint(key, face) {
    this.painted = [key, face];
    this.setColours(this.whole, coloursOfPieces(this.mesh, coloursOf(this.mesh, key, face), this.whole.bytes.colours));
    if (this.coarse) this.paintCoarse();
  }

  /** Gives each coarse triangle the colour of its source, without lines. */
  paintCoarse() {
    const all = coloursOf(this.mesh, ...this.painted);
    const own = new Uint8Array(this.coarse.bytes.colours);
    this.coarse.from.forEach((t, i) => {
      own.set(all.subarray(4 * t, 4 * t + 3), 4 * i);
      own[4 * i + 3] = allHidden;
    });
    this.setColours(this.coarse, own);
  }

  hasCoarse() { return this.whole.triangles >= coarseFrom; }

  /** Made on first use: fast machines never use it. */
  coarseSet() {
    if (!this.coarse) {
      const { corners, from } = coarseMesh(this.mesh, coarseCount);
      this.coarse = { ...this.makeSet(corners), from };
      this.paintCoarse();
    }
    return this.coarse;
  }

  /** Pixels of the drawing for one of the page: fewer while it moves and the machine is slow. */
  resize(density) {
    const width = Math.max(1, Math.round(this.canvas.clientWidth * density));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * density));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
  }

  use(shaders, camera) {
    const gl = this.gl;
    const { width, height } = this.canvas;
    camera.aspect = width / height;
    const clip = camera.toClip();
    gl.useProgram(shaders.program);
    gl.viewport(0, 0, width, height);
    gl.uniformMatrix4fv(shaders.toClip, false, clip);
    // Depth grows away from the eye and is scaled otherwise than right and up: normals need lengths of one pixel in all.
    const pixels = height / 2;
    gl.uniform3f(shaders.toPixels, width / 2, pixels, (-camera.depth() / camera.half) * pixels);
  }

  /** A frame of four samples a pixel, as large as the canvas. */
  fineFrame() {
    const gl = this.gl;
    const { width, height } = this.canvas;
    if (this.fine?.width === width && this.fine.height === height) return this.fine.frame;
    if (this.fine) this.remove(this.fine);
    this.fine = { width, height, ...this.makeFrame(Math.min(4, gl.getParameter(gl.MAX_SAMPLES))) };
    return this.fine.frame;
  }

  makeFrame(samples) {
    const gl = this.gl;
    const { width, height } = this.canvas;
    const frame = gl.createFramebuffer(), stores = [];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    for (const [format, place] of [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
      const store = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, store);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
      stores.push(store);
    }
    return { frame, stores };
  }

  remove({ frame, stores }) {
    this.gl.deleteFramebuffer(frame);
    stores.forEach((store) => this.gl.deleteRenderbuffer(store));
  }

  /**
   * `fine`: with smooth outlines, which take several times as long where the processor draws: not while the mesh moves. `coarse`: the
   * coarse mesh in the place of the whole one.
   */
  draw(camera, fine, coarse = false) {
    const gl = this.gl;
    const { width, height } = this.canvas;
    const set = coarse && this.hasCoarse() ? this.coarseSet() : this.whole;
    gl.bindFramebuffer(gl.FRAMEBUFFER, fine ? this.fineFrame() : null);
    this.drawAll(camera, set);
    if (!fine) return;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.fine.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** Milliseconds from now until the card has drawn all requests so far. */
  async finished() {
    const gl = this.gl, start = performance.now();
    const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    while (sync && !gl.isContextLost() && gl.clientWaitSync(sync, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise((done) => { setTimeout(done, 1); });
    gl.deleteSync(sync);
    return performance.now() - start;
  }

  drawAll(camera, set) {
    const gl = this.gl;
    this.bind(set);
    this.use(this.drawing, camera);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniform1i(this.drawing.edges, this.edges);
    gl.uniform1i(this.drawing.chosen, false);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * set.triangles);
    this.drawCalls = 1;
    if (this.chosen < 0) return;
    this.bind(this.whole);
    gl.uniform1i(this.drawing.chosen, true);
    gl.depthFunc(gl.ALWAYS);
    const { first, count } = piecesOf(this.mesh, this.chosen);
    gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * count);
    gl.depthFunc(gl.LESS);
    this.drawCalls = 2;
  }

  /** The triangle at a place of the canvas, in shares of it from the upper left corner; -1: none. Numbers of triangles are drawn as colours. */
  pick(camera, x, y) {
    const gl = this.gl;
    const { width, height } = this.canvas;
    const made = this.makeFrame(0);
    const column = Math.min(width - 1, Math.floor(x * width)), row = Math.min(height - 1, Math.floor((1 - y) * height));
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(column, row, 1, 1);
    this.bind(this.whole);
    this.use(this.picking, camera);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * this.whole.triangles);
    const id = new Uint8Array(4);
    gl.readPixels(column, row, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, id);
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    this.remove(made);
    const piece = (id[0] | id[1] << 8 | id[2] << 16 | id[3] << 24) - 1;
    return piece < 0 ? -1 : triangleOf(this.mesh, piece);
  }
}
