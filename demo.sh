#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, makes a leaf scan with known truth, fits it in five ways and compares them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tools/setup.sh
cmake --preset release > /dev/null
cmake --build --preset release --target frond

frond=build/release/frond
runs=runs/demo
"$frond" synth leaf --seed=1 --out="$runs/scan" --overwrite --quiet
echo
echo "Scan: $runs/scan/scan.ply, 40,000 points, noise 0.05 mm; truth: $runs/scan/truth.ply, 100,000 clean points"
echo

# compare NAME CONFIG: fits the scan, then prints its row.
compare() {
  local folder
  folder="$runs/$(basename "$2" .yaml)"
  "$frond" fit "$2" --set="input.cloud=$runs/scan/scan.ply; input.truth=$runs/scan/truth.ply" \
    --out="$folder" --overwrite --quiet
  awk -v name="$1" -f tools/metrics_row.awk "$folder/metrics.json"
}

awk -f tools/metrics_row.awk
compare "paper" configs/leaf/paper.yaml
compare "paper + PSO" configs/leaf/paper_pso.yaml
compare "pso_lm" configs/leaf/paper_pso_lm.yaml
compare "lm, conforming" configs/leaf/conforming.yaml
compare "lm" configs/leaf/tea_leaf.yaml

cat <<END

RMSE and maximum: of the truth's points to the surface. Seconds: reading, fit and judgement, without writing.
Runs: $runs/{paper,paper_pso,paper_pso_lm,conforming,tea_leaf}; the surface to take on: $runs/tea_leaf/surface.step
Your own scan: $frond fit configs/leaf/tea_leaf.yaml --set="input.cloud=my_scan.ply"
END
