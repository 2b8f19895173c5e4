// The motion and the hysteresis loops at a point of a curve that is chosen by a click or by Enter.

const panel = {width: 330, height: 210, left: 58, right: 322, top: 10, bottom: 170};
const packedDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
const packedBase = 64, packedSteps = packedBase * packedBase - 1;

// The numbers that packed() of the program has written.
function unpacked(series) {
  const codes = [...series.of].map(digit => packedDigits.indexOf(digit)), values = [];
  for (let i = 0; i + 1 < codes.length; i += 2) {
    values.push(((codes[i] * packedBase + codes[i + 1]) / packedSteps * 2 - 1) * series.most);
  }
  return values;
}

// A prefix for numbers of this size: [prefix, factor].
function prefixOf(size) {
  const prefixes = [["n", 1e9], ["µ", 1e6], ["m", 1e3], ["", 1], ["k", 1e-3], ["M", 1e-6]];
  return prefixes.find(([, factor]) => size * factor < 100 && size * factor >= 0.1) || ["", 1];
}

// Draws y over x, each with a name, a unit and values in SI.
function drawPanel(x, y, name) {
  const svg = d3.create("svg").attr("class", "motion").attr("viewBox", `0 0 ${panel.width} ${panel.height}`)
    .attr("role", "img").attr("aria-label", name);
  const scales = [[x, [panel.left, panel.right]], [y, [panel.bottom, panel.top]]].map(([of, range]) => {
    const [prefix, factor] = prefixOf(d3.max(of.values, Math.abs));
    of.title = `${of.name} (${prefix}${of.unit})`;
    of.shown = of.values.map(value => value * factor);
    const [lower, upper] = d3.extent(of.shown), room = 0.06 * (upper - lower) || 1;
    return d3.scaleLinear().domain(of.isTime ? [lower, upper] : [lower - room, upper + room]).range(range);
  });
  const axis = svg.append("g").attr("class", "axis");
  axis.append("g").attr("transform", `translate(0,${panel.bottom})`).call(d3.axisBottom(scales[0]).ticks(5));
  axis.append("g").attr("transform", `translate(${panel.left},0)`).call(d3.axisLeft(scales[1]).ticks(5));
  axis.append("text").attr("class", "title").attr("text-anchor", "middle").text(x.title)
    .attr("x", (panel.left + panel.right) / 2).attr("y", panel.height - 6);
  axis.append("text").attr("class", "title").attr("text-anchor", "middle").text(y.title)
    .attr("transform", `translate(13 ${(panel.top + panel.bottom) / 2}) rotate(-90)`);
  const line = d3.line().x((_, i) => scales[0](x.shown[i])).y((_, i) => scales[1](y.shown[i]));
  svg.append("path").attr("class", "line c0").attr("d", line(x.shown));
  return element("figure", {class: "motion"}, element("figcaption", {}, name), svg.node());
}

function panelsOf(motion) {
  const displacement = unpacked(motion.x);
  const times = displacement.map((_, i) => motion.period * i / (displacement.length - 1));
  const panels = [drawPanel({name: "time", unit: "s", values: times, isTime: true},
                            {name: "displacement", unit: "m", values: displacement}, "motion over a period")];
  for (const loop of motion.loops) {
    panels.push(drawPanel({name: "displacement", unit: "m", values: unpacked(loop.q || motion.x)},
                          {name: "force", unit: "N", values: unpacked(loop.f)}, loop.name));
  }
  return panels;
}

// The motion of the line that is nearest to a point of the drawing; null: it has none.
function nearestMotion(curve, at) {
  const {data, description} = curve, line = data.lines[at.line];
  const of = line.parts[at.part].columns;
  const place = values => [curve.x(values[description.x]), curve.y(values[description.y])];
  const here = place(of.map(column => column[at.i]));
  const distance = motion => Math.hypot(...place(motion.at).map((value, k) => value - here[k]));
  return line.motions.reduce((best, motion) =>
    (best === null || distance(motion) < distance(best) ? motion : best), null);
}

// Shows the motion next to a point of a curve below its figure.
function showMotion(curve, at) {
  const {data, description, figure} = curve, motion = nearestMotion(curve, at);
  const old = figure.querySelector(".motions");
  if (old !== null) old.remove();
  curve.motion = motion;
  markMotion(curve);
  if (motion === null) return;
  const shown = c => `${data.columns[c].label} ${shortNumber(motion.at[c] * (data.columns[c].factor || 1))}`;
  const title = [data.lines[at.line].heading, motion.words, shown(description.x), shown(description.y)]
    .filter(text => text !== "").join(", ");
  const close = element("button", {type: "button", title: "hide the motion", "aria-label": "hide the motion"}, "×");
  const box = element("section", {class: "motions", "aria-label": "motion at a point"},
                      element("h3", {}, title, " ", close), ...panelsOf(motion));
  close.addEventListener("click", () => {
    box.remove();
    curve.motion = null;
    markMotion(curve);
  });
  figure.append(box);
}

// The place of the motion that is shown, after a zoom, too.
function markMotion(curve) {
  curve.chosen.selectAll("*").remove();
  if (!curve.motion) return;
  const {description, motion} = curve;
  curve.chosen.append("circle").attr("r", 8).attr("cx", curve.x(motion.at[description.x]))
    .attr("cy", curve.y(motion.at[description.y]));
}
