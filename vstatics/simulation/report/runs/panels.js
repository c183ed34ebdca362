// Panels of a run: lines drawn by uPlot, zoomed together, with values at the selected time.
"use strict";
(() => {
  const HEIGHT = 170, LEFT = 70, ROW = 22;
  const root = document.documentElement;
  const css = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();
  const known = (value) => (Number.isFinite(value) ? value : null);

  function shown(value) { // text with four digits, as in pictures
    if (value === 0) return "0";
    if (!Number.isFinite(value)) return "\u2013";
    const size = Math.abs(Number(value.toPrecision(4)));
    if (size >= 1e6) return value.toPrecision(4).replace("-", "\u2212");
    const text = value.toFixed(3 - (size >= 10) - (size >= 100) - (size >= 1000));
    return /[1-9]/.test(text) ? text.replace("-", "\u2212") : text.replace("-", "");
  }

  // Numbers at axes, as in tables: without the separators for thousands of the browser's language.
  const ticks = (plotted, places) => places.map((place) => (
    place === null ? "" : String(Number(place.toPrecision(12))).replaceAll("-", "\u2212")));

  class Panels {
    constructor(run, closed) { // closed: titles of folded panels
      this.run = run;
      this.closed = closed;
      this.place = run.box.querySelector(".run-panels");
      this.plots = [];
      this.rows();
      for (const panel of run.record.panels) this.panel(panel);
      this.observer = new ResizeObserver(() => this.size());
      this.observer.observe(this.place);
    }

    figure(kind, title) {
      const key = `${title} ${this.plots.length}`, one = document.createElement("details");
      one.className = "run-panel";
      one.dataset.panel = kind;
      one.open = !this.closed.has(key);
      const head = document.createElement("summary"), legend = document.createElement("ul"), plot = document.createElement("div");
      head.textContent = title;
      plot.className = "run-plot";
      plot.setAttribute("role", "img");
      plot.setAttribute("aria-label", `${title} over time`);
      legend.className = "run-legend";
      one.append(head, legend, plot);
      this.place.append(one);
      one.addEventListener("toggle", () => {
        if (one.open) this.closed.delete(key);
        else this.closed.add(key);
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
      const scaled = (column, as = (value) => value) => Array.from(this.run.columns[column], (value) => known(as(value) / per));
      const data = [this.run.time], series = [{}], told = [];
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
        const names = leftOut.join(", ");
        item.textContent = `left out, as they are small: ${names}`;
        legend.append(item);
      }
      const limits = lines.flatMap((line) => ("capacity" in line ? [scaled(line.capacity)] : []));
      const range = (plotted, low, high) => this.range(low ?? 0, high ?? 0, limits);
      this.plot({ one, plot, told, lines }, data, series, { range }, { size: LEFT });
    }

    range(low, high, limits) { // limits of a scale, with 0 if the whole run is shown, and with near capacities
      if (this.run.isWhole) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
      const most = 1.25 * Math.max(Math.abs(low), Math.abs(high));
      const [from, to] = [this.run.before(this.run.low), this.run.before(this.run.high)];
      for (const values of limits) {
        for (let n = from; n <= to; n += 1) {
          if (values[n] === null || Math.abs(values[n]) > most) continue;
          [low, high] = [Math.min(low, values[n]), Math.max(high, values[n])];
        }
      }
      const room = 0.06 * (high - low) || Math.abs(high) || 1;
      return [low - room, high + room];
    }

    // rows with the states of shift elements, and with engaged gears
    rows() {
      const { elements, gears } = this.run.record;
      const moving = elements.filter((one) => one.slips?.length || one.sticks?.length);
      if (!moving.length) return;
      const { one, legend, plot } = this.figure("elements", "shift elements");
      const told = moving.map((element) => [this.legend(legend, element.name, "engaged", false), element]);
      const count = moving.length + (gears.length > 0);
      const splits = () => Array.from({ length: count }, (_, n) => count - n - 0.5);
      const names = [...(gears.length ? [this.run.record.words.gear] : []), ...moving.map(({ name }) => (name.length > 10 ? `${name.slice(0, 9)}\u2026` : name))];
      const draw = (plotted) => {
        const { ctx } = plotted, bar = ([low, high], row, colour, part) => {
          const left = plotted.valToPos(Math.max(low, this.run.low), "x", true), right = plotted.valToPos(Math.min(high, this.run.high), "x", true);
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
          const middle = (Math.max(low, this.run.low) + Math.min(high, this.run.high)) / 2;
          ctx.fillText(name, plotted.valToPos(middle, "x", true), plotted.valToPos(moving.length + 0.5, "y", true));
        }
        ctx.restore();
      };
      const axis = { size: LEFT, splits, values: () => names, grid: { show: false }, ticks: { show: false } };
      const data = [this.run.time, Array(this.run.time.length).fill(null)];
      this.plot({ one, plot, told, states: true, high: count * ROW + 40 }, data, [{}, {}], { range: () => [0, count] }, axis, draw);
    }

    plot(panel, data, series, y, axis, draw = () => {}) {
      const line = { stroke: () => css("ink"), grid: { stroke: () => css("line"), width: 1 }, ticks: { stroke: () => css("line"), width: 1 }, values: ticks, font: "12px system-ui, sans-serif" };
      const verticals = (plotted) => {
        const { ctx, bbox } = plotted;
        ctx.save();
        ctx.strokeStyle = css("soft");
        ctx.setLineDash([2, 4]);
        ctx.beginPath();
        for (const { time } of this.run.record.events) {
          if (time < this.run.low || time > this.run.high) continue;
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
        if (width > 4) this.run.zoom(plotted.posToVal(left, "x"), plotted.posToVal(left + width, "x"));
      };
      const options = {
        width: this.wide(), height: panel.high ?? HEIGHT, pxAlign: 0, series, padding: [8, 12, 0, 0], legend: { show: false },
        scales: { x: { time: false, range: () => [this.run.low, this.run.high] }, y },
        axes: [{ ...line, size: 32 }, { ...line, ...axis, grid: { ...line.grid, ...axis.grid }, ticks: { ...line.ticks, ...axis.ticks } }],
        cursor: { x: false, y: false, points: { show: false }, drag: { x: true, y: false, setScale: false }, bind: { dblclick: () => () => { this.run.whole(); } } },
        hooks: { setSelect: [selected], draw: [verticals] },
      };
      const plotted = new uPlot(options, data, panel.plot), cursor = document.createElement("div");
      cursor.className = "run-cursor";
      plotted.over.append(cursor);
      const under = (event) => plotted.posToVal(event.clientX - plotted.over.getBoundingClientRect().left, "x");
      let pressed = null;
      plotted.over.addEventListener("pointermove", (event) => {
        if (event.buttons) return;
        this.run.point(under(event));
      });
      plotted.over.addEventListener("pointerleave", () => this.run.point(null));
      plotted.over.addEventListener("pointerdown", (event) => { pressed = event.clientX; });
      plotted.over.addEventListener("pointerup", (event) => {
        if (Math.abs(event.clientX - pressed) > 4) return;
        this.run.go(under(event));
        this.run.slider.focus({ preventScroll: true });
      });
      this.plots.push({ ...panel, plotted, cursor });
    }

    wide() { return Math.max(240, this.place.clientWidth); }

    size() {
      for (const { plotted, high, one } of this.plots) if (one.open && this.wide() !== plotted.width) plotted.setSize({ width: this.wide(), height: high ?? HEIGHT });
      this.run.later();
    }

    show(time) {
      for (const { plotted, cursor, told, states } of this.plots) {
        cursor.hidden = time < this.run.low || time > this.run.high;
        cursor.style.transform = `translateX(${plotted.valToPos(time, "x")}px)`;
        for (const [element, of, per, unit, heading] of told) {
          if (states) { element.textContent = this.run.record.words[this.run.state(of, time)]; continue; }
          const value = this.run.at(of, time);
          element.textContent = `${shown(value / per)}${unit ? `\u00a0${unit}` : ""}`;
          element.dataset.heading = heading;
          element.dataset.number = known(value) ?? "";
        }
      }
    }

    zoom() {
      const { low, high } = this.run;
      for (const { plotted } of this.plots) plotted.setScale("x", { min: low, max: high });
    }

    redraw() { for (const { plotted } of this.plots) plotted.redraw(false); }

    get lines() { return this.plots.flatMap(({ one, lines }) => (one.open && lines) || []); }

    end() {
      this.observer.disconnect();
      for (const { plotted } of this.plots) plotted.destroy();
    }
  }

  globalThis.runPanels = { Panels, shown, known };
})();
