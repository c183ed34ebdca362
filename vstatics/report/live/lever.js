// Lever diagrams follow: points at their distances, speeds, torques. Rows, names and signs stay where they are.
"use strict";
(() => {
  const { drawn } = globalThis.transmission, { number, renumber, near } = drawn;
  const NO_TORQUE = 1e-12, BESIDE = 6, HEAD = 5; // as in vstatics/pictures/lever

  // Where the links of a lever are: the third link at 0, the second at 1; by the ratios of its mechanisms.
  const positions = (lever, c, ratios) => {
    const nodes = Object.values(lever.nodes), known = new Map();
    const third = nodes.find(({ position }) => position === 0)?.link;
    const own = lever.devices.flatMap((device) => c.devices[device].mechanisms).filter((n) => c.mechanisms[n].links[2] === third);
    const isByRatio = (link) => own.some((n) => c.mechanisms[n].links[0] === link && nodes.some((one) => one.link === c.mechanisms[n].links[1] && one.position === 1));
    for (const { link, position } of nodes) if (position === 0 || (position === 1 && !isByRatio(link))) known.set(link, position);
    for (let round = 0; round < own.length; round += 1) {
      for (const n of own) {
        const [one, other] = c.mechanisms[n].links;
        if (known.has(other) && !known.has(one)) known.set(one, ratios[n] * known.get(other));
        else if (known.has(one) && !known.has(other)) known.set(other, known.get(one) / ratios[n]);
      }
    }
    return nodes.map(({ link }) => known.get(link) ?? NaN);
  };

  const isVaried = ({ devices }, c) => devices.some((device) => c.devices[device].mechanisms.some((n) => c.mechanisms[n].kind));

  const heights = (lever, now) => { // of the points, between the ends that the lever has
    const nodes = Object.values(lever.nodes), first = nodes.map(({ position }) => position);
    if (lever.is_pair || nodes.length < 2) return nodes.map(({ at }) => at);
    const end = (of, list) => nodes[list.indexOf(of(...list))].at, low = end(Math.min, first), high = end(Math.max, first);
    const least = Math.min(...now), most = Math.max(...now);
    return now.map((one) => low + ((one - least) / (most - least || 1)) * (high - low));
  };

  const unit = (scale) => { // a round torque whose arrow is 10 to 25 pt long
    const power = 10 ** Math.floor(Math.log10(10 / scale)), torque = [1, 2, 5, 10].map((step) => step * power).find((one) => one * scale >= 10 - 1e-9);
    return [torque * scale, number(torque).replace(/0+$/, "").replace(/\.$/, "")];
  };

  const arrow = (x, y, length) => { // the line and the head of a torque
    const size = Math.abs(length), head = Math.min(HEAD, Math.max(size, 3)), way = Math.sign(length) || 1;
    const [start, end] = length > 0 ? [x - size, x] : [x, x - size], neck = end - way * head;
    return [`M${start} ${y}L${neck} ${y}`, `M${end} ${y}L${neck} ${y - 3}L${neck} ${y + 3}z`];
  };

  drawn.kinds.lever = (svg, c, base) => {
    const root = JSON.parse(svg.dataset.lever), gear = c.gears.findIndex(({ name }) => name === root.gear);
    const parts = [...svg.querySelectorAll("[data-follows]")].map((element) => ({ element, ...JSON.parse(element.dataset.follows) }));
    const own = drawn.changes(), member = {}; // index of a member among all, by device and name
    c.devices.flatMap(({ members }, device) => members.map(([name]) => `${device} ${name}`)).forEach((key, n) => { member[key] = n; });

    const values = (told) => { // what the picture shows
      const { speeds, members, mechanism_ratios: ratios } = told[gear], speed = (link) => (link ? speeds[link - 1] : 0);
      const levers = root.levers.map((lever) => {
        const now = lever.devices.length && !isVaried(lever, c) ? positions(lever, c, ratios) : Object.values(lever.nodes).map(({ position }) => position);
        const at = heights(lever, now), torques = {}, places = {}, own = {};
        Object.entries(lever.nodes).forEach(([n, { link, sources }], place) => {
          const torque = sources.reduce((total, [device, name, factor]) => total + factor * members[member[`${device} ${name}`]], 0);
          torques[n] = Math.abs(torque) < NO_TORQUE ? 0 : torque;
          places[n] = at[place];
          own[n] = { position: now[place], speed: speed(link) };
        });
        return { torques, places, own };
      });
      const reached = [...root.links.map(speed).filter(Number.isFinite), 0, 1];
      const largest = Math.max(0.1, ...levers.flatMap(({ torques }) => Object.values(torques)).map(Math.abs).filter(Number.isFinite));
      return { levers, span: [Math.min(...reached), Math.max(...reached)], scale: root.longest / largest };
    };

    const check = (told) => {
      const { levers, span, scale } = values(told);
      return near(span[0], root.speeds[0]) && near(span[1], root.speeds[1]) && near(scale, root.torque) && levers.every(({ torques, own }, n) => (
        Object.entries(root.levers[n].nodes).every(([key, node]) => near(own[key].speed, node.speed) && near(torques[key], node.torque)
          && (node.position === null || near(own[key].position, node.position)))));
    };

    const pairRatio = (lever, told) => {
      const links = Object.values(lever.nodes).map(({ link }) => link);
      const n = c.devices[lever.devices[0]].mechanisms.find((one) => c.mechanisms[one].links.every((link) => links.includes(link)));
      return told[gear].mechanism_ratios[n];
    };

    const move = (told) => {
      const { levers, span, scale } = values(told);
      const text = (element, now) => { for (const one of element.querySelectorAll("text")) own.text(one, now); };
      const titled = (element, pairs) => { for (const one of element.querySelectorAll("title")) own.text(one, renumber(own.first(one), pairs)); };
      for (const { element, of, lever, node, speed, names, unit: length } of parts) {
        const one = root.levers[lever], now = levers[lever], given = one?.nodes[node], paths = element.querySelectorAll("path");
        const across = (value) => one.speeds[0] + ((value - span[0]) / (span[1] - span[0])) * (one.speeds[1] - one.speeds[0]);
        const at = now?.places[node], value = now?.own[node], torque = now?.torques[node];
        if (of === "ratio") text(element, renumber(own.first(element.querySelector("text")), [[number(root.ratio), number(told[gear].ratio[0])]]));
        else if (of === "scale") own.set(paths[0], "d", paths[0].getAttribute("d").replace(/([ML])-?[\d.]+/g, `$1${across(speed)}`));
        else if (of === "line") {
          const points = Object.keys(one.nodes).filter((n) => one.nodes[n].at !== null).map((n) => [across(now.own[n].speed), now.places[n]]);
          own.set(paths[0], "d", `M${points.sort((a, b) => b[1] - a[1]).map((place) => place.join(" ")).join("L")}`);
        } else if (of === "link") {
          const end = one.speeds[1], { y } = given;
          const places = [[one.left, y], [one.at - BESIDE, y], [one.at, at], [end, at], [end + BESIDE, y], [one.right, y]];
          own.set(paths[0], "d", `M${places.map((place) => place.join(" ")).join("L")}`);
        } else if (of === "point" || of === "ground") own.set(element, "transform", `translate(0 ${at - given.at})`);
        else if (of === "speed") own.set(paths[0], "d", `M${across(0)} ${at}L${across(value.speed)} ${at}`);
        else if (of === "torque") arrow(one.at - BESIDE, given.y, torque * scale).forEach((d, n) => own.set(paths[n], "d", d));
        else if (of === "torque number") text(element, number(torque));
        else if (of === "speed number") text(element, Math.abs(value.speed) === 0 ? "0" : number(value.speed));
        else if (of === "said") titled(element, [[number(given.speed), number(value.speed)], [number(given.torque), number(torque)]]);
        else if (of === "name") {
          // each between a blank and a comma: two points of one place may part, names may have digits
          const places = Object.keys(one.nodes).map((n) => [one.nodes[n], now.own[n]].map(({ position }) => ` ${number(position)},`));
          for (const title of element.querySelectorAll("title")) own.text(title, renumber(`${own.first(title)},`, places).slice(0, -1));
        }
        else if (of === "pair") {
          const ratio = (of) => { const some = Object.values(of); return some.at(-1).speed / some[0].speed; };
          const change = isVaried(one, c) ? [ratio(one.nodes), ratio(now.own)] : [pairRatio(one, base), pairRatio(one, told)];
          text(element, renumber(own.first(element.querySelector("text")), [change.map(number)]));
        }
        else if (of === "carried") {
          const torques = names.map((name) => [base, told].map((each) => number(each[gear].first_torques[c.results.WFRI.rows.indexOf(name)])));
          titled(element, torques);
        } else if (of === "unit") {
          const [long, said] = unit(scale), head = paths[1].getAttribute("d").match(/-?[\d.]+/g).map(Number), first = root.torque * Number(length);
          const start = (own.start ??= head[0] - first); // where the sample begins
          arrow(start + long, head[1], long).forEach((d, n) => own.set(paths[n], "d", d));
          text(element, renumber(own.first(element.querySelector("text")), [[length, said]]));
        }
      }
    };

    return { check, move, back: own.back };
  };
})();
