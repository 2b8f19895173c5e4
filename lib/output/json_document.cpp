#include <arcslip/output/json_document.hpp>

#include <arcslip/output/json_text.hpp>
#include <arcslip/output/version.hpp>

#include <ostream>

namespace arcslip::output {

void write_document(std::ostream& out, const scene::Scene& scene, std::span<const JsonSection> sections) {
  using detail::text;
  const std::string format = sections.size() == 1 ? sections.front().format : "arcslip-results-1";
  out << "{\"format\": " << text(format) << ",\n\"program\": \"arcslip " << version()
      << "\",\n\"scene_hash\": " << text(scene::hash(scene)) << ",\n\"title\": " << text(scene.title)
      << ",\n\"frequency_unit\": " << text(scene::unit_name(scene.frequency_unit));
  for (const JsonSection& section : sections) {
    out << ",\n" << text(section.key) << ": ";
    section.write(out);
  }
  out << "}\n";
}

}  // namespace arcslip::output
