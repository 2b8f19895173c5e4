// Scales of the columns, and their ticks.

const paper = {width: 760, height: 400, left: 78, right: 744, top: 14, bottom: 352};

function paddedRange(column, fills) {
  const lower = column.lower, upper = column.upper;
  if (column.scale === "percent") return [-2, 102];
  if (lower === null || upper === null || !(lower <= upper)) return [0, 1];
  if (column.scale === "logarithmic") {
    const spread = fills ? 1 : Math.pow(upper / lower, 0.05);
    const least = lower < upper ? spread : 10;
    return [lower / least, upper * least];
  }
  const width = upper - lower;
  if (width <= 1e-12 * Math.max(Math.abs(lower), Math.abs(upper))) {
    const half = lower === 0 ? 1 : Math.abs(lower) / 10;
    return [lower - half, upper + half];
  }
  return fills ? [lower, upper] : [lower - 0.05 * width, upper + 0.05 * width];
}

function scaleOf(column, fills, range) {
  const scale = column.scale === "logarithmic" ? d3.scaleLog() : d3.scaleLinear();
  return scale.domain(paddedRange(column, fills)).range(range);
}

// The scale in the unit of the axis, which has a prefix.
function inUnit(scale, column) {
  const factor = column.factor || 1;
  return scale.copy().domain(scale.domain().map(value => value * factor));
}

const superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function powerOfTen(exponent) {
  const digits = [...String(Math.abs(exponent))].map(digit => superscripts[Number(digit)]).join("");
  return "10" + (exponent < 0 ? "⁻" : "") + digits;
}

// Decades where there are several, else round numbers.
function setTicks(axis, scale, isLogarithmic, count) {
  const [lower, upper] = scale.domain();
  if (!isLogarithmic) {
    const usual = scale.tickFormat(count);
    return axis.ticks(count).tickFormat(value => (usual(value).length > 6 ? shortNumber(value) : usual(value)));
  }
  if (upper < 10 * lower) {
    return axis.tickValues(d3.ticks(lower, upper, count)).tickFormat(shortNumber);
  }
  const exponents = d3.range(Math.floor(Math.log10(lower) + 1e-9), Math.floor(Math.log10(upper) + 1e-9) + 1);
  const every = Math.ceil(exponents.length / 10);
  const factors = upper < 1000 * lower ? [1, 2, 5] : [1];
  const values = [];
  for (const exponent of exponents.filter((_, i) => i % every === 0)) {
    for (const factor of factors) values.push(factor * Math.pow(10, exponent));
  }
  const isPlain = lower > 0.9e-3 && upper < 1.1e5;
  const format = value => {
    if (isPlain) return shortNumber(value);
    const exponent = Math.floor(Math.log10(value) + 1e-9), factor = Math.round(value / Math.pow(10, exponent));
    return (factor === 1 ? "" : factor + "·") + powerOfTen(exponent);
  };
  return axis.tickValues(values.filter(value => value >= lower && value <= upper)).tickFormat(format);
}
