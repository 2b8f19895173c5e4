// Tables that sort, and whose rows are linked to the marks in curves.

function compareCells(a, b) {
  const x = Number(a), y = Number(b);
  const isNumber = text => text !== "" && text !== "-" && Number.isFinite(Number(text));
  if (isNumber(a) && isNumber(b)) return x - y;
  if (isNumber(a) !== isNumber(b)) return isNumber(a) ? -1 : 1;  // numbers before words
  return a < b ? -1 : a > b ? 1 : 0;
}

function sortBy(table, column, header) {
  const ascending = header.getAttribute("aria-sort") !== "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  header.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const body = table.tBodies[0];
  const rows = [...body.rows].map((row, i) => [row, row.cells[column].textContent, i]);
  const isMissing = text => text === "" || text === "-";  // last in any order
  rows.sort((a, b) => isMissing(a[1]) - isMissing(b[1]) || (ascending ? 1 : -1) * compareCells(a[1], b[1]) || a[2] - b[2]);
  body.append(...rows.map(([row]) => row));
}

function makeSortable(table) {
  [...table.tHead.rows[0].cells].forEach((header, column) => {
    const button = element("button", {type: "button", title: "sort by this column"}, header.textContent);
    header.replaceChildren(button);
    button.addEventListener("click", () => sortBy(table, column, header));
  });
}

// Marks the row and whatever stands for it in the curves of its study; no row: none.
function markRow(study, row, scrolls) {
  document.querySelectorAll("tr.on").forEach(other => other.classList.remove("on"));
  const found = row < 0 ? null : document.getElementById(study.id + "-" + row);
  if (found !== null) {
    found.classList.add("on");
    if (scrolls) found.scrollIntoView({block: "nearest"});
  }
  for (const data of study.figures) {
    for (const view of data.views) view.markRow(row);
  }
}

function linkRows(study) {
  const rows = new Set(study.figures.flatMap(data => data.lines.flatMap(line => line.marks.map(mark => mark.row))));
  for (const row of rows) {
    const found = row < 0 ? null : document.getElementById(study.id + "-" + row);
    if (found === null) continue;
    found.classList.add("linked");
    found.tabIndex = 0;
    found.addEventListener("click", () => markRow(study, row, false));
    found.addEventListener("focus", () => markRow(study, row, false));
  }
}
