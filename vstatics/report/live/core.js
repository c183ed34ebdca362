// The statics of one gear, as `vstatics` calculates them: `core(train, gear)`.
//
// Both as vstatics/report/live/lowered.py has them. The answer is the state of the gear, NaN for what
// does not exist; `Outside` is thrown where the program is to be asked. See docs/method.md. In short:
// - speeds and torques are relative to those of the input; link 0 is the housing, which stands;
// - the column of a device has the torques that its links give to it by the torque on its first link:
//   (1, -1) of a shift element, (1, -u, u - 1) of a mechanism; it is its equation for speeds, too;
// - losses make of u the ratio u * efficiency**x, x = +1 where the first link drives, seen from the
//   third, else -1. A set of signs x must agree with the powers that it leads to.
"use strict";

{
class Outside extends Error {}
const EPSILON = 2 ** -52, REAL = 2 ** -20, PIVOT = 0.1; // see numerics/tolerances.py
const TIE = 1e-9, UNCERTAIN = 1e-6, NEAR_ONE = 1e-4, NO_POWER = 1e-12, TURNING = 1e-9;
const SEARCHED = 12, RIGHT = -1; // most signs that are searched; the column of right-hand sides

const outside = (why) => { throw new Outside(why); };
const sum = (terms) => terms.reduce((total, one) => total + one, 0);
const last = (list) => list[list.length - 1];
const times = (a, b) => (a === 0 || b === 0 ? 0 : a * b); // also where the other is NaN
const { abs, sign } = Math, none = Number.isNaN;
const value = (given) => (Array.isArray(given) ? given[0] + given[1] : given); // of one or two terms
const range = (count) => [...Array(count).keys()];
const add = (map, link, torque) => map.set(link, (map.get(link) ?? 0) + torque);

// Linear systems: numerics/elimination.py
// An entry is [value, size]; the size sums up the magnitudes that it was made from, which bounds its
// rounding. A row is a Map of column -> entry, without what is zero.

const entry = (number) => [number, abs(number)];
const quotient = ([a, size], [b, other]) => [a / b, (size + abs(a / b) * other) / abs(b)];

const less = ([a, size], [factor, ofFactor], [term, ofTerm]) => { // a - factor * term
  const product = factor * term, left = a - product;
  size += ofFactor * abs(term) + abs(factor) * ofTerm;
  const rounding = Math.min(EPSILON * size, REAL * Math.max(abs(a), abs(product)));
  return [abs(left) <= rounding && rounding < Infinity ? 0 : left, size];
};

const subtract = (row, factor, other) => {
  for (const [column, term] of other) {
    const made = less(row.get(column) ?? [0, 0], factor, term);
    row.delete(column);
    if (made[0] !== 0) row.set(column, made);
  }
};

const rowOf = (equation) => { // of pairs of a column and a coefficient, a number or two terms
  const row = new Map();
  for (const [column, given] of equation) {
    const made = Array.isArray(given) ? less(entry(given[0]), [1, 0], entry(-given[1])) : entry(given);
    if (made[0] !== 0) row.set(column, made);
  }
  return row;
};
const lengthOf = (row) => row.size - row.has(RIGHT);

const choose = (active) => { // the pivot that fills least among those large enough
  const shortest = Math.min(...active.map(lengthOf));
  const candidates = active.filter((row) => lengthOf(row) === shortest);
  let best = [candidates[0], Math.max(...candidates[0].keys())], least = Infinity;
  if (shortest === 1) return best;
  const counts = new Map();
  for (const row of active) for (const column of row.keys()) add(counts, column, 1);
  for (const row of candidates) {
    for (const [column, [pivot]] of row) {
      if (column === RIGHT || counts.get(column) >= least) continue;
      if (![...row].every(([one, [other]]) => one === RIGHT || abs(pivot) >= PIVOT * abs(other))) continue;
      [best, least] = [[row, column], counts.get(column)];
    }
  }
  return best;
};

const solve = (equations, unknowns, sums = []) => {
  const pivots = [], left = [];
  let active = [];
  const sortIn = (row) => (lengthOf(row) ? active : left).push(row);
  equations.map(rowOf).forEach(sortIn);
  while (active.length) {
    const [row, column] = choose(active), pivot = row.get(column), others = active;
    row.delete(column);
    pivots.push([column, pivot, row]);
    active = [];
    for (const other of others) {
      if (other === row) continue;
      const own = other.get(column);
      if (own === undefined) { active.push(other); continue; }
      other.delete(column);
      subtract(other, quotient(own, pivot), row);
      sortIn(other);
    }
  }
  const told = left.filter((row) => row.has(RIGHT)).map((row) => row.get(RIGHT));
  const consistent = !told.length, decisive = [...pivots.map((one) => one[1]), ...told];
  let values = Array(unknowns + sums.length).fill(NaN);
  if (consistent) {
    const known = new Map(range(unknowns).map((one) => [one, new Map([[one, [1, 0]]])])); // free ones
    for (const [column, pivot, row] of pivots.reverse()) {
      const total = new Map(row.has(RIGHT) ? [[RIGHT, row.get(RIGHT)]] : []);
      for (const [one, factor] of row) if (one >= 0) subtract(total, factor, known.get(one));
      known.set(column, new Map([...total].map(([one, own]) => [one, quotient(own, pivot)])));
    }
    const wanted = range(unknowns).map((one) => known.get(one));
    for (const terms of sums) {
      const total = new Map();
      for (const [one, factor] of terms) subtract(total, [-factor, 0], known.get(one));
      wanted.push(total);
    }
    const entries = wanted.map((row) => (lengthOf(row) ? [NaN, 0] : row.get(RIGHT) ?? [0, 0]));
    values = entries.map((one) => one[0]);
    decisive.push(...entries);
  }
  const certain = decisive.every(([own, size]) => !(EPSILON * size > UNCERTAIN * abs(own)));
  return { values, consistent, certain };
};

// Equations: statics/matrix.py

const torqueRatio = ({ points }, i) => { // of a converter: straight between points
  if (i <= points[0][0]) return points[0][1];
  for (let n = 1; n < points.length; n += 1) {
    const [[left, before], [right, after]] = [points[n - 1], points[n]];
    if (i <= right) return before + (i - left) * ((after - before) / (right - left));
  }
  return last(points)[1];
};

const speedRow = ({ kind }, u) => (kind ? [u, -1, [1, -u]] : [1, -u, [u, -1]]);
const torqueColumn = (one, u) => {
  if (one.kind !== "converter") return speedRow(one, u);
  const K = torqueRatio(one, u);
  return [1, -K, [K, -1]];
};

const byDevice = ({ elements, mechanisms, springs }, ratios, of) => { // pairs of link and coefficient
  const pairs = (links, parts) => links.map((link, n) => [link, parts[n]]).filter(([link]) => link);
  return [...elements.map((one) => pairs(one.slice(0, 2), [1, -1])),
    ...mechanisms.map((one, n) => pairs(one.links, of(one, ratios[n]))), ...springs];
};

const isTie = (difference, ...speeds) => speeds.some((one) => abs(difference) <= TIE * abs(one));
const isLossy = ({ forward, back }) => forward < 1 || back < 1;
const passed = ({ forward, back }, x) => { // efficiency**x
  if (x === 0 || (forward === 1 && back === 1)) return 1;
  return x > 0 ? forward : x < 0 && back ? 1 / back : NaN;
};

const sets = (items, size) => (size // combinations in their order
  ? items.flatMap((one, n) => sets(items.slice(n + 1), size - 1).map((rest) => [one, ...rest])) : [[]]);

const noDrag = () => ({ links: new Map(), elements: new Map(), external: new Map(), losses: [] });
const NO_DRAG = noDrag();

const core = (train, gear) => {
  const { links: count, elements, mechanisms } = train, { direction, output } = gear;
  const first = elements.length; // of the mechanisms among the devices
  const ratios = mechanisms.map(({ ratio }) => ratio), devices = range(mechanisms.length);
  const columns = byDevice(train, ratios, torqueColumn), rows = byDevice(train, ratios, speedRow);
  const freewheels = range(first).filter((n) => elements[n][2]);
  const held = gear.speeds.map(([link]) => link).filter((link) => link !== output);
  const hasFurtherPorts = gear.speeds.length + gear.torques.length > 0;
  const isConverter = (n) => mechanisms[n].kind === "converter";
  const external = new Map([[gear.input, gear.torque]]);
  for (const [link, torque] of gear.torques) add(external, link, torque);
  if (mechanisms.some(({ ratio, links }) => links[2] && ratio !== 1 && abs(ratio - 1) < NEAR_ONE)) outside("nearly singular");

  // Speeds and torques: statics/speeds.py, torques.py

  const solveSpeeds = (engaged) => {
    const pairs = [...mechanisms.map(({ links }) => [links[0], links[2]]), ...elements];
    const sums = pairs.map(([a, b]) => [[a - 1, 1], [b - 1, -1]].filter(([column]) => column >= 0));
    const used = [...train.alwaysLoaded(engaged), ...engaged].map((n) => rows[n]);
    const equations = used.map((row) => row.map(([link, part]) => [link - 1, part]));
    equations.push([[gear.input - 1, 1], [RIGHT, 1]]);
    for (const [link, speed, other] of gear.speeds) { // a number, or that of another link
      equations.push([[link - 1, 1], other ? [other - 1, -speed] : [RIGHT, speed]]);
    }
    const solution = solve(equations, count, sums), { values } = solution;
    const links = [0, ...values.slice(0, count)]; // the housing first
    const relative = devices.map((n) => { // first link against third
      const own = values[count + n], [one, , third] = mechanisms[n].links;
      return isTie(own, links[one], links[third]) ? 0 : own;
    });
    return { ...solution, links, relative, slips: values.slice(count + mechanisms.length) };
  };

  const torqueSystem = (engaged, by, drag) => { // the equilibrium of each link
    const equations = range(count + 1).map(() => []), acting = new Map(external);
    const loaded = [...[...engaged].sort((a, b) => a - b), ...train.alwaysLoaded(engaged)];
    loaded.forEach((device, n) => by[device].forEach(([link, part]) => equations[link].push([n, part])));
    equations[output].push([loaded.length, 1]);
    held.forEach((link, n) => equations[link].push([loaded.length + 1 + n, -1]));
    for (const [link, torque] of drag.external) add(acting, link, torque);
    for (const [link, torque] of acting) equations[link].push([RIGHT, torque]);
    return { equations: equations.slice(1), loaded, size: loaded.length + 1 + held.length };
  };

  // On first links of devices, then the output's; `factors` are what columns are multiplied with.
  const solveTorques = (engaged, by, drag) => {
    const { equations, loaded, size } = torqueSystem(engaged, by, drag);
    const { values, consistent, certain } = solve(equations, size);
    const factors = Array(by.length + 1).fill(consistent ? 0 : NaN);
    [...loaded, by.length].forEach((device, n) => { factors[device] = values[n]; });
    if (consistent) for (const [device, torque] of drag.elements) factors[device] = torque;
    const torques = factors.slice();
    mechanisms.forEach(({ kind }, n) => {
      if (kind === "variator") torques[first + n] = times(factors[first + n], value(by[first + n][0][1]));
    });
    const holding = new Map(held.map((link, n) => [link, values[loaded.length + 1 + n]]));
    return { torques, factors, holding, consistent, certain };
  };

  const noTorques = (torques = Array(columns.length + 1).fill(NaN)) => ({
    torques, factors: torques, holding: new Map(held.map((link) => [link, NaN])), consistent: false, certain: true });

  const dragTorques = (engaged, { links, slips }) => { // against motion, so it takes power
    const drag = noDrag();
    const against = (torque, speed) => (none(speed) ? 0 : torque * direction * sign(speed));
    for (const [link, torque] of gear.drag) {
      const own = against(torque, links[link]);
      if (!own) continue;
      drag.links.set(link, -own);
      add(drag.external, link, -own);
      drag.losses.push(own * links[link]);
    }
    for (const [element, torque] of gear.open) {
      const [a, b] = elements[element], slip = slips[element], own = against(torque, slip);
      if (engaged.includes(element) || !own || isTie(slip, links[a], links[b])) continue;
      drag.elements.set(element, own);
      if (a) add(drag.external, a, -own);
      if (b) add(drag.external, b, own);
      drag.losses.push(own * slip);
    }
    return drag;
  };

  // Without losses: statics/ideal.py

  const converterSlip = (n) => 1 - torqueRatio(mechanisms[n], ratios[n]) * ratios[n];

  const idealGear = (engaged, speeds) => {
    let ideal = solveTorques(engaged, columns, NO_DRAG);
    const gains = (n) => times(times(ideal.torques[first + n], speeds.relative[n]), converterSlip(n)) * direction < 0;
    if (devices.filter(isConverter).some(gains)) ideal = noTorques(); // no converter does
    const drag = dragTorques(engaged, speeds);
    const withDrag = drag.losses.length ? solveTorques(engaged, columns, drag) : ideal;
    return { engaged, speeds, ideal, drag, withDrag, overcome: false };
  };

  // By link, the housing first: devices (-1: from outside) with the sizes of their torques there.
  const torquesByLink = ({ drag }, by, { torques, factors, holding }) => {
    const found = range(count + 1).map(() => []);
    by.forEach((column, device) => column.forEach(([link, share]) => (
      found[link].push([device, abs(value(share) * factors[device])]))));
    found[output].push([-1, abs(last(torques))]);
    for (const [link, torque] of [...external, ...holding, ...drag.links]) found[link].push([-1, abs(torque)]);
    return found;
  };

  const isNothing = (byLink, device, links) => links.filter((link) => link).every((link) => { // beside others
    const own = byLink[link].find(([other]) => other === device)[1];
    return own === 0 || byLink[link].some(([other, size]) => other !== device && own <= TIE * size);
  });

  const mechanismTorques = (state, by, solved) => { // 0 where it is a tie
    const byLink = torquesByLink(state, by, solved);
    return mechanisms.map(({ links }, n) => (isNothing(byLink, first + n, links) ? 0 : solved.torques[first + n]));
  };

  // Losses under given signs: statics/losses.py

  const entering = ({ speeds }, { torques, holding }) => { // power by each link, from outside
    const acting = new Map([...external, ...holding]);
    add(acting, output, -last(torques));
    return [...acting].map(([link, torque]) => times(torque, speeds.links[link]));
  };

  const shares = (sides, powers) => { // what leaves by what enters, on the sides of some powers
    let received = 0, given = 0;
    for (const [n, side] of sides.entries()) {
      if (none(side)) return NaN;
      if (side * direction > 0) received += powers[n];
      if (side * direction < 0) given -= powers[n];
    }
    return received === 0 ? NaN : given / received;
  };

  const efficiencyOf = (state, solved) => { // by which sets of signs are compared
    if (hasFurtherPorts || devices.some(isConverter)) return shares(entering(state, state.ideal), entering(state, solved));
    const outputs = [solved, state.ideal].map((one) => last(one.torques));
    if (direction < 0) outputs.reverse();
    return outputs[1] === 0 ? NaN : outputs[0] / outputs[1];
  };

  const powerRatio = (state, lossy) => { // as it is told: ports on the sides of their own powers
    const ports = entering(state, lossy.solved);
    return hasFurtherPorts ? shares(ports, ports) : lossy.efficiency;
  };

  const noSolution = (signs) => {
    const nothing = signs.map(() => NaN), own = { directions: nothing, losses: nothing, powers: nothing };
    return { ...own, signs, solved: noTorques(), efficiency: NaN, dragLosses: NaN, balance: NaN, admissible: false };
  };

  const isPossible = (signs) => devices.every((n) => mechanisms[n].back || !(signs[n] < 0));

  const lossyRatios = (signs) => devices.map((n) => {
    const factor = passed(mechanisms[n], signs[n]);
    return mechanisms[n].kind === "variator" ? ratios[n] / factor : ratios[n] * factor;
  });

  const torquesForSigns = (state, signs) => {
    if (!isPossible(signs)) return noSolution(signs);
    const factors = devices.map((n) => passed(mechanisms[n], signs[n])), { drag } = state;
    const by = byDevice(train, lossyRatios(signs), torqueColumn), solved = solveTorques(state.engaged, by, drag);
    const powers = mechanismTorques(state, by, solved).map((torque, n) => times(torque, state.speeds.relative[n]));
    const losses = powers.map((power, n) => times(power, isConverter(n) ? converterSlip(n) : 1 - factors[n]));
    const directions = powers.map((power) => sign(power) * direction);
    const agrees = devices.every((n) => (signs[n] === 0 || !isLossy(mechanisms[n]) || signs[n] * directions[n] >= 0)
      && (!isConverter(n) || losses[n] * direction >= 0));
    const efficiency = efficiencyOf(state, solved), passes = (one) => one > 0 && one < Infinity;
    return {
      signs, solved, by, powers, losses, directions, efficiency, dragLosses: sum(drag.losses),
      balance: sum(entering(state, solved)) - sum(losses) - sum(drag.losses),
      admissible: agrees // and power passes, if it does without losses
        && (state.overcome || passes(efficiency) || !passes(abs(efficiencyOf(state, state.ideal)))),
    };
  };

  // Signs: statics/signs.py

  const idealSigns = (state, moving) => {
    const torques = moving ? mechanismTorques(state, columns, state.withDrag) : devices.map(() => NaN);
    const relative = moving ? state.speeds.relative : torques;
    const unloaded = torques.map((one) => one === 0), still = relative.map((one) => one === 0);
    const signs = devices.map((n) => {
      if (!unloaded[n] && !still[n]) return sign(torques[n] * relative[n]) * direction;
      if (train.idle === "exact") return 0; // the convention for what has no flow
      if (unloaded[n] || ratios[n] > 0) return 1;
      return mechanisms[n].back ? -1 : 0;
    });
    return { signs, unloaded, still };
  };

  const followUnloaded = (state, start) => { // what idles takes the sign of its flow with losses
    let { signs } = start, lossy = torquesForSigns(state, signs);
    for (let round = 0; round < signs.length; round += 1) {
      const flow = lossy.directions;
      const followed = signs.map((x, n) => (start.unloaded[n] && abs(flow[n]) === 1 ? flow[n] : x));
      if (followed.every((x, n) => Object.is(x, signs[n]))) break;
      signs = followed;
      lossy = torquesForSigns(state, signs);
    }
    return lossy;
  };

  const everySet = (state, { signs }, free) => range(2 ** free.length).map((set) => {
    const own = signs.slice(); // +1 first; the last of them turns first
    free.forEach((place, n) => { own[place] = (set >> (free.length - 1 - n)) & 1 ? -1 : 1; });
    return own;
  }).filter(isPossible).map((own) => torquesForSigns(state, own));

  const search = (state, start) => { // the admissible set of the largest efficiency, null: there is none
    let free = devices.filter((n) => !start.still[n] && isLossy(mechanisms[n]));
    if (free.length > SEARCHED) free = free.filter((n) => !start.unloaded[n]);
    if (free.length > SEARCHED) outside("too many signs");
    const found = everySet(state, start, free).filter((one) => one.admissible);
    if (found.length) {
      const best = found.reduce((one, other) => (
        other.efficiency > one.efficiency || !(one.efficiency < Infinity) ? other : one));
      const isIdle = (n) => start.unloaded[n] && best.directions[n] === 0;
      return { ...best, signs: best.signs.map((x, n) => (isIdle(n) ? start.signs[n] : x)) };
    }
    if (free.length || start.signs.every((x, n) => !start.still[n] || x === 0)) return null;
    // nothing moves that could lock: the convention for idle mechanisms does not suit
    return search(state, { ...start, signs: start.signs.map((x, n) => (start.still[n] ? 0 : x)) });
  };

  const admissible = (state, start) => {
    const lossy = followUnloaded(state, start);
    return lossy.admissible ? lossy : search(state, start);
  };

  // What all sets of signs lead to, where statics leaves the flow through some mechanisms open.
  const common = (state, start, open) => {
    const tried = open.length > SEARCHED ? [] : everySet(state, start, open), [one] = tried;
    if (!tried.length || tried.some(({ efficiency }) => efficiency <= 0)) return noSolution(start.signs);
    const same = (of) => { // the number that all have, to rounding
      const own = of(one), most = TIE * Math.max(abs(own), 1);
      return tried.every((each) => abs(of(each) - own) <= most) ? own : NaN;
    };
    const all = (of) => of(one).map((_, n) => same((each) => of(each)[n]));
    const holding = new Map(held.map((link) => [link, same((each) => each.solved.holding.get(link))]));
    const torques = all((each) => each.solved.torques), factors = all((each) => each.solved.factors);
    return {
      ...one, solved: { ...one.solved, torques, factors, holding }, admissible: false,
      signs: all((each) => each.signs), losses: all((each) => each.losses), 
      efficiency: same((each) => powerRatio(state, each)), balance: same((each) => each.balance),
    };
  };

  const isDragged = (state, { solved, efficiency, dragLosses }) => { // from the output, none leaves at the input
    if (!state.drag.losses.length || !(state.overcome || none(efficiency))) return false;
    const entered = -times(last(solved.torques), state.speeds.links[output]);
    return external.get(gear.input) * direction >= 0 && entered * direction > NO_POWER * dragLosses * direction;
  };

  const findSigns = (given) => {
    const moving = given.ideal.consistent && given.speeds.consistent, start = idealSigns(given, moving);
    const open = devices.filter((n) => none(start.signs[n]) && isLossy(mechanisms[n]));
    let state = given, lossy = noSolution(start.signs), found = lossy;
    if (moving && open.length) {
      lossy = common(state, start, open);
    } else if (moving) {
      found = admissible(state, start);
      if (!found && state.drag.losses.length) { // unless friction alone locks it the output may overcome drag
        const bare = { ...state, drag: NO_DRAG, withDrag: state.ideal };
        state = { ...state, overcome: true };
        found = admissible(bare, idealSigns(bare, true)) && admissible(state, start);
      }
      lossy = found ?? lossy;
    }
    const dragged = lossy.admissible && isDragged(state, lossy);
    if (lossy.admissible) lossy = { ...lossy, efficiency: dragged ? NaN : powerRatio(state, lossy) };
    return { ...state, lossy, dragged, locked: !found, idle: devices.map((n) => start.unloaded[n] || start.still[n]) };
  };

  // Freewheels: statics/freewheels.py

  const drivenBackward = (engaged, { links, slips }) => freewheels.some((n) => !engaged.includes(n)
    && slips[n] * gear.turns < 0 && !isTie(slips[n], links[elements[n][0]], links[elements[n][1]]));

  const canHold = (state, n) => { // with a torque of the right sign, or none
    let solved = state.withDrag, by = columns;
    if (!none(state.lossy.solved.torques[n])) ({ solved, by = columns } = state.lossy);
    const pull = sign(solved.torques[n]) * direction * gear.turns;
    return pull <= 0 || (pull > 0 && isNothing(torquesByLink(state, by, solved), n, elements[n].slice(0, 2)));
  };

  const possible = (engaged, speeds = solveSpeeds(engaged)) => {
    if (!speeds.consistent || none(speeds.links[output]) || drivenBackward(engaged, speeds)) return [];
    const state = findSigns(idealGear(engaged, speeds)), holding = freewheels.filter((n) => engaged.includes(n));
    return state.ideal.consistent && holding.every((n) => canHold(state, n)) ? [state] : [];
  };

  const findState = () => {
    const { engaged } = gear, nobody = solveSpeeds(engaged);
    if (!nobody.consistent) outside("tied up");
    if (drivenBackward(engaged, nobody)) outside("freewheels in conflict");
    for (let size = 0; freewheels.length && size <= freewheels.length; size += 1) { // the fewest that do
      const found = sets(freewheels, size).flatMap((more) => possible([...engaged, ...more]));
      if (found.length > 1) outside("freewheels in more than one state");
      if (found.length) return found[0];
    }
    return findSigns(idealGear(engaged, nobody)); // all overrun
  };

  const state = findState(), { lossy, speeds, ideal, withDrag, drag } = state;
  if (state.locked) outside("locked by friction");
  if (![speeds, ideal, withDrag, lossy.solved].every(({ certain }) => certain)) outside("lost in rounding");
  const turns = (power, n) => !state.idle[n] && isLossy(mechanisms[n]) && power !== 0 && abs(power) < TURNING;
  if (lossy.powers.some(turns)) outside("a power turns");

  // Sums of shares of torques of devices, which may be known where the torques are not.
  const sums = (isLossy, asked) => {
    const { equations, loaded, size } = torqueSystem(state.engaged, ...(isLossy ? [lossy.by, drag] : [columns, NO_DRAG]));
    const known = asked.map((terms) => terms.map(([n, share]) => [loaded.indexOf(n), share]).filter(([n]) => n >= 0));
    return solve(equations, size, known).values.slice(size);
  };
  return { ...state, ratios, lossyRatios: lossyRatios(lossy.signs), sums };
};

globalThis.transmission = { core, torqueColumn, value, Outside };
}
