// Puts sections that are packed in their places: deflate (RFC 1951), then what stood before by its place.
"use strict";
{
const packed = Uint8Array.from(atob(document.getElementById("packed").textContent), (one) => one.charCodeAt(0));
let place = 0; // in bits

const bits = (count) => {
  let found = 0;
  for (let n = 0; n < count; n += 1, place += 1) found |= ((packed[place >> 3] >> (place & 7)) & 1) << n;
  return found;
};

const codes = (lengths) => { // Huffman codes by their lengths: how many there are of each, and their symbols in order
  const counts = Array(16).fill(0), symbols = [];
  for (const one of lengths) counts[one] += 1;
  counts[0] = 0;
  for (let long = 1; long < 16; long += 1) lengths.forEach((one, n) => { if (one === long) symbols.push(n); });
  return { counts, symbols };
};

const symbol = ({ counts, symbols }) => {
  let code = 0, first = 0, index = 0;
  for (let long = 1; long < 16; long += 1) {
    code |= (packed[place >> 3] >> (place & 7)) & 1;
    place += 1;
    if (code - counts[long] < first) return symbols[index + code - first];
    index += counts[long];
    first = (first + counts[long]) << 1;
    code <<= 1;
  }
  throw new Error("what is packed is broken");
};

const scale = (count, start, each) => { // what symbols of lengths and distances start from, and their further bits
  const found = [];
  for (let n = 0, from = start; n < count; n += 1) {
    const more = Math.max(0, Math.floor(n / each) - 1);
    found.push([from, more]);
    from += 2 ** more;
  }
  return found;
};
const LENGTHS = [...scale(28, 3, 4), [258, 0]], DISTANCES = scale(30, 1, 2);
const ORDER = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

const tables = () => {
  const literals = bits(5) + 257, distances = bits(5) + 1, given = bits(4) + 4, own = Array(19).fill(0);
  for (let n = 0; n < given; n += 1) own[ORDER[n]] = bits(3);
  const lengths = [], code = codes(own);
  while (lengths.length < literals + distances) {
    const one = symbol(code);
    if (one < 16) lengths.push(one);
    else {
      const [what, from, more] = [[lengths.at(-1), 3, 2], [0, 3, 3], [0, 11, 7]][one - 16];
      for (let n = from + bits(more); n > 0; n -= 1) lengths.push(what);
    }
  }
  return [codes(lengths.slice(0, literals)), codes(lengths.slice(literals))];
};

const FIXED = () => [codes([...Array(288).keys()].map((n) => (n < 144 ? 8 : n < 256 ? 9 : n < 280 ? 7 : 8))), codes(Array(30).fill(5))];

const inflated = () => {
  const out = [];
  for (let isLast = 0; !isLast;) {
    isLast = bits(1);
    const kind = bits(2);
    if (kind === 0) { // as it stands
      place = (place + 7) & ~7;
      for (let n = bits(16) + 0 * bits(16); n > 0; n -= 1) out.push(bits(8));
      continue;
    }
    const [literal, distance] = kind === 1 ? FIXED() : tables();
    for (let one = symbol(literal); one !== 256; one = symbol(literal)) {
      if (one < 256) { out.push(one); continue; }
      const [start, more] = LENGTHS[one - 257], long = start + bits(more);
      const [back, further] = DISTANCES[symbol(distance)], from = out.length - back - bits(further);
      for (let n = 0; n < long; n += 1) out.push(out[from + n]);
    }
  }
  return out;
};

const expanded = (bytes) => {
  const out = [];
  let n = 0;
  const number = () => {
    let found = 0;
    for (n += 1; bytes[n] >= 48 && bytes[n] < 58; n += 1) found = 10 * found + bytes[n] - 48;
    return found;
  };
  while (n < bytes.length) {
    if (bytes[n] !== 1) { out.push(bytes[n]); n += 1; continue; }
    const from = number(), long = number();
    for (let one = 0; one < long; one += 1) out.push(out[from + one]);
    n += 1;
  }
  return new TextDecoder().decode(Uint8Array.from(out));
};

const contents = expanded(inflated()).split("\u0002");
document.querySelectorAll("[data-packed]").forEach((one, n) => { one.outerHTML = contents[n]; });
document.getElementById("packed").remove();
}
