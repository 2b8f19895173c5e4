#include <arcslip/report/parts.hpp>

namespace arcslip::report {

Outline outline(results::Shape shape) {
  constexpr std::string_view square = "M-4 -4H4V4H-4Z",
                             circle = "M-4.5 0A4.5 4.5 0 1 1 4.5 0A4.5 4.5 0 1 1 -4.5 0Z",
                             up = "M0 -5.5L5 4H-5Z", down = "M0 5.5L5 -4H-5Z",
                             diamond = "M0 -6L5 0L0 6L-5 0Z",
                             pentagon = "M0 -5.5L5.2 -1.7L3.2 4.5H-3.2L-5.2 -1.7Z";
  using results::Shape;
  switch (shape) {
    case Shape::none:
      break;
    case Shape::plus:
      return {"M-5 0H5M0 -5V5"};
    case Shape::cross:
      return {"M-4 -4L4 4M-4 4L4 -4"};
    case Shape::star:
      return {"M-5 0H5M0 -5V5M-4 -4L4 4M-4 4L4 -4"};
    case Shape::square:
      return {square};
    case Shape::filled_square:
      return {square, true};
    case Shape::circle:
      return {circle};
    case Shape::filled_circle:
      return {circle, true};
    case Shape::triangle:
      return {up};
    case Shape::filled_triangle:
      return {up, true};
    case Shape::inverted_triangle:
      return {down};
    case Shape::filled_inverted_triangle:
      return {down, true};
    case Shape::diamond:
      return {diamond};
    case Shape::filled_diamond:
      return {diamond, true};
    case Shape::pentagon:
      return {pentagon};
    case Shape::filled_pentagon:
      return {pentagon, true};
  }
  return {};
}

}  // namespace arcslip::report
