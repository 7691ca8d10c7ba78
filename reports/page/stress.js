'use strict';
// Fills the grid for the chosen format and shows the chosen cell; nothing is computed here.
(() => {
const data = JSON.parse(document.getElementById('data').textContent);
const grid = document.getElementById('grid'), panel = document.getElementById('chosen');

function element(tag, text, attributes = {}) {
    const made = document.createElement(tag);
    if (text !== null) made.textContent = text;
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    return made;
}

function show(fn, regime, cell, button) {
    for (const other of grid.querySelectorAll('[aria-pressed=true]')) other.setAttribute('aria-pressed', 'false');
    button.setAttribute('aria-pressed', 'true');
    panel.replaceChildren(element('h2', `${fn.name}, ${regime.name} (${fn.file})`));
    const facts = element('dl', null, { class: 'facts' });
    const rows = [['regime', `${regime.meaning}; ${cell.lanes} inputs`], ['got', cell.got], ['exact (float64)', cell.exact],
        ['relative error', cell.relative], ['absolute error', cell.absolute], ['digits kept', String(cell.digits)],
        ['attainable', `${cell.attainable}${cell.inherent ? ': the loss is the inputs\' own rounding' : ''}`],
        ['faults', cell.counts], ['safe domain', fn.safe]];
    for (const [name, text] of rows) if (text) facts.append(element('dt', name), element('dd', text));
    panel.append(facts, element('code', cell.command));
}

function draw() {
    const format = document.querySelector('input[name=format]:checked').value;
    const head = element('tr', null);
    head.append(element('th', 'function'));
    for (const regime of data.regimes) {
        const column = element('th', null, { scope: 'col', title: regime.meaning });
        column.append(element('span', regime.name));
        head.append(column);
    }
    const thead = element('thead', null), tbody = element('tbody', null);
    thead.append(head);
    for (const fn of data.functions) {
        if (!(format in fn.cells)) continue;
        const row = element('tr', null);
        row.append(element('th', fn.name, { scope: 'row', title: fn.safe || fn.file }));
        fn.cells[format].forEach((cell, i) => {
            const place = element('td', null);
            if (cell && cell.command) {
                const look = cell.fault ? 'fault' : `d${Math.min(7, Math.floor(cell.digits))}${cell.inherent ? ' inherent' : ''}`;
                const button = element('button', cell.text, { class: `digits ${look}`, 'aria-pressed': 'false', type: 'button' });
                button.addEventListener('click', () => show(fn, data.regimes[i], cell, button));
                place.append(button);
            }
            row.append(place);
        });
        tbody.append(row);
    }
    grid.replaceChildren(thead, tbody);
}

for (const input of document.querySelectorAll('input[name=format]')) input.addEventListener('change', draw);
draw();
})();
