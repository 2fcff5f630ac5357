'use strict';

/// Sliders in a box: of numbers that a command sets, by factors from 1/4 to 4; and of the start, which the text has.
class Sliders {
  static most = 12;

  constructor(box) {
    this.box = box;
    this.spans = new Map();
  }

  /// Forgets from where to where the start could be moved.
  forget() {
    this.spans.clear();
  }

  /// `numbers` are {path, number, about}, `set` has those that are other ones, {path: number}.
  /// `starts` are {path, number, reach}.
  show(numbers, set, starts) {
    const focused = document.activeElement?.dataset?.path;
    const factors = numbers.slice(0, 8).map(({path, number, about}) => {
      const slider = {min: -2, max: 2, step: 0.05, value: path in set ? Math.log2(Number(set[path]) / number) : 0};
      return this.row(path, about, slider, {number});
    });
    const others = starts.map(({path, number, reach}) =>
      this.row(path, '', this.span(path, number, reach), {start: true}));
    this.box.replaceChildren(...[...factors, ...others].slice(0, Sliders.most));
    if (focused) [...this.box.querySelectorAll('input')].find(({dataset}) => dataset.path === focused)?.focus();
  }

  /// Of a number of the start: as it was, as long as it holds the number.
  span(path, number, reach) {
    const before = this.spans.get(path);
    const step = Numbers.roundBelow(reach / 40), middle = multipleOf(step, number);
    const span = before && before.min <= number && number <= before.max
      ? before : {min: multipleOf(step, middle - 40 * step), max: multipleOf(step, middle + 40 * step), step};
    this.spans.set(path, span);
    return {...span, value: number};
  }

  row(path, about, values, data) {
    const row = Object.assign(document.createElement('label'), {className: 'slider', title: about ?? ''});
    const slider = Object.assign(document.createElement('input'), {type: 'range', ...values});
    Object.assign(slider.dataset, {path, ...data});
    const value = document.createElement('output');
    const tell = () => { value.textContent = this.valueAt(slider); };
    slider.addEventListener('input', tell);
    row.append(Object.assign(document.createElement('span'), {textContent: path}), slider, value);
    // Where a slider stands between two of its steps, the number is told as it is.
    if (data.start) value.textContent = Number(values.value.toPrecision(4));
    else tell();
    return row;
  }

  valueAt({dataset, value}) {
    return String(Number((dataset.start ? Number(value) : dataset.number * 2 ** value).toPrecision(4)));
  }

  /// What factors change: {path: value}.
  changes() {
    const set = {};
    for (const slider of this.box.querySelectorAll('input:not([data-start])'))
      if (Number(slider.value) !== 0) set[slider.dataset.path] = this.valueAt(slider);
    return set;
  }
}
