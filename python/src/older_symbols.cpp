// Functions of which glibc 2.35 and libstdc++ 12 have a new version, which older systems lack. The new ones differ
// in how they report errors and pass on the end of a thread, and not in what they do. A program that is linked
// with --wrap=NAME calls the version that all have.

extern "C" {

double hypot_of_all(double x, double y);
__asm__(".symver hypot_of_all, hypot@GLIBC_2.2.5");
double __wrap_hypot(double x, double y);  // the linker's name
double __wrap_hypot(double x, double y) {
  return hypot_of_all(x, y);
}

// std::condition_variable::wait(std::unique_lock<std::mutex>&)
void wait_of_all(void* condition, void* lock);
__asm__(".symver wait_of_all, _ZNSt18condition_variable4waitERSt11unique_lockISt5mutexE@GLIBCXX_3.4.11");
void __wrap__ZNSt18condition_variable4waitERSt11unique_lockISt5mutexE(void* condition, void* lock);
void __wrap__ZNSt18condition_variable4waitERSt11unique_lockISt5mutexE(void* condition, void* lock) {
  wait_of_all(condition, lock);
}
}
