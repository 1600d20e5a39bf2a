// Particles and lines by WebGL2: a point sprite shaded as a ball for each particle, a screen-aligned strip for each line.

const DOT_VERTEX = `#version 300 es
layout(location = 0) in vec3 position;   // relative to the eye
layout(location = 1) in vec3 paint;
layout(location = 2) in float size;      // relative; negative: hidden
layout(location = 3) in float kind;      // 0 particle, 1 fixed, 2 centre; plus 4 if selected
uniform mat4 clip;
uniform float pixels;                    // diameter of a particle of size 1 at distance 1
uniform float least;
out vec3 colour;
flat out float form;
flat out float extent;
void main() {
  colour = paint;
  form = kind;
  gl_Position = clip * vec4(position, 1.0);
  if (size < 0.0 || any(isnan(position))) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = max(pixels * abs(size) / gl_Position.w, least);
  if (mod(kind, 4.0) > 0.5) gl_PointSize = max(gl_PointSize, 2.2 * least);
  extent = gl_PointSize;
}`;

const DOT_FRAGMENT = `#version 300 es
precision highp float;
in vec3 colour;
flat in float form;
flat in float extent;
uniform vec3 right, up, back;
uniform vec3 light;
uniform vec4 ink;
out vec4 pixel;
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  at.y = -at.y;
  bool selected = form > 3.5;
  float kind = mod(form, 4.0);
  float rim = 2.0 / extent;                       // a pixel
  float r = kind > 0.5 && kind < 1.5 ? max(abs(at.x), abs(at.y)) : length(at);
  float cover = clamp((1.0 - r) / rim, 0.0, 1.0);
  if (cover <= 0.0) discard;
  vec3 shade = colour;
  if (kind < 0.5) {
    vec3 n = vec3(at, sqrt(max(0.0, 1.0 - r * r)));
    vec3 world = n.x * right + n.y * up + n.z * back;
    shade *= 0.56 + 0.14 * world.z + 0.36 * max(0.0, dot(world, light)) + 0.1 * n.z;
  } else {
    // Fixed: a square with a rim. A centre: a ring.
    float edge = max(0.3, 1.5 * rim);
    if (kind > 1.5 && r < 1.0 - edge) discard;
    if (r > 1.0 - edge) shade = ink.rgb;
  }
  if (selected) shade = r > 0.62 ? vec3(1.0) : min(shade + 0.12, 1.0);
  pixel = vec4(min(shade, 1.0) * cover, cover);
}`;

const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec2 corner;     // along 0..1, across -1..1
layout(location = 1) in vec3 from;       // relative to the eye
layout(location = 2) in vec3 to;
uniform mat4 clip;
uniform vec2 screen;                     // pixels
uniform float breadth;                   // pixels
uniform float near;
out float across;
void main() {
  vec4 a = clip * vec4(from, 1.0);
  vec4 b = clip * vec4(to, 1.0);
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * screen;
  float size = length(along);
  vec2 side = size > 0.0 ? vec2(-along.y, along.x) / size : vec2(0.0, 1.0);
  float half_breadth = 0.5 * breadth + 1.0;         // a pixel more, for the soft edge
  across = corner.y * half_breadth;
  vec4 end = corner.x < 0.5 ? a : b;
  gl_Position = end + vec4(side * corner.y * half_breadth * 2.0 / screen * end.w, 0.0, 0.0);
  if (a.w < near || b.w < near || any(isnan(from + to))) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
in float across;
uniform vec4 paint;
uniform float breadth;
out vec4 pixel;
void main() {
  float a = paint.a * clamp(0.5 * breadth + 0.5 - abs(across), 0.0, 1.0);
  if (a <= 0.0) discard;
  pixel = vec4(paint.rgb * a, a);
}`;

class WebGlCloud {
  constructor(gl, stage) {
    this.gl = gl;
    this.cloud = stage.cloud;
    this.dot = compile(gl, DOT_VERTEX, DOT_FRAGMENT);
    this.line = compile(gl, LINE_VERTEX, LINE_FRAGMENT);
    const count = this.cloud.vertices.length / 3;
    this.places = gl.createBuffer();
    this.paints = gl.createBuffer();
    this.relative = new Float32Array(3 * count);
    this.dots = gl.createVertexArray();
    gl.bindVertexArray(this.dots);
    this.attribute(this.places, 0, 3, 3, 0, 0);
    [[1, 3, 0], [2, 1, 3], [3, 1, 4]].forEach(([location, size, offset]) => this.attribute(this.paints, location, size, 5, offset, 0));
    this.ends = gl.createBuffer();
    const quad = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, quad);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]), gl.STATIC_DRAW);
    this.strips = gl.createVertexArray();
    gl.bindVertexArray(this.strips);
    this.attribute(quad, 0, 2, 2, 0, 0);
    this.attribute(this.ends, 1, 3, 6, 0, 1);
    this.attribute(this.ends, 2, 3, 6, 3, 1);
    gl.bindVertexArray(null);
  }

  attribute(buffer, location, size, stride, offset, divisor) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * stride, 4 * offset);
    gl.vertexAttribDivisor(location, divisor);
  }

  draw(scene, view, clip, pixelRatio) {
    const { gl, cloud } = this;
    const [x, y, z] = view.eye;
    for (let i = 0; i < this.relative.length; i += 3) {
      this.relative[i] = cloud.vertices[i] - x;
      this.relative[i + 1] = cloud.vertices[i + 1] - y;
      this.relative[i + 2] = cloud.vertices[i + 2] - z;
    }
    if (this.painted !== cloud.revision || this.theme !== scene.theme) this.repaint(scene.theme);
    gl.enable(gl.BLEND);
    this.drawLines(scene, view, clip, pixelRatio);
    this.drawDots(scene, view, clip, pixelRatio);
    gl.disable(gl.BLEND);
  }

  repaint(theme) {
    const { gl, cloud } = this;
    [this.painted, this.theme] = [cloud.revision, theme];
    const count = this.relative.length / 3;
    const data = new Float32Array(5 * count);
    for (let i = 0; i < count; i++) {
      data.set(cloud.rgb(i, theme), 5 * i);
      data[5 * i + 3] = cloud.hidden(i) ? -1 : cloud.size(i);
      data[5 * i + 4] = cloud.kind(i) + (cloud.isSelected(i) ? 4 : 0);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, this.paints);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    this.batches = cloud.lines(theme);
  }

  drawLines(scene, view, clip, pixelRatio) {
    const { gl, line, cloud } = this;
    gl.useProgram(line.program);
    gl.uniformMatrix4fv(line.at("clip"), false, clip);
    gl.uniform2f(line.at("screen"), view.width * pixelRatio, view.height * pixelRatio);
    gl.uniform1f(line.at("near"), view.near);
    gl.bindVertexArray(this.strips);
    const strip = (data, rgb, alpha, breadth) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.ends);
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      gl.uniform4f(line.at("paint"), ...rgb, alpha);
      gl.uniform1f(line.at("breadth"), breadth * pixelRatio);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, data.length / 6);
    };
    gl.depthMask(false); // a soft edge must not hide what is drawn after it
    if (cloud.guides.length > 0) {
      const data = new Float32Array(cloud.guides.flatMap(([a, b]) => [...sub(a, view.eye), ...sub(b, view.eye)]));
      strip(data, ...guidePaint(scene.theme));
    }
    gl.depthMask(true);
    for (const { pairs, rgb, alpha, breadth } of this.batches) {
      const data = new Float32Array(6 * pairs.length);
      pairs.forEach(([a, b], k) => {
        for (let i = 0; i < 3; i++) {
          data[6 * k + i] = this.relative[3 * a + i];
          data[6 * k + 3 + i] = this.relative[3 * b + i];
        }
      });
      strip(data, rgb, alpha, breadth);
    }
  }

  drawDots(scene, view, clip, pixelRatio) {
    const { gl, dot: program, cloud } = this;
    gl.useProgram(program.program);
    gl.uniformMatrix4fv(program.at("clip"), false, clip);
    gl.uniform1f(program.at("pixels"), 2 * cloud.radius * view.focal * pixelRatio);
    gl.uniform1f(program.at("least"), LEAST_DOT * pixelRatio);
    gl.uniform3fv(program.at("right"), view.right);
    gl.uniform3fv(program.at("up"), view.up);
    gl.uniform3fv(program.at("back"), scale(view.forward, -1));
    gl.uniform3fv(program.at("light"), LIGHT);
    gl.uniform4f(program.at("ink"), ...rgbaOfCss(scene.theme.ink));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.bufferData(gl.ARRAY_BUFFER, this.relative, gl.DYNAMIC_DRAW);
    gl.bindVertexArray(this.dots);
    gl.drawArrays(gl.POINTS, 0, this.relative.length / 3);
    gl.bindVertexArray(null);
  }
}

/** Pixels that a particle covers at least, however far it is. */
const LEAST_DOT = 3;
/** Colour, opacity and breadth of the lines that show surfaces: lightly. */
const guidePaint = (theme) => [rgbaOfCss(theme.accent).slice(0, 3), 0.4, 1.2];
