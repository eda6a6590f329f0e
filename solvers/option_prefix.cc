// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/option_prefix.h"

#include <utility>

namespace frond {

std::vector<OptionSpec> WithPrefix(const std::string& prefix, std::vector<OptionSpec> specs) {
  for (OptionSpec& spec : specs) spec.name = prefix + "." + spec.name;
  return specs;
}

Options WithoutPrefix(const std::string& prefix, const std::vector<OptionSpec>& specs,
                      const Options& options) {
  Options inner(specs);
  for (const OptionSpec& spec : specs) {
    const std::string name = prefix + "." + spec.name;
    if (options.IsSet(name)) inner.Set(spec.name, options.Value(name));
  }
  return inner;
}

}  // namespace frond
