// A figure that zooms, pans and shows values: one column over another, or areas.

const steps = 0.001;  // of a pixel, to which outlines are rounded, so that they stay smooth when zoomed

function rounded(value) {
  return Math.round(value / steps) * steps;
}

// The points of the lines in pixels without zoom, as they are drawn and searched.
function placesOf(data, description, x, y) {
  return data.lines.map(line => line.parts.map(part => {
    const xs = part.columns[description.x], ys = part.columns[description.y];
    const at = {x: new Float64Array(xs.length), y: new Float64Array(xs.length), unstable: part.unstable, part};
    for (let i = 0; i < xs.length; ++i) {
      at.x[i] = xs[i] === null ? NaN : x(xs[i]);
      at.y[i] = ys[i] === null ? NaN : y(ys[i]);
      if (!Number.isFinite(at.x[i]) || !Number.isFinite(at.y[i])) at.x[i] = at.y[i] = NaN;
    }
    return at;
  }));
}

function outlineOf(places) {
  const text = [];
  let isDown = false;
  for (let i = 0; i < places.x.length; ++i) {
    const isThere = !Number.isNaN(places.x[i]);
    if (isThere) text.push((isDown ? "L" : "M") + rounded(places.x[i]).toFixed(3) + " " + rounded(places.y[i]).toFixed(3));
    isDown = isThere;
  }
  return text.join("");
}

function addAxes(svg, description) {
  const axis = svg.append("g").attr("class", "axis");
  const made = {
    gridX: axis.append("g").attr("class", "grid").attr("transform", `translate(0,${paper.bottom})`),
    gridY: axis.append("g").attr("class", "grid").attr("transform", `translate(${paper.left},0)`),
    x: axis.append("g").attr("transform", `translate(0,${paper.bottom})`),
    y: axis.append("g").attr("transform", `translate(${paper.left},0)`),
  };
  axis.append("text").attr("class", "title").attr("text-anchor", "middle").text(description.xLabel)
    .attr("x", (paper.left + paper.right) / 2).attr("y", paper.height - 8);
  axis.append("text").attr("class", "title").attr("text-anchor", "middle").text(description.yLabel)
    .attr("transform", `translate(16 ${(paper.top + paper.bottom) / 2}) rotate(-90)`);
  return made;
}

function drawAxes(axes, x, y, columns) {
  const isLogarithmic = column => column.scale === "logarithmic";
  const along = inUnit(x, columns.x), upwards = inUnit(y, columns.y);
  const horizontal = () => setTicks(d3.axisBottom(along), along, isLogarithmic(columns.x), 7);
  const vertical = () => setTicks(d3.axisLeft(upwards), upwards, isLogarithmic(columns.y), 6);
  axes.x.call(horizontal().tickSizeOuter(0));
  axes.y.call(vertical().tickSizeOuter(0));
  axes.gridX.call(horizontal().tickSize(paper.top - paper.bottom).tickFormat(""));
  axes.gridY.call(vertical().tickSize(paper.left - paper.right).tickFormat(""));
  for (const grid of [axes.gridX, axes.gridY]) grid.select(".domain").remove();
}

function addAreas(group, description, x, y) {
  const shape = d3.area().x(i => i[0]).y0(i => i[1]).y1(i => i[2]);
  for (const area of description.areas) {
    const text = area.strips.map(([at, lower, upper]) =>
      shape(at.map((value, i) => [x(value), y(lower[i]), y(upper[i])]))).join("");
    group.append("path").attr("class", area.class).attr("d", text)
      .append("title").text(area.kind);
  }
}

function addBands(group, data, x) {
  data.lines.forEach((line, i) => line.bands.forEach(band => {
    group.append("rect").datum(i).attr("class", "band " + lineClass(i, data.lines.length))
      .attr("x", x(band.lower)).attr("width", x(band.upper) - x(band.lower))
      .attr("y", paper.top).attr("height", paper.bottom - paper.top).append("title").text(band.label);
  }));
}

// Buttons above the drawing.
function addTools(figure, actions) {
  const tools = element("div", {class: "tools"});
  for (const [text, title, action] of actions) {
    const button = element("button", {type: "button", title, "aria-label": title}, text);
    button.addEventListener("click", action);
    tools.append(button);
  }
  figure.prepend(tools);
}

class Curve {
  constructor(figure, data, description, study, number) {
    Object.assign(this, {figure, data, description, study});
    this.columns = {x: data.columns[description.x], y: data.columns[description.y]};
    if (description.turn) this.columns.y = {label: description.yLabel, scale: "linear", lower: 0, upper: 360};
    const hasAreas = description.areas.length > 0;
    this.x0 = this.x = scaleOf(this.columns.x, hasAreas || description.x === 0, [paper.left, paper.right]);
    this.y0 = this.y = scaleOf(this.columns.y, hasAreas, [paper.bottom, paper.top]);
    this.places = hasAreas ? [] : placesOf(data, description, this.x0, this.y0);
    this.transform = d3.zoomIdentity;
    this.build(number);
    this.refreshKey = hasAreas ? () => {} : bringToLife(figure.querySelector(".key"), data);
    this.pointer = hasAreas ? null : new Pointer(this);
    this.addZoom();
    this.refresh();
  }

  build(number) {
    const {figure, data, description} = this;
    figure.querySelector("svg.plain").remove();
    const svg = d3.select(figure).insert("svg", ".key").attr("class", "live")
      .attr("viewBox", `0 0 ${paper.width} ${paper.height}`).attr("tabindex", 0).attr("role", "application")
      .attr("aria-label", description.caption +
        ". Arrow keys go along a curve and from curve to curve, Enter shows the motion there, plus and minus zoom, 0 shows all.");
    svg.append("clipPath").attr("id", "clip" + number).append("rect").attr("x", paper.left).attr("y", paper.top)
      .attr("width", paper.right - paper.left).attr("height", paper.bottom - paper.top);
    this.svg = svg;
    this.axes = addAxes(svg, description);
    const clipped = svg.append("g").attr("clip-path", `url(#clip${number})`);
    this.moved = clipped.append("g").attr("class", "figure-lines");
    if (description.areas.length > 0) {
      addAreas(this.moved, description, this.x0, this.y0);
      return;
    }
    if (description.x === 0) addBands(this.moved, data, this.x0);
    this.outlines = data.lines.map((_, i) => this.places[i].map(part =>
      this.moved.append("path").datum(i).attr("d", outlineOf(part))
        .attr("class", "line " + lineClass(i, data.lines.length) + (data.lines[i].main ? " main" : "") + (part.unstable ? " unstable" : "")).node()));
    this.front = clipped.append("g").attr("class", "figure-front");
    this.addMarks(clipped.append("g"));
    this.chosen = clipped.append("g").attr("class", "chosen");
    this.cursor = clipped.append("g").attr("class", "cursor");
  }

  addMarks(group) {
    const {data, description, study} = this;
    const marks = data.lines.flatMap((line, i) => line.marks.map(mark => ({line: i, mark})))
      .filter(({mark}) => [description.x, description.y].every(c => mark.values[c] !== null) &&
        data.kinds[mark.kind].path !== "");
    this.marks = group.selectAll("path").data(marks).enter().append("path")
      .attr("class", ({line, mark}) => "mark " + lineClass(line, data.lines.length) +
        (data.kinds[mark.kind].filled ? " filled" : ""))
      .attr("d", ({mark}) => data.kinds[mark.kind].path);
    this.marks.append("title").text(({mark}) => data.kinds[mark.kind].words);
    this.marks.each(function ({mark}) {
      this.addEventListener("click", () => markRow(study, mark.row, true));
    });
  }

  addZoom() {
    const {svg} = this;
    const corners = [[paper.left, paper.top], [paper.right, paper.bottom]];
    this.zoom = d3.zoom().scaleExtent([1, 500]).extent(corners).translateExtent(corners)
      // The wheel scrolls the page, unless the figure has the focus or the key Ctrl is held.
      .filter(given => {
        const event = d3.event || given;
        return event.type === "wheel" ? event.ctrlKey || document.activeElement === svg.node() : !event.button;
      })
      .on("zoom", given => {
        this.transform = (d3.event || given).transform;
        this.refresh();
      });
    svg.call(this.zoom);
    const by = factor => () => svg.call(this.zoom.scaleBy, factor);
    const all = () => svg.call(this.zoom.transform, d3.zoomIdentity);
    addTools(this.figure, [["+", "zoom in", by(2)], ["−", "zoom out", by(0.5)], ["all", "show all", all]]);
    svg.node().addEventListener("keydown", event => {
      const actions = {"+": by(1.5), "=": by(1.5), "-": by(1 / 1.5), "0": all};
      const action = actions[event.key] || (this.pointer && this.pointer.keyAction(event));
      if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      action();
    });
  }

  // After a zoom, or when other lines are shown.
  refresh() {
    const {transform, data, description} = this;
    this.x = transform.rescaleX(this.x0);
    this.y = transform.rescaleY(this.y0);
    drawAxes(this.axes, this.x, this.y, this.columns);
    this.moved.attr("transform", `translate(${transform.x},${transform.y}) scale(${transform.k})`);
    if (description.areas.length > 0) return;
    this.front.attr("transform", this.moved.attr("transform"));
    const isThere = line => isShown(data, line);
    this.moved.selectAll("path,rect").attr("display", line => (isThere(line) ? null : "none"));
    this.marks.attr("display", ({line}) => (isThere(line) ? null : "none"))
      .attr("transform", ({mark}) =>
        `translate(${this.x(mark.values[description.x])},${this.y(mark.values[description.y])})`);
    this.refreshKey();
    markMotion(this);
    this.pointer.refresh();
  }

  markRow(row) {
    if (this.marks) this.marks.classed("on", ({mark}) => row >= 0 && mark.row === row);
  }
}

function drawCurve(figure, data, description, study, number) {
  return new Curve(figure, data, description, study, number);
}
