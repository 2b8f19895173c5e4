#include <arcslip/optimize/nlopt/minimize.hpp>

int main() {
  return arcslip::optimize::algorithms().empty() ? 1 : 0;
}
