// Pictures as half floats: decoding them when they are first shown, and turning them into colours by table.
// A half float has 65536 values, so a display transform is a table of that length.

const HALF_VALUE = (() => {
  const table = new Float32Array(65536);
  for (let bits = 0; bits < 65536; bits++) {
    const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
    if (exponent === 31) table[bits] = fraction ? NaN : sign * Infinity;
    else if (exponent === 0) table[bits] = sign * fraction * 2 ** -24;
    else table[bits] = sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
  }
  return table;
})();

const MASKED_COLOUR = [128, 128, 128];
const PICTURE_NONFINITE = [255, 0, 255];

function bytesOfBlob(index) {
  const text = atob(document.getElementById(`blob-${index}`).textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflateBlob(index, size) {
  const packed = bytesOfBlob(index);
  let bytes;
  if (typeof DecompressionStream === 'function') {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
    bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  } else {
    bytes = inflateZlib(packed, size);
  }
  if (bytes.length !== size) throw new Error(`expected ${size} bytes of picture data, found ${bytes.length}`);
  return bytes;
}

// The reverse of embedded_data.pack_image: bits of half floats, one plane after the other.
async function decodeImage(model, width, height) {
  const count = width * height * model.channels;
  const bytes = await inflateBlob(model.blob, 2 * count);
  const halves = new Uint16Array(count);
  let previous = 0;
  for (let i = 0; i < count; i++) {
    const zigzag = (bytes[i] << 8) | bytes[count + i];
    previous = (previous + ((zigzag >> 1) ^ -(zigzag & 1))) & 0xffff;
    halves[i] = previous;
  }
  return { halves, scale: 2 ** model.exponent, model, plane: width * height };
}

async function decodePair(pair) {
  const { width, height } = pair;
  const images = await Promise.all(
    [pair.tested, pair.truth, ...pair.errors].map((model) => decodeImage(model, width, height)));
  const mask = pair.mask === null ? null : await inflateBlob(pair.mask, width * height);
  return { tested: images[0], truth: images[1], errors: images.slice(2), mask };
}

function valueAt(image, index, channel = 0) {
  return HALF_VALUE[image.halves[index + channel * image.plane]] * image.scale;
}

function encodeSrgb(value) {
  if (!(value > 0)) return 0;
  if (value >= 1) return 1;
  return value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
}

function curveFunction(curve) {
  const { x, y } = curve, last = x.length - 1, floor = 2 ** x[0];
  return (value) => {
    if (!(value > 0)) return 0;
    if (value < floor) return (y[0] * value) / floor;
    const log = Math.log2(value);
    if (log >= x[last]) return y[last];
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (x[middle] <= log) low = middle; else high = middle;
    }
    const t = (log - x[low]) / (x[high] - x[low]);
    return y[low] + t * (y[high] - y[low]);
  };
}

// Display transform: bits of a half float to a code value of 0 to 255, 256 for what is not finite.
function displayTable(transform, gain) {
  const table = new Uint16Array(65536);
  for (let bits = 0; bits < 65536; bits++) {
    const value = HALF_VALUE[bits] * gain;
    table[bits] = Number.isFinite(value) ? Math.round(255 * Math.min(1, Math.max(0, transform(value)))) : 256;
  }
  return table;
}

function paintPicture(target, image, mask, table) {
  const { halves, plane } = image, data = target.data;
  for (let i = 0, o = 0; i < plane; i++, o += 4) {
    let red = table[halves[i]], green = table[halves[i + plane]], blue = table[halves[i + 2 * plane]];
    if (mask && !mask[i]) [red, green, blue] = MASKED_COLOUR;
    else if (red > 255 || green > 255 || blue > 255) [red, green, blue] = PICTURE_NONFINITE;
    data[o] = red;
    data[o + 1] = green;
    data[o + 2] = blue;
    data[o + 3] = 255;
  }
}

function paintHeatmap(target, image, mask, colours, low, high) {
  const table = new Uint8Array(65536 * 3), steps = 256 / (high - low);
  for (let bits = 0; bits < 65536; bits++) {
    const value = HALF_VALUE[bits] * image.scale;
    let colour = colours.nonfinite;
    if (Number.isFinite(value)) {
      const step = 3 * Math.min(255, Math.max(0, Math.floor((value - low) * steps)));
      colour = colours.rgb.subarray(step, step + 3);
    }
    table.set(colour, 3 * bits);
  }
  const { halves, plane } = image, data = target.data;
  for (let i = 0, o = 0; i < plane; i++, o += 4) {
    const from = 3 * halves[i], grey = mask && !mask[i];
    data[o] = grey ? MASKED_COLOUR[0] : table[from];
    data[o + 1] = grey ? MASKED_COLOUR[1] : table[from + 1];
    data[o + 2] = grey ? MASKED_COLOUR[2] : table[from + 2];
    data[o + 3] = 255;
  }
}

// The exposure, in stops, that brings the brightest hundredth of both pictures to four fifths.
function autoExposure(pair) {
  const values = [];
  for (const image of [pair.tested, pair.truth]) {
    const stride = Math.max(1, Math.floor(image.plane / 20000));
    for (let i = 0; i < image.plane; i += stride) {
      if (pair.mask && !pair.mask[i]) continue;
      const value = Math.max(valueAt(image, i), valueAt(image, i, 1), valueAt(image, i, 2));
      if (Number.isFinite(value) && value > 0) values.push(value);
    }
  }
  if (!values.length) return 0;
  values.sort((a, b) => a - b);
  return Math.log2(0.8 / values[Math.floor(0.99 * (values.length - 1))]);
}

function hexBytes(text) {
  return Uint8Array.from({ length: text.length / 2 }, (_, i) => parseInt(text.substr(2 * i, 2), 16));
}
