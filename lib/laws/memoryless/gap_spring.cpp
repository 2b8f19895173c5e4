#include <arcslip/laws/memoryless/gap_spring.hpp>

#include <arcslip/laws/memoryless/piecewise_linear.hpp>
#include <arcslip/scene/keys/study_keys.hpp>

#include <utility>

namespace arcslip::elements {
namespace {

constexpr scene::Field gap_spring_fields[] = {
    {.name = "stiffness",
     .unit = "N/m",
     .lower = 0,
     .upper = infinity,
     .lower_open = true,
     .help = "stiffness in contact"},
    {.name = "gap",
     .unit = "m",
     .lower = -infinity,
     .upper = infinity,
     .help = "displacement at the onset of contact; force = stiffness * (displacement - gap) beyond it. "
             "Negative: a compression at rest, whose force the structure balances there"},
};

scene::file::KeysOf<GapSpringOptions> gap_options() {
  scene::file::KeysOf<GapSpringOptions> keys;
  keys.add(scene::file::flag("two_sided", &GapSpringOptions::two_sided, "whether there is one on each side"));
  return keys;
}

class GapSpring final : public scene::file::KeyedPart<GapSpringOptions, LawType> {
 public:
  GapSpring() : KeyedPart(gap_options()) {}
  std::string_view name() const override { return "gap_spring"; }
  std::string_view help() const override {
    return "a spring behind a gap or with a preload, one- or two-sided";
  }
  std::span<const scene::Field> fields(const scene::Settings&) const override { return gap_spring_fields; }
  bool options_bring_fields() const override { return false; }
  std::shared_ptr<const Law> law(const scene::Settings& options) const override {
    return !options.empty() && options.as<GapSpringOptions>().two_sided ? two_sided_ : one_sided_;
  }

 private:
  using Shape = PiecewiseLinearShape;
  const std::shared_ptr<const Law> one_sided_ =
      std::make_shared<const PiecewiseLinearLaw>(Shape{{1}, {{{0, 0}, {1, -1}}}, {"open", "closed"}, true},
                                                 Shape{{-1}, {{{0, -1}, {1, 0}}}, {"open", "closed"}, true});
  const std::shared_ptr<const Law> two_sided_ = std::make_shared<const PiecewiseLinearLaw>(
      Shape{{-1, 1}, {{{1, 1}, {0, 0}, {1, -1}}}, {"closed-", "open", "closed+"}, true},
      Shape{{-1, 1}, {{{1, -1}, {2, 0}, {1, 1}}}, {"closed-", "closed", "closed+"}, true});
};

}  // namespace

const LawType& gap_spring() {
  static const GapSpring law;
  return law;
}

}  // namespace arcslip::elements
