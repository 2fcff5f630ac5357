'use strict';

/// Charts one below the other as an SVG file, as they are seen: what the style sheet says goes with them.
function pictureFile(charts) {
  const size = (name) => charts.map((chart) => Number(chart.getAttribute(name)));
  const width = Math.max(...size('width')), height = size('height').reduce((sum, one) => sum + one, 0);
  let below = 0;
  const groups = charts.map((chart) => {
    const group = svg('g', {transform: `translate(0 ${below})`}, ...chart.cloneNode(true).childNodes);
    below += Number(chart.getAttribute('height'));
    return group;
  });
  const paper = svg('rect', {width, height, class: 'paper'});
  const whole = svg('svg', {viewBox: `0 0 ${width} ${height}`, width, height, class: 'chart hidden'}, paper, ...groups);
  document.body.append(whole);
  const lines = ['stroke', 'stroke-width', 'stroke-dasharray', 'fill'];
  const copy = whole.cloneNode(true), parts = [...copy.querySelectorAll('*')];
  whole.querySelectorAll('*').forEach((part, i) => {
    const style = getComputedStyle(part);
    for (const name of part.tagName === 'text' ? [...lines, 'font-size', 'font-family'] : lines)
      parts[i].setAttribute(name, style.getPropertyValue(name));
    parts[i].removeAttribute('class');
  });
  whole.remove();
  copy.removeAttribute('class');
  return new XMLSerializer().serializeToString(copy);
}
