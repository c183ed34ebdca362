// Puts sections that are packed in their places: LZMA, as letters of packed.py.
"use strict";
{
const CONTEXT = 4; // so many bits of the byte before tell what comes
const letters = document.getElementById("packed").textContent;

let value = 0, known = 0, read = 0;
const byte = () => { // thirteen bits stand in two letters
  const digit = () => { const code = letters.charCodeAt(read++); return code - 35 - (code > 60); };
  if (known < 8) {
    value |= (digit() + 91 * digit()) << known;
    known += 13;
  }
  const one = value & 255;
  value >>= 8;
  known -= 8;
  return one;
};

let range = 2 ** 32 - 1, code = 0; // of the arithmetic coder
for (let n = 0; n < 5; n += 1) code = code * 256 + byte();
const narrowed = (isOne) => {
  if (range < 2 ** 24) { range *= 256; code = code * 256 + byte(); }
  return isOne;
};
const bit = (chances, place) => {
  const chance = chances[place], bound = (range >>> 11) * chance;
  if (code < bound) {
    range = bound;
    chances[place] += (2048 - chance) >> 5;
    return narrowed(0);
  }
  range -= bound;
  code -= bound;
  chances[place] -= chance >> 5;
  return narrowed(1);
};
const plain = (count) => { // bits that are as often 0 as 1
  let found = 0;
  for (let n = 0; n < count; n += 1) {
    range = Math.floor(range / 2);
    const isOne = code >= range ? 1 : 0;
    if (isOne) code -= range;
    found = 2 * found + narrowed(isOne);
  }
  return found;
};
const tree = (chances, count, start = 0) => { // the first bit is the highest
  let found = 1;
  for (let n = 0; n < count; n += 1) found = 2 * found + bit(chances, start + found);
  return found - 2 ** count;
};
const mirrored = (chances, count, start = 0) => {
  let found = 0;
  for (let n = 0, at = 1; n < count; n += 1) {
    const one = bit(chances, start + at);
    at = 2 * at + one;
    found += one * 2 ** n;
  }
  return found;
};
const even = (count) => new Uint16Array(count).fill(1024);

const STATES = 12; // what came before: literals, matches, repetitions
const isMatch = even(STATES), isOld = even(STATES), isFarther = even(STATES), isLong = even(STATES);
const isThird = even(STATES), isFourth = even(STATES), literals = even(0x300 << CONTEXT);
const slots = [even(64), even(64), even(64), even(64)], near = even(128), align = even(16);
const lengths = () => ({ choice: even(2), short: even(8), middle: even(8), long: even(256) });
const ofNew = lengths(), ofOld = lengths();
const length = ({ choice, short, middle, long }) => {
  if (!bit(choice, 0)) return 2 + tree(short, 3);
  return bit(choice, 1) ? 18 + tree(long, 8) : 10 + tree(middle, 3);
};
const distance = (long) => {
  const slot = tree(slots[Math.min(long - 2, 3)], 6), more = (slot >> 1) - 1;
  if (slot < 4) return slot;
  const from = (2 + (slot & 1)) * 2 ** more;
  if (slot < 14) return from + mirrored(near, more, from - slot);
  return from + 16 * plain(more - 4) + mirrored(align, 4);
};

const out = [], far = [0, 0, 0, 0]; // the last distances
let state = 0;
const literal = () => {
  const start = 0x300 * ((out.at(-1) ?? 0) >> (8 - CONTEXT));
  let found = 1;
  if (state >= 7) { // not what stands where the last match would go on
    for (let other = out[out.length - 1 - far[0]], one = -1, own = -1; found < 256 && one === own; other <<= 1) {
      own = (other >> 7) & 1;
      one = bit(literals, start + 256 * (1 + own) + found);
      found = 2 * found + one;
    }
  }
  while (found < 256) found = 2 * found + bit(literals, start + found);
  out.push(found - 256);
  state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
};
const old = () => { // from one of the last distances; how much
  if (!bit(isFarther, state)) {
    if (!bit(isLong, state)) { state = state < 7 ? 9 : 11; return 1; }
  } else {
    const which = bit(isThird, state) ? 2 + bit(isFourth, state) : 1;
    far.unshift(...far.splice(which, 1));
  }
  const long = length(ofOld);
  state = state < 7 ? 8 : 11;
  return long;
};
for (;;) {
  if (!bit(isMatch, state)) { literal(); continue; }
  let long;
  if (bit(isOld, state)) long = old();
  else {
    long = length(ofNew);
    state = state < 7 ? 7 : 10;
    far.unshift(distance(long));
    far.pop();
    if (far[0] === 2 ** 32 - 1) break; // the end
  }
  for (let n = 0; n < long; n += 1) out.push(out[out.length - 1 - far[0]]);
}

const contents = new TextDecoder().decode(new Uint8Array(out)).split("\u0002");
document.querySelectorAll("[data-packed]").forEach((one, n) => { one.outerHTML = contents[n]; });
document.getElementById("packed").remove();
}
