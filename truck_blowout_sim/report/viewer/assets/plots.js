// Plots of any channel over time, with one cursor for all of them.

const PALETTE = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9'];
const DASHES = [[], [6, 3], [2, 2], [8, 3, 2, 3]];

class Plots {
  constructor(root, runs, app) {
    Object.assign(this, {root, runs, app, panels: []});
    this.units = 'us'; this.axes = 'iso';
    this.window = null;
    const names = new Map();
    for (const run of runs) for (const c of run.channels) if (!names.has(c.name)) names.set(c.name, c);
    this.names = names;
    document.getElementById('names').innerHTML = [...names.values()]
      .map(c => `<option value="${escape_(c.name)}">${escape_(c.words)}</option>`).join('');
    this.row = document.createElement('div');
    this.row.className = 'adders';
    this.row.innerHTML = '<button id="more">+ plot</button>';
    root.append(this.row);
    this.row.querySelector('#more').onclick = () => this.add([]);
  }

  add(channels) {
    const box = document.createElement('section');
    box.className = 'plot';
    box.innerHTML = '<div class="head"><div class="chips"></div>'
      + '<input list="names" placeholder="add a channel" aria-label="add a channel">'
      + '<button class="close" title="remove this plot" aria-label="remove this plot">×</button></div>'
      + '<canvas></canvas>';
    const panel = {box, canvas: box.querySelector('canvas'), chips: box.querySelector('.chips'),
      channels: channels.filter(n => this.names.has(n)), still: document.createElement('canvas')};
    this.root.insertBefore(box, this.row);
    this.panels.push(panel);
    const input = box.querySelector('input');
    input.onchange = () => {
      const name = this.names.has(input.value) ? input.value : this.nearest(input.value);
      if (name && !panel.channels.includes(name)) panel.channels.push(name);
      input.value = '';
      this.draw(panel);
    };
    box.querySelector('.close').onclick = () => {
      this.panels = this.panels.filter(p => p !== panel);
      box.remove();
    };
    this._pointer(panel);
    this.draw(panel);
    return panel;
  }

  // The first channel that holds every word typed.
  nearest(text) {
    const words = text.toLowerCase().split(/[\s_]+/).filter(Boolean);
    return [...this.names.keys()].find(n => words.every(w => n.includes(w)));
  }

  _pointer(panel) {
    const seek = e => {
      const r = panel.canvas.getBoundingClientRect(), {x0, x1, t0, t1} = panel.scale;
      const px = (e.clientX - r.left);
      this.app.seek(t0 + (px - x0) / (x1 - x0) * (t1 - t0), true);
    };
    panel.canvas.onpointerdown = e => { panel.canvas.setPointerCapture(e.pointerId); seek(e); panel.held = true; };
    panel.canvas.onpointermove = e => { if (panel.held) seek(e); };
    panel.canvas.onpointerup = () => { panel.held = false; };
    panel.canvas.addEventListener('wheel', e => {
      e.preventDefault();
      const r = panel.canvas.getBoundingClientRect(), {x0, x1, t0, t1} = panel.scale;
      const t = t0 + (e.clientX - r.left - x0) / (x1 - x0) * (t1 - t0);
      const k = e.deltaY > 0 ? 1.25 : 0.8, {start, end} = this.app;
      const a = Math.max(start, t - (t - t0) * k), b = Math.min(end, t + (t1 - t) * k);
      this.window = b - a < 0.05 ? this.window : (b - a > 0.999 * (end - start) ? null : [a, b]);
      this.redraw();
    }, {passive: false});
    panel.canvas.ondblclick = () => { this.window = null; this.redraw(); };
  }

  redraw() { for (const p of this.panels) this.draw(p); }

  curves(panel) {
    const out = [];
    panel.channels.forEach((name, k) => this.runs.forEach((run, r) => {
      const c = run.byName.get(name);
      if (!c) return;
      const [symbol, per] = c[this.units];
      out.push({c, run, r, k, symbol, factor: per * (this.axes === 'sae' ? c.sae : 1),
        color: PALETTE[k % PALETTE.length], dash: DASHES[r % DASHES.length]});
    }));
    return out;
  }

  draw(panel) {
    const {canvas, still} = panel, ratio = devicePixelRatio || 1;
    const w = canvas.clientWidth || 400, h = canvas.clientHeight || 150;
    for (const c of [canvas, still]) { c.width = w * ratio; c.height = h * ratio; }
    const g = still.getContext('2d'), style = getComputedStyle(document.documentElement);
    const ink = style.getPropertyValue('--ink'), soft = style.getPropertyValue('--soft');
    const grid = style.getPropertyValue('--grid');
    g.scale(ratio, ratio);
    g.clearRect(0, 0, w, h);
    const [t0, t1] = this.window || [this.app.start, this.app.end];
    const curves = panel.curves = this.curves(panel);
    const [lo, hi] = extent(curves, t0, t1);
    const s = panel.scale = {x0: 52, x1: w - 10, y0: h - 20, y1: 8, t0, t1, lo, hi};
    const X = t => s.x0 + (t - t0) / (t1 - t0) * (s.x1 - s.x0);
    const Yp = v => s.y0 - (v - lo) / (hi - lo) * (s.y0 - s.y1);
    g.font = '11px system-ui, sans-serif'; g.lineWidth = 1;
    g.fillStyle = soft; g.strokeStyle = grid; g.textBaseline = 'middle'; g.textAlign = 'right';
    for (const v of ticks(lo, hi, 4)) { line(g, s.x0, Yp(v), s.x1, Yp(v)); g.fillText(plain(v), s.x0 - 6, Yp(v)); }
    g.textAlign = 'center'; g.textBaseline = 'top';
    for (const t of ticks(t0, t1, 8)) { line(g, X(t), s.y0, X(t), s.y1); g.fillText(plain(t), X(t), s.y0 + 4); }
    const units = [...new Set(curves.map(c => c.symbol))].join(', ');
    g.save(); g.translate(10, (s.y0 + s.y1) / 2); g.rotate(-Math.PI / 2); g.textBaseline = 'middle';
    g.fillText(units, 0, 0); g.restore();
    // blowouts stand at the edge of the plot, never over a curve
    g.fillStyle = '#d94f1e';
    for (const run of this.runs) for (const e of run.blowouts) {
      if (e.t < t0 || e.t > t1) continue;
      g.beginPath(); g.moveTo(X(e.t), s.y0); g.lineTo(X(e.t) - 5, s.y0 + 8); g.lineTo(X(e.t) + 5, s.y0 + 8); g.fill();
    }
    g.fillStyle = '#8b3fa8';
    for (const o of this.app.rollovers()) {
      if (o.t < t0 || o.t > t1 + 0.01) continue;
      const x = X(Math.min(o.t, t1));
      g.beginPath(); g.moveTo(x, s.y0); g.lineTo(x - 5, s.y0 + 8); g.lineTo(x + 5, s.y0 + 8); g.fill();
    }
    g.save(); g.beginPath(); g.rect(s.x0, s.y1 - 2, s.x1 - s.x0, s.y0 - s.y1 + 4); g.clip();
    for (const q of curves) trace(g, q, X, Yp, t0, t1, s.x1 - s.x0);
    g.restore();
    g.strokeStyle = ink;
    this.chips(panel);
    this.cursor(panel);
  }

  chips(panel) {
    panel.chips.innerHTML = '';
    panel.channels.forEach((name, k) => {
      const chip = document.createElement('span');
      chip.className = 'chip';
      chip.style.setProperty('--c', PALETTE[k % PALETTE.length]);
      chip.title = this.names.get(name).words + ': click to remove';
      chip.innerHTML = `<i></i>${escape_(short(name))} <b></b>`;
      chip.onclick = () => { panel.channels.splice(k, 1); this.draw(panel); };
      panel.chips.append(chip);
    });
  }

  cursor(panel) {
    const {canvas, still, scale: s} = panel, t = this.app.t, ratio = devicePixelRatio || 1;
    const g = canvas.getContext('2d');
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.clearRect(0, 0, canvas.width, canvas.height);
    g.drawImage(still, 0, 0);
    g.scale(ratio, ratio);
    if (t >= s.t0 && t <= s.t1) {
      const x = s.x0 + (t - s.t0) / (s.t1 - s.t0) * (s.x1 - s.x0);
      g.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue('--ink');
      g.lineWidth = 1;
      line(g, x, s.y1, x, s.y0);
      for (const q of panel.curves) {
        const v = valueAt(q.c, t) * q.factor;
        if (v !== v) continue;
        g.fillStyle = q.color;
        g.beginPath();
        g.arc(x, s.y0 - (v - s.lo) / (s.hi - s.lo) * (s.y0 - s.y1), 3, 0, 7);
        g.fill();
      }
    }
    panel.chips.querySelectorAll('b').forEach((b, k) => {
      b.textContent = panel.curves.filter(q => q.k === k)
        .map(q => `${steady(valueAt(q.c, t) * q.factor, s)} ${q.symbol}`).join(' | ');
    });
  }

  cursors() { for (const p of this.panels) this.cursor(p); }
}

function extent(curves, t0, t1) {
  let lo = Infinity, hi = -Infinity;
  for (const {c, factor} of curves)
    for (let i = 0; i < c.t.length; i++) {
      if (c.t[i] < t0 || c.t[i] > t1) continue;
      const v = c.v[i] * factor;
      if (v < lo) lo = v;
      if (v > hi) hi = v;
    }
  if (!(lo <= hi)) return [0, 1];
  const edge = Math.max((hi - lo) * 0.06, Math.max(Math.abs(lo), Math.abs(hi)) * 1e-4, 1e-9);
  return [lo - edge, hi + edge];
}

// A curve, by lowest and highest value of each pixel where samples are denser than pixels.
function trace(g, q, X, Yp, t0, t1, width) {
  const {c: {t, v}, factor} = q;
  let i = Math.max(lastBefore(t, t0), 0);
  const end = Math.min(lastBefore(t, t1) + 2, t.length);
  g.strokeStyle = q.color; g.lineWidth = 1.6; g.setLineDash(q.dash);
  g.globalAlpha = q.r ? 0.9 : 1;
  g.beginPath();
  if (end - i < 6 * width) {
    for (; i < end; i++) g.lineTo(X(t[i]), Yp(v[i] * factor));
  } else {
    while (i < end) {
      const column = Math.floor(X(t[i]));
      let lo = Infinity, hi = -Infinity;
      for (; i < end && Math.floor(X(t[i])) === column; i++) { lo = Math.min(lo, v[i]); hi = Math.max(hi, v[i]); }
      g.lineTo(column, Yp(lo * factor)); g.lineTo(column, Yp(hi * factor));
    }
  }
  g.stroke();
  g.setLineDash([]); g.globalAlpha = 1;
}

function line(g, x0, y0, x1, y1) { g.beginPath(); g.moveTo(x0, y0); g.lineTo(x1, y1); g.stroke(); }

function ticks(lo, hi, n) {
  const raw = (hi - lo) / n, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find(k => k * power >= raw) * power, out = [];
  for (let v = Math.ceil(lo / step) * step; v <= hi + 1e-9 * step; v += step) out.push(Math.abs(v) < 1e-9 * step ? 0 : v);
  return out;
}

function plain(v) {
  if (v !== v) return '–';
  const a = Math.abs(v);
  return a !== 0 && (a < 1e-3 || a >= 1e6) ? v.toExponential(1)
    : (+v.toFixed(a >= 100 ? 1 : a >= 1 ? 2 : 3)).toString();
}

// As many decimals as the plot's range deserves, so that the words keep their width while time runs.
function steady(v, {lo, hi}) {
  if (v !== v) return '–';
  const digits = Math.min(Math.max(2 - Math.floor(Math.log10(hi - lo)), 0), 6);
  return (+v.toFixed(digits) + 0).toFixed(digits);
}

const short = name => name.replace(/_(radps|rad|mps2|mps|pa|nm|n|m|s)$/, '').replaceAll('_', ' ');
const escape_ = text => text.replace(/[&<>"]/g, c => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'}[c]));
