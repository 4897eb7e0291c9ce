// Bodies out of flat faces, one geometry with a color at each corner.

class Solid {
  constructor() { this.position = []; this.color = []; this.normal = []; }

  face(corners, color) {
    const [a, b, c] = corners.map(p => new THREE.Vector3(...p));
    const n = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    const shade = new THREE.Color(color);
    for (let i = 1; i < corners.length - 1; i++)
      for (const p of [corners[0], corners[i], corners[i + 1]]) {
        this.position.push(...p); this.normal.push(n.x, n.y, n.z);
        this.color.push(shade.r, shade.g, shade.b);
      }
  }

  // A hull between two outlines of equally many points, the second above or ahead of the first.
  hull(low, high, color) {
    const n = low.length;
    this.face([...low].reverse(), color);
    this.face(high, color);
    for (let i = 0; i < n; i++) {
      const j = (i + 1) % n;
      this.face([low[i], low[j], high[j], high[i]], color);
    }
  }

  box(x0, x1, y0, y1, z0, z1, color) {
    const ring = z => [[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]];
    this.hull(ring(z0), ring(z1), color);
  }

  // From one x to another, with half widths, bottoms and tops at each end.
  loft(x0, w0, b0, t0, x1, w1, b1, t1, color) {
    const ring = (x, w, b, t) => [[x, -w, b], [x, w, b], [x, w, t], [x, -w, t]];
    this.hull(ring(x0, w0, b0, t0), ring(x1, w1, b1, t1), color);
  }

  rod(x0, y0, z0, x1, y1, z1, radius, color, sides = 10) {
    const axis = new THREE.Vector3(x1 - x0, y1 - y0, z1 - z0).normalize();
    const side = Math.abs(axis.z) < 0.9 ? new THREE.Vector3(0, 0, 1) : new THREE.Vector3(1, 0, 0);
    const u = side.cross(axis).normalize(), v = axis.clone().cross(u);
    const ring = (x, y, z) => Array.from({length: sides}, (_, k) => {
      const c = radius * Math.cos(2 * Math.PI * k / sides);
      const s = radius * Math.sin(2 * Math.PI * k / sides);
      return [x + c * u.x + s * v.x, y + c * u.y + s * v.y, z + c * u.z + s * v.z];
    });
    this.hull(ring(x0, y0, z0), ring(x1, y1, z1), color);
  }

  geometry() {
    const g = new THREE.BufferGeometry();
    for (const name of ['position', 'normal', 'color'])
      g.setAttribute(name, new THREE.BufferAttribute(new Float32Array(this[name]), 3));
    return g;
  }

  mesh(material) {
    const mesh = new THREE.Mesh(this.geometry(), material);
    mesh.frustumCulled = false;
    return mesh;
  }
}
