// A tire that stands on the road: the part below the road is pressed flat and bulges to the sides.

const SPOKES = 26;

class Tire {
  constructor(spec, paint) {
    this.spec = spec;
    this.paint = paint;
    const {radius: R, width: w, rim} = spec, h = w / 2;
    // radius and side of the outline, from the inner bead over the tread to the outer bead
    this.outline = [[rim, -0.42 * w], [0.5 * (R + rim), -h], [0.93 * R, -0.96 * h], [R, -0.74 * h],
      [R, 0], [R, 0.74 * h], [0.93 * R, 0.96 * h], [0.5 * (R + rim), h], [rim, 0.42 * w]];
    const n = this.outline.length;
    this.free = [];
    const normals = [], index = [];
    for (let k = 0; k <= SPOKES; k++) {
      const angle = 2 * Math.PI * k / SPOKES, c = Math.cos(angle), s = Math.sin(angle);
      this.outline.forEach(([r, y], j) => {
        this.free.push([r * c, y, r * s]);
        const [r0, y0] = this.outline[Math.max(j - 1, 0)];
        const [r1, y1] = this.outline[Math.min(j + 1, n - 1)];
        const out = y1 - y0, side = -(r1 - r0), size = Math.hypot(out, side) || 1;
        normals.push(out / size * c, side / size, out / size * s);
        if (k < SPOKES && j < n - 1) {
          const a = k * n + j, b = a + n;
          index.push(a, a + 1, b, b, a + 1, b + 1);
        }
      });
    }
    const g = new THREE.BufferGeometry();
    this.positions = new Float32Array(3 * this.free.length);
    g.setAttribute('position', new THREE.BufferAttribute(this.positions, 3));
    g.setAttribute('normal', new THREE.BufferAttribute(new Float32Array(normals), 3));
    g.setIndex(index);
    this.material = paint(0x2b2f36);
    this.rubber = new THREE.Mesh(g, this.material);
    this.wheel = this._wheel();
    this.group = new THREE.Group();
    this.group.add(this.rubber, this.wheel);
    for (const part of [this.rubber, this.wheel]) part.frustumCulled = false;
    this.height = NaN;
  }

  // Rim with hand holes and a painted mark on the side walls, so that spin is seen.
  _wheel() {
    const {radius: R, width: w, rim} = this.spec, s = new Solid();
    for (const side of [-1, 1]) {
      const y = side * 0.36 * w, ring = (r, yy, n = 20) => Array.from({length: n}, (_, k) => {
        const a = side * 2 * Math.PI * k / n;
        return [r * Math.cos(a), yy, -r * Math.sin(a)];
      });
      s.face(ring(rim, y), 0xb9c0c7);
      s.face(ring(0.42 * rim, y + side * 0.012), 0x878f98);
      for (let k = 0; k < 8; k++) {
        const a = 2 * Math.PI * k / 8, x = 0.7 * rim * Math.cos(a), z = 0.7 * rim * Math.sin(a);
        s.face(ring(0.13 * rim, y + side * 0.01, 6).map(p => [p[0] + x, p[1], p[2] + z]), 0x3a4047);
      }
      const m = 0.5 * (R + rim), yy = side * (0.5 * w + 0.004), d = 0.03 * R;
      const mark = [[m - 3 * d, yy, -d], [m + 3 * d, yy, -d], [m + 3 * d, yy, d], [m - 3 * d, yy, d]];
      s.face(side < 0 ? mark : mark.reverse(), 0xe8e4d8);
    }
    return s.mesh(this.paint(0xffffff, {vertexColors: true}));
  }

  // height: hub above the road; air: part of the pressure left; lean: of the axle, for the patch.
  shape(height, air) {
    if (Math.abs(height - this.height) > 4e-4 || this.height !== this.height) {
      const {radius: R, width: w} = this.spec, p = this.positions;
      this.free.forEach(([x, y, z], i) => {
        const deep = Math.max(-height - z, 0);
        const r = Math.hypot(x, z);
        // side walls over the patch give way: they bulge by up to the depth of the patch
        const over = Math.max(-z / r, 0) ** 6 * Math.max(R - height, 0);
        const bulge = 1 + (r < 0.96 * R ? 1.1 : 0.45) * (0.5 * over + 0.5 * deep) / (0.5 * w);
        p[3 * i] = x;
        p[3 * i + 1] = y * Math.min(bulge, 1.75);
        p[3 * i + 2] = deep > 0 ? -height : z;
      });
      this.rubber.geometry.attributes.position.needsUpdate = true;
      this.height = height;
    }
    this.material.color.setHex(0x2b2f36).lerp(Tire.blown, 0.85 * Math.min(1, (1 - air) * 1.1));
  }
}
Tire.blown = new THREE.Color(0xd94f1e);
