# SPDX-License-Identifier: BSD-3-Clause
# One row of a Markdown table from a run's metrics.json; without a file, the table's head. -v name=METHOD.
BEGIN {
  row = "| %-14s | %14s | %8s | %10s | %11s | %7s |\n"
  if (ARGC == 1) {
    printf row, "method", "control points", "RMSE mm", "maximum mm", "evaluations", "seconds"
    print "|:---------------|---------------:|---------:|-----------:|------------:|--------:|"
    exit
  }
}
{ value = $2; sub(/,$/, "", value) }
$1 == "\"control_points\":" { getline u; getline v; net = (u + 0) " x " (v + 0) }
$1 == "\"truth_rmse\":" { rmse = value }
$1 == "\"truth_max\":" { maximum = value }
$1 == "\"evaluations\":" { evaluations = value }
/^  "seconds":/ { seconds = value }
END {
  if (ARGC > 1) {
    printf row, name, net, sprintf("%.4f", rmse), sprintf("%.3f", maximum), evaluations, sprintf("%.2f", seconds)
  }
}
