// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_texts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "experiments/study/display_number.h"

namespace frond {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLevel = 0.05;     // of significance
constexpr int kFewBlocks = 10;      // ranks over fewer are weak evidence
constexpr std::size_t kNames = 12;  // problems named in a sentence

double OrInfinity(double value) { return std::isnan(value) ? kInfinity : value; }

double SuccessRate(const ContenderSummary& c) {
  return c.runs > 0 ? static_cast<double>(c.successes) / c.runs : 0;
}

std::string Counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string Reached(const ContenderSummary& c) {
  return "reached the target in " + std::to_string(c.successes) + " of " + std::to_string(c.runs) +
         " runs (" + Percent(SuccessRate(c)) + ", 95 % interval " + PercentInterval(c.success_interval) + ")";
}

std::string PerSuccess(const ContenderSummary& c) {
  return UntilText(c.expected_running_time) + " evaluations per success (95 % interval " +
         UntilText(c.expected_running_time_interval) + ")";
}

int AllFailed(const StudyAnalysis& analysis) {
  int failed = 0;
  for (const ContenderSummary& c : analysis.contenders) failed += c.failed;
  return failed;
}

int AllSuccesses(const StudyAnalysis& analysis) {
  int successes = 0;
  for (const ContenderSummary& c : analysis.contenders) successes += c.successes;
  return successes;
}

std::string Blocks(const StudyAnalysis& analysis) {
  const auto count = static_cast<std::size_t>(std::max(analysis.rank_block_count, 0));
  if (analysis.rank_blocks == "problems") return Counted(count, "problem");
  return Counted(count, "block") + " (" + analysis.rank_blocks + ")";
}

// Whether ranks tell `best` from the others, in a sentence.
std::string RankCertainty(const StudyAnalysis& analysis, std::size_t best) {
  if (!(analysis.friedman_p < kLevel)) {
    return "How sure: not sure. Over " + Blocks(analysis) +
           " the ranks do not tell the solvers apart (Friedman p = " + Significance(analysis.friedman_p) +
           "); more problems or repetitions may.";
  }
  std::vector<bool> alike(analysis.contenders.size(), false);
  for (const auto& group : analysis.equal_groups) {
    if (std::find(group.begin(), group.end(), best) == group.end()) continue;
    for (const std::size_t k : group) alike[k] = true;
  }
  std::vector<std::string> same, worse;
  for (std::size_t k = 0; k < alike.size(); ++k) {
    if (k != best) (alike[k] ? same : worse).push_back(analysis.contenders[k].name);
  }
  const std::string test = " (Friedman p " + std::string(analysis.friedman_p < 0.001 ? "" : "= ") +
                           Significance(analysis.friedman_p) + "; Nemenyi, 5 % level, over " +
                           Blocks(analysis) + ")";
  std::string text = "How sure: ";
  if (!worse.empty()) text += "it ranks better than " + Joined(worse) + test;
  if (!same.empty()) {
    text += std::string(worse.empty() ? "" : ", but ") + "ranks cannot tell it from " + Joined(same) +
            (worse.empty() ? test : "");
  }
  return text + ".";
}

// "; it never reaches the target on 2 problems", or "".
std::string NeverReached(const StudyAnalysis& analysis, std::size_t contender) {
  std::size_t never = 0;
  for (const ProblemSummary& p : analysis.problems) {
    if (contender < p.cells.size() && p.cells[contender].successes == 0) ++never;
  }
  return never == 0 ? "" : "; it never reaches the target on " + Counted(never, "problem");
}

// Who is first by other measures.
std::vector<std::string> OtherFirsts(const StudyAnalysis& analysis, std::size_t best) {
  const auto& all = analysis.contenders;
  const auto least = [&](const auto& cost) {
    std::size_t first = best;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (OrInfinity(cost(all[k])) < OrInfinity(cost(all[first]))) first = k;
    }
    return first;
  };
  std::vector<std::string> texts;
  const std::size_t surest = least([](const ContenderSummary& c) { return -SuccessRate(c); });
  if (surest != best)
    texts.push_back("Most reliable is " + all[surest].name + ": it " + Reached(all[surest]) + ".");
  const std::size_t cheapest = least([](const ContenderSummary& c) { return c.expected_running_time; });
  if (cheapest != best) {
    texts.push_back("Least spent has " + all[cheapest].name + ": " + PerSuccess(all[cheapest]) +
                    NeverReached(analysis, cheapest) + ".");
  }
  const std::size_t fastest = least([](const ContenderSummary& c) { return c.median_seconds; });
  if (fastest != best) {
    texts.push_back("Fastest by the clock is " + all[fastest].name + ": a median of " +
                    UntilText(all[fastest].median_seconds) + " s to the target, against " +
                    UntilText(all[best].median_seconds) + " of " + all[best].name + ".");
  }
  return texts;
}

std::string TargetText(const StudySettings& settings) {
  const std::string tau = InFull(settings.target);
  switch (settings.scale) {
    case TargetScale::kStart:
      return "f ≤ f_L + " + tau + " (f₀ − f_L), with f₀ the objective of the run's start";
    case TargetScale::kRelative:
      return "f ≤ f_L + " + tau + " |f_L|";
    case TargetScale::kAbsolute:
      return "f ≤ f_L + " + tau;
  }
  return "";
}

std::string LeastText(const StudyAnalysis& analysis) {
  const auto known =
      static_cast<std::size_t>(std::count_if(analysis.problems.begin(), analysis.problems.end(),
                                             [](const ProblemSummary& p) { return p.least_is_known; }));
  const std::size_t all = analysis.problems.size();
  const std::string caveat =
      " the best objective of all runs of this study: a target that one of the solvers set itself, and that "
      "is too easy "
      "where all stopped short";
  if (known == all) return "f_L, the least objective, is published for every problem.";
  if (known == 0) return "f_L, the least objective, is published for no problem; it is" + caveat + ".";
  return "f_L, the least objective, is published for " + std::to_string(known) + " of " +
         std::to_string(all) + " problems; for the others it is" + caveat + ".";
}

std::string ValidText(const StudyPlan& plan) {
  if (plan.contenders.size() < 2) return "";
  if (const auto evaluations = ComparableEvaluations(plan)) {
    return "The comparison is valid up to the smallest budget, " + WholeNumber(*evaluations) +
           " evaluations.";
  }
  double seconds = kInfinity;
  for (const Contender& c : plan.contenders) seconds = std::min(seconds, c.budget.max_seconds);
  if (std::isfinite(seconds)) {
    return "The comparison is valid up to the smallest budget, " + ThreeDigits(seconds) +
           " s of this machine.";
  }
  return "Not every run has a budget: each ended where its solver did, and the comparison is valid up to the "
         "shortest.";
}

// " (on p 15, q 3)", the problems with most misses first; "" where all are of one problem's study.
std::string WhereMissed(const StudyAnalysis& analysis, const SpeedUp& s) {
  constexpr std::size_t kMost = 6;
  if (analysis.problems.size() < 2) return "";
  std::vector<std::pair<std::size_t, int>> missed = s.missed;
  std::stable_sort(missed.begin(), missed.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(missed.size(), kMost); ++k) {
    words.push_back(std::to_string(missed[k].second) + " on " + analysis.problems[missed[k].first].name);
  }
  if (missed.size() > kMost) words.push_back(Counted(missed.size() - kMost, "more problem"));
  return words.empty() ? "" : " (" + Joined(words) + ")";
}

std::string SpeedUpSentence(const StudyAnalysis& analysis, const SpeedUp& s) {
  const std::string& solver = analysis.contenders[s.solver].name;
  const std::string& reference = analysis.contenders[s.reference].name;
  const auto inverse = [](double factor) {
    return factor > 0 ? ThreeDigits(1 / factor) : std::string("never");
  };
  std::string text;
  if (s.median >= 1) {
    text = solver + " reaches the best objective of " + reference + " with " + ThreeDigits(s.median) + " (";
    text += s.interval.lower > 0 ? ThreeDigits(s.interval.lower) : "never";
    text += "–" + ThreeDigits(s.interval.upper) + ") times fewer evaluations; ";
  } else if (s.median > 0) {
    text = solver + " needs " + inverse(s.median) + " (" + inverse(s.interval.upper) + "–" +
           inverse(s.interval.lower) + ") times the evaluations to reach the best objective of " + reference +
           "; ";
  } else {
    text = solver + " does not reach the best objective of " + reference + " in most runs; ";
  }
  const int missed = s.pairs - s.reached;
  if (missed > 0) {
    text += "in " + std::to_string(missed) + " of " + std::to_string(s.pairs) +
            " runs it never does: there " + reference + " wins" + WhereMissed(analysis, s);
  } else {
    text += "it does in all " + std::to_string(s.pairs) + " runs";
  }
  const bool unsure = s.interval.lower <= 1 && s.interval.upper >= 1;
  if (unsure && s.median > 0) text += " (not sure: the interval holds 1)";
  return text + ".";
}

}  // namespace

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  }
  return text;
}

std::optional<std::int64_t> ComparableEvaluations(const StudyPlan& plan) {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const Contender& c : plan.contenders) {
    if (!c.budget.LimitsEvaluations()) return std::nullopt;
    least = std::min(least, c.budget.max_evaluations);
  }
  return plan.contenders.empty() ? std::nullopt : std::optional(least);
}

std::optional<std::size_t> RecommendedContender(const StudyAnalysis& analysis) {
  std::optional<std::size_t> best;
  const auto order = [&](std::size_t k) {
    const ContenderSummary& c = analysis.contenders[k];
    return std::tuple(OrInfinity(c.mean_rank), -SuccessRate(c), OrInfinity(c.expected_running_time));
  };
  for (std::size_t k = 0; k < analysis.contenders.size(); ++k) {
    if (analysis.contenders[k].failed >= analysis.contenders[k].runs) continue;
    if (!best || order(k) < order(*best)) best = k;
  }
  if (!best) return best;
  // Of those that ranks cannot tell from the first the most reliable, then the cheapest.
  const double first_rank = analysis.contenders[*best].mean_rank;
  const auto reliability = [&](std::size_t k) {
    const ContenderSummary& c = analysis.contenders[k];
    return std::tuple(-SuccessRate(c), OrInfinity(c.expected_running_time), OrInfinity(c.mean_rank));
  };
  for (std::size_t k = 0; k < analysis.contenders.size(); ++k) {
    const ContenderSummary& c = analysis.contenders[k];
    const bool tied = c.mean_rank - first_rank < analysis.critical_difference;
    if (c.failed < c.runs && tied && reliability(k) < reliability(*best)) best = k;
  }
  return best;
}

// "it ranks best (mean rank 1.2)", or beside whom it does.
std::string RankText(const StudyAnalysis& analysis, std::size_t best) {
  const std::string rank = ThreeDigits(analysis.contenders[best].mean_rank);
  const auto first = std::min_element(analysis.contenders.begin(), analysis.contenders.end(),
                                      [](const auto& a, const auto& b) { return a.mean_rank < b.mean_rank; });
  if (!(first->mean_rank < analysis.contenders[best].mean_rank))
    return "it ranks best (mean rank " + rank + ")";
  return "it is among those that ranks put first (mean rank " + rank + "; " + first->name + " has " +
         ThreeDigits(first->mean_rank) +
         ", a difference that they cannot establish), and of these it succeeds most often, then most cheaply";
}

std::vector<std::string> AnswerSentences(const StudyPlan& plan, const StudyAnalysis& analysis) {
  const auto best = RecommendedContender(analysis);
  if (!best) return {"None: no run gave a result, so nothing can be compared."};
  const ContenderSummary& c = analysis.contenders[*best];
  std::vector<std::string> texts;
  if (analysis.contenders.size() < 2) {
    texts.push_back("Only " + c.name + " was run: there is nothing to compare it with. It " + Reached(c) +
                    ", at " + PerSuccess(c) + ".");
  } else if (AllSuccesses(analysis) == 0) {
    texts.push_back("No solver reached the target in any run. " + c.name +
                    " came nearest: its mean rank is " + ThreeDigits(c.mean_rank) + " of " +
                    std::to_string(analysis.contenders.size()) +
                    ". A larger budget, or a target that is less strict, may tell more.");
  } else {
    texts.push_back("Use " + c.name + ". Of " + Counted(analysis.contenders.size(), "solver") + " " +
                    RankText(analysis, *best) + "; it " + Reached(c) + ", at " + PerSuccess(c) + ".");
  }
  if (analysis.contenders.size() > 1) {
    texts.push_back(RankCertainty(analysis, *best));
    if (analysis.rank_block_count < kFewBlocks) {
      texts.push_back("Ranks over only " + Blocks(analysis) + " are a hint, no more.");
    }
    for (std::string& text : OtherFirsts(analysis, *best)) texts.push_back(std::move(text));
  }
  if (const int failed = AllFailed(analysis); failed > 0) {
    texts.push_back(std::to_string(failed) + " of " + std::to_string(analysis.runs.size()) +
                    " runs failed; they count as runs without success.");
  }
  if (std::string valid = ValidText(plan); !valid.empty()) texts.push_back(std::move(valid));
  return texts;
}

std::vector<std::string> SetupSentences(const StudyPlan& plan, const StudyAnalysis& analysis) {
  const StudySettings& settings = plan.settings;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(kNames, analysis.problems.size()); ++k) {
    names.push_back(analysis.problems[k].name);
  }
  if (analysis.problems.size() > kNames) {
    names.push_back(std::to_string(analysis.problems.size() - kNames) + " more");
  }
  const std::size_t repetitions = static_cast<std::size_t>(std::max(settings.repetitions, 0));
  std::vector<std::string> texts = {
      Counted(analysis.problems.size(), "problem") + " × " + Counted(analysis.contenders.size(), "solver") +
          " × " + Counted(repetitions, "repetition") + ": " + Counted(analysis.runs.size(), "run") + ", " +
          std::to_string(AllFailed(analysis)) + " of them failed.",
      "Problems: " + Joined(names) + ".",
      "Seed " + std::to_string(plan.seed) +
          "; each repetition of a problem has a seed of its own, the same for every solver. Every run "
          "starts " +
          (settings.random_starts ? "at a point drawn in the fit's start box." : "at the fit's own start."),
      "Success: " + TargetText(settings) + "." +
          (settings.stop_at_target ? " Where f_L is published a run ends on success."
                                   : " Runs go on after success."),
      LeastText(analysis)};
  std::vector<std::string> once;
  for (const ContenderSummary& c : analysis.contenders) {
    if (c.repeats_itself) once.push_back(c.name);
  }
  if (!once.empty()) {
    texts.push_back("The repetitions of " + Joined(once) + " are the same run each time: " +
                    Counted(analysis.problems.size(), "case") + ", however many its intervals count.");
  }
  std::vector<std::string> targets;
  for (const double tau : settings.profile_targets) targets.push_back(InFull(tau));
  texts.push_back("Run-length distributions are over the targets τ = " + Joined(targets) + ".");
  texts.push_back(
      "Evaluations are residual evaluations; a Jacobian of n parameters is charged n of them (2n where "
      "numeric). A run longer than " +
      InFull(settings.time_limit) + " s is killed and counts as failed.");
  if (analysis.contenders.size() > 1) {
    texts.push_back(
        "Ranks (runs that reached the target by evaluations, behind them the others by gap) average over " +
        Blocks(analysis) + ".");
    texts.push_back(ValidText(plan));
  }
  return texts;
}

std::vector<std::string> SpeedUpSentences(const StudyPlan& plan, const StudyAnalysis& analysis,
                                          std::size_t most) {
  if (analysis.contenders.size() < 2) return {};
  std::vector<std::string> texts;  // what the study asks for first, however it came out
  std::vector<const SpeedUp*> faster;
  for (const SpeedUp& s : analysis.speed_ups) {
    if (s.pairs == 0) continue;
    if (plan.solvers[plan.contenders[s.solver].solver].label == plan.settings.question) {
      texts.push_back(SpeedUpSentence(analysis, s));
    } else if (s.median > 1) {
      faster.push_back(&s);
    }
  }
  std::stable_sort(faster.begin(), faster.end(), [](const SpeedUp* a, const SpeedUp* b) {
    const bool a_sure = a->interval.lower > 1, b_sure = b->interval.lower > 1;
    return a_sure != b_sure ? a_sure : a->median > b->median;
  });
  for (std::size_t k = 0; k < std::min(most, faster.size()); ++k) {
    texts.push_back(SpeedUpSentence(analysis, *faster[k]));
  }
  if (faster.size() > most) {
    texts.push_back(Counted(faster.size() - most, "more pair") + " in the table of speed-ups.");
  }
  const bool compared = std::any_of(analysis.speed_ups.begin(), analysis.speed_ups.end(),
                                    [](const SpeedUp& s) { return s.pairs > 0; });
  if (!compared) return {"No two runs from the same start gave results to compare."};
  if (texts.empty()) {
    texts.push_back("No solver reaches what another did in fewer evaluations, in the median.");
  }
  return texts;
}

std::vector<std::string> RankSentences(const StudyAnalysis& analysis) {
  if (analysis.contenders.size() < 2) return {};
  std::vector<std::string> texts = {
      "Friedman's test over " + Blocks(analysis) + ": p " +
      std::string(analysis.friedman_p < 0.001 ? "" : "= ") + Significance(analysis.friedman_p) + ". " +
      (analysis.friedman_p < kLevel ? "The solvers do not all rank alike."
                                    : "The ranks are what chance alone may give.") +
      " Two mean ranks differ, at the 5 % level for all pairs, where they are at least " +
      ThreeDigits(analysis.critical_difference) + " apart (Nemenyi)."};
  for (const auto& group : analysis.equal_groups) {
    std::vector<std::string> names;
    for (const std::size_t k : group) names.push_back(analysis.contenders[k].name);
    if (names.size() > 1) texts.push_back("Cannot be told apart: " + Joined(names) + ".");
  }
  if (analysis.equal_groups.empty() && analysis.friedman_p < kLevel)
    texts.push_back("Every solver differs from every other.");
  return texts;
}

}  // namespace frond
