// The fallback renderer on a 2D canvas: facets sorted from far to near (painter's algorithm).
// Long facets are cut up first, since one depth for a long facet puts it before or behind too much.

/** Facets all bodies together may have after cutting up: about 100 ms a picture on a slow machine. */
const FACET_BUDGET = 24000;

class Canvas2dRenderer {
  constructor(canvas, stage) {
    this.context = canvas.getContext("2d");
    if (!this.context) throw new Error("neither WebGL2 nor a 2D canvas is available");
    this.name = "canvas2d";
    const share = FACET_BUDGET / (stage.recording.bodies.length || 1);
    this.shapes = stage.shapes.map((shape) => {
      if (!shape || shape.plane) return shape;
      if (shape.circles) return ellipsoid(shape.axes, sphereLevels(share));
      return subdivided(shape, Math.min(stage.radius / 4, shape.radius * 1.5), share);
    });
  }

  draw(scene, view, pixelRatio) {
    const c = this.context;
    c.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    c.clearRect(0, 0, view.width, view.height);
    c.lineJoin = "round";
    const front = (patch) => dot(sub(view.eye, patch.centre), patch.normal) > 0;
    for (const patch of scene.planes.filter(front)) this.drawPlane(scene, view, patch, true);
    this.drawBodies(scene, view);
    if (scene.stage.cloud) this.drawCloud(scene.stage.cloud, scene.theme, view);
    for (const patch of scene.planes.filter((p) => !front(p))) this.drawPlane(scene, view, patch, false);
  }

  drawPlane(scene, view, patch, front) {
    const c = this.context;
    const { theme, stage } = scene;
    const on = (x, y) => add(patch.centre, add(scale(patch.u, x), scale(patch.v, y)));
    if (patch.solid) {
      // Rings one on the other: the fill fades towards the rim as the shader's does.
      const rings = 6;
      c.fillStyle = css(patch.rgb ?? theme.fixedRgb, planeOpacity(front && !patch.light) / rings);
      for (let ring = 1; ring <= rings; ring++) {
        const radius = patch.size * mix(0.45, 0.95, ring / rings);
        const rim = Array.from({ length: 48 }, (_, k) => on(radius * Math.cos((k * Math.PI) / 24), radius * Math.sin((k * Math.PI) / 24)));
        this.path([projectPolygon(view, rim)]);
        c.fill();
      }
    }
    for (const [i, axis] of [[0, (a, b) => on(a, b)], [1, (a, b) => on(b, a)]]) this.drawLines(scene, view, patch, axis, i, stage.gridStep);
    if (patch.solid && !patch.light && front && takesShadow(patch)) this.drawShadows(scene, view, patch);
  }

  drawLines(scene, view, patch, place, i, gap) {
    const c = this.context;
    const [r, g, b, a] = scene.theme.gridRgba;
    const pieces = 12;
    const first = Math.ceil((patch.phase[i] - patch.size) / gap);
    for (let k = first; k * gap - patch.phase[i] <= patch.size; k++) {
      const x = k * gap - patch.phase[i];
      const half = Math.sqrt(Math.max(patch.size ** 2 - x ** 2, 0));
      for (let piece = 0; piece < pieces; piece++) {
        const [y0, y1] = [mix(-half, half, piece / pieces), mix(-half, half, (piece + 1) / pieces)];
        const rim = Math.hypot(x, (y0 + y1) / 2) / patch.size;
        const ends = projectPolygon(view, [place(x, y0), place(x, y1)]);
        if (ends.length < 2) continue;
        const t = clamp((rim - 0.45) / 0.55, 0, 1);
        c.strokeStyle = css([r, g, b], a * (k % 10 === 0 ? 1 : 0.55) * (1 - t * t * (3 - 2 * t)));
        c.lineWidth = 1;
        c.beginPath();
        c.moveTo(ends[0].x, ends[0].y);
        c.lineTo(ends[1].x, ends[1].y);
        c.stroke();
      }
    }
  }

  /**
   * Each shadow as the hull of its body's corners thrown on the plane, all in one path: hulls are wound alike, so
   * that where they overlap is filled once. A hollow body's shadow is too full; facet by facet it takes seconds.
   */
  drawShadows(scene, view, patch) {
    const polygons = scene.items.map((item) => {
      const fallen = this.shapes[item.shape].points.map((corner) => {
        const p = sub(add(item.position, mapped(item.map, corner)), patch.centre);
        const height = dot(p, patch.normal);
        const q = height > 0 ? sub(p, scale(LIGHT, height / dot(patch.normal, LIGHT))) : p;
        return [dot(q, patch.u), dot(q, patch.v)];
      });
      return projectPolygon(view, hull(fallen).map(([x, y]) => add(patch.centre, add(scale(patch.u, x), scale(patch.v, y)))));
    });
    this.path(polygons);
    this.context.fillStyle = `rgba(0,0,0,${scene.theme.shadow})`;
    this.context.fill("nonzero");
  }

  path(polygons) {
    const c = this.context;
    c.beginPath();
    for (const points of polygons) {
      if (points.length < 3) continue;
      points.forEach((p, k) => (k === 0 ? c.moveTo(p.x, p.y) : c.lineTo(p.x, p.y)));
      c.closePath();
    }
  }

  drawBodies(scene, view) {
    const facets = [];
    for (const item of scene.items) this.collect(item, view, facets);
    facets.sort((a, b) => b.depth - a.depth);
    for (const facet of facets) this.drawFacet(facet);
  }

  /** The great circles of an ellipsoid, where they are on the near side. */
  collectCircles(item, shape, view, edge, facets) {
    for (const ends of shape.lines) {
      const world = ends.map((p) => add(item.position, mapped(item.map, p)));
      const outward = mapped(item.facing, ends[0].map((x, k) => x / shape.axes[k] ** 2));
      const toEye = sub(view.eye, world[0]);
      if (dot(outward, toEye) <= 0) continue;
      const points = world.map((p) => project(view, p));
      if (points.some((p) => p.depth < view.near)) continue;
      // Drawn after the facets that it lies on: nearer by more than a facet's breadth.
      facets.push({ points, depth: length(toEye) - 0.2 * shape.radius, edge, sharp: [true] });
    }
  }

  collect(item, view, facets) {
    const shape = this.shapes[item.shape];
    const edge = css(item.selected ? [1, 1, 1] : scale(item.rgb, 0.42), 1);
    const tint = item.selected ? 0.12 : 0;
    if (shape.circles) this.collectCircles(item, shape, view, item.selected ? edge : css(scale(item.rgb, 0.72)), facets);
    shape.corners.forEach((t, i) => {
      const world = t.map((p) => add(item.position, mapped(item.map, p)));
      let normal = direction(mapped(item.facing, shape.normals[i])) ?? [0, 0, 1];
      const middle = scale(add(add(world[0], world[1]), world[2]), 1 / 3);
      const toEye = sub(view.eye, middle);
      if (dot(normal, toEye) < 0) {
        if (shape.closed) return; // its own front hides it
        normal = scale(normal, -1);
      }
      const points = world.map((p) => project(view, p));
      if (points.some((p) => p.depth < view.near)) return;
      const b = brightness(normal, direction(toEye) ?? normal);
      const rgb = item.rgb.map((x) => Math.min(x * b + tint, 1));
      facets.push({ points, depth: length(toEye), fill: css(rgb), edge, sharp: shape.sharp[i] });
    });
  }

  /** Particles over everything else: lines first, then balls from far to near. */
  drawCloud(cloud, theme, view) {
    const c = this.context;
    const strokes = (segments, rgb, alpha, breadth) => {
      c.strokeStyle = css(rgb, alpha);
      c.lineWidth = breadth;
      c.beginPath();
      for (const ends of segments) {
        const [a, b] = projectPolygon(view, ends);
        if (!b) continue;
        c.moveTo(a.x, a.y);
        c.lineTo(b.x, b.y);
      }
      c.stroke();
    };
    strokes(cloud.guides, ...guidePaint(theme));
    for (const { pairs, rgb, alpha, breadth } of cloud.lines(theme)) {
      strokes(pairs.map((pair) => pair.map((vertex) => cloud.position(vertex))), rgb, alpha, breadth);
    }
    const balls = [];
    for (let i = 0; i < cloud.vertices.length / 3; i++) {
      const p = project(view, cloud.position(i));
      if (p.depth > view.near && !cloud.hidden(i)) balls.push({ ...p, i });
    }
    balls.sort((a, b) => b.depth - a.depth);
    for (const ball of balls) this.drawBall(cloud, theme, view, ball);
  }

  drawBall(cloud, theme, view, { x, y, depth, i }) {
    const c = this.context;
    const kind = cloud.kind(i);
    const least = (kind === VERTEX.particle ? 0.5 : 1.1) * LEAST_DOT;
    const radius = Math.max((cloud.radius * cloud.size(i) * view.focal) / depth, least);
    const rgb = cloud.rgb(i, theme);
    c.beginPath();
    if (kind === VERTEX.fixed) c.rect(x - radius, y - radius, 2 * radius, 2 * radius);
    else c.arc(x, y, radius, 0, 2 * Math.PI);
    if (kind !== VERTEX.centre) {
      c.fillStyle = css(rgb);
      c.fill();
    }
    if (kind === VERTEX.particle && radius > 4) {
      // The lit side: what the shader does pixel by pixel, in one spot.
      const spot = c.createRadialGradient(x - 0.3 * radius, y - 0.45 * radius, 0.1 * radius, x, y, radius);
      spot.addColorStop(0, "rgba(255,255,255,0.3)");
      spot.addColorStop(1, "rgba(0,0,0,0.25)");
      c.fillStyle = spot;
      c.fill();
    }
    if (kind === VERTEX.particle && !cloud.isSelected(i)) return;
    c.strokeStyle = cloud.isSelected(i) ? "#ffffff" : theme.ink;
    c.lineWidth = Math.max(1, 0.3 * radius);
    c.stroke();
  }

  drawFacet({ points, fill, edge, sharp }) {
    const c = this.context;
    if (fill) {
      this.path([points]);
      c.fillStyle = c.strokeStyle = fill;
      c.fill();
      c.lineWidth = 0.8; // closes the hair lines that smoothing leaves between neighbours
      c.stroke();
    }
    if (!sharp.includes(true)) return;
    c.strokeStyle = edge;
    c.lineWidth = 1.1;
    c.beginPath();
    sharp.forEach((is, k) => {
      if (!is) return;
      c.moveTo(points[k].x, points[k].y);
      c.lineTo(points[(k + 1) % 3].x, points[(k + 1) % 3].y);
    });
    c.stroke();
  }
}
