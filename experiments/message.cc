// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/message.h"

#include <iostream>

namespace frond {

void PrintMessage(std::string message) {
  for (char& c : message) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) c = '?';
  }
  std::cerr << "frond: " << message << "\n";
}

}  // namespace frond
