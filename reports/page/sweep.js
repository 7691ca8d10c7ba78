'use strict';
// Draws the plots for the chosen view and metric, in the colours of the page; nothing is computed here.
(() => {
const plots = JSON.parse(document.getElementById('plots').textContent);
const dark = matchMedia('(prefers-color-scheme: dark)');
const config = {
    displaylogo: false,
    responsive: true,
    showSendToCloud: false,
    plotlyServerURL: '',
    modeBarButtonsToRemove: ['select2d', 'lasso2d', 'autoScale2d'],
};

const chosen = name => document.querySelector(`input[name=${name}]:checked`).value;
const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// "ink" stands for the page's text colour, which the data cannot know.
function inked(value, ink) {
    if (value === 'ink') return ink;
    if (Array.isArray(value)) return value.map(item => inked(item, ink));
    if (value === null || typeof value !== 'object') return value;
    return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, inked(item, ink)]));
}

function layout(figure) {
    const ink = colour('--ink'), line = colour('--line'), panel = colour('--panel');
    const axis = {
        gridcolor: line, linecolor: line, zeroline: false, tickcolor: line, automargin: true, exponentformat: 'power',
    };
    return {
        paper_bgcolor: panel, plot_bgcolor: panel, font: { color: ink, family: 'system-ui, sans-serif', size: 13 },
        margin: { l: 70, r: 44, t: 10, b: 50 }, hovermode: 'closest',
        hoverlabel: { bgcolor: panel, bordercolor: line, font: { color: ink }, align: 'left' },
        modebar: { orientation: 'v' },  // beside the plot: above it, it would lie on the legend
        legend: { orientation: 'h', y: 1.02, yanchor: 'bottom' },
        xaxis: { ...axis, ...figure.layout.xaxis }, yaxis: { ...axis, ...figure.layout.yaxis },
    };
}

async function draw() {
    const view = chosen('view'), metric = chosen('metric');
    for (const table of document.querySelectorAll('[data-view]')) {
        table.hidden = table.dataset.view !== view || table.dataset.metric !== metric;
    }
    for (const place of document.querySelectorAll('.plot')) {
        const figure = plots[place.dataset.effect][view]?.[metric];
        place.hidden = !figure;
        if (figure) await Plotly.react(place, inked(figure.data, colour('--ink')), layout(figure), config);
    }
    document.body.dataset.shown = `${view} ${metric}`;
}

for (const input of document.querySelectorAll('.choices input')) input.addEventListener('change', draw);
dark.addEventListener('change', draw);
draw();
})();
