// Light, ground with a grid to scale, lane lines beside a straight path, paths, blowout marks.

const THEMES = {
  light: {sky: 0xdfe9f2, ground: 0xb9bfc4, grid: 0x9aa2a9, line: 0xffffff, sun: 2.1, fill: 1.7},
  dark: {sky: 0x10161d, ground: 0x2a3138, grid: 0x3f4851, line: 0xaab4bd, sun: 1.7, fill: 1.25},
};

class World {
  constructor(scene, runs) {
    this.scene = scene;
    this.runs = runs;
    this.box = this._box();
    this.sky = new THREE.HemisphereLight(0xffffff, 0x707880, 1.5);
    this.sun = new THREE.DirectionalLight(0xffffff, 2);
    this.sun.position.set(-0.5, 0.8, 1.6);
    scene.add(this.sky, this.sun);
    scene.fog = new THREE.Fog(0xffffff, 90, 420);
    this._ground();
    this._grid();
    this._lanes();
    this.own = runs.map((run, k) => this._path(run, k));
  }

  _box() {
    const box = {x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity};
    for (const run of this.runs)
      for (const u of Object.values(run.motion.units))
        for (let i = 0; i < run.n; i += 5) {
          box.x0 = Math.min(box.x0, u.x[i]); box.x1 = Math.max(box.x1, u.x[i]);
          box.y0 = Math.min(box.y0, u.y[i]); box.y1 = Math.max(box.y1, u.y[i]);
        }
    return box;
  }

  _ground() {
    const {x0, x1, y0, y1} = this.box;
    const size = Math.max(x1 - x0, y1 - y0) + 900;
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(size, size),
      new THREE.MeshBasicMaterial({color: 0xffffff}));
    this.ground.position.set((x0 + x1) / 2, (y0 + y1) / 2, 0);
    this.scene.add(this.ground);
  }

  _grid() {
    const {x0, x1, y0, y1} = this.box, edge = 130;
    const longest = Math.max(x1 - x0, y1 - y0) + 2 * edge;
    this.step = [10, 20, 50, 100, 200, 500].find(s => longest / s < 90) || 1000;
    const s = this.step, a0 = Math.floor((x0 - edge) / s) * s, a1 = Math.ceil((x1 + edge) / s) * s;
    const b0 = Math.floor((y0 - edge) / s) * s, b1 = Math.ceil((y1 + edge) / s) * s, p = [];
    for (let x = a0; x <= a1; x += s) p.push(x, b0, 0.005, x, b1, 0.005);
    for (let y = b0; y <= b1; y += s) p.push(a0, y, 0.005, a1, y, 0.005);
    const g = new THREE.BufferGeometry();
    g.setAttribute('position', new THREE.BufferAttribute(new Float32Array(p), 3));
    this.grid = new THREE.LineSegments(g, new THREE.LineBasicMaterial({color: 0xffffff}));
    this.scene.add(this.grid);
  }

  // Dashes of 3 m every 12 m, 3.66 m apart, where the first run goes about straight.
  _lanes() {
    const run = this.runs[0], u = run.motion.units[Object.keys(run.motion.units)[0]];
    const yaw = u.yaw[0], c = Math.cos(yaw), s = Math.sin(yaw), last = run.n - 1;
    const along = (x, y) => (x - u.x[0]) * c + (y - u.y[0]) * s;
    const across = (x, y) => -(x - u.x[0]) * s + (y - u.y[0]) * c;
    let far = 0, widest = 0;
    for (let i = 0; i <= last; i += 5) {
      far = Math.max(far, along(u.x[i], u.y[i]));
      widest = Math.max(widest, Math.abs(across(u.x[i], u.y[i])));
    }
    this.straight = far > 60 && widest < 0.12 * far;
    if (!this.straight) return;
    const solid = new Solid();
    const strip = (a0, a1, b, w) => solid.face([[a0, b - w], [a1, b - w], [a1, b + w], [a0, b + w]]
      .map(([a, d]) => [u.x[0] + a * c - d * s, u.y[0] + a * s + d * c, 0.012]), 0xffffff);
    for (let lane = -3; lane <= 4; lane++) {
      const b = (lane - 0.5) * 3.66;
      if (lane === -3 || lane === 4) strip(-60, far + 60, b, 0.06);
      else for (let a = -60; a < far + 60; a += 12.2) strip(a, a + 3.05, b, 0.06);
    }
    this.lines = solid.mesh(new THREE.MeshBasicMaterial({color: 0xffffff}));
    this.scene.add(this.lines);
  }

  _path(run, number) {
    const group = new THREE.Group();
    Object.values(run.motion.units).forEach((u, k) => {
      group.add(ribbon(u, run.n, k ? 0.05 : 0.09, COLORS[number % COLORS.length], k ? 0.45 : 0.85,
        0.02 + 0.004 * number));
    });
    const [first] = Object.keys(run.motion.units);
    for (const event of run.blowouts) markRoad(group, pose(run, first, instant(run, event.t)), 'blowout', 0xd94f1e);
    if (run.rollover) {
      const at = instant(run, run.rollover.t);
      markRoad(group, pose(run, run.rollover.unit, at), 'rollover', 0x8b3fa8);
    }
    this.scene.add(group);
    return group;
  }

  theme(name) {
    const t = THEMES[name];
    this.scene.background = new THREE.Color(t.sky);
    this.scene.fog.color.setHex(t.sky);
    this.ground.material.color.setHex(t.ground);
    this.grid.material.color.setHex(t.grid);
    if (this.lines) this.lines.material.color.setHex(t.line);
    this.sun.intensity = t.sun; this.sky.intensity = t.fill;
  }
}

// A flat band along a unit's path.
function ribbon(u, n, half, color, opacity, z) {
  const every = Math.max(1, Math.floor(n / 1500)), p = [], index = [];
  let k = 0;
  for (let i = 0; i < n; i += every) {
    const a = Math.max(i - every, 0), b = Math.min(i + every, n - 1);
    let dx = u.x[b] - u.x[a], dy = u.y[b] - u.y[a];
    const size = Math.hypot(dx, dy);
    if (size < 1e-3) { dx = Math.cos(u.yaw[i]); dy = Math.sin(u.yaw[i]); } else { dx /= size; dy /= size; }
    p.push(u.x[i] - dy * half, u.y[i] + dx * half, z, u.x[i] + dy * half, u.y[i] - dx * half, z);
    if (k) index.push(2 * k - 2, 2 * k - 1, 2 * k, 2 * k, 2 * k - 1, 2 * k + 1);
    k++;
  }
  const g = new THREE.BufferGeometry();
  g.setAttribute('position', new THREE.BufferAttribute(new Float32Array(p), 3));
  g.setIndex(index);
  return new THREE.Mesh(g, new THREE.MeshBasicMaterial({color, transparent: true, opacity,
    depthWrite: false, side: THREE.DoubleSide, forceSinglePass: true}));
}

// A bar across the road where something happened, with its name beside it.
function markRoad(group, p, words, color) {
  const bar = new Solid(), c = Math.cos(p.yaw), s = Math.sin(p.yaw);
  bar.face([[-0.08, -4], [0.08, -4], [0.08, 4], [-0.08, 4]]
    .map(([a, b]) => [p.x + a * c - b * s, p.y + a * s + b * c, 0.03]), color);
  group.add(bar.mesh(new THREE.MeshBasicMaterial({color})));
  group.add(label(words, p.x - 4.7 * s, p.y + 4.7 * c, 0.5, color));
}

function label(text, x, y, height, color) {
  const canvas = document.createElement('canvas');
  canvas.width = 256; canvas.height = 64;
  const c = canvas.getContext('2d');
  c.font = '600 40px system-ui, sans-serif'; c.textAlign = 'center'; c.textBaseline = 'middle';
  c.lineWidth = 8; c.strokeStyle = 'rgba(255,255,255,.85)'; c.strokeText(text, 128, 32);
  c.fillStyle = '#' + color.toString(16).padStart(6, '0'); c.fillText(text, 128, 32);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map, transparent: true}));
  sprite.scale.set(4 * height * 1.6, height * 1.6, 1);
  sprite.position.set(x, y, height);
  return sprite;
}
