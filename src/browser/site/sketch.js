'use strict';

/// The start of a plane scene of bodies, points and rods, as a sketch in which bodies can be moved.
/// `moved` is called with {path: number} when one is let go.
class Sketch {
  constructor(box, moved) {
    this.box = box;
    this.moved = moved;
  }

  /// `motion` begins with the start; null if it is not known.
  show(motion) {
    this.motion = motion;
    const focused = document.activeElement?.dataset?.body;
    const fits = motion && motion.dimension === 2 && motion.bodies.length === 0;
    this.box.hidden = !fits;
    this.box.replaceChildren();
    if (!fits) return;
    this.at = motion.places.map((_, i) => motion.position(i, 0).slice(0, 2));
    this.frame();
    this.place = [];  // what puts each part where it is now
    const letters = motion.masses.length <= 12;
    this.box.append(svg('svg', {viewBox: `0 0 ${this.width} ${this.height}`, width: this.width, height: this.height,
      class: 'sketch', role: 'group', 'aria-label': 'The start; drag a body, or move it by the arrow keys'},
    ...motion.curves.map((line) => this.curve(line)),
    ...motion.links.map(([a, b, as]) => this.link(a, b, as)),
    ...motion.places.map((place, i) => (place.has_mass ? this.body(i, letters) : this.point(i, letters)))));
    this.draw();
    if (focused !== undefined) this.box.querySelector(`[data-body="${focused}"]`)?.focus();
  }

  /// The part of the plane that is seen, with room around it.
  frame() {
    this.width = this.box.clientWidth;
    this.height = Math.round(0.6 * this.width);
    const seen = [...this.at, ...this.motion.curves.flat()], sides = [0, 1].map((j) => seen.map((x) => x[j]));
    const ends = sides.map((side) => [Math.min(...side), Math.max(...side)]);
    const [width, height] = ends.map(([low, high]) => high - low);
    this.size = Math.max(width, height) || 1;
    this.middle = ends.map(([low, high]) => (low + high) / 2);
    const least = this.size / 2;
    this.scale = Math.min((this.width - 90) / Math.max(width, least), (this.height - 70) / Math.max(height, least));
  }

  drawn([x, y]) {
    return [this.width / 2 + this.scale * (x - this.middle[0]), this.height / 2 - this.scale * (y - this.middle[1])];
  }

  draw() {
    for (const place of this.place) place();
  }

  /// What a body is held on.
  curve(line) {
    return svg('polyline', {class: 'held', points: line.map((x) => this.drawn(x).join()).join(' ')});
  }

  link(a, b, as) {
    const line = svg('line', {class: as});
    this.place.push(() => [a, b].forEach((end, i) => {
      const [x, y] = this.drawn(this.at[end]);
      line.setAttribute(`x${i + 1}`, x);
      line.setAttribute(`y${i + 1}`, y);
    }));
    return line;
  }

  /// What stands at a place.
  group(i, attributes, ...parts) {
    const group = svg('g', attributes, ...parts);
    this.place.push(() => group.setAttribute('transform', `translate(${this.drawn(this.at[i])})`));
    return group;
  }

  name(i, letters) {
    const {name, labelled} = this.motion.places[i];
    if (!letters || !labelled) return [];
    const text = svg('text', {y: -8}, name);
    // Within the sketch
    this.place.push(() => {
      const right = this.drawn(this.at[i])[0] > 0.75 * this.width;
      text.setAttribute('x', right ? -10 : 10);
      text.setAttribute('text-anchor', right ? 'end' : 'start');
    });
    return [text];
  }

  /// A triangle that hangs from a fixed point.
  point(i, letters) {
    return this.group(i, {class: 'point'}, svg('path', {d: 'M0 0l-6 10h12z'}), ...this.name(i, letters));
  }

  body(i, letters) {
    const {name} = this.motion.places[i], colour = this.motion.masses.indexOf(i) % 6;
    const body = this.group(i, {class: `body colour${colour}`, tabindex: 0, role: 'button', 'data-body': i,
      'aria-roledescription': 'body to move'},
    svg('circle', {class: 'reach', r: 18}), svg('circle', {r: 8}), ...this.name(i, letters));
    this.place.push(() => {
      const [x, y] = this.at[i].map((value) => Number(value.toPrecision(4)));
      body.setAttribute('aria-label', `${name} at ${x}, ${y}`);
    });
    this.dragged(body, i);
    this.pressed(body, i);
    return body;
  }

  dragged(body, i) {
    // A finger on a body moves it, and not the page.
    body.addEventListener('touchstart', (event) => event.preventDefault(), {passive: false});
    body.addEventListener('pointerdown', (event) => body.setPointerCapture(event.pointerId));
    body.addEventListener('pointermove', (event) => {
      if (!body.hasPointerCapture(event.pointerId)) return;
      const box = this.box.firstChild.getBoundingClientRect();
      this.move(i, [this.middle[0] + (event.clientX - box.left - this.width / 2) / this.scale,
        this.middle[1] - (event.clientY - box.top - this.height / 2) / this.scale]);
    });
    body.addEventListener('pointerup', () => this.letGo(i));
    body.addEventListener('pointercancel', () => this.show(this.motion));
  }

  pressed(body, i) {
    const ways = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    body.addEventListener('keydown', (event) => {
      const way = ways[event.key], step = Numbers.roundBelow(this.size / 40) * (event.shiftKey ? 5 : 1);
      if (!way) return;
      event.preventDefault();
      this.move(i, this.at[i].map((x, j) => x + step * way[j]));
    });
    body.addEventListener('keyup', () => this.letGo(i));
    body.addEventListener('blur', () => this.letGo(i));
  }

  /// To a place, in numbers no longer than what a hand can tell.
  move(i, to) {
    const unit = 10 ** Math.floor(Math.log10(this.size / 400));
    this.at[i] = to.map((x) => multipleOf(unit, x));
    this.changed = true;
    this.draw();
  }

  letGo(i) {
    if (!this.changed) return;
    this.changed = false;
    const {name} = this.motion.places[i], [x, y] = this.at[i];
    this.moved({[`${name}.x`]: x, [`${name}.y`]: y});
  }
}
