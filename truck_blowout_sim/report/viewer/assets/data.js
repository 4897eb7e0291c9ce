// Restores what report/viewer/packing.py packed, and reads a run at an instant.

async function unpackRun(run) {
  const packed = Uint8Array.from(atob(run.bytes), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  run.bytes = null;
  const series = entry => {
    const {at, n, low, step} = entry, out = new Float64Array(n);
    let speed = 0, value = 0;
    for (let i = 0; i < n; i++) {
      const code = bytes[at + i] + bytes[at + n + i] * 256 + bytes[at + 2 * n + i] * 65536
        + bytes[at + 3 * n + i] * 16777216;
      speed += code % 2 ? -(code + 1) / 2 : code / 2;
      value += speed;
      out[i] = value * step + low;
    }
    return out;
  };
  const walk = node => {
    if (Array.isArray(node)) return node.map(walk);
    if (node && typeof node === 'object') {
      if ('at' in node) return series(node);
      return Object.fromEntries(Object.entries(node).map(([key, value]) => [key, walk(value)]));
    }
    return node;
  };
  run.motion = walk(run.motion);
  run.times = walk(run.times);
  run.channels = run.channels.map(c => ({...c, v: series(c.v), t: run.times[c.time]}));
  run.byName = new Map(run.channels.map(c => [c.name, c]));
  return run;
}

// Position in the evenly spaced motion: index below, and the share of the way to the next.
function instant(run, t) {
  const at = (Math.min(Math.max(t, run.t0), run.t1) - run.t0) / (run.t1 - run.t0) * (run.n - 1);
  const i = Math.min(Math.floor(at), Math.max(run.n - 2, 0));
  return {i, w: run.n > 1 ? at - i : 0};
}

const between = (values, at) =>
  at.w ? values[at.i] * (1 - at.w) + values[at.i + 1] * at.w : values[at.i];

function pose(run, unit, at) {
  const u = run.motion.units[unit];
  return {x: between(u.x, at), y: between(u.y, at), z: between(u.z, at), yaw: between(u.yaw, at),
    roll: between(u.roll, at), pitch: between(u.pitch, at)};
}

// Value of a channel at a time by linear interpolation; NaN outside of what was recorded.
function valueAt(channel, t) {
  const {t: times, v} = channel;
  if (!times.length || t < times[0] - 1e-4 || t > times[times.length - 1] + 1e-4) return NaN;
  const i = lastBefore(times, t);
  if (i >= times.length - 1) return v[times.length - 1];
  const w = Math.max((t - times[i]) / (times[i + 1] - times[i]), 0);
  return v[i] * (1 - w) + v[i + 1] * w;
}

function lastBefore(times, t) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle; else high = middle - 1;
  }
  return low;
}
