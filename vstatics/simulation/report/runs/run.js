// Interactive run: panels, levers, tables and the stick diagram at a selected time; keys, CSV.
"use strict";
(() => {
  const RPM = 30 / Math.PI, { Panels, shown, known } = globalThis.runPanels;
  const numbers = (text) => { // decodes numbers: the first bytes of all numbers, then all second bytes
    const parts = atob(text), count = parts.length / 8;
    return new Float64Array(Uint8Array.from(parts, (_, n) => parts.charCodeAt((n % 8) * count + (n >> 3))).buffer);
  };

  // Choices outlive the section, because a served page replaces it after each change of the case.
  const kept = { time: null, low: null, high: null, closed: new Set(), focused: false };

  class Run {
    constructor(box) {
      this.box = box;
      this.record = JSON.parse(box.dataset.record);
      box.removeAttribute("data-record");
      this.time = numbers(this.record.time);
      this.columns = this.record.columns.map((text) => {
        const values = numbers(text); // a constant column has one number
        return values.length === this.time.length ? values : this.time.map(() => values[0]);
      });
      this.first = this.time[0];
      this.last = this.time.at(-1);
      this.slider = box.querySelector("#time");
      this.low = Math.max(kept.low ?? this.first, this.first);
      this.high = Math.min(kept.high ?? this.last, this.last);
      if (!(this.low < this.high)) [this.low, this.high] = [this.first, this.last];
      this.now = Math.min(Math.max(kept.time ?? this.first, this.first), this.last);
      this.under = null; // time under the pointer, if any
      box.hidden = false;
      box.parentElement.querySelector(".run-still")?.classList.add("paper");
      this.panels = new Panels(this, kept.closed);
      this.listen();
      this.show();
      dispatchEvent(new Event("resize")); // elements wider than the page become stops of the Tab key
      if (kept.focused) this.slider.focus({ preventScroll: true });
    }

    // --- numbers at a time -------------------------------------------------------------------

    before(time) { // index of the last instant up to a time; at a jump, the second instant
      let low = 0, high = this.time.length - 1;
      while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (this.time[middle] <= time) low = middle;
        else high = middle - 1;
      }
      return low;
    }

    at(column, time) {
      const values = this.columns[column], place = this.before(time);
      if (this.time[place] === time || place + 1 === values.length) return values[place];
      const part = (time - this.time[place]) / (this.time[place + 1] - this.time[place]);
      return values[place] + part * (values[place + 1] - values[place]);
    }

    state(element, time) {
      const within = (spans) => spans?.some(([low, high]) => low <= time && time < high || time === this.last && high === time);
      return within(element.sticks) ? "sticks" : within(element.slips) ? "slips" : "open";
    }

    // --- selected time and section of time ----------------------------------------------------------------------

    get isWhole() { return this.low === this.first && this.high === this.last; }

    point(time) { // shows a time while the pointer is there; null: the pointer has left
      this.under = time;
      this.later();
    }

    go(time) {
      this.now = kept.time = Math.min(Math.max(time, this.first), this.last);
      this.under = null;
      const wide = this.high - this.low;
      if (this.now < this.low) this.zoom(this.now, this.now + wide);
      else if (this.now > this.high) this.zoom(this.now - wide, this.now);
      this.show();
    }

    zoom(low, high) {
      const least = 1e-9 * (this.last - this.first);
      if (!(high - low > least)) return;
      this.low = kept.low = Math.max(low, this.first);
      this.high = kept.high = Math.min(high, this.last);
      this.panels.zoom();
      for (const one of this.box.querySelectorAll("[data-run=whole], [data-run=zoom-out]")) one.disabled = this.isWhole;
      this.later();
    }

    nearer(part) { // scales the visible section by a factor about the selected time
      this.zoom(this.now - part * (this.now - this.low), this.now + part * (this.high - this.now));
    }

    whole() {
      this.zoom(this.first, this.last);
      kept.low = kept.high = null;
    }

    later() { // shows all changes together in the next animation frame
      if (this.waits) return;
      this.waits = true;
      requestAnimationFrame(() => { this.waits = false; this.show(); });
    }

    show() {
      const time = this.under ?? this.now, { record, box } = this;
      this.slider.value = time;
      const at = time.toFixed(4);
      this.slider.setAttribute("aria-valuetext", `${at} s`);
      box.querySelector(".time-now").textContent = at;
      box.dataset.time = time;
      this.words(time);
      this.panels.show(time);
      for (const row of box.querySelectorAll("[data-element]")) this.element(row, time);
      for (const cell of box.querySelectorAll("td[data-link]")) {
        const speed = this.at(record.links[cell.dataset.link], time);
        cell.textContent = shown(speed * RPM);
        cell.dataset.number = speed;
      }
      this.levers(time);
      this.stick(time);
    }

    words(time) {
      const [gear] = this.record.gears.find(([, low, high]) => low <= time && time <= high) ?? [];
      const event = this.record.events.findLast((one) => one.time <= time), told = event?.told, at = event?.time.toFixed(4);
      const last = event ? `${told} at ${at} s` : "";
      const said = gear === undefined ? last : event ? `gear ${gear}; last: ${last}` : `gear ${gear}`;
      const line = this.box.querySelector(".gear-now");
      if (line.textContent !== said) line.textContent = said;
    }

    element(row, time) {
      const element = this.record.elements.find(({ name }) => name === row.dataset.element);
      const [state, slip, torque] = row.querySelectorAll("td");
      row.dataset.state = this.state(element, time);
      state.textContent = this.record.words[row.dataset.state];
      for (const [cell, column, per] of [[slip, element.slip, RPM], [torque, element.torque, 1]]) {
        const value = this.at(column, time);
        cell.textContent = shown(value * per);
        cell.dataset.number = value;
      }
    }

    levers(time) { // with a common scale, so that levers can be compared
      const { links } = this.record;
      this.ends ??= [...new Set([...this.box.querySelectorAll(".levers-now [data-link]")].map((one) => links[one.dataset.link]))]
        .reduce(([low, high], column) => this.columns[column].reduce(([a, b], value) => [Math.min(a, value), Math.max(b, value)], [low, high]), [0, 0]);
      const [low, high] = this.ends;
      for (const svg of this.box.querySelectorAll(".levers-now svg")) {
        const from = Number(svg.dataset.from), to = Number(svg.dataset.to);
        const across = (speed) => from + ((speed - low) / (high - low || 1)) * (to - from);
        const points = [], set = (one, name, value) => one.setAttribute(name, value.toFixed(2));
        for (const end of ["x1", "x2"]) set(svg.querySelector(".rest"), end, across(0));
        for (const point of svg.querySelectorAll("[data-at]")) {
          const { link } = point.dataset, speed = link === undefined ? 0 : this.at(links[link], time), bar = point.querySelector(".speed");
          set(bar, "x1", across(0));
          set(bar, "x2", across(speed));
          point.dataset.number = speed;
          point.querySelector(".number").textContent = shown(speed * RPM);
          points.push(`${across(speed).toFixed(2)},${point.dataset.at}`);
        }
        points.sort((one, other) => one.split(",")[1] - other.split(",")[1]);
        svg.querySelector(".through")?.setAttribute("points", points.join(" "));
      }
    }

    stick(time) {
      const states = new Map(this.record.elements.map((one) => [one.name, this.state(one, time)]));
      for (const one of this.box.querySelectorAll(".stick-now g.element")) one.dataset.state = states.get(one.dataset.name) ?? "open";
    }

    // --- keys, buttons -----------------------------------------------------------------------

    beside(way, isEvent) { // the next instant, or event, in a direction
      const times = isEvent ? this.record.events.map(({ time }) => time) : Array.from(this.time);
      return (way > 0 ? times.find((one) => one > this.now) : times.findLast((one) => one < this.now)) ?? this.now;
    }

    listen() {
      const tenth = () => (this.high - this.low) / 10;
      const keys = {
        ArrowLeft: ({ shiftKey }) => this.go(this.beside(-1, shiftKey)), ArrowRight: ({ shiftKey }) => this.go(this.beside(1, shiftKey)),
        ArrowDown: () => this.go(this.beside(-1)), ArrowUp: () => this.go(this.beside(1)),
        PageDown: () => this.go(this.now - tenth()), PageUp: () => this.go(this.now + tenth()),
        Home: () => this.go(this.first), End: () => this.go(this.last),
        "+": () => this.nearer(0.5), "=": () => this.nearer(0.5), "-": () => this.nearer(2), Escape: () => this.whole(),
      };
      this.box.addEventListener("keydown", (event) => {
        const act = keys[event.key], moves = event.target === this.slider || event.target.matches(".run-buttons button");
        if (!act || !moves || event.altKey || event.ctrlKey || event.metaKey) return;
        event.preventDefault();
        event.stopPropagation(); // otherwise the arrow keys would choose gears
        act(event);
      });
      this.slider.addEventListener("input", () => this.go(this.slider.valueAsNumber));
      const buttons = { "zoom-in": () => this.nearer(0.5), "zoom-out": () => this.nearer(2), whole: () => this.whole(), csv: () => this.save() };
      for (const one of this.box.querySelectorAll("[data-run]")) one.addEventListener("click", buttons[one.dataset.run]);
      for (const one of this.box.querySelectorAll("[data-run=whole], [data-run=zoom-out]")) one.disabled = this.isWhole;
      this.slider.addEventListener("focus", () => { kept.focused = true; });
      this.slider.addEventListener("blur", () => setTimeout(() => { // unless a new section replaces this section
        if (this.slider.isConnected) kept.focused = false;
      }));
    }

    // --- visible section as CSV, with headings, units and digits of `vstatics simulate -f csv`

    csv() {
      const columns = new Map([["time", this.time]]);
      for (const line of this.panels.lines) {
        columns.set(line.heading, this.columns[line.column]);
        if ("capacity" in line) columns.set(line.capacityHeading, this.columns[line.capacity].map(Math.abs));
      }
      const field = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
      const rows = [[...columns.keys()].map(field).join(",")];
      this.time.forEach((time, n) => {
        if (time < this.low || time > this.high) return;
        rows.push([...columns.values()].map((values) => known(values[n]) ?? "").join(","));
      });
      return `${rows.join("\n")}\n`;
    }

    save() {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([this.csv()], { type: "text/csv" }));
      link.download = "run.csv";
      link.click();
      URL.revokeObjectURL(link.href);
    }
  }

  let run = null;
  function begin() {
    if (run && !run.box.isConnected) { run.panels.end(); run = null; }
    const box = document.querySelector(".run-moves[data-record]");
    if (box) run = new Run(box);
    else run?.show(); // the stick diagram can be new
  }
  begin();
  addEventListener("shown", begin);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => run?.panels.redraw());
})();
