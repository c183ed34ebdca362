
  // Units: numbers relative to the input, in rpm, N*m and kW, or as in the United States.
  // `data-number` stays what it is. A table, or a column, that is another one in a unit is left out.

  const select = document.getElementById("units");
  let cells = [], byElement = new Map();
  const byTable = new Map();
  const [texts, heads] = [new WeakMap(), new WeakMap()]; // as the page has them, and as they are written here

  const about = ({ dataset }) => {
    const result = known.results[dataset.result];
    if (result) return result;
    if (dataset.unit) return { unit: dataset.unit, own: true, real: true, repeats: "repeats" in dataset };
    return dataset.scaled ? { unit: dataset.scaled, real: true } : null;
  };

  const scale = (of, { unit, real }, gear) => { // where no gear is told it is the one that all have
    const all = Object.values(of.gears).map((one) => one[unit]);
    const one = gear === undefined ? (all.every((other) => other === all[0]) ? all[0] : undefined) : of.gears[gear]?.[unit];
    const sign = unit === "kW" && !real && of.gears[gear]?.Nm * of.gears[gear]?.rpm < 0 ? -1 : 1; // of what is driven: statics/physical.py
    return one === undefined ? NaN : one * sign;
  };
  const isKnown = (unit) => Object.values(cases).some(({ gears }) => Object.values(gears).some((one) => Math.abs(one[unit]) > 0));

  const find = () => {
    cells = [];
    for (const element of document.querySelectorAll("main :is([data-result], [data-unit], [data-scaled])")) {
      const told = about(element);
      const of = cases[element.dataset.case ?? ""];
      if (told && of && !element.closest("svg") && isKnown(told.unit)) cells.push({ element, told, of });
    }
    byElement = new Map(cells.map((cell) => [cell.element, cell]));
    const can = cells.length > 0;
    for (const option of select.options) option.disabled = option.value !== "relative" && !can;
    select.title = can ? "" : "The case has no load: nothing is known in units";
    if (!can) select.value = "relative";
    byTable.clear();
    for (const cell of cells) {
      const table = cell.element.closest("table");
      if (table) byTable.set(table, [...(byTable.get(table) ?? []), cell]);
    }
    for (const [table, own] of byTable) leaveOut(table, own);
  };

  const leaveOut = (table, own) => {
    const units = new Set(own.map(({ element }) => element));
    const rest = [...table.querySelectorAll("tbody td[data-value]")].filter((one) => !units.has(one));
    const section = table.closest("section.table");
    if (!rest.length && own.every(({ told }) => told.repeats)) section?.setAttribute("data-repeats", "");
    headsOf(table).forEach((head, column) => {
      const mine = own.filter(({ element }) => element.cellIndex === column);
      if (!mine.length || !mine.every(({ told }) => told.repeats)) return;
      for (const one of [head, ...[...table.tBodies[0].rows].map((row) => row.cells[column])]) one?.setAttribute("data-repeats", "");
    });
  };

  const suffix = ({ unit, own }) => {
    if (select.value === "relative") return own ? known.words[""] : "";
    return select.value === "us" ? known.us[unit]?.[1] ?? known.words[unit] : known.words[unit];
  };

  const factor = (cell) => {
    const { told, of, element: { dataset } } = cell;
    const by = scale(of, told, dataset.gear);
    if (select.value === "relative") return told.own ? 1 / by : 1;
    return (told.own ? 1 : by) * (select.value === "us" ? known.us[told.unit]?.[0] ?? 1 : 1);
  };

  const decimals = ({ dataset }, { unit }) => (select.value === "relative" ? known.decimals[dataset.result.replace(`_${unit}`, "")] ?? 3 : known.places[unit]);

  const write = (cell) => {
    const { element, told, of } = cell, { dataset } = element;
    const written = texts.get(element);
    const own = written && element.textContent === written.now ? written.own : element.textContent; // somebody else wrote it meanwhile
    const number = dataset.number ?? dataset.value ?? "", by = factor(cell);
    const isOwn = by === 1 && (told.own ? select.value !== "relative" : select.value === "relative");
    const stays = isOwn || number === "" || own.trim() === "" || own === "\u2013";
    const now = stays ? own : rounded(parseFloat(number) * by, decimals({ dataset: { result: "", ...dataset } }, told), of.digits ?? undefined);
    texts.set(element, { own, now });
    if (element.textContent !== now) element.textContent = now;
    const beside = element.nextElementSibling;
    if (beside?.matches(".unit")) beside.textContent = told.own || select.value !== "relative" ? suffix(told) : known.words[""];
  };

  const ownHeading = (inner) => {
    const written = heads.get(inner);
    return (written && inner.textContent === written.now ? written.own : inner.textContent).trim();
  };

  // what stands over a column tells its unit; where gears stand there the title of the table does
  const head = (element, told) => {
    const inner = element.querySelector("[role=button]") ?? element;
    const own = ownHeading(inner);
    const stem = told.own ? own.replace(new RegExp(`(^|,? )${known.words[told.unit].replace("*", ".")}(?= \\[|$)`), "") : own;
    const word = suffix(told), [, name, key = ""] = /^(.*?)( \[\w+\])?$/.exec(stem);
    const now = (told.own ? select.value === "si" : !word) ? own : word ? `${name}, ${word}${key}` : stem;
    heads.set(inner, { own, now });
    if (inner.textContent !== now) inner.textContent = now;
  };

  const writeHeads = () => {
    for (const [table, own] of byTable) {
      const [first] = own, row = headsOf(table);
      const overGears = own.every(({ element }) => (row[element.cellIndex]?.textContent === element.dataset.gear));
      const title = table.closest("section.table")?.querySelector("h3");
      if (overGears && title) head(title, first.told);
      else row.forEach((one, column) => { const cell = own.find(({ element }) => element.cellIndex === column); if (cell) head(one, cell.told); });
    }
  };

  const rewrite = () => cells.forEach(write);
  const showUnits = () => { find(); rewrite(); writeHeads(); };
  select.value = choices.read().units ?? "relative";
  select.addEventListener("change", () => { choices.keep({ units: select.value }); rewrite(); writeHeads(); });
  followers.push(showUnits);
  renumbered.push((elements) => {
    for (const one of elements) texts.delete(one);
    for (const one of elements) if (byElement.has(one)) write(byElement.get(one));
  });
