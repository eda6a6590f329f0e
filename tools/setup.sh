#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages of packages.txt that are missing. Does nothing, and needs no network, where none is.
set -euo pipefail
export LC_ALL=C  # comm and sort have to agree

fail() {
  echo "setup: $1" >&2
  exit 1
}

list="$(dirname "${BASH_SOURCE[0]}")/../packages.txt"
mapfile -t packages < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$list")
[[ ${#packages[@]} -gt 0 ]] || fail "no packages in $list"
command -v dpkg-query > /dev/null || fail "this is no Debian system; install what packages.txt names by hand"

# dpkg-query fails for packages it has never heard of: they are missing, like those removed or half installed.
installed="$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${packages[@]}" 2> /dev/null \
  | awk '$2 == "installed" { print $1 }' || true)"
mapfile -t missing < <(comm -23 <(printf '%s\n' "${packages[@]}" | LC_ALL=C sort -u) \
  <(printf '%s\n' "$installed" | LC_ALL=C sort -u))
[[ ${#missing[@]} -eq 0 ]] && exit 0

as_root=()
if [[ "$(id -u)" -ne 0 ]]; then
  command -v sudo > /dev/null || fail "run as root, or install sudo; missing: ${missing[*]}"
  as_root=(sudo)
fi
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@"
}
echo "setup: installing ${missing[*]}"
apt update || fail "apt-get update failed; is there a network? Missing: ${missing[*]}"
apt install --no-install-recommends "${missing[@]}" || fail "apt-get could not install: ${missing[*]}"
