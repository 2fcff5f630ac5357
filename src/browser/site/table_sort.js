// A click on the heading of a table sorts its rows, numbers by their size and texts by their letters.
'use strict';

/** What a cell sorts by: its number, if it begins with one. */
function sortKey(row, column) {
  const text = row.cells[column].textContent.trim();
  const number = parseFloat(text);
  return Number.isNaN(number) ? text.toLowerCase() : number;
}

/** Numbers before texts, and what is empty last. */
function compareKeys(a, b) {
  if (a === '' || b === '') return a === b ? 0 : a === '' ? 1 : -1;
  if (typeof a !== typeof b) return typeof a === 'number' ? -1 : 1;
  return a < b ? -1 : a > b ? 1 : 0;
}

for (const table of document.querySelectorAll('table.sortable')) {
  const headings = [...table.tHead.rows[0].cells];
  headings.forEach((heading, column) => heading.addEventListener('click', () => {
    const direction = heading.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
    const rows = [...table.tBodies[0].rows];
    rows.sort((x, y) => direction * compareKeys(sortKey(x, column), sortKey(y, column)));
    table.tBodies[0].append(...rows);
    for (const other of headings) other.setAttribute('aria-sort', 'none');
    heading.setAttribute('aria-sort', direction > 0 ? 'ascending' : 'descending');
  }));
}
