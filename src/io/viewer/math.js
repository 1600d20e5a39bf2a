// Vectors are [x, y, z]; a quaternion is [w, x, y, z], of unit length, and turns v into q v q*.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const mix = (a, b, f) => a + (b - a) * f;
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
const allFinite = (list) => list.every(Number.isFinite);

/** Unit vector along a, or null where a has no direction. */
function direction(a) {
  const n = length(a);
  return Number.isFinite(n) && n > 0 ? scale(a, 1 / n) : null;
}

/** v turned by q: v + 2 w (u x v) + 2 u x (u x v), u = (x, y, z). */
function rotate([w, x, y, z], v) {
  const u = [x, y, z];
  const t = scale(cross(u, v), 2);
  return add(add(v, scale(t, w)), cross(u, t));
}

/** The columns of the linear map of a body: turned by q, after a stretch S (rows one after the other) if there is one. */
function mapOf(quaternion, stretch) {
  const before = (k) => [0, 1, 2].map((i) => (stretch ? stretch[3 * i + k] : i === k ? 1 : 0));
  return [0, 1, 2].map((k) => rotate(quaternion, before(k)));
}

/** v by a linear map. */
const mapped = ([a, b, c], [x, y, z]) => [0, 1, 2].map((i) => a[i] * x + b[i] * y + c[i] * z);

/** The map that takes normals along, up to their lengths. */
const cofactors = ([a, b, c]) => [cross(b, c), cross(c, a), cross(a, b)];

/** What a linear map makes v of (Cramer's rule). */
function unmapped(map, v) {
  const rows = cofactors(map);
  const det = dot(map[0], rows[0]);
  return rows.map((row) => dot(row, v) / det);
}

/** The quaternion of the rotor s + e23 + e31 + e12: w + xi + yj + zk is w - x e23 - y e31 - z e12. Null if not finite. */
function quaternionOfRotor(s, e23, e31, e12) {
  const n = Math.hypot(s, e23, e31, e12);
  return Number.isFinite(n) && n > 0 ? [s / n, -e23 / n, -e31 / n, -e12 / n] : null;
}

/** Normalised linear interpolation along the shorter way: q and -q are the same attitude. */
function nlerp(a, b, f) {
  const d = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const q = a.map((x, i) => mix(x, d < 0 ? -b[i] : b[i], f));
  const n = Math.hypot(...q);
  return n > 0 ? q.map((x) => x / n) : a;
}

/** Two unit vectors that complete n to a right-handed frame (u, v, n); u is horizontal where n allows it. */
function tangents(n) {
  const u = direction(cross(Math.abs(n[2]) > 0.999 ? [0, 1, 0] : [0, 0, 1], n));
  return [u, cross(n, u)];
}

/** The round length 1, 2 or 5 times a power of ten next above x. */
function roundStep(x) {
  if (!(x > 0) || !Number.isFinite(x)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  const digit = [1, 2, 5].find((d) => d * power >= x * (1 - 1e-9)); // 1e-9: 0.1 / 10**-1 is not exactly 1
  return (digit ?? 10) * power;
}

/** A number for people: about `digits` significant digits, a dash for what is not finite. */
function show(x, digits = 4) {
  if (!Number.isFinite(x)) return "–";
  const size = Math.abs(x);
  const text = size !== 0 && (size < 1e-3 || size >= 1e6)
    ? x.toExponential(Math.max(digits - 2, 0)).replace("e+", "e")
    : x.toFixed(clamp(digits - 1 - Math.floor(Math.log10(Math.max(size, 1e-3))), 0, digits));
  return text.replace(/-/g, "−");
}

/** Index of the last entry of a rising list that is not above x, at least 0. */
function lastNotAbove(list, x) {
  let low = 0;
  let high = list.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle] <= x) low = middle;
    else high = middle;
  }
  return low;
}
