#!/usr/bin/env bash
# scripts/lint.sh <build directory>: checks formatting, runs clang-tidy on every file that the build
# compiles, and checks the shell scripts. Reports problems only; exits with 1 if there are any.
set -euo pipefail

cd "$(dirname "$0")/.."
build="${1:?usage: scripts/lint.sh <build directory>}"
jobs="${JOBS:-$(nproc)}"

# The checkout may belong to another user, as in a container.
tracked() { git -c safe.directory='*' ls-files -z -- "$@"; }

failed=()

echo "clang-format"
tracked '*.cpp' '*.hpp' | xargs -0 -r clang-format --dry-run -Werror || failed+=(clang-format)

echo "shellcheck"
tracked '*.sh' '.ci/run' | xargs -0 -r shellcheck || failed+=(shellcheck)

echo "clang-tidy"
JOBS="$jobs" scripts/tidy.py "$build/compile_commands.json" || failed+=(clang-tidy)

if ((${#failed[@]})); then
  echo "lint: failed: ${failed[*]}" >&2
  exit 1
fi
echo "lint: all good"
