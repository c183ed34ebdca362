// The results of each gear at some numbers of a case: formulas -> `core` -> rows of tables.
"use strict";
(() => {
  const { core, torqueColumn, value, Outside } = globalThis.transmission;
  const sum = (terms) => terms.reduce((total, one) => total + one, 0);
  const times = (torque, speed) => (torque === 0 || speed === 0 ? 0 : torque * speed); // also where the other is NaN

  // Formulas, as vstatics/elements/quotients.py has them.

  const tipContact = (teeth, way) => { // the part of the contact ratio at a tip; way -1 of a ring
    const angle = (20 * Math.PI) / 180, pitch = teeth / 2, base = pitch * Math.cos(angle);
    const length = way * (Math.sqrt((pitch + way) ** 2 - base ** 2) - pitch * Math.sin(angle));
    return length / (Math.PI * Math.cos(angle));
  };

  const operations = {
    "*": (...factors) => factors.reduce((total, one) => total * one, 1),
    "/": (a, b) => a / b,
    "-": (a, b) => a - b,
    mesh: (friction, teeth, others, internal) => { // its efficiency by friction
      const way = internal ? -1 : 1, a = tipContact(teeth, 1), b = tipContact(others, way);
      return 1 - Math.PI * friction * (1 / teeth + way / others) * (1 - a - b + a ** 2 + b ** 2);
    },
  };

  const evaluate = (formula, numbers) => {
    if (typeof formula === "string") return numbers[formula];
    if (!Array.isArray(formula)) return formula ?? NaN;
    const [operation, ...parts] = formula;
    return operations[operation](...parts.map((one) => evaluate(one, numbers)));
  };

  // What results have of the state of a gear, by the names of their arrays: statics/state.py.

  // The torques on the members of each device: sums, which may be known where their parts are not.
  const memberTorques = (c, state, lossy) => {
    const { factors, consistent } = lossy ? state.lossy.solved : state.ideal, first = c.elements.length;
    const ratios = lossy ? state.lossyRatios : state.ratios;
    const parts = c.mechanisms.map((one, n) => torqueColumn(one, ratios[n]).map(value));
    const members = c.devices.flatMap((device) => device.members.map(([, , places]) => (
      places.map(([mechanism, part]) => [first + mechanism, parts[mechanism][part]]))));
    const found = members.map((terms) => sum(terms.map(([device, share]) => share * factors[device])));
    const unknown = [...found.keys()].filter((n) => Number.isNaN(found[n]));
    if (unknown.length && (lossy ? state.lossy.admissible : consistent) && !ratios.some(Number.isNaN)) {
      state.sums(lossy, unknown.map((n) => members[n])).forEach((torque, n) => { found[unknown[n]] = torque; });
    }
    return found;
  };

  const torques = (c, state, lossy) => { // of shift elements, members or mechanisms, springs, the output
    const own = lossy ? state.lossy.solved.torques : state.ideal.torques, count = c.elements.length;
    if (!c.drawn) return own;
    return [...own.slice(0, count), ...memberTorques(c, state, lossy), ...own.slice(count + c.mechanisms.length)];
  };

  // What links give to members of devices, springs, drag, ports; below 0 what they take: statics/state.py.
  const exchanges = (c, gear, state, lossy) => {
    const solved = lossy ? state.lossy.solved : state.ideal, { links } = state.speeds, found = [];
    const own = solved.torques, first = c.elements.length, { elements: dragging, links: dragged } = state.drag;
    const give = (node, member, link, torque) => {
      if (link) found.push({ node, member, link, power: times(torque, links[link]) * gear.direction });
    };
    c.elements.forEach(([one, other], n) => {
      const drags = lossy && dragging.has(n), torque = drags ? dragging.get(n) : own[n];
      if (!state.engaged.includes(n) && !drags) return;
      const name = `element ${c.results.WFRI.rows[n]}`;
      give(name, "", one, torque);
      give(name, "", other, -torque);
    });
    const torques = memberTorques(c, state, lossy);
    let place = 0;
    c.devices.forEach(({ members }, n) => {
      for (const [member, link] of members) give(`mechanism ${c.results.losses.rows[n]}`, member, link, torques[place++]);
    });
    c.springs.forEach((spring, n) => {
      for (const [link, part] of spring) give(`spring ${n}`, "", link, part * own[first + c.mechanisms.length + n]);
    });
    const acting = [[gear.input, gear.torque], ...gear.torques, ...solved.holding];
    for (const [link, torque] of acting) give(`port ${link}`, "", link, -torque);
    give("port output", "", gear.output, own[own.length - 1]);
    if (lossy) for (const [link, torque] of dragged) give(`drag ${c.names[link - 1]}`, "", link, -torque);
    return found;
  };

  const withoutNoise = (found) => { // powers that are nothing but rounding are 0
    const noise = 1e-12 * Math.max(0, ...found.map(({ power }) => Math.abs(power)).filter((power) => power >= 0));
    return found.map((one) => (Math.abs(one.power) <= noise ? { ...one, power: 0 } : one));
  };

  // Power through links, mechanisms, shift elements and drag, and that of members: flow/power.py.
  const powers = (c, found) => {
    const through = {}, between = new Map();
    for (const { node, member, link, power } of found) {
      if (member) through[`${node}.${member}`] = power;
      if (!between.has(node)) between.set(node, new Map());
      between.get(node).set(link, (between.get(node).get(link) ?? 0) + power);
    }
    const enter = (node, power) => { through[node] = (through[node] ?? 0) + power; };
    for (const [node, byLink] of between) {
      for (const [link, power] of byLink) {
        if (!(power < 0)) enter(node, Math.abs(power));
        if (!(power > 0)) enter(`link ${c.names[link - 1]}`, -power);
      }
    }
    return through;
  };

  const powerLosses = (c, gear, state, exchanged) => { // of mechanisms, of open shift elements, of links
    const losses = Object.fromEntries(c.devices.map(({ mechanisms }, n) => (
      [`mechanism ${c.results.losses.rows[n]}`, sum(mechanisms.map((one) => state.lossy.losses[one])) * gear.direction])));
    const dragging = [...state.drag.elements.keys()].map((n) => `element ${c.results.WFRI.rows[n]}`);
    for (const { node, power } of exchanged) {
      if (dragging.includes(node) || node.startsWith("drag ")) losses[node] = (losses[node] ?? 0) + power;
    }
    return losses;
  };

  const portPowers = (gear, { lossy, speeds }) => { // what enters by each link with losses, in kW
    const acting = new Map(), { torques, holding } = lossy.solved;
    const every = [[gear.input, gear.torque], ...gear.torques, ...holding, [gear.output, -torques[torques.length - 1]]];
    for (const [link, torque] of every) acting.set(link, (acting.get(link) ?? 0) + torque);
    return [...acting].map(([link, torque]) => times(torque, speeds.links[link]) * (gear.scales.kW ?? NaN));
  };

  const planetSpeed = (c, state, planet, number) => { // against the carrier
    const { links, relative } = state.speeds;
    if (planet.wheels) { // from the first wheel of its train that has a speed
      const speed = number(planet.speed), carrier = links[planet.carrier];
      for (const [link, mechanism, ratio] of planet.wheels) {
        if (Number.isNaN(speed + links[link] + carrier)) continue;
        return relative[mechanism] === 0 ? 0 : ((links[link] - carrier) / number(ratio)) * speed;
      }
      return NaN;
    }
    const one = c.mechanisms[planet.mechanism], motion = relative[planet.mechanism];
    if (one.planet !== undefined) return motion / number(one.planet);
    return one.links[2] && one.ratio < 0 && one.ratio !== -1 ? motion / ((one.ratio + 1) / 2) : NaN;
  };

  const told = (c, gear, state, number) => {
    const { lossy, ideal, speeds } = state, first = c.elements.length, output = speeds.links[gear.output];
    const exists = (mark) => (ideal.consistent ? +mark : NaN); // a question only where torques balance
    const byLink = (holding) => c.results.W.rows.map((_, n) => holding.get(n + 1) ?? NaN);
    const ports = portPowers(gear, state);
    const exchanged = withoutNoise(exchanges(c, gear, state, true)), lossyPower = powers(c, exchanged);
    const losses = powerLosses(c, gear, state, exchanged);
    const lost = sum(Object.values(losses)), share = ([node, loss]) => [node, (100 * loss) / (lost || NaN)];
    const ofMeshes = (own) => c.devices.flatMap(({ meshes }) => meshes.map(([n, known]) => (known ? own[first + n] : NaN)));
    return {
      speeds: speeds.links.slice(1, c.results.W.rows.length + 1),
      slip_speeds: speeds.slips,
      planet_speeds: c.devices.flatMap(({ planets }) => planets.map((one) => planetSpeed(c, state, one, number))),
      ratio: [output === 0 ? NaN : 1 / output],
      torques: torques(c, state, false),
      lossy_torques: torques(c, state, true),
      holding_torques: byLink(ideal.holding),
      lossy_holding_torques: byLink(lossy.solved.holding),
      mesh_torques: ofMeshes(ideal.torques),
      lossy_mesh_torques: ofMeshes(lossy.solved.torques),
      efficiency: [lossy.efficiency],
      power_sign: lossy.signs,
      losses: c.devices.map(({ mechanisms }) => sum(mechanisms.map((n) => lossy.losses[n]))),
      power_balance: [lossy.balance],
      drag_losses: [lossy.dragLosses],
      idle: c.devices.map(({ mechanisms }) => exists(mechanisms.every((n) => state.idle[n]))),
      holds: c.elements.map((_, n) => +state.engaged.includes(n)),
      consistent: [exists(lossy.admissible)],
      locked: [exists(false)],
      dragged: [exists(state.dragged)],
      input_power_kW: [sum(ports.map((one) => Math.max(one, 0)))],
      output_power_kW: [sum(ports.map((one) => Math.max(-one, 0)))],
      power: powers(c, withoutNoise(exchanges(c, gear, state, false))),
      lossy_power: lossyPower,
      power_loss: losses,
      loss_share: Object.fromEntries(Object.entries(losses).map(share)),
      exchanged, // what pictures show besides
      members: memberTorques(c, state, false),
      first_torques: ideal.torques,
      mechanism_ratios: state.ratios,
    };
  };

  // The results of each gear at some numbers, or `outside`: why the program is to be asked.

  const holds = { above: (x) => x > 0, not: (x) => x !== 0, is: (x) => Math.abs(x) < 1e-12 };
  const expected = (c, path, value) => { // what a number of teeth, an efficiency, another one is not
    if (c.counts.includes(path)) return Number.isInteger(value) && value > 0 ? "" : "a whole number above 0";
    if (/\.diameters\./.test(path)) return value > 0 ? "" : "a number above 0";
    if (/back_efficiency$/.test(path)) return value >= 0 && value <= 1 ? "" : "a number from 0 to 1";
    if (/efficiency$|mesh_efficiency\.\w+$/.test(path)) return value > 0 && value <= 1 ? "" : "a number above 0, up to 1";
    const isRatio = c.mechanisms.some(({ ratio, kind }) => ratio === path && !kind);
    if (isRatio && value === 0) return "a number other than 0";
    return Number.isFinite(value) ? "" : "a number";
  };
  const refused = (c, number) => { // why no case has these numbers, if none has
    for (const path of Object.keys(c.numbers)) {
      const given = number(path), wanted = expected(c, path, given), name = c.called?.[path] ?? path;
      if (wanted) return `${name} = ${given}: expected ${wanted}`;
    }
    return c.conditions.every(([kind, formula]) => holds[kind](number(formula))) ? "" : "no such teeth";
  };

  // Mechanisms and springs, by their indices among the devices, without bypassed converters and dampers
  // alone: model/fields.py
  const alwaysLoaded = ({ links, elements, mechanisms, springs, dampers }) => {
    const isDamper = (n) => dampers.includes(n - mechanisms.length);
    const devices = [...mechanisms, ...springs].map((one, n) => elements.length + n)
      .filter((one, n) => !isDamper(n));
    if (!mechanisms.some(({ kind }) => kind === "converter")) return () => devices;
    const bypassed = (engaged) => {
      let bodies = [...Array(links + 1).keys()]; // the housing first
      const join = (a, b) => { bodies = bodies.map((one) => (one === bodies[a] ? bodies[b] : one)); };
      for (const n of engaged) join(...elements[n]);
      for (const [[a, one], [b, other] = [0, -one], ...more] of springs.filter((_, n) => !dampers.includes(n))) {
        if (!more.length && one === -other && Math.abs(one) === 1 && (one === 1 || !b)) join(a, b); // a shaft
      }
      return ({ kind, links: [a, b] }) => kind === "converter" && bodies[a] === bodies[b];
    };
    return (engaged) => {
      const isBypassed = bypassed(engaged);
      return devices.filter((one, n) => n >= mechanisms.length || !isBypassed(mechanisms[n]));
    };
  };

  const ofGear = (c, gear, number) => {
    const own = new Map(gear.ratios), mechanisms = c.mechanisms.map((one, n) => {
      const forward = number(one.efficiency), back = one.back === undefined ? forward : number(one.back);
      return { ...one, ratio: number(own.get(n) ?? one.ratio), forward, back };
    });
    for (const { ratio, kind, forward, back } of mechanisms) {
      const right = Number.isFinite(ratio) && (ratio !== 0 || kind) && forward > 0 && forward <= 1 && back >= 0 && back <= 1;
      if (!right) throw new Outside("no such number");
    }
    const given = (pairs) => pairs.map(([link, formula, other]) => [link, number(formula), other]);
    const numeric = { ...c, mechanisms, alwaysLoaded: alwaysLoaded(c) };
    const moved = { ...gear, speeds: given(gear.speeds), torques: given(gear.torques) };
    return told(numeric, moved, core(numeric, moved), number);
  };

  // What no loss changes, where freewheels, which ask for torques, do not decide it.
  const KINEMATIC = ["speeds", "slip_speeds", "planet_speeds", "ratio"];
  const lossless = (c, gear, number) => {
    if (c.elements.some(([, , isFreewheel]) => isFreewheel)) return {};
    const mechanisms = c.mechanisms.map((one) => ({ ...one, efficiency: 1, back: undefined }));
    const found = ofGear({ ...c, mechanisms }, { ...gear, drag: [], open: [] }, number);
    return Object.fromEntries(KINEMATIC.map((key) => [key, found[key]]));
  };

  const calculate = (c, numbers) => {
    const number = (formula) => evaluate(formula, numbers);
    const why = refused(c, number);
    return c.gears.map((gear) => {
      try {
        if (why) return { outside: why, isOfAll: true };
        if (c.depends) return { outside: "losses that depend on load", ...lossless(c, gear, number) };
        return ofGear(c, gear, number);
      } catch (error) {
        if (error instanceof Outside) return { outside: error.message };
        throw error;
      }
    });
  };

  // Steps to the next gear of a direction: statics/gear_steps.py.

  const steps = (c, told) => {
    const ratios = told.map(({ ratio }, n) => (ratio && c.gears[n].kind === "gear" ? ratio[0] : NaN));
    const sizes = ratios.map((ratio) => +Math.abs(ratio).toPrecision(10)); // so that rounding orders nothing
    return ratios.map((ratio, n) => {
      const isNext = (other, m) => c.gears[m].input === c.gears[n].input && c.gears[m].output === c.gears[n].output
        && (sizes[m] < sizes[n] || (sizes[m] === sizes[n] && m > n)) && other * ratio > 0;
      const next = Math.max(...ratios.filter(isNext).map(Math.abs));
      return { step: [next > 0 ? Math.abs(ratio) / next : NaN] };
    });
  };

  Object.assign(globalThis.transmission, { calculate, steps });
})();
