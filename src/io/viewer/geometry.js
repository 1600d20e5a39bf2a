// What is drawn of each shape: triangles with flat normals, and lines along its sharp edges.

/** Facets that meet at more than this are divided by a line: below it they are the facets of a rounded surface. */
const SHARP_ANGLE = (25 * Math.PI) / 180;
/** Subdivisions of the icosahedron for one body's share of a budget of facets: 20 * 4^levels of them. */
const sphereLevels = (share) => (share > 1280 ? 3 : share > 320 ? 2 : 1);

/** { corners: [[a, b, c]], normals: [n], sharp: [[ab, bc, ca]], lines: [[a, b]], points: [p], radius, closed } or { plane } or null. */
function buildShape(shape, facetShare) {
  if (shape.plane) return { plane: direction(shape.plane.map(Number)) ?? [0, 0, 1], radius: 0 };
  if (shape.revolution) return revolution(shape.revolution);
  if (shape.ellipsoid) return ellipsoid(shape.ellipsoid, sphereLevels(facetShare));
  const vertices = decode(shape.mesh.vertices, "Float32");
  const triangles = decode(shape.mesh.triangles, "Uint32");
  const vertex = (i) => [vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]];
  const corners = [];
  for (let i = 0; i + 3 <= triangles.length; i += 3) {
    const triangle = [0, 1, 2].map((k) => vertex(triangles[i + k]));
    if (triangle.every(allFinite)) corners.push(triangle); // an index out of range reads undefined, which is not finite
  }
  return withEdges(corners);
}

/** Facets round a surface of revolution, and lines down it that show how it turns: every twelfth. */
const AROUND = 48;
const MERIDIAN_EVERY = 12;

/** The surface that a profile [[distance from z, height]] from below to above makes about z. */
function revolution(profile) {
  const ring = profile.map(([r, z]) => Array.from({ length: AROUND }, (_, k) => {
    const angle = (2 * Math.PI * k) / AROUND;
    return r > 0 ? [r * Math.cos(angle), r * Math.sin(angle), z] : [0, 0, z];
  }));
  const triangles = [];
  const meridians = new Set();
  for (let i = 0; i + 1 < ring.length; i++) {
    for (let k = 0; k < AROUND; k++) {
      const next = (k + 1) % AROUND;
      triangles.push([ring[i][k], ring[i][next], ring[i + 1][next]], [ring[i][k], ring[i + 1][next], ring[i + 1][k]]);
      if (k % MERIDIAN_EVERY === 0) meridians.add(`${ring[i][k]} ${ring[i + 1][k]}`);
    }
  }
  return withEdges(triangles, ([a, b]) => meridians.has(`${a} ${b}`) || meridians.has(`${b} ${a}`));
}

/**
 * Drops triangles without area, and finds the edges that one face has alone, two faces share at a sharp angle, or that
 * are asked for.
 */
function withEdges(triangles, asked = () => false) {
  const normalOf = ([a, b, c]) => direction(cross(sub(b, a), sub(c, a)));
  const corners = triangles.filter((t) => normalOf(t));
  const normals = corners.map(normalOf);
  // Mesh files repeat a corner for each facet: corners with the same coordinates are the same corner.
  const ids = new Map();
  const id = (p) => {
    const key = p.join();
    if (!ids.has(key)) ids.set(key, ids.size);
    return ids.get(key);
  };
  const edges = new Map();
  const keys = corners.map((t, face) => {
    const v = t.map(id);
    return [0, 1, 2].map((k) => {
      const [a, b] = [v[k], v[(k + 1) % 3]];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      if (!edges.has(key)) edges.set(key, { ends: [t[k], t[(k + 1) % 3]], faces: [], from: [] });
      edges.get(key).faces.push(face);
      edges.get(key).from.push(a);
      return key;
    });
  });
  let closed = corners.length > 0;
  for (const edge of edges.values()) {
    const [f, g] = edge.faces;
    const paired = edge.faces.length === 2 && edge.from[0] !== edge.from[1];
    if (!paired) closed = false;
    edge.sharp = !paired || dot(normals[f], normals[g]) < Math.cos(SHARP_ANGLE) || asked(edge.ends);
  }
  const sharp = keys.map((list) => list.map((key) => edges.get(key).sharp));
  const lines = [...edges.values()].filter((edge) => edge.sharp).map((edge) => edge.ends);
  const points = [...new Map(corners.flat().map((p) => [id(p), p])).values()];
  const radius = points.reduce((r, p) => Math.max(r, length(p)), 0);
  return corners.length > 0 ? { corners, normals, sharp, lines, points, radius, closed } : null;
}

function ellipsoid(axes, levels) {
  if (!axes.every((a) => Number.isFinite(a) && a >= 0)) return null;
  const largest = Math.max(...axes);
  if (!(largest > 0)) return null;
  // A rod's inertia ellipsoid may be flat or a needle: it keeps a little breadth so that it has facets.
  const size = axes.map((a) => Math.max(a, 0.01 * largest));
  const stretch = (p) => p.map((x, i) => x * size[i]);
  const shape = withEdges(sphereTriangles(levels).map((t) => t.map(stretch)));
  // The three great circles along the axes show how a smooth body turns.
  shape.lines = [];
  shape.circles = true;
  shape.axes = size;
  const n = 12 * 2 ** Math.min(levels, 2);
  for (let axis = 0; axis < 3; axis++) {
    const at = (k) => {
      const p = [0, 0, 0];
      p[(axis + 1) % 3] = 1.002 * Math.cos((2 * Math.PI * k) / n);
      p[(axis + 2) % 3] = 1.002 * Math.sin((2 * Math.PI * k) / n);
      return stretch(p);
    };
    for (let k = 0; k < n; k++) shape.lines.push([at(k), at(k + 1)]);
  }
  shape.sharp = shape.sharp.map(() => [false, false, false]);
  return shape;
}

/** Icosahedron, each facet quartered `levels` times, on the unit sphere. */
function sphereTriangles(levels) {
  const g = (1 + Math.sqrt(5)) / 2;
  const v = [
    [-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g],
    [0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1],
  ].map(direction);
  const faces = [
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
    [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1],
  ];
  let list = faces.map((f) => f.map((i) => v[i]));
  for (let level = 0; level < levels; level++) {
    list = list.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [add(a, b), add(b, c), add(c, a)].map(direction);
      return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    });
  }
  return list;
}

/** The convex hull of points in a plane, anticlockwise (monotone chain: lower side, then upper). */
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length >= 2 && turn(chain[chain.length - 2], chain[chain.length - 1], p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** The same surface in pieces whose edges are at most `longest`: the painter's order goes wrong on long triangles. */
function subdivided(shape, longest, limit) {
  const out = { corners: [], normals: [], sharp: [] };
  const stack = shape.corners.map((t, i) => [t, shape.normals[i], shape.sharp[i]]);
  while (stack.length > 0) {
    const [t, normal, sharp] = stack.pop();
    const lengths = [0, 1, 2].map((k) => length(sub(t[k], t[(k + 1) % 3])));
    const k = lengths.indexOf(Math.max(...lengths));
    if (lengths[k] <= longest || out.corners.length + stack.length >= limit) {
      out.corners.push(t);
      out.normals.push(normal);
      out.sharp.push(sharp);
      continue;
    }
    const [a, b, c] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
    const [ab, bc, ca] = [sharp[k], sharp[(k + 1) % 3], sharp[(k + 2) % 3]];
    const m = scale(add(a, b), 0.5);
    stack.push([[a, m, c], normal, [ab, false, ca]], [[m, b, c], normal, [ab, bc, false]]);
  }
  return { ...shape, ...out };
}
