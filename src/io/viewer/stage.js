// What stands on the stage: colours, light, the extent of the motion, and the list of things to draw at a time.

/** Toward the light, for shading and for the shadows on planes. */
const LIGHT = direction([0.35, -0.5, 0.9]);
const PALETTE = ["#3d7eff", "#f2872b", "#21a675", "#d8475f", "#8d6be0", "#13a3b8", "#c99a06", "#d96bb4", "#6f9426", "#a5663d"];

const rgbOfHex = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

/** Any CSS colour as [r, g, b, a] in 0..1. */
function rgbaOfCss(colour) {
  if (/^#[0-9a-f]{6}$/i.test(colour)) return [...rgbOfHex(colour), 1];
  const parts = colour.match(/[\d.]+/g).map(Number);
  return [parts[0] / 255, parts[1] / 255, parts[2] / 255, parts[3] ?? 1];
}

const css = ([r, g, b], a = 1) => `rgba(${Math.round(255 * r)},${Math.round(255 * g)},${Math.round(255 * b)},${a})`;

/** After the palette, hues by the golden angle, so that neighbours in the list stay apart. */
function bodyColour(n) {
  if (n < PALETTE.length) return rgbOfHex(PALETTE[n]);
  const hue = (n * 137.508) % 360;
  const [s, l] = [0.58, n % 2 ? 0.48 : 0.6];
  const part = (k) => l - s * Math.min(l, 1 - l) * clamp(Math.min(((k + hue / 30) % 12) - 3, 9 - ((k + hue / 30) % 12)), -1, 1);
  return [part(0), part(8), part(4)];
}

/** Brightness of a facet: sky and ground, the light, and a little from the eye. The shader has the same formula. */
function brightness(normal, toEye) {
  return 0.56 + 0.14 * normal[2] + 0.36 * Math.max(0, dot(normal, LIGHT)) + 0.1 * Math.max(0, dot(normal, toEye));
}

const cssVariable = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function readTheme() {
  const theme = { dark: matchMedia("(prefers-color-scheme: dark)").matches };
  for (const name of ["ink", "muted", "line", "accent", "kinetic", "potential", "total", "contact", "grid", "fixed"]) {
    theme[name] = cssVariable(`--${name}`);
  }
  theme.gridRgba = rgbaOfCss(theme.grid);
  theme.fixedRgb = rgbaOfCss(theme.fixed).slice(0, 3);
  theme.shadow = theme.dark ? 0.45 : 0.2;
  return theme;
}

/** Facets that all ellipsoids together may have: more show no more, and a software renderer has to draw them too. */
const FACETS_OF_ELLIPSOIDS = 100000;

/** Positions kept for the first view: a few thousand give the same view as a million. */
const MAX_VIEW_POINTS = 4000;

/** The box of all poses of the chosen bodies, each widened by its body's radius, and of all particles; null if there is none. */
function extent(recording, shapes, chosen) {
  const points = [];
  const { frames, particles } = recording;
  const every = Math.ceil((frames.length * (recording.bodies.length + particles.n)) / MAX_VIEW_POINTS);
  let n = 0;
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const take = (x, y, z, always) => {
    if (!Number.isFinite(x + y + z)) return;
    [low[0], low[1], low[2]] = [Math.min(low[0], x), Math.min(low[1], y), Math.min(low[2], z)];
    [high[0], high[1], high[2]] = [Math.max(high[0], x), Math.max(high[1], y), Math.max(high[2], z)];
    if (n++ % every === 0 || always) points.push({ position: [x, y, z], radius: 0 });
  };
  for (const { frame } of frames) {
    const begin = 3 * frame * particles.n;
    for (let i = begin; i < begin + 3 * particles.n; i += 3) {
      take(particles.positions[i], particles.positions[i + 1], particles.positions[i + 2], false);
    }
  }
  const anchors = recording.links.flatMap(({ ends }) => ends).filter((end) => end.body == null).map((end) => end.point);
  for (const point of [...stillPoints(particles), ...anchors]) take(...point, true);
  recording.bodies.forEach((body, i) => {
    if (!chosen(body, shapes[body.shape])) return;
    const radius = shapes[body.shape]?.radius ?? 0;
    for (const { frame } of recording.frames) {
      const pose = recordedPose(recording, frame, i);
      if (!pose) continue;
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], pose.position[k] - radius);
        high[k] = Math.max(high[k], pose.position[k] + radius);
      }
      if (n++ % every === 0) points.push({ position: pose.position, radius });
    }
  });
  return allFinite(low) && allFinite(high) ? { low, high, points } : null;
}

class Stage {
  constructor(recording) {
    this.recording = recording;
    const share = FACETS_OF_ELLIPSOIDS / (recording.bodies.length || 1);
    this.shapes = recording.shapes.map((shape) => buildShape(shape, share));
    const solid = (shape) => shape && !shape.plane;
    const box = extent(recording, this.shapes, (body, shape) => solid(shape) && !body.fixed)
      ?? extent(recording, this.shapes, (_, shape) => solid(shape))
      ?? extent(recording, this.shapes, () => true)
      ?? { low: [-1, -1, -1], high: [1, 1, 1], points: [{ position: [0, 0, 0], radius: 1 }] };
    const diagonal = length(sub(box.high, box.low));
    this.middle = scale(add(box.low, box.high), 0.5);
    this.radius = diagonal > 0 ? diagonal / 2 : 1;
    this.box = box;
    this.points = diagonal > 0 ? box.points : [{ position: this.middle, radius: 1 }];
    this.gridStep = roundStep(this.radius / 10);
    // Marks are of the size of what touches, but never lost in the picture.
    const radii = recording.bodies.filter((body) => !body.fixed).map((body) => this.shapes[body.shape]?.radius ?? 0);
    const middling = radii.sort((a, b) => a - b)[radii.length >> 1] ?? 0;
    this.arrow = clamp(2 * middling, 0.05 * this.radius, 0.3 * this.radius);
    this.guidePlanes = recording.particles.guides.filter((guide) => guide.plane && direction(guide.plane.normal));
    this.hasPlane = this.guidePlanes.length > 0 || recording.bodies.some((body) => this.shapes[body.shape]?.plane);
    let moving = 0;
    this.look = recording.bodies.map((body) => ({ hidden: false, rgb: body.fixed ? null : bodyColour(moving++) }));
    this.cloud = recording.particles.n > 0 ? new Cloud(recording.particles, this, () => bodyColour(moving++)) : null;
    this.selected = -1;
  }

  rgb(body, theme) {
    return this.look[body].rgb ?? theme.fixedRgb;
  }

  /** Everything that is drawn at a time, positions relative to the scene's centre. */
  at(time, theme) {
    const between = bracket(this.recording, time);
    const items = [];
    const planes = [];
    this.recording.bodies.forEach((body, i) => {
      const shape = this.shapes[body.shape];
      const pose = poseAt(this.recording, i, between);
      if (!pose || !shape || this.look[i].hidden) return;
      const map = mapOf(pose.quaternion, pose.stretch);
      const item = { position: pose.position, map, facing: cofactors(map), body: i, shape: body.shape, rgb: this.rgb(i, theme), selected: i === this.selected };
      if (shape.plane) planes.push(this.patch(pose.position, rotate(pose.quaternion, shape.plane), body.fixed ? null : item.rgb));
      else items.push(item);
    });
    for (const { plane } of this.guidePlanes) planes.push({ ...this.patch(plane.point, direction(plane.normal), rgbaOfCss(theme.accent).slice(0, 3)), light: true });
    if (!this.hasPlane) planes.push(this.referenceGrid());
    this.cloud?.moveTo(between);
    return { items, planes, links: this.links(between), shapes: this.shapes, theme, stage: this };
  }

  /** Joints and springs where they are: their ends, and of a hinge the direction of its axis. */
  links(between) {
    const placed = ({ body, point }) => {
      if (body == null) return { point, map: null };
      const pose = this.look[body]?.hidden ? null : poseAt(this.recording, body, between);
      if (!pose) return null;
      const map = mapOf(pose.quaternion, pose.stretch);
      return { point: add(pose.position, mapped(map, point)), map };
    };
    return this.recording.links.flatMap(({ kind, ends, axis }) => {
      const [a, b] = ends.map(placed);
      if (!a || !b) return [];
      const along = axis && direction(a.map ? mapped(a.map, axis) : axis);
      return [{ kind, ends: [a.point, b.point], fixed: [!a.map, !b.map], axis: along }];
    });
  }

  /** The part of a plane that is near the motion; its lines stay at whole steps from the plane's own point. */
  patch(point, normal, rgb) {
    const [u, v] = tangents(normal);
    const away = sub(this.middle, point);
    const distance = dot(away, normal);
    return {
      normal, u, v, rgb, solid: true,
      centre: sub(this.middle, scale(normal, distance)),
      // Phase of the grid at the patch's centre, reduced so that the shader's f32 keeps its digits far from the point.
      phase: [dot(away, u) % (10 * this.gridStep), dot(away, v) % (10 * this.gridStep)],
      size: 2.4 * this.radius + Math.min(Math.abs(distance), this.radius),
    };
  }

  /** Without a plane in the scene: lines under the motion, to tell up from down. Not a thing: it takes no shadow. */
  referenceGrid() {
    const z = this.box.low[2] - 0.08 * this.radius;
    const patch = this.patch([0, 0, z], [0, 0, 1], null);
    return { ...patch, solid: false };
  }

  /** The nearest body under a ray, or -1. */
  pick(scene, origin, ray) {
    let best = { distance: Infinity, body: -1 };
    for (const item of scene.items) {
      const shape = this.shapes[item.shape];
      const o = unmapped(item.map, sub(origin, item.position));
      const d = unmapped(item.map, ray);
      const along = -dot(o, d) / dot(d, d);
      if (length(add(o, scale(d, along))) > shape.radius) continue;
      for (const triangle of shape.corners) {
        const distance = hit(triangle, o, d);
        if (distance < best.distance) best = { distance, body: item.body };
      }
    }
    return best.body;
  }
}

/** How far along the ray o + t d it meets a triangle (Cramer's rule); Infinity if it does not. */
function hit([a, b, c], o, d) {
  const [ab, ac, ao] = [sub(b, a), sub(c, a), sub(o, a)];
  const p = cross(d, ac);
  const det = dot(ab, p);
  if (det === 0) return Infinity;
  const q = cross(ao, ab);
  const [u, v, t] = [dot(ao, p) / det, dot(d, q) / det, dot(ac, q) / det];
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : Infinity;
}
