// SPDX-License-Identifier: BSD-3-Clause
#include "base/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/errors.h"

namespace frond {
namespace {

bool IsWhole(double x) { return std::isfinite(x) && x == std::floor(x) && std::abs(x) < 9e15; }

std::string FormatNumber(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), x).ptr;
  return {text, end};
}

bool InRange(const OptionSpec& spec, double x) { return x >= spec.minimum && x <= spec.maximum; }

bool HasWord(const OptionSpec& spec, const std::string& word) {
  return std::find(spec.words.begin(), spec.words.end(), word) != spec.words.end();
}

bool IsList(OptionType type) { return type == OptionType::kIntegers || type == OptionType::kNumbers; }

bool IsIntegral(OptionType type) { return type == OptionType::kInteger || type == OptionType::kIntegers; }

// The value in the type that `spec` stores, or an unchanged one that Accepts will turn down.
OptionValue Normalised(const OptionSpec& spec, OptionValue value) {
  if (spec.type == OptionType::kNumber || IsList(spec.type)) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) value = static_cast<double>(*whole);
  }
  if (spec.type == OptionType::kInteger) {
    if (const auto* x = std::get_if<double>(&value); x != nullptr && IsWhole(*x)) {
      value = static_cast<std::int64_t>(*x);
    }
  }
  if (IsList(spec.type)) {
    if (const auto* x = std::get_if<double>(&value)) value = std::vector<double>{*x};
  }
  if (spec.type == OptionType::kRows) {
    if (const auto* row = std::get_if<std::vector<double>>(&value)) {
      value = row->empty() ? OptionRows() : OptionRows{*row};
    }
  }
  return value;
}

bool Accepts(const OptionSpec& spec, const OptionValue& value) {
  if (const auto* word = std::get_if<std::string>(&value)) {
    return spec.type == OptionType::kText || HasWord(spec, *word);
  }
  switch (spec.type) {
    case OptionType::kFlag:
      return std::holds_alternative<bool>(value);
    case OptionType::kInteger: {
      const auto* x = std::get_if<std::int64_t>(&value);
      return x != nullptr && InRange(spec, static_cast<double>(*x));
    }
    case OptionType::kNumber: {
      const auto* x = std::get_if<double>(&value);
      return x != nullptr && InRange(spec, *x);
    }
    case OptionType::kIntegers:
    case OptionType::kNumbers: {
      const auto* list = std::get_if<std::vector<double>>(&value);
      return list != nullptr && list->size() >= spec.min_size && list->size() <= spec.max_size &&
             std::all_of(list->begin(), list->end(), [&](double x) {
               return InRange(spec, x) && (!IsIntegral(spec.type) || IsWhole(x));
             });
    }
    case OptionType::kRows: {
      const auto* rows = std::get_if<OptionRows>(&value);
      return rows != nullptr && rows->size() >= spec.min_size && rows->size() <= spec.max_size &&
             std::all_of(rows->begin(), rows->end(), [&](const std::vector<double>& row) {
               return row.size() == spec.row_size &&
                      std::all_of(row.begin(), row.end(), [&](double x) { return InRange(spec, x); });
             });
    }
    case OptionType::kText:
    case OptionType::kChoice:
      return false;
  }
  return false;
}

std::size_t EditDistance(std::string_view a, std::string_view b) {
  // Optimal string alignment: a swap of neighbours ("slcies") counts as one edit.
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    before_last = std::exchange(last, row);
  }
  return last[b.size()];
}

// "2", "2 to 9", "1 or more": how many values or rows a list may hold.
std::string DescribeCount(const OptionSpec& spec) {
  std::string text = std::to_string(spec.min_size);
  if (spec.max_size > spec.min_size) {
    text += spec.max_size > 1000000 ? " or more" : " to " + std::to_string(spec.max_size);
  }
  return text;
}

std::string FormatList(const std::vector<double>& list) {
  std::string text = "[";
  for (const double x : list) text += (text.size() > 1 ? ", " : "") + FormatNumber(x);
  return text + "]";
}

template <typename T>
const T& Typed(const OptionValue& value, const std::string& name) {
  const T* typed = std::get_if<T>(&value);
  if (typed == nullptr) throw std::logic_error("option '" + name + "' read as another type than it has");
  return *typed;
}

}  // namespace

std::string DescribeAccepted(const OptionSpec& spec) {
  std::string words;
  for (const std::string& word : spec.words) words += (words.empty() ? "" : ", ") + word;
  std::string text;
  switch (spec.type) {
    case OptionType::kFlag:
      return "true or false";
    case OptionType::kText:
      return "text";
    case OptionType::kChoice:
      return "one of " + words;
    case OptionType::kInteger:
      text = "an integer";
      break;
    case OptionType::kNumber:
      text = "a number";
      break;
    case OptionType::kIntegers:
    case OptionType::kNumbers:
      text = "a list of " + DescribeCount(spec);
      text += spec.type == OptionType::kIntegers ? " integers" : " numbers";
      break;
    case OptionType::kRows:
      text = "a list of " + DescribeCount(spec) + " lists of " + std::to_string(spec.row_size) + " numbers";
      break;
  }
  const bool below = std::isfinite(spec.minimum), above = std::isfinite(spec.maximum);
  if (below && above) text += " in [" + FormatNumber(spec.minimum) + ", " + FormatNumber(spec.maximum) + "]";
  if (below && !above) text += " >= " + FormatNumber(spec.minimum);
  if (!below && above) text += " <= " + FormatNumber(spec.maximum);
  if (!words.empty()) text += " or " + words;
  return text;
}

std::string FormatValue(const OptionValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return FormatNumber(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return FormatList(*list);
  std::string rows = "[";
  for (const std::vector<double>& row : std::get<OptionRows>(value)) {
    rows += (rows.size() > 1 ? ", " : "") + FormatList(row);
  }
  return rows + "]";
}

std::string NearestWord(std::string_view word, std::span<const std::string> candidates) {
  std::string nearest;
  std::size_t best = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = EditDistance(word, candidate);
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

Options::Options(std::vector<OptionSpec> specs) : specs_(std::move(specs)) {
  for (OptionSpec& spec : specs_) {
    spec.default_value = Normalised(spec, std::move(spec.default_value));
    if (!Accepts(spec, spec.default_value)) {
      throw std::logic_error("option '" + spec.name + "': its default is out of its own range");
    }
  }
}

void Options::Set(const std::string& name, OptionValue value) {
  const auto spec = std::find_if(specs_.begin(), specs_.end(), [&](const auto& s) { return s.name == name; });
  if (spec == specs_.end()) {
    std::vector<std::string> names;
    for (const OptionSpec& s : specs_) names.push_back(s.name);
    const std::string nearest = NearestWord(name, names);
    throw ConfigError("unknown option '" + name + "'" +
                      (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)"));
  }
  value = Normalised(*spec, std::move(value));
  if (!Accepts(*spec, value)) {
    throw ConfigError("option '" + name + "' is " + FormatValue(value) + ", expected " +
                      DescribeAccepted(*spec));
  }
  values_.insert_or_assign(name, std::move(value));
}

bool Options::IsSet(const std::string& name) const {
  Spec(name);
  return values_.contains(name);
}

const OptionSpec& Options::Spec(const std::string& name) const {
  const auto spec = std::find_if(specs_.begin(), specs_.end(), [&](const auto& s) { return s.name == name; });
  if (spec == specs_.end()) throw std::logic_error("no option is named '" + name + "'");
  return *spec;
}

const OptionValue& Options::Value(const std::string& name) const {
  const OptionSpec& spec = Spec(name);
  const auto value = values_.find(name);
  return value == values_.end() ? spec.default_value : value->second;
}

bool Options::Flag(const std::string& name) const { return Typed<bool>(Value(name), name); }

int Options::Integer(const std::string& name) const {
  return static_cast<int>(Typed<std::int64_t>(Value(name), name));
}

double Options::Number(const std::string& name) const { return Typed<double>(Value(name), name); }

const std::string& Options::Text(const std::string& name) const {
  return Typed<std::string>(Value(name), name);
}

bool Options::HoldsWord(const std::string& name) const {
  return std::holds_alternative<std::string>(Value(name));
}

std::vector<int> Options::Integers(const std::string& name) const {
  std::vector<int> list;
  for (const double x : Numbers(name)) list.push_back(static_cast<int>(x));
  return list;
}

const std::vector<double>& Options::Numbers(const std::string& name) const {
  return Typed<std::vector<double>>(Value(name), name);
}

const OptionRows& Options::Rows(const std::string& name) const {
  return Typed<OptionRows>(Value(name), name);
}

}  // namespace frond
