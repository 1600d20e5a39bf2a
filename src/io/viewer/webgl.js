// The WebGL2 renderer: one instanced call per shape for facets, edges and shadows; planes as shaded patches.
// Positions reach the card relative to the eye, so that f32 has its finest steps where one looks.

const BODY_VERTEX = `#version 300 es
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 facet;
layout(location = 2) in vec3 position;
layout(location = 3) in vec3 first;   // the columns of the body's map
layout(location = 4) in vec3 second;
layout(location = 5) in vec3 third;
layout(location = 6) in vec4 paint;
uniform mat4 clip;
uniform vec4 plane;      // unit normal and offset, relative to the eye
uniform vec3 light;
uniform bool shadow;
out vec3 place;
out vec3 normal;
out vec4 colour;
void main() {
  place = position + mat3(first, second, third) * corner;
  normal = mat3(cross(second, third), cross(third, first), cross(first, second)) * facet;
  colour = paint;
  if (shadow) {
    float height = dot(plane.xyz, place) - plane.w;
    place -= height > 0.0 ? light * height / dot(plane.xyz, light) : plane.xyz * height;
  }
  gl_Position = clip * vec4(place, 1.0);
}`;

const BODY_FRAGMENT = `#version 300 es
precision highp float;
in vec3 place;
in vec3 normal;
in vec4 colour;
uniform vec3 light;
uniform vec4 flatColour;   // with alpha above 0: no shading (edges, shadows)
uniform float edge;        // above 0: the body's colour, darkened
out vec4 pixel;
void main() {
  if (flatColour.a > 0.0) { pixel = vec4(flatColour.rgb * flatColour.a, flatColour.a); return; }
  if (edge > 0.0) { pixel = vec4(mix(colour.rgb * edge, vec3(1.0), colour.a * 0.9), 1.0); return; }
  vec3 toEye = normalize(-place);
  vec3 n = normalize(normal);
  if (dot(n, toEye) < 0.0) n = -n;
  float b = 0.56 + 0.14 * n.z + 0.36 * max(0.0, dot(n, light)) + 0.1 * max(0.0, dot(n, toEye));
  pixel = vec4(min(colour.rgb * b + colour.a * 0.12, 1.0), 1.0);
}`;

const PLANE_VERTEX = `#version 300 es
layout(location = 0) in vec2 corner;
uniform mat4 clip;
uniform vec3 centre, u, v;
uniform float size;
out vec2 at;
void main() {
  at = corner * size;
  gl_Position = clip * vec4(centre + at.x * u + at.y * v, 1.0);
}`;

const PLANE_FRAGMENT = `#version 300 es
precision highp float;
in vec2 at;
uniform vec2 phase;
uniform float size, gap;
uniform vec4 fill, line;
out vec4 pixel;
float lines(float gap) {
  vec2 w = fwidth(at) / gap;
  vec2 d = abs(fract((at + phase) / gap - 0.5) - 0.5) / w;
  vec2 crisp = clamp(1.0 - d, 0.0, 1.0) * clamp(1.2 - 2.5 * w, 0.0, 1.0);   // fades before it shimmers
  return max(crisp.x, crisp.y);
}
void main() {
  float fade = 1.0 - smoothstep(0.45, 1.0, length(at) / size);
  float ink = max(0.55 * lines(gap), lines(10.0 * gap)) * line.a;
  float a = mix(fill.a, 1.0, ink) * fade;
  pixel = vec4(mix(fill.rgb, line.rgb, ink / max(mix(fill.a, 1.0, ink), 1e-6)) * a, a);
}`;

function compile(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`shader: ${gl.getProgramInfoLog(program)}`);
  const places = new Map();
  const at = (name) => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
    return places.get(name);
  };
  return { program, at };
}

/** Column-major clip matrix for points relative to the eye. */
function clipMatrix(view) {
  const [sx, sy] = [(2 * view.focal) / view.width, (2 * view.focal) / view.height];
  const [n, f] = [view.near, view.far];
  const [r, u, w] = [view.right, view.up, view.forward];
  const [a, b] = [(f + n) / (f - n), (-2 * f * n) / (f - n)];
  const m = [];
  for (let k = 0; k < 3; k++) m.push(sx * r[k], sy * u[k], a * w[k], w[k]);
  return [...m, 0, 0, b, 0];
}

const FLOATS_PER_INSTANCE = 16;

class WebGlRenderer {
  constructor(canvas, stage) {
    const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, premultipliedAlpha: true });
    if (!gl) throw new Error("WebGL2 is not available");
    this.gl = gl;
    this.name = "webgl2";
    this.body = compile(gl, BODY_VERTEX, BODY_FRAGMENT);
    this.plane = compile(gl, PLANE_VERTEX, PLANE_FRAGMENT);
    this.meshes = stage.shapes.map((shape) => (shape && !shape.plane ? this.upload(shape) : null));
    this.cloud = stage.cloud ? new WebGlCloud(gl, stage) : null;
    this.quad = gl.createVertexArray();
    gl.bindVertexArray(this.quad);
    this.buffer(new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]));
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
    gl.bindVertexArray(null);
  }

  buffer(data) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    return buffer;
  }

  upload(shape) {
    const { gl } = this;
    const instances = gl.createBuffer();
    const facets = new Float32Array(shape.corners.flatMap((t, i) => t.flatMap((p) => [...p, ...shape.normals[i]])));
    const lines = new Float32Array(shape.lines.flatMap((ends) => ends.flatMap((p) => [...p, 0, 0, 0])));
    const part = (data) => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      this.buffer(data);
      const attribute = (location, size, stride, offset, divisor) => {
        gl.enableVertexAttribArray(location);
        gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * stride, 4 * offset);
        gl.vertexAttribDivisor(location, divisor);
      };
      attribute(0, 3, 6, 0, 0);
      attribute(1, 3, 6, 3, 0);
      gl.bindBuffer(gl.ARRAY_BUFFER, instances);
      attribute(2, 3, FLOATS_PER_INSTANCE, 0, 1);
      for (const column of [0, 1, 2]) attribute(3 + column, 3, FLOATS_PER_INSTANCE, 3 + 3 * column, 1);
      attribute(6, 4, FLOATS_PER_INSTANCE, 12, 1);
      return { array, count: data.length / 6 };
    };
    return { instances, facets: part(facets), lines: part(lines), edge: shape.circles ? 0.72 : 0.42 };
  }

  draw(scene, view, pixelRatio) {
    const { gl } = this;
    gl.viewport(0, 0, Math.round(view.width * pixelRatio), Math.round(view.height * pixelRatio));
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const clip = clipMatrix(view);
    this.fillInstances(scene, view);
    this.drawBodies(clip);
    this.cloud?.draw(scene, view, clip, pixelRatio);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    for (const plane of scene.planes) this.drawPlane(scene, view, clip, plane);
    gl.disable(gl.BLEND);
    gl.bindVertexArray(null);
  }

  fillInstances(scene, view) {
    const { gl } = this;
    const groups = this.meshes.map(() => []);
    for (const { shape, position, map, rgb, selected } of scene.items) {
      groups[shape].push(...sub(position, view.eye), ...map.flat(), ...rgb, selected ? 1 : 0);
    }
    this.groups = [];
    groups.forEach((list, i) => {
      if (list.length === 0) return;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.meshes[i].instances);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(list), gl.DYNAMIC_DRAW);
      this.groups.push({ mesh: this.meshes[i], count: list.length / FLOATS_PER_INSTANCE });
    });
  }

  drawBodies(clip) {
    const { gl, body } = this;
    gl.useProgram(body.program);
    gl.uniformMatrix4fv(body.at("clip"), false, clip);
    gl.uniform3fv(body.at("light"), LIGHT);
    gl.uniform1i(body.at("shadow"), 0);
    gl.uniform4f(body.at("flatColour"), 0, 0, 0, 0);
    gl.uniform1f(body.at("edge"), 0);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1); // facets step back so that their edges are not half hidden
    for (const { mesh, count } of this.groups) {
      gl.bindVertexArray(mesh.facets.array);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, mesh.facets.count, count);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
    for (const { mesh, count } of this.groups) {
      gl.uniform1f(body.at("edge"), mesh.edge);
      gl.bindVertexArray(mesh.lines.array);
      gl.drawArraysInstanced(gl.LINES, 0, mesh.lines.count, count);
    }
  }

  drawPlane(scene, view, clip, patch) {
    const { gl, plane } = this;
    const { theme, stage } = scene;
    const centre = sub(patch.centre, view.eye);
    const front = dot(centre, patch.normal) < 0;
    const rgb = patch.rgb ?? theme.fixedRgb;
    gl.useProgram(plane.program);
    gl.uniformMatrix4fv(plane.at("clip"), false, clip);
    gl.uniform3fv(plane.at("centre"), centre);
    gl.uniform3fv(plane.at("u"), patch.u);
    gl.uniform3fv(plane.at("v"), patch.v);
    gl.uniform2fv(plane.at("phase"), patch.phase);
    gl.uniform1f(plane.at("size"), patch.size);
    gl.uniform1f(plane.at("gap"), stage.gridStep);
    gl.uniform4f(plane.at("fill"), ...rgb, patch.solid ? planeOpacity(front && !patch.light) : 0);
    gl.uniform4fv(plane.at("line"), theme.gridRgba);
    gl.bindVertexArray(this.quad);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    if (patch.solid && !patch.light && front && takesShadow(patch)) this.drawShadows(theme, centre, patch, clip);
  }

  /** Bodies flattened along the light; the stencil lets overlapping facets darken a pixel once. */
  drawShadows(theme, centre, patch, clip) {
    const { gl, body } = this;
    gl.useProgram(body.program);
    gl.uniformMatrix4fv(body.at("clip"), false, clip);
    gl.uniform1i(body.at("shadow"), 1);
    gl.uniform4f(body.at("plane"), ...patch.normal, dot(patch.normal, centre));
    gl.uniform4f(body.at("flatColour"), 0, 0, 0, theme.shadow);
    gl.clear(gl.STENCIL_BUFFER_BIT);
    gl.enable(gl.STENCIL_TEST);
    gl.stencilFunc(gl.EQUAL, 0, 255);
    gl.stencilOp(gl.KEEP, gl.KEEP, gl.INCR);
    for (const { mesh, count } of this.groups) {
      gl.bindVertexArray(mesh.facets.array);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, mesh.facets.count, count);
    }
    gl.disable(gl.STENCIL_TEST);
  }
}

/** From behind, a plane must not hide what stands on it. */
const planeOpacity = (front) => (front ? 0.34 : 0.1);
/** A plane that the light only grazes would take shadows without end. */
const takesShadow = (patch) => dot(patch.normal, LIGHT) > 0.5;
