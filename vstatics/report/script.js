"use strict";
(() => {
  // the gear whose power and modes are shown: #gear=R or #modes=R at the end of the address
  const gears = [...document.querySelectorAll("[data-gear]")];
  const links = [...document.querySelectorAll("[data-choose]")];

  function asked() {
    const [section, end] = location.hash.slice(1).split(/=(.*)/s);
    if (end === undefined) return undefined;
    let name = end;
    try { name = decodeURIComponent(end); } catch { /* a % that stands for itself */ }
    return gears.find((one) => one.dataset.gear === name && one.id.startsWith(`${section}=`));
  }

  function choose(gear) {
    for (const one of gears) one.hidden = one.dataset.gear !== gear.dataset.gear;
    for (const link of links) {
      if (link.dataset.choose === gear.dataset.gear) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  }

  if (gears.length) {
    choose(asked() ?? gears[0]);
    asked()?.scrollIntoView();
    addEventListener("hashchange", () => { const gear = asked(); if (gear) choose(gear); });
  }

  // tables sorted by a column: up, down, then as they were
  const NEXT = { none: "ascending", ascending: "descending", descending: "none" };

  function key(row, column) {
    const cell = row.cells[column];
    if ("value" in cell.dataset) return cell.dataset.value === "" ? NaN : Number(cell.dataset.value);
    const text = cell.textContent.trim();
    return text === "-" || text === "" ? NaN : isNaN(text) ? text : Number(text);
  }

  function compare(one, other, sign) {
    const missing = [one, other].map((value) => Number.isNaN(value));
    if (missing[0] || missing[1]) return missing[0] - missing[1]; // last, up or down
    if (typeof one === "number" && typeof other === "number") return sign * (one - other);
    return sign * String(one).localeCompare(String(other), undefined, { numeric: true });
  }

  // rows in order, each followed by those that are set in below it, in order too
  function sorted(rows, column, sign) {
    const groups = [];
    for (const row of rows) {
      if (groups.length && depth(row) > depth(groups.at(-1)[0])) groups.at(-1).push(row);
      else groups.push([row]);
    }
    const keyed = groups.map((group) => [key(group[0], column), group]);
    keyed.sort((one, other) => compare(one[0], other[0], sign));
    return keyed.flatMap(([, [head, ...below]]) => [head, ...(below.length ? sorted(below, column, sign) : [])]);
  }

  function depth(row) { return Number(row.dataset.level ?? 0); }

  for (const table of document.querySelectorAll("table")) {
    const body = table.tBodies[0];
    const original = [...body.rows];
    if (original.length < 2) continue;
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      // a button proper is not printed where the head of a table is repeated
      const button = document.createElement("span");
      button.setAttribute("role", "button");
      button.tabIndex = 0;
      button.title = "Sort";
      button.append(...head.childNodes);
      head.append(button);
      head.setAttribute("aria-sort", "none");
      button.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        button.click();
      });
      button.addEventListener("click", () => {
        const order = NEXT[head.getAttribute("aria-sort")];
        for (const other of heads) other.setAttribute("aria-sort", "none");
        head.setAttribute("aria-sort", order);
        const sign = order === "descending" ? -1 : 1;
        body.append(...(order === "none" ? original : sorted(original, column, sign)));
      });
    });
  }

  // the result that the page carries, as `vstatics run -f json` writes it
  const save = document.createElement("button");
  save.textContent = "Save the result as JSON";
  save.className = "save";
  save.addEventListener("click", () => {
    const text = document.getElementById("result").textContent;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
    link.download = "result.json";
    link.click();
    URL.revokeObjectURL(link.href);
  });
  document.getElementById("conventions").append(save);

  document.documentElement.dataset.ready = "true";
})();
