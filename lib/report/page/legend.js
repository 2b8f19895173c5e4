// Which lines of a data set are shown: by a button each, and by the values of parameters.

function isShown(data, line) {
  const set = data.lines[line].set;
  const isChosen = (value, p) => data.chosen[p] === undefined || data.chosen[p] === value;
  return !data.hidden.has(line) && (set.length !== data.parameters.length || set.every(isChosen));
}

function refresh(data) {
  for (const view of data.views) view.refresh();
}

// A list of the values of a parameter, where lines differ in several.
function parameterChoice(data, p) {
  const values = [...new Set(data.lines.map(line => line.set[p]))];
  if (values.length < 2) return null;
  const select = element("select", {}, element("option", {value: ""}, "all"));
  for (const value of values) select.append(element("option", {value: value}, String(value)));
  select.addEventListener("change", () => {
    data.chosen[p] = select.value === "" ? undefined : Number(select.value);
    refresh(data);
  });
  data.choices.push(() => {
    select.value = data.chosen[p] === undefined ? "" : String(data.chosen[p]);
  });
  return element("label", {}, data.parameters[p] + " ", select);
}

// Turns the lines of a key into buttons.
function bringToLife(key, data) {
  const buttons = [];
  if (data.lines.length > 1) {
    key.querySelectorAll("li[data-line]").forEach(item => {
      const line = Number(item.dataset.line);
      const button = element("button", {type: "button", title: "show or hide; with the shift key, this one alone"},
                             ...item.childNodes);
      item.append(button);
      buttons.push([line, button]);
      button.addEventListener("click", event => {
        toggle(data, line, event.shiftKey);
        refresh(data);
      });
    });
  }
  const several = data.lines.every(line => line.set.length === data.parameters.length) && data.parameters.length > 1;
  for (let p = data.parameters.length - 1; several && p >= 0; --p) {
    const choice = parameterChoice(data, p);
    if (choice !== null) key.prepend(choice);
  }
  return () => {
    for (const [line, button] of buttons) button.setAttribute("aria-pressed", String(isShown(data, line)));
    for (const update of data.choices) update();
  };
}

function toggle(data, line, alone) {
  if (alone) {
    const isAlone = data.hidden.size === data.lines.length - 1 && !data.hidden.has(line);
    data.hidden = new Set(isAlone ? [] : data.lines.map((_, i) => i).filter(i => i !== line));
  } else if (data.hidden.has(line)) {
    data.hidden.delete(line);
  } else {
    data.hidden.add(line);
  }
}
