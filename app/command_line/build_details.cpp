#include "options.hpp"

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <link.h>

namespace arcslip::app {
namespace {

struct Library {
  std::string_view name, version, licence;
};

constexpr std::array libraries = {
    Library{"Eigen", ARCSLIP_EIGEN_VERSION, "MPL-2.0"},
    Library{"SuiteSparse (KLU)", ARCSLIP_SUITESPARSE_VERSION, "LGPL-2.1-or-later"},
    Library{"SuiteSparse (CHOLMOD)", ARCSLIP_SUITESPARSE_VERSION, "LGPL-2.1-or-later, GPL-2.0-or-later"},
    Library{"Spectra", ARCSLIP_SPECTRA_VERSION, "MPL-2.0"},
    Library{"NLopt", ARCSLIP_NLOPT_VERSION, "MIT, LGPL-2.1-or-later"},
    Library{"nlohmann/json", ARCSLIP_JSON_VERSION, "MIT"},
    Library{"Boost", ARCSLIP_BOOST_VERSION, "BSL-1.0"},
    Library{"SQLite", ARCSLIP_SQLITE_VERSION, "public domain"},
    Library{"CLI11", ARCSLIP_CLI11_VERSION, "BSD-3-Clause"},
    Library{"matio (of arcslip-mat)", ARCSLIP_MATIO_VERSION, "BSD-2-Clause"},
};

/// Keeps the file of a loaded library of linear algebra; OpenBLAS may stand behind a link to it.
int take_blas(dl_phdr_info* info, std::size_t /*size*/, void* to) {
  const std::string path = info->dlpi_name != nullptr ? info->dlpi_name : "";
  if (path.find("blas") == std::string::npos && path.find("libmkl") == std::string::npos) return 0;
  std::error_code error;
  const std::filesystem::path real = std::filesystem::canonical(path, error);
  auto& all = *static_cast<std::string*>(to);
  all += (all.empty() ? "" : ", ") + (error ? path : real.string());
  return 0;
}

}  // namespace

std::string build_details() {
  std::string text = std::string("commit: ") + ARCSLIP_COMMIT + "\ncompiler: " + ARCSLIP_COMPILER + "\n";
  std::string blas;
  ::dl_iterate_phdr(take_blas, &blas);
  text += "BLAS: " + (blas.empty() ? "linked into the program" : blas) + "\n";
  for (const Library& library : libraries)
    text += std::string(library.name) + " " +
            (library.version.empty() ? "none" : std::string(library.version)) + ", " +
            std::string(library.licence) + "\n";
  return text + "D3 in reports: " + (ARCSLIP_HAS_D3 ? "yes, BSD-3-Clause" : "none") +
         "\nArcslip's own licence is pending: none has been chosen yet.\n";
}

}  // namespace arcslip::app
