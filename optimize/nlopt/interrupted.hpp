#pragma once

namespace arcslip::optimize {

/// Thrown to abort a computation at once, without a result. An objective or a constraint that throws it ends
/// its run with reason `user`.
struct Interrupted {};

}  // namespace arcslip::optimize
