'use strict';

/// Charts as SVG: curves on axes; and errors against the step.

function svg(tag, attributes, ...children) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/// A power of ten, written with a raised exponent.
const powerOfTen = (exponent) => '10' + [...String(exponent)].map((c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻').join('');

/// An axis from one whole power of ten to another; `logarithms` are those of what it has to hold.
function axisOfPowers(logarithms, title) {
  const low = Math.floor(Math.min(...logarithms)), high = Math.max(low + 1, Math.ceil(Math.max(...logarithms)));
  const ticks = Array.from({length: high - low + 1}, (_, i) => [low + i, powerOfTen(low + i)]);
  return {low, high, ticks, title};
}

/// What marks a point of a curve; curves that are lines have none.
function mark(kind, x, y) {
  if (kind === 'p') return svg('rect', {x: x - 3.5, y: y - 3.5, width: 7, height: 7});
  if (kind === 'lambda') return svg('path', {d: `M${x} ${y - 5}l5 8.5h-10z`});
  return svg('circle', {cx: x, cy: y, r: 4});
}

/// The axes in a frame; `across` and `up` lead from their numbers to the picture.
function drawnAxes(x, y, across, up, {left, top, right, bottom}) {
  const group = svg('g', {class: 'axes'});
  const thin = ({ticks}, most) => ticks.filter((_, i) => i % Math.ceil(ticks.length / most) === 0);
  for (const [value, text] of thin(y, Math.min(8, Math.max(2, (bottom - top) / 24))))
    group.append(svg('path', {d: `M${left} ${up(value)}H${right}`}),
      svg('text', {x: left - 6, y: up(value) + 4, 'text-anchor': 'end'}, text));
  for (const [value] of x.ticks) group.append(svg('path', {d: `M${across(value)} ${bottom}v5`}));
  for (const [value, text] of thin(x, (right - left) / 52))
    group.append(svg('text', {x: across(value), y: bottom + 19, 'text-anchor': 'middle'}, text));
  group.append(svg('path', {class: 'frame', d: `M${left} ${top}V${bottom}H${right}`}),
    svg('text', {x: (left + right) / 2, y: bottom + 40, 'text-anchor': 'middle'}, x.title),
    svg('text', {x: 4, y: 20}, y.title));
  return group;
}

/// The names of curves in their colours, in as many lines as they need.
function namesOf(curves, width) {
  const lines = [[]];
  let letters = 0;
  for (const {name, colour} of curves) {
    letters += name.length + 5;
    if (letters * 7.2 > width && lines[lines.length - 1].length) {
      lines.push([]);
      letters = name.length + 5;
    }
    lines[lines.length - 1].push(svg('tspan', {class: `colour${colour}`, fill: 'currentColor', dx: 8}, `● ${name}`));
  }
  return lines.map((names, i) => svg('text', {x: -4, y: 38 + 17 * i}, ...names));
}

/// The points of a curve in pieces without gaps.
function piecesOf(points) {
  const pieces = [[]];
  for (const point of points)
    if (point.y !== null) pieces[pieces.length - 1].push(point);
    else if (pieces[pieces.length - 1].length) pieces.push([]);
  return pieces;
}

/// A chart. An axis is {low, high, ticks, title}, where a tick is a number and its text.
/// A curve is {colour, kind, points, name}: `kind` is of what it is, "line" has no marks, "dots" no line.
/// Its points are {x, y, says}. Where y is null, the curve has a gap; where curves have names, these are told.
function chartOf({x, y, curves, width, height, label}) {
  const names = namesOf(curves.filter(({name}) => name), width);
  const box = {left: 52, top: 30 + (names.length ? 6 + 17 * names.length : 0), right: width - 18, bottom: height - 48};
  const across = (value) => box.left + 14 + (box.right - box.left - 28) * (value - x.low) / (x.high - x.low || 1);
  const up = (value) => box.bottom - (box.bottom - box.top) * (value - y.low) / (y.high - y.low);
  const placed = (at) => [across(at.x).toFixed(1), up(at.y).toFixed(1)];
  const picture = svg('svg', {viewBox: `0 0 ${width} ${height}`, width, height, class: 'chart', role: 'img',
    'aria-label': label}, drawnAxes(x, y, across, up, box), ...names);
  for (const {kind, colour, points} of curves) {
    const group = svg('g', {class: `curve colour${colour} ${kind}`});
    for (const piece of kind === 'dots' ? [] : piecesOf(points))
      group.append(svg('polyline', {points: piece.map(placed).join(' ')}));
    if (kind !== 'line')
      for (const at of points) {
        const point = mark(kind, across(at.x), up(at.y));
        if (at.says) point.append(svg('title', {}, at.says));
        group.append(point);
      }
    picture.append(group);
  }
  return picture;
}

const partsOfEnd = [['q', 'q'], ['p', 'p'], ['lambda', 'λ']];

/// A step as a fraction where it is one: 0.0078125 is 1/128.
function stepText(step) {
  const inverse = 1 / Number(step);
  return inverse > 1 && Number.isInteger(inverse) ? `1/${inverse}` : String(Number(Number(step).toPrecision(3)));
}

/// Of each method and component that has errors in what `hbvm convergence --json` tells: its points, as logarithms.
function curvesOf({methods}) {
  return methods.flatMap((method, colour) => partsOfEnd.map(([kind]) => ({
    kind, colour: colour % 6,
    points: method.points
      .map(({step, error}) => ({step, x: Math.log10(Number(step)), y: logarithmOf(error?.[kind] ?? '')}))
      .filter(({y}) => y !== null),
  }))).filter(({points}) => points.length);
}

/// The errors against the step, of a width in pixels.
function pictureOf(found, width) {
  const curves = curvesOf(found), points = curves.flatMap((curve) => curve.points);
  if (!points.length) return document.createTextNode('No error is above round-off.');
  const steps = [...new Set(points.map(({step}) => step))].sort((a, b) => a - b);
  const ticks = steps.map((step) => [Math.log10(Number(step)), stepText(step)]);
  return chartOf({
    x: {low: ticks[0][0], high: ticks[ticks.length - 1][0], ticks, title: 'step h, in the unit of time'},
    y: axisOfPowers(points.map(({y}) => y), 'greatest error of q, p, λ at the end, in their units'),
    curves, width, height: Math.round(Math.min(460, Math.max(320, 0.6 * width))),
    label: 'Errors against the step, on logarithmic axes; the table below has the orders',
  });
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
