'use strict';

/// Right digits against processor time, of the runs so far of one scene up to one time.
class WorkPrecision {
  /// The clock of a browser counts tenths of milliseconds; what takes less counts as one.
  static tick = 1e-4;

  constructor(box) {
    Object.assign(this, {box, of: '', points: []});
  }

  /// Runs of what `of` says; others are forgotten when it changes. `says` tells with what they ran.
  add(of, runs, says) {
    if (of !== this.of) Object.assign(this, {of, points: []});
    for (const run of runs)
      if (run.digits !== undefined && run.digits !== null)
        this.points.push({
          method: run.resolved ?? run.method, x: Math.log10(Math.max(Number(run.cpu_seconds), WorkPrecision.tick)),
          y: Number(run.digits), says: `${run.method}, ${says}: ${Number(run.digits).toFixed(1)} digits in ` +
            `${Number(run.cpu_seconds).toPrecision(2)} s`,
        });
    this.draw();
  }

  draw() {
    this.box.hidden = !this.points.length;
    if (!this.points.length) return this.box.replaceChildren();
    const names = [...new Set(this.points.map(({method}) => method))], width = Math.min(420, this.box.clientWidth);
    const most = Math.ceil(Math.max(...this.points.map(({y}) => y)));
    this.box.replaceChildren(chartOf({
      x: axisOfPowers(this.points.map(({x}) => x), 'processor time in seconds'),
      y: axisOfNumbers([0, most || 1], 'right digits so far'),
      curves: names.map((name, i) => ({
        kind: 'dots', colour: i % 6, name,
        points: this.points.filter(({method}) => method === name).sort((a, b) => a.x - b.x),
      })),
      width, height: 220, label: `Right digits against processor time. ${this.points.map(({says}) => says).join('; ')}`,
    }));
  }
}
