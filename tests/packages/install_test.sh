#!/usr/bin/env bash
# install_test.sh SOURCE: tests what scripts/install_packages.sh requests from apt, on a made-up release. It
# has `new`, `other` and `plain`, lacks `old`, and `here` is installed.
set -euo pipefail

folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/scripts" "$folder/bin"
cp "$1/scripts/install_packages.sh" "$folder/scripts/"
printf '%s\n' '[program]' 'plain' 'old | new' 'new | other' 'here' 'gone | here' '[tests]' 'other' \
  >"$folder/packages.txt"

fake() {
  printf '#!/bin/bash\n%s\n' "$2" >"$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}
fake dpkg-query 'echo "installed here"; exit 1'
# shellcheck disable=SC2016 # expanded in the fake programs
fake apt-cache 'case "$2" in new | other | plain) echo "  Candidate: 1.0" ;; old) echo "  Candidate: (none)" ;; esac'
# shellcheck disable=SC2016
fake apt-get 'echo "$*" >>"$(dirname "$0")/../requested"'
# shellcheck disable=SC2016
fake sudo '[[ "$1" == -n ]] && shift; exec "$@"'

requested() {
  rm -f "$folder/requested"
  PATH="$folder/bin:$PATH" "$folder/scripts/install_packages.sh" "$@" >/dev/null </dev/null
  tail -n 1 "$folder/requested"
}
expect() {
  [[ "$2" == "$1" ]] || { printf 'expected: %s\nfound:    %s\n' "$1" "$2" && exit 1; }
}
expect 'install -q -y --no-install-recommends plain new new' "$(requested program)"
expect 'install -q -y --no-install-recommends other' "$(requested tests)"
