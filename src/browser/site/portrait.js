'use strict';

/// A phase portrait: a coordinate of a body against its velocity, of each method that ran.
class Portrait {
  /// `select` has the coordinates, `box` the picture.
  constructor(select, box) {
    Object.assign(this, {select, box, chosen: ''});
    select.addEventListener('change', () => {
      this.chosen = select.value;
      this.draw();
    });
  }

  /// `names` are the methods', one after another in what moves.
  show(motion, names) {
    Object.assign(this, {motion, names, each: motion.masses.length / names.length});
    this.select.replaceChildren();
    for (let k = 0; k < this.each; ++k)
      for (let j = 0; j < motion.dimension; ++j) {
        const {name} = motion.places[motion.masses[k]], axis = 'xyz'[j];
        const body = names.length > 1 ? name.replace(/ \([^()]*\)$/, '') : name;
        const option = new Option(`${body}.${axis} and ${body}.v${axis}`, `${body}.${axis}`);
        Object.assign(option.dataset, {body: k, axis: j});
        this.select.add(option);
      }
    if ([...this.select.options].some(({value}) => value === this.chosen)) this.select.value = this.chosen;
    this.draw();
  }

  draw() {
    const option = this.select.selectedOptions[0];
    if (!option) return this.box.replaceChildren();
    const width = Math.min(560, this.box.clientWidth), path = option.value;
    const of = (i) => Number(option.dataset.body) + i * this.each, j = Number(option.dataset.axis);
    const curves = this.names.map((name, i) => ({
      kind: 'line', colour: i % 6, name: this.names.length > 1 ? name : '',
      points: this.motion.rows.map((_, state) => {
        const x = this.motion.position(this.motion.masses[of(i)], state)[j], y = this.motion.velocity(of(i), state)[j];
        return {x, y: Number.isFinite(x) && Number.isFinite(y) ? y : null};
      }),
    }));
    const points = curves.flatMap((curve) => curve.points).filter(({y}) => y !== null);
    if (!points.length) return this.box.replaceChildren();
    const ends = (numbers) => {
      const [low, high] = endsOf(numbers), room = (high - low) / 25;
      return [low - room, high + room];
    };
    const speed = path.replace(/(.)$/, 'v$1');
    this.box.replaceChildren(chartOf({
      x: axisOfNumbers(ends(points.map(({x}) => x)), path), y: axisOfNumbers(ends(points.map(({y}) => y)), speed),
      curves, width, height: Math.round(Math.max(260, 0.7 * width)),
      label: `Phase portrait: ${speed} against ${path} of ${this.names.join(', ')}`,
    }));
  }
}
