// The viewer: three panes that show the same part of a pair's pictures.
// One state, one function that draws it; every control changes the state and asks for a drawing.

class Viewer {
  constructor(root, data) {
    this.root = root;
    this.pairs = data.pairs;
    this.curve = data.curve;
    this.maps = Object.fromEntries(Object.entries(data.maps).map(
      ([name, map]) => [name, { rgb: hexBytes(map.rgb), nonfinite: map.nonfinite }]));
    this.decoded = new Map();
    this.ranges = new Map();
    this.state = {
      pair: 0, error: 0, mode: 'side', stops: 0, transform: data.curve ? 'frame' : 'srgb',
      wipe: 0.5, held: false, zoom: 1, x: 0.5, y: 0.5, cursor: null,
    };
    this.onChange = () => {};
    this.panes = ['tested', 'truth', 'error'].map((name) => {
      const figure = root.querySelector(`[data-pane="${name}"]`);
      return { name, figure, canvas: figure.querySelector('canvas'), store: document.createElement('canvas'), key: '' };
    });
    this.listen();
    new ResizeObserver(() => this.draw()).observe(root.querySelector('#panes'));
  }

  get pair() { return this.pairs[this.state.pair]; }
  get error() { return this.pair.errors[this.state.error]; }
  get content() { const found = this.decoded.get(this.state.pair); return found && found.tested ? found : null; }

  set(change) {
    Object.assign(this.state, change);
    this.onChange();
    this.draw();
  }

  // Open a pair with the error map that is asked for by name, or with the one that is shown now; else its first.
  async show(index, map) {
    const sameSize = this.pairs[index].width === this.pair.width && this.pairs[index].height === this.pair.height;
    const found = [map, this.error.name].map((name) => this.pairs[index].errors.findIndex((one) => one.name === name));
    const error = found.find((place) => place >= 0) ?? 0;
    const change = { pair: index, error, cursor: sameSize ? this.state.cursor : null };
    this.set(sameSize ? change : { ...change, zoom: 1, x: 0.5, y: 0.5 });
    const message = this.root.querySelector('#message');
    message.classList.remove('failed');
    if (!this.decoded.has(index)) this.decoded.set(index, decodePair(this.pairs[index]));
    try {
      const waiting = this.decoded.get(index);
      if (waiting instanceof Promise) {
        message.textContent = 'Unpacking the pictures…';
        this.decoded.set(index, await waiting);
      }
      if (this.state.pair === index) message.textContent = '';
    } catch (problem) {
      this.decoded.delete(index);
      if (this.state.pair !== index) return;
      message.textContent = `The pictures cannot be shown: ${problem.message}`;
      message.classList.add('failed');
      return;
    }
    if (this.state.pair === index) this.set({});
  }

  // The error map's range: as the report chose it, or as the reader did.
  range() {
    const { low, high } = this.error, chosen = this.ranges.get(this.error);
    if (!chosen) return [low, high];
    return this.error.scale === 'signed' ? [-chosen, chosen] : [low, chosen];
  }

  setRange(high) {
    if (high > 0 && Number.isFinite(high)) this.ranges.set(this.error, high);
    else this.ranges.delete(this.error);
    this.set({});
  }

  auto() {
    if (this.content && this.pair.space !== 'display') {
      const stops = Math.round(4 * autoExposure(this.content)) / 4;
      this.set({ stops: Math.max(-12, Math.min(12, stops)) });
    }
  }

  // Drawing -------------------------------------------------------------------------------------------------

  draw() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => { this.asked = false; this.drawNow(); });
  }

  drawNow() {
    const content = this.content;
    for (const pane of this.panes) this.size(pane);
    if (!content) return;
    for (const pane of this.panes) this.paint(pane, content);
    for (const pane of this.panes) if (pane.figure.offsetParent) this.compose(pane);
    this.root.dataset.shown = this.pair.name;
  }

  size(pane) {
    const width = pane.canvas.clientWidth, ratio = window.devicePixelRatio || 1;
    if (!width) return;
    const limit = Math.max(260, Math.min(window.innerHeight * 0.78, 1100));
    const height = Math.round(Math.min((width * this.pair.height) / this.pair.width, limit));
    const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (pane.canvas.width !== w || pane.canvas.height !== h) {
      pane.canvas.width = w;
      pane.canvas.height = h;
      pane.canvas.style.height = `${height}px`;
    }
  }

  // Colours at the picture's own resolution, made again only where something changed.
  paint(pane, content) {
    const { width, height } = this.pair, { stops, transform } = this.state, [low, high] = this.range();
    const key = pane.name === 'error'
      ? `${this.state.pair}/${this.state.error}/${low}/${high}`
      : `${this.state.pair}/${this.pair.space === 'display' ? 'display' : `${stops}/${transform}`}`;
    if (pane.key === key) return;
    pane.key = key;
    pane.store.width = width;
    pane.store.height = height;
    const brush = pane.store.getContext('2d'), target = brush.createImageData(width, height);
    if (pane.name === 'error') {
      paintHeatmap(target, content.errors[this.state.error], content.mask, this.maps[this.error.map], low, high);
    } else {
      const image = content[pane.name];
      const table = displayTable(this.displayFunction(), image.scale * (this.pair.space === 'display' ? 1 : 2 ** stops));
      paintPicture(target, image, content.mask, table);
    }
    brush.putImageData(target, 0, 0);
  }

  displayFunction() {
    if (this.pair.space === 'display') return (value) => value;
    return this.state.transform === 'frame' ? curveFunction(this.curve) : encodeSrgb;
  }

  // Scale (device pixels per picture pixel) and offset of a pane.
  placement(pane) {
    const { canvas } = pane, { width, height } = this.pair;
    const scale = Math.min(canvas.width / width, canvas.height / height) * this.state.zoom;
    return {
      scale,
      left: canvas.width / 2 - this.state.x * width * scale,
      top: canvas.height / 2 - this.state.y * height * scale,
    };
  }

  compose(pane) {
    const brush = pane.canvas.getContext('2d'), at = this.placement(pane);
    const { mode, wipe, held } = this.state;
    const put = (store) => {
      brush.imageSmoothingEnabled = at.scale < 1;
      brush.drawImage(store, at.left, at.top, this.pair.width * at.scale, this.pair.height * at.scale);
    };
    brush.clearRect(0, 0, pane.canvas.width, pane.canvas.height);
    if (pane.name === 'tested' && mode === 'flip') put(this.panes[held ? 1 : 0].store);
    else put(pane.store);
    if (pane.name === 'tested' && mode === 'wipe') {
      const x = Math.round(wipe * pane.canvas.width);
      brush.save();
      brush.beginPath();
      brush.rect(x, 0, pane.canvas.width - x, pane.canvas.height);
      brush.clip();
      brush.clearRect(0, 0, pane.canvas.width, pane.canvas.height);
      put(this.panes[1].store);
      brush.restore();
      this.divider(brush, x, pane.canvas.height);
    }
    this.rings(brush, pane, at);
    this.cross(brush, at);
  }

  divider(brush, x, height) {
    const ratio = window.devicePixelRatio || 1;
    brush.fillStyle = '#000';
    brush.fillRect(x - 1.5 * ratio, 0, 3 * ratio, height);
    brush.fillStyle = '#fff';
    brush.fillRect(x - 0.5 * ratio, 0, ratio, height);
    brush.beginPath();
    brush.arc(x, height / 2, 7 * ratio, 0, 7);
    brush.fill();
    brush.strokeStyle = '#000';
    brush.stroke();
  }

  // A ring around each of the first pixels that are not finite: one pixel alone would not be seen.
  rings(brush, pane, at) {
    const model = pane.name === 'error' ? this.error : this.pair[this.shownImage(pane)];
    const ratio = window.devicePixelRatio || 1;
    for (const [x, y] of model.places) {
      const radius = Math.max(7 * ratio, at.scale);
      brush.beginPath();
      brush.arc(at.left + (x + 0.5) * at.scale, at.top + (y + 0.5) * at.scale, radius, 0, 7);
      brush.lineWidth = 3 * ratio;
      brush.strokeStyle = '#000';
      brush.stroke();
      brush.lineWidth = 1.5 * ratio;
      brush.strokeStyle = '#fff';
      brush.stroke();
    }
  }

  cross(brush, at) {
    const cursor = this.state.cursor;
    if (!cursor) return;
    const ratio = window.devicePixelRatio || 1, reach = 7 * ratio;
    const x = at.left + (cursor[0] + 0.5) * at.scale, y = at.top + (cursor[1] + 0.5) * at.scale;
    const half = Math.max(at.scale / 2, 2 * ratio);
    for (const [width, colour] of [[3 * ratio, '#000'], [ratio, '#fff']]) {
      brush.lineWidth = width;
      brush.strokeStyle = colour;
      brush.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        brush.moveTo(x + dx * half, y + dy * half);
        brush.lineTo(x + dx * (half + reach), y + dy * (half + reach));
      }
      brush.stroke();
    }
  }

  shownImage(pane) {
    return pane.name === 'tested' && this.state.mode === 'flip' && this.state.held ? 'truth' : pane.name;
  }

  // Reading -------------------------------------------------------------------------------------------------

  valuesUnderCursor() {
    const content = this.content, cursor = this.state.cursor;
    if (!content || !cursor) return null;
    const index = cursor[1] * this.pair.width + cursor[0];
    const three = (image) => [0, 1, 2].map((channel) => valueAt(image, index, channel));
    const tested = three(content.tested), truth = three(content.truth);
    return {
      tested, truth, difference: tested.map((value, i) => value - truth[i]),
      error: [valueAt(content.errors[this.state.error], index)],
      masked: content.mask !== null && !content.mask[index],
    };
  }

  // Input ---------------------------------------------------------------------------------------------------

  listen() {
    for (const pane of this.panes) {
      const canvas = pane.canvas;
      canvas.addEventListener('wheel', (event) => {
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 18 : 1;
        this.zoomAt(pane, this.devicePoint(pane, event), Math.exp(-event.deltaY * lines * 0.002));
      }, { passive: false });
      canvas.addEventListener('dblclick', () => this.fit());
      canvas.addEventListener('pointerdown', (event) => this.grab(pane, event));
      canvas.addEventListener('pointermove', (event) => this.move(pane, event));
      for (const name of ['pointerup', 'pointercancel']) {
        canvas.addEventListener(name, () => { this.drag = null; canvas.classList.remove('dragging'); });
      }
      canvas.addEventListener('pointerleave', () => { if (!this.drag) this.set({ cursor: null }); });
      canvas.addEventListener('keydown', (event) => this.arrow(event));
    }
  }

  devicePoint(pane, event) {
    const box = pane.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) * (pane.canvas.width / box.width),
      (event.clientY - box.top) * (pane.canvas.height / box.height)];
  }

  picturePoint(pane, [x, y]) {
    const at = this.placement(pane);
    return [(x - at.left) / at.scale, (y - at.top) / at.scale];
  }

  fit() { this.set({ zoom: 1, x: 0.5, y: 0.5 }); }

  zoomAt(pane, point, factor) {
    const { width, height } = this.pair, [px, py] = this.picturePoint(pane, point);
    const zoom = Math.min(Math.max(width, height) / 4, Math.max(0.5, this.state.zoom * factor));
    const change = this.state.zoom / zoom;
    const x = px / width + (this.state.x - px / width) * change;
    const y = py / height + (this.state.y - py / height) * change;
    this.set({ zoom, x: clampUnit(x), y: clampUnit(y) });
  }

  zoomCentre(factor) {
    const pane = this.panes[0];
    this.zoomAt(pane, [pane.canvas.width / 2, pane.canvas.height / 2], factor);
  }

  grab(pane, event) {
    if (event.button !== 0) return;
    pane.canvas.setPointerCapture(event.pointerId);
    const point = this.devicePoint(pane, event), ratio = window.devicePixelRatio || 1;
    const onDivider = this.state.mode === 'wipe' && pane.name === 'tested'
      && Math.abs(point[0] - this.state.wipe * pane.canvas.width) < 12 * ratio;
    this.drag = { point, wipe: onDivider, x: this.state.x, y: this.state.y };
    if (!onDivider) pane.canvas.classList.add('dragging');
  }

  move(pane, event) {
    const point = this.devicePoint(pane, event), { width, height } = this.pair;
    if (this.drag && this.drag.wipe) {
      this.set({ wipe: clampUnit(point[0] / pane.canvas.width) });
    } else if (this.drag) {
      const { scale } = this.placement(pane);
      this.set({
        x: clampUnit(this.drag.x - (point[0] - this.drag.point[0]) / (scale * width)),
        y: clampUnit(this.drag.y - (point[1] - this.drag.point[1]) / (scale * height)),
      });
    } else {
      const [x, y] = this.picturePoint(pane, point).map(Math.floor);
      this.set({ cursor: x >= 0 && y >= 0 && x < width && y < height ? [x, y] : null });
    }
  }

  arrow(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const { width, height } = this.pair;
    if (event.shiftKey) {
      this.set({
        x: clampUnit(this.state.x + (0.1 * step[0]) / this.state.zoom),
        y: clampUnit(this.state.y + (0.1 * step[1]) / this.state.zoom),
      });
      return;
    }
    const from = this.state.cursor || [Math.floor(this.state.x * width), Math.floor(this.state.y * height)];
    this.set({
      cursor: [Math.max(0, Math.min(width - 1, from[0] + step[0])), Math.max(0, Math.min(height - 1, from[1] + step[1]))],
    });
  }
}

function clampUnit(value) { return Math.min(1, Math.max(0, value)); }
