#include <arcslip/control.hpp>

using namespace arcslip::control;

int main() {
  AbandonedThreads abandoned;
  const Control control{{.abandoned = &abandoned}};
  return interruptible([](const Control& given) { return given.keep_going() ? 0 : 1; }, control, "");
}
