// The recording: the data blocks of the page decoded, and the pose of a body at any time.

function bytesOfBase64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Little-endian numbers, whatever the machine: kind is "Float64", "Float32" or "Uint32". */
function decode(text, kind) {
  const view = new DataView(bytesOfBase64(text).buffer);
  const size = { Float64: 8, Float32: 4, Uint32: 4 }[kind];
  const list = new { Float64: Float64Array, Float32: Float32Array, Uint32: Uint32Array }[kind](view.byteLength / size);
  const get = view[`get${kind}`].bind(view);
  for (let i = 0; i < list.length; i++) list[i] = get(i * size, true);
  return list;
}

const block = (id, kind) => decode(document.getElementById(id).textContent, kind);

/** Rows of `width` numbers, made into objects by `make` and put in order of time; rows without a finite time go. */
function timed(list, width, make) {
  const rows = [];
  for (let i = 0; i + width <= list.length; i += width) rows.push(make(list.subarray(i, i + width), i / width));
  return rows.filter((row) => Number.isFinite(row.time)).sort((a, b) => a.time - b.time);
}

function loadRecording() {
  const index = JSON.parse(document.getElementById("ga-index").textContent);
  const named = block("ga-mark-names", "Uint32");
  const name = (k) => index.names[named[k]] ?? "?";
  const recording = {
    scene: index.scene,
    centre: index.centre,
    bodies: index.bodies,
    shapes: index.shapes,
    poses: block("ga-poses", "Float32"),
    links: index.links,
    // Of bodies whose orientation is a matrix: what is left of it beside the rotation, frame by frame.
    stretches: new Map(index.stretches.map(({ body, rows }) => [body, decode(rows, "Float32")])),
    particles: loadParticles(index.particles, block("ga-points", "Float32")),
    frames: timed(block("ga-times", "Float64"), 1, (row, frame) => ({ time: row[0], frame })),
    marks: timed(block("ga-marks", "Float64"), 8, (row, i) => ({
      time: row[0],
      point: sub([row[1], row[2], row[3]], index.centre),
      normal: direction([row[4], row[5], row[6]]),
      impulse: row[7],
      a: name(3 * i),
      b: name(3 * i + 1),
      kind: name(3 * i + 2),
    })),
    energy: timed(block("ga-energy", "Float64"), 4, (row) => ({
      time: row[0], kinetic: row[1], potential: row[2], total: row[3],
    })),
  };
  if (recording.frames.length === 0) throw new Error("the recording holds no frame with a finite time");
  recording.times = recording.frames.map((f) => f.time);
  recording.start = recording.times[0];
  recording.end = recording.times[recording.times.length - 1];
  recording.duration = recording.end - recording.start;
  return recording;
}

/** The pose as recorded, relative to the scene's centre; null where it is not finite. */
function recordedPose(recording, frame, body) {
  const at = 7 * (frame * recording.bodies.length + body);
  const p = recording.poses;
  const position = [p[at], p[at + 1], p[at + 2]];
  const quaternion = quaternionOfRotor(p[at + 3], p[at + 4], p[at + 5], p[at + 6]);
  if (!allFinite(position) || !quaternion) return null;
  const rows = recording.stretches.get(body)?.subarray(9 * frame, 9 * frame + 9);
  return { position, quaternion, stretch: rows?.length === 9 && rows.every(Number.isFinite) ? rows : null };
}

/** The two frames about a time and the fraction between them. */
function bracket(recording, time) {
  const { times, frames } = recording;
  const i = lastNotAbove(times, time);
  const j = Math.min(i + 1, times.length - 1);
  const gap = times[j] - times[i];
  return { from: frames[i].frame, to: frames[j].frame, f: gap > 0 ? clamp((time - times[i]) / gap, 0, 1) : 0 };
}

/** Between frames: positions and stretches linearly, attitudes by nlerp. A missing end is replaced by the other one. */
function poseAt(recording, body, { from, to, f }) {
  const a = recordedPose(recording, from, body);
  if (a && f === 0) return a;
  const b = recordedPose(recording, to, body);
  if (!a || !b) return a ?? b;
  return {
    position: a.position.map((x, i) => mix(x, b.position[i], f)),
    quaternion: nlerp(a.quaternion, b.quaternion, f),
    stretch: a.stretch && b.stretch ? a.stretch.map((x, i) => mix(x, b.stretch[i], f)) : a.stretch ?? b.stretch,
  };
}
