#!/usr/bin/env bash
# ./dev fresh 12|13 [--ccache DIR] [COMMAND...]: what somebody sees who clones this repository in a new Debian.
# Each COMMAND is what follows ./dev, in quotes where it has several words. HEAD is cloned, not the working tree.
set -euo pipefail
sources=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ "$(id -u)" -eq 0 ] || exec sudo --preserve-env=HOME "${BASH_SOURCE[0]}" "$@"

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }
fail() { say "$*"; exit 1; }

declare -A suites=([12]=bookworm [13]=trixie)
version=${1:-}
suite=${suites[${version:-none}]:-}
[ -n "$suite" ] || fail "write for example: ./dev fresh 13 (versions: 12, 13)"
shift
ccache=
if [ "${1:-}" = --ccache ]; then
  [ -n "${2:-}" ] || fail "--ccache needs a folder: ./dev fresh $version --ccache ~/.cache/ccache"
  ccache=$(mkdir -p "$2" && cd "$2" && pwd)
  shift 2
fi
[ $# -gt 0 ] || set -- demo test
log=$sources/out/fresh-$version.log
base=$HOME/.cache/ombre/debian-$version.tar.gz

mkdir -p "$sources/out" "$(dirname "$base")"
: >"$log"
root=$(mktemp -d "/var/tmp/ombre-debian-$version.XXXXXX")
# Mounts are in a namespace of their own (below), so nothing but files is left here.
trap 'rm -rf --one-file-system "$root"' EXIT
trap 'exit 130' INT TERM

if [ ! -f "$base" ]; then
  command -v debootstrap >/dev/null || { apt-get update -qq && apt-get install -y -qq debootstrap >/dev/null; }
  say "fetching Debian $version ($suite)"
  debootstrap --variant=minbase --include=git,bash,ca-certificates "$suite" "$root" >>"$log" 2>&1 || fail "see $log"
  rm -f "$root"/var/cache/apt/archives/*.deb
  tar -C "$root" -czf "$base.new" . && mv "$base.new" "$base"
else
  tar -C "$root" -xzf "$base"
fi
chmod 755 "$root" # apt downloads as another user
git -c safe.directory="*" -C "$sources" diff --quiet HEAD || say "the working tree has changes, which HEAD has not"
git -c safe.directory="*" clone --quiet --no-local "$sources" "$root/root/ombre"
cp /etc/resolv.conf /etc/hosts "$root/etc/"

# Networks that need a proxy, or a certificate of their own, need them there too.
environment=(HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM=dumb)
for name in http_proxy https_proxy no_proxy SSL_CERT_FILE NODE_EXTRA_CA_CERTS PIP_CERT PIP_INDEX_URL npm_config_registry; do
  [ -n "${!name:-}" ] || continue
  environment+=("$name=${!name}")
  [ ! -f "${!name}" ] || install -D -m 644 "${!name}" "$root${!name}"
done
[ -z "$ccache" ] || { environment+=(CCACHE_DIR=/ccache); mkdir "$root/ccache"; }

# What runs there is gone with this script, as are its mounts.
inside() {
  unshare --mount --pid --fork --kill-child bash -c '
    set -e
    root=$1 ccache=$2
    shift 2
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    [ -z "$ccache" ] || mount --bind "$ccache" "$root/ccache"
    chroot "$root" env -i "$@"' inside "$root" "$ccache" "${environment[@]}" "$@"
}

for command in "$@"; do
  printf '\n== ./dev %s\n' "$command" >>"$log"
  say "./dev $command (tail -f $log shows more)"
  SECONDS=0
  status=0
  # shellcheck disable=SC2016
  inside bash -c "cd /root/ombre && time ./dev $command" >>"$log" 2>&1 </dev/null || status=$?
  tail -n 14 "$log"
  say "./dev $command: $((SECONDS / 60)) min $((SECONDS % 60)) s, status $status"
  [ "$status" -eq 0 ] || exit "$status"
done
