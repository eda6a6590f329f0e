// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/errors.h"

namespace frond {

// body(), its InputErrors and FitErrors with "NAME: " in front: libraries do not know whose data they have.
template <typename Body>
auto NameErrors(const std::string& name, const Body& body) {
  try {
    return body();
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  } catch (const FitError& error) {
    throw FitError(name + ": " + error.what());
  }
}

}  // namespace frond
