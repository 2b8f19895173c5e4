#pragma once

namespace arcslip::optimize {

/// Thrown where work that is under way is to end at once: what it was about is not known. An objective or a
/// constraint that throws it ends its run with reason `user`.
struct Interrupted {};

}  // namespace arcslip::optimize
