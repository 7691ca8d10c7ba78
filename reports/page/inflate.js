// Inflate (RFC 1951) in a zlib wrapper (RFC 1950), for browsers without DecompressionStream.
// Canonical Huffman decoding by counts and symbols, after Mark Adler's puff.

function inflateZlib(input, size) {
  const out = new Uint8Array(size);
  let at = 2, bitBuffer = 0, bitCount = 0, end = 0;

  function bits(need) {
    while (bitCount < need) {
      if (at >= input.length) throw new Error('picture data is cut short');
      bitBuffer |= input[at++] << bitCount;
      bitCount += 8;
    }
    const value = bitBuffer & ((1 << need) - 1);
    bitBuffer >>>= need;
    bitCount -= need;
    return value;
  }

  function table(lengths) {
    const count = new Uint16Array(16), offset = new Uint16Array(16);
    for (const length of lengths) count[length]++;
    count[0] = 0;
    for (let i = 1; i < 15; i++) offset[i + 1] = offset[i] + count[i];
    const symbol = new Uint16Array(lengths.length);
    lengths.forEach((length, value) => { if (length) symbol[offset[length]++] = value; });
    return { count, symbol };
  }

  function decode({ count, symbol }) {
    let code = 0, first = 0, index = 0;
    for (let length = 1; length < 16; length++) {
      code |= bits(1);
      if (code - count[length] < first) return symbol[index + code - first];
      index += count[length];
      first = (first + count[length]) << 1;
      code <<= 1;
    }
    throw new Error('picture data is damaged');
  }

  function stored() {
    bitBuffer = bitCount = 0;
    const length = input[at] | (input[at + 1] << 8);
    at += 4;
    out.set(input.subarray(at, at + length), end);
    at += length;
    end += length;
  }

  function compressed(literals, distances) {
    for (;;) {
      let symbol = decode(literals);
      if (symbol === 256) return;
      if (symbol < 256) { out[end++] = symbol; continue; }
      symbol -= 257;
      let length = LENGTH_BASE[symbol] + bits(LENGTH_EXTRA[symbol]);
      symbol = decode(distances);
      const back = DISTANCE_BASE[symbol] + bits(DISTANCE_EXTRA[symbol]);
      for (; length > 0; length--, end++) out[end] = out[end - back];
    }
  }

  function dynamicTables() {
    const literalCount = bits(5) + 257, distanceCount = bits(5) + 1, codeCount = bits(4) + 4;
    const order = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
    const codeLengths = new Array(19).fill(0);
    for (let i = 0; i < codeCount; i++) codeLengths[order[i]] = bits(3);
    const codes = table(codeLengths), lengths = [];
    while (lengths.length < literalCount + distanceCount) {
      const symbol = decode(codes);
      if (symbol < 16) { lengths.push(symbol); continue; }
      const value = symbol === 16 ? lengths[lengths.length - 1] : 0;
      let repeat = symbol === 16 ? 3 + bits(2) : symbol === 17 ? 3 + bits(3) : 11 + bits(7);
      while (repeat--) lengths.push(value);
    }
    return [table(lengths.slice(0, literalCount)), table(lengths.slice(literalCount))];
  }

  function fixedTables() {
    const lengths = Array.from({ length: 288 }, (_, i) => (i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8));
    return [table(lengths), table(new Array(30).fill(5))];
  }

  let last = 0;
  while (!last) {
    last = bits(1);
    const kind = bits(2);
    if (kind === 0) stored();
    else if (kind === 1) compressed(...fixedTables());
    else if (kind === 2) compressed(...dynamicTables());
    else throw new Error('picture data is damaged');
  }
  return out;
}

const LENGTH_BASE = [3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131,
  163, 195, 227, 258];
const LENGTH_EXTRA = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0];
const DISTANCE_BASE = [1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257, 385, 513, 769, 1025, 1537,
  2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577];
const DISTANCE_EXTRA = [0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12,
  13, 13];
