// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study_plan.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "base/errors.h"
#include "small_study.h"
#include "tests/io/temp_folder.h"

namespace frond {
namespace {

constexpr char kPlan[] = R"(name: plan
seed: 3
problems:
  bowl: {set: functions, function: sphere, dimension: 2}
  fits: {set: nist, problem: misra1a}
solvers:
  lm: {}
  swarm: {type: pso, swarm_size: 10}
budget: {evaluations: [100, 1000]}
study: {repetitions: 2}
)";

StudyPlan PlanWith(const std::string& set) {
  ConfigFile config = ConfigFile::Parse(kPlan, "study.yaml");
  if (!set.empty()) config.Override(set);
  return ReadStudyPlan(config, {});
}

// kPlan with the text `from` replaced by `to`.
std::string Replaced(const std::string& from, const std::string& to) {
  std::string text = kPlan;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// Keys by what they are the key of.
std::map<std::string, std::string> KeysOf(const StudyPlan& plan) {
  std::map<std::string, std::string> keys;
  for (const StudyJob& job : plan.jobs) {
    keys[plan.problems[job.problem].name + " " + plan.contenders[job.contender].name + " " +
         std::to_string(job.repetition)] = job.key;
  }
  return keys;
}

struct Wrong {
  const char *from, *to, *message;
};

TEST(StudyPlan, WrongConfig_IsOneLineWithThePlace) {
  const Wrong cases[] = {
      {"problems:\n  bowl: {set: functions, function: sphere, dimension: 2}\n  fits: {set: nist, problem: "
       "misra1a}\n",
       "", "study.yaml: 'problems' is missing; see docs/studies.md"},
      {"solvers:\n  lm: {}\n  swarm: {type: pso, swarm_size: 10}\n", "",
       "study.yaml: 'solvers' is missing; see docs/studies.md"},
      {"solvers:\n  lm: {}\n  swarm: {type: pso, swarm_size: 10}\n", "solvers: {}\n",
       "study.yaml:6:10: 'solvers' names none"},
      {"solvers:\n  lm: {}\n  swarm: {type: pso, swarm_size: 10}\n", "solvers: [lm, pso]\n",
       "study.yaml:6:10: 'solvers' must be a section of named entries"},
      {"budget: {evaluations: [100, 1000]}\n", "",
       "study.yaml: a study needs 'budget.evaluations' or 'budget.seconds'"},
      {"[100, 1000]", "[100, 2.5]", "study.yaml:9:23: 'evaluations' must be whole numbers from 1 to 1e15"},
      {"[100, 1000]", "0", "study.yaml:9:23: 'evaluations' must be whole numbers from 1 to 1e15"},
      {"set: functions", "set: function",
       "study.yaml:4:15: unknown problem set 'function' (did you mean 'functions'?)"},
      {"set: functions, ", "", "study.yaml:4:9: 'set' in 'bowl' is missing, expected text"},
      {"function: sphere", "function: spere",
       "study.yaml:4:36: 'function' in 'bowl' is spere, expected one of all, ackley, griewank, rastrigin, "
       "rosenbrock, schwefel, sphere"},
      {"type: pso", "type: psoo", "study.yaml:8:17: unknown solver 'psoo' (did you mean 'pso'?)"},
      {"lm: {}", "ml: {}", "study.yaml:7:7: unknown solver 'ml' (did you mean 'lm'?)"},
      {"swarm_size: 10", "swarmsize: 10",
       "study.yaml:8:22: unknown key 'swarmsize' in 'swarm' (did you mean 'swarm_size'?)"},
      {"swarm_size: 10", "swarm_size: -1",
       "study.yaml:8:34: 'swarm_size' in 'swarm' is -1, expected an integer in [1, 1e+09]"},
      {"repetitions: 2", "repetitions: 0", "study.yaml:10:22: 'study.repetitions' must be at least 1"},
      {"repetitions: 2", "repetitions: 2.5",
       "study.yaml:10:22: 'repetitions' in 'study' is 2.5, expected an integer"},
      {"repetitions: 2", "repetitons: 2",
       "study.yaml:10:9: unknown key 'repetitons' in 'study' (did you mean 'repetitions'?)"},
      {"repetitions: 2", "target_scale: best",
       "study.yaml:10:23: 'study.target_scale' is best, expected one of start, relative, absolute"},
      {"repetitions: 2", "starts: some",
       "study.yaml:10:17: 'study.starts' is some, expected one of given, random"},
      {"repetitions: 2", "target: 0", "study.yaml:10:17: 'target' must be above 0"},
      {"repetitions: 2", "time_limit: -1", "study.yaml:10:21: 'time_limit' must be above 0"},
      {"repetitions: 2", "profile_targets: [1e-3, 0]", "study.yaml:10:26: 'profile_targets' must be above 0"},
      {"repetitions: 2", "profile_targets: []", "study.yaml:10:26: 'profile_targets' names none"},
      {"repetitions: 2", "part: [3, 2]",
       "study.yaml:10:15: 'part' must be [k, n] with 1 <= k <= n: every n-th repetition of a problem from "
       "the k-th"},
      {"repetitions: 2", "part: [1.5, 2]",
       "study.yaml:10:15: 'part' must be [k, n] with 1 <= k <= n: every n-th repetition of a problem from "
       "the k-th"},
      {"repetitions: 2", "part: 1",
       "study.yaml:10:15: 'part' must be [k, n] with 1 <= k <= n: every n-th repetition of a problem from "
       "the k-th"},
      {"bowl:", "a.bowl:",
       "study.yaml:4:3: 'a.bowl' in 'problems' must be a name of letters, digits, '_' and '-'"},
      {"bowl:", "a/bowl:",
       "study.yaml:4:11: 'a/bowl' in 'problems' must be a name of letters, digits, '_' and '-'"},
      {"swarm:", "../swarm:",
       "study.yaml:7:3: '../swarm' in 'solvers' must be a name of letters, digits, '_' and '-'"},
      {"lm: {}", "lm: {}\n  also_lm: {type: lm}",
       "study.yaml:8:12: 'also_lm@100' is the same as another entry"},
      {"[100, 1000]", "[100, 100]", "study.yaml:9:23: 'evaluations' names a budget twice"},
      {"name: plan", "name: my/plan",
       "study.yaml:1:7: 'name', 'my/plan', must be a name of letters, digits, '_' and '-'"},
      {"seed: 3", "seed: -3", "study.yaml:2:7: 'seed' must not be negative"},
      {"seed: 3", "sed: 3", "study.yaml:2:1: unknown key 'sed' at the top level (did you mean 'seed'?)"},
      {"repetitions: 2", "repetitions: 1000000",
       "study.yaml:10:8: the study has 12000000 jobs, more than 10000000"},
  };
  for (const Wrong& wrong : cases) {
    const std::string yaml = Replaced(wrong.from, wrong.to);
    const std::string message = MessageOf<ConfigError>([&] { (void)PlanOf(yaml); });
    EXPECT_EQ(message, wrong.message);
  }
}

TEST(StudyPlan, Jobs_StandByProblemThenRepetitionThenContender) {
  const StudyPlan plan = PlanOf(kPlan);
  EXPECT_EQ(plan.name, "plan");
  EXPECT_EQ(plan.seed, 3U);
  std::vector<std::string> problems, contenders;
  for (const StudyProblem& problem : plan.problems) problems.push_back(problem.name);
  for (const Contender& contender : plan.contenders) contenders.push_back(contender.name);
  EXPECT_EQ(problems, (std::vector<std::string>{"bowl", "fits.misra1a_1", "fits.misra1a_2"}));
  EXPECT_EQ(contenders, (std::vector<std::string>{"lm@100", "lm@1000", "swarm@100", "swarm@1000"}));
  EXPECT_EQ(plan.contenders[3].budget.max_evaluations, 1000);
  EXPECT_EQ(plan.contenders[3].solver, 1U);
  ASSERT_EQ(plan.jobs.size(), 3U * 2U * 4U);
  std::set<std::string> keys;
  for (std::size_t k = 0; k < plan.jobs.size(); ++k) {
    EXPECT_EQ(plan.jobs[k].problem, k / 8);
    EXPECT_EQ(plan.jobs[k].repetition, static_cast<int>(k / 4 % 2));
    EXPECT_EQ(plan.jobs[k].contender, k % 4);
    EXPECT_EQ(plan.jobs[k].key.size(), 24U);
    keys.insert(plan.jobs[k].key);
  }
  EXPECT_EQ(keys.size(), plan.jobs.size());
  const std::string first = "key,problem,contender,repetition\n" + plan.jobs[0].key + ",bowl,lm@100,0\n";
  EXPECT_TRUE(plan.Csv().starts_with(first)) << plan.Csv();
}

TEST(StudyPlan, Keys_ChangeWithAllThatDecidesAResult) {
  const auto keys = KeysOf(PlanOf(kPlan));
  for (const char* set :
       {"seed=4", "budget.stall=50", "budget.seconds=10", "study.target=1e-3", "study.starts=random",
        "study.target_scale=absolute", "study.stop_at_target=false", "study.time_limit=5"}) {
    const auto changed = KeysOf(PlanWith(set));
    ASSERT_EQ(changed.size(), keys.size());
    for (const auto& [name, key] : changed) EXPECT_NE(key, keys.at(name)) << name << " with " << set;
  }
  for (const auto& [name, key] : KeysOf(PlanWith("solvers.swarm.swarm_size=11"))) {
    EXPECT_EQ(key != keys.at(name), name.find("swarm") != std::string::npos) << name;
  }
  for (const auto& [name, key] : KeysOf(PlanWith("problems.bowl.dimension=3"))) {
    EXPECT_EQ(key != keys.at(name), name.starts_with("bowl")) << name;
  }
}

TEST(StudyPlan, Keys_StayWhereOtherJobsComeOrGo) {
  const auto keys = KeysOf(PlanOf(kPlan));
  for (const char* set : {"solvers.dogleg.type=dogleg", "study.part=[2, 3]", "study.repetitions=5",
                          "budget.evaluations=[10, 100, 1000]", "study.profile_targets=[0.5]", "name=other",
                          "problems.more={set: functions, function: ackley, dimension: 2}"}) {
    const auto more = KeysOf(PlanWith(set));
    EXPECT_GE(more.size(), keys.size());
    for (const auto& [name, key] : keys) EXPECT_EQ(more.at(name), key) << name << " with " << set;
  }
}

TEST(StudyPlan, JobSeeds_AreOneForAllContendersOfARepetition) {
  const StudyPlan plan = PlanOf(kPlan);
  std::map<std::string, std::set<std::uint64_t>> seeds;
  std::set<std::uint64_t> all;
  for (const StudyJob& job : plan.jobs) {
    seeds[plan.problems[job.problem].name + std::to_string(job.repetition)].insert(plan.JobSeed(job));
    all.insert(plan.JobSeed(job));
  }
  for (const auto& [name, values] : seeds) EXPECT_EQ(values.size(), 1U) << name;
  EXPECT_EQ(all.size(), 6U);
}

TEST(StudyPlan, SeedOfTheCommandLine_StandsForTheConfigs) {
  const StudyPlan plan = PlanOf(kPlan, {.set = "", .seed = 4, .threads = 1});
  EXPECT_EQ(plan.Csv(), PlanWith("seed=4").Csv());
  EXPECT_EQ(plan.config, PlanWith("seed=4").config);
}

TEST(StudyPlan, ResolvedConfig_ReadsBackToTheSamePlan) {
  const TempFolder folder;
  const std::string scan = folder.Write("leaf.xyz", "0 0 0\n1 0 0\n").string();
  for (const std::string& set : std::vector<std::string>{
           "",
           "study={starts: random, target: 0.1, target_scale: relative, time_limit: 7, stop_at_target: "
           "false}",
           "budget={seconds: 0.5, stall: 30}", "budget.evaluations=1e5",
           "solvers={swarm: {type: pso, swarm_size: 5, inertia: linear}, both: {type: pso_lm, lm: "
           "{max_iterations: 7}}}",
           "study.profile_targets=[0.5, 1e-9]", "problems={leaf: {set: leaf_weights, leaves: [1, 2]}}",
           "problems={scan: {set: leaf_weights, cloud: " + scan + "}, sheet: {set: sheet}}"}) {
    const StudyPlan plan = PlanWith(set);
    const StudyPlan back = PlanOf(plan.config);
    EXPECT_EQ(back.Csv(), plan.Csv()) << set;
    EXPECT_EQ(back.config, plan.config) << set;
    EXPECT_EQ(back.settings.profile_targets, plan.settings.profile_targets);
    EXPECT_EQ(back.settings.time_limit, plan.settings.time_limit);
  }
}

TEST(StudyPlan, Scan_IsToldByItsContent) {
  const TempFolder folder;
  const auto keys = [&](const std::string& scan) {
    return PlanWith("problems={scan: {set: sheet, cloud: " + scan + "}}").Csv();
  };
  const std::string first = keys(folder.Write("a.xyz", "0 0 0\n").string());
  EXPECT_EQ(keys(folder.Write("b.xyz", "0 0 0\n").string()), first);
  EXPECT_NE(keys(folder.Write("a.xyz", "0 0 1\n").string()), first);
  EXPECT_THROW(keys((folder / "absent.xyz").string()), ConfigError);
}

TEST(StudyPlan, OfAPart_IsThePlanOfTheWhole) {
  const StudyPlan part = PlanWith("study.part=[2, 3]");
  EXPECT_EQ(part.settings.part, 2);
  EXPECT_EQ(part.settings.parts, 3);
  EXPECT_EQ(part.Csv(), PlanOf(kPlan).Csv());
  EXPECT_EQ(part.config, PlanOf(kPlan).config);
}

TEST(StudyPlan, AdoptKeys_TakesThemFromAnotherVersionAndRefusesOtherJobs) {
  StudyPlan plan = PlanOf(kPlan);
  std::string csv = plan.Csv();
  csv.replace(csv.find('\n') + 1, 24, "aaaaaaaaaaaaaaaaaaaaaaaa");
  AdoptKeys(csv, "plan.csv", &plan);
  EXPECT_EQ(plan.jobs[0].key, "aaaaaaaaaaaaaaaaaaaaaaaa");
  EXPECT_EQ(plan.Csv(), csv);
  for (const std::string& other : {std::string(), std::string("key\n"), csv + "more,bowl,lm@100,2\n",
                                   csv.substr(0, csv.size() - 30), PlanWith("study.repetitions=3").Csv()}) {
    EXPECT_TRUE(Holds(MessageOf<InputError>([&] { AdoptKeys(other, "plan.csv", &plan); }),
                      "plan.csv: holds other jobs than config.yaml beside it says"));
  }
  EXPECT_EQ(plan.Csv(), csv) << "left alone where refused";
}

TEST(StudyPlan, TargetObjective_AllowsWhatItsScaleSays) {
  EXPECT_DOUBLE_EQ(TargetObjective(TargetScale::kStart, 0.1, 2, 12, 0), 3);
  EXPECT_DOUBLE_EQ(TargetObjective(TargetScale::kRelative, 0.1, -20, 12, 0), -18);
  EXPECT_DOUBLE_EQ(TargetObjective(TargetScale::kAbsolute, 0.1, 2, 12, 0), 2.1);
  EXPECT_DOUBLE_EQ(TargetObjective(TargetScale::kStart, 1e-9, 2, 12, 0.5), 2.5)
      << "no less than the rounding";
  for (const double start :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_DOUBLE_EQ(TargetObjective(TargetScale::kStart, 0.1, 2, start, 0.25), 2.25);
  }
}

}  // namespace
}  // namespace frond
