// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_plan.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "base/errors.h"
#include "base/random.h"
#include "experiments/study/study_sets.h"
#include "experiments/version.h"
#include "io/file_bytes.h"
#include "io/number_text.h"
#include "io/sha256.h"

namespace frond {
namespace {

constexpr std::size_t kMostJobs = 10'000'000;

constexpr char kNameRule[] = " must be a name of letters, digits, '_' and '-'";

// Names stand in file names, tables and dotted keys.
bool IsName(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

void CheckLabel(const ConfigFile& config, const std::string& section, const std::string& label) {
  if (IsName(label)) return;
  const std::string key = section + "." + label;  // with a dot in the label it is found nowhere
  config.Fail(config.Has(key) ? key : section, "'" + label + "' in '" + section + "'" + kNameRule);
}

std::vector<std::string> Labels(const ConfigFile& config, const std::string& section) {
  if (!config.Has(section)) config.Fail(section, "'" + section + "' is missing; see docs/studies.md");
  if (!config.IsSection(section))
    config.Fail(section, "'" + section + "' must be a section of named entries");
  std::vector<std::string> labels = config.Keys(section);
  if (labels.empty()) config.Fail(section, "'" + section + "' names none");
  for (const std::string& label : labels) CheckLabel(config, section, label);
  return labels;
}

// A registry's or an option check's complaint, with the config's place in front.
template <typename Find>
auto At(const ConfigFile& config, const std::string& key, const Find& find) -> decltype(find()) {
  try {
    return find();
  } catch (const ConfigError& error) {
    config.Fail(key, error.what());
  } catch (const InputError& error) {
    config.Fail(key, error.what());
  }
}

// Not the defaults: what has no effect beside another option may not be set.
void AddWhatIsSet(const std::string& section, const Options& options, ResolvedConfig* resolved) {
  for (const OptionSpec& spec : options.specs()) {
    if (options.IsSet(spec.name)) resolved->Add(section + "." + spec.name, options.Value(spec.name));
  }
}

void ReadProblems(const ConfigFile& config, ResolvedConfig* resolved, StudyPlan* plan) {
  for (const std::string& label : Labels(config, "problems")) {
    const std::string section = "problems." + label;
    const std::string set = config.Text(section + ".set");
    const ProblemSetType& type = At(config, section + ".set", [&]() -> const ProblemSetType& {
      return FindProblemSetType(StudySetTypes(), set);
    });
    Options options(type.options);
    config.ReadSection(section, &options, {"set"});
    std::string input_hash;
    if (config.Has(section + ".cloud")) {
      const std::filesystem::path cloud = config.ResolvePath(section + ".cloud");
      options.Set("cloud", cloud.string());
      input_hash = At(config, section + ".cloud", [&] { return Sha256(ReadFileBytes(cloud)); });
    }
    resolved->Add(section + ".set", set);
    AddWhatIsSet(section, options, resolved);
    std::vector<TestProblem> problems = At(config, section, [&] { return type.problems(options); });
    for (TestProblem& problem : problems) {
      const std::string name = problems.size() == 1 ? label : label + "." + problem.name;
      const bool twice = std::any_of(plan->problems.begin(), plan->problems.end(),
                                     [&](const StudyProblem& other) { return other.name == name; });
      if (twice) config.Fail(section, "'" + name + "' is named twice");
      plan->problems.push_back({name, set, options, std::move(problem), input_hash});
    }
  }
}

void ReadSolvers(const ConfigFile& config, ResolvedConfig* resolved, StudyPlan* plan) {
  for (const std::string& label : Labels(config, "solvers")) {
    const std::string section = "solvers." + label;
    const std::string name = config.Text(section + ".type", label);
    const SolverType& type = At(config, config.Has(section + ".type") ? section + ".type" : section,
                                [&]() -> const SolverType& { return FindSolverType(name); });
    Options options(type.options);
    config.ReadSection(section, &options, {"type"});
    (void)At(config, section, [&] { return type.create(options); });
    resolved->Add(section + ".type", name);
    AddWhatIsSet(section, options, resolved);
    plan->solvers.push_back({label, name, std::move(options)});
  }
}

std::int64_t AtLeastOne(const ConfigFile& config, const std::string& key, std::int64_t fallback) {
  const std::int64_t value = config.Integer(key, fallback);
  if (value < 1) config.Fail(key, "'" + key + "' must be at least 1");
  return value;
}

bool IsWhole(double value) { return value == std::floor(value); }

// Contenders: solvers × budgets, and `budget` resolved.
void ReadBudgets(const ConfigFile& config, ResolvedConfig* resolved, StudyPlan* plan) {
  config.CheckKeys("budget", {"evaluations", "seconds", "stall"});
  Budget common;
  if (config.Has("budget.seconds")) {
    common.max_seconds = config.Number("budget.seconds");
    if (!(common.max_seconds > 0)) config.Fail("budget.seconds", "'seconds' must be above 0");
    resolved->Add("budget.seconds", common.max_seconds);
  }
  if (config.Has("budget.stall")) {
    common.stall_evaluations = AtLeastOne(config, "budget.stall", 1);
    resolved->Add("budget.stall", common.stall_evaluations);
  }
  std::vector<double> evaluations;
  if (config.Has("budget.evaluations")) {
    evaluations = config.Numbers("budget.evaluations");
    for (const double e : evaluations) {
      if (!(e >= 1 && e <= 1e15 && IsWhole(e))) {
        config.Fail("budget.evaluations", "'evaluations' must be whole numbers from 1 to 1e15");
      }
    }
    if (std::set<double>(evaluations.begin(), evaluations.end()).size() != evaluations.size()) {
      config.Fail("budget.evaluations", "'evaluations' names a budget twice");
    }
    resolved->Add("budget.evaluations", evaluations);
  }
  if (evaluations.empty() && !std::isfinite(common.max_seconds)) {
    config.Fail("budget", "a study needs 'budget.evaluations' or 'budget.seconds'");
  }
  for (std::size_t s = 0; s < plan->solvers.size(); ++s) {
    if (evaluations.empty()) plan->contenders.push_back({plan->solvers[s].label, s, common});
    for (const double e : evaluations) {
      Contender contender{plan->solvers[s].label, s, common};
      contender.budget.max_evaluations = std::llround(e);
      if (evaluations.size() > 1) contender.name += "@" + std::to_string(std::llround(e));
      plan->contenders.push_back(std::move(contender));
    }
  }
}

std::string OneOf(const ConfigFile& config, const std::string& key, const std::vector<std::string>& words) {
  const std::string word = config.Text(key, words[0]);
  if (std::find(words.begin(), words.end(), word) != words.end()) return word;
  std::string all;
  for (const std::string& known : words) all += (all.empty() ? "" : ", ") + known;
  config.Fail(key, "'" + key + "' is " + word + ", expected one of " + all);
}

StudySettings ReadSettings(const ConfigFile& config, ResolvedConfig* resolved) {
  config.CheckKeys("study", {"repetitions", "starts", "target", "target_scale", "stop_at_target",
                             "profile_targets", "question", "time_limit", "part"});
  StudySettings settings;
  const std::int64_t repetitions = AtLeastOne(config, "study.repetitions", settings.repetitions);
  if (repetitions > 1'000'000) config.Fail("study.repetitions", "'repetitions' must be at most 1e6");
  settings.repetitions = static_cast<int>(repetitions);
  const std::string starts = OneOf(config, "study.starts", {"given", "random"});
  settings.random_starts = starts == "random";
  settings.target = config.Number("study.target", settings.target);
  if (!(settings.target > 0 && std::isfinite(settings.target)))
    config.Fail("study.target", "'target' must be above 0");
  const std::string scale = OneOf(config, "study.target_scale", {"start", "relative", "absolute"});
  settings.scale = scale == "relative"   ? TargetScale::kRelative
                   : scale == "absolute" ? TargetScale::kAbsolute
                                         : TargetScale::kStart;
  settings.stop_at_target = config.Flag("study.stop_at_target", settings.stop_at_target);
  if (config.Has("study.profile_targets")) settings.profile_targets = config.Numbers("study.profile_targets");
  if (settings.profile_targets.empty()) config.Fail("study.profile_targets", "'profile_targets' names none");
  for (const double tau : settings.profile_targets) {
    if (!(tau > 0 && std::isfinite(tau)))
      config.Fail("study.profile_targets", "'profile_targets' must be above 0");
  }
  settings.question = config.Text("study.question", "");
  settings.time_limit = config.Number("study.time_limit", settings.time_limit);
  if (!(settings.time_limit > 0)) config.Fail("study.time_limit", "'time_limit' must be above 0");
  if (config.Has("study.part")) {
    const std::vector<double> part = config.Numbers("study.part");
    if (part.size() != 2 || !(part[0] >= 1 && part[0] <= part[1] && part[1] <= 1e6) || !IsWhole(part[0]) ||
        !IsWhole(part[1])) {
      config.Fail("study.part",
                  "'part' must be [k, n] with 1 <= k <= n: every n-th repetition of a problem from "
                  "the k-th");
    }
    settings.part = static_cast<int>(part[0]);
    settings.parts = static_cast<int>(part[1]);
  }
  resolved->Add("study.repetitions", std::int64_t{settings.repetitions});
  resolved->Add("study.starts", starts);
  resolved->Add("study.target", settings.target);
  resolved->Add("study.target_scale", scale);
  resolved->Add("study.stop_at_target", settings.stop_at_target);
  resolved->Add("study.profile_targets", settings.profile_targets);
  if (!settings.question.empty()) resolved->Add("study.question", settings.question);
  resolved->Add("study.time_limit", settings.time_limit);
  return settings;
}

// `cloud` is told by the file's content.
std::string OptionsText(const Options& options) {
  std::string text;
  for (const OptionSpec& spec : options.specs()) {
    if (spec.name == "cloud") continue;
    text += spec.name + "=" + FormatValue(options.Value(spec.name)) + "\n";
  }
  return text;
}

// All that decides a job's result. Names of labels do not, but that of the problem, which seeds it.
std::string JobContent(const StudyPlan& plan, const StudyJob& job) {
  const StudyProblem& problem = plan.problems[job.problem];
  const Contender& contender = plan.contenders[job.contender];
  const StudySolver& solver = plan.solvers[contender.solver];
  const Budget& budget = contender.budget;
  const StudySettings& settings = plan.settings;
  return VersionText() + "\nproblem " + problem.name + "\nset " + problem.set + " " + problem.problem.name +
         "\n" + OptionsText(problem.options) + "input " + problem.input_hash + "\nsolver " + solver.type +
         "\n" + OptionsText(solver.options) + "budget " + std::to_string(budget.max_evaluations) + " " +
         FormatNumber(budget.max_seconds) + " " + std::to_string(budget.stall_evaluations) + "\nseed " +
         std::to_string(plan.JobSeed(job)) + "\nstart " +
         std::to_string(static_cast<int>(settings.random_starts)) + "\ntarget " +
         FormatNumber(settings.target) + " " + std::to_string(static_cast<int>(settings.scale)) + " " +
         std::to_string(static_cast<int>(settings.stop_at_target)) + "\ntime_limit " +
         FormatNumber(settings.time_limit) + "\n";
}

void AddJobs(const ConfigFile& config, StudyPlan* plan) {
  const std::size_t count =
      plan->problems.size() * plan->contenders.size() * static_cast<std::size_t>(plan->settings.repetitions);
  if (count > kMostJobs) {
    config.Fail("study",
                "the study has " + std::to_string(count) + " jobs, more than " + std::to_string(kMostJobs));
  }
  std::set<std::string> keys;
  for (std::size_t p = 0; p < plan->problems.size(); ++p) {
    for (int r = 0; r < plan->settings.repetitions; ++r) {
      for (std::size_t c = 0; c < plan->contenders.size(); ++c) {
        StudyJob job{p, c, r, {}};
        job.key = Sha256(JobContent(*plan, job)).substr(0, 24);
        if (!keys.insert(job.key).second) {
          config.Fail("solvers." + plan->solvers[plan->contenders[c].solver].label,
                      "'" + plan->contenders[c].name + "' is the same as another entry");
        }
        plan->jobs.push_back(std::move(job));
      }
    }
  }
}

}  // namespace

double TargetObjective(TargetScale scale, double tau, double least, double start, double resolution) {
  double allowance = tau;
  if (scale == TargetScale::kRelative) allowance = tau * std::abs(least);
  if (scale == TargetScale::kStart) allowance = std::isfinite(start) ? tau * (start - least) : 0;
  return least + std::max(allowance, resolution);
}

std::uint64_t StudyPlan::JobSeed(const StudyJob& job) const {
  return Random::ForKey(seed, problems[job.problem].name + "#" + std::to_string(job.repetition)).NextBits();
}

std::string StudyPlan::Csv() const {
  std::string csv = "key,problem,contender,repetition\n";
  for (const StudyJob& job : jobs) {
    csv += job.key + "," + problems[job.problem].name + "," + contenders[job.contender].name + "," +
           std::to_string(job.repetition) + "\n";
  }
  return csv;
}

void AdoptKeys(const std::string& csv, const std::filesystem::path& path, StudyPlan* plan) {
  StudyPlan adopted = *plan;
  std::size_t line_start = csv.find('\n') + 1;
  for (StudyJob& job : adopted.jobs) {
    const std::size_t comma = csv.find(',', line_start);
    if (line_start == 0 || comma == std::string::npos) break;
    job.key = csv.substr(line_start, comma - line_start);
    line_start = csv.find('\n', line_start) + 1;
  }
  if (adopted.Csv() != csv)
    throw InputError(path.string() + ": holds other jobs than config.yaml beside it says");
  *plan = std::move(adopted);
}

bool IsStudy(const ConfigFile& config) { return config.Has("problems"); }

StudyPlan ReadStudyPlan(const ConfigFile& config, const RunFlags& flags) {
  if (!IsStudy(config) && config.Has("problem")) {
    config.Fail("problem",
                "is the config of a single fit (it has 'problem', not 'problems'); run it with `frond fit`");
  }
  config.CheckKeys("", {"name", "seed", "problems", "solvers", "budget", "study"});
  StudyPlan plan;
  plan.name = config.Text("name", std::filesystem::path(config.name()).stem().string());
  if (!IsName(plan.name)) config.Fail("name", "'name', '" + plan.name + "'," + kNameRule);
  const std::int64_t seed = config.Integer("seed", 0);
  if (seed < 0) config.Fail("seed", "'seed' must not be negative");
  plan.seed = flags.seed.value_or(static_cast<std::uint64_t>(seed));
  ResolvedConfig resolved;
  resolved.Add("name", plan.name);
  resolved.Add("seed", static_cast<std::int64_t>(plan.seed));
  ReadProblems(config, &resolved, &plan);
  ReadSolvers(config, &resolved, &plan);
  ReadBudgets(config, &resolved, &plan);
  plan.settings = ReadSettings(config, &resolved);
  for (const Contender& contender : plan.contenders) {
    if (std::isfinite(contender.budget.max_seconds) &&
        plan.settings.time_limit <= contender.budget.max_seconds) {
      config.Fail("study.time_limit",
                  "'time_limit' must be above 'budget.seconds': a run that uses its budget would "
                  "be killed");
    }
  }
  const auto asked = std::find_if(plan.solvers.begin(), plan.solvers.end(),
                                  [&](const StudySolver& s) { return s.label == plan.settings.question; });
  if (!plan.settings.question.empty() && asked == plan.solvers.end()) {
    config.Fail("study.question",
                "'question' is " + plan.settings.question + ", expected a name in 'solvers'");
  }
  AddJobs(config, &plan);
  plan.config = resolved.Yaml();
  return plan;
}

}  // namespace frond
