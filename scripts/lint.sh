#!/usr/bin/env bash
# scripts/lint.sh <build directory> [<date>]: checks formatting and the shell scripts, and runs clang-tidy on every
# file that the build compiles, or on those that commits since the date have changed. Reports problems only; exits
# with 1 if there are any.
set -euo pipefail

cd "$(dirname "$0")/.."
build="${1:?usage: scripts/lint.sh <build directory> [<date>]}"
since="${2:-}"
jobs="${JOBS:-$(nproc)}"

# The checkout may belong to another user, as in a container.
git() { command git -c safe.directory='*' "$@"; }
tracked() { git ls-files -z -- "$@"; }
# What commits since the date, or nobody yet has committed, and which still exists.
changed() {
  { git log --since="$since" --format= --name-only; git diff --name-only HEAD; } | sort -u |
    while read -r file; do [[ $file == *.?pp && -f $file ]] && echo "$file"; done || true
}

failed=()

echo "clang-format"
tracked '*.cpp' '*.hpp' | xargs -0 -r clang-format --dry-run -Werror || failed+=(clang-format)

echo "shellcheck"
tracked '*.sh' '.ci/run' | xargs -0 -r shellcheck || failed+=(shellcheck)

files=()
[[ -z "$since" ]] || mapfile -t files < <(changed)
echo "clang-tidy${since:+ of ${#files[@]} files changed since $since}"
[[ -n "$since" && ${#files[@]} -eq 0 ]] ||
  JOBS="$jobs" scripts/tidy.py "$build/compile_commands.json" "${files[@]}" || failed+=(clang-tidy)

if ((${#failed[@]})); then
  echo "lint: failed: ${failed[*]}" >&2
  exit 1
fi
echo "lint: all good"
