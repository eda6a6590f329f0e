#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds everything and runs every test. Arguments go to ctest: ./test.sh -R leaf
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tools/setup.sh
cmake --preset release
cmake --build --preset release
exec ctest --test-dir build/release -j2 --output-on-failure "$@"
