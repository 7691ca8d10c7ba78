// Controls, read-outs, rows and tooltips around the viewer.

const byId = (id) => document.getElementById(id);

function showNumber(value) {
  if (Number.isNaN(value)) return 'NaN';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-4 ? value.toExponential(3) : value.toPrecision(4);
  return text.replace(/-/g, '−');
}

function trimmed(value) { return String(Number(value.toPrecision(4))).replace(/-/g, '−'); }

function startViewer() {
  const data = JSON.parse(byId('viewer-data').textContent);
  const viewer = new Viewer(byId('viewer'), data);
  fillTransforms(viewer);
  bindControls(viewer);
  bindKeys(viewer);
  bindRows(viewer);
  viewer.onChange = () => refresh(viewer);
  viewer.show(pairFromAddress(viewer));
}

function pairFromAddress(viewer) {
  let wanted = '';
  try { wanted = decodeURIComponent(location.hash.slice(1)); } catch { /* an address that is no name */ }
  return Math.max(0, viewer.pairs.findIndex((pair) => pair.name === wanted));
}

function fillTransforms(viewer) {
  const select = byId('transform');
  if (viewer.curve) select.add(new Option(viewer.curve.name, 'frame'));
  select.add(new Option(viewer.curve ? 'plain sRGB' : 'sRGB', 'srgb'));
  select.value = viewer.state.transform;
}

function bindControls(viewer) {
  for (const button of document.querySelectorAll('[data-mode][role=radio]')) {
    button.addEventListener('click', () => viewer.set({ mode: button.dataset.mode }));
    button.addEventListener('keydown', (event) => radioKey(event, viewer));
  }
  const hold = byId('hold'), held = (value) => () => viewer.set({ held: value });
  hold.addEventListener('pointerdown', held(true));
  for (const name of ['pointerup', 'pointerleave', 'pointercancel', 'blur']) hold.addEventListener(name, held(false));
  hold.addEventListener('keydown', (event) => { if (event.key === ' ' || event.key === 'Enter') viewer.set({ held: true }); });
  hold.addEventListener('keyup', held(false));
  byId('wipe').addEventListener('input', (event) => viewer.set({ wipe: Number(event.target.value) }));
  byId('exposure').addEventListener('input', (event) => viewer.set({ stops: Number(event.target.value) }));
  byId('exposure-auto').addEventListener('click', () => viewer.auto());
  byId('exposure-zero').addEventListener('click', () => viewer.set({ stops: 0 }));
  byId('transform').addEventListener('change', (event) => viewer.set({ transform: event.target.value }));
  byId('error').addEventListener('change', (event) => viewer.set({ error: Number(event.target.value) }));
  byId('range').addEventListener('change', (event) => viewer.setRange(Number(event.target.value)));
  byId('range-reset').addEventListener('click', () => viewer.setRange(0));
  byId('fit').addEventListener('click', () => viewer.fit());
}

function radioKey(event, viewer) {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const modes = ['side', 'wipe', 'flip'];
  const mode = modes[(modes.indexOf(viewer.state.mode) + step + 3) % 3];
  viewer.set({ mode });
  document.querySelector(`[role=radio][data-mode=${mode}]`).focus();
}

function bindKeys(viewer) {
  const actions = {
    1: () => viewer.set({ mode: 'side' }),
    2: () => viewer.set({ mode: 'wipe' }),
    3: () => viewer.set({ mode: 'flip' }),
    0: () => viewer.fit(),
    '+': () => viewer.zoomCentre(1.25),
    '=': () => viewer.zoomCentre(1.25),
    '-': () => viewer.zoomCentre(0.8),
    '[': () => viewer.set({ stops: Math.max(-12, viewer.state.stops - 0.25) }),
    ']': () => viewer.set({ stops: Math.min(12, viewer.state.stops + 0.25) }),
    f: () => viewer.set({ mode: 'flip', held: true }),
  };
  const typing = (event) => event.ctrlKey || event.metaKey || event.altKey
    || (event.target instanceof Element && event.target.matches('input:not([type=range]), select, textarea'));
  document.addEventListener('keydown', (event) => {
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || typing(event)) return;
    event.preventDefault();
    action();
  });
  document.addEventListener('keyup', (event) => { if (event.key.toLowerCase() === 'f') viewer.set({ held: false }); });
  window.addEventListener('blur', () => viewer.set({ held: false }));
}

function bindRows(viewer) {
  const open = (name, jump, map) => {
    const index = viewer.pairs.findIndex((pair) => pair.name === name);
    if (index < 0) return;
    viewer.show(index, map);
    try { history.replaceState(null, '', `#${encodeURIComponent(name)}`); } catch { /* some browsers refuse on file: */ }
    if (jump) byId('viewer').scrollIntoView({ block: 'start', behavior: 'auto' });
  };
  for (const card of document.querySelectorAll('.card')) card.addEventListener('click', () => open(card.dataset.pair, false));
  for (const engine of document.querySelectorAll('.strip button')) {
    engine.addEventListener('click', () => open(engine.dataset.pair, true, engine.dataset.map));
  }
  for (const row of document.querySelectorAll('tr[data-pair]')) {
    row.addEventListener('click', (event) => { if (!event.target.closest('.term')) open(row.dataset.pair, true, row.dataset.map); });
  }
}

// Everything of the page that follows from the viewer's state.
function refresh(viewer) {
  const { state, pair, error } = viewer;
  byId('viewer-title').textContent = pair.title;
  byId('caption').textContent = pair.caption;
  byId('panes').dataset.mode = state.mode;
  for (const button of document.querySelectorAll('[data-mode][role=radio]')) {
    const chosen = button.dataset.mode === state.mode;
    button.setAttribute('aria-checked', String(chosen));
    button.tabIndex = chosen ? 0 : -1;
  }
  for (const item of document.querySelectorAll('button[data-pair]')) {
    item.setAttribute('aria-pressed', String(item.dataset.pair === pair.name));
  }
  for (const row of document.querySelectorAll('tr[data-pair]')) row.classList.toggle('chosen', row.dataset.pair === pair.name);
  byId('hold').hidden = state.mode !== 'flip';
  byId('hold').textContent = `Hold for ${pair.labels[1]}`;
  byId('wipe-label').hidden = state.mode !== 'wipe';
  byId('wipe').value = state.wipe;
  refreshExposure(viewer);
  refreshError(viewer);
  refreshLabels(viewer);
  refreshReadout(viewer);
  byId('zoom').textContent = `${trimmed(Number((100 * state.zoom).toPrecision(3)))} %`;
  byId('error').value = String(pair.errors.indexOf(error));
}

function refreshExposure({ state, pair }) {
  const fixed = pair.space === 'display';
  for (const id of ['exposure', 'exposure-auto', 'exposure-zero', 'transform']) byId(id).disabled = fixed;
  byId('exposure').value = state.stops;
  const stops = `${state.stops > 0 ? '+' : ''}${state.stops}`.replace('-', '−');
  byId('exposure-value').textContent = fixed ? 'code values' : `${stops} stops`;
  byId('transform').value = state.transform;
}

function refreshError(viewer) {
  const { pair, error } = viewer, [low, high] = viewer.range(), select = byId('error');
  if (select.dataset.pair !== pair.name || select.options.length !== pair.errors.length) {
    select.replaceChildren(...pair.errors.map((one, index) => new Option(one.title, String(index))));
    select.dataset.pair = pair.name;
  }
  const field = byId('range');
  if (document.activeElement !== field) field.value = String(Number(high.toPrecision(4)));
  byId('range-unit').textContent = error.unit;
  byId('range-reset').disabled = !viewer.ranges.has(error);
  const { rgb, nonfinite } = viewer.maps[error.map], brush = byId('bar-canvas').getContext('2d');
  const strip = brush.createImageData(256, 1);
  for (let i = 0; i < 256; i++) strip.data.set([rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], 255], 4 * i);
  brush.putImageData(strip, 0, 0);
  byId('bad-swatch').style.background = `rgb(${nonfinite.join(' ')})`;
  byId('bad-legend').hidden = error.bad === 0;
  byId('mask-legend').hidden = pair.mask === null;
  byId('ticks').replaceChildren(...ticks(low, high).map((value) => {
    const tick = document.createElement('span');
    tick.textContent = trimmed(value);
    tick.style.left = `${(100 * (value - low)) / (high - low)}%`;
    return tick;
  }));
}

function ticks(low, high) {
  const raw = (high - low) / 5, scale = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((factor) => factor * scale).find((one) => one >= raw * (1 - 1e-9));
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i <= high / step + 1e-9; i++) found.push(i * step);
  return found;
}

function refreshLabels(viewer) {
  const { pair, error, state } = viewer, [tested, truth] = pair.labels;
  const names = { tested, truth, error: error.title };
  if (state.mode === 'wipe') names.tested = `${tested} | ${truth}`;
  if (state.mode === 'flip') names.tested = state.held ? truth : tested;
  for (const pane of viewer.panes) {
    const model = pane.name === 'error' ? error : pair[viewer.shownImage(pane)];
    pane.figure.querySelector('[data-label]').textContent = names[pane.name];
    pane.canvas.setAttribute('aria-label', `${pair.title}: ${names[pane.name]}`);
    const bad = pane.figure.querySelector('[data-bad]');
    bad.hidden = model.bad === 0;
    bad.textContent = `✕ ${model.bad} not finite`;
  }
  document.querySelector('[data-value-label=tested]').textContent = tested;
  document.querySelector('[data-value-label=truth]').textContent = truth;
  document.querySelector('[data-value-label=error]').textContent = error.title;
}

function refreshReadout(viewer) {
  const values = viewer.valuesUnderCursor(), { pair, error, state } = viewer;
  byId('place').textContent = values
    ? `x ${state.cursor[0]}, y ${state.cursor[1]}${values.masked ? ' (nothing to judge here)' : ''}` : 'point at a picture';
  for (const name of ['tested', 'truth', 'difference', 'error']) {
    const cell = document.querySelector(`[data-value=${name}]`);
    if (!values) { cell.textContent = '–'; continue; }
    cell.replaceChildren(...values[name].map((value) => {
      const item = document.createElement('span');
      item.className = Number.isFinite(value) ? 'channel' : 'channel failed';
      item.textContent = showNumber(value);
      return item;
    }));
    const unit = name === 'error' ? error.unit : pair.unit;
    if (unit) cell.append(` ${unit}`);
  }
}

// One tooltip for the page; it opens on hovering and on keyboard focus, and closes with Escape.
function startTips() {
  const tip = document.createElement('div');
  tip.id = 'tip';
  tip.role = 'tooltip';
  tip.hidden = true;
  document.body.append(tip);
  let owner = null;
  const close = () => {
    if (owner) owner.removeAttribute('aria-describedby');
    owner = null;
    tip.hidden = true;
  };
  const open = (event) => {
    const found = event.target instanceof Element ? event.target.closest('[data-tip]') : null;
    if (found === owner) return;
    close();
    if (!found) return;
    owner = found;
    tip.textContent = found.dataset.tip;
    tip.hidden = false;
    found.setAttribute('aria-describedby', 'tip');
    const box = found.getBoundingClientRect(), own = tip.getBoundingClientRect();
    const left = Math.max(8, Math.min(box.left, document.documentElement.clientWidth - own.width - 8));
    const above = box.top - own.height - 6;
    tip.style.left = `${left}px`;
    tip.style.top = `${above > 4 ? above : box.bottom + 6}px`;
  };
  document.addEventListener('pointerover', open);
  document.addEventListener('focusin', (event) => { if (event.target.matches(':focus-visible')) open(event); });
  document.addEventListener('focusout', close);
  document.addEventListener('scroll', close, { passive: true, capture: true });
  document.addEventListener('keydown', (event) => { if (event.key === 'Escape') close(); });
}

startTips();
if (byId('viewer')) startViewer();
