'use strict';

/// Errors against the step on logarithmic axes, as `hbvm convergence --json` tells of them.

const partsOfEnd = [['q', 'q'], ['p', 'p'], ['lambda', 'λ']];

function svg(tag, attributes, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/// A power of ten, written with a raised exponent.
const powerOfTen = (exponent) => '10' + [...String(exponent)].map((c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻').join('');

/// A step as a fraction where it is one: 0.0078125 is 1/128.
function stepText(step) {
  const inverse = 1 / Number(step);
  return inverse > 1 && Number.isInteger(inverse) ? `1/${inverse}` : String(Number(Number(step).toPrecision(3)));
}

/// What marks the points of q, p and lambda.
function mark(part, x, y) {
  if (part === 'q') return svg('circle', {cx: x, cy: y, r: 4});
  if (part === 'p') return svg('rect', {x: x - 3.5, y: y - 3.5, width: 7, height: 7});
  return svg('path', {d: `M${x} ${y - 5}l5 8.5h-10z`});
}

/// Of each method and component that has errors: its points {x, y}, which are logarithms.
function curvesOf({methods}) {
  return methods.flatMap((method, colour) => partsOfEnd.map(([part]) => ({
    part, colour: colour % 6,
    points: method.points
      .map(({step, error}) => ({step, x: Math.log10(Number(step)), y: logarithmOf(error?.[part] ?? '')}))
      .filter(({y}) => y !== null),
  }))).filter(({points}) => points.length);
}

/// Axes with their ticks and labels; x and y are functions from logarithms to the picture.
function axes(x, y, steps, [low, high], {width, left, top, right, bottom}) {
  const group = svg('g', {class: 'axes'});
  const every = Math.ceil((high - low) / 8), thin = Math.ceil(steps.length * 52 / (right - left));
  for (let power = low; power <= high; power += every)
    group.append(svg('path', {d: `M${left} ${y(power)}H${right}`}),
      svg('text', {x: left - 6, y: y(power) + 4, 'text-anchor': 'end'}, powerOfTen(power)));
  steps.forEach((step, i) => {
    const at = x(Math.log10(Number(step)));
    group.append(svg('path', {d: `M${at} ${bottom}v5`}));
    if (i % thin === 0) group.append(svg('text', {x: at, y: bottom + 19, 'text-anchor': 'middle'}, stepText(step)));
  });
  group.append(svg('path', {class: 'frame', d: `M${left} ${top}V${bottom}H${right}`}),
    svg('text', {x: (left + right) / 2, y: bottom + 40, 'text-anchor': 'middle'}, 'step h, in the unit of time'),
    svg('text', {x: 4, y: top - 10}, 'greatest error of q, p, λ at the end, in their units'));
  return group;
}

/// The picture, of a width in pixels.
function pictureOf(found, width) {
  const curves = curvesOf(found), points = curves.flatMap((curve) => curve.points);
  if (!points.length) return document.createTextNode('No error is above round-off.');
  const steps = [...new Set(points.map(({step}) => step))].sort((a, b) => a - b);
  const height = Math.round(Math.min(460, Math.max(320, 0.6 * width)));
  const box = {width, left: 52, top: 30, right: width - 18, bottom: height - 48};
  const range = [Math.floor(Math.min(...points.map(({y}) => y))), Math.ceil(Math.max(...points.map(({y}) => y)))];
  if (range[0] === range[1]) ++range[1];
  const ends = [steps[0], steps[steps.length - 1]].map((step) => Math.log10(Number(step)));
  const x = (value) => box.left + 14 + (box.right - box.left - 28) * (value - ends[0]) / (ends[1] - ends[0] || 1);
  const y = (value) => box.bottom - (box.bottom - box.top) * (value - range[0]) / (range[1] - range[0]);
  const picture = svg('svg', {viewBox: `0 0 ${width} ${height}`, width, height, class: 'chart', role: 'img',
    'aria-label': 'Errors against the step, on logarithmic axes; the table below has the orders'});
  picture.append(axes(x, y, steps, range, box));
  for (const {part, colour, points: of} of curves)
    picture.append(svg('g', {class: `curve colour${colour} ${part}`},
      svg('polyline', {points: of.map((point) => `${x(point.x)},${y(point.y)}`).join(' ')}),
      ...of.map((point) => mark(part, x(point.x), y(point.y)))));
  return picture;
}

/// The legend: a row for each method, with the order of each component, which is the slope of its curve.
function legendOf({methods}) {
  const several = new Set(methods.map(({precision}) => precision)).size > 1;
  const swatch = (colour, part) => svg('svg', {class: 'swatch', width: 34, height: 14, 'aria-hidden': true},
    svg('g', {class: `curve colour${colour} ${part}`}, svg('polyline', {points: '1,7 33,7'}), mark(part, 17, 7)));
  const cell = (part) => ({method, colour}) => {
    const order = method.orders?.[part], box = document.createElement('span');
    if (!method.points.some(({error}) => logarithmOf(error?.[part] ?? '') !== null)) return '';
    box.append(swatch(colour, part),
      order ? ` ${Number(order.rate).toFixed(2)} ± ${Number(order.uncertainty).toPrecision(1)}` : ' none');
    return box;
  };
  const columns = [
    ['method', ({method}) => method.resolved + (several ? `, ${method.precision}` : '')],
    ...partsOfEnd.map(([part, name]) => [`order of ${name}`, cell(part)]),
  ];
  return tableOf(columns, methods.map((method, i) => ({method, colour: i % 6})));
}

/// Shows what the command found in a box, as wide as the box.
function showConvergence(found, box) {
  box.replaceChildren(pictureOf(found, Math.min(760, box.clientWidth)), legendOf(found));
}
