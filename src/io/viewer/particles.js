// Particles: where they are at a time, what ties them together, and what of that is drawn how.
//
// Ten thousand of them have to play: positions live in one flat array that is filled anew for each picture, in which
// the points that particles are tied to, and those that attract, stand behind the particles as vertices of their own.

/** A particle's radius, by the distance to its neighbours, and without links by the size of the picture. */
const RADIUS_OF_LINK = 0.16;
const RADIUS_OF_STAGE = 0.02;
/** However light, a particle is to be seen beside the heaviest. */
const LEAST_SIZE = 0.4;
/** Segments of a circle, circles of a sphere. */
const CIRCLE = 96;
const MERIDIANS = 6;

const VERTEX = { particle: 0, fixed: 1, centre: 2 };

function loadParticles(index, positions) {
  const n = index.names.length;
  const fixed = new Uint8Array(n);
  for (const i of decode(index.fixed, "Uint32")) fixed[i] = 1;
  const pairs = (text) => {
    const list = decode(text, "Uint32");
    const out = [];
    for (let i = 0; i + 2 <= list.length; i += 2) out.push([list[i], list[i + 1]]);
    return out;
  };
  let begin = 0;
  const groups = index.groups.map(([name, count]) => ({ name, begin, end: (begin += count) }));
  return {
    n, fixed, groups, positions,
    names: index.names,
    sizes: decode(index.sizes, "Float32"),
    links: pairs(index.links),
    springs: pairs(index.springs),
    tethers: [...decode(index.tethered, "Uint32")].map((particle, k) => [particle, n + k]),
    anchors: index.anchors,
    centres: index.centres,
    guides: index.guides,
  };
}

/** Where a particle is between two frames, as for bodies; a missing end is replaced by the other one, or NaN. */
function particleAt({ n, positions }, particle, { from, to, f }, out, at) {
  const [a, b] = [3 * (from * n + particle), 3 * (to * n + particle)];
  for (let k = 0; k < 3; k++) {
    const [p, q] = [positions[a + k], positions[b + k]];
    out[at + k] = f === 0 || !Number.isFinite(q) ? p : Number.isFinite(p) ? mix(p, q, f) : q;
  }
}

/** The points of the world that count for the view and are not particles. */
function stillPoints({ anchors, centres, guides }) {
  const round = guides.flatMap(({ sphere, circle }) => {
    const it = sphere ?? circle;
    return it ? [0, 1, 2].flatMap((k) => [-1, 1].map((s) => it.centre.map((x, i) => (i === k ? x + s * it.radius : x)))) : [];
  });
  return [...anchors, ...centres, ...round].filter(allFinite);
}

class Cloud {
  constructor(particles, stage, colour) {
    this.particles = particles;
    const { n, anchors, centres, groups } = particles;
    this.vertices = new Float32Array(3 * (n + anchors.length + centres.length));
    this.vertices.set([...anchors, ...centres].flat(), 3 * n);
    this.groupOf = new Uint32Array(n);
    groups.forEach(({ begin, end }, g) => this.groupOf.fill(g, begin, end));
    const moves = ({ begin, end }) => particles.fixed.subarray(begin, end).includes(0);
    this.look = groups.map((group) => ({ hidden: false, rgb: moves(group) ? colour() : null }));
    this.radius = this.sizeOfParticles(stage);
    this.guides = particles.guides.flatMap((guide) => guideSegments(guide, stage));
    this.selected = { group: -1, particle: -1 };
    this.revision = 0; // grows when colours, sizes or what is hidden change
  }

  sizeOfParticles(stage) {
    const { links, tethers, positions, n } = this.particles;
    const at = (i) => (i < n ? positions : this.vertices).subarray(3 * i, 3 * i + 3);
    const lengths = [...links, ...tethers].map(([a, b]) => length(sub(at(a), at(b)))).filter((x) => x > 0).sort((a, b) => a - b);
    const middling = lengths[lengths.length >> 1];
    const whole = RADIUS_OF_STAGE * stage.radius;
    return middling ? clamp(RADIUS_OF_LINK * middling, 0.15 * whole, whole) : whole;
  }

  moveTo(between) {
    const { n } = this.particles;
    for (let i = 0; i < n; i++) particleAt(this.particles, i, between, this.vertices, 3 * i);
  }

  position(vertex) {
    return [...this.vertices.subarray(3 * vertex, 3 * vertex + 3)];
  }

  kind(vertex) {
    const { n, anchors, fixed } = this.particles;
    if (vertex >= n + anchors.length) return VERTEX.centre;
    return vertex >= n || fixed[vertex] ? VERTEX.fixed : VERTEX.particle;
  }

  hidden(vertex) {
    return vertex < this.particles.n && this.look[this.groupOf[vertex]].hidden;
  }

  size(vertex) {
    const { n, sizes } = this.particles;
    return this.kind(vertex) === VERTEX.particle && vertex < n ? mix(LEAST_SIZE, 1, sizes[vertex] ?? 1) : 1;
  }

  rgb(vertex, theme) {
    const own = vertex < this.particles.n && !this.particles.fixed[vertex] ? this.look[this.groupOf[vertex]].rgb : null;
    return own ?? theme.fixedRgb;
  }

  isSelected(vertex) {
    const { group, particle } = this.selected;
    if (vertex >= this.particles.n || group < 0) return false;
    return particle >= 0 ? vertex === particle : this.groupOf[vertex] === group;
  }

  select(group, particle) {
    this.selected = { group, particle };
    this.revision++;
  }

  /** Lines to draw: the pairs of vertices, their colour, and their breadth in pixels. */
  lines(theme) {
    const { links, springs, tethers } = this.particles;
    const shown = (pairs) => pairs.filter(([a, b]) => !this.hidden(a) && !this.hidden(b));
    const many = links.length + tethers.length > 300;
    const rope = theme.dark ? [0.72, 0.76, 0.82] : [0.3, 0.34, 0.4];
    return [
      { pairs: shown(links), rgb: rope, alpha: many ? 0.6 : 0.9, breadth: many ? 1.2 : 2 },
      { pairs: shown(tethers), rgb: rope, alpha: many ? 0.6 : 0.9, breadth: many ? 1.2 : 2 },
      { pairs: shown(springs), rgb: rgbaOfCss(theme.accent).slice(0, 3), alpha: 0.8, breadth: 1.5 },
    ].filter(({ pairs }) => pairs.length > 0);
  }

  /** The nearest particle under a pixel, within its disc or a finger's breadth of 8 px, or -1. */
  pick(view, x, y) {
    let best = { distance: Infinity, particle: -1 };
    for (let i = 0; i < this.particles.n; i++) {
      const p = project(view, this.position(i));
      if (!(p.depth > view.near) || this.hidden(i)) continue;
      const reach = Math.max((this.radius * this.size(i) * view.focal) / p.depth, 8);
      const distance = Math.hypot(p.x - x, p.y - y);
      if (distance < reach && distance < best.distance) best = { distance, particle: i };
    }
    return best.particle;
  }
}

/** The lines [from, to] that show a surface; a plane is a patch of its own. */
function guideSegments(guide, stage) {
  const closed = (points) => points.map((p, k) => [p, points[(k + 1) % points.length]]);
  const ring = (centre, u, v, count) => Array.from({ length: count }, (_, k) => {
    const angle = (2 * Math.PI * k) / count;
    return add(centre, add(scale(u, Math.cos(angle)), scale(v, Math.sin(angle))));
  });
  if (guide.circle) {
    const { centre, radius, normal } = guide.circle;
    const n = direction(normal);
    if (!n) return [];
    const [u, v] = tangents(n);
    return closed(ring(centre, scale(u, radius), scale(v, radius), CIRCLE));
  }
  if (guide.sphere) {
    const { centre, radius } = guide.sphere;
    const up = [0, 0, radius];
    const meridians = Array.from({ length: MERIDIANS }, (_, k) => {
      const angle = (Math.PI * k) / MERIDIANS;
      return closed(ring(centre, [radius * Math.cos(angle), radius * Math.sin(angle), 0], up, CIRCLE / 2));
    });
    const parallels = [-0.5, 0, 0.5].map((height) => {
      const r = radius * Math.sqrt(1 - height * height);
      return closed(ring(add(centre, scale(up, height)), [r, 0, 0], [0, r, 0], CIRCLE / 2));
    });
    return [...meridians, ...parallels].flat();
  }
  if (guide.line) {
    const d = direction(guide.line.direction);
    if (!d) return [];
    // The part near the motion, in pieces, so that it fades with none of them behind the eye.
    const foot = add(guide.line.point, scale(d, dot(sub(stage.middle, guide.line.point), d)));
    const reach = 2 * stage.radius;
    return Array.from({ length: 16 }, (_, k) => [k, k + 1].map((i) => add(foot, scale(d, reach * (i / 8 - 1)))));
  }
  return [];
}
