"use strict";
(() => {
  // A page that is served: numbers that are changed here are tried by the server and shown; what
  // is saved, here or by somebody else, comes as an event. Edits stay here until they are saved.
  const root = document.documentElement, { body } = document;
  const panel = document.getElementById("panel");
  const at = (id) => document.getElementById(id);
  const fields = () => [...document.querySelectorAll("input.field, input.slider")];
  const edits = new Map(); // path -> number, of those that are not as the file has them
  const steps = []; // what undo goes back to: maps of path -> number
  let ofFile = new Map(fields().map((one) => [one.dataset.path, Number(one.getAttribute("value"))]));
  let shown = Number(panel.dataset.shown); // the state whose pictures are asked for
  let { digest } = body.dataset; // of the files on which edits stand
  let [gone, conflict, saving, step] = [false, false, false, null];
  let errors = at("errors").textContent;
  const last = new Map(); // section -> what it was made of
  const { patches: { learn, nodesOf, patch }, typed } = globalThis;

  async function ask(route, options) {
    try {
      const answer = await fetch(route, { cache: "no-store", ...options });
      gone = false;
      return answer;
    } catch (error) {
      if (error.name !== "AbortError") { gone = true; tell(); }
      return null;
    }
  }

  function post(route, changes, headers = {}) {
    return ask(route, { method: "POST", headers, body: JSON.stringify({ changes: Object.fromEntries(changes) }) });
  }

  function tell() {
    body.dataset.state = gone ? "gone" : conflict ? "conflict" : errors ? "error" : "good";
    at("save").hidden = at("revert").hidden = !edits.size;
    at("undo").hidden = !steps.length;
    for (const one of ["conflict", "keep-mine", "take-file"]) at(one).hidden = !conflict;
    at("errors").hidden = !errors;
    at("errors").textContent = errors;
  }

  // An error makes the panel higher. The focused field is scrolled until the panel does not cover it.
  new ResizeObserver(() => {
    root.style.setProperty("--panel", `${panel.offsetHeight}px`);
    const { activeElement } = document;
    if (activeElement.matches("input.field, input.slider")) activeElement.scrollIntoView({ block: "nearest" });
  }).observe(panel);

  // --- what is shown -----------------------------------------------------------------------

  const key = ({ dataset: { result, row, gear } }) => [result, row, gear].join("\n");
  const numbered = (part) => [...part.querySelectorAll("[data-result]")];
  const numbers = (part) => new Map(numbered(part).map((one) => [key(one), one.dataset.number]));

  // those of a part with another content that are other than before
  function others(part, before) {
    const isOther = (one, old) => old !== undefined && old !== one.dataset.number;
    return numbered(part).filter((one) => isOther(one, before.get(key(one))));
  }

  function mark(changed, part = document) {
    for (const one of part.querySelectorAll("[data-changed]")) if (!changed.has(one)) one.removeAttribute("data-changed");
    for (const one of changed) one.setAttribute("data-changed", "");
  }

  function parsed(html) {
    const made = document.createElement("template");
    made.innerHTML = html;
    return made.content;
  }

  const bound = []; // what has tables with buttons, and where it belongs once others have theirs

  // other content of a part; pictures that are awaited stand there as they were until they come
  function put(part, made, ...before) {
    const kept = part.querySelector(":scope > .save"); // the script of every page put it there
    const old = new Map([...part.querySelectorAll("[data-awaited]")].map((one) => [one.dataset.awaited, one]));
    for (const one of made.querySelectorAll("[data-awaited]")) {
      const as = old.get(one.dataset.awaited);
      if (as?.querySelector("table")) bound.push([one, as]);
      else if (as) one.replaceWith(as);
    }
    const focused = part.contains(document.activeElement) && document.activeElement.dataset.choose;
    part.replaceChildren(...before, ...made.childNodes, ...(kept ? [kept] : []));
    if (focused) part.querySelector(`[data-choose="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
    return part;
  }

  // once for all parts: whoever hears it measures the page, and gives tables their buttons
  function announce(parts) {
    const tell = (detail) => dispatchEvent(new CustomEvent("shown", { detail }));
    tell(parts);
    const back = bound.splice(0);
    for (const [place, one] of back) place.replaceWith(one);
    if (back.length) tell([]);
  }

  const heading = (part) => part.querySelector("h2");
  const sections = () => [...document.querySelectorAll("main > section")];

  // the sections of an answer in their order: others leave, new ones come
  function arrange(wanted) {
    const there = new Map(sections().map((one) => [one.id, one]));
    for (const [name, one] of there) if (!(name in wanted)) one.remove();
    let before = null;
    for (const [name, html] of Object.entries(wanted)) {
      const part = there.get(name) ?? parsed(html).firstElementChild;
      if (!there.has(name)) before ? before.after(part) : document.querySelector("main").prepend(part);
      before = part;
    }
    document.querySelector(".contents").replaceChildren(...sections().map((one) => {
      const link = document.createElement("a");
      [link.href, link.textContent] = [`#${one.id}`, heading(one).textContent];
      return link;
    }));
  }

  // what is being read stays where it is, whatever changes above it
  function staying(work) {
    const top = (one) => one.getBoundingClientRect().top;
    const read = sections().findLast((one) => top(one) < 0.4 * innerHeight);
    const before = read && top(read);
    work();
    if (read?.isConnected) scrollBy({ top: top(read) - before, behavior: "instant" });
  }

  // an answer of the files, or of numbers that are tried, which never make another head
  function show(answer, tried = false) {
    errors = answer.errors;
    if (answer.sections) {
      if (!tried && answer.head !== panel.dataset.head) { location.reload(); return; }
      shown = answer.number;
      mark(renew(answer));
      at("result").textContent = JSON.stringify(answer.document);
      stale();
    }
    root.dataset.revision = Math.max(Number(root.dataset.revision) + 1, answer.number);
    tell();
  }

  // numbers in their places where nothing else changes, else other sections; what changed
  function renew(answer) {
    const changed = new Set(), patched = [], parts = [];
    const names = sections().map((one) => one.id);
    if (names.join("\n") !== Object.keys(answer.sections).join("\n")) staying(() => arrange(answer.sections));
    for (const part of sections()) {
      const html = answer.sections[part.id];
      if (part.id === "change") change(part, answer.fields, html);
      else if (html !== last.get(part)) {
        const done = patch(part, html);
        if (!done) parts.push([part, html]);
        for (const one of done?.numbers ?? []) changed.add(one);
        patched.push(...done?.changed ?? []);
      }
      last.set(part, html);
    }
    if (patched.length) dispatchEvent(new CustomEvent("renumbered", { detail: patched }));
    if (parts.length) staying(() => {
      const before = parts.map(([part]) => numbers(part));
      announce(parts.map(([part, html]) => fresh(part, html)));
      parts.forEach(([part], n) => { for (const one of others(part, before[n])) changed.add(one); });
    });
    return changed;
  }

  // a section with other content below its heading
  function fresh(part, html) {
    const made = parsed(html).firstElementChild, nodes = nodesOf(made);
    nodes.splice(0, 3, part, heading(part), heading(part).firstChild);
    learn(part, html, nodes);
    heading(made).remove();
    return put(part, made, heading(part));
  }

  // what the sections of this page were made of, once it is quiet: the first change is as fast as others
  const first = new Map(sections().map((part) => [part, nodesOf(part)]));
  async function learnFirst() {
    const answer = await ask("shown"), told = answer?.ok ? await answer.json() : {};
    for (const [part, nodes] of first) {
      const html = told.sections?.[part.id];
      if (told.number !== shown || last.has(part) || !html || part.id === "change") continue;
      learn(part, html, nodes);
      last.set(part, html);
    }
    first.clear();
  }

  // fields have the numbers of the file but where there are edits
  function change(part, now, html) {
    const same = [...ofFile.keys()].join("\n") === Object.keys(now).join("\n");
    ofFile = new Map(Object.entries(now));
    if (!same || !ofFile.size) fresh(part, html); // of a deck nothing can be filled in
    for (const [path, value] of edits) if (!ofFile.has(path) || ofFile.get(path) === value) edits.delete(path);
    const byPath = Map.groupBy?.(fields(), (one) => one.dataset.path);
    for (const path of ofFile.keys()) fill(path, edits.get(path) ?? ofFile.get(path), null, byPath?.get(path));
  }

  function fill(path, value, but, all = fields()) {
    for (const one of all) {
      if (one.dataset.path !== path || one === but) continue;
      if (one.type === "range") {
        if (value < Number(one.min)) one.min = value;
        if (value > Number(one.max)) one.max = value;
      }
      typed.write(one, value);
    }
  }

  // --- pictures and slow sections: made when they are looked at, pale until then ----------------

  const inSight = new Set();
  const watcher = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      if (isIntersecting) inSight.add(target);
      else inSight.delete(target);
    }
    soon();
  }, { rootMargin: "200px" });
  const watched = new WeakSet();
  let drawing = null, waiting;

  function stale() {
    drawing?.abort();
    for (const one of document.querySelectorAll("[data-awaited]")) one.classList.add("pale");
    watch();
  }

  function watch() {
    for (const one of document.querySelectorAll("[data-awaited]")) {
      if (watched.has(one)) continue;
      watched.add(one);
      watcher.observe(one);
    }
    soon(150); // a slider may still be moving
  }

  function soon(delay = 0) {
    clearTimeout(waiting);
    waiting = setTimeout(draw, delay);
  }

  async function draw() {
    if (drawing) return;
    const all = [...document.querySelectorAll("[data-awaited].pale")];
    const next = all.find((one) => inSight.has(one)) ?? all.find((one) => "soon" in one.dataset);
    if (!next || gone) return;
    const own = drawing = new AbortController();
    const asked = new URLSearchParams({ number: shown, name: next.dataset.awaited });
    const answer = await ask(`part?${asked}`, { signal: own.signal });
    const html = answer?.ok ? await answer.text().catch(() => null) : null;
    drawing = null;
    if (!own.signal.aborted && answer) {
      next.classList.remove("pale");
      if (html !== null) {
        const before = numbers(next);
        put(next, parsed(html));
        if (next.closest(".run-moves") || next.querySelector("table, [data-gear], [data-choose]")) announce([next]);
        else dispatchEvent(new Event("drawn")); // a picture alone
        mark(new Set(others(next, before)), next);
        for (const one of next.querySelectorAll("[data-awaited]")) one.classList.add("pale");
      }
    }
    watch();
  }

  // --- edits -----------------------------------------------------------------------------------

  const now = (path) => edits.get(path) ?? ofFile.get(path);

  function set(path, value, but) {
    if (value === ofFile.get(path)) edits.delete(path);
    else edits.set(path, value);
    fill(path, value, but);
  }

  let trying = false, again = false;

  async function attempt() {
    tell();
    if (trying) { again = true; return; }
    trying = true;
    do {
      again = false;
      const answer = edits.size ? await post("try", edits) : await ask("shown");
      if (!answer || again || saving) continue;
      if (answer.ok) show(await answer.json(), edits.size > 0);
      else { errors = (await answer.text()).trim(); tell(); }
    } while (again);
    trying = false;
  }

  // what comes from one field without a pause is one step of undo
  let pause;
  addEventListener("input", ({ target }) => {
    if (!target.matches("input.field, input.slider")) return;
    const { path } = target.dataset, value = typed.read(target);
    if (Number.isNaN(value) || value === now(path)) return;
    if (step !== path) steps.push(new Map([[path, now(path)]]));
    step = path;
    clearTimeout(pause);
    pause = setTimeout(() => { step = null; }, 500);
    set(path, value, target);
    attempt();
  });
  addEventListener("change", () => { step = null; });

  at("undo").addEventListener("click", () => {
    step = null;
    for (const [path, value] of steps.pop() ?? []) if (ofFile.has(path)) set(path, value);
    attempt();
  });

  function drop() {
    step = null;
    if (edits.size) steps.push(new Map(edits));
    for (const path of [...edits.keys()]) set(path, ofFile.get(path));
    for (const one of fields()) typed.restore(one, ofFile.get(one.dataset.path));
  }

  at("revert").addEventListener("click", () => { drop(); attempt(); });

  async function save(headers) {
    if (saving || !edits.size) return;
    saving = true;
    step = null;
    const answer = await post("save", edits, headers);
    if (answer?.ok) {
      const told = await answer.json();
      ({ digest } = told);
      conflict = false;
      show(told);
    } else if (answer?.status === 412) {
      conflict = true;
    } else if (answer) {
      errors = (await answer.text()).trim();
    }
    saving = false;
    tell();
    if (heard) hear(heard);
  }

  at("save").addEventListener("click", () => save({ "If-Match": `"${digest}"` }));
  at("keep-mine").addEventListener("click", () => save({}));
  at("take-file").addEventListener("click", async () => {
    drop();
    conflict = false;
    await take();
  });

  // --- what others do --------------------------------------------------------------------------

  async function take() {
    drawing?.abort(); // numbers first
    const answer = await ask("shown");
    if (!answer?.ok) return;
    const told = await answer.json();
    ({ digest } = told);
    show(told);
  }

  let heard = null, known = Number(root.dataset.revision);
  function hear(told) {
    heard = saving ? told : null;
    if (saving) return;
    gone = false;
    if (edits.size && told.digest !== digest) conflict = true;
    else if (conflict) { conflict = false; attempt(); } // the file is as it was
    else if (edits.size && told.number !== known) attempt(); // a file beside the case
    else if (told.number > shown || told.errors !== errors || told.digest !== digest) take();
    known = told.number;
    tell();
  }

  const events = new EventSource("events");
  events.addEventListener("message", ({ data }) => hear(JSON.parse(data)));
  events.addEventListener("error", () => { gone = true; tell(); });

  // --- a page that is loaded again keeps its edits ---------------------------------------------

  addEventListener("pagehide", () => {
    const { revision } = root.dataset;
    const kept = { digest, revision, edits: [...edits], steps: steps.map((one) => [...one]) };
    sessionStorage.setItem(location.pathname, JSON.stringify(kept));
  });
  const kept = JSON.parse(sessionStorage.getItem(location.pathname) ?? "null");
  if (kept) {
    root.dataset.revision = Math.max(Number(root.dataset.revision), Number(kept.revision) + 1);
    steps.push(...kept.steps.map((one) => new Map(one)));
    for (const [path, value] of kept.edits) if (ofFile.has(path)) set(path, value);
    if (edits.size) {
      ({ digest } = kept);
      attempt();
    }
  }
  stale();
  tell();
  setTimeout(learnFirst, 300);
})();
