/** The time shown, and what changes it. */
class Player {
  constructor(data) {
    const find = (id) => document.getElementById(id);
    this.motion = new Motion(data);
    this.theme = new Theme(data.colours);
    this.stage = new Stage(document.querySelector('#stage canvas'), this.motion, this.theme);
    this.charts = data.charts.map(
      (chart) => new Chart(find('charts'), chart, data.time, this.motion, this.theme, (t) => this.choose(this.motion.indexNear(t))));
    this.slider = find('slider');
    this.slider.max = this.motion.count - 1;
    this.playing = false;
    this.fillSpeeds(find('speed'));
    this.fillCentres(find('centre'));
    this.fillValues(find('values'), data.charts.flatMap((chart) => chart.curves));
    this.listen(find);
    this.theme.onChange(() => this.stage.draw());
    const opened = this.openAddress();
    if (!opened) this.show(0);
    if (!opened && !window.matchMedia('(prefers-reduced-motion: reduce)').matches) this.play(true);
  }

  get last() { return this.motion.count - 1; }

  /** The whole run in 20 seconds, or in fewer if it has few states. */
  fillSpeeds(select) {
    const seconds = Math.min(20, Math.max(4, this.motion.count / 30));
    this.rate = this.motion.passed[this.last] / seconds;
    for (const [factor, text] of [[1 / 8, '⅛'], [1 / 4, '¼'], [1 / 2, '½'], [1, '1'], [2, '2'], [4, '4'], [8, '8']]) {
      const option = new Option(text + ' ×', String(factor), factor === 1, factor === 1);
      option.title = Numbers.value(this.rate * factor, 3) + ' a second';
      select.add(option);
    }
    this.speed = 1;
    select.addEventListener('change', () => (this.speed = Number(select.value)));
  }

  fillCentres(select) {
    const { motion, stage } = this;
    select.add(new Option('fixed', 'all'));
    if (motion.masses.length > 1) select.add(new Option('mean of bodies', 'mean'));
    for (const place of motion.masses) select.add(new Option(motion.places[place].name, String(place)));
    select.addEventListener('change', () => stage.centreOn(Number.isNaN(Number(select.value)) ? select.value : Number(select.value)));
  }

  /** Tables of positions, and of multipliers by their whole names. */
  fillValues(parent, curves) {
    const { motion } = this;
    this.cells = [];
    const table = (heads, rows) => {
      if (rows.length === 0) return;
      const made = document.createElement('table');
      const line = (tag, texts) => {
        const row = made.insertRow();
        return texts.map((text) => {
          const cell = document.createElement(tag);
          cell.textContent = text;
          if (text) cell.className = 'name';
          row.append(cell);
          return cell;
        });
      };
      line('th', heads);
      for (const [texts, ...values] of rows) {
        const cells = line('td', [...texts, ...values.map(() => '')]).slice(texts.length);
        cells.forEach((cell, k) => this.cells.push({ cell, value: values[k] }));
      }
      parent.append(made);
    };
    const axes = ['x', 'y', 'z'].slice(0, motion.dimension);
    table(['', ...axes], motion.masses.map((place) =>
      [[motion.places[place].name], ...axes.map((_, j) => (i) => motion.position(place, i)[j])]));
    table(['', 'constraint', 'λ'], curves.filter(({ number }) => number !== undefined).map(({ number, name, column }) =>
      [[Numbers.lowered('λ' + number), name], (i) => motion.rows[i][column]]));
  }

  listen(find) {
    this.button = find('play');
    this.button.addEventListener('click', () => this.play(!this.playing));
    this.slider.addEventListener('input', () => this.choose(Number(this.slider.value)));
    this.repeat = find('repeat');
    find('path').addEventListener('change', (event) => {
      this.stage.path = event.target.value;
      this.stage.draw();
    });
    if (this.stage.planar) find('view-choice').hidden = true;
    find('view').addEventListener('change', (event) => this.stage.resetView(event.target.value));
    find('reset').addEventListener('click', () => this.stage.resetView(find('view').value));
    find('all-values').addEventListener('toggle', () => this.showValues());
    window.addEventListener('hashchange', () => this.openAddress());
    document.addEventListener('keydown', (event) => this.press(event));
  }

  press(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const { tagName, type } = event.target;
    if (tagName === 'SELECT' || (event.key === ' ' && /^(BUTTON|SUMMARY)$/.test(tagName)) || type === 'checkbox') return;
    const leap = event.shiftKey ? Math.max(1, Math.round(this.motion.count / 20)) : 1;
    const action = {
      ' ': () => this.play(!this.playing),
      ArrowLeft: () => this.choose(this.index - leap),
      ArrowRight: () => this.choose(this.index + leap),
      Home: () => this.choose(0),
      End: () => this.choose(this.last),
      '+': () => this.stage.nearer(1.25),
      '-': () => this.stage.nearer(0.8),
    }[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  /** file.html#t=2.5 */
  openAddress() {
    const match = /^#t=([-+.\deE]+)$/.exec(window.location.hash);
    if (!match || !Number.isFinite(Number(match[1]))) return false;
    this.choose(this.motion.indexNear(Number(match[1])));
    return true;
  }

  play(playing) {
    this.playing = playing;
    this.button.textContent = playing ? 'pause' : 'play';
    if (!playing) return;
    if (this.index === this.last) this.show(0);
    this.passed = this.motion.passed[this.index];
    this.before = undefined;
    requestAnimationFrame((now) => this.advance(now));
  }

  advance(now) {
    if (!this.playing) return;
    if (this.before !== undefined) this.passed += ((now - this.before) / 1000) * this.rate * this.speed;
    this.before = now;
    if (this.passed >= this.motion.passed[this.last]) {
      this.show(this.last);
      if (!this.repeat.checked) return this.play(false);
      this.passed = 0;
    }
    const index = this.motion.indexAfter(this.passed);
    if (index !== this.index) this.show(index);
    requestAnimationFrame((later) => this.advance(later));
  }

  /** As somebody wants it: what played stops. */
  choose(index) {
    this.play(false);
    this.show(index);
  }

  show(index) {
    this.index = Math.min(Math.max(index, 0), this.last);
    this.slider.value = this.index;
    const t = Numbers.value(this.motion.t(this.index), 6);
    document.getElementById('time').textContent = `t = ${t}, step ${Numbers.grouped(this.motion.step(this.index))} of ${Numbers.grouped(this.motion.steps)}`;
    this.slider.setAttribute('aria-valuetext', 't = ' + t);
    this.stage.show(this.index);
    for (const chart of this.charts) chart.show(this.index);
    this.showValues();
  }

  showValues() {
    if (!document.getElementById('all-values').open) return;
    for (const { cell, value } of this.cells) cell.textContent = Numbers.value(value(this.index), 7);
  }
}

const player = new Player(JSON.parse(document.getElementById('run').textContent));
