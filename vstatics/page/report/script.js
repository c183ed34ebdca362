"use strict";
(() => {
  // The gear that is chosen, for all that is shown of one: #gear=R at the end of the address.
  // Another section instead of gear, #flow=R, opens the page there.
  let blocks, links;
  function look() {
    blocks = [...document.querySelectorAll("div[data-gear]")];
    links = [...document.querySelectorAll("[data-choose]")];
  }
  look();
  const chooser = document.querySelector(".chooser");
  const names = chooser ? [...chooser.querySelectorAll("a")].map((link) => link.dataset.choose) : [];
  let chosen;

  function address() {
    const [section, end] = location.hash.slice(1).split(/=(.*)/s);
    try { return [section, decodeURIComponent(end ?? "")]; } catch { return [section, end]; } // a bare %
  }

  function asked() {
    const [section, name] = address();
    const own = blocks.filter((one) => one.dataset.gear === name);
    return own.find((one) => one.id.startsWith(`${section}=`)) ?? own[0];
  }

  function choose(name) {
    chosen = name;
    for (const one of blocks) one.hidden = one.dataset.gear !== name;
    for (const link of links) {
      const row = link.closest("tr");
      row?.classList.toggle("chosen", link.dataset.choose === name);
      if (link.dataset.choose === name) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
    const link = chooser.querySelector("[aria-current]");
    chooser.scrollLeft = link.offsetLeft - (chooser.clientWidth - link.offsetWidth) / 2;
  }

  // another gear, while what is being read stays where it is
  function change(name) {
    if (name === chosen) return;
    const sections = [...document.querySelectorAll("main > section")];
    const top = (one) => one.getBoundingClientRect().top;
    const read = sections.findLast((one) => top(one) < 0.4 * innerHeight);
    const before = read && top(read);
    choose(name);
    stops();
    if (read) scrollBy({ top: top(read) - before, behavior: "instant" });
    tell(name, `Gear ${name}`);
  }

  function tell(name, said) {
    history.replaceState(null, "", `#gear=${encodeURIComponent(name)}`);
    chooser.querySelector("[role=status]").textContent = said;
  }

  // as the address says; a gear that is not there leaves the one that is chosen, and the address tells it
  function follow() {
    const block = asked();
    const [section, name] = address();
    choose(block?.dataset.gear ?? chosen ?? names[0]);
    if (!block && name && blocks.some((one) => one.id.startsWith(`${section}=`))) {
      tell(chosen, `There is no gear ${name}, this is gear ${chosen}`);
    }
    return block;
  }

  if (names.length) {
    const block = follow();
    if (block && !block.id.startsWith("gear=")) block.scrollIntoView();
    addEventListener("hashchange", () => { follow(); stops(); });
    if (names.length > 1) {
      const hint = document.createElement("span");
      hint.className = "note";
      hint.textContent = "or keys \u2190 \u2192";
      chooser.title = "The keys left and right step through the gears";
      chooser.append(hint);
    }
  }

  addEventListener("click", (event) => {
    const link = event.target.closest("a, button, [role=button]");
    const row = event.target.closest("tbody tr");
    const choosing = link ?? row?.querySelector("[data-choose]");
    if (!choosing?.matches("[data-choose]") || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (!link && String(getSelection())) return; // somebody copies
    event.preventDefault();
    change(choosing.dataset.choose);
  });

  // left and right: the gear before and after, but where these keys do something else
  addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step || !names.length || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (event.target.closest("input, select, textarea, [contenteditable]")) return;
    const wide = event.target.closest(".scroll");
    if (wide && wide.scrollWidth > wide.clientWidth && !event.target.matches("[data-choose]")) return;
    const next = names[names.indexOf(chosen) + step];
    event.preventDefault();
    if (next !== undefined) change(next);
    if (event.target.matches("[data-choose]")) {
      const within = event.target.closest("table, nav") ?? chooser;
      within.querySelector("[data-choose][aria-current]")?.focus({ preventScroll: true });
    }
  });

  // what fits needs no stop of the Tab key
  function stops() {
    const scrollers = [...document.querySelectorAll(".scroll")];
    for (const one of scrollers) {
      if (one.scrollWidth > one.clientWidth) one.tabIndex = 0;
      else one.removeAttribute("tabindex");
    }
    for (const one of [...scrollers, ...(chooser ? [chooser] : [])]) fade(one);
  }

  // an end that fades tells that there is more
  function fade(one) {
    one.classList.toggle("more", one.scrollLeft + one.clientWidth < one.scrollWidth - 1);
  }
  addEventListener("scroll", (event) => { if (event.target.matches?.(".scroll, .chooser")) fade(event.target); }, true);

  // tables sorted by a column: up, down, then as they were
  const orders = new Map(); // by table and column, for a table that stands in place of another
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

  function sortable(table) {
    const body = table.tBodies[0];
    const original = [...body.rows];
    if (original.length < 2) return;
    const heads = [...[...table.tHead.rows].at(-1).cells];
    const label = table.parentElement.getAttribute("aria-label");
    heads.forEach((head, column) => {
      if (!head.textContent) return;
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
        for (const other of heads) if (other.ariaSort) other.setAttribute("aria-sort", "none");
        head.setAttribute("aria-sort", order);
        orders.set(label, [column, order]);
        const sign = order === "descending" ? -1 : 1;
        body.append(...(order === "none" ? original : sorted(original, column, sign)));
      });
    });
    const [column, order] = orders.get(label) ?? [];
    for (let clicks = { ascending: 1, descending: 2 }[order] ?? 0; clicks > 0; clicks -= 1) {
      heads[column]?.querySelector("[role=button]")?.click();
    }
  }

  // a table as CSV: all digits, and nothing that a spreadsheet would calculate
  const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

  function field(cell) {
    const shown = cell.textContent.trim();
    const text = /\p{L}{2}/u.test(shown) ? shown : cell.dataset.value ?? shown; // words as they are
    if (cell.matches("td") && (shown === "-" || shown === "")) return ""; // of an open element, too
    const guarded = /^'*[=+\-@\t\r]/.test(text) && !NUMBER.test(text) ? `'${text}` : text;
    return /[",\r\n]/.test(guarded) ? `"${guarded.replaceAll('"', '""')}"` : guarded;
  }

  function csv(table) {
    const rows = [[...table.tHead.rows].at(-1), ...table.tBodies[0].rows];
    return rows.map((row) => `${[...row.cells].map(field).join(",")}\n`).join("");
  }

  async function copy(text) {
    try { await navigator.clipboard.writeText(text); } catch { // an older browser, or a file
      const area = document.createElement("textarea");
      area.value = text;
      document.body.append(area);
      area.select();
      document.execCommand("copy");
      area.remove();
    }
  }

  function copied(scroller, table) {
    const button = document.createElement("button");
    button.className = "copy";
    button.textContent = "Copy CSV";
    button.setAttribute("aria-label", `Copy CSV: ${scroller.getAttribute("aria-label")}`);
    button.addEventListener("click", async () => {
      await copy(csv(table));
      button.textContent = "Copied";
      setTimeout(() => { button.textContent = "Copy CSV"; }, 2000);
    });
    scroller.before(button);
  }

  function bind(root) {
    for (const table of root.querySelectorAll(".scroll > table")) {
      sortable(table);
      copied(table.parentElement, table);
    }
  }
  bind(document);
  stops();
  addEventListener("resize", stops);

  // parts of the page stand in place of others
  addEventListener("shown", (event) => {
    look();
    if (names.length) choose(chosen);
    event.detail.forEach(bind);
    stops();
  });

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
  document.querySelector("main > section:last-child")?.append(save);

  document.documentElement.dataset.ready = "true";
})();
