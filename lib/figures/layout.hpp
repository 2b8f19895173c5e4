#pragma once
// From the data of curves to figures.

#include <arcslip/results/figure.hpp>
#include <arcslip/results/figure_data.hpp>
#include <arcslip/results/text.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::figures {

/// The most curves that a figure draws one by one.
inline constexpr std::size_t most_curves = 200;

/// Returns a figure of the data. More than most_curves are drawn as their median and bands that hold a half
/// and nine tenths of them, over x; where x is no axis that they share, some of them are drawn. The note
/// of the figure says so.
results::Figure figure_of(const results::FigureData& data, const results::FigureView& view,
                          const results::FigureStyle& style = {});

/// All figures of the data.
std::vector<results::Figure> figures_of(const results::FigureData& data,
                                        const results::FigureStyle& style = {});

/// The kinds of marks of the data: those of the table of kinds in its order, then others as the lines have
/// them.
std::vector<results::EventKind> mark_kinds(const results::FigureData& data);

/// The unit with a prefix that suits the numbers of a column.
results::PrefixedUnit unit_of(const results::FigureColumn& column);

}  // namespace arcslip::figures
