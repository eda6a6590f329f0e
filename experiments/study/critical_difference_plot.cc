// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/critical_difference_plot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiments/study/display_number.h"
#include "experiments/study/markup_text.h"
#include "experiments/study/svg_plot.h"

namespace frond {
namespace {

constexpr double kWidth = 560, kLeft = 150, kRight = 410;  // the axis of ranks
constexpr double kBarRow = 9, kLabelRow = 20;
constexpr std::size_t kLabelWidth = 19;  // characters

class Diagram {
 public:
  Diagram(const std::vector<RankedSeries>& solvers, double critical_difference)
      : solvers_(solvers), critical_difference_(critical_difference), order_(solvers.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return solvers[a].mean_rank < solvers[b].mean_rank;
    });
  }

  std::string Svg(const std::vector<std::vector<std::size_t>>& groups) {
    DrawScale();
    DrawBars(groups);
    DrawSolvers(axis_ + 14 + kBarRow * static_cast<double>(bars_));
    const std::string title = "Critical-difference diagram: mean ranks, best left";
    return "<svg xmlns='http://www.w3.org/2000/svg' width='" + Pixels(kWidth) + "' height='" +
           Pixels(bottom_) + "' viewBox='0 0 " + Pixels(kWidth) + " " + Pixels(bottom_) +
           "' font-family='system-ui, sans-serif' font-size='12' role='img' aria-label='" + EscapeXml(title) +
           "'>\n<title>" + EscapeXml(title) +
           "</title>\n<rect width='100%' height='100%' fill='white' class='paper'/>\n" + svg_ + "</svg>\n";
  }

 private:
  double X(double rank) const {
    return kLeft + (kRight - kLeft) * (rank - 1) / static_cast<double>(solvers_.size() - 1);
  }

  void Line(double x1, double y1, double x2, double y2, double width) {
    svg_ += "<line x1='" + Pixels(x1) + "' y1='" + Pixels(y1) + "' x2='" + Pixels(x2) + "' y2='" +
            Pixels(y2) + "' stroke='#555' class='frame' stroke-width='" + Pixels(width) + "'/>";
  }

  void Text(double x, double y, const char* anchor, const std::string& text) {
    svg_ += "<text x='" + Pixels(x) + "' y='" + Pixels(y) + "' text-anchor='" + anchor +
            "' fill='#222' class='ink'>" + EscapeXml(text) + "</text>";
  }

  void DrawScale() {
    if (std::isfinite(critical_difference_) && critical_difference_ > 0) {
      const double end = std::min(X(1 + critical_difference_), kWidth - 8);
      Line(kLeft, 24, end, 24, 1.5);
      Line(kLeft, 20, kLeft, 28, 1.5);
      const bool fits = X(1 + critical_difference_) <= end;
      if (fits) Line(end, 20, end, 28, 1.5);
      Text(kLeft, 14, "start",
           "critical difference " + ThreeDigits(critical_difference_) + (fits ? "" : " (wider)"));
    }
    Line(kLeft, axis_, kRight, axis_, 1.5);
    const std::size_t k = solvers_.size(), stride = (k + 9) / 10;
    for (std::size_t rank = 1; rank <= k; ++rank) {
      const double x = X(static_cast<double>(rank));
      const bool labelled = (rank - 1) % stride == 0;
      Line(x, axis_ - (labelled ? 6 : 3), x, axis_, 1);
      if (labelled) Text(x, axis_ - 10, "middle", std::to_string(rank));
    }
    svg_ += "\n";
  }

  // Each group's bar in the first row where it meets no other.
  void DrawBars(const std::vector<std::vector<std::size_t>>& groups) {
    std::vector<double> row_ends;
    for (const std::vector<std::size_t>& group : groups) {
      if (group.size() < 2) continue;
      double low = solvers_[group[0]].mean_rank, high = low;
      for (const std::size_t k : group) {
        low = std::min(low, solvers_[k].mean_rank);
        high = std::max(high, solvers_[k].mean_rank);
      }
      const double from = X(low) - 4, to = X(high) + 4;
      std::size_t row = 0;
      while (row < row_ends.size() && from <= row_ends[row] + 4) ++row;
      if (row == row_ends.size()) row_ends.push_back(to);
      row_ends[row] = to;
      const double y = axis_ + 11 + kBarRow * static_cast<double>(row);
      Line(from, y, to, y, 4);
    }
    bars_ = row_ends.size();
    svg_ += "\n";
  }

  // The better half's labels to the left, the others' to the right; the outermost highest, so that no lines
  // cross.
  void DrawSolvers(double top) {
    const std::size_t left = (order_.size() + 1) / 2;
    for (std::size_t place = 0; place < order_.size(); ++place) {
      const RankedSeries& solver = solvers_[order_[place]];
      const bool on_left = place < left;
      const std::size_t row = on_left ? place : order_.size() - 1 - place;
      const double x = X(solver.mean_rank), y = top + 8 + kLabelRow * static_cast<double>(row);
      const double end = on_left ? kLeft - 8 : kRight + 8;
      const std::string stroke = SeriesStroke(order_[place]);
      svg_ += "<path d='M" + Pixels(x) + " " + Pixels(axis_) + "V" + Pixels(y) + "H" + Pixels(end) +
              "' fill='none' " + stroke + " stroke-width='1.5'><title>" + EscapeXml(solver.label) +
              "</title></path>";
      const std::string rank = ThreeDigits(solver.mean_rank);
      const std::string label = Shortened(solver.label, kLabelWidth - 6);
      Text(on_left ? end - 4 : end + 4, y + 4, on_left ? "end" : "start",
           on_left ? label + "  " + rank : rank + "  " + label);
      svg_ += "\n";
    }
    bottom_ = top + 20 + kLabelRow * static_cast<double>(left);
  }

  const std::vector<RankedSeries>& solvers_;
  double critical_difference_;
  std::vector<std::size_t> order_;
  std::string svg_;
  std::size_t bars_ = 0;
  double axis_ = 60, bottom_ = 0;
};

}  // namespace

std::string CriticalDifferenceSvg(const std::vector<RankedSeries>& solvers, double critical_difference,
                                  const std::vector<std::vector<std::size_t>>& groups) {
  const bool finite = std::all_of(solvers.begin(), solvers.end(),
                                  [](const RankedSeries& s) { return std::isfinite(s.mean_rank); });
  if (solvers.size() < 2 || !finite) return "";
  return Diagram(solvers, critical_difference).Svg(groups);
}

}  // namespace frond
