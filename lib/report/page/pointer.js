// The point of a curve next to the pointer, or chosen by keys: its values, and the multiples of its frequency.

const reach = 40;         // pixels from the pointer to a point
const mostMultiple = 9;
const mostValues = 14;    // that are shown at a point

class Pointer {
  constructor(curve) {
    this.curve = curve;
    this.at = null;          // {line, part, i}
    this.emphasized = null;  // line
    this.values = element("div", {class: "values", hidden: ""});
    this.spoken = element("p", {class: "spoken", "aria-live": "polite"});
    curve.figure.append(this.values, this.spoken);
    const svg = curve.svg.node();
    svg.addEventListener("pointermove", event => this.show(this.nearest(...this.place(event)), false));
    svg.addEventListener("click", event => this.showMotion(event.target));
    svg.addEventListener("pointerleave", () => this.show(null, false));
    svg.addEventListener("blur", () => this.show(null, false));
  }

  // Of the point that is shown. A click on a mark leads to its row alone.
  showMotion(target) {
    if (this.at !== null && !target.classList.contains("mark")) showMotion(this.curve, this.at);
  }

  // In the units of the drawing.
  place(event) {
    const box = this.curve.svg.node().getBoundingClientRect();
    return [(event.clientX - box.left) * paper.width / box.width, (event.clientY - box.top) * paper.height / box.height];
  }

  nearest(px, py) {
    const {curve} = this, {k, x: tx, y: ty} = curve.transform;
    const x = (px - tx) / k, y = (py - ty) / k;
    let best = (reach / k) * (reach / k), found = null;
    curve.places.forEach((parts, line) => {
      if (!isShown(curve.data, line)) return;
      parts.forEach((places, part) => {
        for (let i = 0; i < places.x.length; ++i) {
          const dx = places.x[i] - x, dy = places.y[i] - y, distance = dx * dx + dy * dy;
          if (distance < best) {
            best = distance;
            found = {line, part, i};
          }
        }
      });
    });
    return found;
  }

  show(at, aloud) {
    this.at = at;
    this.emphasize(at === null ? null : at.line);
    this.values.hidden = at === null;
    if (at !== null) this.write(aloud);
    this.refresh();
  }

  // Draws a line before the others, which fade as one; null: none.
  emphasize(line) {
    const {curve} = this;
    if (line === this.emphasized) return;
    this.emphasized = line;
    curve.moved.classed("dim", line !== null && curve.data.lines.length > 1);
    curve.front.node().replaceChildren(...(line === null ? [] : curve.outlines[line].map(each => each.cloneNode())));
  }

  // Pairs of a quantity and its value.
  pairs() {
    const {data, description} = this.curve, {line, part, i} = this.at;
    const of = data.lines[line].parts[part];
    const columns = [...new Set([description.x, description.y, ...data.columns.keys()])].slice(0, mostValues);
    const pairs = columns.filter(c => of.columns[c][i] !== null)
      .map(c => [data.columns[c].label, shortNumber(of.columns[c][i] * (data.columns[c].factor || 1))]);
    if (data.lines.some(each => each.parts.some(some => some.unstable))) pairs.push(["", of.unstable ? "unstable" : "stable"]);
    return pairs;
  }

  write(aloud) {
    const {data} = this.curve;
    const line = data.lines[this.at.line], pairs = this.pairs();
    const lines = pairs.map(([label, value]) => element("div", {}, label === "" ? value : label + ": " + value));
    const title = line.heading || line.label;
    this.values.replaceChildren(...(title === "" ? [] : [element("strong", {}, title)]), ...lines);
    const said = [title, ...pairs.map(([label, value]) => (label + " " + value).trim())];
    if (aloud) this.spoken.textContent = said.filter(text => text !== "").join(", ");
  }

  // After a zoom.
  refresh() {
    const {curve, at} = this;
    curve.cursor.selectAll("*").remove();
    if (at === null) return;
    if (!isShown(curve.data, at.line)) {
      this.show(null, false);
      return;
    }
    const of = curve.data.lines[at.line].parts[at.part].columns;
    const x = curve.x(of[curve.description.x][at.i]), y = curve.y(of[curve.description.y][at.i]);
    this.addRule(x, "", "");
    if (curve.columns.x.frequency) this.addMultiples(of[curve.description.x][at.i]);
    curve.cursor.append("circle").attr("cx", x).attr("cy", y).attr("r", 6);
    this.placeValues(x, y);
  }

  addRule(x, name, text) {
    const {cursor} = this.curve;
    cursor.append("line").attr("class", name).attr("x1", x).attr("x2", x).attr("y1", paper.top).attr("y2", paper.bottom);
    if (text !== "") cursor.append("text").attr("x", x + 3).attr("y", paper.top + 10).text(text);
  }

  addMultiples(frequency) {
    const [lower, upper] = this.curve.x.domain();
    for (let n = 2; n <= mostMultiple; ++n) {
      for (const [value, text] of [[n * frequency, "×" + n], [frequency / n, "÷" + n]]) {
        if (value >= lower && value <= upper) this.addRule(this.curve.x(value), "multiple", text);
      }
    }
  }

  placeValues(x, y) {
    const svg = this.curve.svg.node(), box = svg.getBoundingClientRect();
    const left = svg.parentElement.getBoundingClientRect();
    const scale = box.width / paper.width, style = this.values.style;
    const isRight = x > (paper.left + paper.right) / 2;
    const at = box.left - left.left + x * scale;
    style.left = isRight ? "" : at + 14 + "px";
    style.right = isRight ? left.width - at + 14 + "px" : "";
    style.top = box.top - left.top + Math.min(Math.max(y, paper.top), paper.bottom) * scale + 10 + "px";
  }

  // What a key does, if anything.
  keyAction(event) {
    const steps = {ArrowLeft: -1, ArrowRight: 1};
    const lines = {ArrowUp: -1, ArrowDown: 1};
    if (event.key in steps) return () => this.go(steps[event.key] * (event.shiftKey ? 10 : 1));
    if (event.key in lines) return () => this.goToLine(lines[event.key]);
    if (event.key === "Enter") return () => this.showMotion(this.curve.svg.node());
    return event.key === "Escape" ? () => this.show(null, false) : null;
  }

  go(step) {
    const {places} = this.curve;
    if (this.at === null) return this.goToLine(0);
    let {line, part, i} = this.at;
    i += step;
    while (i < 0 && part > 0) i += places[line][--part].x.length;
    while (i >= places[line][part].x.length && part + 1 < places[line].length) i -= places[line][part++].x.length;
    i = Math.min(Math.max(i, 0), places[line][part].x.length - 1);
    this.show({line, part, i}, true);
  }

  goToLine(step) {
    const {places, data} = this.curve;
    const shown = places.map((_, line) => line).filter(line => isShown(data, line) && places[line].length > 0);
    if (shown.length === 0) return;
    if (this.at === null) {
      this.show({line: shown[0], part: 0, i: Math.floor(places[shown[0]][0].x.length / 2)}, true);
      return;
    }
    const now = shown.indexOf(this.at.line);
    const line = shown[(now + step + shown.length) % shown.length];
    const part = Math.min(this.at.part, places[line].length - 1);
    this.show({line, part, i: Math.min(this.at.i, places[line][part].x.length - 1)}, true);
  }
}
