// glibc 2.35 gave hypot() a new version, which older systems lack, for errors alone: its values are the same. A
// program that is linked with --wrap=hypot calls the version that all have.

extern "C" {
double hypot_of_all(double x, double y);
__asm__(".symver hypot_of_all, hypot@GLIBC_2.2.5");

double __wrap_hypot(double x, double y);  // the linker's name
double __wrap_hypot(double x, double y) {
  return hypot_of_all(x, y);
}
}
