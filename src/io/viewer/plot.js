// The energy curve: kinetic, potential and total energy over time, with a cursor; click or drag moves the time.

const CURVES = [
  { key: "kinetic", label: "kinetic", width: 1.6 },
  { key: "potential", label: "potential", width: 1.6 },
  { key: "total", label: "total", width: 2.2 },
];

class EnergyPlot {
  constructor(canvas, legend, recording, seek) {
    this.canvas = canvas;
    this.recording = recording;
    this.samples = recording.energy;
    this.times = this.samples.map((s) => s.time);
    this.shown = { kinetic: true, potential: true, total: true };
    this.ground = document.createElement("canvas");
    this.values = {};
    for (const { key, label } of CURVES) {
      const button = document.createElement("button");
      button.type = "button";
      button.className = `curve ${key}`;
      button.setAttribute("aria-pressed", "true");
      button.title = `Show or hide the ${label} energy`;
      const value = document.createElement("span");
      value.className = "value";
      button.append(label, value);
      button.addEventListener("click", () => {
        this.shown[key] = !this.shown[key];
        button.setAttribute("aria-pressed", String(this.shown[key]));
        this.stale = true;
        seek(null);
      });
      legend.append(button);
      this.values[key] = value;
    }
    const toTime = (event) => {
      const { left, right } = this.frame;
      seek(mix(this.recording.start, this.recording.end, clamp((event.offsetX - left) / (right - left), 0, 1)));
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      toTime(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons & 1) toTime(event);
    });
    this.stale = true;
  }

  /** Lowest and highest shown value, widened to round ticks. */
  range() {
    let [low, high] = [Infinity, -Infinity];
    for (const s of this.samples) {
      for (const { key } of CURVES) {
        if (!this.shown[key] || !Number.isFinite(s[key])) continue;
        low = Math.min(low, s[key]);
        high = Math.max(high, s[key]);
      }
    }
    if (!(low <= high)) return null;
    // A constant curve gets a band about it; rounding noise of a constant must not fill the picture.
    const least = Math.max(Math.abs(low), Math.abs(high)) * 1e-12;
    if (high - low <= least) {
      const half = Math.abs(low) > 0 ? Math.abs(low) * 0.1 : 1;
      [low, high] = [low - half, high + half];
    }
    const step = roundStep((high - low) / 4);
    return { low: Math.floor(low / step) * step, high: Math.ceil(high / step) * step, step };
  }

  draw(time, theme, pixelRatio) {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (!(width > 0 && height > 0)) return;
    const [w, h] = [Math.round(width * pixelRatio), Math.round(height * pixelRatio)];
    if (this.stale || this.canvas.width !== w || this.canvas.height !== h || this.theme !== theme) {
      this.canvas.width = this.ground.width = w;
      this.canvas.height = this.ground.height = h;
      this.theme = theme;
      this.stale = false;
      this.drawGround(width, height, pixelRatio);
    }
    const c = this.canvas.getContext("2d");
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, w, h);
    c.drawImage(this.ground, 0, 0);
    c.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    this.drawCursor(c, time);
  }

  x(time) {
    const { left, right } = this.frame;
    const { start, duration } = this.recording;
    return duration > 0 ? left + ((time - start) / duration) * (right - left) : (left + right) / 2;
  }

  y(value) {
    const { top, bottom } = this.frame;
    return bottom - ((value - this.scale.low) / (this.scale.high - this.scale.low)) * (bottom - top);
  }

  drawGround(width, height, pixelRatio) {
    const c = this.ground.getContext("2d");
    const { theme } = this;
    c.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    c.clearRect(0, 0, width, height);
    c.font = "11px system-ui, sans-serif";
    this.scale = this.range();
    this.frame = { left: 74, right: width - 14, top: 10, bottom: height - 30 };
    const { left, right, top, bottom } = this.frame;
    if (!this.scale) {
      c.fillStyle = theme.muted;
      c.textAlign = "center";
      c.fillText("no finite energy to show", (left + right) / 2, (top + bottom) / 2);
      return;
    }
    this.drawAxes(c);
    c.save();
    c.beginPath();
    c.rect(left - 1, top - 3, right - left + 2, bottom - top + 6);
    c.clip();
    for (const { key, width: line } of CURVES) if (this.shown[key]) this.drawCurve(c, key, line);
    c.restore();
  }

  drawAxes(c) {
    const { theme, scale: { low, high, step }, frame: { left, right, top, bottom } } = this;
    const rule = (x0, y0, x1, y1) => {
      c.beginPath();
      c.moveTo(x0, y0);
      c.lineTo(x1, y1);
      c.stroke();
    };
    c.strokeStyle = theme.line;
    c.fillStyle = theme.muted;
    c.lineWidth = 1;
    c.textBaseline = "middle";
    c.textAlign = "right";
    const n = Math.round((high - low) / step);
    const every = Math.max(1, Math.ceil((n * 16) / (bottom - top)));
    for (let k = 0; k <= n; k += every) {
      const value = low + k * step;
      const y = Math.round(this.y(value)) + 0.5;
      rule(left, y, right, y);
      c.fillText(tick(value, step), left - 6, y);
    }
    c.textAlign = "center";
    const { start, end, duration } = this.recording;
    const gap = roundStep(duration / Math.max((right - left) / 90, 1));
    for (let k = Math.ceil(start / gap - 1e-9); duration > 0 && k * gap <= end + 1e-9 * gap; k++) {
      const x = Math.round(this.x(k * gap)) + 0.5;
      rule(x, bottom, x, bottom + 4);
      c.fillText(tick(k * gap, gap), x, bottom + 11);
    }
    c.fillText("time (s)", (left + right) / 2, bottom + 24);
    c.save();
    c.translate(10, (top + bottom) / 2);
    c.rotate(-Math.PI / 2);
    c.fillText("energy (J)", 0, 0);
    c.restore();
  }

  /** With many samples, the lowest and highest of each pixel column: a spike is never thinned away. */
  drawCurve(c, key, width) {
    c.strokeStyle = this.theme[key];
    c.lineWidth = width;
    c.lineJoin = "round";
    c.beginPath();
    let pen = false;
    let column = null;
    const flush = () => {
      if (!column) return;
      for (const y of column.first < column.last ? [column.high, column.low] : [column.low, column.high]) {
        pen ? c.lineTo(column.x, y) : c.moveTo(column.x, y);
        pen = true;
      }
      column = null;
    };
    const dense = this.samples.length > 2 * (this.frame.right - this.frame.left);
    for (const s of this.samples) {
      if (!Number.isFinite(s[key])) {
        flush();
        pen = false;
        continue;
      }
      const [x, y] = [this.x(s.time), this.y(s[key])];
      if (!dense) {
        pen ? c.lineTo(x, y) : c.moveTo(x, y);
        pen = true;
        continue;
      }
      if (column && Math.floor(x) !== Math.floor(column.x)) flush();
      column ??= { x, low: y, high: y, first: y, last: y };
      column.low = Math.max(column.low, y);
      column.high = Math.min(column.high, y);
      column.last = y;
    }
    flush();
    c.stroke();
    if (this.samples.length === 1) {
      const s = this.samples[0];
      c.fillStyle = this.theme[key];
      c.beginPath();
      c.arc(this.x(s.time), this.y(s[key]), 3, 0, 2 * Math.PI);
      c.fill();
    }
  }

  drawCursor(c, time) {
    const { theme, frame: { top, bottom } } = this;
    if (this.scale) {
      const x = this.x(time);
      c.strokeStyle = theme.accent;
      c.lineWidth = 1.5;
      c.beginPath();
      c.moveTo(x, top - 4);
      c.lineTo(x, bottom);
      c.stroke();
    }
    for (const { key } of CURVES) {
      const value = this.valueAt(key, time);
      this.values[key].textContent = value === null ? "" : `${show(value, 5)} J`;
      if (value === null || !this.scale || !this.shown[key]) continue;
      c.fillStyle = theme[key];
      c.beginPath();
      c.arc(this.x(time), this.y(value), 3, 0, 2 * Math.PI);
      c.fill();
    }
  }

  valueAt(key, time) {
    const { samples, times } = this;
    if (samples.length === 0 || time < times[0] || time > times[times.length - 1]) return null;
    const i = lastNotAbove(times, time);
    const [a, b] = [samples[i], samples[Math.min(i + 1, samples.length - 1)]];
    const gap = b.time - a.time;
    const value = gap > 0 && time > a.time ? mix(a[key], b[key], (time - a.time) / gap) : a[key];
    return Number.isFinite(value) ? value : null;
  }
}

/** A tick's label with as many decimals as the step between ticks needs. */
function tick(value, step) {
  if (Math.abs(value) < step * 1e-6) return "0";
  if (Math.abs(value) >= 1e6 || step < 1e-4) return show(value, 5);
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))).replace("-", "−");
}
