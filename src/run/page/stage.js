/** The scene, drawn on a canvas: in its plane, or in space from a side that can be chosen. */
class Stage {
  constructor(canvas, motion, theme) {
    this.canvas = canvas;
    this.motion = motion;
    this.theme = theme;
    this.index = 0;
    this.path = 'last';
    this.bodies = this.coloursOfBodies();
    this.centreOn('all');
    this.listen();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  get planar() { return this.motion.dimension < 3; }

  /** Which colour each place has: what has mass its own, points of a rigid body that of the body. */
  coloursOfBodies() {
    const colours = new Map();
    this.motion.places.forEach(({ colour }, i) => colour >= 0 && colours.set(i, colour));
    if (colours.size > 0) return colours;
    this.motion.masses.forEach((place, i) => colours.set(place, i));
    this.motion.places.forEach(({ of }, i) => of !== undefined && colours.set(i, colours.get(of)));
    return colours;
  }

  colour(place) { return this.bodies.has(place) ? this.theme.colour(this.bodies.get(place)) : this.theme.get('rod'); }

  // What is seen

  /** 'all', 'mean' or the number of a place that everything is seen from. */
  centreOn(centre) {
    this.centre = centre;
    const { motion } = this;
    const seen = centre === 'all' ? motion.places.map((_, i) => i) : motion.masses;
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    this.middle = [0, 0, 0];
    this.forEachSeen(seen, (point) => point.forEach((x, j) => {
      if (!Number.isFinite(x)) return;
      low[j] = Math.min(low[j], x);
      high[j] = Math.max(high[j], x);
    }));
    const bounded = low.every(Number.isFinite);
    this.low = bounded ? low : [-1, -1, -1];
    this.high = bounded ? high : [1, 1, 1];
    this.middle = centre === 'all' ? this.low.map((x, j) => (x + this.high[j]) / 2) : [0, 0, 0];
    this.radius = 0;
    this.forEachSeen(seen, (point) => {
      const r = Math.hypot(...point);
      if (Number.isFinite(r)) this.radius = Math.max(this.radius, r);
    });
    if (!(this.radius > 0)) this.radius = 1;
    this.resetView();
  }

  /** Every place, and the corners of boxes about rigid bodies, at all times; what bodies are held on, if it rests. */
  forEachSeen(places, call) {
    const { motion } = this;
    const boxes = motion.bodies.map((body) => [body, Stage.boxAbout(body.solid.corners)]);
    for (let i = 0; i < motion.count; ++i) {
      for (const place of places) call(this.relative(place, i));
      const from = this.origin(i);
      for (const [body, box] of boxes) for (const x of motion.corners(body, i, box)) call(Stage.less(x, from));
    }
    if (this.centre === 'all') for (const line of [...motion.meshes, ...motion.curves]) for (const x of line) call(Stage.less(x, this.middle));
  }

  /** The corners of the smallest box about points. */
  static boxAbout(points) {
    const ends = [0, 1, 2].map((j) => points.map((x) => x[j])).map((x) => [Math.min(...x), Math.max(...x)]);
    return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => ends.map((end, j) => end[(i >> j) & 1]));
  }

  static less(a, b) { return a.map((x, j) => x - b[j]); }

  resetView(side = 'oblique') {
    const degree = Math.PI / 180;
    [this.azimuth, this.elevation] =
      { oblique: [-60 * degree, 20 * degree], x: [0, 0], y: [-90 * degree, 0], z: [-90 * degree, 90 * degree] }[side];
    this.zoom = 1;
    this.shift = [0, 0];
    this.turned();
  }

  /** The centre of what is seen. */
  origin(i) {
    const { motion, centre } = this;
    return centre === 'all' ? this.middle : centre === 'mean' ? motion.mean(i) : motion.position(centre, i);
  }

  /** A position from there. */
  relative(place, i) { return Stage.less(this.motion.position(place, i), this.origin(i)); }

  /** The velocity from there of the k-th place that has mass. */
  relativeVelocity(k, i) {
    const { motion, centre } = this, v = motion.velocity(k, i);
    if (centre === 'all') return v;
    return Stage.less(v, centre === 'mean' ? motion.meanVelocity(i) : motion.velocity(motion.masses.indexOf(centre), i));
  }

  /** The path of the k-th place that has mass: points, each behind the two that bend the way to it. */
  pathOf(k) {
    const { motion } = this, place = motion.masses[k];
    const states = motion.rows.map(([t], i) => ({ t, at: this.relative(place, i), v: this.relativeVelocity(k, i) }));
    return states.map((state, i) => {
      const bend = i > 0 ? Stage.bend(states[i - 1], state) : [];
      return [...this.project(state.at), ...bend.flatMap((x) => this.project(x).slice(0, 2))];
    });
  }

  /** Two points by which a cubic has the velocities at its ends; none where these do not fit, as in smooth_path.cpp. */
  static bend(from, to) {
    const passed = to.t - from.t, way = Stage.less(to.at, from.at), longest = 2 * Math.hypot(...way);
    const leadsOn = (v) =>
      passed * v.reduce((sum, x, j) => sum + x * way[j], 0) >= 0 && Math.hypot(...v) * Math.abs(passed) <= longest;
    if (!leadsOn(from.v) || !leadsOn(to.v)) return [];
    return [from.at.map((x, j) => x + (passed / 3) * from.v[j]), to.at.map((x, j) => x - (passed / 3) * to.v[j])];
  }

  /** To pixels, right and down, and towards who looks. */
  project([x, y, z]) {
    let across = x, up = y, near = z;
    if (!this.planar) {
      const sin = Math.sin(this.azimuth), cos = Math.cos(this.azimuth);
      const towards = cos * x + sin * y;
      across = cos * y - sin * x;
      up = Math.cos(this.elevation) * z - Math.sin(this.elevation) * towards;
      near = Math.cos(this.elevation) * towards + Math.sin(this.elevation) * z;
    }
    return [this.width / 2 + this.shift[0] + this.scale * across, this.height / 2 + this.shift[1] - this.scale * up, near];
  }

  /** Where a place is drawn, in pixels of the page from the corner of the canvas. */
  drawnAt(place, i = this.index) { return this.project(this.relative(place, i)); }

  /** Width and height of what is seen; of a motion in space for all azimuths, so that turning it does not change them. */
  sizes() {
    if (this.centre !== 'all') return [2 * this.radius, 2 * this.radius];
    const [x, y, z] = this.high.map((high, j) => high - this.low[j]);
    if (this.planar) return [x, y];
    const flat = Math.hypot(x, y);
    return [flat, Math.sin(Math.abs(this.elevation)) * flat + Math.cos(this.elevation) * z];
  }

  turned() {
    if (!this.width) return;
    const room = 2.2 * this.letter;
    const free = [Math.max(this.width - 2 * room, 20), Math.max(this.height - 2 * room, 20)];
    const sizes = this.sizes();
    this.scale = this.zoom * Math.min(...free.map((x, j) => x / Math.max(sizes[j], 0.05 * this.radius)));
    this.paths = this.motion.masses.map((_, k) => this.pathOf(k));
    this.draw();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    this.letter = parseFloat(getComputedStyle(document.documentElement).fontSize);
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    this.pen = this.canvas.getContext('2d');
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.turned();
  }

  nearer(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.1), 1e4);
    this.turned();
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener('pointermove', (event) => {
      if (!canvas.hasPointerCapture(event.pointerId)) return;
      if (this.planar) {
        this.shift = [this.shift[0] + event.movementX, this.shift[1] + event.movementY];
      } else {
        const turn = Math.PI / Math.max(this.width, 1);
        this.azimuth -= turn * event.movementX;
        this.elevation = Math.min(Math.max(this.elevation + turn * event.movementY, -Math.PI / 2), Math.PI / 2);
      }
      this.turned();
    });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.nearer(Math.exp(-event.deltaY / 500));
    }, { passive: false });
    canvas.addEventListener('dblclick', () => this.resetView());
  }

  show(index) {
    this.index = index;
    this.draw();
  }

  // Drawing

  draw() {
    if (!this.width || !this.paths) return;
    this.pen.clearRect(0, 0, this.width, this.height);
    this.pen.lineCap = this.pen.lineJoin = 'round';
    if (!this.planar && this.centre === 'all') this.drawBox();
    this.drawHeldOn();
    this.drawPaths();
    this.drawScene();
    this.drawLabels();
    this.drawAxes();
    this.drawMeasure();
  }

  /** A line through points; one with the two that bend the way to it has them behind its three numbers. */
  stroke(points, colour, width, { alpha = 1, dash = [] } = {}) {
    const { pen } = this;
    pen.globalAlpha = alpha;
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    pen.beginPath();
    let open = false;
    for (const [x, y, , ...bend] of points) {
      const there = Number.isFinite(x) && Number.isFinite(y);
      if (there && open && bend.length > 0) pen.bezierCurveTo(...bend, x, y);
      else if (there && open) pen.lineTo(x, y);
      else if (there) pen.moveTo(x, y);
      open = there;
    }
    pen.stroke();
    pen.globalAlpha = 1;
  }

  disc([x, y], radius, colour) {
    const { pen } = this;
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fillStyle = colour;
    pen.fill();
  }

  /** The surfaces and curves that bodies are held on. */
  drawHeldOn() {
    const { motion } = this, from = this.origin(this.index), soft = this.theme.get('soft');
    const draw = (line, width, alpha) => this.stroke(line.map((x) => this.project(Stage.less(x, from))), soft, width, { alpha });
    for (const line of motion.meshes) draw(line, 0.7, 0.4);
    for (const line of motion.curves) draw(line, 1.5, 0.5);
  }

  /** What the motion stays in. */
  drawBox() {
    const { low, high, middle } = this;
    const corner = (i) => this.project([0, 1, 2].map((j) => ((i >> j) & 1 ? high[j] : low[j]) - middle[j]));
    for (let i = 0; i < 8; ++i)
      for (let j = 0; j < 3; ++j)
        if (!((i >> j) & 1)) this.stroke([corner(i), corner(i | (1 << j))], this.theme.get('grid'), 1.2);
  }

  drawPaths() {
    if (this.path === 'none') return;
    const last = this.index + 1;
    const first = this.path === 'last' ? Math.max(0, last - Math.max(12, Math.round(this.motion.count / 16))) : 0;
    this.motion.masses.forEach((place, k) => {
      if (this.path !== 'past') this.stroke(this.paths[k], this.colour(place), 1.2, { alpha: this.path === 'whole' ? 0.8 : 0.22 });
      if (this.path !== 'whole') this.stroke(this.paths[k].slice(first, last), this.colour(place), 2);
    });
  }

  /** Faces and links, points before them, and bodies before these; of each kind the farther ones first. */
  drawScene() {
    const { motion, letter } = this;
    const at = motion.places.map((_, i) => this.drawnAt(i));
    const faces = motion.bodies.flatMap((body) => this.facesOf(body));
    const links = motion.links.map(([a, b, as]) => ({ near: (at[a][2] + at[b][2]) / 2, draw: () => this.drawLink(at[a], at[b], as, this.colourOfLink(a, b, as)) }));
    const places = (kind) => motion.places.flatMap((place, i) =>
      place.has_mass === kind && at[i].every(Number.isFinite)
        ? [{ near: at[i][2], draw: () => this.drawPlace(place, i, at[i], letter) }] : []);
    for (const parts of [[...faces, ...links], places(false), places(true)])
      parts.sort((a, b) => a.near - b.near).forEach((part) => part.draw());
  }

  /** The faces of a rigid body that are seen, lit from above and before, each with its edges. */
  facesOf(body) {
    const { solid } = body, colour = this.colour(body.place), from = this.origin(this.index);
    const at = this.motion.corners(body, this.index).map((x) => this.project(Stage.less(x, from)));
    if (!at.every((x) => x.every(Number.isFinite))) return [];
    // Twice the area in each plane, down being positive on a canvas, and so the normal.
    const normals = solid.faces.map((face) => {
      const sum = [0, 0, 0];
      face.forEach((corner, k) => {
        const a = at[corner], b = at[face[(k + 1) % face.length]], scale = this.scale;
        for (let j = 0; j < 3; ++j) {
          const [l, m] = [(j + 1) % 3, (j + 2) % 3], in3 = (x, n) => (n === 2 ? x[2] * scale : n === 1 ? -x[1] : x[0]);
          sum[j] += in3(a, l) * in3(b, m) - in3(a, m) * in3(b, l);
        }
      });
      const size = Math.hypot(...sum);
      return size > 0 ? sum.map((x) => x / size) : [0, 0, 0];
    });
    const towards = normals.map((normal) => normal[2] > 0);
    return solid.faces.flatMap((face, f) => {
      if (solid.closed && !towards[f]) return [];
      const side = towards[f] ? 1 : -1, [x, y, z] = normals[f].map((part) => side * part);
      const light = Math.max(0, -0.35 * x + 0.55 * y + 0.75 * z);
      const edges = solid.edges.filter(([, , one, other, sharp]) =>
        (one === f || other === f) && (sharp || towards[one] !== towards[other]));
      const near = face.reduce((sum, corner) => sum + at[corner][2] / face.length, 0);
      return [{ near, draw: () => {
        this.fill(face.map((corner) => at[corner]), this.theme.mixed(colour, 0.45 - 0.33 * light));
        for (const [a, b] of edges) this.stroke([at[a], at[b]], colour, 1.5);
      } }];
    });
  }

  /** A face, and over its rim, so that no gap is left to the next. */
  fill(points, colour) {
    const { pen } = this;
    pen.beginPath();
    points.forEach(([x, y], k) => (k === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
    pen.closePath();
    pen.setLineDash([]);
    pen.lineWidth = 0.8;
    pen.fillStyle = pen.strokeStyle = colour;
    pen.fill();
    pen.stroke();
  }

  /** A body's own; of rods and springs that of their motion, where several are shown. */
  colourOfLink(a, b, as) {
    const given = [a, b].find((place) => this.motion.places[place].colour >= 0);
    return as === 'body' || given !== undefined ? this.colour(given ?? a) : this.theme.get('rod');
  }

  drawLink(a, b, as, colour) {
    if (as === 'spring') this.stroke(this.coil(a, b), colour, 0.09 * this.letter);
    else if (as === 'axis') this.stroke([a, b], this.theme.get('text'), 1.3, { dash: [9, 3, 2, 3] });
    else this.stroke([a, b], colour, (as === 'rod' ? 0.17 : 0.3) * this.letter);
  }

  /** A spring's zigzag between two points. */
  coil(a, b) {
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(length > 0)) return [a, b];
    const turns = 12, width = Math.min(0.45 * this.letter, length / 4);
    const points = [a];
    for (let i = 1; i < turns; ++i) {
      const share = i / turns, side = (i % 2 ? 1 : -1) * (i > 1 && i < turns - 1 ? width : 0);
      points.push([
        a[0] + share * (b[0] - a[0]) + (side * (a[1] - b[1])) / length,
        a[1] + share * (b[1] - a[1]) + (side * (b[0] - a[0])) / length,
      ]);
    }
    return [...points, b];
  }

  drawPlace(place, i, at, letter) {
    const fixed = place.blocks.length === 0;
    const charge = Number(place.charge);
    if (place.mark === 'none') return;
    if (place.has_mass) this.disc(at, (charge !== 0 ? 0.62 : place.of === undefined ? 0.48 : 0.26) * letter, this.colour(i));
    else if (place.mark === 'joint') this.joint(at, letter);
    else if (fixed) this.pivot(at, letter);
    else this.disc(at, 0.22 * letter, this.bodies.has(i) ? this.colour(i) : this.theme.get('rod'));
    if (charge !== 0) this.sign(at, charge, letter, place.has_mass);
  }

  joint(at, letter) {
    this.disc(at, 0.34 * letter, this.theme.get('text'));
    this.disc(at, 0.2 * letter, this.theme.get('back'));
  }

  /** A point fixed in space: a triangle that hangs from it. */
  pivot([x, y], letter) {
    const { pen } = this;
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x - 0.5 * letter, y + 0.85 * letter);
    pen.lineTo(x + 0.5 * letter, y + 0.85 * letter);
    pen.closePath();
    pen.fillStyle = this.theme.get('text');
    pen.fill();
  }

  /** + or − within a body, or beside a point. */
  sign([x, y], charge, letter, within) {
    const size = 0.34 * letter, colour = this.theme.get(within ? 'back' : 'text'), left = within ? x : x - letter;
    this.stroke([[left - size, y], [left + size, y]], colour, 0.18 * letter);
    if (charge > 0) this.stroke([[left, y - size], [left, y + size]], colour, 0.18 * letter);
  }

  /** Names, of places that hide each other in one line, beside them where nothing else stands; else left out. */
  drawLabels() {
    const most = 12, { motion, pen, letter } = this;
    this.labels = [];
    if (motion.masses.length > most) return;
    const marks = [];
    motion.places.forEach((place, i) => {
      if (place.mark === 'none' || !(place.has_mass || place.blocks.length === 0 || place.mark === 'joint')) return;
      const at = this.drawnAt(i), name = place.labelled && place.mark !== 'joint' ? place.name : '';
      if (!at.every(Number.isFinite)) return;
      const near = marks.find((mark) => Math.abs(mark.at[0] - at[0]) < letter && Math.abs(mark.at[1] - at[1]) < letter);
      if (near && name) near.text += (near.text ? ', ' : '') + name;
      else if (!near) marks.push({ at, text: name });
    });
    pen.font = `${letter}px system-ui, "Liberation Sans", Arial, sans-serif`;
    pen.textBaseline = 'middle';
    pen.textAlign = 'left';
    pen.lineWidth = 0.25 * letter;
    pen.strokeStyle = this.theme.get('back');
    pen.fillStyle = this.theme.get('text');
    pen.setLineDash([]);
    const half = 0.45 * letter, taken = marks.map(({ at: [x, y] }) => [x - half, y - half, x + half, y + half]);
    const free = (a) => a[0] >= 0 && a[1] >= 0 && a[2] <= this.width && a[3] <= this.height &&
      !taken.some((b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]);
    this.sides ??= new Map();
    for (const { at, text } of marks) {
      if (!text) continue;
      const width = pen.measureText(text).width, sides = Stage.sides(at, width, letter);
      // As it stood before, if there is room still: names that jump cannot be read.
      const order = [this.sides.get(text), ...sides.keys()].filter((side) => side !== undefined);
      const side = order.find((n) => free(sides[n]));
      if (side === undefined) continue;
      this.sides.set(text, side);
      taken.push(sides[side]);
      this.labels.push([text, ...sides[side]]);
      const x = sides[side][0], y = (sides[side][1] + sides[side][3]) / 2;
      pen.strokeText(text, x, y);
      pen.fillText(text, x, y);
    }
  }

  /** Where a name may stand, the best first: left, top, right and bottom. */
  static sides([x, y], width, letter) {
    const gap = 0.6 * letter, height = 1.15 * letter;
    const left = { '1': x + gap, '-1': x - gap - width, '0': x - width / 2 };
    const top = { '1': y - gap - height, '-1': y + gap, '0': y - height / 2 };
    return [[1, 1], [-1, 1], [1, -1], [-1, -1], [1, 0], [-1, 0], [0, 1], [0, -1]].map(([across, up]) => {
      // At a corner it is nearer to the mark.
      const near = across !== 0 && up !== 0 ? 0.3 * letter : 0;
      const l = left[across] - across * near / 2, t = top[up] + up * near;
      return [l, t, l + width, t + height];
    });
  }

  /** The directions of the axes, below on the left. */
  drawAxes() {
    const { pen, letter } = this, origin = [2.6 * letter, this.height - 2.6 * letter], length = 1.7 * letter;
    const zero = this.project([0, 0, 0]);
    ['x', 'y', 'z'].slice(0, this.motion.dimension).forEach((name, j) => {
      const end = this.project([0, 1, 2].map((k) => (k === j ? 1 : 0)));
      const [dx, dy] = [(end[0] - zero[0]) / this.scale, (end[1] - zero[1]) / this.scale];
      if (Math.hypot(dx, dy) < 0.05) return;
      this.stroke([origin, [origin[0] + length * dx, origin[1] + length * dy]], this.theme.get('soft'), 1.5);
      pen.fillStyle = this.theme.get('soft');
      pen.font = `italic ${0.9 * letter}px system-ui, "Liberation Sans", Arial, sans-serif`;
      pen.textAlign = 'center';
      pen.textBaseline = 'middle';
      pen.fillText(name, origin[0] + (length + 0.55 * letter) * dx, origin[1] + (length + 0.55 * letter) * dy);
    });
  }

  /** A round length, below on the right. */
  drawMeasure() {
    const { pen, letter } = this, length = Numbers.roundBelow(this.width / 5 / this.scale);
    if (!Number.isFinite(length)) return;
    const right = this.width - letter, left = right - length * this.scale, y = this.height - letter, tooth = 0.3 * letter;
    this.stroke([[left, y - tooth], [left, y], [right, y], [right, y - tooth]], this.theme.get('soft'), 1.5);
    pen.fillStyle = this.theme.get('soft');
    pen.font = `${0.9 * letter}px system-ui, "Liberation Sans", Arial, sans-serif`;
    pen.textAlign = 'center';
    pen.textBaseline = 'bottom';
    pen.fillText(Numbers.value(length, 1), (left + right) / 2, y - 0.2 * letter);
  }
}
