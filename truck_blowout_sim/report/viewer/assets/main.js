// The page: tools, time, and the loop that draws.

const $ = id => document.getElementById(id);

class App {
  constructor(runs) {
    this.runs = runs;
    this.start = Math.min(...runs.map(r => r.t0));
    this.end = Math.max(...runs.map(r => r.t1));
    this.t = Math.max(this.start, Math.min(...runs.flatMap(r => r.blowouts.map(b => b.t)), this.end) - 2);
    if (!runs.some(r => r.blowouts.length)) this.t = this.start;
    this.playing = false; this.speed = 1; this.forces = true; this.mode = 'ghost';
    this.stale = true; this.frames = []; this.sharp = Math.min(devicePixelRatio || 1, 1.5);
    this._scene();
    this.plots = new Plots($('plots'), runs, this);
    this._tools();
    this._about();
    for (const names of firstPlots(runs)) this.plots.add(names);
    this.seek(this.t);
    this.view('chase');
    addEventListener('resize', () => { this.resize(); this.plots.redraw(); });
    new ResizeObserver(() => this.resize()).observe($('stage'));
    this.resize();
    this.wake();
  }

  _scene() {
    this.scene = new THREE.Scene();
    this.world = new World(this.scene, this.runs);
    this.trucks = this.runs.map((run, k) => new Truck(run, k));
    this.trucks.forEach(t => this.scene.add(t.group));
    this.eye = new Eye($('scene'));
    const [first] = Object.values(this.runs[0].vehicle.units);
    const length = Object.values(this.runs[0].vehicle.units).reduce((n, u) => n + u.front - u.rear, 0);
    this.eye.size = Math.min(1.25, 0.32 + 0.68 * length / 19);
    this.second = new THREE.PerspectiveCamera(38, 1, 0.3, 900);
    try {
      // a processor that draws alone is spared the four-fold work of smooth edges
      this.bySoftware = drawnBySoftware();
      this.renderer = new THREE.WebGLRenderer({canvas: $('scene'), antialias: !this.bySoftware});
    } catch (error) {
      $('message').hidden = false;
      $('message').textContent = 'This browser gives no WebGL: the plots work, the truck cannot be drawn.';
    }
    this.dark = matchMedia('(prefers-color-scheme: dark)');
    this.dark.addEventListener('change', () => this.theme());
    this.theme();
    this.eye.controls.addEventListener('change', () => { this.stale = true; });
  }

  theme(forced) {
    if (forced) document.documentElement.dataset.theme = forced;
    const name = document.documentElement.dataset.theme || (this.dark.matches ? 'dark' : 'light');
    document.documentElement.dataset.theme = name;
    this.world.theme(name);
    this.stale = true;
    if (this.plots) this.plots.redraw();
  }

  _tools() {
    const tools = $('tools');
    const choose = (words, title, options, value, act) => {
      const s = document.createElement('select');
      s.title = title; s.setAttribute('aria-label', title);
      s.innerHTML = options.map(([v, label]) => `<option value="${v}">${label}</option>`).join('');
      s.value = value; s.onchange = () => act(s.value);
      tools.append(s);
      return s;
    };
    this.viewChoice = choose('view', 'camera (keys 1 to 6)', Object.keys(VIEWS).map(v => [v, v]), 'chase', v => this.view(v));
    this.followChoice = choose('follow', 'camera follows the truck or stands free (key f)',
      [['yes', 'follows'], ['no', 'free']], 'yes', v => { this.eye.follow = v === 'yes'; });
    if (this.runs.length > 1)
      choose('mode', 'two runs', [['ghost', 'ghost'], ['side', 'side by side'], ['first', 'first only']],
        'ghost', v => { this.mode = v; this.arrange(); });
    choose('forces', 'tire forces', [['yes', 'forces'], ['no', 'no forces']], 'yes',
      v => { this.forces = v === 'yes'; this.stale = true; this.legend(); });
    choose('units', 'units of plots', [['us', 'mph, ft, psi'], ['si', 'SI']], 'us',
      v => { this.plots.units = v; this.plots.redraw(); this.stale = true; });
    choose('axes', 'axes of plots', [['iso', 'ISO axes'], ['sae', 'SAE axes']], 'iso',
      v => { this.plots.axes = v; this.plots.redraw(); this.stale = true; });
    choose('theme', 'light or dark', [['light', 'light'], ['dark', 'dark']],
      document.documentElement.dataset.theme, v => this.theme(v));
    $('play').onclick = () => this.play(!this.playing);
    const scrub = $('scrub');
    scrub.min = this.start; scrub.max = this.end;
    scrub.oninput = () => this.seek(+scrub.value, true);
    $('speed').onchange = () => { this.speed = +$('speed').value; };
    $('marks').innerHTML = this.runs.flatMap(r => r.blowouts).map(b =>
      `<i style="left:${100 * (b.t - this.start) / (this.end - this.start)}%" title="blown: ${escape_(b.tires.join(', '))}"></i>`).join('')
      + this.rollovers().map(o =>
        `<i class="over" style="left:${100 * Math.min((o.t - this.start) / (this.end - this.start), 1)}%" title="${escape_(o.words)}"></i>`).join('');
    addEventListener('keydown', e => this.key(e));
    this.arrange();
  }

  rollovers() { return this.runs.map(r => r.rollover).filter(o => o); }

  key(e) {
    if (e.target.matches('input:not([type=range]), select, textarea')) return;
    const steps = {ArrowLeft: -0.1, ArrowRight: 0.1, ',': -0.02, '.': 0.02};
    if (e.key === ' ') { e.preventDefault(); this.play(!this.playing); }
    else if (e.key in steps) { e.preventDefault(); this.seek(this.t + steps[e.key], true); }
    else if (e.key === 'Home') this.seek(this.start, true);
    else if (e.key === 'b') this.seek(Math.min(...this.runs.flatMap(r => r.blowouts.map(b => b.t))), true);
    else if (e.key === 'r' && this.rollovers().length) this.seek(Math.min(...this.rollovers().map(o => o.t)), true);
    else if (e.key === 'f') { this.eye.follow = !this.eye.follow; this.followChoice.value = this.eye.follow ? 'yes' : 'no'; }
    else if (/^[1-6]$/.test(e.key)) { const v = Object.keys(VIEWS)[e.key - 1]; this.viewChoice.value = v; this.view(v); }
  }

  _about() {
    $('about').querySelector('div').innerHTML = this.runs.map(run => `<h3>${escape_(run.name)}</h3>`
      + `<p>${escape_(run.title)}</p><p>Vehicle: ${escape_(run.vehicle.title)} (${escape_(run.vehicle.name)})</p><ul>`
      + [...run.notes, ...run.assumptions].map(a => `<li>${escape_(a)}</li>`).join('') + '</ul>').join('')
      + '<p>Keys: space plays, arrows step 0.1 s, comma and dot 0.02 s, b goes to the blowout, r to a rollover, 1 to 6 choose'
      + ' the camera, f frees it. Drag turns the view, the wheel comes closer, the right button shifts.'
      + ' In a plot: drag moves the cursor, the wheel spreads time, a double click shows all.</p>'
      + '<p>Drawn with three.js ' + '(MIT license, © three.js authors).</p>';
  }

  arrange() {
    const side = this.mode === 'side';
    this.trucks.forEach((truck, k) => {
      truck.setGhost(this.mode === 'ghost' && k > 0);
      truck.group.visible = k === 0 || this.mode !== 'first';
      this.world.own[k].visible = truck.group.visible;
    });
    document.body.classList.toggle('side', side);
    this.legend();
    this.resize();
  }

  legend() {
    const arrows = this.runs.some(r => Object.values(r.motion.hubs).some(h => Object.values(h.tires).some(t => t.f)));
    $('legend').innerHTML = this.runs.map((r, k) =>
      `<span><i style="background:#${COLORS[k % COLORS.length].toString(16).padStart(6, '0')}"></i>${escape_(r.name)}</span>`).join('')
      + (arrows && this.forces ? '<span><i style="background:#0091d5"></i>1 m = 5 kN on the road</span>'
        + '<span><i style="background:#52b788"></i>1 m = 20 kN upward</span>' : '')
      + '<span><i style="background:#d94f1e"></i>blown tire</span>'
      + (this.rollovers().length ? '<span><i style="background:#8b3fa8"></i>rollover</span>' : '')
      + `<span>grid ${this.world.step} m</span>`;
  }

  view(name) { this.eye.view(name, this.trucks[0]); this.stale = true; }

  play(on) {
    this.playing = on;
    if (on && this.t >= this.end - 1e-3) this.t = this.start;
    $('play').textContent = on ? '❚❚' : '▶';
    this.before = performance.now();
    if (on) this.wake();
  }

  seek(t, byHand) {
    this.t = Math.min(Math.max(t, this.start), this.end);
    this.trucks.forEach(truck => truck.place(this.t, this.forces));
    this.eye.go(this.trucks[0]);
    $('scrub').value = this.t;
    $('clock').textContent = `${this.t.toFixed(2)} s`;
    const now = performance.now();
    // words and cursors need not change more often than an eye follows them
    if (byHand || !this.playing || now - (this.said || 0) > 66) {
      this.said = now;
      this.read();
      this.plots.cursors();
    }
    this.stale = true;
    if (byHand) this.before = now;
  }

  read() {
    const us = this.plots.units === 'us', rows = this.runs.map(run => {
      const get = name => { const c = run.byName.get(name); return c ? valueAt(c, this.t) : NaN; };
      const sae = this.plots.axes === 'sae' ? -1 : 1, degrees = 180 / Math.PI;
      const speed = get('tractor_vx_mps'), parts = [];
      // The sum turns the -0 of a rounded small number into 0.
      const say = (v, digits, words) => { if (v === v) parts.push(`${(+v.toFixed(digits) + 0).toFixed(digits)} ${words}`); };
      say(us ? speed / 0.44704 : speed, 1, us ? 'mph' : 'm/s');
      say(sae * get('tractor_yaw_rate_radps') * degrees, 1, 'deg/s yaw rate');
      say(sae * get('steering_wheel_angle_rad') * degrees, 0, 'deg hand wheel');
      say(sae * get('articulation_rad') * degrees, 1, 'deg articulation');
      const flat = run.blowouts.filter(b => b.t <= this.t).flatMap(b => b.tires);
      const over = run.rollover && this.t >= Math.min(run.rollover.t, run.t1) - 0.005;
      const events = [...(flat.length ? [`${flat.join(', ')} blown`] : []), ...(over ? [run.rollover.words] : [])];
      return `<div>${[`${escape_(run.name)}: ${parts.join(' · ')}`, ...events.map(e => `<b>${escape_(e)}</b>`)].join(' · ')}</div>`;
    });
    $('readout').innerHTML = rows.join('');
  }

  resize() {
    if (!this.renderer) return;
    const stage = $('stage'), w = stage.clientWidth, h = stage.clientHeight;
    if (!w || !h) return;
    this.renderer.setPixelRatio(this.sharp);
    this.renderer.setSize(w, h, false);
    this.stale = true;
  }

  draw(w = $('stage').clientWidth, h = $('stage').clientHeight) {
    if (!this.renderer) return;
    const r = this.renderer;
    if (this.mode === 'side' && this.trucks.length > 1) {
      r.setScissorTest(true);
      const half = Math.floor(w / 2), cameras = [this.eye.camera, this.second];
      this.eye.beside(this.second, this.trucks[0], this.trucks[1]);
      cameras.forEach((camera, k) => {
        camera.aspect = half / h; camera.updateProjectionMatrix();
        this.trucks.forEach((t, j) => { t.group.visible = this.world.own[j].visible = j === k; });
        r.setViewport(k * half, 0, half, h); r.setScissor(k * half, 0, half, h);
        r.render(this.scene, camera);
      });
      r.setScissorTest(false);
      r.setViewport(0, 0, w, h);
      return;
    }
    this.eye.camera.aspect = w / h;
    this.eye.camera.updateProjectionMatrix();
    r.render(this.scene, this.eye.camera);
  }

  // A change of the scene asks for one frame; without changes no frame runs and no time is spent.
  get stale() { return this._stale; }

  set stale(is) { this._stale = is; if (is) this.wake(); }

  wake() {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(now => { this.due = false; this.loop(now); });
  }

  loop(now) {
    if (this.playing) {
      const passed = Math.min((now - this.before) / 1000, 0.25);
      this.before = now;
      const next = this.t + passed * this.speed;
      if (next >= this.end) { this.seek(this.end); this.play(false); } else this.seek(next);
      this.pace(now);
    }
    this.eye.controls.update();
    if (this.stale && !this.filming) { this.stale = false; this.draw(); }
    if (this.playing) this.wake();
  }

  // Slow machines draw fewer pixels instead of fewer pictures.
  pace(now) {
    this.frames.push(now);
    while (now - this.frames[0] > 1000) this.frames.shift();
    const full = this.frames.length > 3 && now - this.frames[0] > 700;
    const rate = (this.frames.length - 1) / (now - this.frames[0]) * 1000;
    this.rate = rate;
    if (full && rate < (this.bySoftware ? 29 : 24) && this.sharp > 0.55) { this.sharp *= 0.8; this.frames = []; this.resize(); }
  }

  // From now on pictures are drawn on demand only.
  film() { this.filming = true; this.playing = false; return true; }

  // A picture at an instant with what the page writes over it, for films and tests.
  // fine: drawn larger by this factor and reduced, for smooth edges.
  picture(t, width, height, type = 'image/jpeg', fine = 1) {
    this.seek(t);
    this.renderer.setPixelRatio(fine);
    this.renderer.setSize(width, height, false);
    this.draw(width, height);
    const page = document.createElement('canvas');
    page.width = width; page.height = height;
    const g = page.getContext('2d'), style = getComputedStyle(document.documentElement);
    g.imageSmoothingQuality = 'high';
    g.drawImage($('scene'), 0, 0, width, height);
    g.textBaseline = 'top';
    const lines = [`${this.t.toFixed(2)} s`, ...[...$('readout').children].map(row => row.textContent)];
    const font = px => { g.font = `600 ${px}px system-ui, "DejaVu Sans", sans-serif`; };
    const usual = Math.round(height / 34);
    font(usual);
    const longest = Math.max(...lines.map(words => g.measureText(words).width)) + 2 * usual;
    const size = usual * Math.min(1, width / longest);  // smaller where a line would be cut off
    font(size);
    lines.forEach((words, k) => {
      const y = size * (0.8 + 1.55 * k);
      g.fillStyle = style.getPropertyValue('--glass');
      g.fillRect(size * 0.6, y - size * 0.25, g.measureText(words).width + size * 0.8, size * 1.5);
      g.fillStyle = style.getPropertyValue('--ink');
      g.fillText(words, size, y);
    });
    return page.toDataURL(type, 0.92);
  }
}

function drawnBySoftware() {
  const gl = document.createElement('canvas').getContext('webgl');
  const info = gl && gl.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

// What one wants to see first, as far as it was recorded.
function firstPlots(runs) {
  const has = name => runs.some(r => r.byName.has(name));
  const blown = runs.flatMap(r => r.blowouts).flatMap(b => b.tires)[0];
  const wanted = [['tractor_yaw_rate_radps', 'trailer_yaw_rate_radps'], ['steering_wheel_angle_rad'],
    ['tractor_roll_rad', 'trailer_roll_rad', 'articulation_rad'], ['tractor_vx_mps'],
    blown ? [`tire_pressure_${blown}_pa`] : [], blown ? [`tire_fy_${blown}_n`, `tire_fz_${blown}_n`] : [],
    ['tractor_ay_mps2'], ['tractor_y_m']];
  const found = wanted.map(names => names.filter(has)).filter(names => names.length);
  return found.length ? found.slice(0, 4) : [[runs[0].channels[0].name]];
}

window.viewer = Promise.all(JSON.parse($('data').textContent).runs.map(unpackRun))
  .then(runs => (window.app = new App(runs)))
  .catch(error => {
    $('message').hidden = false;
    $('message').textContent = `This page cannot be shown: ${error.message}`;
    throw error;
  });
