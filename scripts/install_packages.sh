#!/usr/bin/env bash
# install_packages.sh [section...]: installs the missing Debian packages of these sections of
# packages.txt (all sections by default), of `a | b` the first that this release has. If none is missing,
# it does nothing, and needs neither network nor root.
set -euo pipefail

list="$(dirname "$0")/../packages.txt"
mapfile -t wanted < <(
  sed -e 's/#.*//' -e 's/[[:space:]]//g' "$list" | awk -v named=" $* " '
    /^\[.*\]$/ { section = " " substr($0, 2, length($0) - 2) " "; next }
    NF && (named == "  " || index(named, section))')

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  {
    echo "touchdown: this is not a Debian system, so its packages cannot be installed from here."
    echo "Install the equivalents of these Debian packages:"
    printf '  %s\n' "${wanted[@]}"
    echo "and build with: cmake --preset program && cmake --build --preset program"
  } >&2
  exit 1
fi

# dpkg-query fails for unknown names; those are simply not installed.
mapfile -t names < <(printf '%s\n' "${wanted[@]}" | tr '|' '\n')
installed="$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${names[@]}" 2>/dev/null || true)"
missing=()
for package in "${wanted[@]}"; do
  grep -qxE "installed (${package//+/\\+})" <<<"$installed" || missing+=("$package")
done
((${#missing[@]})) || exit 0

# Lists the missing packages, of each a|b the first that this release has.
choose() {
  local package name
  for package in "${missing[@]}"; do
    name="${package%%|*}"
    if [[ "$package" == *"|"* ]]; then
      for name in ${package//|/ }; do
        [[ "$(LC_ALL=C apt-cache policy "$name")" == *"Candidate: "[^\(]* ]] && break
        name="${package%%|*}" # none: apt reports the first as missing
      done
    fi
    echo "$name"
  done
}

echo "touchdown: ${#missing[@]} Debian packages are missing: ${missing[*]}"

as_root=(env)
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "touchdown: neither root nor sudo here. Ask an administrator to run:" >&2
    echo "  apt-get install --no-install-recommends $(choose | paste -sd ' ')" >&2
    exit 1
  fi
  as_root=(sudo)
  [[ -t 0 ]] || as_root+=(-n) # without a terminal, no password can be typed
  as_root+=(env)
fi
as_root+=(DEBIAN_FRONTEND=noninteractive)

echo "touchdown: installing them with apt-get (with their dependencies, up to 2 GB of disk)"
if ! { "${as_root[@]}" apt-get update -q &&
  mapfile -t chosen < <(choose) &&
  "${as_root[@]}" apt-get install -q -y --no-install-recommends "${chosen[@]}"; }; then
  echo "touchdown: apt-get could not install them (see above). Needed: ${missing[*]}" >&2
  exit 1
fi
