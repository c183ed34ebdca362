// Power flows follow: widths of bands, their ways, numbers. Nodes and bands stay where they are.
"use strict";
(() => {
  const { drawn } = globalThis.transmission, { number, renumber, near } = drawn;
  const CYCLE = 1e-9, NOISE = 1e-12, LEAST = 0.0005; // as in vstatics/numerics and vstatics/pictures
  const WIDEST = 30, HIGHEST = 90, THINNEST = 0.6, TURN = 6, LOSS = 8, PORT = 11; // [pt]
  const sum = (list) => list.reduce((total, one) => total + one, 0);
  const key = (...nodes) => nodes.join("\n");

  // Power that goes round, taken away cycle by cycle, the shortest first: flow/circulation.py.
  const cancel = (edges, order) => {
    const powers = new Map(edges.map(([source, target, power]) => [key(source, target), [source, target, power]])), loops = [];
    const least = CYCLE * Math.max(0, ...edges.map(([, , power]) => power));
    const nodes = [...new Set([...order, ...edges.flatMap(([source, target]) => [source, target])])];
    const isBefore = (one, other) => one.nodes.length < other.nodes.length
      || (one.nodes.length === other.nodes.length && one.power > other.power * (1 + CYCLE));
    const through = (start, following) => {
      const seen = new Set([start]);
      for (let layer = new Map([[start, { nodes: [start], power: Infinity }]]); layer.size;) {
        const ahead = new Map();
        for (const [node, way] of layer) {
          for (const [target, power] of following.get(node) ?? []) {
            if (seen.has(target) && target !== start) continue;
            const longer = { nodes: [...way.nodes, target], power: Math.min(way.power, power) };
            if (!ahead.has(target) || isBefore(longer, ahead.get(target))) ahead.set(target, longer);
          }
        }
        if (ahead.has(start)) { const { nodes: [, ...rest], power } = ahead.get(start); return { nodes: [start, ...rest.slice(0, -1)], power }; }
        for (const one of ahead.keys()) seen.add(one);
        layer = ahead;
      }
      return null;
    };
    const first = () => {
      const following = new Map();
      for (const [source, target, power] of powers.values()) following.set(source, [...(following.get(source) ?? []), [target, power]]);
      let best = null;
      for (const node of nodes) {
        const found = following.has(node) ? through(node, following) : null;
        if (found && (!best || isBefore(found, best))) best = found;
      }
      return best;
    };
    for (let loop = first(); loop; loop = first()) {
      loop.nodes.forEach((node, n) => {
        const pair = key(node, loop.nodes[(n + 1) % loop.nodes.length]), [source, target, power] = powers.get(pair);
        if (power - loop.power <= least) powers.delete(pair);
        else powers.set(pair, [source, target, power - loop.power]);
      });
      if (loop.power > least) loops.push(loop);
    }
    return { edges: [...powers.values()], loops };
  };

  // What is transmitted, what goes round, what is lost: flow/power.py, pictures/flow/graph.py.
  const flowOf = (c, told, pieces) => {
    const nodes = new Set(c.names.map((name) => `link ${name}`)), between = new Map();
    for (const { node, link, power } of told.exchanged) {
      const pair = key(node, link), before = between.get(pair)?.[2] ?? 0;
      nodes.add(node);
      between.set(pair, [node, `link ${c.names[link - 1]}`, before + power]);
    }
    const edges = [...between.values()].filter(([, , power]) => Math.abs(power) > 0)
      .map(([node, link, power]) => (power > 0 ? [link, node, power] : [node, link, -power]));
    const isWithin = ([source, target]) => pieces[source] !== undefined && pieces[source] === pieces[target];
    const order = [...nodes], isKnown = [...between.values()].every(([, , power]) => !Number.isNaN(power));
    const rest = cancel(edges.filter(isWithin), order);
    const found = cancel([...edges.filter((one) => !isWithin(one)), ...rest.edges], order), losses = new Map();
    const least = NOISE * Math.max(0, ...edges.map(([, , power]) => power));
    for (const [node, loss] of Object.entries(told.power_loss)) if (loss > least && !node.startsWith("drag")) losses.set(node, loss);
    const forward = new Map();
    for (const [source, target, power] of found.edges) {
      if (target.startsWith("drag")) losses.set(source, (losses.get(source) ?? 0) + power);
      else forward.set(key(source, target), power);
    }
    const ports = told.exchanged.filter(({ node }) => node.startsWith("port")).map(({ power }) => power);
    const entering = -sum(ports.filter((power) => power < 0)) + 0, leaving = sum(ports.filter((power) => power > 0)) + 0;
    return { forward, loops: found.loops, locked: rest.loops, losses, isKnown, ports: [entering, leaving, sum(Object.values(told.power_loss))] };
  };

  const turned = (nodes) => { // a loop from its first node in the order of letters
    const start = nodes.indexOf([...nodes].sort()[0]);
    return key(...nodes.slice(start), ...nodes.slice(0, start));
  };

  const curves = (points) => points.map(([x, y], n) => {
    if (n === 0) return `M${x} ${y}`;
    const [left, start] = points[n - 1], middle = (left + x) / 2;
    return start === y ? `L${x} ${y}` : `C${middle} ${start} ${middle} ${y} ${x} ${y}`;
  }).join("");

  const rounded = (points, wide) => {
    const far = ([a, b], [x, y]) => Math.hypot(x - a, y - b), end = points.length - 1;
    const room = points.slice(1).map((one, n) => far(points[n], one) / (n === 0 || n === end - 1 ? 1 : 2));
    const towards = ([x, y], other, way) => { const part = way / (far([x, y], other) || 1); return `${x + (other[0] - x) * part} ${y + (other[1] - y) * part}`; };
    const turns = points.slice(1, -1).map((corner, n) => {
      const size = Math.min(wide / 2 + TURN, room[n], room[n + 1]);
      return `L${towards(corner, points[n], size)}Q${corner.join(" ")} ${towards(corner, points[n + 2], size)}`;
    });
    return `M${points[0].join(" ")}${turns.join("")}L${points[end].join(" ")}`;
  };

  const shape = (...places) => `M${places.map((one) => one.join(" ")).join("L")}z`;

  drawn.kinds.flow = (svg, c, base) => {
    const root = JSON.parse(svg.dataset.flow), gear = c.gears.findIndex(({ name }) => name === root.gear), own = drawn.changes();
    const parts = [...svg.querySelectorAll("[data-follows]")].map((element) => ({ element, ...JSON.parse(element.dataset.follows) }));
    const bands = parts.filter(({ of }) => of === "band"), ports = parts.filter(({ of }) => of === "port"), nodes = parts.filter(({ of }) => of === "node");
    const runs = new Map(); // by their first node
    for (const one of nodes) {
      const [top, bottom] = one.thick, run = runs.get(one.run) ?? { nodes: [], middle: (top + bottom) / 2, thick: bottom - top };
      run.nodes.push(one.node);
      runs.set(one.run, run);
    }
    const runOf = Object.fromEntries(nodes.map(({ node, run }) => [node, run]));
    const biggest = Math.max(1e-9, ...nodes.map(({ powers }) => powers[0])), widest = nodes.find(({ powers }) => powers[0] === biggest);
    const scale = widest ? (widest.thick[1] - widest.thick[0]) / biggest : WIDEST;

    const powerOf = ({ nodes: way, loop, port, link, enters }, flow) => { // below 0 where it goes the other way
      const through = (source, target) => (flow.forward.get(key(source, target)) ?? 0) - (flow.forward.get(key(target, source)) ?? 0);
      if (port) return enters ? through(port, link) : through(link, port);
      if (!loop) return through(way[0], way[1]);
      const found = (list) => flow.loops.find((one) => turned(one.nodes) === turned(list))?.power ?? 0;
      return found(loop) - found([...loop].reverse());
    };

    const reason = (flow) => { // why the picture has no place for all power
      if (!flow.isKnown) return "Some power is not determined: run the program.";
      const known = new Set([...bands, ...ports].flatMap(({ nodes: way, loop, port, link }) => (
        port ? [key(port, link), key(link, port)] : loop ? [] : [key(...way), key(way[1], way[0])])));
      const loops = new Set(bands.flatMap(({ loop }) => (loop ? [turned(loop), turned([...loop].reverse())] : [])));
      const isNew = [...flow.forward].some(([pair, power]) => power > CYCLE && !known.has(pair)) || flow.loops.some((one) => !loops.has(turned(one.nodes)));
      if ([...flow.losses].some(([node, loss]) => loss > CYCLE && !nodes.some((one) => one.node === node && one.powers[1] > 0))) {
        return "Power is lost where this picture has no loss: run the program.";
      }
      return isNew ? "Power takes ways that this picture does not have: run the program." : "";
    };

    // Power of bands and ports, thickness of runs, and where bands and ports end at them.
    const values = (told) => {
      const flow = flowOf(c, told[gear], root.pieces), power = new Map([...bands, ...ports].map((one) => [one, powerOf(one, flow)]));
      const through = Object.fromEntries(nodes.map(({ node }) => {
        let entering = 0, leaving = flow.losses.get(node) ?? 0, passing = 0;
        for (const one of bands) {
          const p = power.get(one), source = one.nodes[0], target = one.nodes[one.nodes.length - 1];
          if (node === (p < 0 ? source : target)) entering += Math.abs(p);
          if (node === (p < 0 ? target : source)) leaving += Math.abs(p);
          if (one.nodes.slice(1, -1).includes(node)) passing += Math.abs(p);
        }
        for (const one of ports) {
          if (one.link !== node) continue;
          if (one.enters === (power.get(one) >= 0)) entering += Math.abs(power.get(one));
          else leaving += Math.abs(power.get(one));
        }
        return [node, passing + Math.max(entering, leaving)];
      }));
      const now = Math.min(scale, HIGHEST / Math.max(1e-9, ...Object.values(through)));
      return { flow, power, through, scale: now };
    };

    const stacked = ({ power, through, scale: now }) => { // depths of ends, by part
      const thick = (run) => now * Math.max(...runs.get(run).nodes.map((node) => through[node])), stacks = new Map();
      const put = (name, run, y, part, end) => {
        if (!stacks.has(name)) stacks.set(name, { run, ends: [] });
        stacks.get(name).ends.push({ y, part, end });
      };
      for (const one of bands) {
        const [source, target] = [one.nodes[0], one.nodes[one.nodes.length - 1]], { points } = one, last = points.length - 1;
        if (!one.back && runOf[source] === runOf[target]) put(`in ${key(source, target)}`, runOf[source], points[0][1], one, 2);
        else {
          put(`right ${runOf[source]}`, runOf[source], points[0][1], one, 0);
          put(`left ${runOf[target]}`, runOf[target], points[last][1], one, 1);
        }
      }
      for (const one of ports) put(`${one.enters ? "left" : "right"} ${runOf[one.link]}`, runOf[one.link], one.place[1], one, 2);
      const depths = new Map([...bands, ...ports].map((one) => [one, [0, 0]]));
      for (const { run, ends } of stacks.values()) {
        let top = runs.get(run).middle - thick(run) / 2;
        for (const { part, end } of ends.sort((a, b) => a.y - b.y)) {
          const wide = now * Math.abs(power.get(part));
          for (const side of end === 2 ? [0, 1] : [end]) depths.get(part)[side] = top + wide / 2;
          top += wide;
        }
      }
      return { thick, depths };
    };

    const kilowatts = (power) => {
      const value = power * root.kilowatts;
      return value >= 100 ? value.toFixed(0) : value.toPrecision(3);
    };
    const shown = (power) => { // one line or two
      const text = power >= LEAST ? number(power) : "<0.001";
      return root.kilowatts === null ? [text] : [text, `${kilowatts(power)} ${root.unit}`];
    };
    const changed = (before, after) => { const to = shown(Math.abs(after)); return shown(Math.abs(before)).map((one, n) => [one, to[n]]); };

    const check = (told) => {
      const { flow, power, through } = values(told);
      return !reason(flow) && [...power].every(([part, own]) => near(own, part.power)) && root.ports.every((one, n) => near(one, flow.ports[n]))
        && nodes.every(({ node, powers }) => near(through[node], powers[0]) && near(flow.losses.get(node) ?? 0, powers[1]));
    };

    const turning = (node, before, after, told) => { // torque and speed of a link
      const speed = (each) => each[gear].speeds[c.names.indexOf(node.slice(5))];
      return [[number(before / Math.abs(speed(base))), number(after / Math.abs(speed(told)))], [number(speed(base)), number(speed(told))]];
    };

    const place = (one, now, [start, end], wide) => { // a band
      const { element, points, back, hatched } = one, [path, ...ways] = element.querySelectorAll("path"), last = points.length - 1;
      const isLevel = points.every(([, y]) => y === points[0][1]);
      const moved = points.map(([x, y], n) => {
        if (isLevel) return [x, n <= last / 2 ? start : end];
        if (points.slice(0, n + 1).every(([, other]) => other === points[0][1])) return [x, start];
        return [x, points.slice(n).every(([, other]) => other === points[last][1]) ? end : y];
      });
      own.set(path, "d", back ? rounded(moved, wide) : curves(moved));
      if (hatched) {
        one.pattern ??= getComputedStyle(path).fill; // once: it takes long
        own.set(path, "style", `fill:none;stroke:${one.pattern};stroke-width:${wide}`);
      } else own.set(path, "style", `stroke-width:${wide}`);
      const sides = back ? [[moved[1], moved[2]], [moved[3], moved[4]]] : [];
      ways.filter((way) => !way.matches(".way")).forEach((way, n) => {
        const [[x, from], [, to]] = sides[n], y = (from + to) / 2, size = Math.min(Math.max(wide / 4, 2), 5);
        const tip = Math.sign((to - from) * now || 1) * size;
        own.set(way, "d", shape([x - size, y - tip], [x + size, y - tip], [x, y + tip]));
      });
      element.querySelector(".way")?.remove();
      if (now < 0 && !back) { // it goes from right to left now
        const middle = path.getPointAtLength(path.getTotalLength() / 2), size = Math.min(Math.max(wide / 3, 3), 6), way = document.createElementNS(svg.namespaceURI, "path");
        way.setAttribute("class", "way");
        way.setAttribute("d", shape([middle.x + size, middle.y - size], [middle.x + size, middle.y + size], [middle.x - size, middle.y]));
        element.append(way);
      }
    };

    const port = (one, now, y, wide) => { // the tail of an arrow before its link, or the head of one behind it
      const [x] = one.place, half = wide / 2, notch = Math.min(half, PORT - 4), side = one.enters ? -1 : 1, far = x + side * PORT;
      const isHead = one.enters === now < 0, corner = isHead ? far - side * notch : far, middle = isHead ? far : far - side * notch;
      return shape([x, y - half], [corner, y - half], [middle, y], [corner, y + half], [x, y + half]);
    };

    const runLines = (one, power, values) => { // below the names of a run
      const others = one.ports.filter(({ port: name }) => name).map((each) => [each, values(each)]).filter(([, own]) => !near(own, power));
      return [...shown(power), ...others.flatMap(([{ enters }, own]) => shown(Math.abs(own)).map((text, n) => (n ? text : `${root.ways[enters === own >= 0 ? 0 : 1]} ${text}`)))];
    };

    const back = () => {
      own.back();
      for (const one of svg.querySelectorAll(".way")) one.remove();
    };

    const move = (told) => {
      const all = values(told), { flow, power, through, scale: now } = all, why = reason(flow);
      if (why) { back(); return why; }
      const { thick, depths } = stacked(all), first = (of) => parts.find((one) => one.of === "port" && one.port === of.port && one.link === of.link);
      const titled = (element, pairs) => { for (const one of element.querySelectorAll("title")) own.text(one, renumber(own.first(one).split("\n")[0], pairs)); };
      const written = (element, pairs) => { for (const one of element.querySelectorAll("text")) own.text(one, renumber(own.first(one), pairs)); };
      for (const one of parts) {
        const { element, of, run } = one, middle = runs.get(run)?.middle, half = run && thick(run) / 2, paths = element.querySelectorAll("path");
        if (of === "head") {
          const pairs = root.ports.map((before, n) => [number(before), number(flow.ports[n])]);
          const [line, ...rest] = [...element.querySelectorAll("text")].reverse(), lines = [line, ...rest].filter(Boolean);
          for (const text of lines) own.text(text, renumber(own.first(text), own.first(text).includes(" \u00b7 ") ? pairs : inner(flow)));
        } else if (of === "band" || of === "port") {
          const p = power.get(one), wide = Math.max(THINNEST, now * Math.abs(p)), link = one.nodes?.find((node) => node.startsWith("link")) ?? one.link;
          if (of === "band") place(one, p, depths.get(one), wide);
          else own.set(paths[0], "d", port(one, p, depths.get(one)[0], wide));
          const hasSpeed = (one.nodes?.length ?? 2) === 2;
          titled(element, [...changed(one.power, p), ...(hasSpeed ? turning(link, one.power, Math.abs(p), told) : [])]);
        } else if (of === "node" || of === "side") {
          const [left, right] = one.sides;
          own.set(paths[0], "d", shape([left, middle + half], [left, middle - half], [right, middle - half], [right, middle + half]));
          if (of === "node") {
            const lost = flow.losses.get(one.node) ?? 0, isLink = one.node.startsWith("link");
            titled(element, [...changed(one.powers[0], through[one.node]), ...(isLink ? turning(one.node, one.powers[0], through[one.node], told) : []), ...changed(one.powers[1], lost)]);
          }
        } else if (of === "loss" || of === "lost") {
          const lost = Math.max(flow.losses.get(run) ?? 0, 0), low = middle + half, wide = Math.max(THINNEST, lost * now) / 2, tip = low + LOSS + (lost * now) / 2, neck = tip - wide - 2.5;
          if (of === "loss") {
            const side = [[one.middle + wide, low], [one.middle + wide, neck], [one.middle + wide + 2.5, neck]], x = one.middle;
            own.set(paths[0], "d", shape(...side, [x, tip], ...side.reverse().map(([a, y]) => [2 * x - a, y])));
          } else {
            const before = runs.get(run).thick / 2 + (one.power * scale) / 2;
            own.set(element, "transform", `translate(0 ${half + (lost * now) / 2 - before})`);
            written(element, changed(one.power, lost));
          }
        } else if (of === "note") {
          const p = power.get(bands.find((band) => (one.loop ? band.loop && turned(band.loop) === turned(one.loop) : !band.loop && key(...band.nodes) === key(...one.nodes))));
          const share = (each, entering) => `${((100 * each) / entering).toFixed(1)}%`;
          const pairs = one.loop ? [[number(one.power), number(Math.abs(p))], ...changed(one.power, p).slice(1), [share(one.power, root.ports[0]), share(Math.abs(p), flow.ports[0])]] : changed(one.power, p);
          written(element, pairs);
        } else if (of === "run") {
          const texts = [...element.querySelectorAll("text")], biggest = Math.max(...one.nodes.map((node) => through[node]));
          const before = runLines(one, Math.max(...nodes.filter(({ node }) => one.nodes.includes(node)).map(({ powers }) => powers[0])), (each) => each.power);
          const lines = runLines(one, biggest, (each) => power.get(first(each)) ?? each.power), names = texts.length - before.length;
          own.set(element, "transform", `translate(0 ${runs.get(run).thick / 2 - half})`);
          texts.slice(names).forEach((text, n) => own.text(text, n === before.length - 1 ? lines.slice(n).join(" \u00b7 ") : lines[n] ?? ""));
        }
      }
      return "";
    };

    const inner = (flow) => { // all power that circulates, where there are several loops, and that within one piece
      const locked = root.locked.map(({ nodes: way, power }) => [number(power), number(flow.locked.find((one) => turned(one.nodes) === turned(way))?.power ?? 0)]);
      const now = sum(flow.loops.map(({ power }) => power)), share = (each, entering) => `${((100 * each) / entering).toFixed(1)}%`;
      return [...changed(root.circulating ?? NaN, now), [share(root.circulating, root.ports[0]), share(now, flow.ports[0])], ...locked];
    };

    return { check, move, back };
  };
})();
