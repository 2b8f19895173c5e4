#pragma once
// What ends a computation, what it reports, and what becomes of computations that cannot be interrupted.

#include <arcslip/control/interruptible.hpp>
#include <arcslip/control/run_control.hpp>
