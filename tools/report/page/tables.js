// Tables are sorted by a click on a heading: by data-order where a cell has one, as numbers where all are.
'use strict';

for (const table of document.querySelectorAll('.sortable table')) {
  const body = table.tBodies[0];
  [...table.tHead.rows[0].cells].forEach((heading, column) => {
    const button = document.createElement('button');
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener('click', () => {
      const descending = heading.getAttribute('aria-sort') === 'ascending';
      for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
      heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
      const key = row => row.cells[column].dataset.order ?? row.cells[column].textContent;
      const compare = (a, b) => (a !== '' && b !== '' && isFinite(a) && isFinite(b)) ? a - b : a.localeCompare(b);
      const rows = [...body.rows].sort((a, b) => compare(key(a), key(b)));
      body.append(...(descending ? rows.reverse() : rows));
    });
  });
}
