// A run that moves: panels that are zoomed together, a time that levers, tables and stick follow.
"use strict";
(() => {
  const RPM = 30 / Math.PI, HEIGHT = 170, LEFT = 70, ROW = 22;
  const root = document.documentElement;
  const css = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();
  const numbers = (text) => new Float64Array(Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer);
  const known = (value) => (Number.isFinite(value) ? value : null);

  function shown(value) { // four digits, as pictures have them
    if (value === 0) return "0";
    if (!Number.isFinite(value)) return "\u2013";
    const size = Math.abs(Number(value.toPrecision(4)));
    if (size >= 1e6) return value.toPrecision(4).replace("-", "\u2212");
    const text = value.toFixed(3 - (size >= 10) - (size >= 100) - (size >= 1000));
    return /[1-9]/.test(text) ? text.replace("-", "\u2212") : text.replace("-", "");
  }

  // what is chosen outlives the section, which a page that is served replaces
  const kept = { time: null, low: null, high: null, closed: new Set(), focused: false };

  class Run {
    constructor(box) {
      this.box = box;
      const record = this.record = JSON.parse(box.dataset.record);
      box.removeAttribute("data-record");
      this.time = numbers(record.time);
      this.columns = record.columns.map((text) => {
        const values = numbers(text); // one where all are equal
        return values.length === this.time.length ? values : this.time.map(() => values[0]);
      });
      this.first = this.time[0];
      this.last = this.time.at(-1);
      this.slider = box.querySelector("#time");
      this.low = Math.max(kept.low ?? this.first, this.first);
      this.high = Math.min(kept.high ?? this.last, this.last);
      if (!(this.low < this.high)) [this.low, this.high] = [this.first, this.last];
      this.now = Math.min(Math.max(kept.time ?? this.first, this.first), this.last);
      this.under = null; // the time under a pointer, which is shown as long as it is there
      box.hidden = false;
      box.parentElement.querySelector(".run-still")?.classList.add("paper");
      this.plots = [];
      this.rows();
      for (const panel of record.panels) this.panel(panel);
      this.listen();
      this.show();
      if (kept.focused) this.slider.focus({ preventScroll: true });
    }

    // --- numbers at a time -------------------------------------------------------------------

    before(time) { // the last instant that is not after it; of a jump the second
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

    // --- panels ------------------------------------------------------------------------------

    figure(kind, title) {
      const one = document.createElement("details");
      one.className = "run-panel";
      one.dataset.panel = kind;
      one.open = !kept.closed.has(title);
      const head = document.createElement("summary"), legend = document.createElement("ul"), plot = document.createElement("div");
      head.textContent = title;
      plot.className = "run-plot";
      plot.setAttribute("role", "img");
      plot.setAttribute("aria-label", `${title} over time`);
      legend.className = "run-legend";
      one.append(head, legend, plot);
      this.box.querySelector(".run-panels").append(one);
      one.addEventListener("toggle", () => {
        if (one.open) kept.closed.delete(title);
        else kept.closed.add(title);
        this.size();
      });
      return { one, legend, plot };
    }

    legend(list, label, colour, dashed) {
      const item = document.createElement("li"), sign = document.createElement("i"), value = document.createElement("b");
      sign.style.borderTop = `3px ${dashed ? "dashed" : "solid"} var(--${colour})`;
      item.append(sign, `${label} `, value);
      list.append(item);
      return value;
    }

    panel({ kind, title, unit, per, lines, leftOut }) {
      const { one, legend, plot } = this.figure(kind, unit ? `${title}, ${unit}` : title);
      const scaled = (column, as = (value) => value) => Array.from(this.columns[column], (value) => known(as(value) / per));
      const data = [this.time], series = [{}], told = [];
      for (const line of lines) {
        const stroke = () => css(line.colour), dash = line.dash.map((length) => 1.3 * length);
        if ("capacity" in line) {
          data.push(scaled(line.capacity));
          series.push({ stroke, width: 1, dash: [3, 3], auto: false, points: { show: false } });
        }
        data.push(scaled(line.column));
        series.push({ label: line.label, stroke, width: 1.6, dash, points: { show: false } });
        told.push([this.legend(legend, line.label, line.colour, dash.length), line.column, per, unit, line.heading]);
      }
      if (leftOut.length) {
        const item = document.createElement("li");
        item.className = "note";
        item.textContent = `left out, as they are small: ${leftOut.join(", ")}`;
        legend.append(item);
      }
      const limits = lines.flatMap((line) => ("capacity" in line ? [scaled(line.capacity)] : []));
      const range = (plotted, low, high) => this.range(low ?? 0, high ?? 0, limits);
      this.plot({ one, plot, told, lines }, data, series, { range }, { size: LEFT });
    }

    range(low, high, limits) { // with 0, if the whole run is shown, and capacities that are near
      if (this.isWhole) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
      const most = 1.25 * Math.max(Math.abs(low), Math.abs(high));
      const [from, to] = [this.before(this.low), this.before(this.high)];
      for (const values of limits) {
        for (let n = from; n <= to; n += 1) {
          if (values[n] === null || Math.abs(values[n]) > most) continue;
          [low, high] = [Math.min(low, values[n]), Math.max(high, values[n])];
        }
      }
      const room = 0.06 * (high - low) || Math.abs(high) || 1;
      return [low - room, high + room];
    }

    // what shift elements do, and the gears that hold, in rows
    rows() {
      const { elements, gears } = this.record;
      const moving = elements.filter((one) => one.slips?.length || one.sticks?.length);
      if (!moving.length) return;
      const { one, legend, plot } = this.figure("elements", "shift elements");
      const told = moving.map((element) => [this.legend(legend, element.name, "engaged", false), element]);
      const count = moving.length + (gears.length > 0);
      const splits = () => Array.from({ length: count }, (_, n) => count - n - 0.5);
      const names = [...(gears.length ? ["gear"] : []), ...moving.map(({ name }) => (name.length > 10 ? `${name.slice(0, 9)}\u2026` : name))];
      const draw = (plotted) => {
        const { ctx } = plotted, bar = ([low, high], row, colour, part) => {
          const left = plotted.valToPos(Math.max(low, this.low), "x", true), right = plotted.valToPos(Math.min(high, this.high), "x", true);
          const top = plotted.valToPos(row + 0.5 + part / 2, "y", true), foot = plotted.valToPos(row + 0.5 - part / 2, "y", true);
          if (right <= left) return 0;
          ctx.fillStyle = css(colour);
          ctx.fillRect(left, top, right - left, foot - top);
          return right - left;
        };
        ctx.save();
        moving.forEach((element, n) => {
          const row = moving.length - 1 - n;
          for (const span of element.sticks ?? []) bar(span, row, "engaged", 0.7);
          for (const span of element.slips ?? []) bar(span, row, "lost", 0.35);
        });
        ctx.textAlign = "center";
        ctx.textBaseline = "middle";
        for (const [name, low, high] of gears) {
          const wide = bar([low, high], moving.length, "shade", 0.8);
          if (wide < ctx.measureText(name).width) continue;
          ctx.fillStyle = css("ink");
          const middle = (Math.max(low, this.low) + Math.min(high, this.high)) / 2;
          ctx.fillText(name, plotted.valToPos(middle, "x", true), plotted.valToPos(moving.length + 0.5, "y", true));
        }
        ctx.restore();
      };
      const axis = { size: LEFT, splits, values: () => names, grid: { show: false }, ticks: { show: false } };
      const data = [this.time, Array(this.time.length).fill(null)];
      this.plot({ one, plot, told, states: true, high: count * ROW + 40 }, data, [{}, {}], { range: () => [0, count] }, axis, draw);
    }

    plot(panel, data, series, y, axis, draw = () => {}) {
      const line = { stroke: () => css("ink"), grid: { stroke: () => css("line"), width: 1 }, ticks: { stroke: () => css("line"), width: 1 }, font: "12px system-ui, sans-serif" };
      const verticals = (plotted) => {
        const { ctx, bbox } = plotted;
        ctx.save();
        ctx.strokeStyle = css("soft");
        ctx.setLineDash([2, 4]);
        ctx.beginPath();
        for (const { time } of this.record.events) {
          if (time < this.low || time > this.high) continue;
          const x = plotted.valToPos(time, "x", true);
          ctx.moveTo(x, bbox.top);
          ctx.lineTo(x, bbox.top + bbox.height);
        }
        ctx.stroke();
        ctx.restore();
        draw(plotted);
      };
      const selected = (plotted) => {
        const { left, width } = plotted.select;
        plotted.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        if (width > 4) this.zoom(plotted.posToVal(left, "x"), plotted.posToVal(left + width, "x"));
      };
      const options = {
        width: this.wide(), height: panel.high ?? HEIGHT, pxAlign: 0, series, padding: [8, 12, 0, 0], legend: { show: false },
        scales: { x: { time: false, range: () => [this.low, this.high] }, y },
        axes: [{ ...line, size: 32 }, { ...line, ...axis, grid: { ...line.grid, ...axis.grid }, ticks: { ...line.ticks, ...axis.ticks } }],
        cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false, setScale: false }, bind: { dblclick: () => () => { this.whole(); } } },
        hooks: { setSelect: [selected], draw: [verticals] },
      };
      const plotted = new uPlot(options, data, panel.plot), cursor = document.createElement("div");
      cursor.className = "run-cursor";
      plotted.over.append(cursor);
      const under = (event) => plotted.posToVal(event.clientX - plotted.over.getBoundingClientRect().left, "x");
      let pressed = null;
      plotted.over.addEventListener("pointermove", (event) => {
        if (event.buttons) return;
        this.under = under(event);
        this.later();
      });
      plotted.over.addEventListener("pointerleave", () => { this.under = null; this.later(); });
      plotted.over.addEventListener("pointerdown", (event) => { pressed = event.clientX; });
      plotted.over.addEventListener("pointerup", (event) => {
        if (Math.abs(event.clientX - pressed) > 4) return;
        this.go(under(event));
        this.slider.focus({ preventScroll: true });
      });
      this.plots.push({ ...panel, plotted, cursor });
    }

    wide() { return Math.max(240, this.box.querySelector(".run-panels").clientWidth); }

    size() {
      for (const { plotted, high, one } of this.plots) if (one.open && this.wide() !== plotted.width) plotted.setSize({ width: this.wide(), height: high ?? HEIGHT });
      this.later();
    }

    // --- what is chosen ----------------------------------------------------------------------

    get isWhole() { return this.low === this.first && this.high === this.last; }

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
      for (const { plotted } of this.plots) plotted.setScale("x", { min: this.low, max: this.high });
      for (const one of this.box.querySelectorAll("[data-run=whole], [data-run=zoom-out]")) one.disabled = this.isWhole;
      this.later();
    }

    nearer(part) { // what is seen becomes so many times as long about the time
      this.zoom(this.now - part * (this.now - this.low), this.now + part * (this.high - this.now));
    }

    whole() {
      this.zoom(this.first, this.last);
      kept.low = kept.high = null;
    }

    later() { // once for all that moves before the next picture
      if (this.waits) return;
      this.waits = true;
      requestAnimationFrame(() => { this.waits = false; this.show(); });
    }

    show() {
      const time = this.under ?? this.now, { record, box } = this;
      this.slider.value = time;
      this.slider.setAttribute("aria-valuetext", `${time.toFixed(4)} s`);
      box.querySelector(".time-now").textContent = time.toFixed(4);
      box.dataset.time = time;
      this.words(time);
      for (const { plotted, cursor, told, states } of this.plots) {
        const at = plotted.valToPos(time, "x");
        cursor.hidden = time < this.low || time > this.high;
        cursor.style.transform = `translateX(${at}px)`;
        for (const [element, of, per, unit, heading] of told) {
          if (states) { element.textContent = this.state(of, time); continue; }
          const value = this.at(of, time);
          element.textContent = `${shown(value / per)}${unit ? `\u00a0${unit}` : ""}`;
          element.dataset.heading = heading;
          element.dataset.number = known(value) ?? "";
        }
      }
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
      const gear = this.record.gears.find(([, low, high]) => low <= time && time <= high);
      const event = this.record.events.findLast((one) => one.time <= time);
      const said = [gear ? `gear ${gear[0]}` : "", event ? `${event.told} at ${event.time.toFixed(4)} s` : ""].filter(Boolean).join("; last: ");
      const line = this.box.querySelector(".gear-now");
      if (line.textContent !== said) line.textContent = said;
    }

    element(row, time) {
      const element = this.record.elements.find(({ name }) => name === row.dataset.element);
      const [state, slip, torque] = row.querySelectorAll("td");
      state.textContent = row.dataset.state = this.state(element, time);
      for (const [cell, column, per] of [[slip, element.slip, RPM], [torque, element.torque, 1]]) {
        const value = this.at(column, time);
        cell.textContent = shown(value * per);
        cell.dataset.number = value;
      }
    }

    levers(time) { // all to one scale, so that they can be compared
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

    beside(way, isEvent) { // the next instant, or event, that way
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
        event.stopPropagation(); // left and right would choose gears
        act(event);
      });
      this.slider.addEventListener("input", () => this.go(this.slider.valueAsNumber));
      const buttons = { "zoom-in": () => this.nearer(0.5), "zoom-out": () => this.nearer(2), whole: () => this.whole(), csv: () => this.save() };
      for (const one of this.box.querySelectorAll("[data-run]")) one.addEventListener("click", buttons[one.dataset.run]);
      for (const one of this.box.querySelectorAll("[data-run=whole], [data-run=zoom-out]")) one.disabled = this.isWhole;
      this.slider.addEventListener("focus", () => { kept.focused = true; });
      this.slider.addEventListener("blur", () => setTimeout(() => { // where the section is not just replaced
        if (this.slider.isConnected) kept.focused = false;
      }));
      this.observer = new ResizeObserver(() => this.size());
      this.observer.observe(this.box.querySelector(".run-panels"));
    }

    // --- what is seen, as CSV: headings, units and digits as `vstatics simulate -f csv` has them

    csv() {
      const columns = new Map([["time", this.time]]);
      for (const { one, lines } of this.plots) {
        for (const line of (one.open && lines) || []) {
          columns.set(line.heading, this.columns[line.column]);
          if ("capacity" in line) columns.set(line.capacityHeading, this.columns[line.capacity].map(Math.abs));
        }
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

    end() {
      this.observer.disconnect();
      for (const { plotted } of this.plots) plotted.destroy();
    }
  }

  let run = null;
  function begin() {
    if (run && !run.box.isConnected) { run.end(); run = null; }
    const box = document.querySelector(".run-moves[data-record]");
    if (box) run = new Run(box);
    else run?.show(); // the stick diagram may be new
  }
  begin();
  addEventListener("shown", begin);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    for (const { plotted } of run?.plots ?? []) plotted.redraw(false);
  });
})();
