
  // What is shown, as files: pictures as SVG, tables as CSV and JSON, the results as JSON.
  // Numbers are those of `data-number` with all digits, in the units that the page was made with.

  const KINDS = { svg: "image/svg+xml", csv: "text/csv", json: "application/json" };

  const keep = (name, kind, text) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: `${KINDS[kind]};charset=utf-8` }));
    link.download = `${name.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "").slice(0, 80) || "result"}.${kind}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };

  // --- tables ------------------------------------------------------------------------------

  const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
  const datum = (cell) => { // a number, null for none, or words
    const text = cell.textContent.trim();
    if (cell.matches("th") || /\p{L}{2}/u.test(text)) return text; // also of what is sorted by a number
    const number = cell.dataset.number ?? cell.dataset.value;
    if (number === undefined) return text;
    return number === "" ? null : Number(number);
  };
  const headings = (table) => { // with the unit of their numbers
    const heads = headsOf(table), rows = [...table.tBodies[0].rows];
    return heads.map((one, column) => {
      const inner = one.querySelector("[role=button]") ?? one, name = ownHeading(inner);
      const cell = rows.map((row) => row.cells[column]).find((other) => other && about(other)?.own);
      const word = cell && known.words[about(cell).unit];
      return word && !name.includes(word) ? `${name}, ${word}` : name;
    });
  };
  const rowsOf = (table) => [...table.tBodies[0].rows].filter((row) => !row.hidden).map((row) => [...row.cells].map(datum));

  const field = (value) => { // nothing that a spreadsheet would calculate: tables/csv.py
    if (value === null) return "";
    const text = String(value);
    const guarded = typeof value === "string" && /^'*[=+\-@\t\r]/.test(text) && !NUMBER.test(text) ? `'${text}` : text;
    return /[",\r\n]/.test(guarded) ? `"${guarded.replaceAll('"', '""')}"` : guarded;
  };
  const csvOf = (table) => [headings(table), ...rowsOf(table)].map((row) => `${row.map(field).join(",")}\n`).join("");
  const jsonOf = (table) => `${JSON.stringify({ title: nameOf(table), columns: headings(table), rows: rowsOf(table) }, null, 1)}\n`;

  // --- pictures: what the page says of their looks goes with them, in the colours of paper ------

  const svgOf = (svg) => {
    const copy = svg.cloneNode(true), looks = new Set(), parts = [svg];
    const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]);
    for (const part of parts) { // copy the looks, shapes and hatches that the page defines once
      const names = new Set([part, ...part.querySelectorAll("[class]")].flatMap((one) => [...one.classList]));
      for (const { selectorText, cssText } of rules) if (/^\.l\d+$/.test(selectorText ?? "") && names.has(selectorText.slice(1))) looks.add(cssText);
      for (const [, id] of [part.outerHTML, ...looks].join("").matchAll(/#([\w.-]+)/g)) {
        const other = document.getElementById(id);
        if (other && !svg.contains(other) && !parts.includes(other)) parts.push(other);
      }
    }
    const [style, defined] = ["style", "defs"].map((name) => document.createElementNS(svg.namespaceURI, name));
    style.textContent = [...looks].join("\n");
    defined.append(...parts.slice(1).map((part) => part.cloneNode(true)));
    copy.prepend(style, defined);
    const shown = getComputedStyle(svg), [, , wide, high] = svg.getAttribute("viewBox").split(" ");
    copy.removeAttribute("style");
    for (const [name, value] of Object.entries({ width: `${wide}pt`, height: `${high}pt`, "font-family": shown.fontFamily, "font-size": shown.fontSize, fill: "var(--ink)", "stroke-linejoin": "round" })) copy.setAttribute(name, value);
    const colours = rules.find(({ selectorText, style: own }) => selectorText === ":root" && own.getPropertyValue("--ink")).style;
    return new XMLSerializer().serializeToString(copy).replace(/var\((--[\w-]+)\)/g, (_, name) => colours.getPropertyValue(name).trim());
  };

  // --- the page ----------------------------------------------------------------------------

  const save = (button) => {
    const { save: kind } = button.dataset, figure = button.closest("figure"), section = button.closest("section.table");
    if (figure) keep(nameOf(figure.querySelector("svg")), kind, svgOf(figure.querySelector("svg")));
    else if (section) keep(section.querySelector(".scroll").getAttribute("aria-label"), kind, { csv: csvOf, json: jsonOf }[kind](section.querySelector("table")));
    else keep("result", kind, document.getElementById("result").textContent);
  };
  addEventListener("click", ({ target }) => { if (target.matches?.("button[data-save]")) save(target); });

  const button = (kind, name) => {
    const made = document.createElement("button"), form = kind.toUpperCase();
    Object.assign(made, { type: "button", className: "copy", textContent: form });
    made.dataset.save = kind;
    made.setAttribute("aria-label", `Save ${form}: ${name}`);
    return made;
  };

  const offer = () => {
    for (const scroller of document.querySelectorAll("main section.table > .scroll")) {
      const before = scroller.previousElementSibling;
      if (before?.matches(".saves")) continue;
      const group = document.createElement("div"), name = scroller.getAttribute("aria-label");
      group.className = "saves";
      scroller.before(group);
      group.append(...(before?.matches(".copy") ? [before] : []), button("csv", name), button("json", name));
    }
    for (const svg of document.querySelectorAll("main figure svg")) {
      const figure = svg.closest("figure");
      if (figure.closest(".paper") || figure.querySelector("[data-save]")) continue;
      figure.append(button("svg", nameOf(svg)));
    }
  };
  document.querySelector("button.save")?.remove(); // the one of a page without tools
  followers.push(offer);
  addEventListener("drawn", offer); // a picture alone
