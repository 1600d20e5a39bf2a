// What lies over the picture, the same for both renderers: contact marks, paths, names, and the axes.

/** Marks and paths drawn at most: a pile has thousands of contacts, and nobody reads more. */
const MAX_MARKS = 400;
/** From so many marks in sight on, they are drawn small. */
const CROWD = 25;
const MAX_PATHS = 60;
const PATH_POINTS = 600;
/** An orbit is a curve of many turns: thinned too far it would cut its corners. */
const PARTICLE_PATH_POINTS = 3000;

/** The particles whose ways are drawn: those that move, or where they are too many, the one that is selected. */
function followed(cloud) {
  const { n, fixed } = cloud.particles;
  const moving = [];
  for (let i = 0; i < n && moving.length <= MAX_PATHS; i++) if (!fixed[i] && !cloud.hidden(i)) moving.push(i);
  if (moving.length <= MAX_PATHS) return moving;
  return cloud.selected.particle >= 0 ? [cloud.selected.particle] : [];
}

/** 1 at the mark's time, down to 0 at the end of its hold; a mark shows a little before its time, within one frame. */
function markStrength(mark, time, hold, lead) {
  const age = time - mark.time;
  if (age < -lead || age > hold) return 0;
  return age <= 0 ? 1 : 1 - age / hold;
}

class Overlay {
  constructor(canvas, stage, recording) {
    this.context = canvas.getContext("2d");
    this.stage = stage;
    this.recording = recording;
    this.largestImpulse = recording.marks.reduce((j, m) => (m.impulse > j && Number.isFinite(m.impulse) ? m.impulse : j), 0);
    this.paths = new Map();
  }

  draw(scene, view, pixelRatio, { time, hold, lead, show, chosenMark }) {
    const c = this.context;
    c.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    c.clearRect(0, 0, view.width, view.height);
    c.font = "12px system-ui, sans-serif";
    c.lineCap = "round";
    if (show.paths) this.drawPaths(scene, view, time);
    if (show.joints) for (const link of scene.links) drawLink(c, view, scene, link);
    if (show.contacts) this.drawMarks(scene, view, { time, hold, lead, chosenMark });
    this.drawNames(scene, view, show.labels);
    this.drawAxes(scene, view);
  }

  drawMarks(scene, view, { time, hold, lead, chosenMark }) {
    const { marks } = this.recording;
    const visible = [];
    for (let i = marks.length ? lastNotAbove(this.markTimes(), time + lead) : -1; i >= 0 && time - marks[i].time <= hold; i--) {
      const strength = markStrength(marks[i], time, hold, lead);
      if (strength > 0 && allFinite(marks[i].point)) visible.push({ mark: marks[i], strength });
      if (visible.length === MAX_MARKS) break;
    }
    const few = visible.length <= 4;
    const size = visible.length < CROWD ? 1 : 0.5;
    for (const { mark, strength } of visible.reverse()) {
      this.drawMark(scene, view, mark, { strength, size, labelled: mark === chosenMark || (few && strength > 0.5) });
    }
  }

  markTimes() {
    this.times ??= this.recording.marks.map((m) => m.time);
    return this.times;
  }

  drawMark({ theme }, view, mark, { strength, size, labelled }) {
    const c = this.context;
    const foot = project(view, mark.point);
    if (foot.depth < view.near) return;
    c.globalAlpha = 0.25 + 0.75 * strength;
    c.strokeStyle = c.fillStyle = theme.contact;
    c.lineWidth = 1.5;
    c.beginPath();
    c.arc(foot.x, foot.y, size * (4 + 10 * (1 - strength)), 0, 2 * Math.PI);
    c.stroke();
    c.beginPath();
    c.arc(foot.x, foot.y, 3 * size, 0, 2 * Math.PI);
    c.fill();
    if (mark.normal) {
      // Longer for a stronger impulse, by the square root so that weak ones still show.
      const share = this.largestImpulse > 0 && mark.impulse > 0 ? Math.sqrt(Math.min(mark.impulse / this.largestImpulse, 1)) : 0;
      const tip = project(view, add(mark.point, scale(mark.normal, this.stage.arrow * (0.4 + 0.6 * share))));
      if (tip.depth > view.near) this.arrow(foot, tip, size);
      if (labelled && Number.isFinite(mark.impulse)) this.text(`${show(mark.impulse, 3)} N s`, tip.x + 8, tip.y, theme);
    }
    c.globalAlpha = 1;
  }

  arrow(from, to, size) {
    const c = this.context;
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const n = Math.hypot(dx, dy);
    c.lineWidth = 2.5 * size;
    c.beginPath();
    c.moveTo(from.x, from.y);
    c.lineTo(to.x, to.y);
    c.stroke();
    if (n < 6) return; // end on: a head would point nowhere
    const [ux, uy] = [dx / n, dy / n];
    c.beginPath();
    const [tip, back, side] = [4 * size, 6 * size, 5 * size];
    c.moveTo(to.x + tip * ux, to.y + tip * uy);
    c.lineTo(to.x - back * ux - side * uy, to.y - back * uy + side * ux);
    c.lineTo(to.x - back * ux + side * uy, to.y - back * uy - side * ux);
    c.fill();
  }

  /** Text with a halo of the background, readable on any body. */
  text(text, x, y, theme, colour = theme.ink) {
    const c = this.context;
    c.textBaseline = "middle";
    c.lineJoin = "round";
    c.lineWidth = 4;
    c.strokeStyle = theme.dark ? "rgba(18,20,24,0.85)" : "rgba(255,255,255,0.85)";
    c.strokeText(text, x, y);
    c.fillStyle = colour;
    c.fillText(text, x, y);
  }

  drawNames(scene, view, all) {
    const chosen = scene.items.filter((item) => item.selected || (all && !this.recording.bodies[item.body].fixed));
    for (const item of chosen.slice(0, MAX_MARKS)) {
      const top = add(item.position, scale(view.up, this.stage.shapes[item.shape].radius));
      const p = project(view, top);
      if (p.depth < view.near) continue;
      const name = this.recording.bodies[item.body].name;
      const short = [...name].length > 28 ? `${[...name].slice(0, 27).join("")}…` : name;
      this.context.textAlign = "center";
      this.text(short, p.x, p.y - 10, scene.theme);
      this.context.textAlign = "start";
    }
    if (this.stage.cloud) this.drawParticleNames(this.stage.cloud, scene.theme, view, all);
  }

  drawParticleNames(cloud, theme, view, all) {
    const { n, names } = this.recording.particles;
    let room = MAX_MARKS;
    for (let i = 0; i < n && room > 0; i++) {
      const picked = cloud.selected.particle === i;
      if (!picked && (!all || cloud.hidden(i))) continue;
      const p = project(view, cloud.position(i));
      if (!(p.depth > view.near)) continue;
      this.text(names[i], p.x + 9, p.y - 9, theme);
      room--;
    }
  }

  /** The way of a centre of mass over the run, thinned; the part already gone is stronger. */
  drawPaths(scene, view, time) {
    const c = this.context;
    const moving = scene.items.filter((item) => !this.recording.bodies[item.body].fixed);
    const chosen = moving.length > MAX_PATHS ? moving.filter((item) => item.selected) : moving;
    for (const item of chosen) {
      for (const gone of [false, true]) {
        c.beginPath();
        let pen = false;
        for (const step of this.path(item.body)) {
          const p = step.position && (!gone || step.time <= time) ? project(view, step.position) : null;
          const drawn = p && p.depth > view.near;
          if (drawn) pen ? c.lineTo(p.x, p.y) : c.moveTo(p.x, p.y);
          pen = Boolean(drawn);
        }
        const now = project(view, item.position);
        if (gone && pen && now.depth > view.near) c.lineTo(now.x, now.y);
        // A body's way is of its colour: on the body itself only its border shows.
        c.lineJoin = "round";
        if (gone) {
          c.strokeStyle = scene.theme.dark ? "rgba(18,20,24,0.55)" : "rgba(255,255,255,0.65)";
          c.lineWidth = 4.5;
          c.stroke();
        }
        c.strokeStyle = css(item.rgb, gone ? 0.85 : 0.25);
        c.lineWidth = gone ? 2 : 1;
        c.stroke();
      }
    }
    if (this.stage.cloud) this.drawParticlePaths(this.stage.cloud, scene.theme, view, time);
  }

  drawParticlePaths(cloud, theme, view, time) {
    const c = this.context;
    for (const particle of followed(cloud)) {
      for (const gone of [false, true]) {
        c.strokeStyle = css(cloud.rgb(particle, theme), gone ? 0.7 : 0.22);
        c.lineWidth = gone ? 1.6 : 1;
        c.beginPath();
        let pen = false;
        for (const step of this.particlePath(particle)) {
          if (gone && step.time > time) break;
          const p = project(view, step.position);
          const drawn = p.depth > view.near;
          if (drawn) pen ? c.lineTo(p.x, p.y) : c.moveTo(p.x, p.y);
          pen = drawn;
        }
        const now = project(view, cloud.position(particle));
        if (gone && pen && now.depth > view.near) c.lineTo(now.x, now.y);
        c.stroke();
      }
    }
  }

  particlePath(particle) {
    this.particlePaths ??= new Map();
    if (!this.particlePaths.has(particle)) {
      const { frames, particles } = this.recording;
      const every = Math.max(1, Math.ceil(frames.length / PARTICLE_PATH_POINTS));
      const kept = frames.filter((_, i) => i % every === 0 || i === frames.length - 1);
      this.particlePaths.set(particle, kept.map(({ time, frame }) => {
        const position = [0, 0, 0];
        particleAt(particles, particle, { from: frame, to: frame, f: 0 }, position, 0);
        return { time, position };
      }));
    }
    return this.particlePaths.get(particle);
  }

  path(body) {
    if (!this.paths.has(body)) {
      const { frames } = this.recording;
      const every = Math.max(1, Math.ceil(frames.length / PATH_POINTS));
      const kept = frames.filter((_, i) => i % every === 0 || i === frames.length - 1);
      this.paths.set(body, kept.map(({ time, frame }) => ({ time, position: recordedPose(this.recording, frame, body)?.position })));
    }
    return this.paths.get(body);
  }

  drawAxes({ theme, stage }, view) {
    const c = this.context;
    const [x, y, size] = [46, view.height - 46, 28];
    const axes = [["x", "#e5484d"], ["y", "#2fa84f"], ["z", "#3d7eff"]].map(([label, colour], k) => {
      const along = [0, 1, 2].map((i) => (i === k ? 1 : 0));
      return { label, colour, dx: size * dot(along, view.right), dy: -size * dot(along, view.up), depth: dot(along, view.forward) };
    });
    for (const axis of axes.sort((a, b) => b.depth - a.depth)) {
      c.strokeStyle = axis.colour;
      c.lineWidth = 2;
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(x + axis.dx, y + axis.dy);
      c.stroke();
      c.textAlign = "center";
      this.text(axis.label, x + 1.35 * axis.dx, y + 1.35 * axis.dy, theme, axis.colour);
      c.textAlign = "start";
    }
    c.font = "11px system-ui, sans-serif";
    this.text(`grid ${show(stage.gridStep, 1)} m`, 90, view.height - 20, theme, theme.muted);
  }
}
