// A page that calculates: fields and sliders in, numbers with marks out.
"use strict";
(() => {
  const { calculate, steps, pictures } = globalThis.transmission, { typed } = globalThis;
  const c = JSON.parse(document.getElementById("lowered").textContent), numbers = { ...c.numbers };
  const [outside, why] = ["outside", "why-outside"].map((id) => document.getElementById(id)), given = JSON.stringify(numbers);
  const known = { ...c.results, step: { rows: [], of: "step", unit: "", decimals: 3 } };
  const powers = { power: 3, lossy_power: 3, lossy_power_kW: 3, power_loss: 4, power_loss_kW: 3, loss_share: 1 };
  for (const [name, decimals] of Object.entries(powers)) { // by the names of their rows
    const [of, unit = ""] = name.split(/_(?=kW$)/);
    known[name] = { of, unit, decimals };
  }

  for (const { dataset } of document.querySelectorAll("[data-marks]")) { // written short, as they are many
    const [result, row, gear, number] = dataset.marks.split(" ");
    delete dataset.marks;
    Object.assign(dataset, { result: c.texts[result], ...(row && { row: c.texts[row] }), gear: c.texts[gear], number });
  }

  const called = [...document.querySelectorAll("input.slider")].map((one) => [one.dataset.path, one.getAttribute("aria-label")]);
  c.called = Object.fromEntries(called);

  const cells = []; // of each number: its element, what it is, and how it was at first
  const seen = new Map(); // rows may have the same name
  const names = c.gears.map(({ name }) => name);
  for (const element of document.querySelectorAll("[data-result][data-gear]")) {
    const { result, row, gear, number } = element.dataset, about = known[result];
    if (!about) continue;
    const key = JSON.stringify([result, row, gear]), after = (seen.get(key) ?? -1) + 1;
    const place = row === undefined ? 0 : about.rows ? about.rows.indexOf(row, after) : row;
    seen.set(key, place);
    if (element.tagName === "TD") element.dataset.value = number; // by which tables are sorted
    cells.push({ element, about, place, gear: names.indexOf(gear), number, last: number, text: element.textContent });
  }

  const digits = (value) => (Number.isFinite(value) ? String(value) : "");

  const shown = (value, decimals) => globalThis.page.rounded(value, decimals, c.digits ?? undefined);

  const mark = (number, of) => { // of what holds or does not
    if (number === "" || number === "0") return number === "" ? "\u2013" : "\u00b7";
    return of === "idle" ? c.words.idle : "\u25cf";
  };

  const isSame = (a, b) => a === b || (a !== "" && b !== "" && Math.abs(a - b) <= 1e-12 * Math.max(1, Math.abs(a)));

  const draw = pictures(c, calculate(c, numbers));
  const show = () => {
    const told = calculate(c, numbers), asked = told.flatMap((one, n) => (one.outside ? [n] : []));
    const isMoved = JSON.stringify(numbers) !== given;
    steps(c, told).forEach((next, n) => Object.assign(told[n], next));
    for (const cell of cells) {
      const { element, about, place, gear } = cell, of = told[gear][about.of];
      const isFirst = !isMoved && told[gear].outside; // then the number of the program stands
      element.toggleAttribute("data-first", Boolean(isFirst && cell.number));
      const unit = about.unit ? c.gears[gear].scales[about.unit] ?? NaN : 1;
      const scale = about.rows ? unit : Math.abs(unit); // powers by names stand in their real direction, ...
      const nothing = about.rows || !of ? NaN : 0; // ... and are 0 where none flows
      const number = isFirst ? cell.number : digits((of?.[place] ?? nothing) * scale + 0);
      if (number === cell.last) continue;
      cell.last = number;
      const same = isSame(number, cell.number);
      element.dataset.number = number;
      element.toggleAttribute("data-changed", isMoved && !same);
      if (element.tagName === "TD") element.dataset.value = number;
      element.textContent = same ? cell.text : about.isMark ? mark(number, about.of) : shown(parseFloat(number), about.decimals);
    }
    outside.hidden = !asked.length;
    outside.dataset.gears = asked.map((n) => names[n]).join(", ");
    outside.title = asked.map((n) => `${names[n]}: ${told[n].outside}`).join("; ");
    why.hidden = !asked.length;
    const reasons = [...new Set(asked.map((n) => told[n].outside))].map((one) => {
      const own = asked.filter((n) => told[n].outside === one);
      return told[own[0]].isOfAll ? one : `${one} (${own.map((n) => names[n]).join(", ")})`;
    });
    const pale = isMoved ? "" : "The pale numbers are those of the program, which do not follow.";
    why.textContent = `${reasons.join("; ")}. ${pale}`;
    document.getElementById("revert").hidden = !isMoved;
    document.body.toggleAttribute("data-moved", isMoved);
    draw(told, isMoved);
    dispatchEvent(new Event("numbers")); // the tools may show them in other units
  };

  document.addEventListener("input", ({ target }) => {
    const { path } = target.dataset ?? {};
    if (!(path in numbers)) return;
    const number = typed.read(target);
    if (Number.isNaN(number)) return;
    numbers[path] = number;
    for (const other of document.querySelectorAll("input[data-path]")) {
      if (other !== target && other.dataset.path === path) typed.write(other, number);
    }
    show();
  });

  document.getElementById("revert").addEventListener("click", () => {
    Object.assign(numbers, c.numbers);
    for (const one of document.querySelectorAll("input[data-path]")) typed.restore(one, c.numbers[one.dataset.path]);
    show();
  });

  show();
})();
