#!/usr/bin/env bash
# scripts/test_package.sh <package.deb> [release]: installs the package in a bare Debian, in a folder of
# its own. There it runs the program and the Python package without a compiler, then compiles an example
# against the installed library. Needs root, debootstrap and the network.
set -euo pipefail

cd "$(dirname "$0")/.."
package="${1:?usage: scripts/test_package.sh <package.deb> [release]}"
release="${2:-$(sed -n s/^VERSION_CODENAME=//p /etc/os-release)}"
root="$(mktemp -d)"
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$root" "$root.log"' EXIT

debootstrap --variant=minbase "$release" "$root" >"$root.log" || {
  cat "$root.log" >&2
  exit 1
}
cp /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"
cp "$package" "$root/tmp/touchdown.deb"
cp -r examples/control_loop "$root/tmp/"
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/root bash -euc "cd /root; $1"; }

inside 'apt-get update -qq; apt-get install -y -qq --no-install-recommends /tmp/touchdown.deb >/dev/null'
inside '! command -v c++'
inside 'touchdown --version; touchdown run experiments/stairs.yaml --set test.runs=1 --set noise.seeds=1'
inside 'ls runs/stairs/latest/tables/results.csv runs/stairs/latest/report.html runs/stairs/latest/*/*.mp4'
inside 'python3 -c "import touchdown; print(touchdown.__version__)"'

inside 'apt-get install -y -qq --no-install-recommends cmake make g++ libeigen3-dev >/dev/null'
inside 'cmake -S /tmp/control_loop -B example; cmake --build example; ls example'
echo "the package installs and runs in a bare $release"
