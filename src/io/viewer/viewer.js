// Puts the parts together: the clock, the controls, and one picture whenever something changed.

/** A run shorter or longer than this plays, at first, in FITTED_S seconds instead of at real speed. */
const REAL_TIME_S = [1, 60];
const FITTED_S = 10;
/** Up to so many particles in motion, their ways are drawn without being asked for: an orbit is its way. */
const FOLLOWED = 12;
/** Up to so many linked bodies in motion, likewise: what holds them shapes their ways. */
const FOLLOWED_LINKED = 3;
/** For how long a contact mark stays, in seconds of the viewer's time. */
const MARK_HOLD_S = 0.35;

const byId = (id) => document.getElementById(id);

class Viewer {
  constructor() {
    this.recording = loadRecording();
    this.theme = readTheme();
    this.stage = new Stage(this.recording);
    this.camera = new Camera();
    this.camera.setHome(this.stage.middle, this.stage.radius, this.stage.points);
    this.time = this.recording.start;
    this.playing = false;
    this.ready = false;
    this.show = { contacts: true, joints: true, paths: false, labels: false };
    this.chosenMark = null;
    this.renderer = this.makeRenderer(location.hash !== "#canvas2d");
    this.overlay = new Overlay(byId("overlay"), this.stage, this.recording);
    this.plot = new EnergyPlot(byId("energy"), byId("legend"), this.recording, (t) => (t === null ? this.changed() : this.setTime(t)));
    this.bodies = new BodyList(byId("bodies"), this.stage, this.recording, {
      theme: () => this.theme, select: (i) => this.select(i), changed: () => this.changed(),
    });
    const { cloud } = this.stage;
    this.groups = cloud && new GroupList(byId("bodies"), cloud, {
      theme: () => this.theme, select: (g) => this.selectParticle(g, -1), changed: () => this.changed(),
    });
    const moving = this.recording.particles.fixed.filter((fixed) => !fixed).length;
    const linked = this.recording.links.length > 0 ? this.recording.bodies.filter((body) => !body.fixed).length : 0;
    byId("show-paths").checked = (moving > 0 && moving <= FOLLOWED) || (linked > 0 && linked <= FOLLOWED_LINKED);
    this.events = new EventList(byId("events"), byId("kinds"), byId("n-events"), this.recording, (mark) => this.jumpTo(mark));
    this.writeHeader();
    this.connectTransport();
    this.connectView();
    this.changed();
  }

  /** WebGL2 if it works, otherwise the 2D canvas; a canvas keeps its first kind of context, so the fallback takes a new one. */
  makeRenderer(wantGl) {
    const fresh = byId("scene-canvas").cloneNode();
    byId("scene-canvas").replaceWith(fresh);
    if (wantGl) {
      try {
        const renderer = new WebGlRenderer(fresh, this.stage);
        fresh.addEventListener("webglcontextlost", () => {
          this.renderer = this.makeRenderer(false);
          this.writeHeader();
          this.changed();
        });
        return renderer;
      } catch (error) {
        console.info(`ga-physics viewer: ${error.message}; drawing on a 2D canvas`);
        return this.makeRenderer(false);
      }
    }
    return new Canvas2dRenderer(fresh, this.stage);
  }

  writeHeader() {
    const { recording } = this;
    byId("scene").textContent = recording.scene;
    byId("scene").title = recording.scene;
    const count = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;
    const { bodies, particles } = recording;
    const facts = [count(recording.frames.length, "frame")];
    if (particles.n > 0) facts.unshift(count(particles.n, "particle"));
    if (bodies.length > 0 || particles.n === 0) facts.unshift(count(bodies.length, "body").replace("bodys", "bodies"));
    if (recording.duration > 0) facts.push(`${show(recording.duration)} s`);
    if (this.renderer.name === "canvas2d") facts.push("2D fallback");
    byId("facts").textContent = facts.join(" · ");
    byId("joints-switch").hidden = recording.links.length === 0;
    byId("energy-panel").hidden = recording.energy.length === 0;
    byId("n-bodies").textContent = String(bodies.length + particles.n);
    byId("things").textContent = particles.n === 0 ? "Bodies" : bodies.length === 0 ? "Particles" : "Bodies and particles";
  }

  connectTransport() {
    const { recording } = this;
    const still = recording.duration <= 0;
    byId("play").disabled = byId("time").disabled = still;
    byId("play").addEventListener("click", () => this.toggle());
    byId("time").addEventListener("input", () => {
      this.setTime(recording.start + Number(byId("time").value) * recording.duration);
    });
    const speeds = [0.1, 0.25, 0.5, 1, 2, 4].map((s) => [s, `${s}×`]);
    const fitted = recording.duration / FITTED_S;
    if (fitted > 0) speeds.push([fitted, `whole run in ${FITTED_S} s`]);
    for (const [value, label] of speeds) byId("speed").append(new Option(label, String(value)));
    const realTime = recording.duration >= REAL_TIME_S[0] && recording.duration <= REAL_TIME_S[1];
    byId("speed").selectedIndex = realTime || still ? 3 : speeds.length - 1;
    byId("speed").addEventListener("change", () => this.changed());
    for (const [id, key] of [["show-contacts", "contacts"], ["show-joints", "joints"], ["show-paths", "paths"], ["show-labels", "labels"]]) {
      this.show[key] = byId(id).checked;
      byId(id).addEventListener("change", () => {
        this.show[key] = byId(id).checked;
        this.changed();
      });
    }
    document.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    // A focused control keeps its own keys; the slider gives its own up, since a frame is a better step.
    const slider = event.target === byId("time");
    if (!slider && event.target.closest?.("button, select, input")) return;
    const act = {
      " ": () => this.toggle(),
      ArrowRight: () => this.stepFrame(1),
      ArrowLeft: () => this.stepFrame(-1),
      Home: () => this.setTime(this.recording.start),
      End: () => this.setTime(this.recording.end),
      f: () => this.reframe(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }

  connectView() {
    const view = byId("view");
    attachGestures(byId("overlay"), this.camera, {
      viewNow: () => this.view,
      changed: () => this.changed(),
      picked: (x, y) => this.pick(x, y),
    });
    byId("reframe").addEventListener("click", () => this.reframe());
    new ResizeObserver(() => {
      this.resized = true;
      this.changed();
    }).observe(view);
    new ResizeObserver(() => {
      this.resized = true;
      this.changed();
    }).observe(byId("energy-panel"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.theme = readTheme();
      this.bodies.paint(this.theme);
      this.groups?.paint(this.theme);
      this.resized = true;
      this.changed();
    });
  }

  reframe() {
    this.camera.reset();
    this.changed();
  }

  pick(x, y) {
    const { view } = this;
    const particle = this.stage.cloud?.pick(view, x, y) ?? -1;
    if (particle >= 0) {
      this.selectParticle(this.stage.cloud.groupOf[particle], particle);
      return;
    }
    const ray = direction(add(view.forward, add(
      scale(view.right, (x - view.width / 2) / view.focal),
      scale(view.up, (view.height / 2 - y) / view.focal))));
    this.select(this.stage.pick(this.scene, view.eye, ray));
  }

  select(body) {
    this.stage.cloud?.select(-1, -1);
    this.groups?.select(-1);
    this.stage.selected = body;
    this.bodies.select(body);
    this.changed();
  }

  /** A particle, or all of a group. A group of one is its particle. */
  selectParticle(group, particle) {
    this.select(-1);
    const { cloud } = this.stage;
    const { begin, end } = cloud.particles.groups[group] ?? {};
    cloud.select(group, particle < 0 && end - begin === 1 ? begin : particle);
    this.groups.select(group);
  }

  toggle() {
    if (this.recording.duration <= 0) return;
    if (!this.playing && this.time >= this.recording.end) this.time = this.recording.start;
    this.playing = !this.playing;
    this.lastTick = null;
    this.changed();
  }

  setTime(time) {
    if (!Number.isFinite(time)) return;
    this.time = clamp(time, this.recording.start, this.recording.end);
    this.changed();
  }

  stepFrame(by) {
    this.playing = false;
    const { times } = this.recording;
    const at = lastNotAbove(times, this.time);
    // From between two frames, back goes to the one before.
    const from = by < 0 && times[at] < this.time ? at + 1 : at;
    this.setTime(times[clamp(from + by, 0, times.length - 1)]);
  }

  jumpTo(mark) {
    this.playing = false;
    this.chosenMark = mark;
    this.events.choose(mark);
    this.setTime(mark.time);
  }

  changed() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame((now) => {
      this.pending = false;
      try {
        this.tick(now);
      } catch (error) {
        fail(error);
      }
    });
  }

  tick(now) {
    if (this.playing) {
      // After a hidden tab the run goes on where it was, instead of leaping.
      const passed = this.lastTick == null ? 0 : Math.min((now - this.lastTick) / 1000, 0.25);
      this.lastTick = now;
      this.advance(passed * Number(byId("speed").value));
    }
    this.draw();
    if (!this.ready) {
      this.ready = true;
      document.title = `ready: ${this.recording.scene}`;
    }
    if (this.playing) this.changed();
  }

  advance(seconds) {
    this.time += seconds;
    if (this.time < this.recording.end) return;
    if (byId("loop").checked) {
      this.time = this.recording.start + ((this.time - this.recording.start) % this.recording.duration);
    } else {
      this.time = this.recording.end;
      this.playing = false;
    }
  }

  draw() {
    const box = byId("view");
    const [width, height] = [Math.max(box.clientWidth, 1), Math.max(box.clientHeight, 1)];
    const ratio = Math.min(devicePixelRatio || 1, 2); // finer than 2 costs much and shows little
    for (const canvas of [byId("scene-canvas"), byId("overlay")]) {
      const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
      if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    }
    this.view = this.camera.view(width, height);
    this.scene = this.stage.at(this.time, this.theme);
    this.renderer.draw(this.scene, this.view, ratio);
    const frameGap = this.recording.duration / Math.max(this.recording.frames.length - 1, 1);
    const hold = Math.max(1.5 * frameGap, MARK_HOLD_S * Number(byId("speed").value));
    this.overlay.draw(this.scene, this.view, ratio, {
      time: this.time, hold, lead: 0.5 * frameGap, show: this.show, chosenMark: this.chosenMark,
    });
    this.plot.draw(this.time, this.theme, ratio);
    if (this.resized !== false) {
      drawTicks(byId("ticks"), this.recording, this.theme, ratio);
      this.events.fill();
      this.resized = false;
    }
    this.writeControls();
  }

  writeControls() {
    const { recording } = this;
    const play = byId("play");
    if (play.dataset.playing !== String(this.playing)) {
      play.dataset.playing = String(this.playing);
      play.setAttribute("aria-label", this.playing ? "Pause" : "Play");
    }
    const fraction = recording.duration > 0 ? (this.time - recording.start) / recording.duration : 0;
    byId("time").value = String(fraction);
    byId("time").style.setProperty("--done", `${100 * fraction}%`);
    byId("clock").textContent = `${clockText(this.time, recording)} / ${clockText(recording.end, recording)} s`;
    this.writeReadout();
  }

  /** Where the selected body is, in world coordinates. */
  writeReadout() {
    const readout = byId("readout");
    const chosen = this.chosen();
    readout.hidden = !chosen;
    if (!chosen) return;
    const name = element("bdi", "name", chosen.name || "(no name)");
    // Digits down to a ten-thousandth of the scene: further ones would be noise of the drawing's f32.
    const decimals = clamp(4 - Math.ceil(Math.log10(this.stage.radius)), 0, 9);
    const number = (x) => x.toFixed(decimals).replace("-", "−");
    const [x, y, z] = (chosen.position ?? []).map((c, i) => number(c + this.recording.centre[i]));
    const place = chosen.position ? `x ${x}  y ${y}  z ${z} m` : "no finite position at this time";
    readout.replaceChildren(name, element("span", "", chosen.text ?? place));
  }

  /** Name and place of what is selected; null if nothing is. */
  chosen() {
    const { selected, cloud } = this.stage;
    if (selected >= 0) {
      const pose = poseAt(this.recording, selected, bracket(this.recording, this.time));
      return { name: this.recording.bodies[selected].name, position: pose?.position };
    }
    const { group, particle } = cloud?.selected ?? { group: -1 };
    if (group < 0) return null;
    const { names, groups } = cloud.particles;
    if (particle < 0) return { name: groups[group].name, text: `${groups[group].end - groups[group].begin} particles` };
    const position = cloud.position(particle);
    return { name: names[particle], position: allFinite(position) ? position : null };
  }
}

/** Seconds with as many decimals as the distance of the frames deserves, so that the text does not jump about. */
function clockText(time, { duration, frames }) {
  const gap = duration / Math.max(frames.length - 1, 1);
  return time.toFixed(gap > 0 ? clamp(Math.ceil(-Math.log10(gap)) + 1, 0, 9) : 2).replace("-", "−");
}

function fail(error) {
  const message = error instanceof Error ? error.message : String(error);
  document.title = `error: ${message}`;
  const notice = byId("notice");
  notice.hidden = false;
  notice.textContent = `This recording cannot be shown: ${message}`;
}

try {
  const viewer = new Viewer();
  window.gaViewer = {
    get ready() { return viewer.ready; },
    get renderer() { return viewer.renderer.name; },
    get playing() { return viewer.playing; },
    get frameCount() { return viewer.recording.frames.length; },
    time: () => viewer.time,
    setTime: (t) => viewer.setTime(t),
    /** Where a point of a body is at the present time, relative to the scene's centre: a test compares it with the rotor's. */
    worldPoint(body, point) {
      const pose = poseAt(viewer.recording, body, bracket(viewer.recording, viewer.time));
      return pose && add(pose.position, mapped(mapOf(pose.quaternion, pose.stretch), point));
    },
    /** Where an end of a joint or spring is at the present time, relative to the scene's centre. */
    linkEnd(link, end) {
      return viewer.stage.links(bracket(viewer.recording, viewer.time))[link]?.ends[end];
    },
    /** Where a particle is in the picture, in pixels from its top left. */
    particlePixel(particle) {
      const { x, y } = project(viewer.view, viewer.stage.cloud.position(particle));
      return [x, y];
    },
    /** Where a particle is at the present time, relative to the scene's centre. */
    particlePoint(particle) {
      viewer.stage.cloud.moveTo(bracket(viewer.recording, viewer.time));
      return viewer.stage.cloud.position(particle);
    },
  };
} catch (error) {
  fail(error);
}
