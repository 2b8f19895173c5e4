#pragma once

#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/stop_request.hpp>

#include <string>

namespace arcslip::scene {

/// read_file() of a file or a pipe that may take its time. Throws Interrupted where `stop` is asked for
/// meanwhile.
Scene read_file(const std::string& path, const StopRequest& stop);

}  // namespace arcslip::scene
