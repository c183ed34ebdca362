// Pictures that follow: `lever.js` and `flow.js` move their parts, others say why they do not.
"use strict";
(() => {
  const SLICE = 4; // ms
  const kinds = {}; // of pictures that follow: (svg, c) -> { check, move }
  const pale = {
    stays: "This picture stays as the program drew it.",
    parts: "Other shift elements hold here, or other parts carry no torque: run the program.",
    base: "The page does not know all of this picture: run the program.",
  };

  // As vstatics/pictures/sheet/style.py writes numbers.
  const number = (value) => {
    if (!Number.isFinite(value)) return "\u2013";
    const size = Math.abs(Number(value.toPrecision(4)));
    if (size >= 1e6) return signed(value.toPrecision(4).replace(/\.?0+e/, "e").replace(/e([+-])(\d)$/, "e$10$2"));
    return signed(fixed(value, 3 - (size >= 10) - (size >= 100) - (size >= 1000)));
  };
  const fixed = (value, decimals) => { // a 5 at the end goes to the even digit, as in Python
    const size = Math.abs(value), before = Math.floor(size * 10 ** decimals), text = value.toFixed(decimals);
    const isTie = size * 10 ** decimals - before === 0.5 && /^50*$/.test(size.toFixed(60).split(".")[1].slice(decimals));
    return isTie && before % 2 === 0 ? `${value < 0 ? "-" : ""}${(before / 10 ** decimals).toFixed(decimals)}` : text;
  };
  const signed = (text) => (text.startsWith("-") ? (/[1-9]/.test(text) ? `\u2212${text.slice(1)}` : text.slice(1)) : text);

  const renumber = (text, pairs) => { // each text in place of another, one behind the other
    let done = "", rest = text;
    for (const [before, after] of pairs) {
      const at = rest.indexOf(before);
      if (at < 0) continue;
      done += rest.slice(0, at) + after;
      rest = rest.slice(at + before.length);
    }
    return done + rest;
  };

  // Changes of elements that can be taken back.
  const changes = () => {
    const first = new Map();
    const keep = (element, key, given) => {
      if (!first.has(element)) first.set(element, {});
      if (!(key in first.get(element))) first.get(element)[key] = given;
    };
    const put = (element, key, value) => (value === null ? element.removeAttribute(key) : element.setAttribute(key, value));
    return {
      set(element, key, value) {
        const now = element.getAttribute(key);
        if (now === value) return;
        keep(element, key, now);
        put(element, key, value);
      },
      text(element, text) {
        const now = element.textContent;
        if (now === text) return;
        keep(element, "", now);
        element.textContent = text;
      },
      first: (element) => first.get(element)?.[""] ?? element.textContent,
      back() {
        for (const [element, own] of first) {
          for (const [key, value] of Object.entries(own)) key ? put(element, key, value) : (element.textContent = value);
        }
        first.clear();
      },
    };
  };

  const same = (one, other) => one.every((value, n) => Object.is(value, other[n]));
  const near = (one, other) => Math.abs(one - other) <= 1e-9 * Math.max(1, Math.abs(one), Math.abs(other));

  // All pictures of the page; `c` is the lowered case, `base` what it has where the sliders stood first.
  const pictures = (c, base) => {
    const names = c.gears.map(({ name }) => name);
    const found = [...document.querySelectorAll("main figure")].filter((one) => !one.closest(".run-moves")).map((figure) => {
      const svg = figure.querySelector("svg"), block = figure.closest("div[data-gear]");
      const [, make] = Object.entries(kinds).find(([key]) => svg?.hasAttribute(`data-${key}`)) ?? [];
      const gear = block ? names.indexOf(block.dataset.gear) : -1, isStick = figure.closest("#overview") !== null;
      const own = make && !base[gear]?.outside ? make(svg, c, base) : null;
      return { figure, block, gear, own, isBroken: own ? !own.check(base) : make !== undefined, isStick, isDone: true };
    });

    const why = ({ own, gear, isStick, isBroken }, told) => {
      if (!own && !isStick) return isBroken ? pale.base : pale.stays;
      if (gear < 0) return "";
      const reason = told[gear].outside;
      if (reason) return `outside: run the program (${reason})`;
      if (base[gear].outside || !same(told[gear].holds, base[gear].holds) || !same(told[gear].idle, base[gear].idle)) return pale.parts;
      return isBroken ? pale.base : "";
    };

    const say = (figure, text) => {
      let note = figure.querySelector(":scope > .why");
      if (!text) { note?.remove(); figure.removeAttribute("data-pale"); return; }
      if (!note) {
        note = document.createElement("p");
        note.className = "why note";
        figure.prepend(note);
        figure.dataset.pale = "";
      }
      if (note.textContent !== text) note.textContent = text;
    };

    let last = [base, false], later;
    const update = (one) => {
      const [told, isMoved] = last;
      one.isDone = true;
      let text = isMoved ? why(one, told) : "";
      if (one.own && (text || !isMoved)) one.own.back();
      else if (one.own) text = one.own.move(told) ?? "";
      say(one.figure, text);
    };
    const left = () => found.filter((one) => !one.isDone);
    const rest = () => { // some at a time, so that no step of a slider waits for all
      const until = performance.now() + SLICE;
      for (const one of left()) {
        if (performance.now() > until) { later = setTimeout(rest); return; }
        update(one);
      }
    };
    for (const block of new Set(found.map((one) => one.block))) { // when a gear is chosen, its pictures follow
      const shows = () => { if (!block.hidden) for (const one of found) if (one.block === block && !one.isDone) update(one); };
      if (block) new MutationObserver(shows).observe(block, { attributeFilter: ["hidden"] });
    }
    addEventListener("beforeprint", () => left().forEach(update));
    return (told, isMoved) => {
      last = [told, isMoved];
      for (const one of found) {
        one.isDone = false;
        if (!one.block?.hidden) update(one);
      }
      clearTimeout(later);
      later = setTimeout(rest, 200); // those that nobody sees
    };
  };

  Object.assign(globalThis.transmission, { pictures, drawn: { kinds, number, renumber, changes, near } });
})();
