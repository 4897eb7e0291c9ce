// A whole truck: units to scale, hubs, tires, force arrows; placed by the motion of one run.

const COLORS = [0x1f5fa8, 0xd08a00, 0x00795a, 0x9a4f87];
const N_PER_M = {plane: 5000, up: 20000};

class Truck {
  constructor(run, number) {
    this.run = run;
    this.color = COLORS[number % COLORS.length];
    this.ghost = false;
    this.materials = [];
    this.group = new THREE.Group();
    const paint = (color, more = {}) => {
      // three.js draws see-through, two-sided faces twice unless told not to
      const m = new THREE.MeshLambertMaterial({color, side: THREE.DoubleSide, forceSinglePass: true,
        ...more});
      this.materials.push(m);
      return m;
    };
    this.units = {};
    for (const [name, unit] of Object.entries(run.vehicle.units)) {
      const s = new Solid();
      DRAW[unit.kind](s, unit, this.color);
      const body = new THREE.Group();
      body.add(s.mesh(paint(0xffffff, {vertexColors: true})));
      const shadow = this._shadow(unit);
      this.group.add(body, shadow);
      this.units[name] = {unit, body, shadow};
    }
    this.hubs = run.vehicle.hubs.map(hub => {
      const knuckle = new THREE.Group();
      const tires = hub.tires.map(spec => new Tire(spec, paint));
      tires.forEach(t => { t.group.position.y = t.spec.y; knuckle.add(t.group); });
      this.group.add(knuckle);
      return {hub, knuckle, tires, motion: run.motion.hubs[hub.name]};
    });
    this.pairs = this._pairs();
    this.axles = this._axleBeams(paint);
    this.arrows = new Arrows(run.vehicle.hubs.reduce((n, hub) => n + hub.tires.length, 0));
    this.group.add(this.arrows.group);
    this.anchor = new THREE.Vector3();
  }

  _shadow(unit) {
    const g = new THREE.PlaneGeometry(unit.front - unit.rear, 2 * unit.halfWidth);
    const m = new THREE.MeshBasicMaterial({color: 0, transparent: true, opacity: 0.28,
      depthWrite: false});
    const mesh = new THREE.Mesh(g, m);
    mesh.renderOrder = 1;
    return mesh;
  }

  // Left and right hub of each axle: numbers in this.hubs.
  _pairs() {
    const pairs = [];
    for (let i = 0; i + 1 < this.hubs.length; i += 2) pairs.push([i, i + 1]);
    return pairs;
  }

  _axleBeams(paint) {
    return this.pairs.map(() => {
      const s = new Solid();
      s.rod(0, -0.5, 0, 0, 0.5, 0, 0.055, 0x30353c, 8);
      const beam = s.mesh(paint(0xffffff, {vertexColors: true}));
      this.group.add(beam);
      return beam;
    });
  }

  setGhost(ghost) {
    this.ghost = ghost;
    for (const m of this.materials) {
      m.transparent = ghost; m.opacity = ghost ? 0.38 : 1; m.depthWrite = !ghost;
      m.needsUpdate = true;
    }
  }

  place(t, show) {
    const at = instant(this.run, t), poses = {};
    for (const [name, u] of Object.entries(this.units)) {
      const p = poses[name] = pose(this.run, name, at);
      u.body.position.set(p.x, p.y, p.z);
      u.body.rotation.set(p.roll, p.pitch, p.yaw, 'ZYX');
      const middle = (u.unit.front + u.unit.rear) / 2;
      u.shadow.position.set(p.x + middle * Math.cos(p.yaw), p.y + middle * Math.sin(p.yaw), 0.02);
      u.shadow.rotation.z = p.yaw;
    }
    this._wheels(poses, at, show);
    const first = poses[Object.keys(poses)[0]], last = poses[Object.keys(poses).pop()];
    this.anchor.set((2 * first.x + last.x) / 3, (2 * first.y + last.y) / 3,
      2.5 * Object.values(this.run.vehicle.units)[0].wheelRadius);
    this.heading = first.yaw;
    return poses;
  }

  _wheels(poses, at, show) {
    let slot = 0;
    for (const {hub, knuckle, tires, motion} of this.hubs) {
      const p = poses[hub.unit], c = Math.cos(p.yaw), s = Math.sin(p.yaw);
      // the body's tilt shifts the axle under it a little; wheels stand on the road
      const side = hub.y, x = hub.x * Math.cos(p.pitch);
      const height = between(motion.h, at), steer = between(motion.steer, at);
      knuckle.position.set(p.x + x * c - side * s, p.y + x * s + side * c, height);
      knuckle.rotation.set(0, 0, p.yaw + steer);
      const spin = between(motion.spin, at);
      for (const tire of tires) {
        const m = motion.tires[tire.spec.name];
        tire.shape(height, between(m.air, at));
        tire.wheel.rotation.y = spin;
        const force = show && m.f ? m.f.map(f => between(f, at)) : null;
        this._arrow(slot++, knuckle, tire, p.yaw + steer, force);
      }
    }
    this.arrows.done();
    this.pairs.forEach(([l, r], k) => {
      const a = this.hubs[l].knuckle.position, b = this.hubs[r].knuckle.position;
      const beam = this.axles[k];
      beam.position.copy(a).add(b).multiplyScalar(0.5);
      beam.scale.y = a.distanceTo(b);
      beam.quaternion.setFromUnitVectors(Y, a.clone().sub(b).normalize());
    });
  }

  _arrow(slot, knuckle, tire, heading, force) {
    if (!force) return this.arrows.hide(slot);
    const c = Math.cos(heading), s = Math.sin(heading), y = tire.spec.y;
    const x0 = knuckle.position.x - y * s, y0 = knuckle.position.y + y * c;
    const [fx, fy, fz] = force;
    this.arrows.set(slot, x0, y0, (fx * c - fy * s) / N_PER_M.plane,
      (fx * s + fy * c) / N_PER_M.plane, fz / N_PER_M.up);
  }
}

const Y = new THREE.Vector3(0, 1, 0);

// Two arrows a tire: along the road, and upward. Drawn over everything, so that none is hidden.
class Arrows {
  constructor(n) {
    this.group = new THREE.Group();
    this.n = n;
    this.sets = [0x0091d5, 0x52b788].map(color => {
      const material = new THREE.MeshBasicMaterial({color, transparent: true, opacity: 0.9,
        depthTest: false});
      const shaft = new THREE.InstancedMesh(
        new THREE.CylinderGeometry(0.032, 0.032, 1, 6).translate(0, 0.5, 0), material, n);
      const head = new THREE.InstancedMesh(
        new THREE.CylinderGeometry(0, 0.1, 0.24, 8).translate(0, 0.12, 0), material, n);
      for (const part of [shaft, head]) {
        part.frustumCulled = false; part.renderOrder = 20; this.group.add(part);
      }
      return {shaft, head};
    });
    this.matrix = new THREE.Matrix4();
    this.q = new THREE.Quaternion();
  }

  set(slot, x, y, ax, ay, up) {
    this._one(this.sets[0], slot, x, y, 0.06, new THREE.Vector3(ax, ay, 0));
    this._one(this.sets[1], slot, x, y, 0.06, new THREE.Vector3(0, 0, up));
  }

  _one(set, slot, x, y, z, v) {
    const length = v.length();
    if (length < 0.03) {
      set.shaft.setMatrixAt(slot, this.matrix.makeScale(0, 0, 0));
      set.head.setMatrixAt(slot, this.matrix);
      return;
    }
    const way = v.clone().divideScalar(length), from = new THREE.Vector3(x, y, z);
    this.q.setFromUnitVectors(Y, way);
    this.matrix.compose(from, this.q, new THREE.Vector3(1, length, 1));
    set.shaft.setMatrixAt(slot, this.matrix);
    const k = Math.min(1, 0.4 + length);
    this.matrix.compose(from.addScaledVector(way, length), this.q, new THREE.Vector3(k, k, k));
    set.head.setMatrixAt(slot, this.matrix);
  }

  hide(slot) {
    this.matrix.makeScale(0, 0, 0);
    for (const set of this.sets) {
      set.shaft.setMatrixAt(slot, this.matrix); set.head.setMatrixAt(slot, this.matrix);
    }
  }

  done() {
    for (const set of this.sets) {
      set.shaft.instanceMatrix.needsUpdate = true; set.head.instanceMatrix.needsUpdate = true;
    }
  }
}

// Outlines. z of a unit's frame is measured from base_link: the road is at unit.ground.
const DRAW = {
  tractor(s, u, color) {
    const g = u.ground, f = u.front, steer = u.axles[0], R = u.wheelRadius;
    const back = Math.max(u.hitch[0] + 1.65, f - 5.0), top = g + 2.95, w = 1.18;
    const hood = f - Math.min(1.75, 0.4 * (f - back)), cab = hood - 1.35;
    const dark = 0x2a2f36, glass = 0x17232e, chrome = 0xc9ced4;
    frame(s, u, f - 0.25, u.rear, g + 0.82);
    s.loft(hood, 0.9, g + 0.75, g + 1.95, f - 0.18, 0.62, g + 0.8, g + 1.62, color);
    s.box(f - 0.2, f - 0.12, -0.5, 0.5, g + 0.82, g + 1.5, chrome);
    s.box(f - 0.2, f, -w, w, g + 0.42, g + 0.78, chrome);
    for (const y of [-1, 1]) {
      s.box(f - 0.21, f - 0.05, y > 0 ? 0.72 : -1.1, y > 0 ? 1.1 : -0.72, g + 0.86, g + 1.06, 0xfff3cf);
      const inner = 0.66, outer = Math.max(w, u.halfWidth - 0.02);
      const lo = y > 0 ? inner : -outer, hi = y > 0 ? outer : -inner;
      s.box(steer - R - 0.12, f - 0.2, lo, hi, g + 2 * R + 0.1, g + 2 * R + 0.2, color);
      s.box(steer - R - 0.5, steer - R - 0.12, lo, hi, g + 0.55, g + 2 * R + 0.2, color);
      s.rod(cab - 0.05, y * 1.28, g + 0.95, cab - 0.05, y * 1.28, g + 3.35, 0.075, chrome);
      const end = Math.max(u.axles[1] + R + 0.35, back - 1.2);
      if (cab > end) s.rod(cab + 0.2, y * 0.98, g + 0.75, end, y * 0.98, g + 0.75, 0.3, chrome, 12);
      s.box(hood - 0.25, hood - 0.1, y > 0 ? w + 0.12 : -w - 0.3, y > 0 ? w + 0.3 : -w - 0.12,
        g + 1.75, g + 2.25, dark);
    }
    // cab, then sleeper; the windshield leans
    s.box(cab, hood, -w, w, g + 0.75, g + 1.95, color);
    s.hull([[hood, -w, g + 1.95], [hood, w, g + 1.95], [cab, w, g + 1.95], [cab, -w, g + 1.95]],
      [[hood - 0.42, -w + 0.06, top - 0.2], [hood - 0.42, w - 0.06, top - 0.2],
        [cab, w - 0.04, top], [cab, -w + 0.04, top]], color);
    s.face([[hood - 0.02, w - 0.1, g + 2.02], [hood - 0.02, -w + 0.1, g + 2.02],
      [hood - 0.36, -w + 0.2, top - 0.36], [hood - 0.36, w - 0.2, top - 0.36]]
      .map(p => [p[0] + 0.045, p[1], p[2]]), glass);
    for (const y of [-1, 1]) {
      const pane = [[hood - 0.28, g + 2.02], [hood - 0.46, top - 0.38], [cab + 0.28, top - 0.34],
        [cab + 0.28, g + 2.02]].map(([x, z]) => [x, y * (w + 0.008), z]);
      s.face(y > 0 ? pane : pane.reverse(), glass);
      s.face(([[hood - 0.15, g + 0.85], [hood - 0.15, g + 0.9], [cab + 0.2, g + 0.9],
        [cab + 0.2, g + 0.85]].map(([x, z]) => [x, y * (w + 0.006), z])), dark);
    }
    if (cab - back > 0.3) s.loft(back, w, g + 0.8, top + 0.22, cab, w, g + 0.8, top + 0.12, color);
    for (const y of [-0.8, -0.4, 0, 0.4, 0.8])
      s.box(hood - 0.62, hood - 0.5, y - 0.05, y + 0.05, top - 0.08, top - 0.01, 0xffa62b);
    s.box(u.hitch[0] - 0.5, u.hitch[0] + 0.5, -0.45, 0.45, u.hitch[1] - 0.14,
      u.hitch[1] - 0.02, 0x15181c);
    rear(s, u, g);
  },

  flatbed(s, u, color) {
    const g = u.ground, low = Math.min(...u.payload.map(b => b[1] - b[4] / 2),
      u.hitch ? u.hitch[1] + 0.22 : 0.4);
    const w = Math.max(u.halfWidth, 1.25), deck = 0xb08d57, steel = 0x4a515a;
    s.box(u.rear, u.front, -w + 0.06, w - 0.06, low - 0.07, low, deck);
    for (const y of [-1, 1]) {
      s.box(u.rear, u.front, y > 0 ? w - 0.06 : -w, y > 0 ? w : -w + 0.06, low - 0.16, low + 0.01, 0x8b949e);
      const neck = u.hitch ? u.hitch[0] - 1.8 : u.front - 2;
      s.box(u.rear + 0.1, neck, y * 0.5 - 0.06, y * 0.5 + 0.06, low - 0.55, low - 0.07, steel);
      s.box(neck, u.front - 0.1, y * 0.5 - 0.06, y * 0.5 + 0.06, low - 0.22, low - 0.07, steel);
      s.box(neck - 0.75, neck - 0.6, y * 0.75 - 0.08, y * 0.75 + 0.08, g + 0.35, low - 0.07, steel);
      s.box(u.rear - 0.02, u.rear + 0.03, y > 0 ? 0.55 : -0.95, y > 0 ? 0.95 : -0.55, low - 0.35, low - 0.2, 0xc1272d);
      s.box(u.rear + 0.02, u.rear + 0.1, y * 0.5 - 0.05, y * 0.5 + 0.05, g + 0.5, low - 0.5, steel);
      for (let x = u.front - 1.2; x > u.rear + 0.5; x -= 2.4)
        s.box(x - 0.06, x + 0.06, y * w - 0.01, y * w + 0.01, low - 0.13, low - 0.06, 0xffa62b);
    }
    s.box(u.rear + 0.02, u.rear + 0.1, -1.1, 1.1, g + 0.45, g + 0.58, 0xc1272d);
    s.box(u.front - 0.05, u.front, -w, w, low, low + 0.5, 0x9aa3ad);
    s.box(Math.min(...u.axles) - 0.7, Math.max(...u.axles) + 0.7, -0.45, 0.45, g + 0.62, low - 0.5, 0x363c44);
    blocks(s, u);
  },

  rigid(s, u, color) {
    const g = u.ground, f = u.front, back = f - 2.3, w = Math.max(u.halfWidth, 1.1);
    const low = Math.min(g + 1.15, ...u.payload.map(b => b[1] - b[4] / 2));
    frame(s, u, f - 0.2, u.rear, g + 0.8);
    s.box(back, f, -w, w, g + 0.5, g + 1.65, color);
    s.loft(back, w, g + 1.65, g + 2.75, f - 0.35, w - 0.05, g + 1.65, g + 2.65, color);
    s.face([[f - 0.33, w - 0.14, g + 1.72], [f - 0.33, -w + 0.14, g + 1.72],
      [f - 0.33, -w + 0.2, g + 2.5], [f - 0.33, w - 0.2, g + 2.5]], 0x17232e);
    for (const y of [-1, 1]) {
      const pane = [[f - 0.5, 1.72], [f - 0.5, 2.5], [back + 0.7, 2.5], [back + 0.7, 1.72]]
        .map(([x, z]) => [x, y * (w + 0.01), g + z]);
      s.face(y > 0 ? pane : pane.reverse(), 0x17232e);
    }
    s.box(f - 0.02, f + 0.03, -w + 0.1, w - 0.1, g + 0.6, g + 0.85, 0xc9ced4);
    s.box(u.rear, back - 0.2, -w, w, low - 0.12, low, 0xb08d57);
    blocks(s, u);
    rear(s, u, g);
  },

  car(s, u, color) {
    const g = u.ground, f = u.front, r = u.rear, w = u.halfWidth + 0.02, R = u.wheelRadius;
    const body = 0xb3202c, glass = 0x17232e, arch = R + 0.07, low = g + 0.18, deck = g + 2 * R + 0.14;
    const axles = [...u.axles].sort((a, b) => a - b), back = axles[0], fore = axles[axles.length - 1];
    // full width between the wheel arches, narrow beside the wheels, full again over them
    const gaps = axles.flatMap(x => [x - arch, x + arch]).filter(x => x > r && x < f);
    const ends = [r, ...gaps, f];
    s.box(r + 0.05, f - 0.05, -0.7 * w, 0.7 * w, low, deck - 0.03, body);
    for (let k = 0; k < ends.length; k += 2) {
      const nose = ends[k + 1] === f, tail = ends[k] === r;
      s.loft(ends[k], tail ? 0.93 * w : w, low, tail ? deck - 0.04 : deck,
        ends[k + 1], nose ? 0.9 * w : w, low, nose ? deck - 0.13 : deck, body);
    }
    for (const x of axles) s.box(x - arch, x + arch, -w, w, g + 2 * R + 0.02, deck, body);
    // the glass house stands between the axles and leans inwards
    const len = fore - back, a0 = back - 0.05 * len, a1 = fore - 0.22 * len, top = deck + 0.52;
    const foot = x => [[x, -0.86 * w, deck], [x, 0.86 * w, deck]];
    const b0 = back + 0.2 * len, b1 = fore - 0.46 * len;
    s.hull([...foot(a1), ...foot(a0).reverse()], [[b1, -0.66 * w, top], [b1, 0.66 * w, top],
      [b0, 0.66 * w, top], [b0, -0.66 * w, top]], glass);
    s.box(b0, b1, -0.66 * w, 0.66 * w, top, top + 0.03, body);
    for (const y of [-1, 1]) {
      const lo = y > 0 ? 0.5 * w : -0.85 * w, hi = y > 0 ? 0.85 * w : -0.5 * w;
      s.box(f - 0.04, f + 0.02, lo, hi, deck - 0.3, deck - 0.18, 0xfff3cf);
      s.box(r - 0.02, r + 0.04, lo, hi, deck - 0.28, deck - 0.14, 0x5e0f14);
    }
  },
};

function frame(s, u, front, back, top) {
  for (const y of [-0.43, 0.43])
    s.box(back, front, y - 0.04, y + 0.04, top - 0.26, top, 0x2f343b);
  for (let x = back + 0.1; x < front; x += 1.1) s.box(x, x + 0.1, -0.4, 0.4, top - 0.2, top - 0.06, 0x2f343b);
}

function rear(s, u, g) {
  const x = Math.min(...u.axles) - u.wheelRadius - 0.25;
  for (const y of [-1, 1]) {
    const lo = y > 0 ? 0.62 : -1.2, hi = y > 0 ? 1.2 : -0.62;
    s.box(x - 0.02, x, lo, hi, g + 0.15, g + 0.85, 0x15181c);
    s.box(u.rear - 0.02, u.rear + 0.02, y * 0.62 - 0.1, y * 0.62 + 0.1, g + 0.72, g + 0.85, 0xc1272d);
  }
}

function blocks(s, u) {
  for (const [x, z, l, w, h] of u.payload) {
    const n = Math.max(1, Math.round(l / 1.4));
    for (let k = 0; k < n; k++) {
      const x0 = x - l / 2 + k * l / n;
      s.box(x0 + 0.012, x0 + l / n - 0.012, -w / 2, w / 2, z - h / 2, z + h / 2, 0xa9aeb4);
      s.box(x0 + l / n / 2 - 0.04, x0 + l / n / 2 + 0.04, -w / 2 - 0.008, w / 2 + 0.008,
        z - h / 2, z + h / 2 + 0.008, 0xe2b007);
    }
  }
}
