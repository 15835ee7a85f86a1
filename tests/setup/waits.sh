#!/usr/bin/env bash
# Measures how long a newcomer waits on this machine, in a bare Debian without packages and object cache:
#
#   tests/setup/waits.sh [RELEASE]       RELEASE of Debian, such as bookworm or trixie (default: of this machine)
#
# Run it as root on an otherwise idle machine; needs the package debootstrap, and takes about 20 minutes. Prints
# a Markdown table: wall time, and processor time in seconds. The root is removed at the end.
set -euo pipefail
TIMEFORMAT="%R %U %S"
project=$(cd "$(dirname "$0")/../.." && pwd)
release=${1-$(. /etc/os-release && echo "$VERSION_CODENAME")}
root=$(mktemp -d)
trap 'umount "$root/proc" "$root/dev" 2>/dev/null; rm -rf --one-file-system "$root"' EXIT
debootstrap --variant=minbase "$release" "$root" >"$root.log" 2>&1 || { tail "$root.log"; exit 1; }
rm -f "$root.log"
cp /etc/apt/apt.conf.d/* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
git clone -q "$project" "$root/bendlab"

inside() { chroot "$root" bash -c "cd /bendlab && $1"; }

# row NAME COMMAND: runs the command in the root, and prints its row, and what the script said about the build.
row() {
  local times
  times=$({ time inside "$2" >"$root/tmp/out" 2>&1; } 2>&1) || tail -n 40 "$root/tmp/out"
  awk -v name="$1" -v command="$2" '{ printf "| %s | `%s` | %d min %02d s | %d |\n", name, command,
    $1 / 60, $1 % 60, $2 + $3 }' <<<"$times"
  grep -E '^bendlab: the build takes' "$root/tmp/out" || true
}

echo "$(lscpu | sed -n 's/^Model name: *//p'), $(nproc) cores, Debian $release, $(git -C "$project" log -1 --format=%h)"
echo
echo "| what | command | wall time | processor time, s |"
echo "|---|---|---|---|"
row "packages, and the first program" "./bendlab --version"
row "a changed line in the solver, program again" \
  "echo >>lib/bendlab/solver/elastic_system.cpp; ./bendlab --version"
row "tests: build the rest" "./bendlab test -N"
row "tests: run" "./bendlab test"
