// The lists beside the picture: bodies, and events. Whatever a name holds, it is set as text.

const ROW_HEIGHT = 30;

function element(tag, className, text) {
  const node = document.createElement(tag);
  if (className) node.className = className;
  if (text !== undefined) node.textContent = text;
  return node;
}

/** One row a body: the swatch hides and shows it, the name selects it. */
class BodyList {
  constructor(list, stage, recording, { theme, select, changed }) {
    this.stage = stage;
    this.rows = recording.bodies.map((body, i) => {
      const row = element("li");
      const swatch = element("button", "swatch");
      swatch.type = "button";
      swatch.setAttribute("aria-pressed", "true");
      swatch.setAttribute("aria-label", `Show ${body.name}`);
      swatch.title = "Show or hide";
      swatch.addEventListener("click", () => {
        const look = stage.look[i];
        look.hidden = !look.hidden;
        swatch.setAttribute("aria-pressed", String(!look.hidden));
        row.classList.toggle("off", look.hidden);
        changed();
      });
      const name = element("button", "name", body.name || "(no name)");
      name.type = "button";
      name.title = body.name;
      name.addEventListener("click", () => select(stage.selected === i ? -1 : i));
      row.append(swatch, name);
      if (body.fixed) row.append(element("span", "tag", "fixed"));
      list.append(row);
      return { row, swatch, name };
    });
    this.paint(theme());
  }

  paint(theme) {
    this.rows.forEach(({ swatch }, i) => swatch.style.setProperty("--swatch", css(this.stage.rgb(i, theme))));
  }

  select(body) {
    this.rows.forEach(({ row, name }, i) => {
      row.classList.toggle("selected", i === body);
      name.setAttribute("aria-current", String(i === body));
    });
    this.rows[body]?.row.scrollIntoView({ block: "nearest" });
  }
}

/** One row a particle, chain or net: the swatch hides and shows it, the name selects it. */
class GroupList {
  constructor(list, cloud, { theme, select, changed }) {
    this.cloud = cloud;
    const { groups, fixed } = cloud.particles;
    this.rows = groups.map((group, g) => {
      const row = element("li");
      const swatch = element("button", "swatch");
      swatch.type = "button";
      swatch.setAttribute("aria-pressed", "true");
      swatch.setAttribute("aria-label", `Show ${group.name}`);
      swatch.title = "Show or hide";
      swatch.addEventListener("click", () => {
        const look = cloud.look[g];
        look.hidden = !look.hidden;
        cloud.revision++;
        swatch.setAttribute("aria-pressed", String(!look.hidden));
        row.classList.toggle("off", look.hidden);
        changed();
      });
      const name = element("button", "name", group.name || "(no name)");
      name.type = "button";
      name.title = group.name;
      name.addEventListener("click", () => select(cloud.selected.group === g ? -1 : g));
      row.append(swatch, name);
      const count = group.end - group.begin;
      if (count > 1) row.append(element("span", "tag", `${count} particles`));
      else if (fixed[group.begin]) row.append(element("span", "tag", "fixed"));
      list.append(row);
      return { row, swatch, name };
    });
    this.paint(theme());
  }

  paint(theme) {
    this.rows.forEach(({ swatch }, g) => swatch.style.setProperty("--swatch", css(this.cloud.look[g].rgb ?? theme.fixedRgb)));
  }

  select(group) {
    this.rows.forEach(({ row, name }, g) => {
      row.classList.toggle("selected", g === group);
      name.setAttribute("aria-current", String(g === group));
    });
    this.rows[group]?.row.scrollIntoView({ block: "nearest" });
  }
}

/** Events by time; only the rows in sight exist, so that a hundred thousand contacts scroll like ten. */
class EventList {
  constructor(box, kinds, count, recording, jump) {
    this.box = box;
    this.all = recording.marks;
    this.shown = this.all;
    this.count = count;
    this.jump = jump;
    this.track = element("div", "track");
    box.append(this.track);
    const names = [...new Set(this.all.map((m) => m.kind))].sort();
    if (names.length > 1) {
      kinds.hidden = false;
      for (const name of ["all", ...names]) {
        const option = element("option", "", name === "all" ? "all kinds" : name);
        option.value = name === "all" ? "" : name;
        kinds.append(option);
      }
      kinds.addEventListener("change", () => {
        this.shown = kinds.selectedIndex > 0 ? this.all.filter((m) => m.kind === names[kinds.selectedIndex - 1]) : this.all;
        this.refresh();
      });
    }
    box.addEventListener("scroll", () => this.fill());
    box.addEventListener("keydown", (event) => {
      const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!by || this.shown.length === 0) return;
      event.preventDefault();
      event.stopPropagation();
      this.step(by);
    });
    this.refresh();
  }

  refresh() {
    this.count.textContent = this.all.length === this.shown.length ? String(this.all.length) : `${this.shown.length} of ${this.all.length}`;
    this.track.style.height = `${Math.max(this.shown.length, 1) * ROW_HEIGHT}px`;
    this.box.scrollTop = 0;
    this.fill();
  }

  step(by) {
    const at = this.shown.indexOf(this.chosen);
    this.jump(this.shown[clamp(at < 0 ? (by > 0 ? 0 : this.shown.length - 1) : at + by, 0, this.shown.length - 1)]);
  }

  fill() {
    const first = Math.max(0, Math.floor(this.box.scrollTop / ROW_HEIGHT) - 4);
    const last = Math.min(this.shown.length, first + Math.ceil((this.box.clientHeight || 400) / ROW_HEIGHT) + 8);
    const rows = [];
    for (let i = first; i < last; i++) rows.push(this.row(this.shown[i], i));
    if (this.shown.length === 0) rows.push(element("p", "empty", "No events were recorded."));
    this.track.replaceChildren(...rows);
  }

  row(mark, i) {
    const row = element("button", "event");
    row.type = "button";
    row.tabIndex = -1;
    row.style.top = `${i * ROW_HEIGHT}px`;
    row.classList.toggle("selected", mark === this.chosen);
    const pair = element("span", "pair");
    pair.append(element("bdi", "", mark.a), " → ", element("bdi", "", mark.b));
    row.append(element("span", "when", `${show(mark.time)} s`), pair,
      element("span", "much", Number.isFinite(mark.impulse) ? `${show(mark.impulse, 3)} N s` : ""));
    row.title = `${mark.kind}: ${mark.a} → ${mark.b}`;
    row.addEventListener("click", () => this.jump(mark));
    return row;
  }

  /** Marks a row and brings it into sight. */
  choose(mark) {
    this.chosen = mark;
    const at = this.shown.indexOf(mark);
    if (at >= 0) {
      const top = at * ROW_HEIGHT;
      const { scrollTop, clientHeight } = this.box;
      if (top < scrollTop) this.box.scrollTop = top;
      else if (top + ROW_HEIGHT > scrollTop + clientHeight) this.box.scrollTop = top + ROW_HEIGHT - clientHeight;
    }
    this.fill();
  }
}

/** The ticks of the events along the time slider; many in one pixel are one darker tick. */
function drawTicks(canvas, recording, theme, pixelRatio) {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * pixelRatio);
  canvas.height = Math.round(height * pixelRatio);
  const c = canvas.getContext("2d");
  c.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
  const columns = new Map();
  for (const mark of recording.marks) {
    const f = recording.duration > 0 ? (mark.time - recording.start) / recording.duration : 0.5;
    if (f < 0 || f > 1) continue;
    const x = Math.round(f * (width - 2)) + 1;
    columns.set(x, (columns.get(x) ?? 0) + 1);
  }
  c.fillStyle = theme.contact;
  for (const [x, n] of columns) {
    c.globalAlpha = Math.min(1, 0.55 + 0.1 * n);
    c.fillRect(x - 0.75, 0, 1.5, height);
  }
}
