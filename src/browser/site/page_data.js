'use strict';

/// What a page that the program wrote has to draw.

function dataOf(page) {
  return JSON.parse(new DOMParser().parseFromString(page, 'text/html').getElementById('run').textContent);
}

/// Its charts as SVG, of a width.
function chartsOfPage({time, charts, samples}, width) {
  const axis = ({range, tics, factor}, title) => ({
    low: range[0], high: range[1], ticks: tics.map(([value, text]) => [value, Numbers.raised(text)]),
    title: factor ? `${title}, in ${Numbers.raised(factor)}` : title,
  });
  return charts.map((chart) => chartOf({
    x: axis(time, 't'), y: axis(chart, chart.title),
    curves: chart.curves.map(({name, number, column}, i) => ({
      kind: 'line', colour: i % 6, name: number === undefined ? name : `λ${number}`,
      points: samples.map((row) => {
        const y = Number(row[column]);
        return {x: Number(row[0]), y: Number.isFinite(y) ? y : null};
      }),
    })),
    width, height: 280, label: chart.title,
  }));
}
