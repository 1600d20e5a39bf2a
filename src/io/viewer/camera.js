// A camera that orbits a target, z up, and the gestures that move it.

const FIELD_OF_VIEW = (40 * Math.PI) / 180;
/** Short of the pole: beyond it the picture would stand on its head. */
const MAX_PITCH = (89.5 * Math.PI) / 180;

class Camera {
  constructor() {
    this.setHome([0, 0, 0], 1, []);
  }

  /** Sets what `reset` shows: the picture has to hold all the points, each with its radius. */
  setHome(target, radius, points) {
    this.home = { target, radius, points };
    this.reset();
  }

  reset() {
    this.target = [...this.home.target];
    this.yaw = (-60 * Math.PI) / 180;
    this.pitch = (20 * Math.PI) / 180;
    this.fit = true; // distance follows the picture's shape until the user zooms
    this.homeAxes = null;
    this.distance = 4 * this.home.radius;
  }

  /** The least distance from which every home point is in the picture; `tx`, `ty` are the tangents of half its angles. */
  fitted(tx, ty, { right, up, forward }) {
    let distance = 0.5 * this.home.radius;
    for (const { position, radius } of this.home.points) {
      const d = sub(position, this.home.target);
      const [x, y, z] = [right, up, forward].map((axis) => dot(d, axis));
      // A ball touches the side of the picture at radius / cos of the side's angle.
      const need = (side, t) => (Math.abs(side) + radius * Math.hypot(1, t)) / t - z;
      distance = Math.max(distance, need(x, tx), need(y, ty));
    }
    return distance;
  }

  /** What a renderer needs: eye, axes, and pixels per unit of tangent. */
  view(width, height) {
    const half = Math.tan(FIELD_OF_VIEW / 2);
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const back = [cp * cy, cp * sy, sp];
    const forward = scale(back, -1);
    const right = [-sy, cy, 0];
    const up = cross(right, forward);
    // 0.9: a margin, for marks and names that stand out beyond the bodies.
    if (this.fit) this.distance = this.fitted((0.9 * half * width) / height, 0.9 * half, this.homeAxes ??= { right, up, forward });
    const far = 3 * (this.distance + 8 * this.home.radius);
    return {
      eye: add(this.target, scale(back, this.distance)),
      right, up, forward, width, height,
      focal: height / 2 / half, // pixels
      near: Math.max(0.01 * this.distance, 1e-5 * far),
      far,
    };
  }

  orbit(dx, dy) {
    this.yaw -= dx * 0.008; // radians a pixel: half a turn for 400 px
    this.pitch = clamp(this.pitch + dy * 0.008, -MAX_PITCH, MAX_PITCH);
  }

  pan(dx, dy, view) {
    const metres = this.distance / view.focal;
    this.target = add(this.target, add(scale(view.right, -dx * metres), scale(view.up, dy * metres)));
  }

  zoom(factor) {
    this.fit = false;
    this.distance = clamp(this.distance * factor, 0.02 * this.home.radius, 60 * this.home.radius);
  }
}

/** Where a point falls: pixels from the top left, and its distance along the line of sight. */
function project(view, point) {
  const d = sub(point, view.eye);
  const depth = dot(d, view.forward);
  const k = view.focal / depth;
  return { x: view.width / 2 + k * dot(d, view.right), y: view.height / 2 - k * dot(d, view.up), depth };
}

/** Cuts a convex polygon at the near plane and projects the rest. */
function projectPolygon(view, points) {
  const height = (p) => dot(sub(p, view.eye), view.forward) - view.near;
  const kept = [];
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length];
    const [hp, hq] = [height(p), height(q)];
    if (hp >= 0) kept.push(p);
    if (hp >= 0 !== hq >= 0) kept.push(add(p, scale(sub(q, p), hp / (hp - hq))));
  });
  return kept.map((p) => project(view, p));
}

/** Drag orbits; right, middle or shift drag and two fingers pan; wheel and pinch zoom; a click without a drag picks. */
function attachGestures(element, camera, { viewNow, changed, picked }) {
  const pointers = new Map();
  let travelled = 0;
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, d: Math.hypot(a.x - b.x, a.y - b.y) };
  };
  const release = (event) => {
    const single = pointers.size === 1 && event.type === "pointerup" && event.button === 0;
    if (pointers.delete(event.pointerId) && single && travelled < 4) picked(event.offsetX, event.offsetY);
  };
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    if (pointers.size === 0) travelled = 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size >= 2 ? spread() : null;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    travelled += Math.hypot(dx, dy);
    if (before) {
      const after = spread();
      camera.pan(after.x - before.x, after.y - before.y, viewNow());
      if (after.d > 0 && before.d > 0) camera.zoom(before.d / after.d);
      travelled = Infinity;
    } else if (event.shiftKey || event.buttons & 6) {
      camera.pan(dx, dy, viewNow());
    } else {
      camera.orbit(dx, dy);
    }
    changed();
  });
  element.addEventListener("pointerup", release);
  element.addEventListener("pointercancel", release);
  element.addEventListener("contextmenu", (event) => event.preventDefault());
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaY * [1, 16, 400][event.deltaMode];
    camera.zoom(Math.exp(clamp(pixels, -300, 300) * 0.0015));
    changed();
  }, { passive: false });
}
