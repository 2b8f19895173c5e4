#include <arcslip/laws/memoryless/bilinear_spring.hpp>

#include <arcslip/laws/memoryless/piecewise_linear.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

namespace arcslip::elements {
namespace {

constexpr scene::Field bilinear_spring_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = -infinity,
     .upper = infinity,
     .help = "force = stiffness * displacement up to the corner"},
    {.name = "stiffness_beyond",
     .unit = "N/m",
     .lower = -infinity,
     .upper = infinity,
     .help = "slope of the force beyond the corner"},
    {.name = "corner", .unit = "m", .lower = 0, .upper = infinity, .help = "displacement at the corner"},
};

scene::file::KeysOf<BilinearSpringOptions> bilinear_options() {
  scene::file::KeysOf<BilinearSpringOptions> keys;
  keys.add(scene::file::flag("one_sided", &BilinearSpringOptions::one_sided,
                             "a corner at positive displacements only; else one on each side"));
  return keys;
}

class BilinearSpring final : public scene::file::KeyedPart<BilinearSpringOptions, LawType> {
 public:
  BilinearSpring() : KeyedPart(bilinear_options()) {}
  std::string_view name() const override { return "bilinear_spring"; }
  std::string_view help() const override { return "a spring with another stiffness beyond a displacement"; }
  std::span<const scene::Field> fields(const scene::Settings&) const override {
    return bilinear_spring_fields;
  }
  bool options_bring_fields() const override { return false; }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    return !options.empty() && options.as<BilinearSpringOptions>().one_sided ? one_sided_ : two_sided_;
  }

 private:
  // The terms of the stiffness and of that beyond. No shape of negative corners is ever used.
  static std::shared_ptr<const Law> of(const PiecewiseLinearShape& shape) {
    return std::make_shared<const PiecewiseLinearLaw>(shape, shape);
  }
  const std::shared_ptr<const Law> one_sided_ =
      of({{1}, {{{1, 0}, {0, 1}}, {{0, 0}, {1, -1}}}, {"within", "beyond"}});
  const std::shared_ptr<const Law> two_sided_ =
      of({{-1, 1}, {{{0, -1}, {1, 0}, {0, 1}}, {{1, 1}, {0, 0}, {1, -1}}}, {"beyond-", "within", "beyond+"}});
};

}  // namespace

const LawType& bilinear_spring() {
  static const BilinearSpring law;
  return law;
}

}  // namespace arcslip::elements
