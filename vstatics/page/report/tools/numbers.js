  // What all tools of a page take: numbers as they are shown, what is known of cases and units.

  const known = JSON.parse(document.getElementById("known").textContent);
  let cases = {}; // by their labels, "" where there is one
  const readCases = () => {
    cases = {};
    for (const { dataset } of document.querySelectorAll("[data-of-case]")) cases[dataset.label ?? ""] = JSON.parse(dataset.ofCase);
  };

  const rounded = (value, decimals, digits) => { // as vstatics/tables/numbers.py: small numbers have more digits
    const size = Math.abs(value);
    if (!Number.isFinite(value)) return "\u2013";
    if (size >= 1e7) return value.toPrecision(6);
    const fixed = digits ?? (size < 0.1 && size > 1e-12 && decimals ? Math.max(decimals, 3 - Math.floor(Math.log10(size))) : decimals);
    const text = size.toFixed(Math.min(fixed, 20));
    return value < 0 && /[1-9]/.test(text) ? `\u2212${text}` : text;
  };
  globalThis.page = { rounded };

  const choices = { // kept where a page is loaded again
    read() { try { return JSON.parse(sessionStorage.getItem(`${location.pathname}#tools`)) ?? {}; } catch { return {}; } },
    keep(changed) {
      try { sessionStorage.setItem(`${location.pathname}#tools`, JSON.stringify({ ...this.read(), ...changed })); } catch { /* a file, in some browsers */ }
    },
  };

  // what is done anew with parts of the page that stand in place of others
  const followers = [];
  const follow = () => { readCases(); for (const one of followers) one(); };
  addEventListener("DOMContentLoaded", follow);
  addEventListener("shown", follow);

  // texts and attributes of elements that stay where they are; one of these may tell of a case, or of links
  const renumbered = [];
  addEventListener("renumbered", ({ detail }) => {
    if (detail.some((one) => "ofCase" in one.dataset || one.matches("h3, th"))) follow();
    else for (const one of renumbered) one(detail);
  });

  const tables = () => [...document.querySelectorAll("main .scroll > table")];
  const headsOf = (table) => [...[...table.tHead.rows].at(-1).cells];
  const nameOf = (part) => part.closest(".scroll")?.getAttribute("aria-label") ?? document.title;
