#pragma once
// From a scene to responses: scenes, studies with their results and writers, models, laws of force, and the
// functions that studies call.

#include <arcslip/continuation.hpp>
#include <arcslip/elements/law.hpp>
#include <arcslip/elements/sampled_law.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/observables/curves.hpp>
#include <arcslip/observables/frequency_response.hpp>
#include <arcslip/observables/histories.hpp>
#include <arcslip/observables/nonlinear_modes.hpp>
#include <arcslip/observables/over_parameter.hpp>
#include <arcslip/observables/responses_at.hpp>
#include <arcslip/observables/time_study.hpp>
#include <arcslip/results/csv_writer.hpp>
#include <arcslip/results/json_writer.hpp>
#include <arcslip/results/table_writer.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>
