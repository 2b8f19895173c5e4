#include <arcslip/figures/labels.hpp>
#include <arcslip/figures/parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace arcslip::figures {
namespace {

using results::Figure;
using results::FigureCurve;
using results::FigureSymbol;

constexpr std::size_t most_labelled = 24;  // curves

/// The curves in shares of the axes, to keep texts off them.
std::vector<std::vector<Position>> paths_of(const Figure& figure) {
  std::vector<std::vector<Position>> paths;
  for (const FigureCurve& curve : figure.curves)
    for (const results::FigureStretch& stretch : curve.stretches) {
      std::vector<Position>& path = paths.emplace_back();
      for (std::size_t i = stretch.first; i < stretch.first + stretch.count; ++i)
        if (figure.x.shows(curve.x[i]) && figure.y.shows(curve.y[i]))
          path.push_back({figure.x.place(curve.x[i]), figure.y.place(curve.y[i])});
    }
  return paths;
}

class Writer {
 public:
  Writer(Figure& figure, const LabelMetrics& metrics) : figure_(figure), placer_(paths_of(figure), metrics) {
    for (const FigureSymbol& symbol : figure.symbols) placer_.keep_off(at(symbol.x, symbol.y));
  }

  /// Writes a text next to a place, if there is room. Returns whether there is.
  bool write(const std::string& text, const std::string& colour, double x, double y) {
    const LabelSide side = placer_.place(at(x, y), text);
    if (side == LabelSide::none) return false;
    const LabelOffset shift = offset(side);
    figure_.texts.push_back({text, colour, x, y, shift.x, shift.y, shift.alignment});
    return true;
  }

 private:
  Position at(double x, double y) const { return {figure_.x.place(x), figure_.y.place(y)}; }

  Figure& figure_;
  LabelPlacer placer_;
};

/// What a mark says of itself, or the name of its curve.
std::string text_of(const FigureSymbol& symbol, const std::string& of_curve) {
  if (symbol.count > 1) return std::to_string(symbol.count) + " × " + std::string(symbol.kind.words);
  if (!symbol.text.empty()) return symbol.text;
  if (!symbol.kind.mark.label.empty()) return std::string(symbol.kind.mark.label);
  return symbol.kind.mark.labelled ? of_curve : std::string();
}

const FigureCurve* curve_of(const Figure& figure, std::size_t line) {
  const auto found = std::find_if(figure.curves.begin(), figure.curves.end(),
                                  [&](const FigureCurve& curve) { return curve.line == line; });
  return found == figure.curves.end() ? nullptr : &*found;
}

}  // namespace

void add_texts(const results::FigureStyle& style, Figure& figure) {
  constexpr double usual_width = 800, usual_height = 500;
  const LabelMetrics usual;
  Writer writer(figure, {usual.character_width * usual_width / style.width,
                         usual.line_height * usual_height / style.height});
  std::set<std::pair<std::size_t, std::string>> written;  // a text stands once at a curve
  std::vector<const FigureSymbol*> highest_first;
  for (const FigureSymbol& symbol : figure.symbols) highest_first.push_back(&symbol);
  std::stable_sort(highest_first.begin(), highest_first.end(),
                   [](const FigureSymbol* a, const FigureSymbol* b) { return a->y > b->y; });
  for (const FigureSymbol* symbol : highest_first) {
    const FigureCurve* curve = curve_of(figure, symbol->line);
    const std::string text = text_of(*symbol, curve == nullptr ? "" : curve->name);
    if (text.empty() || written.contains({symbol->line, text})) continue;
    if (writer.write(text, symbol->colour, symbol->x, symbol->y)) written.insert({symbol->line, text});
  }
  if (figure.curves.size() > most_labelled) return;
  for (const FigureCurve& curve : figure.curves) {
    if (curve.name.empty() || curve.x.empty() || written.contains({curve.line, curve.name})) continue;
    constexpr std::array shares = {0.5, 0.65, 0.35, 0.8, 0.2, 0.95, 0.05};
    for (const double share : shares) {
      const auto i = static_cast<std::size_t>(share * static_cast<double>(curve.x.size() - 1));
      if (!figure.x.shows(curve.x[i]) || !figure.y.shows(curve.y[i])) continue;
      if (writer.write(curve.name, curve.colour, curve.x[i], curve.y[i])) break;
    }
  }
}

}  // namespace arcslip::figures
