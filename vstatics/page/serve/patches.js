"use strict";
(() => {
  // Sections of which texts and attributes change, but no element comes or goes: what differs is
  // written into the elements that are there, which stay sorted, filtered, chosen and focused.
  const ADDED = ".copy, .save, .saves"; // by other scripts, as are the buttons around headings of tables
  const known = new WeakMap(); // section -> the tokens that it was made of, and the node of each
  const tokensOf = (html) => html.match(/<[^>]*>|[^<]+/g) ?? [];
  const nameOf = (token) => /^<([\w-]+)/.exec(token)?.[1]; // of an element that begins

  function nodesOf(section) {
    const accepted = (node) => {
      if (node.nodeType === Node.TEXT_NODE) return NodeFilter.FILTER_ACCEPT;
      if (node.matches(ADDED)) return NodeFilter.FILTER_REJECT;
      return node.matches("th > [role=button]") ? NodeFilter.FILTER_SKIP : NodeFilter.FILTER_ACCEPT;
    };
    const walker = document.createTreeWalker(section, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT, accepted);
    const nodes = [section];
    while (walker.nextNode()) nodes.push(walker.currentNode);
    return nodes;
  }

  // What a section is made of; its nodes are those that it has now, or had then
  function learn(section, html, nodes = nodesOf(section)) {
    const tokens = tokensOf(html), rest = nodes[Symbol.iterator]();
    const found = tokens.map((token) => (token.startsWith("</") ? null : rest.next().value));
    const fits = (node, n) => node === null || (node && (node.localName ?? undefined) === nameOf(tokens[n]));
    if (rest.next().done && found.every(fits)) known.set(section, { tokens, nodes: found });
    else known.delete(section);
  }

  const attributes = (token) => new Map([...token.matchAll(/ ([\w-]+)(?:="([^"]*)")?/g)].map(([, name, value]) => [name, value ?? ""]));
  const SIGNS = { amp: "&", lt: "<", gt: ">", quot: "\"", "#x27": "'" };
  const plain = (text) => (text.includes("&") ? text.replace(/&([#\w]+);/g, (all, name) => SIGNS[name] ?? all) : text);

  // where a text is written: into its node, or the one that another script put in its place
  function textNode(node, owner) {
    if (node.isConnected) return node;
    const only = owner?.isConnected && owner.childNodes.length === 1 ? owner.firstChild : null;
    return only?.nodeType === Node.TEXT_NODE ? only : null;
  }

  // The elements that are other than before, and those whose number is; null where it can't be done so.
  function patch(section, html) {
    const old = known.get(section);
    if (!old || section.querySelector("[aria-sort=ascending], [aria-sort=descending]")) return null;
    const tokens = tokensOf(html);
    if (tokens.length !== old.tokens.length) return null;
    const work = [];
    let owner = null; // of a text that follows
    for (let n = 0; n < tokens.length; n += 1) {
      const node = old.nodes[n], now = tokens[n], before = old.tokens[n];
      if (node?.nodeType !== Node.TEXT_NODE) owner = node; // none after an end
      if (now === before) continue;
      if (!node || nameOf(now) !== nameOf(before) || now.startsWith("</")) return null;
      const target = node.nodeType === Node.TEXT_NODE ? textNode(node, owner) : node;
      if (!target?.isConnected) return null;
      work.push([target, before, now]);
    }
    const changed = new Set(), numbers = new Set();
    for (const [node, before, now] of work) {
      changed.add(node.nodeType === Node.TEXT_NODE ? node.parentElement : node);
      if (node.nodeType === Node.TEXT_NODE) node.data = plain(now);
      else if (write(node, attributes(before), attributes(now))) numbers.add(node);
    }
    old.tokens = tokens;
    return { changed, numbers };
  }

  function write(element, before, now) {
    for (const name of before.keys()) if (!now.has(name)) element.removeAttribute(name);
    for (const [name, value] of now) if (before.get(name) !== value) element.setAttribute(name, plain(value));
    return before.get("data-number") !== now.get("data-number");
  }

  globalThis.patches = { learn, nodesOf, patch };
})();
