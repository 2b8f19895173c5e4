#pragma once
// Branches of F(u, p) = 0: everything a program needs to trace them.

#include <arcslip/continuation/diagrams/agenda.hpp>
#include <arcslip/continuation/diagrams/deflation.hpp>
#include <arcslip/continuation/diagrams/diagram.hpp>
#include <arcslip/continuation/diagrams/widening.hpp>
#include <arcslip/continuation/events/hopf.hpp>
#include <arcslip/continuation/events/monitor.hpp>
#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/branch.hpp>
#include <arcslip/continuation/problem/choices.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/continuation/problem/linear_solver.hpp>
#include <arcslip/continuation/problem/options.hpp>
#include <arcslip/continuation/problem/problem.hpp>
#include <arcslip/continuation/problem/problem_from_functions.hpp>
#include <arcslip/continuation/special_points/branch_point.hpp>
#include <arcslip/continuation/special_points/branch_point_curve.hpp>
#include <arcslip/continuation/special_points/conserved_sums.hpp>
#include <arcslip/continuation/special_points/constraints.hpp>
#include <arcslip/continuation/special_points/hopf_curve.hpp>
#include <arcslip/continuation/special_points/multiple_point.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/continuation/special_points/test_functions.hpp>
#include <arcslip/continuation/tracing/state.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>
