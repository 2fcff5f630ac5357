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
    const joined = this.motion.links.filter(([, , as]) => as === 'body');
    for (const [a, b] of joined) if (this.motion.places[b].has_mass) colours.set(a, colours.get(b));
    for (const [a, b] of joined) if (!colours.has(b)) colours.set(b, colours.get(a));
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
    for (const place of seen)
      for (let i = 0; i < motion.count; ++i)
        this.relative(place, i).forEach((x, j) => {
          if (!Number.isFinite(x)) return;
          low[j] = Math.min(low[j], x);
          high[j] = Math.max(high[j], x);
        });
    const bounded = low.every(Number.isFinite);
    this.low = bounded ? low : [-1, -1, -1];
    this.high = bounded ? high : [1, 1, 1];
    this.middle = centre === 'all' ? this.low.map((x, j) => (x + this.high[j]) / 2) : [0, 0, 0];
    this.radius = 0;
    for (const place of seen)
      for (let i = 0; i < motion.count; ++i) {
        const r = Math.hypot(...this.relative(place, i));
        if (Number.isFinite(r)) this.radius = Math.max(this.radius, r);
      }
    if (!(this.radius > 0)) this.radius = 1;
    this.resetView();
  }

  resetView(side = 'oblique') {
    const degree = Math.PI / 180;
    [this.azimuth, this.elevation] =
      { oblique: [-60 * degree, 20 * degree], x: [0, 0], y: [-90 * degree, 0], z: [-90 * degree, 90 * degree] }[side];
    this.zoom = 1;
    this.shift = [0, 0];
    this.turned();
  }

  /** A position from the centre of what is seen. */
  relative(place, i) {
    const { motion, centre } = this;
    const from = centre === 'all' ? this.middle : centre === 'mean' ? motion.mean(i) : motion.position(centre, i);
    return motion.position(place, i).map((x, j) => x - from[j]);
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
    this.paths = this.motion.masses.map((place) => this.motion.rows.map((_, i) => this.drawnAt(place, i)));
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
    this.drawPaths();
    this.drawScene();
    this.drawLabels();
    this.drawAxes();
    this.drawMeasure();
  }

  stroke(points, colour, width, { alpha = 1, dash = [] } = {}) {
    const { pen } = this;
    pen.globalAlpha = alpha;
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    pen.beginPath();
    let open = false;
    for (const [x, y] of points) {
      const there = Number.isFinite(x) && Number.isFinite(y);
      if (there && open) pen.lineTo(x, y);
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

  /** Links, points before them, and bodies before these; of each kind the farther ones first. */
  drawScene() {
    const { motion, letter } = this;
    const at = motion.places.map((_, i) => this.drawnAt(i));
    const links = motion.links.map(([a, b, as]) => ({ near: at[a][2] + at[b][2], draw: () => this.drawLink(at[a], at[b], as, this.colourOfLink(a, b, as)) }));
    const places = (kind) => motion.places.flatMap((place, i) =>
      place.has_mass === kind && at[i].every(Number.isFinite)
        ? [{ near: at[i][2], draw: () => this.drawPlace(place, i, at[i], letter) }] : []);
    for (const parts of [links, places(false), places(true)])
      parts.sort((a, b) => a.near - b.near).forEach((part) => part.draw());
  }

  /** A body's own; of rods and springs that of their motion, where several are shown. */
  colourOfLink(a, b, as) {
    const given = [a, b].find((place) => this.motion.places[place].colour >= 0);
    return as === 'body' || given !== undefined ? this.colour(given ?? a) : this.theme.get('rod');
  }

  drawLink(a, b, as, colour) {
    if (as === 'spring') this.stroke(this.coil(a, b), colour, 0.09 * this.letter);
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
    if (place.has_mass) this.disc(at, (charge !== 0 ? 0.62 : 0.48) * letter, this.colour(i));
    else if (fixed) this.pivot(at, letter);
    else this.disc(at, 0.22 * letter, this.bodies.has(i) ? this.colour(i) : this.theme.get('rod'));
    if (charge !== 0) this.sign(at, charge, letter, place.has_mass);
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

  /** Names, of places that hide each other in one line; none where there are too many. */
  drawLabels() {
    const most = 12, { motion, pen, letter } = this;
    if (motion.masses.length > most) return;
    const labels = [];
    motion.places.forEach((place, i) => {
      if (!place.labelled || !(place.has_mass || place.blocks.length === 0)) return;
      const at = this.drawnAt(i);
      if (!at.every(Number.isFinite)) return;
      const near = labels.find((label) => Math.abs(label.at[0] - at[0]) < 1.3 * letter && Math.abs(label.at[1] - at[1]) < letter);
      if (near) near.text += ', ' + place.name;
      else labels.push({ at, text: place.name });
    });
    pen.font = `${letter}px system-ui, "Liberation Sans", Arial, sans-serif`;
    pen.textBaseline = 'middle';
    pen.lineWidth = 0.25 * letter;
    pen.strokeStyle = this.theme.get('back');
    pen.fillStyle = this.theme.get('text');
    pen.setLineDash([]);
    for (const { at, text } of labels) {
      const right = at[0] + 0.9 * letter + pen.measureText(text).width < this.width;
      pen.textAlign = right ? 'left' : 'right';
      const x = at[0] + (right ? 0.9 : -0.9) * letter, y = at[1] - 0.6 * letter;
      pen.strokeText(text, x, y);
      pen.fillText(text, x, y);
    }
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
