#!/usr/bin/env bash
# scripts/lint.sh <build directory>: checks formatting, every file that the build compiles with
# clang-tidy, and the shell scripts. Silent about what is good; exits with 1 if anything is not.
set -euo pipefail

cd "$(dirname "$0")/.."
build="${1:?usage: scripts/lint.sh <build directory>}"
jobs="${JOBS:-$(nproc)}"

# A checkout may belong to another user than the one who checks it, as in a container.
tracked() { git -c safe.directory='*' ls-files -z -- "$@"; }

failed=()

echo "clang-format"
tracked '*.cpp' '*.hpp' | xargs -0 -r clang-format --dry-run -Werror || failed+=(clang-format)

echo "shellcheck"
tracked '*.sh' '.ci/run' | xargs -0 -r shellcheck || failed+=(shellcheck)

# One process per file; clang's count of the warnings that it hid in other people's headers is noise.
tidy() {
  local report status=0
  report="$(clang-tidy --quiet --warnings-as-errors='*' -p "$1" "$2" 2>&1)" || status=$?
  grep -vE '^[0-9]+ warnings?( and [0-9]+ errors?)? generated\.$' <<<"$report" || true
  return "$status"
}
export -f tidy

# Clang cannot read g++'s precompiled headers, and without them a missing include shows.
commands="$build/lint/compile_commands.json"
mkdir -p "$build/lint"
sed -E 's/ -(Winvalid-pch|fpch-preprocess|include [^ ]*cmake_pch\.hxx)//g' \
  "$build/compile_commands.json" >"$commands"

echo "clang-tidy"
sed -n 's/^ *"file": "\(.*\)",\?$/\1/p' "$commands" | grep -v cmake_pch | sort -u |
  xargs -r -d '\n' -P "$jobs" -n 1 bash -c 'tidy "$@"' tidy "$build/lint" || failed+=(clang-tidy)

if ((${#failed[@]})); then
  echo "lint: failed: ${failed[*]}" >&2
  exit 1
fi
echo "lint: all good"
