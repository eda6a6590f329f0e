// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace frond {

// Disjoint sets of 0 … count − 1 (Tarjan 1975, by compressed paths) whose members are of one of two kinds
// relative to each other.
class ParitySets {
 public:
  explicit ParitySets(std::size_t count) : parent_(count), odd_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  // The set's lowest member; the kind relative to it goes to `odd`.
  int Find(int member, bool* odd = nullptr) {
    int root = member;
    bool sum = false;
    while (parent_[At(root)] != root) {
      sum ^= odd_[At(root)] != 0;
      root = parent_[At(root)];
    }
    if (odd != nullptr) *odd = sum;
    while (member != root && parent_[At(member)] != root) {
      const bool own = odd_[At(member)] != 0;
      const int above = parent_[At(member)];
      parent_[At(member)] = root;
      odd_[At(member)] = sum;
      sum ^= own;
      member = above;
    }
    return root;
  }

  // False where a and b are known to be of the other relation.
  bool Join(int a, int b, bool differ = false) {
    bool odd_a = false, odd_b = false;
    int root_a = Find(a, &odd_a), root_b = Find(b, &odd_b);
    if (root_a == root_b) return (odd_a != odd_b) == differ;
    if (root_b < root_a) std::swap(root_a, root_b);
    parent_[At(root_b)] = root_a;
    odd_[At(root_b)] = (odd_a != odd_b) != differ;
    return true;
  }

 private:
  static std::size_t At(int i) { return static_cast<std::size_t>(i); }

  std::vector<int> parent_;
  std::vector<std::uint8_t> odd_;
};

}  // namespace frond
