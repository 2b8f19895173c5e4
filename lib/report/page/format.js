// Numbers as texts, and elements. Names and titles enter the page as text alone.

function shortNumber(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (value !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(5).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(7)));
}

function element(name, attributes, ...content) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value !== null && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...content);
  return made;
}

// The class of a line, by which it has its colour: as line_class() of the program.
function lineClass(line, lines) {
  return lines <= 8 ? "c" + line : "s" + Math.floor((line * 15) / (lines - 1));
}
