/** Curves against time, with a line at the time chosen and the values there. */
class Chart {
  constructor(parent, chart, time, motion, theme, choose) {
    this.chart = chart;
    this.motion = motion;
    this.theme = theme;
    const element = (tag, className, within) => {
      const made = document.createElement(tag);
      made.className = className;
      within.append(made);
      return made;
    };
    const box = element('div', 'chart', parent);
    const heading = element('h2', '', box);
    heading.textContent = chart.title + ' ';
    if (chart.factor) element('span', '', heading).textContent = 'axis in ' + Numbers.raised(chart.factor);
    this.values = element('div', 'values', box);
    this.plot = element('div', 'plot', box);
    this.canvas = element('div', 'canvas', this.plot);
    this.cursor = element('div', 'cursor', this.plot);
    element('div', 'time', this.plot).textContent = 't';
    this.roundOff = element('div', 'round-off', this.plot);
    this.roundOff.textContent = 'round-off';
    this.roundOff.hidden = true;
    this.names = chart.curves.map((curve) => Chart.nameOf(curve));
    this.entries = chart.curves.map((curve, i) => this.entry(curve, i));
    // Columns that numbers of another length do not move, and in which the shortest names are never cut
    const longest = Math.max(...this.names.map((name) => name.length)), width = longest > 8 ? 0.52 * longest + 10 : 12;
    this.values.style.gridTemplateColumns = `repeat(auto-fill, minmax(min(${width}em, 100%), 1fr))`;
    const rows = motion.rows.map((row) => [row[0], ...chart.curves.map(({ column }) => this.drawn(row[column]))]);
    this.backward = motion.direction < 0;
    if (this.backward) rows.reverse();
    const letter = parseFloat(getComputedStyle(document.documentElement).fontSize);
    // Numbers at as many as have room, each of so many pixels, and 0 among them
    const tics = (list, room) => (from, to, pixels) => {
      const apart = list.length > 1 ? (pixels * (list[1][0] - list[0][0])) / (to - from) : room;
      const every = Math.ceil(room / apart), zero = list.findIndex(([v]) => v === 0);
      return list.map(([v, text], i) => ({ v, label: (i - zero) % every === 0 ? Numbers.raised(text) : '' }));
    };
    const ofTime = 0.55 * Math.max(0, ...time.tics.map(([, text]) => text.length)) + 0.6;
    this.graph = new Dygraph(this.canvas, rows, {
      labels: ['t', ...chart.curves.map((_, i) => 'c' + i)],
      ...this.colours(),
      dateWindow: this.withItsEnds(time.range),
      valueRange: chart.range,
      axes: {
        x: { ticker: tics(time.tics, ofTime * letter), axisLabelWidth: 3.6 * letter, axisTickSize: 0.45 * letter },
        y: { ticker: tics(chart.tics, 1.1 * letter), axisLabelWidth: 3.6 * letter },
      },
      axisLabelFontSize: 0.88 * letter,
      strokeWidth: 1.6,
      legend: 'never',
      interactionModel: {},
      drawGapEdgePoints: true,
      pointSize: 2,
      highlightCircleSize: 0.25 * letter,
      gridLineWidth: 1,
      rightGap: Math.round(2.6 * letter),
      underlayCallback: (pen, area, graph) => this.shade(pen, area, graph),
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.listen(choose);
    theme.onChange(() => this.recolour());
  }

  /** What is below round-off, and its name beside it, where no curve goes. */
  shade(pen, area, graph) {
    if (this.chart.round_off === undefined) return;
    const top = Math.max(graph.toDomYCoord(this.chart.round_off), area.y), bottom = area.y + area.h;
    this.roundOff.hidden = top >= bottom;
    if (top >= bottom) return;
    this.roundOff.style.bottom = this.plot.clientHeight - bottom + 'px';
    pen.fillStyle = this.theme.get('grid');
    pen.globalAlpha = 0.5;
    pen.fillRect(area.x, top, area.w, bottom - top);
    pen.globalAlpha = 1;
  }

  /** A constraint by its number where its name is long. */
  static nameOf({ label, name, number }) {
    const longest = 36, text = label ?? name;
    return number === undefined || text.length <= longest ? text : Numbers.lowered('λ' + number);
  }

  /** A tic at the very end would be taken for one beyond it. */
  withItsEnds([from, to]) {
    const bit = 1e-6 * (to - from);
    return [from - bit, to + bit];
  }

  /** Gaps where there is nothing to draw: errors of 0, which have no logarithm, and what is not finite. */
  drawn(x) { return Number.isFinite(x) ? x : null; }

  colours() {
    const series = Object.fromEntries(this.chart.curves.map((_, i) => ['c' + i, { strokePattern: this.theme.dash(i) }]));
    return {
      colors: this.chart.curves.map((_, i) => this.theme.colour(i)),
      series,
      gridLineColor: this.theme.get('grid'),
      axisLineColor: this.theme.get('line'),
    };
  }

  /** Name and value of a curve, which a click hides and shows. */
  entry(curve, i) {
    const button = document.createElement('button');
    button.type = 'button';
    button.title = curve.name;
    button.setAttribute('aria-pressed', 'true');
    button.innerHTML =
      '<svg viewBox="0 0 24 8" preserveAspectRatio="none"><line x1="1" x2="23" y1="4" y2="4" stroke-width="3"/></svg>' +
      '<span class="name"></span><span class="value"></span>';
    button.querySelector('.name').textContent = this.names[i];
    button.addEventListener('click', () => {
      const shown = button.getAttribute('aria-pressed') !== 'true';
      button.setAttribute('aria-pressed', String(shown));
      this.graph.setVisibility(i, shown);
    });
    this.values.append(button);
    const entry = { value: button.querySelector('.value'), line: button.querySelector('line') };
    this.paint(entry, i);
    return entry;
  }

  paint(entry, i) {
    entry.line.setAttribute('stroke', this.theme.colour(i));
    const dash = this.theme.dash(i);
    if (dash) entry.line.setAttribute('stroke-dasharray', dash.map((x) => x / 2).join(' '));
  }

  recolour() {
    this.entries.forEach((entry, i) => this.paint(entry, i));
    this.graph.updateOptions(this.colours());
  }

  listen(choose) {
    const go = (event) => choose(this.graph.toDataXCoord(event.clientX - this.canvas.getBoundingClientRect().left));
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      go(event);
      event.preventDefault();
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (this.canvas.hasPointerCapture(event.pointerId)) go(event);
    });
  }

  resize() {
    this.graph.resize();
    if (this.index !== undefined) this.show(this.index);
  }

  show(index) {
    this.index = index;
    const row = this.motion.rows[index], area = this.graph.getArea();
    this.graph.setSelection(this.backward ? this.motion.count - 1 - index : index, undefined, true);
    this.cursor.style.left = this.graph.toDomXCoord(row[0]) - 1 + 'px';
    this.cursor.style.top = area.y + 'px';
    this.cursor.style.height = area.h + 'px';
    this.chart.curves.forEach(({ column }, i) => {
      const x = row[column];
      this.entries[i].value.textContent = this.chart.decimal ? Numbers.powerOfTen(x) : Numbers.value(x);
    });
  }
}
