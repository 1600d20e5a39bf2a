// Joints and springs between bodies, over the picture: a joint inside of a body is to be seen.

/** Teeth of a spring, and how far they stand out, in pixels. */
const TEETH = 9;
const TOOTH = 5;
/** Radius of the dot at an end, in pixels. */
const DOT = 3.5;

function drawLink(c, view, scene, { kind, ends, fixed, axis }) {
  const { theme, stage } = scene;
  const [a, b] = ends.map((point) => project(view, point));
  if (!(a.depth > view.near && b.depth > view.near)) return;
  const stroke = (points, colour, width) => {
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.lineJoin = "round";
    c.beginPath();
    points.forEach((p, k) => (k === 0 ? c.moveTo(p.x, p.y) : c.lineTo(p.x, p.y)));
    c.stroke();
  };
  const halo = theme.dark ? "rgba(18,20,24,0.9)" : "rgba(255,255,255,0.9)";
  if (kind === "distance") stroke([a, b], theme.ink, 2);
  if (kind === "spring") stroke(zigzag(a, b), theme.accent, 1.6);
  if (kind === "hinge" && axis) {
    const half = scale(axis, 0.45 * stage.arrow);
    const tips = [add(ends[0], half), sub(ends[0], half)].map((point) => project(view, point));
    if (tips.every((tip) => tip.depth > view.near)) {
      stroke(tips, halo, 5);
      stroke(tips, theme.ink, 2.2);
    }
  }
  const dots = kind === "distance" || kind === "spring" ? [0, 1] : [fixed[1] ? 1 : 0];
  for (const k of dots) {
    const { x, y } = [a, b][k];
    c.beginPath();
    // What is fixed to the world is square, as fixed particles are.
    if (fixed[k]) c.rect(x - DOT, y - DOT, 2 * DOT, 2 * DOT);
    else c.arc(x, y, DOT, 0, 2 * Math.PI);
    c.fillStyle = theme.ink;
    c.strokeStyle = halo;
    c.lineWidth = 1.5;
    c.fill();
    c.stroke();
  }
}

/** A line with teeth between two points of the picture. */
function zigzag(a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const n = Math.hypot(dx, dy);
  if (n < 4 * TOOTH) return [a, b];
  const side = [(-dy / n) * TOOTH, (dx / n) * TOOTH];
  const at = (f, s) => ({ x: a.x + f * dx + s * side[0], y: a.y + f * dy + s * side[1] });
  const teeth = Array.from({ length: TEETH }, (_, k) => at(0.15 + (0.7 * (k + 0.5)) / TEETH, k % 2 ? -1 : 1));
  return [a, at(0.15, 0), ...teeth, at(0.85, 0), b];
}
