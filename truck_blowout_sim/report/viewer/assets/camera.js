// Cameras that go with a truck and may be turned around it, or stand still.

// forward, left, up of the eye, then of the point looked at, from the middle of the truck, in m.
const VIEWS = {
  'chase': {eye: [-20, 9.5, 7], to: [-1.2, 0, -1.2]},
  'front left': {eye: [10.4, 6.2, 1.1], to: [2.6, 0.4, -0.1]},
  'front right': {eye: [10.4, -6.2, 1.1], to: [2.6, -0.4, -0.1]},
  'side': {eye: [-2.2, 19, 1.6], to: [-2.2, 0, 0]},
  'top': {eye: [-2.72, 0, 38], to: [-2.7, 0, 0]},
  'driver': {eye: [2.4, 0.55, 1.35], to: [22, 0.4, -0.4]},
};

class Eye {
  constructor(canvas) {
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.3, 900);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = 0.497 * Math.PI;
    this.controls.minDistance = 2;
    this.controls.maxDistance = 350;
    this.follow = true;
    this.last = null;
    this.size = 1;
  }

  view(name, truck) {
    const {eye, to} = VIEWS[name], s = name === 'driver' ? 1 : this.size;
    const put = (target, v) => {
      const c = Math.cos(truck.heading), n = Math.sin(truck.heading);
      target.set(truck.anchor.x + s * (v[0] * c - v[1] * n), truck.anchor.y + s * (v[0] * n + v[1] * c),
        truck.anchor.z + s * v[2]);
    };
    put(this.camera.position, eye);
    put(this.controls.target, to);
    this.controls.update();
    this.last = {at: truck.anchor.clone(), heading: truck.heading};
  }

  // Go along with the truck: shift by its way, turn by its heading.
  go(truck) {
    if (this.follow && this.last) {
      const turn = truck.heading - this.last.heading, c = Math.cos(turn), s = Math.sin(turn);
      for (const v of [this.camera.position, this.controls.target]) {
        const x = v.x - this.last.at.x, y = v.y - this.last.at.y;
        v.x = truck.anchor.x + x * c - y * s;
        v.y = truck.anchor.y + x * s + y * c;
      }
    }
    this.last = {at: truck.anchor.clone(), heading: truck.heading};
  }

  // The same view of another truck.
  beside(camera, from, to) {
    const turn = to.heading - from.heading, c = Math.cos(turn), s = Math.sin(turn);
    const moved = v => new THREE.Vector3(to.anchor.x + (v.x - from.anchor.x) * c - (v.y - from.anchor.y) * s,
      to.anchor.y + (v.x - from.anchor.x) * s + (v.y - from.anchor.y) * c, v.z);
    camera.position.copy(moved(this.camera.position));
    camera.up.set(0, 0, 1);
    camera.lookAt(moved(this.controls.target));
  }
}
