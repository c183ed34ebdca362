
  // Rows of one link: a name, or a part of names, leaves these rows in tables whose rows are of links.

  const asked = document.getElementById("links"), told = document.getElementById("hidden-rows");

  const filter = () => {
    const text = asked.value.trim(), names = new Set(Object.values(cases).flatMap(({ links }) => links));
    const own = names.has(text) ? [text] : [...names].filter((name) => name.toLowerCase().includes(text.toLowerCase()));
    const every = text === "" || !own.length;
    let hidden = 0;
    for (const head of document.querySelectorAll("main tbody th[data-links]")) {
      const { links } = cases[head.dataset.case ?? ""] ?? { links: [] };
      const row = head.closest("tr");
      row.hidden = !every && !head.dataset.links.split(" ").some((place) => own.includes(links[place]));
      hidden += row.hidden;
    }
    told.textContent = text === "" ? "" : own.length ? `rows hidden: ${hidden}` : `no link ${text}`;
    document.getElementById("names-of-links").replaceChildren(...[...names].map((name) => new Option(name, name)));
  };

  asked.value = choices.read().links ?? "";
  asked.addEventListener("input", () => { choices.keep({ links: asked.value }); filter(); });
  asked.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    asked.value = "";
    asked.dispatchEvent(new Event("input", { bubbles: true }));
  });
  followers.push(filter);
