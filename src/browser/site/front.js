'use strict';

/// The front page's pendulum: four runs, one after the other, each a row of a table.

const rows = [
  ['Runge-Kutta 4', 'rk4', 'double'], ['HBVM(10,5)', 'hbvm:10,5', 'double'], ['HBVM(20,10)', 'hbvm:20,10', '34'],
  ['HBVM(32,16)', 'hbvm:32,16', '50'],
];

async function show() {
  const table = tableOf([
    ['method', ([name]) => name], ['digits used', ([,, precision]) => (precision === 'double' ? '16' : precision)],
    ['error of the energy', () => '…'], ['right digits', () => '…'],
  ], rows);
  document.getElementById('digits').replaceChildren(table);
  for (const [i, [, method, precision]] of rows.entries()) {
    const row = table.tBodies[0].rows[i];
    const words = ['run', 'simple_pendulum', '--method', method, '--step', '1/8', '--until', '10'];
    const result = await new Engine().run([...words, '--precision', precision, '--error', '--json']);
    if (result.code !== 0) {
      row.cells[2].textContent = result.err.replace('hbvm: ', '');
      continue;
    }
    const run = JSON.parse(result.out);
    row.cells[2].textContent = shortNumber(run.e_H);
    row.cells[3].textContent = digitsOf(run).toFixed(1);
  }
}

window.addEventListener('load', show);
