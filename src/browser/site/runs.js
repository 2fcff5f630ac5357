'use strict';

/// Runs, as `hbvm run --json` and `hbvm compare --json` tell of them.

/// How many digits of all positions are right in what `run --error --json` says; null if they were not asked for.
function digitsOf({error, q}) {
  const digits = (error?.digits ?? []).slice(0, q.length).filter((number) => number !== null);
  return digits.length ? Math.min(...digits) : null;
}

/// The runs of either command.
const runsOf = (found) => found.runs ?? [{...found, digits: digitsOf(found)}];

/// A table with a row for each of `items`; `columns` are pairs of a heading and of what gives an item's text.
function tableOf(columns, items) {
  const table = document.createElement('table');
  const head = table.createTHead().insertRow(), body = table.createTBody();
  for (const [name] of columns)
    head.append(Object.assign(document.createElement('th'), {textContent: name, scope: 'col'}));
  for (const item of items) {
    const row = body.insertRow();
    for (const [, of] of columns) row.insertCell().append(of(item));
  }
  return table;
}

/// Errors, right digits and time of each run.
function tableOfRuns(runs) {
  const columns = [
    ['integrator', (run) => run.resolved ?? run.method], ['max |H\u00a0−\u00a0H₀|', (run) => shortNumber(run.e_H)],
    ['max |g|', (run) => shortNumber(run.e_g)], ['hidden constraint', (run) => shortNumber(run.e_hid)],
    ['right digits', (run) => (run.digits === undefined || run.digits === null ? '' : Number(run.digits).toFixed(1))],
    ['seconds', (run) => Number(run.cpu_seconds).toPrecision(2)],
  ];
  return tableOf(columns, runs);
}
