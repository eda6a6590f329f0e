// SPDX-License-Identifier: BSD-3-Clause
// What a study found, in sentences.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/study/study_analysis.h"
#include "experiments/study/study_plan.h"

namespace frond {

// The contender to use: the best mean rank, then the larger share of successes, then fewer evaluations per
// success. Nothing where no run gave a result.
std::optional<std::size_t> RecommendedContender(const StudyAnalysis& analysis);

// Which solver to use, and how sure that is.
std::vector<std::string> AnswerSentences(const StudyPlan& plan, const StudyAnalysis& analysis);

// What was run: problems, runs, seeds, targets, where f_L is from, what ranks average over, how far this is
// valid.
std::vector<std::string> SetupSentences(const StudyPlan& plan, const StudyAnalysis& analysis);

// The pairs where one reaches what the other did in fewer evaluations, surest and largest first, at most
// `most`.
std::vector<std::string> SpeedUpSentences(const StudyPlan& plan, const StudyAnalysis& analysis,
                                          std::size_t most = 12);

// Friedman's test, Nemenyi's critical difference and its groups. Empty for fewer than two solvers.
std::vector<std::string> RankSentences(const StudyAnalysis& analysis);

// The smallest budget of evaluations, where all have one: runs can be compared up to there.
std::optional<std::int64_t> ComparableEvaluations(const StudyPlan& plan);

std::string Joined(const std::vector<std::string>& words);  // "a, b and c"

}  // namespace frond
