// SPDX-License-Identifier: BSD-3-Clause
#include "base/options.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/errors.h"

namespace frond {
namespace {

using Values = std::vector<double>;

// One option of each kind.
std::vector<OptionSpec> LeafSpecs() {
  return {
      {.name = "hinge", .type = OptionType::kFlag, .default_value = true, .help = ""},
      {.name = "slices",
       .type = OptionType::kInteger,
       .default_value = 50,
       .help = "",
       .minimum = 2,
       .maximum = 1000},
      {.name = "smoothing", .type = OptionType::kNumber, .default_value = 1e-8, .help = "", .minimum = 0},
      {.name = "label", .type = OptionType::kText, .default_value = std::string("leaf"), .help = ""},
      {.name = "parameters",
       .type = OptionType::kChoice,
       .default_value = std::string("chord"),
       .help = "",
       .words = {"uniform", "chord", "centripetal"}},
      {.name = "surface.control_points",
       .type = OptionType::kIntegers,
       .default_value = std::string("auto"),
       .help = "",
       .minimum = 4,
       .maximum = 200,
       .words = {"auto"},
       .min_size = 2,
       .max_size = 2},
      {.name = "weights",
       .type = OptionType::kNumbers,
       .default_value = Values{1},
       .help = "",
       .minimum = 0,
       .max_size = 9},
      {.name = "planes",
       .type = OptionType::kRows,
       .default_value = OptionRows{},
       .help = "",
       .maximum = 1e6,
       .min_size = 0,
       .max_size = 3,
       .row_size = 2},
  };
}

std::string MessageOfSet(const std::string& name, OptionValue value) {
  Options options(LeafSpecs());
  try {
    options.Set(name, std::move(value));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Options, NothingSet_ReturnsDefaults) {
  const Options options(LeafSpecs());
  EXPECT_TRUE(options.Flag("hinge"));
  EXPECT_EQ(options.Integer("slices"), 50);
  EXPECT_EQ(options.Number("smoothing"), 1e-8);
  EXPECT_EQ(options.Text("label"), "leaf");
  EXPECT_EQ(options.Text("parameters"), "chord");
  EXPECT_TRUE(options.HoldsWord("surface.control_points"));
  EXPECT_EQ(options.Numbers("weights"), Values{1});
  EXPECT_FALSE(options.IsSet("slices"));
}

TEST(Options, ValuesSet_AreReturned) {
  Options options(LeafSpecs());
  options.Set("hinge", false);
  options.Set("slices", 20);
  options.Set("slices", 30);
  options.Set("label", std::string("tea"));
  options.Set("parameters", std::string("uniform"));
  options.Set("surface.control_points", Values{5, 7});
  EXPECT_FALSE(options.Flag("hinge"));
  EXPECT_EQ(options.Integer("slices"), 30);
  EXPECT_EQ(options.Text("label"), "tea");
  EXPECT_EQ(options.Text("parameters"), "uniform");
  EXPECT_FALSE(options.HoldsWord("surface.control_points"));
  EXPECT_EQ(options.Integers("surface.control_points"), (std::vector<int>{5, 7}));
  EXPECT_TRUE(options.IsSet("slices"));
  EXPECT_FALSE(options.IsSet("weights"));
}

TEST(Options, NumericTypes_ConvertWhereNothingIsLost) {
  Options options(LeafSpecs());
  options.Set("smoothing", std::int64_t{2});  // a whole number where a number is asked for
  EXPECT_EQ(options.Number("smoothing"), 2.0);
  options.Set("slices", 12.0);
  EXPECT_EQ(options.Integer("slices"), 12);
  options.Set("weights", std::int64_t{3});  // one value where a list is asked for
  EXPECT_EQ(options.Numbers("weights"), Values{3});
  options.Set("weights", 0.5);
  EXPECT_EQ(options.Numbers("weights"), Values{0.5});
}

TEST(Options, Rows_AreReturned) {
  Options options(LeafSpecs());
  EXPECT_EQ(options.Rows("planes"), OptionRows{});
  options.Set("planes", OptionRows{{1, 2}, {3, 4}});
  EXPECT_EQ(options.Rows("planes"), (OptionRows{{1, 2}, {3, 4}}));
  options.Set("planes", Values{5, 6});  // one row where rows are asked for
  EXPECT_EQ(options.Rows("planes"), (OptionRows{{5, 6}}));
  options.Set("planes", Values{});
  EXPECT_EQ(options.Rows("planes"), OptionRows{});
}

TEST(Options, RowsOfWrongCountWidthOrValue_Throw) {
  const std::string expected = ", expected a list of 0 to 3 lists of 2 numbers <= 1e+06";
  EXPECT_EQ(MessageOfSet("planes", OptionRows{{1, 2}, {3}}), "option 'planes' is [[1, 2], [3]]" + expected);
  EXPECT_EQ(MessageOfSet("planes", OptionRows{{1, 2}, {3, 4}, {5, 6}, {7, 8}}),
            "option 'planes' is [[1, 2], [3, 4], [5, 6], [7, 8]]" + expected);
  EXPECT_EQ(MessageOfSet("planes", OptionRows{{1, 2e6}}), "option 'planes' is [[1, 2e+06]]" + expected);
  EXPECT_EQ(MessageOfSet("planes", 3.0), "option 'planes' is 3" + expected);
  EXPECT_EQ(MessageOfSet("weights", OptionRows{{1}}),
            "option 'weights' is [[1]], expected a list of 1 to 9 numbers >= 0");
}

TEST(Options, UnknownName_ThrowsWithNearestName) {
  EXPECT_EQ(MessageOfSet("slcies", 5), "unknown option 'slcies' (did you mean 'slices'?)");
  EXPECT_EQ(MessageOfSet("surface.control_point", 5),
            "unknown option 'surface.control_point' (did you mean 'surface.control_points'?)");
  EXPECT_EQ(MessageOfSet("zzzzzzzz", 5), "unknown option 'zzzzzzzz'");
}

TEST(Options, OutOfRange_ThrowsWithValueAndRange) {
  EXPECT_EQ(MessageOfSet("slices", 1), "option 'slices' is 1, expected an integer in [2, 1000]");
  EXPECT_EQ(MessageOfSet("slices", 1001), "option 'slices' is 1001, expected an integer in [2, 1000]");
  EXPECT_EQ(MessageOfSet("smoothing", -0.5), "option 'smoothing' is -0.5, expected a number >= 0");
  EXPECT_EQ(MessageOfSet("weights", Values{1, -2}),
            "option 'weights' is [1, -2], expected a list of 1 to 9 numbers >= 0");
}

TEST(Options, NotANumber_IsOutOfEveryRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(MessageOfSet("smoothing", nan), "accepted");
  EXPECT_NE(MessageOfSet("slices", nan), "accepted");
  EXPECT_NE(MessageOfSet("weights", Values{nan}), "accepted");
}

TEST(Options, WrongType_ThrowsWithWhatIsExpected) {
  EXPECT_EQ(MessageOfSet("hinge", 1), "option 'hinge' is 1, expected true or false");
  EXPECT_EQ(MessageOfSet("slices", 2.5), "option 'slices' is 2.5, expected an integer in [2, 1000]");
  EXPECT_EQ(MessageOfSet("slices", true), "option 'slices' is true, expected an integer in [2, 1000]");
  EXPECT_EQ(MessageOfSet("smoothing", std::string("much")),
            "option 'smoothing' is much, expected a number >= 0");
  EXPECT_EQ(MessageOfSet("smoothing", Values{1}), "option 'smoothing' is [1], expected a number >= 0");
  EXPECT_EQ(MessageOfSet("label", 3), "option 'label' is 3, expected text");
  EXPECT_EQ(MessageOfSet("parameters", 3),
            "option 'parameters' is 3, expected one of uniform, chord, centripetal");
}

TEST(Options, UnknownWord_ThrowsWithKnownOnes) {
  EXPECT_EQ(MessageOfSet("parameters", std::string("chrod")),
            "option 'parameters' is chrod, expected one of uniform, chord, centripetal");
  EXPECT_EQ(MessageOfSet("surface.control_points", std::string("many")),
            "option 'surface.control_points' is many, expected a list of 2 integers in [4, 200] or auto");
}

TEST(Options, ListOfWrongLength_Throws) {
  const std::string expected = ", expected a list of 2 integers in [4, 200] or auto";
  EXPECT_EQ(MessageOfSet("surface.control_points", Values{5}),
            "option 'surface.control_points' is [5]" + expected);
  EXPECT_EQ(MessageOfSet("surface.control_points", Values{5, 5, 5}),
            "option 'surface.control_points' is [5, 5, 5]" + expected);
  EXPECT_EQ(MessageOfSet("surface.control_points", Values{5, 5.5}),
            "option 'surface.control_points' is [5, 5.5]" + expected);
}

TEST(Options, RefusedValue_LeavesTheOldOne) {
  Options options(LeafSpecs());
  options.Set("slices", 20);
  EXPECT_THROW(options.Set("slices", 0), ConfigError);
  EXPECT_EQ(options.Integer("slices"), 20);
}

TEST(Options, ReadAsAnotherType_IsALogicError) {
  const Options options(LeafSpecs());
  EXPECT_THROW(options.Flag("slices"), std::logic_error);
  EXPECT_THROW(options.Integer("smoothing"), std::logic_error);
  EXPECT_THROW(options.Number("slices"), std::logic_error);
  EXPECT_THROW(options.Text("hinge"), std::logic_error);
  EXPECT_THROW(options.Numbers("surface.control_points"), std::logic_error);  // holds the word auto
  EXPECT_THROW(options.Integer("no_such"), std::logic_error);
  EXPECT_THROW(options.IsSet("no_such"), std::logic_error);
}

TEST(Options, DefaultOutOfItsOwnRange_IsALogicError) {
  const OptionSpec spec{
      .name = "n", .type = OptionType::kInteger, .default_value = 0, .help = "", .minimum = 1};
  EXPECT_THROW(Options({spec}), std::logic_error);
}

TEST(DescribeAccepted, EachBoundAlone_IsNamed) {
  OptionSpec spec{.name = "a", .type = OptionType::kNumber, .default_value = 0.0, .help = ""};
  EXPECT_EQ(DescribeAccepted(spec), "a number");
  spec.maximum = 2;
  EXPECT_EQ(DescribeAccepted(spec), "a number <= 2");
  spec.minimum = 1;
  EXPECT_EQ(DescribeAccepted(spec), "a number in [1, 2]");
}

TEST(DescribeAccepted, OpenEndedList_SaysOrMore) {
  const OptionSpec spec{.name = "a",
                        .type = OptionType::kIntegers,
                        .default_value = 0.0,
                        .help = "",
                        .max_size = std::size_t{1} << 30};
  EXPECT_EQ(DescribeAccepted(spec), "a list of 1 or more integers");
}

TEST(FormatValue, EachKind_ReadsAsAConfigWouldWriteIt) {
  EXPECT_EQ(FormatValue(true), "true");
  EXPECT_EQ(FormatValue(std::int64_t{-3}), "-3");
  EXPECT_EQ(FormatValue(0.1), "0.1");  // the shortest that reads back the same
  EXPECT_EQ(FormatValue(std::string("chord")), "chord");
  EXPECT_EQ(FormatValue(Values{3, 0.5}), "[3, 0.5]");
  EXPECT_EQ(FormatValue(Values{}), "[]");
  EXPECT_EQ(FormatValue(OptionRows{{1, 2}, {0.5, 4}}), "[[1, 2], [0.5, 4]]");
}

TEST(NearestWord, Typos_FindTheirWord) {
  const std::vector<std::string> words = {"lm", "dogleg", "pso", "pso_lm"};
  EXPECT_EQ(NearestWord("dogelg", words), "dogleg");  // a swap is one edit
  EXPECT_EQ(NearestWord("pso-lm", words), "pso_lm");
  EXPECT_EQ(NearestWord("ml", words), "lm");
  EXPECT_EQ(NearestWord("levenberg", words), "");
  EXPECT_EQ(NearestWord("xy", words), "");  // as far from "lm" as the word is long
  EXPECT_EQ(NearestWord("x", std::vector<std::string>{}), "");
}

}  // namespace
}  // namespace frond
