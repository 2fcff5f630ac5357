/** The states of the run that the page holds. */
class Motion {
  constructor(data) {
    this.rows = data.samples.map((row) => row.map(Number));
    this.velocities = data.velocities;
    this.count = this.rows.length;
    this.dimension = data.sketch.dimension;
    this.places = data.sketch.places;
    this.links = data.sketch.links;
    this.bodies = data.sketch.bodies.map((body) => ({ ...body, solid: data.sketch.solids[body.solid] }));
    this.meshes = data.sketch.meshes;
    this.curves = data.sketch.curves;
    this.every = data.every;
    this.steps = data.steps;
    this.lastStep = data.last_step;
    this.masses = this.places.flatMap((place, i) => (place.has_mass ? [i] : []));
    this.direction = Math.sign(this.t(this.count - 1) - this.t(0)) || 1;
    this.passed = this.rows.map((row) => this.direction * (row[0] - this.rows[0][0]));
    this.positions = this.places.map((place) => this.rows.map((row) => this.at(place, row)));
  }

  t(i) { return this.rows[i][0]; }

  /** The step that state i is after. */
  step(i) { return i === this.count - 1 ? this.lastStep : i * this.every; }

  /** Where a place is: its shift and the weighted blocks of coordinates. */
  at(place, row) {
    const x = [0, 0, 0];
    for (let j = 0; j < this.dimension; ++j) {
      x[j] = place.shift.length > 0 ? Number(place.shift[j]) : 0;
      for (const [offset, weight] of place.blocks) x[j] += weight * row[1 + offset + j];
    }
    return x;
  }

  /** A rigid body's corners, or other points of its frame, in state i. */
  corners(body, i, points = body.solid.corners) {
    const row = this.rows[i], reference = this.at(body, row);
    return points.map((corner) => reference.map((x, j) =>
      j < this.dimension ? body.directors.reduce((sum, at, a) => sum + corner[a] * row[1 + at + j], x) : 0));
  }

  position(place, i) { return this.positions[place][i]; }

  /** Of the k-th place that has mass, in state i; zero if it is not known. */
  velocity(k, i) {
    const known = this.velocities[i]?.[k] ?? [];
    return [0, 1, 2].map((j) => Number(known[j] ?? 0));
  }

  /** The last state that is not later than this time after the start. */
  indexAfter(passed) {
    let low = 0, high = this.count - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (this.passed[middle] <= passed) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** The state nearest to time t. */
  indexNear(t) {
    const passed = this.direction * (t - this.t(0));
    const before = this.indexAfter(passed), after = Math.min(before + 1, this.count - 1);
    return passed - this.passed[before] <= this.passed[after] - passed ? before : after;
  }

  /** The mean position of what has mass. */
  mean(i) {
    const sum = [0, 0, 0];
    for (const place of this.masses) this.position(place, i).forEach((x, j) => (sum[j] += x / this.masses.length));
    return sum;
  }

  /** Its velocity. */
  meanVelocity(i) {
    const sum = [0, 0, 0];
    this.masses.forEach((_, k) => this.velocity(k, i).forEach((x, j) => (sum[j] += x / this.masses.length)));
    return sum;
  }
}
