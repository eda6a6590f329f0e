// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/study/job_result.h"
#include "experiments/study/study_plan.h"

namespace frond {

// Writes runs.csv, traces/, summary.csv, summary.md and report.html of a whole study, each renamed into
// place, and returns the report for a terminal. `results` in the order of the plan. Throws InputError.
//
// The same plan gives the same runs.csv, whatever the threads and the interruptions, but for the columns
// `seconds` and `target_seconds`, which stand last.
std::string WriteStudyOutputs(const StudyPlan& plan, const std::vector<JobResult>& results,
                              const std::filesystem::path& folder);

}  // namespace frond
