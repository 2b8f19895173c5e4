// A bar of n elements in series, of length 1 and stiffness 1, pulled at its end by the force P. Its middle
// element is damaged beyond the strain 1: with the largest strain k that it has had, it carries
//
//   s(k) = (3 - k) / 2   at the strain k, and s(k) / k times its strain below it, for good.
//
// The force falls as soon as the damage begins, at P = 1, and all other elements unload: the end moves back,
// from 1 to 3 / n at P = 0. With the strain w of the weak element the branch is
//
//   P = w, u_end = w                                    up to w = 1
//   P = (3 - w) / 2,  u_end = w / n + (1 - 1 / n) P     beyond
//
// The largest strain is the state of this problem: it changes when a point is accepted, and by nothing else.

#include <arcslip/continuation.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

using namespace arcslip::continuation;

namespace {

constexpr int n = 20, weak = n / 2;
constexpr double h = 1.0 / n;

double strength(double largest) {
  return (3 - largest) / 2;
}

double strain(In u, int element) {
  return (u[element] - (element > 0 ? u[element - 1] : 0)) / h;
}

std::shared_ptr<const Problem> softening_bar() {
  StateFunctions bar;
  bar.initial = Vector::Ones(1);  // the largest strain, which damages beyond 1
  bar.functions = [](AcceptedState largest) {
    Functions f;
    f.size = n;
    f.parameters = {{"P", ""}};
    f.choosing.residual = [=](In u, In p, Choices& choose, Out F) {
      for (int e = 0; e < n; ++e) F[e] = strain(u, e);
      const double k = choose.max(F[weak], largest[0]);
      F[weak] *= strength(k) / k;
      for (int e = 0; e + 1 < n; ++e) F[e] -= F[e + 1];
      F[n - 1] -= p[0];
    };
    return f;
  };
  bar.next = [](In u, In, In largest, Out next) { next[0] = std::max(strain(u, weak), largest[0]); };
  return from_functions(std::move(bar));
}

}  // namespace

int main() {
  const auto bar = softening_bar();

  const Monitor damaged{.name = "damaged",
                        .value = [](const Accepted& now) { return strain(now.u, weak) - 2; },
                        .terminal = true};
  const Start rest{.u = Vector::Zero(n), .p = Vector{{0.0}}};
  const Branch pulled = trace(bar, rest, {.lower = 0, .upper = 2}, {fold_monitor(), damaged});
  double off = 0;
  for (const Point& point : pulled.points) {
    const double w = strain(point.u, weak), P = w > 1 ? strength(w) : w;
    off = std::max({off, std::abs(point.parameter - P), std::abs(point.u[n - 1] - (w * h + (1 - h) * P))});
  }
  for (const Event& event : pulled.events)
    std::printf("%s at P = %.10f, end = %.10f\n", event.monitor.c_str(), event.point.parameter,
                event.point.u[n - 1]);
  std::printf("pulled off = %.1e, largest = %.10f\n", off, pulled.state[0]);

  // Let go, it unloads along the damaged stiffness; pulled again, it softens on from where it was.
  const Point& end = pulled.points.back();
  const Start released{
      .u = 0.99 * end.u, .p = Vector{{0.99 * end.parameter}}, .direction = -1, .state = pulled.state};
  const Branch back = trace(bar, released, {.lower = 0, .upper = 2});
  const Start again{.u = back.points.back().u, .p = Vector{{0.0}}, .state = back.state};
  const Branch broken = trace(bar, again, {.lower = 0, .upper = 2}, {fold_monitor()});
  std::printf("back at P = %.10f, end = %.10f, largest = %.10f\n", back.points.back().parameter,
              back.points.back().u[n - 1], back.state[0]);
  for (const Event& event : broken.events)
    std::printf("again %s at P = %.10f, end = %.10f\n", event.monitor.c_str(), event.point.parameter,
                event.point.u[n - 1]);
  std::printf("broken at P = %.10f, end = %.10f, largest = %.10f\n", broken.points.back().parameter,
              broken.points.back().u[n - 1], broken.state[0]);
  std::printf("%s; %s; %s\n", pulled.stop.message.c_str(), back.stop.message.c_str(),
              broken.stop.message.c_str());
}
