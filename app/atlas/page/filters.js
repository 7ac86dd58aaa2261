// The filters: a range for the keys that are looked at, and a list of choices for all others that vary.
const ALWAYS = ["speed", "least_margin", "step"];

/** The keys that have a range: the usual ones, those of axes and colour, and those that limit already. */
function rangeKeys(axes) {
  const limited = [...filters.from.keys(), ...filters.to.keys()];
  const names = [...ALWAYS, ...axes.map((column) => column.name), ...limited];
  return present(names).filter((column) => column.isNumber && column.choices === null);
}

/** Fields for the least and the largest number of each key; fields that stay are left as they are. */
function showRanges(axes, change) {
  const place = find("ranges");
  const wanted = rangeKeys(axes);
  const groups = /** @type {NodeListOf<HTMLElement>} */ (place.querySelectorAll(":scope > [data-key]"));
  const known = new Map([...groups].map((group) => [group.dataset.key, group]));
  for (const [name, group] of known) if (!wanted.some((column) => column.name === name)) group.remove();
  for (const column of wanted) if (!known.has(column.name)) place.append(rangeGroup(column, change));
}

function rangeGroup(column, change) {
  const group = element("fieldset", "", { "data-key": column.name });
  group.append(element("legend", titled(column)));
  for (const side of ["from", "to"]) {
    const limits = filters[side];
    const label = element("label", side);
    const field = element("input", "", { type: "number", step: "any", inputmode: "decimal" });
    field.setAttribute("aria-label", `${titled(column)}, ${side}`);
    field.addEventListener("input", () => {
      if (Number.isNaN(field.valueAsNumber)) limits.delete(column.name);
      else limits.set(column.name, field.valueAsNumber);
      change();
    });
    label.append(field);
    group.append(label);
  }
  return group;
}

/** A list for each parameter that has choices. */
function showChoices(change) {
  const varied = [...columns.values()].filter((column) => column.choices !== null && varies(column));
  find("choices").replaceChildren(
    ...varied.map((column) => {
      const label = element("label", `${column.title} `, { class: "row" });
      const list = element("select", "", { "aria-label": column.title });
      list.append(element("option", "all", { value: "" }));
      const words = column.choices.map((_, place) => withUnit(column, choiceWords(column, place)));
      list.append(...words.map((text, place) => element("option", text, { value: place })));
      list.addEventListener("change", () => {
        if (list.value === "") filters.choice.delete(column.name);
        else filters.choice.set(column.name, Number(list.value));
        change();
      });
      label.append(list);
      return label;
    }),
  );
}

function clearFilters() {
  for (const limits of Object.values(filters)) limits.clear();
  for (const field of find("ranges").querySelectorAll("input")) field.value = "";
  for (const list of find("choices").querySelectorAll("select")) list.value = "";
}

/** Whether any filter is set. */
function isFiltered() {
  return Object.values(filters).some((limits) => limits.size > 0);
}
