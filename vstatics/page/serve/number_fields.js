// Fields for numbers, as text: a browser drops the comma of "-2,6" from a field of its own kind,
// without a word. Here it is the decimal point, whatever language the page and the browser have.
"use strict";
(() => {
  const NUMBER = /^[+-]?(\d+[.,]?\d*|[.,]\d+)(e[+-]?\d+)?$/i, BEGUN = /^[+-]?\d*[.,]?\d*(e[+-]?)?$/i;
  const held = new WeakMap(); // field -> the number that it stands for
  const entered = new WeakMap(); // field -> what it stood for before something is typed
  let isLeft = false; // what is begun stays as it is

  const plain = (field) => field.value.trim().replace(/^[\u2212\u2013]/, "-"); // as texts write a minus
  const parsed = (field) => {
    const text = plain(field), number = NUMBER.test(text) ? Number(text.replace(",", ".")) : NaN;
    return Number.isFinite(number) ? number : NaN;
  };
  const numberOf = (field) => held.get(field) ?? parseFloat(field.defaultValue);
  const say = (field) => field.dispatchEvent(new Event("input", { bubbles: true }));

  function tell(field, said) { // below the field; nothing where it is a number
    const id = `unread-${field.dataset.path}`;
    let note = document.getElementById(id);
    if (!said) {
      note?.remove();
      for (const name of ["aria-invalid", "aria-describedby"]) field.removeAttribute(name);
      return;
    }
    if (!note) {
      note = document.createElement("p");
      Object.assign(note, { id, className: "unread", role: "alert" });
      field.parentElement.append(note);
    }
    if (note.textContent !== said) note.textContent = said;
    field.setAttribute("aria-invalid", "true");
    field.setAttribute("aria-describedby", id);
  }

  function refuse(field) {
    const now = entered.get(field) ?? parseFloat(field.defaultValue);
    held.set(field, now);
    tell(field, `Not a number such as 64.5 or 64,5: ${now} stays.`);
  }

  // The number of a field or slider, NaN while it is begun; of what can't be read, as is told, the one before.
  function read(field) {
    if (field.type === "range") return field.valueAsNumber;
    const number = parsed(field);
    if (Number.isNaN(number)) {
      if (!isLeft && BEGUN.test(plain(field))) return NaN;
      refuse(field);
    } else {
      held.set(field, number);
      tell(field, "");
    }
    return numberOf(field);
  }

  function enter(field, number) {
    entered.set(field, number);
    field.value = Number.isFinite(number) ? number : "";
  }

  function restore(field, number) {
    enter(field, number);
    if (field.type === "range") return;
    held.set(field, number);
    tell(field, "");
  }

  // Another number into a field or slider; what is typed stays where it is this number.
  function write(field, number) {
    if ((field.type === "range" ? field.valueAsNumber : numberOf(field)) !== number) restore(field, number);
  }

  addEventListener("change", ({ target }) => {
    if (!target.matches?.("input.field")) return;
    const number = parsed(target);
    if (!Number.isNaN(number)) { enter(target, number); return; }
    isLeft = true;
    say(target);
    isLeft = false;
  });

  addEventListener("keydown", (event) => {
    const { target: field, key } = event, way = { ArrowUp: 1, ArrowDown: -1 }[key];
    if (!way || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (!field.matches?.("input.field")) return;
    event.preventDefault();
    enter(field, Number((numberOf(field) + way * field.dataset.step).toPrecision(15)));
    say(field);
  });

  globalThis.typed = { numberOf, read, restore, write };
})();
